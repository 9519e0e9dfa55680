/* poly.c: polynomials in time. */
#include "kinetic/poly.h"

static num_ball ball_minus(num_ball a) {
    return (num_ball){-a.x, a.e};
}

static num_dyadic exact_minus(num_dyadic a) {
    a.sign = -a.sign;
    return a;
}

#define T num_ball
#define POLY poly_ball
#define POINT ball_point
#define NAME(f) ball_##f
#define ADD(a, b) num_ball_add(a, b)
#define SUB(a, b) num_ball_sub(a, b)
#define MUL(a, b) num_ball_mul(a, b)
#include "kinetic/poly_body.inc"

#define T num_dyadic
#define POLY poly_exact
#define POINT exact_point
#define NAME(f) exact_##f
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#include "kinetic/poly_body.inc"

void ball_vertex(const froe_motion *m, const motion_piece *piece, int64_t tick, ball_point *out) {
    motion_ball_curve curve;
    motion_curve_ball(m, piece, tick, &curve);
    out->x.degree = out->y.degree = piece->degree;
    out->w.degree = 0;
    for (int i = 0; i <= piece->degree; i++) out->x.c[i] = curve.x[i], out->y.c[i] = curve.y[i];
    out->w.c[0] = curve.w;
}

void exact_vertex(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, exact_point *out) {
    motion_dyadic_curve curve;
    motion_curve_dyadic(arena, m, piece, tick, &curve);
    out->x.degree = out->y.degree = piece->degree;
    out->w.degree = 0;
    for (int i = 0; i <= piece->degree; i++) out->x.c[i] = curve.x[i], out->y.c[i] = curve.y[i];
    out->w.c[0] = curve.w;
}

void exact_vertex_at(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                     exact_point *out) {
    num_dyadic at[3];
    motion_dyadic(arena, m, piece, tick, at);
    out->x.degree = out->y.degree = out->w.degree = 0;
    out->x.c[0] = at[0], out->y.c[0] = at[1], out->w.c[0] = at[2];
}

void ball_crossing(const ball_point p[4], ball_point *out) {
    ball_cross_lines(NULL, p, out);
}

void exact_crossing(num_arena *arena, const exact_point p[4], exact_point *out) {
    exact_cross_lines(arena, p, out);
}

void ball_order(const ball_point *p, const ball_point *q, int axis, poly_ball *out) {
    ball_order_points(NULL, p, q, axis, out);
}

void exact_order(num_arena *arena, const exact_point *p, const exact_point *q, int axis, poly_exact *out) {
    exact_order_points(arena, p, q, axis, out);
}

void ball_turn(const ball_point *a, const ball_point *b, const ball_point *q, poly_ball *out) {
    ball_turn_points(NULL, a, b, q, out);
}

void exact_turn(num_arena *arena, const exact_point *a, const exact_point *b, const exact_point *q, poly_exact *out) {
    exact_turn_points(arena, a, b, q, out);
}

int exact_sign(const poly_exact *p) {
    for (int i = 0; i <= p->degree; i++)
        if (p->c[i].sign) return p->c[i].sign;
    return 0;
}

/* p(s) becomes p(s + by). */
static void shift(num_arena *arena, poly_exact *p, num_dyadic by) {
    for (int i = 0; i < p->degree; i++)
        for (int j = p->degree - 1; j >= i; j--)
            p->c[j] = num_dyadic_add(arena, p->c[j], num_dyadic_mul(arena, p->c[j + 1], by));
}

/* p(low + 2^power / (1 + x)) (1 + x)^degree has its positive roots where p has those in question. */
int exact_variations(num_arena *arena, const poly_exact *p, int64_t low, int power, int *sign) {
    poly_exact r = *p, q = {.degree = p->degree};
    if (low) shift(arena, &r, num_dyadic_scaled(arena, 1, (uint64_t)low, 0));
    for (int i = 0; i <= r.degree; i++)
        q.c[r.degree - i] = num_dyadic_mul(arena, r.c[i], num_dyadic_scaled(arena, 1, 1, power * i));
    shift(arena, &q, num_dyadic_scaled(arena, 1, 1, 0));
    int changes = 0, last = 0;
    for (int i = 0; i <= q.degree; i++) {
        if (!q.c[i].sign) continue;
        changes += last == -q.c[i].sign;
        last = q.c[i].sign;
    }
    *sign = last;
    return changes;
}
