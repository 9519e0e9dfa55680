/* along.c: the order of two points along a segment from its end 0. A turn of the segment does not change it.
 *
 *            end 1       With u and v the turns of a line against end 0 and end 1, the line crosses the segment at
 *       b -----o-- -     u / (u - v) of the way from end 0: 0 and 1 for the ends themselves. So of two lines
 *            /               share b - share a = (u_a v_b - u_b v_a) / ((u_a - v_a) (u_b - v_b))
 *     a ----/------      and the denominator does not change its sign as long as they cross. For the order of x the
 *       end 0            numerator would be multiplied by how far the segment goes in x, which is 0 when it turns. */
#include "kinetic/now/turning.h"

uint32_t now_shared(const now_state *now, name_point p, name_point q) {
    if (!name_is_crossing(p)) {
        name_point other = p;
        p = q, q = other;
    }
    if (!name_is_crossing(p)) return FROE_NONE;
    const uint32_t both[2] = {p.a, (uint32_t)p.b};
    for (int i = 0; i < 2; i++) {
        if (name_is_crossing(q) && (q.a == both[i] || (uint32_t)q.b == both[i])) return both[i];
        if (name_is_vertex(q) && now_has_end(now, both[i], q.a)) return both[i];
    }
    return FROE_NONE;
}

uint32_t now_met_segment(const now_state *now, name_point p, name_point q) {
    name_point vertex = name_is_vertex(p) ? p : q, crossing = name_is_vertex(p) ? q : p;
    if (!name_is_vertex(vertex) || !name_is_crossing(crossing)) return FROE_NONE;
    if (now_has_end(now, crossing.a, vertex.a)) return (uint32_t)crossing.b;
    return now_has_end(now, (uint32_t)crossing.b, vertex.a) ? crossing.a : FROE_NONE;
}

static name_point end_name(const now_state *now, uint32_t segment, int end) {
    return (name_point){now->segments.data[segment].end[end], NAME_VERTEX};
}

int now_along_holds(now_state *now, const now_claim *claim) {
    const uint32_t s = now_shared(now, claim->p, claim->q);
    const int way = now_compare(now, end_name(now, s, 0), end_name(now, s, 1));
    return now_compare(now, claim->p, claim->q) * way > 0 ? 1 : -1;
}

/* The other line through a crossing on a segment. */
static const uint32_t *other_line(const now_state *now, uint32_t segment, name_point p) {
    return now->segments.data[p.a == segment ? (uint32_t)p.b : p.a].end;
}

/* The turns of that. */
static void exact_turns(now_state *now, uint32_t segment, name_point p, poly_exact out[2]) {
    const uint32_t *end = now->segments.data[segment].end;
    num_arena *arena = &now->context.arena;
    out[0].degree = out[1].degree = 0;
    out[0].c[0] = num_dyadic_from(arena, end[0] != p.a), out[1].c[0] = num_dyadic_from(arena, end[0] == p.a);
    if (name_is_vertex(p)) return;
    const uint32_t *other = other_line(now, segment, p);
    exact_point v[3];
    if (now_is_turning(now, *other) || now_is_turning(now, *end)) {
        for (int i = 0; i < 2; i++)
            now_turning_side(now, (const uint32_t[]){other[0], other[1], end[i]}, true, out + i);
        return;
    }
    now_exact_along(now, other[0], v), now_exact_along(now, other[1], v + 1);
    for (int i = 0; i < 2; i++) {
        now_exact_along(now, end[i], v + 2);
        exact_turn(arena, v, out + i);
    }
}

/* Where bodies turn, u_p v_q - u_q v_p has degree 12. With end 0 x end 1, which is the line of the segment but for a
 * positive factor, it is (p x q) . (end 0 x end 1) for lines p and q (Binet and Cauchy), and has degree 8. */
static void turning_difference(now_state *now, uint32_t segment, const now_claim *claim, poly_exact *out) {
    exact_line line[2], own;
    exact_point meeting;
    now_turning_line(now, other_line(now, segment, claim->p), true, line);
    now_turning_line(now, other_line(now, segment, claim->q), true, line + 1);
    now_turning_line(now, now->segments.data[segment].end, true, &own);
    exact_meeting(&now->context.arena, line, &meeting);
    exact_beside(&now->context.arena, &own, &meeting, out);
}

/* u_p v_q - u_q v_p, whatever the sign of the denominator. */
static void exact_difference(now_state *now, const now_claim *claim, poly_exact *out) {
    const uint32_t s = now_shared(now, claim->p, claim->q);
    poly_exact p[2], q[2];
    now->context.arena.top = 0;
    if (now_is_turning_claim(now, claim) && name_is_crossing(claim->p) && name_is_crossing(claim->q)) {
        turning_difference(now, s, claim, out);
        return;
    }
    exact_turns(now, s, claim->p, p);
    exact_turns(now, s, claim->q, q);
    exact_determinant(&now->context.arena, p, q, out);
}

/* REQUIRES: the claim holds now, which determines the sign. */
void now_along_exact(now_state *now, const now_claim *claim, poly_exact *out) {
    exact_difference(now, claim, out);
    if (exact_sign(out) <= 0) exact_negate(out);
}

int now_along_sign(now_state *now, const now_claim *claim) {
    poly_exact difference;
    exact_difference(now, claim, &difference);
    return exact_sign(&difference);
}
