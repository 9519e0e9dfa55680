/* lines.c: points and lines of the plane where bodies turn. */
#include "kinetic/motion/lines.h"

#include "num/dyadic_terms.inc"
#undef FORMULA
#define FORMULA(f) f##_turning
#define POLY poly_exact
#define POINT exact_point
#define LINE exact_line
#define CURVE motion_dyadic_curve
#include "kinetic/motion/arcs_body.inc"
#include "num/end_terms.inc"

/* How a body is placed, as polynomials, or at the tick. */
static void placing_at(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, bool along,
                       placing_turning *out) {
    motion_dyadic_curve centre;
    num_dyadic turn[4][2];
    motion_curve_dyadic(arena, m, piece, tick, &centre);
    const int turning = motion_tick_turn_dyadic(arena, m, piece, tick, turn);
    placing_of_turning(arena, &centre, along ? piece->degree : 0, turn, along ? turning : 0, out);
}

void exact_vertex_in(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, bool along,
                     exact_point *out) {
    placing_turning placing;
    placing_at(arena, m, piece, tick, along, &placing);
    point_in_turning(arena, &placing, piece->corner, out);
    out->z = (poly_exact){.degree = 0};
}

void exact_line_from(num_arena *arena, const froe_motion *m, const motion_piece end[2], int64_t tick, bool along,
                     exact_line *out) {
    if (end[0].corner && end[0].turn == end[1].turn) {
        placing_turning placing;
        placing_at(arena, m, end, tick, along, &placing);
        line_in_turning(arena, &placing, end[0].corner, end[1].corner, out);
        return;
    }
    exact_point p[2];
    for (int i = 0; i < 2; i++)
        if (along)
            exact_vertex(arena, m, end + i, tick, p + i);
        else
            exact_vertex_at(arena, m, end + i, tick, p + i);
    line_through_turning(arena, p, p + 1, out);
}

void exact_meeting(num_arena *arena, const exact_line line[2], exact_point *out) {
    const exact_line *l = line, *k = line + 1;
    det_turning(arena, &l->b, &k->c, &k->b, &l->c, &out->x);
    det_turning(arena, &l->c, &k->a, &k->c, &l->a, &out->y);
    det_turning(arena, &l->a, &k->b, &k->a, &l->b, &out->w);
    out->z = (poly_exact){.degree = 0};
}

void exact_beside(num_arena *arena, const exact_line *line, const exact_point *point, poly_exact *out) {
    side_of_line_turning(arena, line, point, out);
}
