/* render.h: a picture with hidden surfaces removed on its way to a file. */
#ifndef FROE_DRAW_RENDER_H
#define FROE_DRAW_RENDER_H
#include "output.h"

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
    uint8_t *clear;                /**< per patch; NULL: all are opaque */
    int32_t *priorities;           /**< per patch; NULL */
    uint64_t paths;
} draw_render;

/** Fills style_of and styles. FROE_E_MEMORY. */
froe_status draw_shade(draw_render *render);
/** Width of a kind of line in units of the page. */
double draw_line_width(const froe_render_options *options, froe_line kind);
/** Writes the picture as SVG into bytes. False without memory. */
bool draw_svg(draw_render *render, draw_output *output);
/** Paints it onto a Cairo page. */
void draw_cairo(draw_render *render, cairo_t *cr);
#endif
