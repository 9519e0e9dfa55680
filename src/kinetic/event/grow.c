/* grow.c: the partition of some segments in a cell, from scratch: the definition of the tree, with which all updates
 * agree. The first segment in order cuts the cell; each part gets those of the others that reach into it.
 *
 * Cells are open, walls are points in the order of x + eps y: an end on a wall needs none of its own, and what lies in
 * the line of an edge, touches it or ends on it from outside is not in the cell. This covers shared ends, ends on
 * segments, vertical segments, segments in one line, and many crossings in one point. */
#include "base/sort.h"
#include "kinetic/event/surgery.h"
#include "kinetic/kinetic.h"

/* The order of two points; if they coincide, their segments are bound to each other. */
static int order_of(ktree *tree, name_point p, name_point q) {
    const int order = now_compare(tree->now, p, q);
    if (!order) turn_bind(tree, p, q);
    return order;
}

/* On which side of a border the ends are, > 0 being inside. */
static bool clip_border(froe_kinetic *k, uint32_t segment, uint32_t border, int inside, name_point at[2],
                        uint32_t end[2]) {
    int side[2];
    if (segment == border) return false;
    const name_point cut = name_crossing(segment, border);
    for (int i = 0; i < 2; i++) {
        side[i] = now_side(&k->now, border, now_vertex(&k->now, segment, i)) * inside;
        if (!side[i]) turn_bind(&k->tree, cut, cut);
    }
    if (!side[0] && !side[1]) collinear_watch(k, border, segment);
    if (side[0] <= 0 && side[1] <= 0) return false;
    if (side[0] >= 0 && side[1] >= 0) return true;
    int out = side[0] < 0 ? KTREE_LEFT : KTREE_RIGHT;
    if (ktree_is_end(end[out]) || (order_of(&k->tree, cut, at[out]) > 0) == (out == KTREE_LEFT)) {
        at[out] = cut;
        end[out] = border;
    }
    return true;
}

bool surgery_clip(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]) {
    now_state *now = &k->now;
    name_point at[2];
    for (int i = 0; i < 2; i++) {
        at[i] = (name_point){now_vertex(now, segment, i), NAME_VERTEX};
        end[i] = KTREE_END_0 - (uint32_t)now_end(now, segment, i);
    }
    const name_point left = cell->wall[KTREE_LEFT], right = cell->wall[KTREE_RIGHT];
    if (name_exists(left) && order_of(&k->tree, at[KTREE_RIGHT], left) <= 0) return false;
    if (name_exists(right) && order_of(&k->tree, at[KTREE_LEFT], right) >= 0) return false;
    if (cell->top != FROE_NONE && !clip_border(k, segment, cell->top, -1, at, end)) return false;
    if (cell->bottom != FROE_NONE && !clip_border(k, segment, cell->bottom, 1, at, end)) return false;
    if ((!ktree_is_end(end[KTREE_LEFT]) || !ktree_is_end(end[KTREE_RIGHT])) &&
        order_of(&k->tree, at[KTREE_LEFT], at[KTREE_RIGHT]) >= 0)
        return false;
    bool on_wall = false;
    if (name_exists(left) && order_of(&k->tree, at[KTREE_LEFT], left) <= 0)
        at[KTREE_LEFT] = left, end[KTREE_LEFT] = KTREE_NO_WALL, on_wall = true;
    if (name_exists(right) && order_of(&k->tree, at[KTREE_RIGHT], right) >= 0)
        at[KTREE_RIGHT] = right, end[KTREE_RIGHT] = KTREE_NO_WALL, on_wall = true;
    return !on_wall || order_of(&k->tree, at[KTREE_LEFT], at[KTREE_RIGHT]) < 0;
}

/* ------------------------------------------------------------------- order -- */

static int by_key(void *user, uint32_t a, uint32_t b) {
    const ktree *tree = user;
    return ktree_before(tree, a, b) ? -1 : ktree_before(tree, b, a);
}

static void sort_list(froe_kinetic *k) {
    enum { FEW = 24 };
    uint32_t *items = k->tree.list.data;
    size_t count = k->tree.list.count;
    if (count > FEW) {
        k->surgery.scratch.count = 0;
        if (call_reserve(&k->call, &k->surgery.scratch, count))
            base_merge_sort(items, k->surgery.scratch.data, count, by_key, &k->tree);
        return;
    }
    for (size_t i = 1; i < count; i++) {
        uint32_t item = items[i];
        size_t j = i;
        for (; j && ktree_before(&k->tree, item, items[j - 1]); j--) items[j] = items[j - 1];
        items[j] = item;
    }
}

/* ------------------------------------------------------------------ growth -- */

/* A subtree is to be made of those of a part of the list that reach into its cell. */
static void push_task(froe_kinetic *k, surgery_task task) {
    const size_t first = task.first, end = first + task.count;
    task.first = k->tree.list.count, task.count = 0;
    if (!call_reserve(&k->call, &k->tree.list, end - first)) return;
    uint32_t *list = k->tree.list.data, ends[2];
    for (size_t i = first; i < end; i++)
        if (surgery_clip(k, list[i], &task.cell, ends)) list[k->tree.list.count++] = list[i], task.count++;
    if (task.count) call_push(&k->call, &k->surgery.tasks, task);
}

static void grow_node(froe_kinetic *k, const surgery_task *task) {
    uint32_t end[2], segment = k->tree.list.data[task->first];
    k->tree.list.count = task->first + task->count;
    if (!surgery_clip(k, segment, &task->cell, end)) return;
    uint32_t node = ktree_new_node(&k->tree, segment, end);
    ktree_attach(&k->tree, task->parent, task->slot, node);
    k->counts.nodes_touched++;
    for (int side = 0; side < 2 && node; side++)
        if (ktree_is_end(end[side])) ktree_touch_end(&k->tree, 2 * segment + (KTREE_END_0 - end[side]));
    for (int slot = 0; slot < 4 && node && task->count > 1; slot++) {
        if (slot < KTREE_UP && end[slot] == KTREE_NO_WALL) continue;
        const ktree_cell cell = ktree_child_cell(&k->tree, &task->cell, node, slot);
        push_task(k, (surgery_task){cell, task->first + 1, task->count - 1, node, (uint8_t)slot});
    }
}

void surgery_grow(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot) {
    ktree_attach(&k->tree, parent, slot, KTREE_LEAF);
    sort_list(k);
    const size_t waiting = k->surgery.tasks.count;
    push_task(k, (surgery_task){*cell, 0, k->tree.list.count, parent, slot});
    while (k->surgery.tasks.count > waiting) {
        const surgery_task task = k->surgery.tasks.data[--k->surgery.tasks.count];
        if (!k->call.stopped) grow_node(k, &task);
        call_poll(&k->call);
    }
    k->tree.list.count = 0;
}
