/* turns.c: segments that turn upright and over, in an augmented partition (section 3.1.4 of the paper).
 *
 *      :b /:          :\ b:        When a segment turns, left and right of it change places all along it: of its own
 *      : / :    ->    : \ :        two walls in each cell, and of every wall at a crossing with a later segment, with
 *     -:/--:-        -:--\:-       what is behind it. So walls are named in the direction of a segment, from its
 *      :a  :          :  a:        end 0 to its end 1: two walls of a node in that of the node's own segment, one at
 * a crossing in that of the segment that is crossed. A turn reverses that direction. Left and right of a
 * node are updated when it is next read (node_at). Parts to the left and right of both walls of a node stay there.
 *
 * Certificates must not change, either. Points of one segment are ordered along it (along.c). A region outside of the
 * segment, at one of its walls, borders on its other wall after the turn. Where the turn comes before the certificate
 * of the region fails, the certificate covers both walls.
 *
 * When nothing else fails at the tick and nearby, all certificates hold, and so the tree is right: all that lies
 * between the two walls of a node is ordered by certificates, and only points of the segment itself can change their
 * order by its turn. This does not cover points without a wall, which coincide with others for as long as plans last.
 * When some are found, their segments are bound: they turn by surgery, as all do in an ordinary partition. So do
 * segments that share a vertex. That walls of two nodes need names of different directions is from the specification.
 * That certificates must cover the turn is not in the paper. */
#include "kinetic/live.h"

/* ------------------------------------------------------------------- walls -- */

void live_name_walls(const froe_kinetic *k, uint32_t node) {
    if (!k->options.augmented) return;
    live_node *n = k->nodes.data + node;
    const bool has[2] = {n->wall[LEFT] != END_NONE, n->wall[RIGHT] != END_NONE};
    const uint32_t wall = n->wall[has[LEFT] ? LEFT : RIGHT];
    n->turner = FROE_NONE;
    if (has[LEFT] && has[RIGHT])
        n->turner = n->segment;
    else if (wall != END_NONE && !is_end(wall))
        n->turner = wall;
    if (n->turner != FROE_NONE) n->turned = k->now.segments.data[n->turner].turned;
}

static void swap(uint32_t pair[2]) {
    const uint32_t first = pair[0];
    pair[0] = pair[1], pair[1] = first;
}

void live_turn_node(const froe_kinetic *k, uint32_t node) {
    live_node *n = k->nodes.data + node;
    n->turned = !n->turned;
    swap(n->wall);
    if (n->turner == n->segment) return; /* what is to the left of both walls stays there */
    uint32_t region[2] = {n->cert[CERT_LEFT], n->cert[CERT_RIGHT]};
    swap(n->child);
    swap(region);
    n->cert[CERT_LEFT] = region[0], n->cert[CERT_RIGHT] = region[1];
    for (uint8_t side = 0; side < 2; side++) {
        if (n->child[side]) k->nodes.data[n->child[side]].slot = side;
        if (region[side] != CERT_NONE) k->certs.data[region[side]].kind = side == LEFT ? CERT_LEFT : CERT_RIGHT;
    }
}

/* ----------------------------------------------------------------- freedom -- */

static bool asks(const froe_kinetic *k, now_name p) {
    return name_is_vertex(p) ? p.a >= k->vertices.count : now_is_question(&k->now, (uint32_t)p.b);
}

static void bind(froe_kinetic *k, now_name p) {
    if (name_is_crossing(p)) segment_at(k, p.a)->bound = segment_at(k, (uint32_t)p.b)->bound = true;
    if (!name_is_vertex(p)) return;
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        segment_at(k, e / 2)->bound = true;
}

void live_bind(froe_kinetic *k, now_name p, now_name q) {
    if (asks(k, p) || asks(k, q)) return;
    bind(k, p);
    bind(k, q);
}

bool live_turns_freely(const froe_kinetic *k, uint32_t segment) {
    const live_segment *s = segment_at(k, segment);
    const uint32_t *vertex = k->now.segments.data[segment].end;
    if (!k->options.augmented || s->bound) return false;
    for (uint32_t i = 0; i < 2; i++)
        if (k->vertices.data[vertex[i]] != 2 * segment + i || s->end[i].next != FROE_NONE) return false;
    return true;
}

/* ------------------------------------------------------------------ claims -- */

void live_name_along(const froe_kinetic *k, now_claim *claim) {
    if (!k->options.augmented) return;
    const uint32_t segment = now_shared(&k->now, claim->p, claim->q);
    if (segment == FROE_NONE) return;
    if (k->now.segments.data[segment].turned) *claim = (now_claim){claim->q, claim->p, 0};
    claim->above = NOW_ALONG;
}

static int64_t turn_tick(const froe_kinetic *k, uint32_t segment) {
    const uint32_t cert = segment_at(k, segment)->turn;
    return cert == CERT_NONE ? NOW_NEVER : k->certs.data[cert].tick;
}

/* When the first of the segments turns that are behind a name. */
static int64_t first_turn(const froe_kinetic *k, now_name p) {
    int64_t first = NOW_NEVER;
    if (name_is_crossing(p)) {
        const int64_t a = turn_tick(k, p.a), b = turn_tick(k, (uint32_t)p.b);
        return a < b ? a : b;
    }
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next) {
        const int64_t tick = turn_tick(k, e / 2);
        first = tick < first ? tick : first;
    }
    return first;
}

int64_t live_first_turn(const froe_kinetic *k, const now_claim *claim) {
    const int64_t p = first_turn(k, claim->p), q = first_turn(k, claim->q);
    return p < q ? p : q;
}

static bool is_due(int64_t turn, int64_t tick) {
    return turn != NOW_NEVER && turn <= tick;
}

/* The node whose other wall takes the place of a region's border, seen from outside, when its segment turns; LEAF:
 * there is none, or that is after the tick. */
static uint32_t turning_owner(const froe_kinetic *k, uint32_t node, cert_kind region, int side, int64_t tick) {
    uint8_t slot = (uint8_t)(1 - side);
    uint32_t owner = node;
    if (region == CERT_MIDDLE && node_at(k, node)->wall[side] != END_NONE) return LEAF; /* from inside */
    if (region != (side == LEFT ? CERT_RIGHT : CERT_LEFT)) owner = live_wall_owner(k, node, side, &slot);
    const bool outside = owner && slot == 1 - side;
    return outside && is_due(turn_tick(k, node_at(k, owner)->segment), tick) ? owner : LEAF;
}

void live_cover_turns(froe_kinetic *k, uint32_t cert) {
    live_cert *c = k->certs.data + cert;
    if (!is_due(live_first_turn(k, &c->claim), c->tick)) return;
    const live_cell cell = live_cell_of(k, c->owner);
    now_name name[2][2]; /* of both borders, now and then */
    bool known = true;
    live_borders(k, c->owner, &cell, c->kind, name[0]);
    for (int side = 0; side < 2; side++) {
        const uint32_t owner = turning_owner(k, c->owner, c->kind, side, c->tick);
        const uint32_t wall = owner ? node_at(k, owner)->wall[side] : END_NONE;
        name[1][side] = wall_name(k, node_at(k, owner)->segment, wall);
        known = known && c->covered[side] == wall;
        c->covered[side] = wall;
    }
    for (int i = 1; i < 4 && !known; i++) {
        now_claim claim = {name[i & 1][LEFT], name[i / 2][RIGHT], 0};
        if (!name_exists(claim.p) || !name_exists(claim.q)) continue;
        live_name_along(k, &claim);
        const int64_t tick = live_fail_tick(k, &claim);
        if (tick > k->now.tick && tick < c->tick) live_set_tick(k, cert, tick);
    }
}

/* ------------------------------------------------------------------ halves -- */

void live_note_half(froe_kinetic *k, uint32_t node, int side) {
    const live_node *n = node_at(k, node);
    if (!k->options.augmented || turn_tick(k, n->segment) == NOW_NEVER) return;
    if (!n->child[side] || (n->half && side == RIGHT)) return; /* a half was noted before */
    const live_half half = {n->child[side], n->wall[1 - side], (uint8_t)side};
    if (!array_push(&k->alloc, &k->halves, half)) k->short_of_memory = true;
}

static void push_turned_node(froe_kinetic *k, uint32_t node) {
    if (node && !array_push(&k->alloc, &k->order, node)) k->short_of_memory = true;
}

/* All regions of a subtree whose border on a side is that of its cell. */
static void cover_hugging(froe_kinetic *k, uint32_t top, int side) {
    k->order.count = 0;
    push_turned_node(k, top);
    while (k->order.count) {
        const live_node *n = node_at(k, k->order.data[--k->order.count]);
        const bool ends = n->wall[side] != END_NONE;
        const uint32_t cert = n->cert[!ends ? CERT_MIDDLE : side == LEFT ? CERT_LEFT : CERT_RIGHT];
        if (cert != CERT_NONE) live_cover_turns(k, cert);
        for (int i = UP; i <= DOWN && !ends; i++) push_turned_node(k, n->child[i]);
        if (ends) push_turned_node(k, n->child[side]);
    }
}

void live_certify_halves(froe_kinetic *k) {
    for (size_t i = 0; i < k->halves.count && !k->short_of_memory && !k->broken && !k->now.lost; i++) {
        const live_half *h = k->halves.data + i;
        if (k->nodes.data[h->child].segment == FROE_NONE || live_slot_of(k, h->child) != h->side) continue;
        const live_node *owner = node_at(k, node_at(k, h->child)->parent);
        const uint32_t other = owner->wall[1 - h->side];
        if (other != END_NONE && other != h->other) cover_hugging(k, h->child, 1 - h->side);
    }
    k->halves.count = 0;
}
