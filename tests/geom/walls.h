/* walls.h: one random case for the predicates with sheared walls, among few points, so that lines share their ends and
 * points lie on walls. */
#ifndef FROE_TESTS_GEOM_WALLS_H
#define FROE_TESTS_GEOM_WALLS_H
#include "geom/sides.h"

enum { WALLS_POOL = 7 };

static inline const double *walls_pick(const sides_case *c, fuzz_source *r) {
    return c->points + c->dim * fuzz_int(r, 0, WALLS_POOL - 1);
}

/* Twice the signed area of what two lines span, as the definition of a wall wants it positive. */
static inline int walls_turn(int dim, const double *const ends[4]) {
    const double *flat[2] = {ends[0], ends[1]};
    geom_plane line = dim == 2 ? geom_plane_points(2, flat) : geom_plane_vertical(ends[0], ends[1]);
    rational_plane h;
    rational_point p;
    mpq_t from, to;
    rational_plane_init(&h);
    rational_point_init(&p);
    mpq_init(from);
    mpq_init(to);
    rational_plane_set(&h, &line);
    rational_point_set(&p, dim, ends[2]);
    rational_value(from, &h, &p);
    rational_point_set(&p, dim, ends[3]);
    rational_value(to, &h, &p);
    const int sign = mpq_cmp(to, from);
    rational_plane_clear(&h);
    rational_point_clear(&p);
    mpq_clear(from);
    mpq_clear(to);
    return sign;
}

static inline geom_plane walls_wall(const sides_case *c, fuzz_source *r) {
    const double *e[4];
    for (int i = 0; i < 4; i++) e[i] = walls_pick(c, r);
    const int sign = fuzz_int(r, 0, 2) ? walls_turn(c->dim, e) : 0;
    if (sign == 0) return geom_plane_at_vertex(c->dim, e[0]);
    const double *other[4] = {e[2], e[3], e[0], e[1]};
    return geom_plane_at_crossing(c->dim, sign > 0 ? e : other);
}

static inline geom_plane walls_plane(const sides_case *c, fuzz_source *r) {
    const double *p[3];
    for (int i = 0; i < 3; i++) p[i] = walls_pick(c, r);
    if (fuzz_int(r, 0, 1)) return walls_wall(c, r);
    return c->dim == 3 && fuzz_int(r, 0, 1) ? geom_plane_vertical(p[0], p[1]) : geom_plane_points(c->dim, p);
}

/* Walls, vertical planes and planes through the points; u and v are among these. */
static inline void walls_draw(fuzz_source *r, fuzz_class kind, int dim, sides_case *c) {
    c->dim = dim;
    fuzz_points(r, kind, dim, c->points, WALLS_POOL);
    c->u = walls_pick(c, r), c->v = walls_pick(c, r);
    for (int i = 0; i < SIDES_PLANES; i++) c->planes[i] = walls_plane(c, r);
    c->radius = fabs(c->v[0]);
}
#endif
