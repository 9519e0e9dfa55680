/* ring.h: the corners of a ring, named by what meets there.
 *
 *          edge i-1     edge i           own + own      an input vertex
 *     ------------- o -------------      own + cut      polygon edge x cut plane
 *               corner i                 cut + cut      support x cut plane x cut plane
 *
 * The ring of a segment has no edges but two ends: own, or the segment x cut plane. */
#ifndef FROE_TREE_RING_H
#define FROE_TREE_RING_H
#include "tree/tree.h"

typedef enum ring_point_kind { RING_VERTEX, RING_CROSSING, RING_CORNER } ring_point_kind;

/** A point: x; or where the line uv meets the cut of node a; or where the support meets those of a and b. */
typedef struct ring_point {
    ring_point_kind kind;
    const double *x;     /**< vertex */
    const double *u, *v; /**< crossing */
    uint32_t a, b;       /**< nodes */
} ring_point;

/** End i (0, 1) of a segment whose ring entry there is `end`. */
ring_point ring_end(const froe_scene *s, uint32_t object, uint32_t end);
/** The corner of a polygon between two entries that follow each other in its ring. */
ring_point ring_corner(const froe_scene *s, uint32_t object, uint32_t before, uint32_t after);
/** Corner i of a ring of `count` entries. */
ring_point ring_point_at(const froe_scene *s, uint32_t object, const uint32_t *ring, uint32_t count, uint32_t i);
#endif
