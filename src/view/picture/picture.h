/* picture.h: shapes and lines in the order in which they are painted: the internal types.
 *
 *     picture.c      the public calls: look, plan, paint
 *     plan.c         the order of painting; interleave.c: the places of lines in it
 *     whole.c        shapes: whole patches and clipped ones
 *     paint.c        visible regions and fragments
 *     kinds.c        which edges are lines; segments.c: where they are on the page
 *
 * It speaks for these. */
#ifndef FROE_VIEW_PICTURE_PICTURE_H
#define FROE_VIEW_PICTURE_PICTURE_H
#include "view/picture/outline.h"
#include "view/picture/overlay.h"
#include "view/picture/parts.h"
#include "view/visibility/region.h"

typedef struct picture_shape {
    uint32_t patch, first_ring, ring_count;
    bool whole;
} picture_shape;

typedef struct picture_stroke {
    uint32_t first, count; /**< in stroke_points */
    uint32_t place;        /**< shapes that are painted before it */
    uint16_t kind;
    uint8_t hidden, closed, butt[2];
} picture_stroke;

struct froe_picture {
    froe_allocator alloc;
    uint32_t *styles; /**< per shape */
    ARRAY(picture_shape) shapes;
    print_ring points;    /**< of the rings of all shapes */
    print_ends ring_ends; /**< per ring: where its points end */
    ARRAY(picture_stroke) strokes;
    print_ring stroke_points;
    ARRAY(double) stroke_space; /**< of these points in the scene, 3 each */
    ARRAY(uint32_t)
    stroke_objects; /**< per point: whose line leaves it; the last one of an open line repeats that before */
    froe_picture_report report;
};

/** A picture in the making. */
typedef struct view_painter {
    froe_picture *picture;
    const froe_picture_options *options;
    base_task task; /**< the threads */
    froe_visibility *v;
    view_sightlines *sights; /**< of v */
    view_parts parts;
    view_arcs arcs;
    view_graph graph;
    view_seams seams;
    view_region region;
    uint32_t *order;        /**< of the nodes */
    uint32_t *painted;      /**< per place in `order`: shapes there are before it is painted; NULL: not painted whole */
    uint8_t *breaks;        /**< per place in `order`: lines come before it; NULL: all lines are on top */
    view_items items;       /**< stretches of lines, which may lie on each other */
    view_segments segments; /**< their drawn parts */
    view_chains chains;
    uint32_t *places;  /**< per piece of the tree, when something is clear */
    uint8_t *left_out; /**< per patch; NULL: none is */
    uint32_t *runs;    /**< per patch, see view_outliner */
} view_painter;

/** Finds an order of whole patches, of which some may be late or split. FROE_E_BUDGET. */
froe_status view_plan_whole(view_painter *painter);
/** An order of the nodes of a graph of which those of the picture come first, then lines. FROE_E_MEMORY. */
froe_status view_sort_nodes(const view_painter *painter, const view_graph *graph, uint32_t *order);
/** The same order, with the places of visible segments in it, and so `breaks`. FROE_E_MEMORY. */
froe_status view_interleave(view_painter *painter);
/** Notes the patches of which too little is visible. FROE_E_MEMORY. */
froe_status view_leave_out(view_painter *painter);
/** Appends the shapes of that plan; of visible regions; of fragments. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status view_paint_whole(view_painter *painter);
froe_status view_paint_regions(view_painter *painter);
froe_status view_paint_fragments(view_painter *painter);
/** Is too little visible of a patch? */
static inline bool view_is_left_out(const view_painter *p, uint32_t patch) {
    return p->left_out && p->left_out[patch];
}
/** Appends the visible region of a patch as rings; those of less than three points are dropped. False without memory.
 */
bool view_append_region(view_painter *painter, uint32_t patch, print_ring *points, print_ends *ends);
/** Begins a shape; rings that are then added to points and ring_ends belong to it. */
bool view_begin_shape(froe_picture *picture, uint32_t patch, bool whole);
/** Ends it; a shape without rings is dropped. */
void view_end_shape(froe_picture *picture);

/** Which edges are lines, and of which kind: 0 none. One byte an edge: kinds of edges are below 256. */
void view_line_kinds(view_sightlines *sights, uint32_t wanted, double crease, uint8_t *kinds);
/** Makes segments of all visible (and hidden) intervals, cut as wished. FROE_E_MEMORY. */
froe_status view_make_segments(view_painter *painter, const uint8_t *kinds);
/** Appends the segments as strokes, chained. FROE_E_MEMORY. */
froe_status view_make_strokes(view_painter *painter);
#endif
