/* gaps.h: pairs of convex bodies that have no point in common, certainly, and a gap as narrow as wanted.
 *
 *        A                Two random bodies are shifted until the points a and b that they reach furthest along a
 *        .a -> b .        random direction u and back along it are one gap apart. Coordinates are rounded, so that
 *            u      B     the bodies may meet: then the shift grows, until rationals (GMP) say that they do not. */
#ifndef FROE_TESTS_SUPPORT_GAPS_H
#define FROE_TESTS_SUPPORT_GAPS_H
#include "geom/body.h"
#include "support/fuzz.h"
#include <gmp.h>
#include <stdio.h>

enum { GAPS_CORNERS = 2 * FROE_MAX_DIM, GAPS_KINDS = 5 };
static const froe_kind gaps_kinds[GAPS_KINDS] = {FROE_POINT, FROE_BOX, FROE_BALL, FROE_SEGMENT, FROE_HULL};

typedef struct gaps_pair {
    int dim;
    double points[2][GAPS_CORNERS * FROE_MAX_DIM];
    geom_body body[2];
} gaps_pair;

/* How wide and where: everything times `scale`, then `away` along each axis. */
typedef struct gaps_place {
    double gap, scale, away;
} gaps_place;

static inline void gaps_body(fuzz_source *r, gaps_pair *p, int which, froe_kind kind) {
    geom_body *b = &p->body[which];
    double *x = p->points[which];
    *b = (geom_body){.form = kind, .dim = p->dim, .count = 1, .coords = x};
    if (kind == FROE_SEGMENT || kind == FROE_BOX) b->count = 2;
    if (kind == FROE_HULL) b->count = (uint32_t)fuzz_int(r, p->dim, 2 * p->dim);
    if (kind == FROE_BALL) b->radius = 0.1 + fabs(fuzz_unit(r));
    for (uint32_t i = 0; i < b->count * (uint32_t)p->dim; i++) x[i] = fuzz_unit(r);
    for (int k = 0; k < p->dim && kind == FROE_BOX; k++) x[p->dim + k] = x[k] + 0.1 + fabs(fuzz_unit(r));
}

/* The point that a body reaches furthest along u, of length 1. */
static inline void gaps_furthest(const geom_body *b, const double *u, int sign, double *out) {
    double most = -INFINITY;
    for (uint32_t i = 0; i < geom_body_corners(b); i++) {
        double x[FROE_MAX_DIM], sum = 0;
        for (int k = 0; k < b->dim; k++) {
            x[k] = geom_body_point(b, b->form == FROE_BOX ? i >> k & 1 : i)[k];
            sum += sign * u[k] * x[k];
        }
        if (sum <= most) continue;
        most = sum;
        for (int k = 0; k < b->dim; k++) out[k] = x[k] + sign * u[k] * b->radius;
    }
}

/* The least (sign 1) or minus the greatest (-1) value of u . x, without radius. */
static inline void gaps_reach(mpq_t out, const geom_body *b, const double *u, int sign) {
    mpq_t sum, x, n;
    mpq_inits(sum, x, n, NULL);
    for (uint32_t i = 0; i < geom_body_corners(b); i++) {
        mpq_set_ui(sum, 0, 1);
        for (int k = 0; k < b->dim; k++) {
            mpq_set_d(x, geom_body_point(b, b->form == FROE_BOX ? i >> k & 1 : i)[k]);
            mpq_set_d(n, sign * u[k]);
            mpq_mul(x, x, n);
            mpq_add(sum, sum, x);
        }
        if (!i || mpq_cmp(sum, out) < 0) mpq_set(out, sum);
    }
    mpq_clears(sum, x, n, NULL);
}

/* Are they apart along u, certainly? */
static inline bool gaps_are_apart(const gaps_pair *p, const double *u) {
    mpq_t a, b, square, n;
    mpq_inits(a, b, square, n, NULL);
    gaps_reach(a, &p->body[0], u, -1);
    gaps_reach(b, &p->body[1], u, 1);
    mpq_add(a, a, b);
    bool apart = mpq_sgn(a) > 0;
    mpq_set_d(n, p->body[0].radius);
    mpq_set_d(b, p->body[1].radius);
    mpq_add(b, b, n);
    mpq_mul(b, b, b);
    for (int k = 0; k < p->dim; k++) {
        mpq_set_d(n, u[k]);
        mpq_mul(n, n, n);
        mpq_add(square, square, n);
    }
    mpq_mul(b, b, square);
    mpq_mul(a, a, a);
    apart = apart && mpq_cmp(a, b) > 0;
    mpq_clears(a, b, square, n, NULL);
    return apart;
}

static inline void gaps_draw(fuzz_source *r, int dim, froe_kind a, froe_kind b, gaps_place at, gaps_pair *out) {
    double u[FROE_MAX_DIM], p[FROE_MAX_DIM], q[FROE_MAX_DIM], square = 0;
    gaps_pair still = {.dim = dim};
    for (int k = 0; k < dim; k++) u[k] = fuzz_unit(r), square += u[k] * u[k];
    for (int k = 0; k < dim; k++) u[k] /= sqrt(square);
    gaps_body(r, &still, 0, a);
    gaps_body(r, &still, 1, b);
    gaps_furthest(&still.body[0], u, 1, p);
    gaps_furthest(&still.body[1], u, -1, q);
    for (double more = 0;; more = more > 0 ? 2 * more : 0x1p-53) {
        *out = still;
        for (int i = 0; i < 2; i++) {
            geom_body *body = &out->body[i];
            body->coords = out->points[i];
            body->radius *= at.scale;
            for (uint32_t c = 0; c < body->count; c++)
                for (int k = 0; k < dim; k++) {
                    const double shift = i ? p[k] - q[k] + (at.gap + more) * u[k] : 0;
                    double *x = &out->points[i][c * (uint32_t)dim + (uint32_t)k];
                    *x = (*x + shift) * at.scale + at.away * at.scale + 0.0;
                }
        }
        if (gaps_are_apart(out, u)) return;
    }
}
#endif
