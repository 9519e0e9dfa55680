/* slab.c: the range of x in which the points of a failed certificate are. */
#include "kinetic/event/slab.h"
#include "base/sort.h"
#include "kinetic/event/participants.h"
#include "kinetic/kinetic.h"
#include <math.h>

static froe_event_kind kind_of(const ktree *tree, const slab_item *item) {
    const name_point p = item->claim.p, q = item->claim.q;
    name_point third;
    if (item->kind == CERT_TURN) return FROE_EVENT_TURN;
    if (item->kind == CERT_FLOP) return FROE_EVENT_FLOP;
    if (item->kind > CERT_RIGHT) return FROE_EVENT_CONTACT;
    if (name_is_vertex(p) && name_is_vertex(q))
        return ktree_is_one_segment(tree, p, q) ? FROE_EVENT_TURN : FROE_EVENT_VERTICES;
    if (now_met_segment(tree->now, p, q) != FROE_NONE) return FROE_EVENT_CONTACT;
    if (name_is_vertex(p) || name_is_vertex(q)) return FROE_EVENT_VERTEX_CROSSING;
    return name_third_crossing(p, q, &third) ? FROE_EVENT_TRIPLE : FROE_EVENT_CROSSINGS;
}

static void reach_spot(double slab[2], now_spot spot) {
    double error = 2 * spot.error + fabs(spot.x) * 0x1p-51 + 0x1p-1060;
    if (!(error < (double)INFINITY)) return;
    if (spot.x - error < slab[0]) slab[0] = spot.x - error;
    if (spot.x + error > slab[1]) slab[1] = spot.x + error;
}

void slab_reach(now_state *now, double slab[2], name_point p) {
    reach_spot(slab, now_spot_of(now, p));
}

/* Where the segments at a vertex cross another one. */
static void reach_crossings(ktree *tree, double slab[2], uint32_t vertex, uint32_t other) {
    for (uint32_t e = tree->vertices.data[vertex]; e != FROE_NONE; e = ktree_next_end(tree, e))
        if (ktree_segment_at(tree, e / 2)->here && e / 2 != other)
            participants_reach_pair(tree->now, slab, e / 2, other);
}

void slab_locate(now_state *now, slab_item *item) {
    if (item->claim.p.b != NAME_SEGMENT) item->spot[0] = now_spot_of(now, item->claim.p);
    item->spot[1] = now_spot_of(now, item->claim.q);
}

void slab_find(ktree *tree, slab_item *item) {
    name_point p = item->claim.p, q = item->claim.q, third;
    item->slab[0] = (double)INFINITY, item->slab[1] = -(double)INFINITY;
    item->event = kind_of(tree, item);
    if (item->kind == CERT_FLOP) { /* edges change places all along */
        for (int i = 0; i < 3; i++)
            slab_reach(tree->now, item->slab, (name_point){now_face_of(tree->now, item->cert)->vertex[i], NAME_VERTEX});
        return;
    }
    reach_spot(item->slab, item->spot[1]);
    if (p.b == NAME_SEGMENT) {
        reach_crossings(tree, item->slab, q.a, p.a);
        return;
    }
    reach_spot(item->slab, item->spot[0]);
    if (item->event == FROE_EVENT_VERTICES) return;
    uint32_t met = now_met_segment(tree->now, p, q);
    if (met != FROE_NONE) reach_crossings(tree, item->slab, name_is_vertex(p) ? p.a : q.a, met);
    if (name_is_crossing(p) && name_is_crossing(q) && name_third_crossing(p, q, &third))
        slab_reach(tree->now, item->slab, third);
}

/* ------------------------------------------------------------------- order -- */

/* The segment that an item's certificate belongs to. */
static uint32_t owner_of(const froe_kinetic *k, const slab_item *item) {
    if (item->kind == CERT_TURN || item->kind == CERT_FLOP) return item->cert;
    const uint32_t owner = k->certs.all.data[item->cert].owner;
    return item->kind <= CERT_RIGHT ? ktree_node_at(&k->tree, owner)->segment : owner;
}

static int order_of(uint32_t a, uint32_t b) {
    return (a > b) - (a < b);
}

/* Crossings after others: vertices and segments have numbers of their own. */
static int order_of_names(name_point p, name_point q) {
    const int first = p.b < 0 ? p.b : 0, second = q.b < 0 ? q.b : 0;
    if (first != second) return first < second ? -1 : 1;
    return p.a == q.a ? (p.b > q.b) - (p.b < q.b) : order_of(p.a, q.a);
}

/* By place, and at one place by what the items are about: the order of the queue is a function of what happened
 * before. */
static int from_left(void *user, uint32_t a, uint32_t b) {
    const froe_kinetic *k = user;
    const slab_item *x = k->events.items.data + a, *y = k->events.items.data + b;
    if (x->slab[0] != y->slab[0]) return x->slab[0] < y->slab[0] ? -1 : 1;
    if (x->slab[1] != y->slab[1]) return x->slab[1] < y->slab[1] ? -1 : 1;
    const int order[] = {order_of(y->kind, x->kind), order_of_names(x->claim.p, y->claim.p),
                         order_of_names(x->claim.q, y->claim.q), order_of(owner_of(k, x), owner_of(k, y))};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++)
        if (order[i]) return order[i];
    return 0;
}

void slab_sort(froe_kinetic *k) {
    kinetic_call *call = &k->call;
    event_state *events = &k->events;
    size_t n = events->items.count;
    events->order.count = 0;
    if (n < 2 || !call_reserve(call, &events->order, 2 * n) || !call_reserve(call, &events->items, n)) return;
    uint32_t *order = events->order.data;
    slab_item *items = events->items.data;
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
    base_merge_sort(order, order + n, n, from_left, k);
    for (size_t i = 0; i < n; i++) items[n + i] = items[order[i]];
    for (size_t i = 0; i < n; i++) items[i] = items[n + i];
}
