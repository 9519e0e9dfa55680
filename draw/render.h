/* render.h: a picture with hidden surfaces removed on its way to a file. */
#ifndef FROE_DRAW_RENDER_H
#define FROE_DRAW_RENDER_H
#include "output.h"
#include <math.h>

enum { DRAW_EPS = FROE_DRAW_FORMAT_COUNT }; /* a format of draw_output that partitions are not drawn in */

/** Colour and opacity, 0xAARRGGBB. */
typedef uint32_t draw_style;

typedef struct draw_render {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_scene *scene;
    const froe_render_options *options;
    froe_surface *surface;
    froe_projection view;
    froe_picture *picture;
    size_t patches;
    uint32_t *style_of;            /**< per patch, into styles */
    DRAW_ARRAY(draw_style) styles; /**< ascending, each once */
    uint32_t *layer_of;            /**< per group: the first of its name; NULL: there are no layers */
    uint32_t *keys;                /**< per patch: what the order of painting keeps together; NULL: styles */
    uint8_t *clear;                /**< per patch; NULL: all are opaque */
    int32_t *priorities;           /**< per patch; NULL */
    double grid;                   /**< steps of the output in a unit of the page: SVG's digits, Cairo's fixed point */
    froe_render_report report;
} draw_render;

/** Opacity of a group, 0 .. 1; of FROE_NONE 1. */
double draw_opacity(const froe_scene *scene, const froe_render_options *options, uint32_t group);
/** Fills style_of and styles. FROE_E_MEMORY. */
froe_status draw_shade(draw_render *render);
/** Width of a kind of line in units of the page. */
double draw_line_width(const froe_render_options *options, froe_line kind);
/** Colour of a shape. */
static inline draw_style draw_style_of(const draw_render *render, const froe_shape *shape) {
    return render->styles.data[render->style_of[shape->patch]];
}
/** How far a picture has been painted. */
typedef struct draw_cursor {
    size_t shape, stroke;
} draw_cursor;
/** What is painted as one path: shapes that may share it, or strokes of one kind. */
typedef struct draw_run {
    bool lines;
    bool last; /**< no shape comes after it */
    size_t first, end;
} draw_run;
/** Where a coordinate falls on the grid of the output. */
static inline int64_t draw_step(const draw_render *render, double x) {
    return (int64_t)floor(x * render->grid + 0.5);
}
/** Is anything left of a shape, one of its rings, or a stroke on that grid? */
bool draw_ring_shows(const draw_render *render, const double *points, size_t count);
bool draw_shape_shows(const draw_render *render, const froe_shape *shape);
bool draw_stroke_shows(const draw_render *render, const froe_stroke *stroke);
/** Notes in the report how many shapes and strokes that is, and how many not. */
void draw_count_shown(draw_render *render);
/** The next of them of which something shows; false: there is no more. */
bool draw_next_run(const draw_render *render, draw_cursor *at, draw_run *run);
/** Layer of a shape; FROE_NONE. */
uint32_t draw_layer_of(const draw_render *render, const froe_shape *shape);

/** When a picture is shown: the i-th of `count`, for a share of `seconds`. count 0: always. */
typedef struct draw_frame {
    size_t i, count;
    double seconds;
} draw_frame;
/** Write the beginning of an SVG, a picture (if `frame` says so, only for its time), and the end. False without memory.
 */
bool draw_svg_begin(draw_render *render, draw_output *output);
bool draw_svg_picture(draw_render *render, draw_output *output, const draw_frame *frame);
bool draw_svg_end(draw_render *render, draw_output *output);
/** Paints it onto a Cairo page. */
void draw_cairo(draw_render *render, cairo_t *cr);
#endif
