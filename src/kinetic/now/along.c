/* along.c: the order of two points along a segment from its end 0. A turn of the segment does not change it.
 *
 *            end 1       With u and v the turns of a line against end 0 and end 1, the line crosses the segment at
 *       b -----o-- -     u / (u - v) of the way from end 0: 0 and 1 for the ends themselves. So of two lines
 *            /               share b - share a = (u_a v_b - u_b v_a) / ((u_a - v_a) (u_b - v_b))
 *     a ----/------      and the denominator does not change its sign as long as they cross. For the order of x the
 *       end 0            numerator would be multiplied by how far the segment goes in x, which is 0 when it turns. */
#include "kinetic/now/now.h"

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

/* The turns of the other line through a point of a segment. */
static void exact_turns(now_state *now, uint32_t segment, name_point p, poly_exact out[2]) {
    const uint32_t *end = now->segments.data[segment].end;
    num_arena *arena = &now->context.arena;
    out[0].degree = out[1].degree = 0;
    out[0].c[0] = num_dyadic_from(arena, end[0] != p.a), out[1].c[0] = num_dyadic_from(arena, end[0] == p.a);
    if (name_is_vertex(p)) return;
    const uint32_t *other = now->segments.data[p.a == segment ? (uint32_t)p.b : p.a].end;
    exact_point v[3];
    now_exact_along(now, other[0], v), now_exact_along(now, other[1], v + 1);
    for (int i = 0; i < 2; i++) {
        now_exact_along(now, end[i], v + 2);
        exact_turn(arena, v, out + i);
    }
}

/* u_p v_q - u_q v_p, whatever the sign of the denominator. */
static void exact_difference(now_state *now, const now_claim *claim, poly_exact *out) {
    const uint32_t s = now_shared(now, claim->p, claim->q);
    poly_exact p[2], q[2];
    now->context.arena.top = 0;
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
