/* sides.h: one random case for the predicates, its answers by the oracle, and the check of
 * every stage against them. */
#ifndef FROE_TESTS_GEOM_SIDES_H
#define FROE_TESTS_GEOM_SIDES_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/predicates.h"
#include "support/fuzz.h"
#include "support/rational.h"

enum { SIDES_PLANES = 4, SIDES_POINTS = 14 };

/* Planes h, s, a, b and the points x (= u) and v. */
typedef struct sides_case {
    int dim;
    double points[SIDES_POINTS * 3];
    geom_plane planes[SIDES_PLANES];
    const double *u, *v;
    double radius;
} sides_case;

/* The oracle's variables, initialised once. */
typedef struct sides_oracle {
    rational_plane planes[SIDES_PLANES];
    rational_point u, v, x;
} sides_oracle;

typedef struct sides_tally {
    uint64_t compared, certified_zeros, skipped;
} sides_tally;

static inline void sides_oracle_init(sides_oracle *o) {
    for (int i = 0; i < SIDES_PLANES; i++) rational_plane_init(&o->planes[i]);
    rational_point_init(&o->u);
    rational_point_init(&o->v);
    rational_point_init(&o->x);
}
static inline void sides_oracle_clear(sides_oracle *o) {
    for (int i = 0; i < SIDES_PLANES; i++) rational_plane_clear(&o->planes[i]);
    rational_point_clear(&o->u);
    rational_point_clear(&o->v);
    rational_point_clear(&o->x);
}

/* Mostly planes through points, as in scenes. */
static inline geom_plane sides_plane(fuzz_source *r, int dim, const double *points) {
    const double *p[3] = {points, points + dim, points + 2 * dim};
    switch (fuzz_int(r, 0, 11)) {
    case 0:
    case 1:
        return geom_plane_axis(dim, fuzz_int(r, 0, dim - 1), points[fuzz_int(r, 0, dim - 1)]);
    case 2:
        return fuzz_int(r, 0, 1) ? geom_plane_vector(dim, points, points[dim]) : geom_plane_fine(dim, points, 2);
    case 3:
        return dim == 3 ? geom_plane_vertical(p[0], p[1]) : geom_plane_points(dim, p);
    default:
        return geom_plane_points(dim, p);
    }
}

static inline void sides_draw(fuzz_source *r, fuzz_class kind, int dim, sides_case *c) {
    c->dim = dim;
    fuzz_points(r, kind, dim, c->points, SIDES_POINTS);
    for (int i = 0; i < SIDES_PLANES; i++) c->planes[i] = sides_plane(r, dim, c->points + i * dim * dim);
    c->u = c->points + (SIDES_POINTS - 2) * dim;
    c->v = c->points + fuzz_int(r, 0, SIDES_POINTS - 1) * dim;
    c->radius = fabs(c->points[fuzz_int(r, 0, SIDES_POINTS * dim - 1)]);
}

static inline void sides_oracle_set(sides_oracle *o, const sides_case *c, int planes) {
    for (int i = 0; i < planes; i++) rational_plane_set(&o->planes[i], &c->planes[i]);
    rational_point_set(&o->u, c->dim, c->u);
    rational_point_set(&o->v, c->dim, c->v);
}

/* Asks one predicate, started at every stage in turn, and compares with the oracle. */
#define SIDES_CHECK(context, tally, expected, kind, call)                                                              \
    for (int stage_ = NUM_FILTER; stage_ <= NUM_EXACT; stage_++) {                                                     \
        (context)->first = (num_stage)stage_;                                                                          \
        uint64_t refined_ = (context)->stats.refined;                                                                  \
        int side_ = (call);                                                                                            \
        if (side_ != (expected))                                                                                       \
            fail_msg("%s, class %s, stage %d: %d instead of %d", #call, fuzz_names[kind], stage_, side_, (expected));  \
        (tally)->certified_zeros += side_ == 0 && (context)->stats.refined > refined_;                                 \
        (tally)->compared++;                                                                                           \
    }
#endif
