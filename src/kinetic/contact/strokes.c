/* strokes.c: see strokes.h. */
#include "kinetic/contact/strokes.h"

typedef struct ball_point {
    num_ball_poly x, y, w;
} ball_point;
typedef struct ball_line {
    num_ball_poly a, b, c;
} ball_line;

#include "num/ball_terms.inc"
#define POLY num_ball_poly
#define POINT ball_point
#define LINE ball_line
#define CURVE motion_ball_curve
#define SPAN(m, piece, from, to, out) motion_span_ball(m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_ball(m, piece, from, to, out)
#include "kinetic/contact/strokes_body.inc"

typedef struct dyadic_point {
    num_poly x, y, w;
} dyadic_point;
typedef struct dyadic_line {
    num_poly a, b, c;
} dyadic_line;

#include "num/dyadic_terms.inc"
#define POLY num_poly
#define POINT dyadic_point
#define LINE dyadic_line
#define CURVE motion_dyadic_curve
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
