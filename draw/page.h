/* page.h: how a page is laid out: title above, legend below, the picture between. */
#ifndef FROE_DRAW_PAGE_H
#define FROE_DRAW_PAGE_H
#include "output.h"
#include "partition.h"
#include "task.h"

typedef struct draw_page {
    const froe_tree *tree;
    const froe_draw_options *options;
    froe_allocator alloc;
    draw_task *task;
    double width, height, margin;
    double unit; /**< line weights and letters are given for a page 960 wide; this scales them */
    double text; /**< size of small letters */
    double left, top, inner_width, inner_height; /**< what is left for the picture */
    double faint;                                /**< share of paper in the colours of cells: objects come first */
} draw_page;

/** Plans a page for a picture whose height is `aspect` times its width, plus gaps and labels
 * that take so many text sizes of the width and height. */
void draw_page_plan(draw_page *page, double aspect, double text_across, double text_down);

/** The contents of the legend. */
typedef struct draw_legend {
    bool scale_of_depths;
    double lo_depth, hi_depth;
    bool below, above;              /**< cells beyond the scale */
    double unit;                    /**< page units per `length` of the scene: a scale bar; 0: none */
    double length;                  /**< in scene coordinates: see unit */
    double squeeze;                 /**< of the space: see there */
    bool parts;                     /**< what is merged are the parts of an exploded view */
    uint64_t merged, merged_leaves; /**< regions drawn as one, leaves in them */
} draw_legend;
/** Paints background and title. */
void draw_page_open(const draw_page *page, cairo_t *cr);
void draw_page_close(const draw_page *page, cairo_t *cr, const draw_legend *legend);

/** The colour of a cell of a tone. */
uint32_t draw_cell_color(const draw_page *page, int tone);
/** An ellipse of these half axes as a path; four cubics. */
void draw_ellipse(cairo_t *cr, draw_point centre, draw_point half);
void draw_circle(cairo_t *cr, draw_point centre, double radius);
/** A number in at most 40 characters with 4 digits or, when whole, thousands set apart. */
void draw_number(char *out, double value);
void draw_count(char *out, uint64_t value);
#endif
