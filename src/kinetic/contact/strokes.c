/* strokes.c: see strokes.h. */
#include "kinetic/contact/strokes.h"

static inline num_ball minus_ball(num_ball a) {
    return (num_ball){-a.x, a.e};
}

static inline num_dyadic minus_dyadic(num_dyadic a) {
    a.sign = -a.sign;
    return a;
}

typedef struct ball_point {
    num_ball_poly x, y, w;
} ball_point;
typedef struct ball_line {
    num_ball_poly a, b, c;
} ball_line;

#define T num_ball
#define POLY num_ball_poly
#define POINT ball_point
#define LINE ball_line
#define CURVE motion_ball_curve
#define FORMULA(f) f##_ball
#define ADD(a, b) num_ball_add(a, b)
#define SUB(a, b) num_ball_sub(a, b)
#define MUL(a, b) num_ball_mul(a, b)
#define FROM(x) num_ball_from(x)
#define SPAN(m, piece, from, to, out) motion_span_ball(m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_ball(m, piece, from, to, out)
#include "kinetic/contact/strokes_body.inc"
#undef T
#undef POLY
#undef POINT
#undef LINE
#undef CURVE
#undef FORMULA
#undef ADD
#undef SUB
#undef MUL
#undef FROM
#undef SPAN
#undef TURN

typedef struct dyadic_point {
    num_poly x, y, w;
} dyadic_point;
typedef struct dyadic_line {
    num_poly a, b, c;
} dyadic_line;

#define T num_dyadic
#define POLY num_poly
#define POINT dyadic_point
#define LINE dyadic_line
#define CURVE motion_dyadic_curve
#define FORMULA(f) f##_dyadic
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#define FROM(x) num_dyadic_from(arena, x)
#define SPAN(m, piece, from, to, out) motion_span_dyadic(arena, m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_dyadic(arena, m, piece, from, to, out)
#include "kinetic/contact/strokes_body.inc"

void strokes_near(const froe_motion *m, const motion_piece piece[4], double from, double to, num_ball_poly gap[8],
                  num_ball_poly turn[4]) {
    between_bars_ball(NULL, m, piece, from, to, gap, turn);
}

void strokes_exact(num_arena *arena, const froe_motion *m, const motion_piece piece[4], double from, double to,
                   num_poly gap[8], num_poly turn[4]) {
    between_bars_dyadic(arena, m, piece, from, to, gap, turn);
}
