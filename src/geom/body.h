/* body.h: an object as geometry sees it: a closed convex set, given by corners that lie elsewhere.
 *
 *     point 1 corner, segment 2, polygon its ring, hull any, box {lo, hi}, ball {centre} and a radius > 0
 *
 * A ball of radius 0 is a point. Bodies are made by scene_body(), or by hand around a
 * caller's array. As a polytope a box has 2^dim corners; they are counted and computed here. */
#ifndef FROE_GEOM_BODY_H
#define FROE_GEOM_BODY_H
#include "num/context.h"

typedef struct geom_body {
    froe_kind form;
    int dim;
    uint32_t count; /**< points in coords */
    const double *coords;
    const uint32_t *corners; /**< point i is coords[corners[i] * dim ..]; NULL: coords[i * dim ..] */
    double radius;
} geom_body;

static inline const double *geom_body_point(const geom_body *b, uint32_t i) {
    return b->coords + (size_t)(b->corners ? b->corners[i] : i) * (size_t)b->dim;
}

/** Corners of the polytope (boxes: 2^dim, equal ones included; balls: the centre). */
static inline uint32_t geom_body_corners(const geom_body *b) {
    return b->form == FROE_BOX ? 1u << b->dim : b->count;
}

/** Corner i, dim 2 or 3; in the plane out[2] is 0. */
static inline void geom_body_corner(const geom_body *b, uint32_t i, double out[3]) {
    bool box = b->form == FROE_BOX;
    const double *lo = geom_body_point(b, box ? 0 : i), *hi = box ? geom_body_point(b, 1) : lo;
    out[2] = 0;
    for (int k = 0; k < b->dim; k++) out[k] = box && (i >> k & 1) ? hi[k] : lo[k];
}

/** One point as a body. */
static inline geom_body geom_body_at(int dim, const double *x) {
    return (geom_body){.form = FROE_POINT, .dim = dim, .count = 1, .coords = x};
}

/** Are two points equal? */
static inline bool geom_same_point(const double *p, const double *q, int dim) {
    for (int k = 0; k < dim; k++)
        if (p[k] != q[k]) return false;
    return true;
}

/** The dimension of the body itself, 0 .. dim: exact. */
int geom_body_rank(num_context *context, const geom_body *b);
#endif
