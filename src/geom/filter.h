/* filter.h: the semi-static stage: plain double arithmetic beside one bound per scalar or vector.
 *
 * Notation: u = 2^-53; a computed quantity x stands for a true one in [x - e, x + e].
 * Products and quotients add the constant NUM_BALL_TINY, which swallows their underflows (each
 * at most 2^-1075; sums have none); an overflow turns x and e into infinity or NaN, for which no
 * comparison below says "sure". So no factor needs to be guarded: the bounds hold for all
 * finite doubles (a guard on products alone is not enough: one factor may underflow while
 * another is huge). The factor FILTER_UP pays for the at most six roundings of each bound
 * itself. Scalar operations charge 2u a rounding, not u, so that they hold in every rounding
 * mode; sums over a normal need not, as there n_err is infinite then. */
#ifndef FROE_GEOM_FILTER_H
#define FROE_GEOM_FILTER_H
#include "geom/plane.h"
#include "num/ladder.h"

#define FILTER_U 0x1p-53
#define FILTER_UP (1 + 0x1p-49)
#define FILTER_LOST 0x1p-1073 /* more than three products lose by underflow */

/* A power of two that brings a tiny size to about 1; 1 for all others. Products of tiny numbers are below
 * NUM_BALL_TINY. Signs do not depend on scale, so the normal of a plane through tiny differences is scaled up first,
 * which is exact. */
#define FILTER_SMALL 0x1p-250
static inline double filter_lift(double most) {
    int exponent;
    if (most >= FILTER_SMALL || !(most > 0)) return 1;
    frexp(most, &exponent);
    return ldexp(1, exponent < -1000 ? 1000 : -exponent);
}

/* A power of two for a normal of differences that were lifted from below 2^-800: it becomes about 2^200 long. So its
 * product with a difference of denormal numbers is no less than 2^-874, which NUM_BALL_TINY does not hide, and one of
 * three such normals is still a double. 1 for all others. Lifted numbers are multiples of 2^-274, and so such a normal
 * is no less than 2^-548. */
static inline double filter_raise(double lift, double most) {
    int exponent;
    if (lift < 0x1p800 || !(most > 0)) return 1;
    frexp(most, &exponent);
    return ldexp(1, 200 - exponent);
}

/* sum n[k] w[k] - c, where w[k] = fl(x[k] - o[k]) has relative error u.
 *
 * Let P = sum |n[k] w[k]| + |c|. Each term suffers one rounding in w, one in the product and at
 * most three in the sum:  |x - sum n w_true + c| <= ((1+u)^5 - 1) P < 5.1u P, and P itself
 * is computed to (1 +- 5u). The error of the normal adds at most n_err sum |w_true|; n_err is
 * rounded up by 2^-48, which pays for the roundings here. Hence e = 8u P + n_err sum |w| + TINY. */
static inline num_ball filter_sum_in(int dim, const geom_plane *h, const double *w, double c) {
    double p0 = h->n[0] * w[0], p1 = h->n[1] * w[1], x = p0 + p1;
    double size = fabs(p0) + fabs(p1), spread = fabs(w[0]) + fabs(w[1]);
    if (dim == 3) {
        double p2 = h->n[2] * w[2];
        x += p2;
        size += fabs(p2);
        spread += fabs(w[2]);
    }
    x -= c;
    size += fabs(c);
    return (num_ball){x, 8 * FILTER_U * size + h->n_err * spread + NUM_BALL_TINY};
}

static inline num_ball filter_sum(const geom_plane *h, const double *w, double c) {
    return filter_sum_in(h->dim, h, w, c);
}

/* The same in any dimension D, for planes given by a vector: D roundings of the sum make (D + 2) u P, of which P itself
 * is computed to (1 +- (D + 2) u). Hence e = (2 D + 8) u P + n_err sum |w| + TINY. */
num_ball filter_sum_far(const geom_plane *h, const double *w, double c);

/* a - b for two doubles: one rounding, no underflow. */
static inline num_ball filter_difference(double a, double b) {
    double x = a - b;
    return (num_ball){x, 2 * FILTER_U * fabs(x)};
}

/* f(x) */
static inline num_ball filter_value(const geom_plane *h, const double *x) {
    if (h->form <= GEOM_AT_CROSSING) { /* a sure sign is that of the sheared plane, too */
        num_ball f = filter_difference(x[h->axis], h->c);
        return (num_ball){f.x, (f.e + h->c_err) * FILTER_UP};
    }
    if (geom_is_vector(h)) {
        num_ball f = h->dim > 3 ? filter_sum_far(h, x, h->c) : filter_sum(h, x, h->c);
        return (num_ball){f.x, f.e + h->c_err * FILTER_UP};
    }
    const double *o = h->p[0];
    const double w0 = x[0] - o[0], w1 = x[1] - o[1];
    if (h->dim == 2) return filter_sum_in(2, h, (const double[2]){w0, w1}, 0);
    return filter_sum_in(3, h, (const double[3]){w0, w1, x[2] - o[2]}, 0);
}

/* The sign of f(x) in the plane, form POINTS, or NUM_UNSURE: the filter_value that builders use most. */
static inline int filter_beside_line(const geom_plane *h, const double *x) {
    const double w[2] = {x[0] - h->p[0][0], x[1] - h->p[0][1]};
    num_ball f = filter_sum_in(2, h, w, 0);
    return f.x > f.e ? 1 : f.x < -f.e ? -1 : NUM_UNSURE;
}

/* A line of the plane and no more than its filter needs: f(x) = n . (x - o), as form POINTS has it, or a positive
 * multiple of that. One rounding in n[k]. */
typedef struct filter_line {
    double o[2], n[2], n_err;
} filter_line;

/* trusted: num_rounding_trusted(), asked once for many lines. */
static inline filter_line filter_line_through(const double *p, const double *q, bool trusted) {
    filter_line h = {{p[0], p[1]}, {p[1] - q[1], q[0] - p[0]}, INFINITY};
    const double lift = filter_lift(fmax(fabs(h.n[0]), fabs(h.n[1])));
    if (lift != 1) {
        const double raise = filter_raise(lift, lift * fmax(fabs(h.n[0]), fabs(h.n[1])));
        for (int k = 0; k < 2; k++) h.n[k] = h.n[k] * lift * raise;
    }
    if (trusted) h.n_err = 2 * FILTER_U * (fabs(h.n[0]) + fabs(h.n[1]));
    return h;
}

/* Bound on the error of filter_line_value wherever |x[k] - o[k]| <= w[k]: that of filter_sum_in, whose sums and
 * products grow with |w|. */
static inline double filter_line_bound(const filter_line *h, double w0, double w1) {
    double size = fabs(h->n[0]) * w0 + fabs(h->n[1]) * w1;
    return (8 * FILTER_U * size + h->n_err * (w0 + w1) + NUM_BALL_TINY) * FILTER_UP;
}

/* What it adds to the bound, per unit, that x is an image with an error. */
static inline double filter_line_reach(const filter_line *h) {
    return (fabs(h->n[0]) + fabs(h->n[1]) + 2 * h->n_err) * FILTER_UP;
}

static inline double filter_line_value(const filter_line *h, double x, double y) {
    return h->n[0] * (x - h->o[0]) + h->n[1] * (y - h->o[1]);
}

/* n . (v - u) */
static inline num_ball filter_slope(const geom_plane *h, const double *u, const double *v) {
    if (h->form <= GEOM_AT_CROSSING) return filter_difference(v[h->axis], u[h->axis]);
    if (h->dim > 3) {
        double far[FROE_MAX_DIM];
        for (int k = 0; k < h->dim; k++) far[k] = v[k] - u[k];
        return filter_sum_far(h, far, 0);
    }
    double w[3] = {v[0] - u[0], v[1] - u[1], h->dim == 3 ? v[2] - u[2] : 0};
    return filter_sum(h, w, 0);
}

/* |xy - x'y'| <= |x| e_y + |y| e_x + e_x e_y, and u |xy| for the rounding. */
static inline num_ball filter_mul(num_ball a, num_ball b) {
    double p = a.x * b.x;
    double e = fabs(a.x) * b.e + (fabs(b.x) + b.e) * a.e + 2 * FILTER_U * fabs(p);
    return (num_ball){p, e * FILTER_UP + NUM_BALL_TINY};
}

static inline num_ball filter_add(num_ball a, num_ball b) {
    double s = a.x + b.x;
    return (num_ball){s, (a.e + b.e + 2 * FILTER_U * fabs(s)) * FILTER_UP};
}

static inline num_ball filter_sub(num_ball a, num_ball b) {
    return filter_add(a, (num_ball){-b.x, b.e});
}

/* With q = fl(x / y), |x'/y' - q| <= (|x - q y| + e_x + |q| e_y) / (|y| - e_y), |x - q y| <= u |x|. Products that
 * underflow lose at most 2^-1075 each, which a small divisor makes large: they are paid for before it divides. */
static inline num_ball filter_div(num_ball a, num_ball b) {
    double q = a.x / b.x, gap = (fabs(b.x) - b.e) * (1 - 0x1p-50);
    double e = (2 * FILTER_U * fabs(a.x) + a.e + fabs(q) * b.e + FILTER_LOST) / gap;
    return (num_ball){q, gap > 0 ? e * FILTER_UP + NUM_BALL_TINY : (double)INFINITY};
}

/* One instruction, where fmax() is a call. Beside a NaN, errors are not finite, so either will do. */
static inline double filter_greater(double a, double b) {
    return a > b ? a : b;
}

/* A finite lower bound of a square or a sum of squares that may have overflowed. */
static inline double filter_capped(double square) {
    return square < 0x1p1023 ? square : 0x1p1023;
}

/* At least the length of a vector of `dim` components, of which the squares may underflow or overflow. */
static inline double filter_length_in(int dim, const double *n) {
    double most = 0, sum = 0;
    for (int k = 0; k < dim; k++) most = filter_greater(fabs(n[k]), most);
    for (int k = 0; k < dim; k++) sum += n[k] / most * (n[k] / most);
    return most > 0 ? most * (sqrt(sum) * (1 + 0x1p-48)) + 0x1p-1074 : most;
}

static inline double filter_length(const double n[3]) {
    return filter_length_in(3, n);
}

/* A vector with one error bound for all components. */
typedef struct filter_vector {
    double x[3], most, e; /* most = max |x[k]| */
} filter_vector;

static inline filter_vector filter_normal(const geom_plane *h) {
    return (filter_vector){{h->n[0], h->n[1], h->n[2]}, h->n_max, h->n_err};
}

/* Is the error at most that share of the vector? Not where the vector overflows, or nearly: infinity is a share of
 * infinity. */
static inline bool filter_is_fine(const filter_vector *v, double share) {
    return v->e <= share * v->most && v->most < 0x1p1000;
}

/* Three doubles; and q - p, of which each component is rounded once. */
static inline filter_vector filter_exact(const double x[3]) {
    const double most = filter_greater(filter_greater(fabs(x[0]), fabs(x[1])), fabs(x[2]));
    return (filter_vector){{x[0], x[1], x[2]}, most, 0};
}

static inline filter_vector filter_between(const double p[3], const double q[3]) {
    filter_vector d = filter_exact((const double[3]){q[0] - p[0], q[1] - p[1], q[2] - p[2]});
    d.e = 2 * FILTER_U * d.most;
    return d;
}

/* Each component has two products, of size at most M = a.most b.most and with error at most
 * a.most b.e + (b.most + b.e) a.e + uM, and a difference, at most 2M, that is rounded once. */
static inline filter_vector filter_cross(const filter_vector *a, const filter_vector *b) {
    filter_vector out;
    out.x[0] = a->x[1] * b->x[2] - a->x[2] * b->x[1];
    out.x[1] = a->x[2] * b->x[0] - a->x[0] * b->x[2];
    out.x[2] = a->x[0] * b->x[1] - a->x[1] * b->x[0];
    out.most = filter_greater(filter_greater(fabs(out.x[0]), fabs(out.x[1])), fabs(out.x[2]));
    double e = a->most * b->e + (b->most + b->e) * a->e + 2 * FILTER_U * (a->most * b->most);
    out.e = 2 * e * FILTER_UP + NUM_BALL_TINY;
    return out;
}

/* As above, three products and two roundings of the sum: 3u P. */
static inline num_ball filter_dot(const filter_vector *a, const filter_vector *b) {
    double p0 = a->x[0] * b->x[0], p1 = a->x[1] * b->x[1], p2 = a->x[2] * b->x[2];
    double carried = 3 * (a->most * b->e + (b->most + b->e) * a->e);
    double e = carried + 4 * FILTER_U * (fabs(p0) + fabs(p1) + fabs(p2));
    return (num_ball){p0 + p1 + p2, e * FILTER_UP + NUM_BALL_TINY};
}

/* -1, 1 or NUM_UNSURE; never 0, never for infinity or NaN (then e is not finite either). */
static inline int filter_sign(num_ball a) {
    return a.x > a.e ? 1 : a.x < -a.e ? -1 : NUM_UNSURE;
}
#endif
