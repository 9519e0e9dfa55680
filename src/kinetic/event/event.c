/* event.c: what happens at a tick, and how the partition is repaired. */
#include "kinetic/event/event.h"
#include "base/floats.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/event/change.h"
#include "kinetic/event/pass.h"
#include "kinetic/event/renew.h"
#include "kinetic/event/triangle.h"
#include "kinetic/kinetic.h"

enum { CAREFUL_ROUND = 4, RESTART_ROUND = 16, LAST_ROUND = 20 };
enum { FEW = 8 }; /* triangles leave and enter one by one, if they are no more than one in so many of all */

/* ------------------------------------------------------------------- cells -- */

/* The node of the certificate, or the ancestor with the segment that a point of it meets, if that cuts earlier. */
static uint32_t node_of(const froe_kinetic *k, const slab_item *item) {
    const ktree *tree = &k->tree;
    uint32_t node = k->certs.all.data[item->cert].owner, met = item->claim.p.a;
    if (item->kind <= CERT_RIGHT)
        met = now_met_segment(&k->now, item->claim.p, item->claim.q);
    else
        node = ktree_segment_at(tree, node / 2)->end[node % 2].node;
    if (met == FROE_NONE || !ktree_before(tree, met, ktree_node_at(tree, node)->segment)) return node;
    for (uint32_t n = node; n != KTREE_ROOT; n = ktree_node_at(tree, n)->parent)
        if (ktree_node_at(tree, n)->segment == met) return n;
    return node;
}

/* The lowest ancestor, from a node up, whose cell has its walls outside the slab; with `careful` also one none of whose
 * borders is a participant. */
static uint32_t climb_clear_of_slab(froe_kinetic *k, uint32_t node, bool careful) {
    const name_point line[2] = {{0, NAME_LINE}, {1, NAME_LINE}};
    for (;; node = ktree_node_at(&k->tree, node)->parent) {
        if (ktree_node_at(&k->tree, node)->parent == KTREE_ROOT) return node;
        const ktree_cell cell = ktree_cell_of(&k->tree, node);
        const name_point left = cell.wall[KTREE_LEFT], right = cell.wall[KTREE_RIGHT];
        if (name_exists(left) && now_compare(&k->now, left, line[0]) >= 0) continue;
        if (name_exists(right) && now_compare(&k->now, right, line[1]) <= 0) continue;
        if (!careful ||
            (!participants_have(&k->participants, cell.top) && !participants_have(&k->participants, cell.bottom)))
            return node;
    }
}

/* May be KTREE_ROOT. */
static uint32_t common_ancestor(const ktree *tree, uint32_t a, uint32_t b) {
    uint32_t depth[2] = {0, 0};
    for (uint32_t n = a; n != KTREE_ROOT; n = ktree_node_at(tree, n)->parent) depth[0]++;
    for (uint32_t n = b; n != KTREE_ROOT; n = ktree_node_at(tree, n)->parent) depth[1]++;
    for (; depth[0] > depth[1]; depth[0]--) a = ktree_node_at(tree, a)->parent;
    for (; depth[1] > depth[0]; depth[1]--) b = ktree_node_at(tree, b)->parent;
    while (a != b) a = ktree_node_at(tree, a)->parent, b = ktree_node_at(tree, b)->parent;
    return a;
}

/* ------------------------------------------------------------------ groups -- */

/* Items whose slabs overlap, directly or through others. */
typedef struct event_group {
    size_t first, count; /* of the items */
    double slab[2];
} event_group;

static const slab_item *item_of(const froe_kinetic *k, const event_group *g, size_t i) {
    return k->events.items.data + g->first + i;
}

static bool is_current(const froe_kinetic *k, const slab_item *item) {
    if (item->kind == CERT_TURN || item->kind == CERT_FLOP) return ktree_segment_at(&k->tree, item->cert)->here;
    const cert_record *c = k->certs.all.data + item->cert;
    if (c->kind == CERT_FREE || c->tick > k->now.tick || certify_kind(&k->tree, &k->certs, item->cert) != item->kind)
        return false;
    const now_claim claim = certify_claim_of(k, item->cert);
    return claim_is(&claim, &item->claim);
}

/* Stores the place of the node, which stays valid when the node is replaced. */
static void add_root(froe_kinetic *k, uint32_t node) {
    if (!node) return;
    uint32_t place = 4 * ktree_node_at(&k->tree, node)->parent + ktree_slot_of(&k->tree, node);
    for (size_t i = 0; i < k->events.roots.count; i++)
        if (k->events.roots.data[i] == place) return;
    call_push(&k->call, &k->events.roots, place);
}

static uint32_t root_at(const froe_kinetic *k, size_t i) {
    return ktree_node_at(&k->tree, k->events.roots.data[i] / 4)->child[k->events.roots.data[i] % 4];
}

/* All nodes of a segment. */
static void add_roots_of(froe_kinetic *k, uint32_t segment) {
    uint32_t n = ktree_segment_at(&k->tree, segment)->nodes;
    for (; n; n = ktree_node_at(&k->tree, n)->next) add_root(k, climb_clear_of_slab(k, n, false));
}

/* Where surgery is needed for an item. */
static void add_roots(froe_kinetic *k, const slab_item *item) {
    if (!is_current(k, item)) return;
    if (item->kind == CERT_TURN) {
        add_roots_of(k, item->cert);
    } else if (item->kind == CERT_FLOP) {
        for (int i = 0; i < 3; i++) add_roots_of(k, now_face_of(&k->now, item->cert)->edge[i]);
    } else {
        add_root(k, climb_clear_of_slab(k, node_of(k, item), false));
    }
}

static bool is_sound(const froe_kinetic *k) {
    return !k->now.lost && !k->tree.broken && !k->call.stopped;
}

static void set_lines(now_state *now, const event_group *g) {
    now->line[0] = g->slab[0], now->line[1] = g->slab[1];
}

/* Surgery in small cells, if the event is a simple one. False: it is not, or participants were added. */
static bool operate(froe_kinetic *k, const event_group *g, bool simple) {
    size_t kept = 0;
    k->events.roots.count = 0;
    set_lines(&k->now, g);
    for (size_t i = 0; i < g->count; i++) add_roots(k, item_of(k, g, i));
    for (size_t i = 0; i < k->events.roots.count; i++) { /* only roots that are below no other */
        bool below = false;
        for (size_t j = 0; j < k->events.roots.count && !below; j++)
            below = i != j && common_ancestor(&k->tree, root_at(k, i), root_at(k, j)) == root_at(k, j);
        if (!below) k->events.roots.data[kept++] = k->events.roots.data[i];
    }
    k->events.roots.count = kept;
    if (!simple) return false;
    for (size_t i = 0; i < k->events.roots.count && is_sound(k); i++) {
        uint32_t node = root_at(k, i);
        if (node && !surgery_slab(k, node)) return false;
    }
    return true;
}

/* Surgery in one cell, none of whose borders is a participant. */
static void operate_carefully(froe_kinetic *k, event_group *g) {
    do {
        size_t count;
        do { /* widens the slab by near ends and crossings of participants, and adds the items that it then meets */
            count = k->participants.list.count;
            participants_reach(k, g->slab);
            for (; g->first + g->count < k->events.items.count; g->count++) {
                const slab_item *next = item_of(k, g, g->count);
                if (next->slab[0] > g->slab[1]) break;
                if (next->slab[1] > g->slab[1]) g->slab[1] = next->slab[1];
                participants_add_item(k, next);
                add_roots(k, next);
            }
        } while (k->participants.list.count > count);
        uint32_t node = KTREE_LEAF; /* of the smallest subtree with all roots */
        for (size_t i = 0; i < k->events.roots.count; i++) {
            uint32_t at = root_at(k, i) ? root_at(k, i) : k->events.roots.data[i] / 4;
            node = node ? common_ancestor(&k->tree, node, at) : at;
        }
        if (node == KTREE_ROOT) k->tree.broken = true; /* a new tree */
        if (!node || !is_sound(k)) return;
        set_lines(&k->now, g);
        if (surgery_slab(k, climb_clear_of_slab(k, node, true))) return;
    } while (is_sound(k));
}

/* ------------------------------------------------------------------ events -- */

/* Adds a number to up to four. False: it was there. */
static bool add_to(uint32_t *all, unsigned *count, uint32_t number) {
    for (unsigned i = 0; i < *count && i < 4; i++)
        if (all[i] == number) return false;
    if (*count < 4) all[*count] = number;
    ++*count;
    return true;
}

/* The corner of an edge in the first of its triangles that is there. */
static uint32_t living_corner(const froe_kinetic *k, uint32_t edge) {
    const now_state *now = &k->now;
    uint32_t corner = now->segments.data[edge].origin;
    for (uint32_t c = corner; c != FROE_NONE; c = now_next_corner(now, c))
        if (ktree_segment_at(&k->tree, now->faces.data[c / 3].surface)->here) return c;
    return corner;
}

/* An event and the segments that it is about. In the plane these are its objects. */
typedef struct event_summary {
    froe_event event;
    uint32_t segments[4];
    unsigned count; /**< may be more than 4 */
} event_summary;

static void add_segment(const froe_kinetic *k, event_summary *all, uint32_t segment) {
    froe_event *e = &all->event;
    if (!add_to(all->segments, &all->count, segment)) return;
    if (!now_is_in_space(&k->now) || now_is_surface(&k->now, segment)) {
        add_to(e->objects, &e->object_count, now_object_of(&k->now, segment));
        return;
    }
    const uint32_t corner = living_corner(k, segment);
    add_to(e->edges, &e->edge_count, corner);
    add_to(e->objects, &e->object_count, corner / 3);
}

froe_event event_now(const now_state *now, froe_event_kind kind) {
    return (froe_event){
        .kind = kind, .tick = now->tick, .early = now_time_of(now, now->tick - 2), .late = now_time_of(now, now->tick)};
}

const now_claim event_no_points = {{0, NAME_NONE}, {0, NAME_NONE}, 0};

bool event_tell(froe_kinetic *k, const event_watcher *watcher, const froe_event *event, const now_claim *claim) {
    k->counts.events[event->kind]++;
    if (!watcher->visit) return true;
    k->events.reporting = true;
    k->events.reported = *claim;
    bool go_on = base_callback(watcher->visit(watcher->user, event));
    k->events.reporting = false;
    now_catch_up(&k->now);
    return go_on;
}

/* The segments that an item is about. */
static void add_names(const froe_kinetic *k, event_summary *all, const slab_item *item) {
    const name_point name[2] = {item->claim.p, item->claim.q};
    if (item->kind == CERT_TURN || item->kind == CERT_FLOP) {
        add_segment(k, all, item->cert);
        return;
    }
    for (int j = 0; j < 2; j++) {
        const uint32_t first = name_is_vertex(name[j]) ? k->tree.vertices.data[name[j].a] : FROE_NONE;
        if (first != FROE_NONE) add_segment(k, all, first / 2);
        if (!name_is_vertex(name[j])) add_segment(k, all, name[j].a);
        if (name_is_crossing(name[j])) add_segment(k, all, (uint32_t)name[j].b);
    }
}

/* What the certificates of a group have in common. Of a triangle that turns over all fail that are about its edges. */
static event_summary describe(const froe_kinetic *k, const event_group *g) {
    size_t flops = 0;
    for (size_t i = 0; i < g->count; i++) flops += item_of(k, g, i)->kind == CERT_FLOP;
    event_summary all = {.event = event_now(&k->now, item_of(k, g, 0)->event)};
    froe_event *e = &all.event;
    for (size_t i = 0; i < g->count; i++) {
        const slab_item *item = item_of(k, g, i);
        if (flops && item->kind != CERT_FLOP) continue;
        if (item->event != e->kind) e->kind = FROE_EVENT_BATCH;
        add_names(k, &all, item);
    }
    if (flops) e->kind = flops > 1 ? FROE_EVENT_BATCH : FROE_EVENT_FLOP;
    if ((e->kind == FROE_EVENT_TRIPLE && all.count > 3) || (e->kind == FROE_EVENT_TURN && all.count > 1) ||
        all.count > 4)
        e->kind = FROE_EVENT_BATCH;
    return all;
}

/* The same of a group that was repaired with all that may be in the same place: what passes there may meet. */
static event_summary describe_crowd(const froe_kinetic *k, const event_group *g) {
    event_summary all = describe(k, g);
    const froe_event_kind kind = all.event.kind;
    if (kind == FROE_EVENT_CONTACT || kind == FROE_EVENT_TURN || kind == FROE_EVENT_FLOP) return all;
    all.event.kind = FROE_EVENT_BATCH;
    for (size_t i = 0; i < k->participants.list.count; i++) add_segment(k, &all, k->participants.list.data[i]);
    return all;
}

/* ------------------------------------------------------------------ rounds -- */

static void gather_flops(froe_kinetic *k) {
    event_state *events = &k->events;
    for (size_t i = 0; i < events->flopping.count; i++) {
        const uint32_t surface = events->flopping.data[i];
        now_claim was = k->certs.all.data[k->certs.segments.data[surface].turn].claim;
        was.above = -was.above;
        slab_item item = {.cert = surface, .kind = CERT_FLOP, .claim = was};
        slab_find(&k->tree, &item);
        call_push(&k->call, &events->items, item);
    }
    events->flopping.count = 0;
}

/* Does the claim of an item hold just after the tick? */
static bool still_holds(froe_kinetic *k, const slab_item *item) {
    const now_claim *claim = &item->claim;
    const int order = claim->above ? NUM_UNSURE : now_order_of_spots(item->spot[0], item->spot[1]);
    return order == NUM_UNSURE ? now_holds(&k->now, claim) >= 0 : order < 0;
}

/* With `known` those certificates are known that are due. */
static void gather_failed_certs(froe_kinetic *k, bool known) {
    event_state *events = &k->events;
    events->items.count = 0;
    gather_flops(k);
    for (size_t i = 0; i < events->turning.count; i++) {
        const uint32_t s = events->turning.data[i], *end = k->now.segments.data[s].end;
        slab_item item = {.cert = s, .kind = CERT_TURN, .claim = {{end[0], NAME_VERTEX}, {end[1], NAME_VERTEX}, 0}};
        slab_locate(&k->now, &item);
        slab_find(&k->tree, &item);
        call_push(&k->call, &events->items, item);
    }
    events->turning.count = 0;
    if (!known) cert_find_due(&k->certs, k->now.tick);
    const size_t count = k->certs.queue.due.count;
    for (size_t i = 0; i < count && !k->call.stopped; i++) {
        const uint32_t cert = k->certs.queue.due.data[i];
        if (k->certs.all.data[cert].kind < CERT_TURN) {
            slab_item item;
            item.cert = cert, item.claim = certify_claim_of(k, cert);
            item.kind = certify_kind(&k->tree, &k->certs, cert);
            slab_locate(&k->now, &item);
            if (still_holds(k, &item)) { /* since the last tick it failed and became true again */
                certify_again(k, cert);
            } else {
                slab_find(&k->tree, &item);
                call_push(&k->call, &events->items, item);
            }
        }
        call_poll(&k->call);
    }
    slab_sort(k);
}

/* Does a group look like one event, in one place or on one vertical line? */
static bool is_one_event(const froe_kinetic *k, const event_group *g, const event_summary *all) {
    switch (all->event.kind) {
    case FROE_EVENT_CONTACT:
        return g->count == 1 || all->count == 2;
    case FROE_EVENT_TRIPLE:
        return all->count == 3;
    case FROE_EVENT_TURN:
        return all->count == 1 && !ktree_segment_at(&k->tree, all->segments[0])->bound;
    case FROE_EVENT_FLOP:
    case FROE_EVENT_BATCH:
        return false;
    default:
        for (size_t i = 1; i < g->count; i++)
            if (!claim_is(&item_of(k, g, i)->claim, &item_of(k, g, 0)->claim)) return false;
        return true;
    }
}

/* The cell of a node that is to be looked for soon is found from the nodes above. */
static void ask_ahead(const froe_kinetic *k, const slab_item *item) {
    if (item->kind > CERT_RIGHT) return;
    const uint32_t node = k->certs.all.data[item->cert].owner;
    __builtin_prefetch(k->tree.nodes.data + k->tree.nodes.data[node].parent);
}

/* Repairs the tree where the certificates of a group fail, described by the event. The group may grow. True: others
 * may be in the same place that have no certificates. */
static bool repair(froe_kinetic *k, event_group *g, const event_summary *event, unsigned round) {
    bool usual = true; /* unrelated points are not in one place */
    participants_clear(&k->participants);
    for (size_t i = 0; i < g->count; i++) {
        ask_ahead(k, item_of(k, g, i));
        usual &= participants_add_item(k, item_of(k, g, i));
    }
    const bool simple = usual && round < CAREFUL_ROUND && is_one_event(k, g, event) &&
                        !participants_have_loose_ends(k, item_of(k, g, 0));
    k->now.lost = !(g->slab[0] <= g->slab[1] && g->slab[1] - g->slab[0] < (double)INFINITY);
    pass_outcome outcome = simple ? PASS_DONE : PASS_REFUSED;
    set_lines(&k->now, g);
    for (size_t i = 0; i < g->count && !outcome && is_sound(k); i++) { /* if walls are passed, and that is all */
        const slab_item *item = item_of(k, g, i);
        if (g->first + i == 0 || is_current(k, item))
            outcome = slab_is_one_place(item) ? PASS_REFUSED : pass_wall(k, item);
    }
    const bool crowd = outcome && !operate(k, g, simple && outcome == PASS_REFUSED);
    if (crowd) {
        k->counts.crowds++;
        operate_carefully(k, g);
    }
    if (!k->call.stopped && !is_sound(k)) surgery_restart(k);
    return crowd;
}

static bool is_settled(const froe_kinetic *k) {
    return cert_next_tick(&k->certs) > k->now.tick && !k->events.turning.count && !k->events.flopping.count;
}

/* So many rounds, or until nothing is due any more. The first one tells what happens. With `known` those certificates
 * are known that are due in it. */
static bool settle_tick(froe_kinetic *k, unsigned rounds, bool known, const event_watcher *watcher) {
    bool go_on = true;
    for (unsigned round = 0; round < rounds && !k->call.stopped; round++) {
        if (is_settled(k)) break;
        gather_failed_certs(k, known && !round);
        const size_t count = k->events.items.count;
        if (!count || k->call.stopped) break;
        if (round >= RESTART_ROUND) {
            surgery_restart(k);
            k->counts.stuck += round >= LAST_ROUND;
            if (round >= LAST_ROUND) break;
            continue;
        }
        event_group g;
        for (size_t i = 0; i < count && !k->call.stopped; i += g.count) {
            const slab_item *items = k->events.items.data;
            g = (event_group){i, 1, {items[i].slab[0], items[i].slab[1]}};
            for (size_t j = i + 1; j < count && items[j].slab[0] <= g.slab[1]; j++, g.count++)
                if (items[j].slab[1] > g.slab[1]) g.slab[1] = items[j].slab[1];
            const double place = g.slab[0];
            event_summary event = describe(k, &g);
            /* a turn and nothing else may leave the tree as it is */
            if (g.count == 1 && items[i].kind == CERT_TURN && turn_is_free(&k->tree, items[i].cert))
                k->counts.free_turns++;
            else if (repair(k, &g, &event, round))
                event = describe_crowd(k, &g);
            if (k->call.stopped) break;
            k->counts.batches += event.event.kind == FROE_EVENT_BATCH;
            k->events.slab[0] = g.slab[0], k->events.slab[1] = g.slab[1];
            k->events.place = place;
            if (!round) go_on &= event_tell(k, watcher, &event.event, &item_of(k, &g, 0)->claim);
        }
    }
    return go_on;
}

/* ------------------------------------------------------------------- steps -- */

static void leave_tree(froe_kinetic *k, uint32_t segment, uint32_t tell_it) {
    ktree_segment *s = ktree_segment_at(&k->tree, segment);
    const uint32_t *leaving = k->events.leaving.data;
    if (s->stays) tell_it = 1;
    s->stays = false;
    if (s->leaving < k->events.leaving.count && leaving[s->leaving] / 2 == segment)
        k->events.leaving.data[s->leaving] |= tell_it;
    else
        renew_note_leaving(k, segment, tell_it);
}

/* The same in space of the triangles that have an edge. */
static void leave_with_edge(froe_kinetic *k, uint32_t edge, uint32_t tell_it) {
    const now_state *now = &k->now;
    for (uint32_t c = now->segments.data[edge].origin; c != FROE_NONE; c = now_next_corner(now, c))
        leave_tree(k, now->faces.data[c / 3].surface, tell_it);
}

/* Takes out the segments that have to be out before time goes on to the tick. Others in one line with them may have to
 * be taken out, too, and what that changes may keep others from staying. In space plans that go on change nothing; only
 * what is equal from then on, for as long as pieces last, may be something else, and no certificate tells. True: the
 * plans of so many triangles go on that all is to be made anew at the tick, and they are left in the tree until then.
 */
static bool let_leave(froe_kinetic *k, int64_t tick) {
    const bool space = now_is_in_space(&k->now);
    void (*leave)(froe_kinetic *, uint32_t, uint32_t) = space ? leave_with_edge : leave_tree;
    size_t gone = 0;
    for (bool first = true;; first = false) {
        cert_find_due(&k->certs, tick);
        for (size_t i = 0; i < k->certs.queue.due.count; i++) {
            const cert_record *c = k->certs.all.data + k->certs.queue.due.data[i];
            if (c->kind == CERT_LIFE) leave_tree(k, c->owner, 1);
            if (c->kind == CERT_COLLINEAR) {
                const uint32_t *pair = k->collinear.pairs.data[c->owner].segment;
                for (int j = 0; j < 2; j++) call_push(&k->call, &k->events.meeting, pair[j]);
                leave(k, pair[1], 0);
            }
            uint32_t e = c->kind == CERT_COURSE ? k->tree.vertices.data[c->owner] : FROE_NONE;
            for (; e != FROE_NONE; e = ktree_next_end(&k->tree, e)) leave(k, e / 2, 1);
        }
        for (size_t i = 0; i < k->certs.queue.due.count; i++) {
            const uint32_t cert = k->certs.queue.due.data[i];
            if (k->certs.all.data[cert].kind == CERT_COURSE) cert_set_tick(&k->certs, cert, NOW_NEVER);
        }
        if (first && !space) renew_choose(k, tick);
        if (gone == k->events.leaving.count) renew_check(k, tick);
        const bool all = space && FEW * k->events.leaving.count > k->now.motion->objects.count;
        if (gone == k->events.leaving.count || k->call.stopped) return all;
        for (; gone < k->events.leaving.count && !k->call.stopped; gone++) {
            const uint32_t s = k->events.leaving.data[gone] / 2;
            if (!all || k->now.motion->objects.data[now_object_of(&k->now, s)].last < tick) change_remove(k, s);
        }
    }
}

/* Swaps the ends of segments that turn. This comes before any other question at the tick, as sides depend on it. */
static void turn_segments(froe_kinetic *k) {
    event_state *events = &k->events;
    cert_find_due(&k->certs, k->now.tick);
    for (size_t i = 0; i < k->certs.queue.due.count; i++) {
        const cert_record *c = k->certs.all.data + k->certs.queue.due.data[i];
        if (c->kind == CERT_TURN) call_push(&k->call, &events->turning, c->owner);
    }
    size_t kept = 0;
    for (size_t i = 0; i < events->turning.count && !k->call.stopped; i++) {
        uint32_t s = events->turning.data[i];
        bool was = k->now.segments.data[s].turned;
        certify_turn(k, s);
        if (was != k->now.segments.data[s].turned) events->turning.data[kept++] = s;
    }
    events->turning.count = kept;
}

/* In space: finds triangles that turn over, as seen from above. */
static void flop_triangles(froe_kinetic *k) {
    event_state *events = &k->events;
    size_t kept = 0;
    cert_find_due(&k->certs, k->now.tick);
    for (size_t i = 0; i < k->certs.queue.due.count; i++) {
        const cert_record *c = k->certs.all.data + k->certs.queue.due.data[i];
        if (c->kind == CERT_FLOP) call_push(&k->call, &events->flopping, c->owner);
    }
    for (size_t i = 0; i < events->flopping.count && !k->call.stopped; i++) {
        const uint32_t surface = events->flopping.data[i];
        const now_claim was = k->certs.all.data[k->certs.segments.data[surface].turn].claim;
        certify_flop(k, surface);
        if (now_holds(&k->now, &was) < 0) events->flopping.data[kept++] = surface;
    }
    events->flopping.count = kept;
}

/* Puts those that have left back into the tree, if they are there, and tells what has changed, in the order of the
 * segments. */
static bool enter_tree(froe_kinetic *k, const event_watcher *watcher) {
    bool go_on = true;
    for (size_t i = 0; i < k->events.leaving.count && !k->call.stopped; i++) {
        const uint32_t s = k->events.leaving.data[i] / 2, object = now_object_of(&k->now, s);
        const motion_object *o = k->now.motion->objects.data + object;
        change_schedule(k, s);
        const bool there = now_is_alive(&k->now, object);
        froe_event_kind kind = !there                          ? FROE_EVENT_DISAPPEAR
                               : k->now.tick <= (o->first | 1) ? FROE_EVENT_APPEAR
                                                               : FROE_EVENT_PLAN;
        const bool in = ktree_segment_at(&k->tree, s)->stays || ktree_segment_at(&k->tree, s)->here;
        if (there && !in) change_insert(k, s);
        ktree_segment_at(&k->tree, s)->stays = false;
        event_summary all = {.event = event_now(&k->now, kind)};
        add_segment(k, &all, s);
        if (k->events.leaving.data[i] % 2 && !now_is_ghost(&k->now, object))
            go_on &= event_tell(k, watcher, &all.event, &event_no_points);
    }
    k->events.leaving.count = 0;
    return go_on;
}

/* Tells which segments in one line meet. No certificate of the tree says so: it has one of them where they overlap. */
static bool tell_meetings(froe_kinetic *k, const event_watcher *watcher) {
    const uint32_t *pair = k->events.meeting.data;
    bool go_on = true;
    for (size_t i = 0; i < k->events.meeting.count && !k->call.stopped; i += 2) {
        event_summary all = {.event = event_now(&k->now, FROE_EVENT_CONTACT)};
        for (size_t j = i; j < i + 2; j++) add_segment(k, &all, pair[j]);
        go_on &= event_tell(k, watcher, &all.event, &event_no_points);
    }
    k->events.meeting.count = 0;
    return go_on;
}

/* Are claims all that is due at the tick, so that nothing leaves, turns, or goes on to another piece of a plan? */
static bool claims_alone_are_due(froe_kinetic *k, int64_t tick) {
    cert_find_due(&k->certs, tick);
    for (size_t i = 0; i < k->certs.queue.due.count; i++)
        if (k->certs.all.data[k->certs.queue.due.data[i]].kind > CERT_BELOW) return false;
    return true;
}

bool event_step(froe_kinetic *k, int64_t tick, const event_watcher *watcher) {
    event_state *events = &k->events;
    int64_t next = cert_next_tick(&k->certs);
    if (next > tick) {
        k->now.tick = tick;
        return true;
    }
    /* All certificates hold until then. What comes next to each other where a segment leaves must not pass before. */
    if (next - 2 > k->now.tick) k->now.tick = next - 2;
    events->leaving.count = events->staying.count = events->meeting.count = 0;
    events->turning.count = events->flopping.count = 0;
    const bool usual = claims_alone_are_due(k, next), all = !usual && let_leave(k, next);
    k->now.tick = next;
    if (!usual) {
        renew_apply(k);
        turn_segments(k);
        flop_triangles(k);
    }
    events->phase = EVENT_BEFORE;
    /* Where all is made anew, edges of which plans go on are in the tree until then, and may have turned in between. */
    bool go_on = settle_tick(k, all ? 1 : LAST_ROUND + 1, usual, watcher);
    if (all && !k->call.stopped) {
        triangle_enroll_all(k);
        if (!k->call.stopped) surgery_restart(k);
    }
    events->phase = EVENT_CHANGE;
    go_on &= enter_tree(k, watcher);
    events->phase = EVENT_AFTER;
    go_on &= settle_tick(k, LAST_ROUND + 1, false, watcher);
    events->phase = EVENT_MEETING;
    return tell_meetings(k, watcher) && go_on;
}
