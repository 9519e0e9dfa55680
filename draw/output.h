/* output.h: a Cairo page whose bytes are collected in memory and reach a file at once or not at all. */
#ifndef FROE_DRAW_OUTPUT_H
#define FROE_DRAW_OUTPUT_H
#include "support/array.h"
#include <cairo.h>
#include <froe/draw.h>

typedef struct draw_output {
    froe_allocator alloc;
    froe_draw_format format;
    ARRAY(unsigned char) bytes;
    bool full; /**< out of memory while collecting */
    cairo_surface_t *surface;
    cairo_t *cr; /**< one unit is one page unit; y down */
} draw_output;

/** An empty page. */
froe_status draw_output_begin(draw_output *output, const froe_allocator *alloc, froe_draw_format format, double width,
                              double height, double scale, const char *title, froe_diagnostic *diag);
/** Finishes the page: all bytes are in `bytes`. */
froe_status draw_output_finish(draw_output *output, froe_diagnostic *diag);
void draw_output_free(draw_output *output);
#endif
