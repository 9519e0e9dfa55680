/* events.c: from one instant at which something happens to the next.
 *
 * All certificates that fail at a tick are taken together: those whose slabs overlap form a group, and a group is
 * one surgery, or several in cells that have nothing to do with one another. Where a group looks like one of the
 * paper's events, the cells are small; anything else, and whatever involves points that coincide, gets a cell whose
 * borders certainly have no part in it. Whether that was enough, the certificates tell afterwards: what still fails is
 * due at once, and is met with a larger cell each time, at last with the whole tree. */
#include "base/sort.h"
#include "kinetic/live.h"
#include <math.h>

enum { CAREFUL_ROUND = 4, RESTART_ROUND = 16, LAST_ROUND = 20 };

int64_t live_last_tick(const froe_kinetic *k) {
    return (k->now.motion->last_tick - 1) | 1;
}

/* ------------------------------------------------------------------- slabs -- */

static bool has_end(const froe_kinetic *k, uint32_t segment, uint32_t vertex) {
    const uint32_t *end = k->now.segments.data[segment].end;
    return end[0] == vertex || end[1] == vertex;
}

/* Widens a slab by a point. */
static void reach(froe_kinetic *k, live_item *item, now_name p) {
    now_spot spot = now_spot_of(&k->now, p);
    double error = 2 * spot.error + fabs(spot.x) * 0x1p-51 + 0x1p-1060;
    if (!(error < (double)INFINITY)) {
        k->now.lost = true;
        return;
    }
    if (spot.x - error < item->low) item->low = spot.x - error;
    if (spot.x + error > item->high) item->high = spot.x + error;
}

/* Where the segments at a vertex cross another one. */
static void reach_crossings(froe_kinetic *k, live_item *item, uint32_t vertex, uint32_t other) {
    for (uint32_t e = k->vertices.data[vertex]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (segment_at(k, e / 2)->here && e / 2 != other) reach(k, item, name_crossing(e / 2, other));
}

/* Of two crossings on one segment, where the other two cross. */
static bool third_crossing(now_name p, now_name q, now_name *out) {
    const uint32_t a[2] = {p.a, (uint32_t)p.b}, b[2] = {q.a, (uint32_t)q.b};
    for (int i = 0; i < 4; i++)
        if (a[i / 2] == b[i % 2]) {
            *out = name_crossing(a[1 - i / 2], b[1 - i % 2]);
            return true;
        }
    return false;
}

/* A vertex, and a crossing of a segment that ends at it with another: which one? */
static uint32_t met_segment(const froe_kinetic *k, now_name p, now_name q) {
    now_name vertex = name_is_vertex(p) ? p : q, crossing = name_is_vertex(p) ? q : p;
    if (!name_is_vertex(vertex) || !name_is_crossing(crossing)) return FROE_NONE;
    if (has_end(k, crossing.a, vertex.a)) return (uint32_t)crossing.b;
    return has_end(k, (uint32_t)crossing.b, vertex.a) ? crossing.a : FROE_NONE;
}

static void find_slab(froe_kinetic *k, live_item *item) {
    now_name p = item->claim.p, q = item->claim.q, third;
    item->low = (double)INFINITY, item->high = -(double)INFINITY;
    reach(k, item, q);
    if (p.b == NAME_SEGMENT) {
        reach_crossings(k, item, q.a, p.a);
        return;
    }
    reach(k, item, p);
    uint32_t met = met_segment(k, p, q);
    if (met != FROE_NONE) reach_crossings(k, item, name_is_vertex(p) ? p.a : q.a, met);
    if (name_is_crossing(p) && name_is_crossing(q) && third_crossing(p, q, &third)) {
        bool lost = k->now.lost;
        reach(k, item, third);
        k->now.lost = lost; /* parallel lines cross nowhere: nothing to reach */
    }
}

/* ------------------------------------------------------------------- cells -- */

static uint32_t ancestor_with(const froe_kinetic *k, uint32_t node, uint32_t segment) {
    uint32_t n = node;
    while (n != ROOT && node_at(k, n)->segment != segment) n = node_at(k, n)->parent;
    return n == ROOT ? node : n;
}

/* The node whose certificate this is; or further up, at the segment that an end passes. */
static uint32_t node_of(const froe_kinetic *k, const live_item *item) {
    const live_cert *c = k->certs.data + item->cert;
    uint32_t node, met;
    if (item->kind <= CERT_RIGHT) {
        node = c->owner;
        met = met_segment(k, item->claim.p, item->claim.q);
    } else {
        node = segment_at(k, c->owner / 2)->end[c->owner % 2].node;
        met = item->claim.p.a;
    }
    bool above = met != FROE_NONE && comes_before(k, met, node_at(k, node)->segment);
    return above ? ancestor_with(k, node, met) : node;
}

static bool is_inside(froe_kinetic *k, const live_cell *cell) {
    const now_name line[2] = {{0, NAME_LINE}, {1, NAME_LINE}};
    return (!name_exists(cell->wall[LEFT]) || now_compare(&k->now, cell->wall[LEFT], line[0]) < 0) &&
           (!name_exists(cell->wall[RIGHT]) || now_compare(&k->now, cell->wall[RIGHT], line[1]) > 0);
}

/* Is a segment on the list of those that have a part in this? */
static bool is_involved(const froe_kinetic *k, uint32_t segment) {
    return segment != FROE_NONE && segment_at(k, segment)->stamp == k->list_stamp;
}

/* The nearest cell, from that of a node up, whose walls are outside the slab; and none of whose borders is
 * involved, if care is needed. */
static uint32_t climb(froe_kinetic *k, uint32_t node, bool careful) {
    for (;; node = node_at(k, node)->parent) {
        if (node_at(k, node)->parent == ROOT) return node;
        live_cell cell = live_cell_of(k, node);
        if (is_inside(k, &cell) && (!careful || (!is_involved(k, cell.top) && !is_involved(k, cell.bottom))))
            return node;
    }
}

static void involve(froe_kinetic *k, now_name p) {
    if (p.b == NAME_SEGMENT || name_is_crossing(p)) live_list(k, p.a);
    if (name_is_crossing(p)) live_list(k, (uint32_t)p.b);
    if (!name_is_vertex(p)) return;
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (segment_at(k, e / 2)->here) live_list(k, e / 2);
}

/* ------------------------------------------------------------------ groups -- */

typedef struct group {
    const live_item *items;
    size_t count;
    double low, high;
} group;

static bool is_current(const froe_kinetic *k, const live_item *item) {
    if (item->kind == CERT_TURN) return segment_at(k, item->cert)->here;
    const live_cert *c = k->certs.data + item->cert;
    return c->kind == item->kind && claim_is(&c->claim, &item->claim) && c->tick <= k->now.tick;
}

static void add_root(froe_kinetic *k, uint32_t node) {
    if (!node) return;
    for (size_t i = 0; i < k->roots.count; i++)
        if (k->roots.data[i] == node) return;
    if (!array_push(&k->alloc, &k->roots, node)) k->short_of_memory = true;
}

static void find_roots(froe_kinetic *k, const group *g, bool careful) {
    k->roots.count = 0;
    for (size_t i = 0; i < g->count; i++) {
        const live_item *item = g->items + i;
        if (!is_current(k, item)) continue;
        if (item->kind == CERT_TURN) {
            for (uint32_t n = segment_at(k, item->cert)->nodes; n; n = node_at(k, n)->next)
                add_root(k, climb(k, n, careful));
        } else {
            add_root(k, climb(k, node_of(k, item), careful));
        }
    }
}

static uint32_t depth_of(const froe_kinetic *k, uint32_t node) {
    uint32_t depth = 0;
    for (; node != ROOT; node = node_at(k, node)->parent) depth++;
    return depth;
}

/* May be ROOT. */
static uint32_t common_ancestor(const froe_kinetic *k, uint32_t a, uint32_t b) {
    uint32_t da = depth_of(k, a), db = depth_of(k, b);
    for (; da > db; da--) a = node_at(k, a)->parent;
    for (; db > da; db--) b = node_at(k, b)->parent;
    while (a != b) a = node_at(k, a)->parent, b = node_at(k, b)->parent;
    return a;
}

/* Leaves only those roots that are below no other; all in one if care is needed. */
static void reduce_roots(froe_kinetic *k, bool careful) {
    uint32_t *r = k->roots.data;
    size_t kept = 0;
    for (size_t i = 0; i < k->roots.count; i++) {
        bool below = false;
        for (size_t j = 0; j < k->roots.count && !below; j++) below = i != j && common_ancestor(k, r[i], r[j]) == r[j];
        if (!below) r[kept++] = r[i];
    }
    k->roots.count = kept;
    while (careful && k->roots.count > 1) {
        r[0] = common_ancestor(k, r[0], r[k->roots.count - 1]);
        k->roots.count--;
    }
}

/* Puts on the list who has a part in this: in the certificates, and in coincidences nearby. */
static void list_involved(froe_kinetic *k, const group *g) {
    live_new_list(k);
    for (size_t i = 0; i < g->count; i++) {
        if (g->items[i].kind == CERT_TURN) live_list(k, g->items[i].cert);
        involve(k, g->items[i].claim.p);
        involve(k, g->items[i].claim.q);
    }
    for (size_t i = 0; i < k->now.ties && i < NOW_TIES; i++) involve(k, k->now.tied[i]);
}

/* Surgery on slabs. Leaves the places of the cells it was done in as roots: 4 parent + slot. */
static void operate(froe_kinetic *k, const group *g, bool careful) {
    k->now.line[0] = g->low, k->now.line[1] = g->high;
    list_involved(k, g);
    find_roots(k, g, careful);
    reduce_roots(k, careful);
    for (size_t i = 0; i < k->roots.count && !k->now.lost && !k->broken && !k->short_of_memory; i++) {
        const live_node *n = node_at(k, k->roots.data[i]);
        uint32_t place = 4 * n->parent + n->slot;
        live_slab(k, k->roots.data[i]);
        k->roots.data[i] = place;
    }
}

/* Certificates that are due but not in the group: what is made from scratch must not have them at its borders. */
static void find_pending(froe_kinetic *k) {
    k->pending.count = 0;
    for (size_t i = 0; i < k->items.count; i++) {
        if (k->items.data[i].kind != CERT_TURN) continue;
        live_list(k, k->items.data[i].cert);
        if (!array_push(&k->alloc, &k->pending, k->items.data[i])) k->short_of_memory = true;
    }
    live_due(k, k->now.tick);
    for (size_t i = 0; i < k->order.count; i++) {
        const live_cert *c = k->certs.data + k->order.data[i];
        live_item item = {k->order.data[i], c->kind, c->claim, 0, 0};
        if (c->kind >= CERT_TURN) continue;
        find_slab(k, &item);
        involve(k, item.claim.p);
        involve(k, item.claim.q);
        if (!array_push(&k->alloc, &k->pending, item)) k->short_of_memory = true;
    }
}

static bool is_pending_at(froe_kinetic *k, now_name wall) {
    if (!name_exists(wall)) return false;
    now_spot spot = now_spot_of(&k->now, wall);
    for (size_t i = 0; i < k->pending.count; i++) {
        const live_item *p = k->pending.data + i;
        if (spot.x + spot.error >= p->low && spot.x - spot.error <= p->high) return true;
    }
    return false;
}

static uint32_t climb_clear(froe_kinetic *k, uint32_t node) {
    for (;; node = node_at(k, node)->parent) {
        node = climb(k, node, true);
        live_cell cell = live_cell_of(k, node);
        if (node_at(k, node)->parent == ROOT ||
            (!is_pending_at(k, cell.wall[LEFT]) && !is_pending_at(k, cell.wall[RIGHT])))
            return node;
    }
}

/* Where points coincide, more may have happened than certificates tell: a cell with all of it is made from scratch. */
static void start_over(froe_kinetic *k, const group *g) {
    if (!k->roots.count) return;
    uint32_t node = LEAF;
    for (size_t i = 0; i < k->roots.count; i++) {
        uint32_t parent = k->roots.data[i] / 4, at = node_at(k, parent)->child[k->roots.data[i] % 4];
        if (!at) at = parent;
        node = node ? common_ancestor(k, node, at) : at;
    }
    list_involved(k, g);
    find_pending(k);
    if (k->short_of_memory) return;
    if (node == ROOT || k->now.ties > NOW_TIES || k->now.lost)
        live_restart(k);
    else
        live_rebuild(k, climb_clear(k, node));
}

/* ------------------------------------------------------------------ events -- */

static bool is_one_segment(const froe_kinetic *k, now_name p, now_name q) {
    if (!name_is_vertex(p) || !name_is_vertex(q)) return false;
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (has_end(k, e / 2, q.a)) return true;
    return false;
}

static froe_event_kind kind_of(const froe_kinetic *k, const live_item *item) {
    now_name p = item->claim.p, q = item->claim.q, third;
    if (item->kind == CERT_TURN) return FROE_EVENT_TURN;
    if (item->kind > CERT_RIGHT || met_segment(k, p, q) != FROE_NONE) return FROE_EVENT_CONTACT;
    if (is_one_segment(k, p, q)) return FROE_EVENT_TURN;
    if (name_is_vertex(p) && name_is_vertex(q)) return FROE_EVENT_VERTICES;
    if (name_is_vertex(p) || name_is_vertex(q)) return FROE_EVENT_VERTEX_CROSSING;
    return third_crossing(p, q, &third) ? FROE_EVENT_TRIPLE : FROE_EVENT_CROSSINGS;
}

static void add_object(froe_event *e, uint32_t object) {
    for (unsigned i = 0; i < e->object_count && i < 4; i++)
        if (e->objects[i] == object) return;
    if (e->object_count < 4) e->objects[e->object_count] = object;
    e->object_count++;
}

static void add_objects(const froe_kinetic *k, froe_event *e, const live_item *item) {
    if (item->kind == CERT_TURN) {
        add_object(e, item->cert);
        return;
    }
    const now_name name[2] = {item->claim.p, item->claim.q};
    for (int i = 0; i < 2; i++) {
        if (name_is_vertex(name[i])) {
            uint32_t first = k->vertices.data[name[i].a];
            if (first != FROE_NONE) add_object(e, first / 2);
        } else {
            add_object(e, name[i].a);
            if (name_is_crossing(name[i])) add_object(e, (uint32_t)name[i].b);
        }
    }
}

static double time_of(const froe_kinetic *k, int64_t tick) {
    return k->now.motion->begin + ldexp((double)tick, k->now.motion->power);
}

static froe_event event_at(const froe_kinetic *k, froe_event_kind kind) {
    return (froe_event){
        .kind = kind, .tick = k->now.tick, .early = time_of(k, k->now.tick - 2), .late = time_of(k, k->now.tick)};
}

static bool tell(froe_kinetic *k, const live_watcher *watcher, const froe_event *event) {
    k->counts.events[event->kind]++;
    return !watcher->visit || watcher->visit(watcher->user, event);
}

/* What the certificates of a group have in common. */
static froe_event describe(const froe_kinetic *k, const group *g) {
    froe_event e = event_at(k, kind_of(k, g->items));
    for (size_t i = 0; i < g->count; i++) {
        if (kind_of(k, g->items + i) != e.kind) e.kind = FROE_EVENT_BATCH;
        add_objects(k, &e, g->items + i);
    }
    if ((e.kind == FROE_EVENT_TRIPLE && e.object_count > 3) || (e.kind == FROE_EVENT_TURN && e.object_count > 1) ||
        e.object_count > 4)
        e.kind = FROE_EVENT_BATCH;
    return e;
}

/* ------------------------------------------------------------------ rounds -- */

static bool add_item(froe_kinetic *k, uint32_t cert) {
    const live_cert *c = k->certs.data + cert;
    live_item item = {cert, c->kind, c->claim, 0, 0};
    if (c->kind >= CERT_TURN) return true;
    if (now_holds(&k->now, &c->claim) >= 0) { /* between the last tick and this one it failed, and held again */
        live_set_tick(k, cert, now_first_failure(&k->now, &item.claim));
        return true;
    }
    k->now.lost = false;
    find_slab(k, &item);
    return array_push(&k->alloc, &k->items, item);
}

static int by_low(void *user, uint32_t a, uint32_t b) {
    const live_item *items = ((const froe_kinetic *)user)->items.data;
    const live_item *x = items + a, *y = items + b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return (x->high > y->high) - (x->high < y->high);
}

/* Sorts the items by place; ties keep the order of the queue, which is a function of what happened before. */
static void sort_items(froe_kinetic *k) {
    size_t n = k->items.count;
    k->order.count = 0;
    if (n < 2) return;
    if (!array_reserve(&k->alloc, &k->order, 2 * n) || !array_reserve(&k->alloc, &k->items, n)) {
        k->short_of_memory = true;
        return;
    }
    for (size_t i = 0; i < n; i++) k->order.data[i] = (uint32_t)i;
    base_merge_sort(k->order.data, k->order.data + n, n, by_low, k);
    for (size_t i = 0; i < n; i++) k->items.data[n + i] = k->items.data[k->order.data[i]];
    for (size_t i = 0; i < n; i++) k->items.data[i] = k->items.data[n + i];
}

static void gather(froe_kinetic *k) {
    k->items.count = 0;
    for (size_t i = 0; i < k->turning.count; i++) {
        const uint32_t s = k->turning.data[i], *end = k->now.segments.data[s].end;
        live_item item = {s, CERT_TURN, {{end[0], NAME_VERTEX}, {end[1], NAME_VERTEX}, 0}, 0, 0};
        find_slab(k, &item);
        if (!array_push(&k->alloc, &k->items, item)) k->short_of_memory = true;
    }
    k->turning.count = 0;
    live_due(k, k->now.tick);
    size_t count = k->order.count;
    for (size_t i = 0; i < count && !k->short_of_memory; i++) /* add_item moves certificates in the queue, not here */
        if (!add_item(k, k->order.data[i])) k->short_of_memory = true;
    sort_items(k);
}

/* The items from i on whose slabs hang together. */
static group group_from(const froe_kinetic *k, size_t i) {
    const live_item *items = k->items.data;
    group g = {items + i, 1, items[i].low, items[i].high};
    for (size_t j = i + 1; j < k->items.count && items[j].low <= g.high; j++, g.count++) {
        if (items[j].high > g.high) g.high = items[j].high;
    }
    return g;
}

static bool handle_group(froe_kinetic *k, const group *g, unsigned round, const live_watcher *watcher) {
    froe_event event = describe(k, g);
    bool careful = round >= CAREFUL_ROUND || event.kind == FROE_EVENT_BATCH;
    k->now.ties = 0;
    k->now.lost = !(g->high - g->low < (double)INFINITY);
    operate(k, g, careful);
    if (k->short_of_memory) return true;
    if (k->now.lost || k->broken)
        live_restart(k);
    else if (k->now.ties || round >= CAREFUL_ROUND)
        start_over(k, g);
    k->counts.batches += event.kind == FROE_EVENT_BATCH;
    return round > 0 || tell(k, watcher, &event);
}

/* Until nothing is due any more. */
static bool settle(froe_kinetic *k, const live_watcher *watcher) {
    bool go_on = true;
    for (unsigned round = 0; !k->short_of_memory; round++) {
        gather(k);
        if (!k->items.count || k->short_of_memory) break;
        if (round >= RESTART_ROUND) {
            live_restart(k);
            k->counts.stuck += round >= LAST_ROUND;
            if (round >= LAST_ROUND) break;
            continue;
        }
        group g;
        for (size_t i = 0; i < k->items.count && !k->short_of_memory; i += g.count) {
            g = group_from(k, i);
            go_on &= handle_group(k, &g, round, watcher);
        }
    }
    return go_on;
}

/* ------------------------------------------------------------------- steps -- */

static void leave(froe_kinetic *k, uint32_t segment, uint32_t tell_it) {
    for (size_t i = 0; i < k->leaving.count; i++)
        if (k->leaving.data[i] / 2 == segment) {
            k->leaving.data[i] |= tell_it;
            return;
        }
    if (!array_push(&k->alloc, &k->leaving, 2 * segment + tell_it)) k->short_of_memory = true;
}

/* Which segments have to be taken out before time goes on to the tick. */
static void gather_leaving(froe_kinetic *k, int64_t tick) {
    k->leaving.count = 0;
    live_due(k, tick);
    for (size_t i = 0; i < k->order.count; i++) {
        const live_cert *c = k->certs.data + k->order.data[i];
        if (c->kind == CERT_LIFE) {
            leave(k, c->owner, 1);
        } else if (c->kind == CERT_PAIR) {
            leave(k, k->pairs.data[c->owner].segment[1], 0);
        } else if (c->kind == CERT_COURSE) {
            for (uint32_t e = k->vertices.data[c->owner]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
                leave(k, e / 2, 1);
        }
    }
    for (size_t i = 0; i < k->order.count; i++) {
        uint32_t cert = k->order.data[i];
        if (k->certs.data[cert].kind == CERT_COURSE) live_set_tick(k, cert, NOW_NEVER);
    }
}

/* Ends that change sides: before anything else is asked at this tick, as sides depend on it. */
static void turn_segments(froe_kinetic *k) {
    k->turning.count = 0;
    live_due(k, k->now.tick);
    for (size_t i = 0; i < k->order.count; i++) {
        const live_cert *c = k->certs.data + k->order.data[i];
        if (c->kind == CERT_TURN && !array_push(&k->alloc, &k->turning, c->owner)) k->short_of_memory = true;
    }
    size_t kept = 0;
    for (size_t i = 0; i < k->turning.count && !k->short_of_memory; i++) {
        uint32_t s = k->turning.data[i];
        bool was = k->now.segments.data[s].turned;
        live_certify_turn(k, s);
        if (was != k->now.segments.data[s].turned) k->turning.data[kept++] = s;
    }
    k->turning.count = kept;
}

static bool enter(froe_kinetic *k, const live_watcher *watcher) {
    bool go_on = true;
    for (size_t i = 0; i < k->leaving.count && !k->short_of_memory; i++) {
        uint32_t s = k->leaving.data[i] / 2;
        const motion_object *o = k->now.motion->objects.data + s;
        live_schedule(k, s);
        bool there = o->first <= k->now.tick && k->now.tick <= o->last;
        froe_event_kind kind = !there                          ? FROE_EVENT_DISAPPEAR
                               : k->now.tick <= (o->first | 1) ? FROE_EVENT_APPEAR
                                                               : FROE_EVENT_PLAN;
        if (there) live_insert(k, s);
        froe_event event = event_at(k, kind);
        add_object(&event, s);
        if (k->leaving.data[i] % 2) go_on &= tell(k, watcher, &event);
    }
    k->leaving.count = 0;
    return go_on;
}

bool live_step(froe_kinetic *k, int64_t tick, const live_watcher *watcher) {
    int64_t next = live_next_tick(k);
    if (next > tick) {
        k->now.tick = tick;
        return true;
    }
    gather_leaving(k, next);
    for (size_t i = 0; i < k->leaving.count && !k->short_of_memory; i++) live_remove(k, k->leaving.data[i] / 2);
    k->now.tick = next;
    turn_segments(k);
    bool go_on = settle(k, watcher);
    go_on &= enter(k, watcher);
    return settle(k, watcher) && go_on;
}
