/* slab.c: the range of x in which an event takes place. */
#include "kinetic/live.h"
#include <math.h>

/* Coordinates up to 2^SAFE_TOP: participants and slabs are found by products of two differences, which stay finite. */
enum { SAFE_TOP = 480 };

bool live_has_end(const froe_kinetic *k, uint32_t segment, uint32_t vertex) {
    const uint32_t *end = k->now.segments.data[segment].end;
    return end[0] == vertex || end[1] == vertex;
}

void live_reach(froe_kinetic *k, double slab[2], now_name p) {
    now_spot spot = now_spot_of(&k->now, p);
    double error = 2 * spot.error + fabs(spot.x) * 0x1p-51 + 0x1p-1060;
    if (!(error < (double)INFINITY)) return;
    if (spot.x - error < slab[0]) slab[0] = spot.x - error;
    if (spot.x + error > slab[1]) slab[1] = spot.x + error;
}

/* Where the segments at a vertex cross another one. */
static void reach_crossings(froe_kinetic *k, double slab[2], uint32_t vertex, uint32_t other) {
    for (uint32_t e = k->vertices.data[vertex]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (segment_at(k, e / 2)->here && e / 2 != other) live_reach_pair(k, slab, e / 2, other);
}

bool live_third_crossing(now_name p, now_name q, now_name *out) {
    const uint32_t a[2] = {p.a, (uint32_t)p.b}, b[2] = {q.a, (uint32_t)q.b};
    for (int i = 0; i < 4; i++)
        if (a[i / 2] == b[i % 2]) {
            *out = name_crossing(a[1 - i / 2], b[1 - i % 2]);
            return true;
        }
    return false;
}

uint32_t live_met_segment(const froe_kinetic *k, now_name p, now_name q) {
    now_name vertex = name_is_vertex(p) ? p : q, crossing = name_is_vertex(p) ? q : p;
    if (!name_is_vertex(vertex) || !name_is_crossing(crossing)) return FROE_NONE;
    if (live_has_end(k, crossing.a, vertex.a)) return (uint32_t)crossing.b;
    return live_has_end(k, (uint32_t)crossing.b, vertex.a) ? crossing.a : FROE_NONE;
}

bool live_is_one_segment(const froe_kinetic *k, now_name p, now_name q) {
    if (!name_is_vertex(p) || !name_is_vertex(q)) return false;
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (live_has_end(k, e / 2, q.a)) return true;
    return false;
}

void live_find_slab(froe_kinetic *k, live_item *item) {
    now_name p = item->claim.p, q = item->claim.q, third;
    if (k->now.motion->top > SAFE_TOP) { /* one group, and the whole tree anew */
        item->slab[0] = -(double)INFINITY, item->slab[1] = (double)INFINITY;
        return;
    }
    item->slab[0] = (double)INFINITY, item->slab[1] = -(double)INFINITY;
    live_reach(k, item->slab, q);
    if (p.b == NAME_SEGMENT) {
        reach_crossings(k, item->slab, q.a, p.a);
        return;
    }
    live_reach(k, item->slab, p);
    uint32_t met = live_met_segment(k, p, q);
    if (met != FROE_NONE) reach_crossings(k, item->slab, name_is_vertex(p) ? p.a : q.a, met);
    if (name_is_crossing(p) && name_is_crossing(q) && live_third_crossing(p, q, &third))
        live_reach(k, item->slab, third);
}
