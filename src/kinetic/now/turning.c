/* turning.c: see turning.h. */
#include "kinetic/now/turning.h"

/* ------------------------------------------------------------------ in doubles -- */

now_spot now_turning_spot(now_state *now, uint32_t vertex) {
    now_bend *bend = now->bends.data + vertex;
    if (bend->tick == now->tick) return bend->spot;
    double at[3] = {0, 0, 0};
    const double error = motion_near(now->motion, &bend->piece, now->tick, at);
    bend->tick = now->tick;
    bend->spot = (now_spot){now_lifted(now, at[0]), now_lifted(now, at[1]), now_lifted(now, error) + NUM_BALL_TINY};
    return bend->spot;
}

/* The chord from q0 to q1 comes no nearer to 0 than sqrt(1/2), as their product is positive; so the angle changes by no
 * more than 2 |q1 - q0| / sqrt(1/2) for each unit of the piece, and lengths of quaternions are 1 within 2^-20. */
double now_turning_speed(now_state *now, uint32_t vertex) {
    const motion_piece *piece = &now->bends.data[vertex].piece;
    if (!piece->degree) return 0;
    const double *from = piece->from->at, *to = piece->to->at, *control = piece->from->control;
    const double *q = piece->turn[0].q, *r = piece->turn[1].q;
    const double arm = fabs(piece->corner[0]) + fabs(piece->corner[1]);
    const double angle = 3 * (fabs(r[2] - q[2]) + fabs(r[3] - q[3]));
    const double share = ldexp(1, now->motion->power) / (piece->to->time - piece->from->time); /* of it, in a tick */
    double way = 0;
    for (int k = 0; k < 2; k++) {
        const double first = piece->degree == 2 ? 2 * fabs(control[k] - from[k]) : fabs(to[k] - from[k]);
        way = fmax(way, piece->degree == 2 ? fmax(first, 2 * fabs(to[k] - control[k])) : first);
    }
    return now_lifted(now, (way + angle * arm) * share) * (1 + 0x1p-20);
}

/* --------------------------------------------------------------------- exactly -- */

bool now_is_turning_name(const now_state *now, name_point p) {
    if (!now->motion->bodies.count || p.b == NAME_NONE || p.b == NAME_LINE) return false;
    if (p.b == NAME_VERTEX) return now_is_turning(now, p.a);
    const now_segment *s = now->segments.data;
    return now_is_turning(now, s[p.a].end[0]) || (p.b >= 0 && now_is_turning(now, s[p.b].end[0]));
}

bool now_is_turning_claim(const now_state *now, const now_claim *claim) {
    if (claim->p.b == NAME_SEGMENT && now_is_turning(now, claim->q.a)) return true;
    return now_is_turning_name(now, claim->p) || now_is_turning_name(now, claim->q);
}

int now_vertices_of(const now_state *now, name_point p, uint32_t out[4]) {
    if (p.b == NAME_VERTEX) {
        out[0] = p.a;
        return 1;
    }
    for (int i = 0; i < 4; i++) out[i] = now->segments.data[i < 2 ? p.a : (uint32_t)p.b].end[i % 2];
    return 4;
}

void now_turning_line(now_state *now, const uint32_t vertex[2], bool along, exact_line *out) {
    motion_piece end[2];
    for (int i = 0; i < 2; i++) {
        now_course_of(now, vertex[i]);
        end[i] = now->bends.data[vertex[i]].piece;
    }
    exact_line_from(&now->context.arena, now->motion, end, now->tick, along, out);
}

void now_turning_point(now_state *now, const uint32_t *vertex, int count, bool along, exact_point *out) {
    if (count == 1) {
        if (along)
            now_exact_along(now, *vertex, out);
        else
            now_exact_at(now, *vertex, out);
        return;
    }
    exact_line line[2];
    for (int i = 0; i < 2; i++) now_turning_line(now, vertex + 2 * i, along, line + i);
    exact_meeting(&now->context.arena, line, out);
}

void now_turning_side(now_state *now, const uint32_t vertex[3], bool along, poly_exact *out) {
    exact_line line;
    exact_point point;
    now_turning_line(now, vertex, along, &line);
    now_turning_point(now, vertex + 2, 1, along, &point);
    exact_beside(&now->context.arena, &line, &point, out);
}

void now_turning_lines(now_state *now, const uint32_t vertex[4], bool along, poly_exact *out) {
    exact_point crossing;
    now_turning_point(now, vertex, 4, along, &crossing);
    *out = crossing.w;
}
