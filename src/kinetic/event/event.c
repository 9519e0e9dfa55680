/* event.c: from one instant at which something happens to the next.
 *
 * All certificates that fail at a tick are taken together: those whose slabs overlap form a group. A group is repaired
 * by one surgery, or by several in unrelated cells. Where a group looks like one of the paper's events, the cells are
 * small. Any other group, and any group with points that coincide, gets a cell none of whose borders is involved. The
 * certificates show afterwards whether that was enough: those that still fail are due at once, and are repaired in a
 * larger cell each time, at last in the whole tree. */
#include "base/floats.h"
#include "base/sort.h"
#include "kinetic/live.h"
#include <math.h>

enum { CAREFUL_ROUND = 4, RESTART_ROUND = 16, LAST_ROUND = 20 };

int64_t live_last_tick(const froe_kinetic *k) {
    return (k->now.motion->last_tick - 1) | 1;
}

/* ------------------------------------------------------------------- cells -- */

static uint32_t ancestor_with(const froe_kinetic *k, uint32_t node, uint32_t segment) {
    uint32_t n = node;
    while (n != ROOT && node_at(k, n)->segment != segment) n = node_at(k, n)->parent;
    return n == ROOT ? node : n;
}

/* The node of the certificate, or the ancestor with the segment that a point of it meets, if that cuts earlier. */
static uint32_t node_of(const froe_kinetic *k, const live_item *item) {
    const live_cert *c = k->certs.data + item->cert;
    uint32_t node, met;
    if (item->kind <= CERT_RIGHT) {
        node = c->owner;
        met = live_met_segment(k, item->claim.p, item->claim.q);
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

/* The lowest ancestor, from a node up, whose cell has its walls outside the slab; with `careful` also one none of whose
 * borders is a participant. */
static uint32_t climb_clear_of_slab(froe_kinetic *k, uint32_t node, bool careful) {
    for (;; node = node_at(k, node)->parent) {
        if (node_at(k, node)->parent == ROOT) return node;
        live_cell cell = live_cell_of(k, node);
        if (is_inside(k, &cell) && (!careful || (!live_in_crew(k, cell.top) && !live_in_crew(k, cell.bottom))))
            return node;
    }
}

/* ------------------------------------------------------------------ groups -- */

/* Items whose slabs overlap, directly or through others. */
typedef struct group {
    size_t first, count; /* of the items */
    double slab[2];
} group;

static const live_item *item_of(const froe_kinetic *k, const group *g, size_t i) {
    return k->items.data + g->first + i;
}

static bool is_current(const froe_kinetic *k, const live_item *item) {
    if (item->kind == CERT_TURN) return segment_at(k, item->cert)->here;
    const live_cert *c = k->certs.data + item->cert;
    if (c->kind != item->kind || c->tick > k->now.tick) return false;
    const now_claim claim = live_claim_of(k, item->cert);
    return claim_is(&claim, &item->claim);
}

/* Stores the place of the node, 4 parent + slot, which stays valid when the node is replaced. */
static void add_root(froe_kinetic *k, uint32_t node) {
    if (!node) return;
    uint32_t place = 4 * node_at(k, node)->parent + live_slot_of(k, node);
    for (size_t i = 0; i < k->roots.count; i++)
        if (k->roots.data[i] == place) return;
    if (!array_push(&k->alloc, &k->roots, place)) k->short_of_memory = true;
}

static uint32_t root_at(const froe_kinetic *k, size_t i) {
    return node_at(k, k->roots.data[i] / 4)->child[k->roots.data[i] % 4];
}

/* Where surgery is needed for an item. */
static void add_roots(froe_kinetic *k, const live_item *item) {
    if (!is_current(k, item)) return;
    if (item->kind != CERT_TURN) {
        add_root(k, climb_clear_of_slab(k, node_of(k, item), false));
        return;
    }
    for (uint32_t n = segment_at(k, item->cert)->nodes; n; n = node_at(k, n)->next)
        add_root(k, climb_clear_of_slab(k, n, false));
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

/* Keeps only those roots that are below no other. */
static void reduce_roots(froe_kinetic *k) {
    size_t kept = 0;
    for (size_t i = 0; i < k->roots.count; i++) {
        bool below = false;
        for (size_t j = 0; j < k->roots.count && !below; j++)
            below = i != j && common_ancestor(k, root_at(k, i), root_at(k, j)) == root_at(k, j);
        if (!below) k->roots.data[kept++] = k->roots.data[i];
    }
    k->roots.count = kept;
}

/* The smallest subtree with all roots. */
static uint32_t common_root(const froe_kinetic *k) {
    uint32_t node = LEAF;
    for (size_t i = 0; i < k->roots.count; i++) {
        uint32_t at = root_at(k, i) ? root_at(k, i) : k->roots.data[i] / 4;
        node = node ? common_ancestor(k, node, at) : at;
    }
    return node;
}

/* Collects the participants and places of a group. False: unrelated points may be in one place. */
static bool call_crew(froe_kinetic *k, const group *g) {
    bool usual = true;
    live_new_crew(k);
    for (size_t i = 0; i < g->count; i++) usual &= live_join_item(k, item_of(k, g, i));
    return usual;
}

static bool is_sound(const froe_kinetic *k) {
    return !k->now.lost && !k->broken && !k->short_of_memory;
}

/* Surgery next to a wall that is passed, if that is all that happens. */
static live_outcome pass_wall(froe_kinetic *k, const group *g) {
    live_outcome outcome = LIVE_DONE;
    k->now.line[0] = g->slab[0], k->now.line[1] = g->slab[1];
    for (size_t i = 0; i < g->count && !outcome && is_sound(k); i++) {
        const live_item *item = item_of(k, g, i);
        if (is_current(k, item)) outcome = live_belong_together(k, item) ? LIVE_NOT_NARROW : live_pass(k, item);
    }
    return outcome;
}

/* Surgery in small cells, if the event is a simple one. False: it is not, or participants were added. */
static bool operate(froe_kinetic *k, const group *g, bool simple) {
    k->roots.count = 0;
    k->now.line[0] = g->slab[0], k->now.line[1] = g->slab[1];
    for (size_t i = 0; i < g->count; i++) add_roots(k, item_of(k, g, i));
    reduce_roots(k);
    if (!simple) return false;
    for (size_t i = 0; i < k->roots.count && is_sound(k); i++) {
        uint32_t node = root_at(k, i);
        if (node && !live_slab(k, node)) return false;
    }
    return true;
}

/* Widens the group's slab by the near ends and crossings of its participants, and adds the items that it then meets. */
static void widen(froe_kinetic *k, group *g) {
    size_t count;
    do {
        count = k->crew.count;
        live_reach_crew(k, g->slab);
        for (; g->first + g->count < k->items.count; g->count++) {
            const live_item *next = item_of(k, g, g->count);
            if (next->slab[0] > g->slab[1]) break;
            if (next->slab[1] > g->slab[1]) g->slab[1] = next->slab[1];
            live_join_item(k, next);
            add_roots(k, next);
        }
    } while (k->crew.count > count);
}

/* Surgery in one cell, none of whose borders is a participant. */
static void operate_carefully(froe_kinetic *k, group *g) {
    do {
        widen(k, g);
        uint32_t node = common_root(k);
        if (node == ROOT) k->broken = true; /* a new tree */
        if (!node || !is_sound(k)) return;
        k->now.line[0] = g->slab[0], k->now.line[1] = g->slab[1];
        node = climb_clear_of_slab(k, node, true);
        if (live_slab(k, node)) return;
    } while (is_sound(k));
}

/* ------------------------------------------------------------------ events -- */

static froe_event_kind kind_of(const froe_kinetic *k, const live_item *item) {
    now_name p = item->claim.p, q = item->claim.q, third;
    if (item->kind == CERT_TURN) return FROE_EVENT_TURN;
    if (item->kind > CERT_RIGHT || live_met_segment(k, p, q) != FROE_NONE) return FROE_EVENT_CONTACT;
    if (live_is_one_segment(k, p, q)) return FROE_EVENT_TURN;
    if (name_is_vertex(p) && name_is_vertex(q)) return FROE_EVENT_VERTICES;
    if (name_is_vertex(p) || name_is_vertex(q)) return FROE_EVENT_VERTEX_CROSSING;
    return live_third_crossing(p, q, &third) ? FROE_EVENT_TRIPLE : FROE_EVENT_CROSSINGS;
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

static double time_of_tick(const froe_kinetic *k, int64_t tick) {
    return k->now.motion->begin + ldexp((double)tick, k->now.motion->power);
}

static froe_event event_at(const froe_kinetic *k, froe_event_kind kind) {
    return (froe_event){.kind = kind,
                        .tick = k->now.tick,
                        .early = time_of_tick(k, k->now.tick - 2),
                        .late = time_of_tick(k, k->now.tick)};
}

static bool tell_event(froe_kinetic *k, const live_watcher *watcher, const froe_event *event, const now_claim *claim) {
    k->counts.events[event->kind]++;
    if (!watcher->visit) return true;
    k->told = true;
    k->told_claim = *claim;
    bool go_on = base_callback(watcher->visit(watcher->user, event));
    k->told = false;
    now_catch_up(&k->now);
    return go_on;
}

/* What the certificates of a group have in common. */
static froe_event describe(const froe_kinetic *k, const group *g) {
    froe_event e = event_at(k, kind_of(k, item_of(k, g, 0)));
    for (size_t i = 0; i < g->count; i++) {
        if (kind_of(k, item_of(k, g, i)) != e.kind) e.kind = FROE_EVENT_BATCH;
        add_objects(k, &e, item_of(k, g, i));
    }
    if ((e.kind == FROE_EVENT_TRIPLE && e.object_count > 3) || (e.kind == FROE_EVENT_TURN && e.object_count > 1) ||
        e.object_count > 4)
        e.kind = FROE_EVENT_BATCH;
    return e;
}

/* ------------------------------------------------------------------ rounds -- */

static bool add_failed_cert(froe_kinetic *k, uint32_t cert) {
    if (k->certs.data[cert].kind >= CERT_TURN) return true;
    const now_claim claim = live_claim_of(k, cert);
    live_item item = {cert, k->certs.data[cert].kind, claim, {0, 0}};
    if (now_holds(&k->now, &claim) >= 0) { /* between the last tick and this one it failed and became true again */
        live_rearm(k, cert);
        return true;
    }
    live_find_slab(k, &item);
    return array_push(&k->alloc, &k->items, item);
}

static int by_low(void *user, uint32_t a, uint32_t b) {
    const live_item *items = ((const froe_kinetic *)user)->items.data;
    const live_item *x = items + a, *y = items + b;
    if (x->slab[0] != y->slab[0]) return x->slab[0] < y->slab[0] ? -1 : 1;
    return (x->slab[1] > y->slab[1]) - (x->slab[1] < y->slab[1]);
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

static void gather_failed_certs(froe_kinetic *k) {
    k->items.count = 0;
    for (size_t i = 0; i < k->turning.count; i++) {
        const uint32_t s = k->turning.data[i], *end = k->now.segments.data[s].end;
        live_item item = {s, CERT_TURN, {{end[0], NAME_VERTEX}, {end[1], NAME_VERTEX}, 0}, {0, 0}};
        live_find_slab(k, &item);
        if (!array_push(&k->alloc, &k->items, item)) k->short_of_memory = true;
    }
    k->turning.count = 0;
    live_due(k, k->now.tick);
    size_t count = k->order.count;
    for (size_t i = 0; i < count && !k->short_of_memory; i++) /* add_item moves certificates in the queue, not here */
        if (!add_failed_cert(k, k->order.data[i]) || !live_goes_on(k)) k->short_of_memory = true;
    sort_items(k);
}

/* The group that begins with item i. */
static group group_from(const froe_kinetic *k, size_t i) {
    const live_item *items = k->items.data;
    group g = {i, 1, {items[i].slab[0], items[i].slab[1]}};
    for (size_t j = i + 1; j < k->items.count && items[j].slab[0] <= g.slab[1]; j++, g.count++)
        if (items[j].slab[1] > g.slab[1]) g.slab[1] = items[j].slab[1];
    return g;
}

/* Does a group look like one event, in one place or on one vertical line? */
static bool is_one_event(const froe_kinetic *k, const group *g, const froe_event *event) {
    switch (event->kind) {
    case FROE_EVENT_CONTACT:
        return g->count == 1 || event->object_count == 2;
    case FROE_EVENT_TRIPLE:
        return event->object_count == 3;
    case FROE_EVENT_TURN:
        return event->object_count == 1 && !segment_at(k, event->objects[0])->bound;
    case FROE_EVENT_BATCH:
        return false;
    default:
        for (size_t i = 1; i < g->count; i++)
            if (!claim_is(&item_of(k, g, i)->claim, &item_of(k, g, 0)->claim)) return false;
        return true;
    }
}

/* Is it a turn and nothing else, that leaves the tree as it is? */
static bool is_free_turn(const froe_kinetic *k, const group *g) {
    const live_item *item = item_of(k, g, 0);
    return g->count == 1 && item->kind == CERT_TURN && live_turns_freely(k, item->cert);
}

/* Repairs the tree where the certificates of a group fail. */
static void repair(froe_kinetic *k, group *g, unsigned round) {
    const froe_event event = describe(k, g);
    bool simple = call_crew(k, g) && round < CAREFUL_ROUND && is_one_event(k, g, &event) &&
                  !live_has_loose_ends(k, item_of(k, g, 0));
    k->now.lost = !(g->slab[0] <= g->slab[1] && g->slab[1] - g->slab[0] < (double)INFINITY);
    live_outcome outcome = simple ? pass_wall(k, g) : LIVE_NOT_NARROW;
    if (outcome && !operate(k, g, simple && outcome == LIVE_NOT_NARROW)) {
        k->counts.crowds++;
        operate_carefully(k, g);
    }
    if (!k->short_of_memory && !is_sound(k)) live_restart(k);
}

static bool handle_group(froe_kinetic *k, group *g, unsigned round, const live_watcher *watcher) {
    if (is_free_turn(k, g))
        k->counts.free_turns++;
    else
        repair(k, g, round);
    if (k->short_of_memory) return true;
    const froe_event event = describe(k, g);
    k->counts.batches += event.kind == FROE_EVENT_BATCH;
    return round > 0 || tell_event(k, watcher, &event, &item_of(k, g, 0)->claim);
}

/* Until nothing is due any more. */
static bool settle_tick(froe_kinetic *k, const live_watcher *watcher) {
    bool go_on = true;
    for (unsigned round = 0; !k->short_of_memory; round++) {
        gather_failed_certs(k);
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

static void leave_tree(froe_kinetic *k, uint32_t segment, uint32_t tell_it) {
    for (size_t i = 0; i < k->leaving.count; i++)
        if (k->leaving.data[i] / 2 == segment) {
            k->leaving.data[i] |= tell_it;
            return;
        }
    if (!array_push(&k->alloc, &k->leaving, 2 * segment + tell_it)) k->short_of_memory = true;
}

/* Which segments have to be taken out before time goes on to the tick. */
static void gather_leaving(froe_kinetic *k, int64_t tick) {
    live_due(k, tick);
    for (size_t i = 0; i < k->order.count; i++) {
        const live_cert *c = k->certs.data + k->order.data[i];
        if (c->kind == CERT_LIFE) {
            leave_tree(k, c->owner, 1);
        } else if (c->kind == CERT_PAIR) {
            leave_tree(k, k->pairs.data[c->owner].segment[1], 0);
        } else if (c->kind == CERT_COURSE) {
            for (uint32_t e = k->vertices.data[c->owner]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
                leave_tree(k, e / 2, 1);
        }
    }
    for (size_t i = 0; i < k->order.count; i++) {
        uint32_t cert = k->order.data[i];
        if (k->certs.data[cert].kind == CERT_COURSE) live_set_tick(k, cert, NOW_NEVER);
    }
}

/* Takes them out. Others in one line with them may have to be taken out, too. */
static void let_leave(froe_kinetic *k, int64_t tick) {
    size_t gone = 0;
    k->leaving.count = 0;
    do {
        gather_leaving(k, tick);
        if (gone == k->leaving.count) return;
        for (; gone < k->leaving.count && !k->short_of_memory; gone++) live_remove(k, k->leaving.data[gone] / 2);
    } while (!k->short_of_memory);
}

/* Swaps the ends of segments that turn. This comes before any other question at the tick, as sides depend on it. */
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

static bool enter_tree(froe_kinetic *k, const live_watcher *watcher) {
    static const now_claim nothing = {{0, NAME_NONE}, {0, NAME_NONE}, 0};
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
        if (k->leaving.data[i] % 2) go_on &= tell_event(k, watcher, &event, &nothing);
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
    let_leave(k, next);
    k->now.tick = next;
    turn_segments(k);
    bool go_on = settle_tick(k, watcher);
    go_on &= enter_tree(k, watcher);
    return settle_tick(k, watcher) && go_on;
}
