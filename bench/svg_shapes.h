/* svg_shapes.h: what the fills of an SVG file show, for files that froe or gl2ps wrote: <path> of lines, <polygon>. */
#ifndef FROE_BENCH_SVG_SHAPES_H
#define FROE_BENCH_SVG_SHAPES_H
#include "oracle/canvas.h"

typedef struct svg_count {
    size_t shapes, bytes;
} svg_count;

/** Paints all fills, 0xRRGGBB in place of patches. `seen` (may be NULL) gets the colour of every element with a
 * data-object. Ends the program when the file cannot be read. */
svg_count svg_paint(const char *path, oracle_canvas *canvas, void (*seen)(void *, uint32_t object, uint32_t colour),
                    void *user);
#endif
