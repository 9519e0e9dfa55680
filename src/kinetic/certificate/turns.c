/* turns.c: segments that turn upright and over, in an augmented partition. */
#include "kinetic/certificate/turns.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/kinetic.h"

/* ----------------------------------------------------------------- freedom -- */

void turn_bind(ktree *tree, name_point p, name_point q) {
    const name_point both[2] = {p, q};
    for (int i = 0; i < 2; i++) /* the points of a question bind nothing */
        if (name_is_vertex(both[i]) ? both[i].a >= tree->vertices.count
                                    : now_is_question(tree->now, (uint32_t)both[i].b))
            return;
    for (int i = 0; i < 2; i++) {
        const name_point at = both[i];
        if (name_is_crossing(at))
            ktree_segment_at(tree, at.a)->bound = ktree_segment_at(tree, (uint32_t)at.b)->bound = true;
        uint32_t e = name_is_vertex(at) ? tree->vertices.data[at.a] : FROE_NONE;
        for (; e != FROE_NONE; e = ktree_next_end(tree, e)) ktree_segment_at(tree, e / 2)->bound = true;
    }
}

bool turn_is_free(const ktree *tree, uint32_t segment) {
    const ktree_segment *s = ktree_segment_at(tree, segment);
    const uint32_t *vertex = tree->now->segments.data[segment].end;
    if (!tree->augmented || s->bound) return false;
    for (uint32_t i = 0; i < 2; i++)
        if (tree->vertices.data[vertex[i]] != 2 * segment + i || s->end[i].next != FROE_NONE) return false;
    return true;
}

/* ------------------------------------------------------------------ claims -- */

void turn_name_along(const ktree *tree, now_claim *claim) {
    if (!tree->augmented) return;
    const uint32_t segment = now_shared(tree->now, claim->p, claim->q);
    if (segment == FROE_NONE) return;
    if (tree->now->segments.data[segment].turned) *claim = (now_claim){claim->q, claim->p, 0};
    claim->above = NOW_ALONG;
}

static int64_t turn_tick(const cert_table *certs, uint32_t segment) {
    const uint32_t cert = certs->segments.data[segment].turn;
    return cert == FROE_NONE ? NOW_NEVER : certs->all.data[cert].tick;
}

/* When the first of the segments turns that are behind a name. */
static int64_t first_turn(const froe_kinetic *k, name_point p) {
    int64_t first = NOW_NEVER;
    if (name_is_crossing(p)) {
        const int64_t a = turn_tick(&k->certs, p.a), b = turn_tick(&k->certs, (uint32_t)p.b);
        return a < b ? a : b;
    }
    for (uint32_t e = k->tree.vertices.data[p.a]; e != FROE_NONE; e = ktree_next_end(&k->tree, e)) {
        const int64_t tick = turn_tick(&k->certs, e / 2);
        first = tick < first ? tick : first;
    }
    return first;
}

static bool is_due(int64_t turn, int64_t tick) {
    return turn != NOW_NEVER && turn <= tick;
}

/* The node whose other wall takes the place of a region's border, seen from outside, when its segment turns;
 * KTREE_LEAF: there is none, or that is after the tick. */
static uint32_t turning_owner(const froe_kinetic *k, uint32_t node, cert_kind region, int side, int64_t tick) {
    const ktree *tree = &k->tree;
    uint8_t slot = (uint8_t)(1 - side);
    uint32_t owner = node;
    if (region == CERT_MIDDLE && ktree_node_at(tree, node)->wall[side] != KTREE_NO_WALL) /* from inside */
        return KTREE_LEAF;
    if (region != (side == KTREE_LEFT ? CERT_RIGHT : CERT_LEFT)) owner = ktree_wall_owner(tree, node, side, &slot);
    const bool outside = owner && slot == 1 - side;
    return outside && is_due(turn_tick(&k->certs, ktree_node_at(tree, owner)->segment), tick) ? owner : KTREE_LEAF;
}

void turn_cover(froe_kinetic *k, uint32_t cert) {
    const ktree *tree = &k->tree;
    cert_record *c = k->certs.all.data + cert;
    if (!is_due(first_turn(k, c->claim.p), c->tick) && !is_due(first_turn(k, c->claim.q), c->tick)) return;
    const ktree_cell cell = ktree_cell_of(tree, c->owner);
    const cert_kind region = certify_kind(tree, &k->certs, cert);
    name_point name[2][2]; /* of both borders, now and then */
    bool known = true;
    certify_borders(tree, c->owner, &cell, region, name[0]);
    for (int side = 0; side < 2; side++) {
        const uint32_t owner = turning_owner(k, c->owner, region, side, c->tick);
        const uint32_t wall = owner ? ktree_node_at(tree, owner)->wall[side] : KTREE_NO_WALL;
        name[1][side] = ktree_wall_name(tree, ktree_node_at(tree, owner)->segment, wall);
        known = known && c->covered[side] == wall;
        c->covered[side] = wall;
    }
    for (int i = 1; i < 4 && !known; i++) {
        now_claim claim = {name[i & 1][KTREE_LEFT], name[i / 2][KTREE_RIGHT], 0};
        if (!name_exists(claim.p) || !name_exists(claim.q)) continue;
        turn_name_along(tree, &claim);
        const int64_t tick = certify_fail_tick(k, &claim);
        if (tick > k->now.tick && tick < c->tick) cert_set_tick(&k->certs, cert, tick);
    }
}

/* ------------------------------------------------------------------ halves -- */

void turn_note_half(froe_kinetic *k, uint32_t node, int side) {
    const ktree_node *n = ktree_node_at(&k->tree, node);
    if (!k->tree.augmented || turn_tick(&k->certs, n->segment) == NOW_NEVER) return;
    if (!n->child[side] || (n->half && side == KTREE_RIGHT)) return; /* a half was noted before */
    call_push(&k->call, &k->turns.halves, (turn_half){n->child[side], n->wall[1 - side], (uint8_t)side});
}

/* All regions of a subtree whose border on a side is that of its cell. */
static void cover_along_wall(froe_kinetic *k, uint32_t top, int side) {
    ktree *tree = &k->tree;
    tree->stack.count = 0;
    ktree_push_node(tree, top);
    while (tree->stack.count) {
        const ktree_node *n = ktree_node_at(tree, tree->stack.data[--tree->stack.count]);
        const bool ends = n->wall[side] != KTREE_NO_WALL;
        const uint32_t cert = n->cert[!ends ? CERT_MIDDLE : side == KTREE_LEFT ? CERT_LEFT : CERT_RIGHT];
        if (cert != FROE_NONE) turn_cover(k, cert);
        for (int i = KTREE_UP; i <= KTREE_DOWN && !ends; i++) ktree_push_node(tree, n->child[i]);
        if (ends) ktree_push_node(tree, n->child[side]);
    }
}

void turn_certify_halves(froe_kinetic *k) {
    const ktree *tree = &k->tree;
    for (size_t i = 0; i < k->turns.halves.count && !k->call.stopped && !tree->broken && !k->now.lost; i++) {
        const turn_half *h = k->turns.halves.data + i;
        if (tree->nodes.data[h->child].segment == FROE_NONE || ktree_slot_of(tree, h->child) != h->side) continue;
        const ktree_node *owner = ktree_node_at(tree, ktree_node_at(tree, h->child)->parent);
        const uint32_t other = owner->wall[1 - h->side];
        if (other != KTREE_NO_WALL && other != h->other) cover_along_wall(k, h->child, 1 - h->side);
    }
    k->turns.halves.count = 0;
}
