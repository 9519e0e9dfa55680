/* surgery.c: cutting a partition along a vertical line, putting two halves together, and making a slab anew. */
#include "kinetic/event/surgery.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/kinetic.h"

void surgery_begin(froe_kinetic *k) {
    k->certs.stamp = ++k->tree.stamp;
}

void surgery_free_node(froe_kinetic *k, uint32_t node) {
    const ktree_node *n = ktree_node_at(&k->tree, node);
    for (int i = 0; i < 3; i++)
        if (n->cert[i] != FROE_NONE) cert_drop(&k->certs, n->cert[i]);
    ktree_free_node(&k->tree, node);
}

void surgery_free_tree(froe_kinetic *k, uint32_t node) {
    if (!node) return;
    ktree_walk(&k->tree, node);
    for (uint32_t n; (n = ktree_walk_next(&k->tree));) surgery_free_node(k, n);
}

static void push_cutting(froe_kinetic *k, uint32_t a, uint32_t b, const uint32_t parent[2], const uint8_t slot[2]) {
    call_push(&k->call, &k->surgery.cuttings, (surgery_cutting){a, b, {parent[0], parent[1]}, {slot[0], slot[1]}});
}

/* Gives the certificate of a node's right region to another node. */
static void move_right_cert(froe_kinetic *k, ktree_node *from, uint32_t to) {
    const uint32_t cert = from->cert[CERT_RIGHT];
    from->cert[CERT_RIGHT] = FROE_NONE;
    ktree_node_at(&k->tree, to)->cert[CERT_RIGHT] = cert;
    if (cert != FROE_NONE) k->certs.all.data[cert].owner = to;
}

/* ------------------------------------------------------------------- split -- */

static void split_node(froe_kinetic *k, const surgery_cutting *c, name_point line) {
    ktree *tree = &k->tree;
    ktree_node *n = ktree_node_at(tree, c->a);
    n->stamp = tree->stamp;
    k->counts.nodes_touched++;
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        int order = now_compare(&k->now, line, ktree_wall_name(tree, n->segment, n->wall[side]));
        if (side == KTREE_LEFT ? order > 0 : order < 0) continue;
        uint32_t parent[2] = {c->parent[0], c->parent[1]};
        uint8_t slot[2] = {c->slot[0], c->slot[1]};
        ktree_attach(tree, parent[1 - side], slot[1 - side], c->a); /* it goes to the other side as a whole */
        parent[1 - side] = c->a, slot[1 - side] = (uint8_t)side;
        push_cutting(k, n->child[side], KTREE_LEAF, parent, slot);
        return;
    }
    /* the line crosses it: its right half becomes a node of its own */
    for (int side = 0; side < 2; side++) turn_note_half(k, c->a, side);
    uint32_t half = ktree_new_node(tree, n->segment, (uint32_t[]){KTREE_NO_WALL, n->wall[KTREE_RIGHT]});
    if (!half) return;
    n = ktree_node_at(tree, c->a);
    ktree_node_at(tree, half)->half = true;
    ktree_attach(tree, half, KTREE_RIGHT, n->child[KTREE_RIGHT]);
    n->child[KTREE_RIGHT] = KTREE_LEAF;
    ktree_set_wall(tree, c->a, KTREE_RIGHT, KTREE_NO_WALL);
    move_right_cert(k, n, half);
    ktree_attach(tree, c->parent[0], c->slot[0], c->a);
    ktree_attach(tree, c->parent[1], c->slot[1], half);
    for (int i = KTREE_UP; i <= KTREE_DOWN; i++)
        push_cutting(k, n->child[i], KTREE_LEAF, (uint32_t[]){c->a, half}, (uint8_t[]){(uint8_t)i, (uint8_t)i});
}

void surgery_split(froe_kinetic *k, uint32_t node, int line, const uint32_t parent[2], const uint8_t slot[2]) {
    size_t waiting = k->surgery.cuttings.count;
    push_cutting(k, node, KTREE_LEAF, parent, slot);
    while (k->surgery.cuttings.count > waiting && !k->call.stopped) {
        surgery_cutting c = k->surgery.cuttings.data[--k->surgery.cuttings.count];
        if (c.a) split_node(k, &c, (name_point){(uint32_t)line, NAME_LINE});
        for (int i = 0; i < 2 && !c.a; i++) ktree_attach(&k->tree, c.parent[i], c.slot[i], KTREE_LEAF);
    }
    k->surgery.cuttings.count = waiting;
}

/* -------------------------------------------------------------------- join -- */

static void join_nodes(froe_kinetic *k, const surgery_cutting *c) {
    ktree *tree = &k->tree;
    uint32_t a = c->a, b = c->b;
    if (!a || !b) {
        ktree_attach(tree, c->parent[0], c->slot[0], a ? a : b);
        return;
    }
    ktree_node *m = ktree_node_at(tree, a), *n = ktree_node_at(tree, b);
    m->stamp = n->stamp = tree->stamp;
    k->counts.nodes_touched++;
    if (m->segment != n->segment) { /* the one that cuts first; the other goes behind its wall */
        int side = ktree_before(tree, m->segment, n->segment) ? KTREE_RIGHT : KTREE_LEFT;
        uint32_t first = side == KTREE_RIGHT ? a : b;
        if (ktree_node_at(tree, first)->wall[side] == KTREE_NO_WALL) tree->broken = true;
        ktree_attach(tree, c->parent[0], c->slot[0], first);
        uint32_t inner = ktree_node_at(tree, first)->child[side];
        push_cutting(k, side == KTREE_RIGHT ? inner : a, side == KTREE_RIGHT ? b : inner, (uint32_t[]){first, first},
                     (uint8_t[]){(uint8_t)side, (uint8_t)side});
        return;
    }
    ktree_attach(tree, c->parent[0], c->slot[0], a); /* two parts of one node */
    if (m->wall[KTREE_RIGHT] != KTREE_NO_WALL || n->wall[KTREE_LEFT] != KTREE_NO_WALL) tree->broken = true;
    for (int i = KTREE_UP; i <= KTREE_DOWN; i++)
        push_cutting(k, m->child[i], n->child[i], (uint32_t[]){a, a}, (uint8_t[]){(uint8_t)i, (uint8_t)i});
    const uint32_t wall = n->wall[KTREE_RIGHT];
    ktree_set_wall(tree, b, KTREE_RIGHT, KTREE_NO_WALL);
    ktree_attach(tree, a, KTREE_RIGHT, n->child[KTREE_RIGHT]);
    if (m->cert[CERT_RIGHT] != FROE_NONE) cert_drop(&k->certs, m->cert[CERT_RIGHT]);
    move_right_cert(k, n, a);
    ktree_set_wall(tree, a, KTREE_RIGHT, wall);
    surgery_free_node(k, b);
}

void surgery_join(froe_kinetic *k, uint32_t a, uint32_t b, uint32_t parent, uint8_t slot) {
    size_t waiting = k->surgery.cuttings.count;
    push_cutting(k, a, b, (uint32_t[]){parent, parent}, (uint8_t[]){slot, slot});
    while (k->surgery.cuttings.count > waiting && !k->call.stopped) {
        surgery_cutting c = k->surgery.cuttings.data[--k->surgery.cuttings.count];
        join_nodes(k, &c);
    }
    k->surgery.cuttings.count = waiting;
}

/* -------------------------------------------------------------------- slab -- */

bool surgery_slab(froe_kinetic *k, uint32_t node) {
    ktree *tree = &k->tree;
    const ktree_site site = ktree_site_of(tree, node);
    ktree_cell slab = site.cell;
    surgery_begin(k);
    ktree_new_list(tree);
    surgery_split(k, node, 0, (uint32_t[]){KTREE_PARTS, KTREE_PARTS}, (uint8_t[]){0, 1});
    surgery_split(k, ktree_node_at(tree, KTREE_PARTS)->child[1], 1, (uint32_t[]){KTREE_PARTS, KTREE_PARTS},
                  (uint8_t[]){1, 2});
    if (k->call.stopped) return false;
    ktree_collect(tree, ktree_node_at(tree, KTREE_PARTS)->child[1]);
    bool more = participants_add_near(k, (uint32_t[]){site.cell.top, site.cell.bottom}, 2);
    more = participants_add_near(k, tree->list.data, tree->list.count) || more;
    if (!more) {
        k->counts.surgeries++;
        surgery_free_tree(k, ktree_node_at(tree, KTREE_PARTS)->child[1]);
        for (uint32_t i = 0; i < 2; i++) slab.wall[i] = (name_point){i, NAME_LINE};
        surgery_grow(k, &slab, KTREE_PARTS, 1);
    }
    const uint32_t *part = ktree_node_at(tree, KTREE_PARTS)->child;
    surgery_join(k, part[0], part[1], KTREE_PARTS, 0);
    part = ktree_node_at(tree, KTREE_PARTS)->child;
    surgery_join(k, part[0], part[2], site.parent, site.slot);
    if (!more && !tree->broken && !k->now.lost) certify_site(k, &site);
    turn_certify_halves(k);
    return !more;
}

void surgery_restart(froe_kinetic *k) {
    ktree *tree = &k->tree;
    const bool space = now_is_in_space(&k->now);
    k->counts.restarts++;
    k->call.stopped = tree->broken = k->now.lost = false;
    for (uint32_t i = KTREE_FIRST; i < tree->nodes.count; i++) /* nodes without a parent, too */
        if (ktree_node_at(tree, i)->segment != FROE_NONE) surgery_free_node(k, i);
    ktree_attach(tree, KTREE_ROOT, 0, KTREE_LEAF);
    surgery_begin(k);
    ktree_new_list(tree);
    const ktree_site all = {KTREE_ROOT, 0, false, ktree_plane()};
    for (uint32_t s = 0; s < tree->segments.count; s++)
        if (ktree_segment_at(tree, s)->here && (!space || now_is_surface(&k->now, s))) ktree_list(tree, s);
    surgery_grow(k, &all.cell, KTREE_ROOT, 0);
    certify_site(k, &all);
}
