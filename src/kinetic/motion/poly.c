/* poly.c: polynomials in time. */
#include "kinetic/motion/poly.h"
#include "kinetic/motion/lines.h"

#define T num_short
#define POLY poly_short
#define POINT short_point
#define FORMULA(f) f##_short
#define NEG(a) (-(a))
#define ADD(a, b) ((a) + (b))
#define SUB(a, b) ((a) - (b))
#define MUL(a, b) ((a) * (b))
#define SIGN(a) (((a) > 0) - ((a) < 0))
#include "kinetic/motion/poly_body.inc"

#define T num_wide
#define POLY poly_wide
#define POINT wide_point
#define FORMULA(f) f##_wide
#define NEG(a) num_wide_sub((num_wide){{0}}, a)
#define ADD(a, b) num_wide_add(a, b)
#define SUB(a, b) num_wide_sub(a, b)
#define MUL(a, b) num_wide_mul(a, b)
#define SIGN(a) num_wide_sign(a)
#define FROM(x) num_wide_from(x)
#define POWER(k) num_wide_power(k)
#include "kinetic/motion/poly_body.inc"

#define T num_dyadic
#define POLY poly_exact
#define POINT exact_point
#define FORMULA(f) f##_exact
#define NEG(a) num_dyadic_neg(a)
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#define SIGN(a) (a).sign
#define FROM(x) num_dyadic_scaled(arena, 1, (uint64_t)(x), 0)
#define POWER(k) num_dyadic_scaled(arena, 1, 1, k)
#include "kinetic/motion/poly_body.inc"

#define CURVE_TO_POINT(curve, out)                                                                                     \
    do {                                                                                                               \
        (out)->x.degree = (out)->y.degree = (out)->z.degree = piece->degree;                                           \
        (out)->w.degree = 0;                                                                                           \
        for (int i = 0; i <= piece->degree; i++)                                                                       \
            (out)->x.c[i] = (curve).x[i], (out)->y.c[i] = (curve).y[i], (out)->z.c[i] = (curve).z[i];                  \
        (out)->w.c[0] = (curve).w;                                                                                     \
    } while (0)

void exact_vertex(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, exact_point *out) {
    if (piece->corner) {
        exact_vertex_in(arena, m, piece, tick, true, out);
        return;
    }
    motion_dyadic_curve curve;
    motion_curve_dyadic(arena, m, piece, tick, &curve);
    CURVE_TO_POINT(curve, out);
}

void exact_vertex_at(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                     exact_point *out) {
    if (piece->corner) {
        exact_vertex_in(arena, m, piece, tick, false, out);
        return;
    }
    num_dyadic at[4];
    motion_dyadic(arena, m, piece, tick, at);
    out->x.degree = out->y.degree = out->z.degree = out->w.degree = 0;
    out->x.c[0] = at[0], out->y.c[0] = at[1], out->w.c[0] = at[m->dim];
    if (m->dim == 3) out->z.c[0] = at[2];
}

void exact_crossing(num_arena *arena, const exact_point p[4], exact_point *out) {
    cross_lines_exact(arena, p, out);
}

int exact_compare_points(num_arena *arena, const exact_point *p, const exact_point *q, bool both) {
    return compare_points_exact(arena, p, q, both);
}

void exact_claim_points(num_arena *arena, const exact_point *p, const exact_point *q, int axis, poly_exact *out) {
    claim_points_exact(arena, p, q, axis, out);
}

void exact_turn(num_arena *arena, const exact_point v[3], poly_exact *out) {
    turn_points_exact(arena, v, v + 1, v + 2, out);
}

void exact_determinant(num_arena *arena, const poly_exact p[2], const poly_exact q[2], poly_exact *out) {
    det_exact(arena, p, q + 1, q, p + 1, out);
}

int exact_sign(const poly_exact *p) {
    return first_sign_exact(p);
}

int wide_sign(const poly_wide *p) {
    return first_sign_wide(p);
}

int exact_variations(num_arena *arena, const poly_exact *p, int64_t low, int power, int *sign) {
    return count_changes_exact(arena, p, low, power, sign);
}

int wide_variations(const poly_wide *p, int64_t low, int power, int *sign) {
    return count_changes_wide(NULL, p, low, power, sign);
}

int short_order_sign(const short_point *v, const int count[2], bool both) {
    return compare_named_short(NULL, v, count, both);
}

int wide_order_sign(const wide_point *v, const int count[2], bool both) {
    return compare_named_wide(NULL, v, count, both);
}

int exact_order_sign(num_arena *arena, const exact_point *v, const int count[2], bool both) {
    return compare_named_exact(arena, v, count, both);
}

int short_turn_sign(const short_point v[3]) {
    return side_of_short(NULL, v);
}

int wide_turn_sign(const wide_point v[3]) {
    return side_of_wide(NULL, v);
}

int exact_turn_sign(num_arena *arena, const exact_point v[3]) {
    return side_of_exact(arena, v);
}

int short_volume_sign(const short_point v[4]) {
    return side_of_plane_short(NULL, v);
}

int wide_volume_sign(const wide_point v[4]) {
    return side_of_plane_wide(NULL, v);
}

int exact_volume_sign(num_arena *arena, const exact_point v[4]) {
    return side_of_plane_exact(arena, v);
}

void wide_order(const wide_point *v, const int count[2], int axis, poly_wide *out) {
    claim_order_wide(NULL, v, count, axis, out);
}

void exact_order(num_arena *arena, const exact_point *v, const int count[2], int axis, poly_exact *out) {
    claim_order_exact(arena, v, count, axis, out);
}

void wide_turn(const wide_point v[3], poly_wide *out) {
    turn_points_wide(NULL, v, v + 1, v + 2, out);
}

void wide_lines(const wide_point v[4], poly_wide *out) {
    turn_lines_wide(NULL, v, out);
}

void exact_lines(num_arena *arena, const exact_point v[4], poly_exact *out) {
    turn_lines_exact(arena, v, out);
}

int short_lines_sign(const short_point v[4]) {
    return turn_of_lines_short(NULL, v);
}

int wide_lines_sign(const wide_point v[4]) {
    return turn_of_lines_wide(NULL, v);
}

int exact_lines_sign(num_arena *arena, const exact_point v[4]) {
    return turn_of_lines_exact(arena, v);
}

void exact_negate(poly_exact *p) {
    for (int i = 0; i <= p->degree; i++) p->c[i].sign = -p->c[i].sign;
}
