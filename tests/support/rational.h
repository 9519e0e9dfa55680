/* rational.h: the oracle: points and planes in exact rationals (GMP), straight from the
 * definitions; it shares no formula and no arithmetic with the code under test.
 *
 *     rational_plane h, a;  rational_point u, v, x;         // init each once, clear at the end
 *     rational_plane_set(&h, &plane);  rational_point_set(&u, 3, doubles);
 *     if (rational_meet(&x, &a, &u, &v)) side = rational_side(&h, &x);
 *
 * A point is homogeneous, x[k] / w with w > 0, so that nothing is ever divided. */
#ifndef FROE_TESTS_SUPPORT_RATIONAL_H
#define FROE_TESTS_SUPPORT_RATIONAL_H
#include "geom/plane.h"
#include <gmp.h>
#include <math.h>
#include <string.h>

/** n . x = c */
typedef struct rational_plane {
    int dim;
    mpq_t n[3], c;
} rational_plane;

typedef struct rational_point {
    int dim;
    mpq_t x[3], w;
} rational_point;

static inline void rational_plane_init(rational_plane *h) {
    for (int k = 0; k < 3; k++) mpq_init(h->n[k]);
    mpq_init(h->c);
}
static inline void rational_plane_clear(rational_plane *h) {
    for (int k = 0; k < 3; k++) mpq_clear(h->n[k]);
    mpq_clear(h->c);
}
static inline void rational_point_init(rational_point *p) {
    for (int k = 0; k < 3; k++) mpq_init(p->x[k]);
    mpq_init(p->w);
}
static inline void rational_point_clear(rational_point *p) {
    for (int k = 0; k < 3; k++) mpq_clear(p->x[k]);
    mpq_clear(p->w);
}

/** An input point. */
static inline void rational_point_set(rational_point *p, int dim, const double *x) {
    p->dim = dim;
    for (int k = 0; k < 3; k++) mpq_set_d(p->x[k], k < dim ? x[k] : 0);
    mpq_set_ui(p->w, 1, 1);
}

/** out += sign * a * b, or -= when sign < 0. */
static inline void rational_add_product(mpq_t out, int sign, const mpq_t a, const mpq_t b) {
    mpq_t t;
    mpq_init(t);
    mpq_mul(t, a, b);
    if (sign > 0)
        mpq_add(out, out, t);
    else
        mpq_sub(out, out, t);
    mpq_clear(t);
}

/** An input point between two others: u + t (v - u). */
static inline void rational_point_between(rational_point *p, int dim, const double *u, const double *v, double t) {
    mpq_t share, d;
    mpq_init(share);
    mpq_init(d);
    mpq_set_d(share, t);
    rational_point_set(p, dim, u);
    for (int k = 0; k < dim; k++) {
        mpq_set_d(d, v[k]);
        mpq_sub(d, d, p->x[k]);
        rational_add_product(p->x[k], 1, share, d);
    }
    mpq_clear(share);
    mpq_clear(d);
}

/** out = a x b */
static inline void rational_cross(mpq_t out[3], mpq_t a[3], mpq_t b[3]) {
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        mpq_set_ui(out[k], 0, 1);
        rational_add_product(out[k], 1, a[i], b[j]);
        rational_add_product(out[k], -1, a[j], b[i]);
    }
}

/** out = a . b */
static inline void rational_dot(mpq_t out, mpq_t a[3], mpq_t b[3]) {
    mpq_set_ui(out, 0, 1);
    for (int k = 0; k < 3; k++) rational_add_product(out, 1, a[k], b[k]);
}

/** (n . x - c) w */
static inline void rational_value(mpq_t out, rational_plane *h, rational_point *p) {
    rational_dot(out, h->n, p->x);
    rational_add_product(out, -1, h->c, p->w);
}

static inline int rational_side(rational_plane *h, rational_point *p) {
    mpq_t value;
    mpq_init(value);
    rational_value(value, h, p);
    int sign = mpq_sgn(value);
    mpq_clear(value);
    return sign;
}

/** Makes w > 0; false when it is 0. */
static inline bool rational_point_orient(rational_point *p) {
    int sign = mpq_sgn(p->w);
    for (int k = 0; k < 3 && sign < 0; k++) mpq_neg(p->x[k], p->x[k]);
    if (sign < 0) mpq_neg(p->w, p->w);
    return sign != 0;
}

/** The point where line pq meets h; false when they are parallel. out may not be p or q. */
static inline bool rational_meet(rational_point *out, rational_plane *h, rational_point *p, rational_point *q) {
    mpq_t at_p, at_q;
    mpq_init(at_p);
    mpq_init(at_q);
    rational_value(at_p, h, p);
    rational_value(at_q, h, q);
    out->dim = p->dim;
    for (int k = 0; k < 4; k++) { /* h(q) p - h(p) q */
        mpq_t *to = k < 3 ? &out->x[k] : &out->w;
        mpq_mul(*to, at_q, k < 3 ? p->x[k] : p->w);
        rational_add_product(*to, -1, at_p, k < 3 ? q->x[k] : q->w);
    }
    mpq_clear(at_p);
    mpq_clear(at_q);
    return rational_point_orient(out);
}

/** The infinitesimal by which walls are sheared, as a number smaller than what predicates on doubles can tell apart. */
#define RATIONAL_EPS_BITS 65536

/** n = (1, eps, 0), c = n . p, where p is the vertex or the crossing. */
static inline void rational_wall_set(rational_plane *h, const geom_plane *plane) {
    rational_point p, q, at;
    rational_point_init(&p), rational_point_init(&q), rational_point_init(&at);
    rational_point_set(&at, 2, plane->p[0]);
    if (plane->form == GEOM_AT_CROSSING) { /* the second line is that of n . x = c */
        rational_point_set(&p, 2, plane->p[2]);
        rational_point_set(&q, 2, plane->p[3]);
        h->dim = 2;
        mpq_sub(h->n[0], p.x[1], q.x[1]);
        mpq_sub(h->n[1], q.x[0], p.x[0]);
        mpq_set_ui(h->n[2], 0, 1);
        rational_dot(h->c, h->n, p.x);
        rational_point_set(&p, 2, plane->p[0]);
        rational_point_set(&q, 2, plane->p[1]);
        rational_meet(&at, h, &p, &q);
    }
    mpq_set_ui(h->n[0], 1, 1);
    mpq_div_2exp(h->n[1], h->n[0], RATIONAL_EPS_BITS);
    mpq_set_ui(h->n[2], 0, 1);
    rational_dot(h->c, h->n, at.x);
    mpq_div(h->c, h->c, at.w);
    rational_point_clear(&p), rational_point_clear(&q), rational_point_clear(&at);
}

/** Coefficient k of a FINE plane. */
static inline void rational_sum_rows(mpq_t out, const geom_plane *plane, int k) {
    mpq_t row;
    mpq_init(row);
    mpq_set_ui(out, 0, 1);
    for (int i = 0; i < plane->row_count; i++) {
        mpq_set_d(row, plane->rows[i * (plane->dim + 1) + k]);
        mpq_div_2exp(row, row, 53 * (mp_bitcnt_t)i);
        mpq_add(out, out, row);
    }
    mpq_clear(row);
}

/** From the definition in geom/plane.h, whatever image the plane carries. */
static inline void rational_plane_set(rational_plane *h, const geom_plane *plane) {
    rational_point p[3];
    if (geom_is_sheared(plane)) {
        rational_wall_set(h, plane);
        h->dim = plane->dim;
        return;
    }
    for (int i = 0; i < 3; i++) rational_point_init(&p[i]);
    for (int i = 0; i < 3 && plane->form <= GEOM_VERTICAL; i++) rational_point_set(&p[i], plane->dim, plane->p[i]);
    h->dim = plane->dim;
    for (int k = 0; k < 3; k++) mpq_set_ui(h->n[k], 0, 1);
    mpq_set_d(h->c, plane->c);
    if (plane->form == GEOM_AXIS) mpq_set_ui(h->n[plane->axis], 1, 1);
    if (plane->form == GEOM_VECTOR)
        for (int k = 0; k < 3; k++) mpq_set_d(h->n[k], plane->normal[k]);
    if (plane->form == GEOM_FINE) {
        for (int k = 0; k < plane->dim; k++) rational_sum_rows(h->n[k], plane, k);
        rational_sum_rows(h->c, plane, plane->dim);
    }
    if (plane->form == GEOM_POINTS || plane->form == GEOM_VERTICAL) {
        for (int i = 1; i < 3; i++)
            for (int k = 0; k < 3; k++) mpq_sub(p[i].x[k], p[i].x[k], p[0].x[k]);
        if (plane->form == GEOM_POINTS && plane->dim == 3) {
            rational_cross(h->n, p[1].x, p[2].x);
        } else {
            mpq_neg(h->n[0], p[1].x[1]);
            mpq_set(h->n[1], p[1].x[0]);
        }
        rational_dot(h->c, h->n, p[0].x);
    }
    for (int i = 0; i < 3; i++) rational_point_clear(&p[i]);
}

/** The point on three planes, by Cramer's rule; false unless there is exactly one. */
static inline bool rational_corner(rational_point *out, rational_plane *s, rational_plane *a, rational_plane *b) {
    rational_plane *planes[3] = {s, a, b};
    rational_point cross;
    rational_point_init(&cross);
    out->dim = 3;
    for (int k = 0; k < 3; k++) mpq_set_ui(out->x[k], 0, 1);
    for (int i = 0; i < 3; i++) {
        rational_cross(cross.x, planes[(i + 1) % 3]->n, planes[(i + 2) % 3]->n);
        for (int k = 0; k < 3; k++) rational_add_product(out->x[k], 1, planes[i]->c, cross.x[k]);
        if (i == 0) rational_dot(out->w, s->n, cross.x);
    }
    rational_point_clear(&cross);
    return rational_point_orient(out);
}

/** As geom_side_ball. */
static inline int rational_side_ball(rational_plane *h, rational_point *centre, double radius) {
    mpq_t value, square, reach;
    mpq_init(value);
    mpq_init(square);
    mpq_init(reach);
    rational_value(value, h, centre);
    int side = mpq_sgn(value);
    rational_dot(square, h->n, h->n);
    mpq_set_d(reach, radius);
    mpq_mul(square, square, reach);
    mpq_mul(square, square, reach);
    mpq_mul(value, value, value);
    if (radius > 0 && (side == 0 || mpq_cmp(value, square) < 0)) side = 2;
    mpq_clear(value);
    mpq_clear(square);
    mpq_clear(reach);
    return side;
}

/** Coordinate k as a fraction. */
static inline void rational_coordinate(mpq_t out, rational_point *p, int k) {
    mpq_div(out, p->x[k], p->w);
}

/** Is every coordinate of p within `error` of x? */
static inline bool rational_within(rational_point *p, const double *x, double error) {
    mpq_t exact, bound;
    bool within = true;
    if (!(error < INFINITY)) return true;
    mpq_init(exact);
    mpq_init(bound);
    for (int k = 0; k < p->dim; k++) {
        rational_coordinate(exact, p, k);
        mpq_set_d(bound, x[k]);
        mpq_sub(exact, exact, bound);
        mpq_abs(exact, exact);
        mpq_set_d(bound, error);
        within = within && mpq_cmp(exact, bound) <= 0;
    }
    mpq_clear(exact);
    mpq_clear(bound);
    return within;
}

/** Half way from |x| to the next larger double, or to 2^1024. */
static inline void rational_half_way(mpq_t out, double x) {
    mpq_t step;
    double magnitude = fabs(x), next = nextafter(magnitude, INFINITY);
    mpq_init(step);
    mpq_set_d(out, magnitude);
    mpq_set_d(step, isinf(next) ? magnitude - nextafter(magnitude, 0) : next - magnitude);
    mpq_div_2exp(step, step, 1);
    mpq_add(out, out, step);
    mpq_clear(step);
}

/** Is x the double nearest to q, ties to even, infinity from half way beyond the largest? */
static inline bool rational_rounds_to(const mpq_t q, double x) {
    mpq_t magnitude, limit;
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bool even = (bits & 1) == 0, right = x == 0 || (x > 0) == (mpq_sgn(q) > 0);
    mpq_init(magnitude);
    mpq_init(limit);
    mpq_abs(magnitude, q);
    if (!isinf(x)) {
        rational_half_way(limit, x);
        int above = mpq_cmp(magnitude, limit);
        right = right && (above < 0 || (above == 0 && even));
    }
    if (x != 0) {
        rational_half_way(limit, isinf(x) ? 0x1.fffffffffffffp1023 : nextafter(fabs(x), 0));
        int above = mpq_cmp(magnitude, limit);
        right = right && (above > 0 || (above == 0 && (isinf(x) || even)));
    }
    mpq_clear(magnitude);
    mpq_clear(limit);
    return right;
}
#endif
