/* surgery.c: cutting a partition along a vertical line, putting two halves together, and making a slab anew.
 *
 *          x1    x2           What happens at an instant changes the partition only near one x, so the tree of
 *     _____:______:_____      a cell is cut in three there, the middle is made from scratch, and the three are
 *     |  A |  T   | B  |      joined again. Cut and join are exact inverses: both walk down the nodes that the line
 *     |    | x o  |    |      crosses. The slab holds little besides what crosses it, as both lines are as
 *     |____:______:____|      close to the event as doubles can be.
 *
 * The result is the very tree that is made from scratch, because of one fact: a node's segment is the first, in order,
 * of those that reach into its cell. If the roots of two neighbours differ, the earlier of the two segments does not
 * reach the border between them, so it ends at a wall of its own, and the other tree belongs behind that wall. */
#include "kinetic/live.h"

static void push_cutting(froe_kinetic *k, uint32_t a, uint32_t b, const uint32_t parent[2], const uint8_t slot[2]) {
    live_cutting c = {a, b, {parent[0], parent[1]}, {slot[0], slot[1]}};
    if (!array_push(&k->alloc, &k->cuttings, c)) k->short_of_memory = true;
}

/* ------------------------------------------------------------------- split -- */

/* The right half of a node that the line crosses. */
static uint32_t right_half(froe_kinetic *k, uint32_t node) {
    const uint32_t wall[2] = {END_NONE, node_at(k, node)->wall[RIGHT]};
    for (int side = 0; side < 2; side++) live_note_half(k, node, side);
    uint32_t half = live_new_node(k, node_at(k, node)->segment, wall);
    live_node *n = node_at(k, node);
    if (!half) return LEAF;
    node_at(k, half)->half = true;
    live_attach(k, half, RIGHT, n->child[RIGHT]);
    n->child[RIGHT] = LEAF;
    live_set_wall(k, node, RIGHT, END_NONE);
    uint32_t cert = n->cert[CERT_RIGHT];
    n->cert[CERT_RIGHT] = CERT_NONE;
    node_at(k, half)->cert[CERT_RIGHT] = cert;
    if (cert != CERT_NONE) k->certs.data[cert].owner = half;
    return half;
}

static void split_node(froe_kinetic *k, const live_cutting *c, now_name line) {
    live_node *n = node_at(k, c->a);
    n->stamp = k->stamp;
    k->counts.nodes_touched++;
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == END_NONE) continue;
        int order = now_compare(&k->now, line, wall_name(k, n->segment, n->wall[side]));
        if (side == LEFT ? order > 0 : order < 0) continue;
        uint32_t parent[2] = {c->parent[0], c->parent[1]};
        uint8_t slot[2] = {c->slot[0], c->slot[1]};
        live_attach(k, parent[1 - side], slot[1 - side], c->a); /* it goes to the other side as a whole */
        parent[1 - side] = c->a, slot[1 - side] = (uint8_t)side;
        push_cutting(k, n->child[side], LEAF, parent, slot);
        return;
    }
    uint32_t half = right_half(k, c->a);
    if (!half) return;
    live_attach(k, c->parent[0], c->slot[0], c->a);
    live_attach(k, c->parent[1], c->slot[1], half);
    for (int i = UP; i <= DOWN; i++)
        push_cutting(k, node_at(k, c->a)->child[i], LEAF, (uint32_t[]){c->a, half},
                     (uint8_t[]){(uint8_t)i, (uint8_t)i});
}

void live_split(froe_kinetic *k, uint32_t node, int line, const uint32_t parent[2], const uint8_t slot[2]) {
    size_t waiting = k->cuttings.count;
    push_cutting(k, node, LEAF, parent, slot);
    while (k->cuttings.count > waiting && !k->short_of_memory) {
        live_cutting c = k->cuttings.data[--k->cuttings.count];
        if (c.a) {
            split_node(k, &c, (now_name){(uint32_t)line, NAME_LINE});
        } else {
            live_attach(k, c.parent[0], c.slot[0], LEAF);
            live_attach(k, c.parent[1], c.slot[1], LEAF);
        }
    }
    k->cuttings.count = waiting;
}

/* -------------------------------------------------------------------- join -- */

/* Two parts of one node. */
static void merge(froe_kinetic *k, uint32_t a, uint32_t b) {
    live_node *m = node_at(k, a), *n = node_at(k, b);
    if (m->wall[RIGHT] != END_NONE || n->wall[LEFT] != END_NONE) k->broken = true;
    for (int i = UP; i <= DOWN; i++) {
        const uint8_t side = (uint8_t)i;
        push_cutting(k, m->child[i], n->child[i], (uint32_t[]){a, a}, (uint8_t[]){side, side});
    }
    const uint32_t wall = n->wall[RIGHT];
    live_set_wall(k, b, RIGHT, END_NONE);
    live_attach(k, a, RIGHT, n->child[RIGHT]);
    if (m->cert[CERT_RIGHT] != CERT_NONE) live_drop_cert(k, m->cert[CERT_RIGHT]);
    m->cert[CERT_RIGHT] = n->cert[CERT_RIGHT];
    n->cert[CERT_RIGHT] = CERT_NONE;
    if (m->cert[CERT_RIGHT] != CERT_NONE) k->certs.data[m->cert[CERT_RIGHT]].owner = a;
    live_set_wall(k, a, RIGHT, wall);
    live_free_node(k, b);
}

static void join_nodes(froe_kinetic *k, const live_cutting *c) {
    uint32_t a = c->a, b = c->b, parent = c->parent[0];
    uint8_t slot = c->slot[0];
    if (!a || !b) {
        live_attach(k, parent, slot, a ? a : b);
        return;
    }
    live_node *m = node_at(k, a), *n = node_at(k, b);
    m->stamp = n->stamp = k->stamp;
    k->counts.nodes_touched++;
    if (m->segment == n->segment) {
        live_attach(k, parent, slot, a);
        merge(k, a, b);
        return;
    }
    int side = comes_before(k, m->segment, n->segment) ? RIGHT : LEFT;
    uint32_t first = side == RIGHT ? a : b;
    if (node_at(k, first)->wall[side] == END_NONE) k->broken = true;
    live_attach(k, parent, slot, first);
    uint32_t inner = node_at(k, first)->child[side];
    push_cutting(k, side == RIGHT ? inner : a, side == RIGHT ? b : inner, (uint32_t[]){first, first},
                 (uint8_t[]){(uint8_t)side, (uint8_t)side});
}

void live_join(froe_kinetic *k, uint32_t a, uint32_t b, uint32_t parent, uint8_t slot) {
    size_t waiting = k->cuttings.count;
    push_cutting(k, a, b, (uint32_t[]){parent, parent}, (uint8_t[]){slot, slot});
    while (k->cuttings.count > waiting && !k->short_of_memory) {
        live_cutting c = k->cuttings.data[--k->cuttings.count];
        join_nodes(k, &c);
    }
    k->cuttings.count = waiting;
}

/* -------------------------------------------------------------------- slab -- */

/* Adds the segments in the slab, and the borders of the cell, that come near a place. True: some were added. */
static bool has_strangers(froe_kinetic *k, const live_cell *cell) {
    const uint32_t border[2] = {cell->top, cell->bottom};
    bool found = live_find_strangers(k, border, 2);
    return live_find_strangers(k, k->list.data, k->list.count) || found;
}

bool live_slab(froe_kinetic *k, uint32_t node) {
    const live_site site = live_site_of(k, node);
    live_cell slab = site.cell;
    k->stamp++;
    live_new_list(k);
    live_split(k, node, 0, (uint32_t[]){PARTS, PARTS}, (uint8_t[]){0, 1});
    live_split(k, node_at(k, PARTS)->child[1], 1, (uint32_t[]){PARTS, PARTS}, (uint8_t[]){1, 2});
    if (k->short_of_memory) return false;
    live_collect(k, node_at(k, PARTS)->child[1]);
    bool strangers = has_strangers(k, &site.cell);
    if (!strangers) {
        k->counts.surgeries++;
        live_free_tree(k, node_at(k, PARTS)->child[1]);
        for (uint32_t i = 0; i < 2; i++) slab.wall[i] = (now_name){i, NAME_LINE};
        live_grow(k, &slab, 0, PARTS, 1);
    }
    const uint32_t *part = node_at(k, PARTS)->child;
    live_join(k, part[0], part[1], PARTS, 0);
    part = node_at(k, PARTS)->child;
    live_join(k, part[0], part[2], site.parent, site.slot);
    if (!strangers && !k->broken && !k->now.lost) live_certify(k, &site);
    live_certify_halves(k);
    return !strangers;
}

/* Counts nodes without a parent as free. */
static void forget_nodes(froe_kinetic *k) {
    for (uint32_t i = FIRST_NODE; i < k->nodes.count; i++)
        if (node_at(k, i)->segment != FROE_NONE) live_free_node(k, i);
    live_attach(k, ROOT, 0, LEAF);
}

void live_restart(froe_kinetic *k) {
    k->counts.restarts++;
    k->short_of_memory = k->broken = k->now.lost = false;
    forget_nodes(k);
    k->stamp++;
    live_new_list(k);
    const live_site all = {ROOT, 0, false, live_plane()};
    for (uint32_t s = 0; s < k->segments.count; s++)
        if (segment_at(k, s)->here) live_list(k, s);
    live_grow(k, &all.cell, 0, ROOT, 0);
    live_certify(k, &all);
}
