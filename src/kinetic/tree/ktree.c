/* ktree.c: nodes of a partition in motion, their cells, and lists of segments. */
#include "kinetic/tree/ktree.h"

void ktree_free(ktree *tree) {
    const froe_allocator *alloc = &tree->call->alloc;
    array_free(alloc, &tree->nodes);
    array_free(alloc, &tree->segments);
    array_free(alloc, &tree->vertices);
    array_free(alloc, &tree->touched);
    array_free(alloc, &tree->list);
    array_free(alloc, &tree->stack);
    array_free(alloc, &tree->visits);
}

bool ktree_is_one_segment(const ktree *tree, name_point p, name_point q) {
    if (!name_is_vertex(p) || !name_is_vertex(q)) return false;
    for (uint32_t e = tree->vertices.data[p.a]; e != FROE_NONE; e = ktree_next_end(tree, e))
        if (now_has_end(tree->now, e / 2, q.a)) return true;
    return false;
}

/* ------------------------------------------------------------------- walls -- */

void ktree_touch_end(ktree *tree, uint32_t end) {
    ktree_end *e = ktree_segment_at(tree, end / 2)->end + end % 2;
    if (e->stamp == tree->stamp) return;
    e->stamp = tree->stamp;
    call_push(tree->call, &tree->touched, end);
}

void ktree_touch_wall(ktree *tree, name_point wall) {
    uint32_t e = name_is_vertex(wall) ? tree->vertices.data[wall.a] : FROE_NONE;
    for (; e != FROE_NONE; e = ktree_next_end(tree, e))
        if (ktree_segment_at(tree, e / 2)->end[e % 2].node) ktree_touch_end(tree, e);
}

/* Sets the segment in whose direction the walls of a node are named, which is a function of these walls. */
static void name_walls(const ktree *tree, uint32_t node) {
    if (!tree->augmented) return;
    ktree_node *n = tree->nodes.data + node;
    const bool has[2] = {n->wall[KTREE_LEFT] != KTREE_NO_WALL, n->wall[KTREE_RIGHT] != KTREE_NO_WALL};
    const uint32_t wall = n->wall[has[KTREE_LEFT] ? KTREE_LEFT : KTREE_RIGHT];
    n->turner = FROE_NONE;
    if (has[KTREE_LEFT] && has[KTREE_RIGHT])
        n->turner = n->segment;
    else if (wall != KTREE_NO_WALL && !ktree_is_end(wall))
        n->turner = wall;
    if (n->turner != FROE_NONE) n->turned = tree->now->segments.data[n->turner].turned;
}

static void swap(uint32_t *a, uint32_t *b) {
    const uint32_t first = *a;
    *a = *b, *b = first;
}

void ktree_turn_node(const ktree *tree, uint32_t node) {
    ktree_node *n = tree->nodes.data + node;
    n->turned = !n->turned;
    swap(n->wall, n->wall + 1);
    if (n->turner == n->segment) return; /* what is to the left of both walls stays there */
    swap(n->child + KTREE_LEFT, n->child + KTREE_RIGHT);
    swap(n->cert, n->cert + 2);
    for (uint8_t side = 0; side < 2; side++)
        if (n->child[side]) tree->nodes.data[n->child[side]].slot = side;
}

/* Which end's wall a node has; the node of an end's wall is known by its end. */
static void own_end(ktree *tree, uint32_t node, int side) {
    const ktree_node *n = ktree_node_at(tree, node);
    if (ktree_is_end(n->wall[side])) ktree_segment_at(tree, n->segment)->end[KTREE_END_0 - n->wall[side]].node = node;
}

/* ------------------------------------------------------------------- nodes -- */

uint32_t ktree_new_node(ktree *tree, uint32_t segment, const uint32_t wall[2]) {
    uint32_t node = tree->free_node;
    if (node) {
        tree->free_node = ktree_node_at(tree, node)->next;
    } else {
        if (tree->nodes.count >= KTREE_MOST) return call_stop(tree->call), KTREE_LEAF; /* as without memory */
        if (!call_reserve(tree->call, &tree->nodes, 1)) return KTREE_LEAF;
        node = (uint32_t)tree->nodes.count++;
        tree->nodes.data[node].turner = FROE_NONE;
    }
    ktree_segment *s = ktree_segment_at(tree, segment);
    *ktree_node_at(tree, node) = (ktree_node){.segment = segment,
                                              .wall = {wall[0], wall[1]},
                                              .next = s->nodes,
                                              .cert = {FROE_NONE, FROE_NONE, FROE_NONE},
                                              .stamp = tree->stamp,
                                              .turner = FROE_NONE};
    name_walls(tree, node);
    if (s->nodes) tree->nodes.data[s->nodes].previous = node; /* not read, as it may be far from all caches */
    s->nodes = node;
    tree->node_count++;
    for (int side = 0; side < 2; side++) own_end(tree, node, side);
    return node;
}

void ktree_set_wall(ktree *tree, uint32_t node, int side, uint32_t wall) {
    ktree_node_at(tree, node)->wall[side] = wall;
    name_walls(tree, node);
    own_end(tree, node, side);
}

void ktree_free_node(ktree *tree, uint32_t node) {
    ktree_node *n = ktree_node_at(tree, node);
    for (int side = 0; side < 2; side++) {
        if (!ktree_is_end(n->wall[side])) continue;
        const uint32_t which = KTREE_END_0 - n->wall[side];
        ktree_end *end = ktree_segment_at(tree, n->segment)->end + which;
        if (end->node == node) end->node = KTREE_LEAF;
        ktree_touch_end(tree, 2 * n->segment + which);
    }
    if (n->previous)
        tree->nodes.data[n->previous].next = n->next;
    else
        ktree_segment_at(tree, n->segment)->nodes = n->next;
    if (n->next) tree->nodes.data[n->next].previous = n->previous;
    n->segment = n->turner = FROE_NONE;
    n->next = tree->free_node;
    tree->free_node = node;
    tree->node_count--;
}

void ktree_attach(ktree *tree, uint32_t parent, uint8_t slot, uint32_t node) {
    ktree_node_at(tree, parent)->child[slot] = node;
    if (!node) return;
    tree->nodes.data[node].parent = parent;
    tree->nodes.data[node].slot = slot;
}

/* ------------------------------------------------------------------- cells -- */

ktree_cell ktree_plane(void) {
    return (ktree_cell){{{0, NAME_NONE}, {0, NAME_NONE}}, FROE_NONE, FROE_NONE, FROE_NONE, FROE_NONE};
}

/* Looks up the name of a wall if it is not known yet. */
static void take_wall(const ktree *tree, name_point *wall, const ktree_node *node, int side) {
    if (node->wall[side] != KTREE_NO_WALL && !name_exists(*wall))
        *wall = ktree_wall_name(tree, node->segment, node->wall[side]);
}

/* In the plane there are no surfaces, and so only nodes are read. */
static inline ktree_cell plane_cell_of(const ktree *tree, uint32_t node, bool augmented) {
    ktree_cell cell = ktree_plane();
    int missing = 4;
    const ktree_node *n = ktree_node_at(tree, node);
    while (missing && n->parent != KTREE_ROOT) {
        const ktree_node *parent = augmented ? ktree_node_at(tree, n->parent) : tree->nodes.data + n->parent;
        const int slot = n->slot;
        n = parent;
        if (slot < KTREE_UP) {
            if (name_exists(cell.wall[1 - slot])) continue;
            take_wall(tree, cell.wall + (1 - slot), n, slot);
            missing -= name_exists(cell.wall[1 - slot]);
            continue;
        }
        uint32_t *border = slot == KTREE_UP ? &cell.bottom : &cell.top;
        if (*border == FROE_NONE) *border = n->segment, missing--;
        for (int side = 0; side < 2; side++) {
            if (n->wall[side] == KTREE_NO_WALL || name_exists(cell.wall[side])) continue;
            cell.wall[side] = ktree_wall_name(tree, n->segment, n->wall[side]);
            missing--;
        }
    }
    return cell;
}

ktree_cell ktree_cell_of(const ktree *tree, uint32_t node) {
    if (!now_is_in_space(tree->now)) /* without the test of each node whether it has turned, where none does */
        return tree->augmented ? plane_cell_of(tree, node, true) : plane_cell_of(tree, node, false);
    ktree_cell cell = ktree_plane();
    for (const ktree_node *n = ktree_node_at(tree, node); n->parent != KTREE_ROOT; n = ktree_node_at(tree, n->parent)) {
        if (name_exists(cell.wall[0]) && name_exists(cell.wall[1]) && cell.top != FROE_NONE &&
            cell.bottom != FROE_NONE && cell.ceiling != FROE_NONE && cell.floor != FROE_NONE)
            break;
        const ktree_node *parent = ktree_node_at(tree, n->parent);
        if (now_is_surface(tree->now, parent->segment)) {
            uint32_t *layer = n->slot == KTREE_UP ? &cell.floor : &cell.ceiling;
            if (*layer == FROE_NONE) *layer = parent->segment;
            continue;
        }
        if (n->slot < KTREE_UP) {
            take_wall(tree, cell.wall + (1 - n->slot), parent, n->slot);
            continue;
        }
        uint32_t *border = n->slot == KTREE_UP ? &cell.bottom : &cell.top;
        if (*border == FROE_NONE) *border = parent->segment;
        for (int side = 0; side < 2; side++) take_wall(tree, cell.wall + side, parent, side);
    }
    return cell;
}

ktree_cell ktree_child_cell(const ktree *tree, const ktree_cell *cell, uint32_t node, int slot) {
    const ktree_node *n = ktree_node_at(tree, node);
    ktree_cell child = *cell;
    if (now_is_surface(tree->now, n->segment)) {
        *(slot == KTREE_UP ? &child.floor : &child.ceiling) = n->segment;
        return child;
    }
    const name_point left = ktree_wall_name(tree, n->segment, n->wall[KTREE_LEFT]);
    const name_point right = ktree_wall_name(tree, n->segment, n->wall[KTREE_RIGHT]);
    if (slot == KTREE_LEFT) {
        child.wall[KTREE_RIGHT] = left;
    } else if (slot == KTREE_RIGHT) {
        child.wall[KTREE_LEFT] = right;
    } else {
        if (name_exists(left)) child.wall[KTREE_LEFT] = left;
        if (name_exists(right)) child.wall[KTREE_RIGHT] = right;
        *(slot == KTREE_UP ? &child.bottom : &child.top) = n->segment;
    }
    return child;
}

ktree_site ktree_site_of(const ktree *tree, uint32_t node) {
    const ktree_node *n = ktree_node_at(tree, node);
    return (ktree_site){n->parent, ktree_slot_of(tree, node), n->cut, ktree_cell_of(tree, node)};
}

uint32_t ktree_wall_owner(const ktree *tree, uint32_t node, int side, uint8_t *slot) {
    for (uint32_t n = node;; n = ktree_node_at(tree, n)->parent) {
        uint32_t above = ktree_node_at(tree, n)->parent;
        *slot = ktree_slot_of(tree, n);
        if (above == KTREE_ROOT) return KTREE_LEAF;
        if (*slot == 1 - side || (*slot >= KTREE_UP && ktree_node_at(tree, above)->wall[side] != KTREE_NO_WALL))
            return above;
    }
}

name_point ktree_wall_beside(const ktree *tree, uint32_t node, int side) {
    uint8_t slot;
    const uint32_t owner = ktree_wall_owner(tree, node, side, &slot);
    if (!owner) return (name_point){0, NAME_NONE};
    const ktree_node *n = ktree_node_at(tree, owner);
    return ktree_wall_name(tree, n->segment, n->wall[slot < KTREE_UP ? 1 - side : side]);
}

/* ------------------------------------------------------------------- walks -- */

void ktree_walk(ktree *tree, uint32_t node) {
    tree->stack.count = 0;
    ktree_push_node(tree, node);
}

uint32_t ktree_walk_next(ktree *tree) {
    if (!tree->stack.count) return KTREE_LEAF;
    const uint32_t node = tree->stack.data[--tree->stack.count];
    if (!call_reserve(tree->call, &tree->stack, 4)) return KTREE_LEAF;
    const ktree_node *n = ktree_node_at(tree, node);
    for (int i = 0; i < 4; i++)
        if (n->child[i]) tree->stack.data[tree->stack.count++] = n->child[i];
    return node;
}

void ktree_push_visit(ktree *tree, uint32_t node, const ktree_cell *cell, bool back) {
    if (node) call_push(tree->call, &tree->visits, (ktree_visit){*cell, node, back});
}

void ktree_new_list(ktree *tree) {
    tree->list_stamp++;
    tree->list.count = 0;
}

void ktree_list(ktree *tree, uint32_t segment) {
    if (ktree_segment_at(tree, segment)->stamp == tree->list_stamp) return;
    ktree_segment_at(tree, segment)->stamp = tree->list_stamp;
    call_push(tree->call, &tree->list, segment);
}

void ktree_list_objects(ktree *tree, uint32_t segment) {
    const now_state *now = tree->now;
    if (!now_is_in_space(now)) {
        ktree_list(tree, segment);
        return;
    }
    if (now_is_surface(now, segment)) {
        if (ktree_segment_at(tree, segment)->here) ktree_list(tree, segment);
        return;
    }
    for (uint32_t c = now->segments.data[segment].origin; c != FROE_NONE; c = now_next_corner(now, c)) {
        const uint32_t surface = now->faces.data[c / 3].surface;
        if (ktree_segment_at(tree, surface)->here) ktree_list(tree, surface);
    }
}

void ktree_collect(ktree *tree, uint32_t node) {
    ktree_walk(tree, node);
    for (uint32_t n; (n = ktree_walk_next(tree));) ktree_list_objects(tree, ktree_node_at(tree, n)->segment);
}
