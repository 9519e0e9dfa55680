/* ktree.c: nodes of a live partition, their cells, and lists of segments. */
#include "kinetic/live.h"

void live_touch_end(froe_kinetic *k, uint32_t end) {
    live_end *e = segment_at(k, end / 2)->end + end % 2;
    if (e->stamp == k->stamp) return;
    e->stamp = k->stamp;
    if (!array_push(&k->alloc, &k->ends, end)) k->short_of_memory = true;
}

void live_touch_wall(froe_kinetic *k, now_name wall) {
    uint32_t e = name_is_vertex(wall) ? k->vertices.data[wall.a] : FROE_NONE;
    for (; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (segment_at(k, e / 2)->end[e % 2].node) live_touch_end(k, e);
}

static live_end *end_of(froe_kinetic *k, uint32_t segment, uint32_t wall) {
    return segment_at(k, segment)->end + (END_0 - wall);
}

uint32_t live_new_node(froe_kinetic *k, uint32_t segment, const uint32_t wall[2]) {
    uint32_t node = k->free_node;
    if (node) {
        k->free_node = node_at(k, node)->next;
    } else {
        if (!array_push(&k->alloc, &k->nodes, (live_node){0})) {
            k->short_of_memory = true;
            return LEAF;
        }
        node = (uint32_t)(k->nodes.count - 1);
    }
    live_segment *s = segment_at(k, segment);
    *node_at(k, node) = (live_node){.segment = segment,
                                    .wall = {wall[0], wall[1]},
                                    .next = s->nodes,
                                    .cert = {CERT_NONE, CERT_NONE, CERT_NONE},
                                    .stamp = k->stamp,
                                    .turner = FROE_NONE};
    live_name_walls(k, node);
    if (s->nodes) node_at(k, s->nodes)->previous = node;
    s->nodes = node;
    k->node_count++;
    for (int side = 0; side < 2; side++) live_own_end(k, node, side);
    return node;
}

void live_set_wall(froe_kinetic *k, uint32_t node, int side, uint32_t wall) {
    node_at(k, node)->wall[side] = wall;
    live_name_walls(k, node);
    live_own_end(k, node, side);
}

void live_own_end(froe_kinetic *k, uint32_t node, int side) {
    live_node *n = node_at(k, node);
    if (!is_end(n->wall[side])) return;
    end_of(k, n->segment, n->wall[side])->node = node;
}

void live_free_node(froe_kinetic *k, uint32_t node) {
    live_node *n = node_at(k, node);
    for (int i = 0; i < 3; i++)
        if (n->cert[i] != CERT_NONE) live_drop_cert(k, n->cert[i]);
    for (int side = 0; side < 2; side++) {
        if (!is_end(n->wall[side])) continue;
        live_end *end = end_of(k, n->segment, n->wall[side]);
        if (end->node == node) end->node = LEAF;
        live_touch_end(k, 2 * n->segment + (END_0 - n->wall[side]));
    }
    if (n->previous)
        node_at(k, n->previous)->next = n->next;
    else
        segment_at(k, n->segment)->nodes = n->next;
    if (n->next) node_at(k, n->next)->previous = n->previous;
    n->segment = n->turner = FROE_NONE;
    n->next = k->free_node;
    k->free_node = node;
    k->node_count--;
}

void live_attach(froe_kinetic *k, uint32_t parent, uint8_t slot, uint32_t node) {
    node_at(k, parent)->child[slot] = node;
    if (!node) return;
    node_at(k, node)->parent = parent;
    node_at(k, node)->slot = slot;
}

/* ------------------------------------------------------------------- cells -- */

live_cell live_plane(void) {
    return (live_cell){{{0, NAME_NONE}, {0, NAME_NONE}}, FROE_NONE, FROE_NONE};
}

/* Looks up the name of a wall if it is not known yet. */
static void take_wall(const froe_kinetic *k, now_name *wall, const live_node *node, int side) {
    if (node->wall[side] != END_NONE && !name_exists(*wall)) *wall = wall_name(k, node->segment, node->wall[side]);
}

/* What the parent adds to the borders found so far. */
static void widen(const froe_kinetic *k, live_cell *cell, const live_node *parent, int slot) {
    if (slot < UP) {
        take_wall(k, cell->wall + (1 - slot), parent, slot);
        return;
    }
    uint32_t *border = slot == UP ? &cell->bottom : &cell->top;
    if (*border == FROE_NONE) *border = parent->segment;
    for (int side = 0; side < 2; side++) take_wall(k, cell->wall + side, parent, side);
}

static bool is_closed(const live_cell *cell) {
    return name_exists(cell->wall[LEFT]) && name_exists(cell->wall[RIGHT]) && cell->top != FROE_NONE &&
           cell->bottom != FROE_NONE;
}

live_cell live_cell_of(const froe_kinetic *k, uint32_t node) {
    live_cell cell = live_plane();
    for (const live_node *n = node_at(k, node); n->parent != ROOT && !is_closed(&cell); n = node_at(k, n->parent)) {
        const live_node *parent = node_at(k, n->parent);
        widen(k, &cell, parent, n->slot);
    }
    return cell;
}

uint32_t live_wall_owner(const froe_kinetic *k, uint32_t node, int side, uint8_t *slot) {
    for (uint32_t n = node;; n = node_at(k, n)->parent) {
        uint32_t above = node_at(k, n)->parent;
        *slot = live_slot_of(k, n);
        if (above == ROOT) return LEAF;
        if (*slot == 1 - side || (*slot >= UP && node_at(k, above)->wall[side] != END_NONE)) return above;
    }
}

live_cell live_child_cell(const froe_kinetic *k, const live_cell *cell, uint32_t node, int slot) {
    const live_node *n = node_at(k, node);
    live_cell child = *cell;
    now_name left = wall_name(k, n->segment, n->wall[LEFT]), right = wall_name(k, n->segment, n->wall[RIGHT]);
    if (slot == LEFT) {
        child.wall[RIGHT] = left;
    } else if (slot == RIGHT) {
        child.wall[LEFT] = right;
    } else {
        if (name_exists(left)) child.wall[LEFT] = left;
        if (name_exists(right)) child.wall[RIGHT] = right;
        *(slot == UP ? &child.bottom : &child.top) = n->segment;
    }
    return child;
}

/* ------------------------------------------------------------------- lists -- */

void live_new_list(froe_kinetic *k) {
    k->list_stamp++;
    k->list.count = 0;
}

void live_list(froe_kinetic *k, uint32_t segment) {
    if (segment_at(k, segment)->stamp == k->list_stamp) return;
    segment_at(k, segment)->stamp = k->list_stamp;
    if (!array_push(&k->alloc, &k->list, segment)) k->short_of_memory = true;
}

typedef void visit_node(froe_kinetic *k, uint32_t node, void *context);

/* Visits a subtree from the top down. */
static void each_node(froe_kinetic *k, uint32_t node, visit_node *visit, void *context) {
    k->order.count = 0;
    if (node && !array_push(&k->alloc, &k->order, node)) k->short_of_memory = true;
    while (k->order.count) {
        uint32_t top = k->order.data[--k->order.count];
        if (!array_reserve(&k->alloc, &k->order, 4)) {
            k->short_of_memory = true;
            return;
        }
        const live_node *n = node_at(k, top);
        for (int i = 0; i < 4; i++)
            if (n->child[i]) k->order.data[k->order.count++] = n->child[i];
        visit(k, top, context);
    }
}

static void list_segment_of(froe_kinetic *k, uint32_t node, void *context) {
    (void)context;
    live_list(k, node_at(k, node)->segment);
}

void live_collect(froe_kinetic *k, uint32_t node) {
    each_node(k, node, list_segment_of, NULL);
}

static void free_one(froe_kinetic *k, uint32_t node, void *context) {
    (void)context;
    live_free_node(k, node);
}

void live_free_tree(froe_kinetic *k, uint32_t node) {
    each_node(k, node, free_one, NULL);
}
