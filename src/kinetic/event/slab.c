/* slab.c: the range of x in which the points of a failed certificate are. */
#include "kinetic/event/slab.h"
#include "kinetic/event/participants.h"
#include "kinetic/kinetic.h"
#include <math.h>

/* Coordinates up to 2^SAFE_TOP: participants and slabs are found by products of two differences, which stay finite. */
enum { SAFE_TOP = 480 };

bool slab_is_one_place(const ktree *tree, const slab_item *item) {
    name_point p = item->claim.p, q = item->claim.q, third;
    if (item->kind == CERT_TURN || p.b == NAME_SEGMENT || now_met_segment(tree->now, p, q) != FROE_NONE) return true;
    if (name_is_crossing(p) && name_is_crossing(q)) return name_third_crossing(p, q, &third);
    return ktree_is_one_segment(tree, p, q);
}

void slab_reach(now_state *now, double slab[2], name_point p) {
    now_spot spot = now_spot_of(now, p);
    double error = 2 * spot.error + fabs(spot.x) * 0x1p-51 + 0x1p-1060;
    if (!(error < (double)INFINITY)) return;
    if (spot.x - error < slab[0]) slab[0] = spot.x - error;
    if (spot.x + error > slab[1]) slab[1] = spot.x + error;
}

/* Where the segments at a vertex cross another one. */
static void reach_crossings(ktree *tree, double slab[2], uint32_t vertex, uint32_t other) {
    for (uint32_t e = tree->vertices.data[vertex]; e != FROE_NONE; e = ktree_next_end(tree, e))
        if (ktree_segment_at(tree, e / 2)->here && e / 2 != other)
            participants_reach_pair(tree->now, slab, e / 2, other);
}

void slab_find(ktree *tree, slab_item *item) {
    name_point p = item->claim.p, q = item->claim.q, third;
    if (tree->now->motion->top > SAFE_TOP) { /* one group, and the whole tree anew */
        item->slab[0] = -(double)INFINITY, item->slab[1] = (double)INFINITY;
        return;
    }
    item->slab[0] = (double)INFINITY, item->slab[1] = -(double)INFINITY;
    if (item->kind == CERT_FLOP) { /* edges change places all along */
        for (int i = 0; i < 3; i++)
            slab_reach(tree->now, item->slab, (name_point){now_face_of(tree->now, item->cert)->vertex[i], NAME_VERTEX});
        return;
    }
    slab_reach(tree->now, item->slab, q);
    if (p.b == NAME_SEGMENT) {
        reach_crossings(tree, item->slab, q.a, p.a);
        return;
    }
    slab_reach(tree->now, item->slab, p);
    uint32_t met = now_met_segment(tree->now, p, q);
    if (met != FROE_NONE) reach_crossings(tree, item->slab, name_is_vertex(p) ? p.a : q.a, met);
    if (name_is_crossing(p) && name_is_crossing(q) && name_third_crossing(p, q, &third))
        slab_reach(tree->now, item->slab, third);
}
