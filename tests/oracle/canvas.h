/* canvas.h: the oracle for pictures: what is left at each sample of a page when one shape after the other is
 * filled by the nonzero rule. Clear shapes leave what is under them. */
#ifndef FROE_TESTS_ORACLE_CANVAS_H
#define FROE_TESTS_ORACLE_CANVAS_H
#include "oracle/hits.h"

typedef struct oracle_layer {
    uint32_t patch, below; /**< below: a layer, FROE_NONE: the page */
} oracle_layer;

typedef struct oracle_canvas {
    oracle_grid grid;
    const froe_projection *view;
    uint32_t *top; /**< per sample: the layer painted last; FROE_NONE */
    oracle_layer *layers;
    size_t count, room;
    struct oracle_crossing *crossings;
    size_t crossing_count, crossing_room;
} oracle_canvas;

/** What was found, summed up over pictures. */
typedef struct oracle_result {
    uint64_t samples, covered; /**< looked at; where a ray meets something */
    uint64_t layers;           /**< painted there, in all */
    uint64_t ties, ties_wrong; /**< samples in a tie; those of them not ranked as froe says */
    uint64_t wrong;            /**< of the other samples */
    double at[2];              /**< the first wrong one on the page */
    uint32_t painted, met;     /**< there: patches, or FROE_NONE */
} oracle_result;

oracle_canvas oracle_canvas_new(oracle_grid grid, const froe_projection *view);
void oracle_canvas_free(oracle_canvas *canvas);
/** One side of a shape, then all of it as one shape. */
void oracle_side(oracle_canvas *canvas, const double from[2], const double to[2]);
void oracle_fill(oracle_canvas *canvas, uint32_t patch, bool clear);
void oracle_paint(oracle_canvas *canvas, const froe_picture *picture, const uint8_t *clear);
/** Holds a canvas against what rays meet. */
void oracle_compare(const oracle_canvas *canvas, const oracle_hits *hits, const uint8_t *clear, oracle_result *sum);
#endif
