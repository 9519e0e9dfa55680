/* grow.c: the partition of some segments in a cell, from scratch: the definition of the tree, with which all updates
 * agree. The first segment in order cuts the cell; each part gets those of the others that reach into it.
 *
 * Cells are open, walls are points in the order of x + eps y: an end on a wall needs none of its own, and what lies in
 * the line of an edge, touches it or ends on it from outside is not in the cell. This covers shared ends, ends on
 * segments, vertical segments, segments in one line, and many crossings in one point. */
#include "base/sort.h"
#include "kinetic/live.h"

/* The order of two points; if they coincide, their segments are bound to each other. */
static int order_of(froe_kinetic *k, now_name p, now_name q) {
    const int order = now_compare(&k->now, p, q);
    if (!order) live_bind(k, p, q);
    return order;
}

/* On which side of a border the ends are, > 0 being inside. */
static bool clip_border(froe_kinetic *k, uint32_t segment, uint32_t border, int inside, now_name at[2],
                        uint32_t end[2]) {
    int side[2];
    if (segment == border) return false;
    for (int i = 0; i < 2; i++) {
        const uint32_t vertex = now_vertex(&k->now, segment, i);
        side[i] = now_side(&k->now, border, vertex) * inside;
        const now_name crossing = name_crossing(segment, border);
        if (!side[i]) live_bind(k, crossing, crossing);
    }
    if (!side[0] && !side[1]) live_watch_pair(k, border, segment);
    if (side[0] <= 0 && side[1] <= 0) return false;
    if (side[0] >= 0 && side[1] >= 0) return true;
    int out = side[0] < 0 ? LEFT : RIGHT;
    now_name cut = name_crossing(segment, border);
    if (is_end(end[out]) || (order_of(k, cut, at[out]) > 0) == (out == LEFT)) {
        at[out] = cut;
        end[out] = border;
    }
    return true;
}

bool live_clip(froe_kinetic *k, uint32_t segment, const live_cell *cell, uint32_t end[2]) {
    now_state *now = &k->now;
    now_name at[2];
    for (int i = 0; i < 2; i++) {
        at[i] = (now_name){now_vertex(now, segment, i), NAME_VERTEX};
        end[i] = END_0 - (uint32_t)now_end(now, segment, i);
    }
    const now_name *wall = cell->wall;
    if (name_exists(wall[LEFT]) && order_of(k, at[RIGHT], wall[LEFT]) <= 0) return false;
    if (name_exists(wall[RIGHT]) && order_of(k, at[LEFT], wall[RIGHT]) >= 0) return false;
    if (cell->top != FROE_NONE && !clip_border(k, segment, cell->top, -1, at, end)) return false;
    if (cell->bottom != FROE_NONE && !clip_border(k, segment, cell->bottom, 1, at, end)) return false;
    if ((!is_end(end[LEFT]) || !is_end(end[RIGHT])) && order_of(k, at[LEFT], at[RIGHT]) >= 0) return false;
    bool on_wall = false;
    if (name_exists(wall[LEFT]) && order_of(k, at[LEFT], wall[LEFT]) <= 0)
        at[LEFT] = wall[LEFT], end[LEFT] = END_NONE, on_wall = true;
    if (name_exists(wall[RIGHT]) && order_of(k, at[RIGHT], wall[RIGHT]) >= 0)
        at[RIGHT] = wall[RIGHT], end[RIGHT] = END_NONE, on_wall = true;
    return !on_wall || order_of(k, at[LEFT], at[RIGHT]) < 0;
}

/* ------------------------------------------------------------------- order -- */

static int by_key(void *user, uint32_t a, uint32_t b) {
    const froe_kinetic *k = user;
    return comes_before(k, a, b) ? -1 : comes_before(k, b, a);
}

static void sort_list(froe_kinetic *k, size_t first) {
    enum { FEW = 24 };
    uint32_t *items = k->list.data + first;
    size_t count = k->list.count - first;
    if (count > FEW) {
        k->order.count = 0;
        if (array_reserve(&k->alloc, &k->order, count))
            base_merge_sort(items, k->order.data, count, by_key, k);
        else
            k->short_of_memory = true;
        return;
    }
    for (size_t i = 1; i < count; i++) {
        uint32_t item = items[i];
        size_t j = i;
        for (; j && comes_before(k, item, items[j - 1]); j--) items[j] = items[j - 1];
        items[j] = item;
    }
}

/* ------------------------------------------------------------------ growth -- */

/* Appends those of a list that reach into a cell. */
static size_t deal(froe_kinetic *k, size_t first, size_t count, const live_cell *cell) {
    size_t kept = 0;
    if (!array_reserve(&k->alloc, &k->list, count)) {
        k->short_of_memory = true;
        return 0;
    }
    for (size_t i = first; i < first + count; i++) {
        uint32_t end[2];
        if (live_clip(k, k->list.data[i], cell, end)) k->list.data[k->list.count++] = k->list.data[i], kept++;
    }
    return kept;
}

static void push_task(froe_kinetic *k, const live_task *task) {
    if (task->count && !array_push(&k->alloc, &k->tasks, *task)) k->short_of_memory = true;
}

static void grow_node(froe_kinetic *k, const live_task *task) {
    uint32_t end[2], segment = k->list.data[task->first];
    k->list.count = task->first + task->count;
    if (!live_clip(k, segment, &task->cell, end)) return;
    uint32_t node = live_new_node(k, segment, end);
    live_attach(k, task->parent, task->slot, node);
    k->counts.nodes_touched++;
    for (int side = 0; side < 2 && node; side++)
        if (is_end(end[side])) live_touch_end(k, 2 * segment + (END_0 - end[side]));
    for (int slot = 0; slot < 4 && node && task->count > 1; slot++) {
        if (slot < UP && end[slot] == END_NONE) continue;
        live_task child = {live_child_cell(k, &task->cell, node, slot), k->list.count, 0, node, (uint8_t)slot};
        child.count = deal(k, task->first + 1, task->count - 1, &child.cell);
        push_task(k, &child);
    }
}

void live_grow(froe_kinetic *k, const live_cell *cell, size_t first, uint32_t parent, uint8_t slot) {
    live_attach(k, parent, slot, LEAF);
    sort_list(k, first);
    live_task task = {*cell, k->list.count, 0, parent, slot};
    task.count = deal(k, first, k->list.count - first, cell);
    size_t waiting = k->tasks.count;
    push_task(k, &task);
    while (k->tasks.count > waiting) {
        task = k->tasks.data[--k->tasks.count];
        if (!k->short_of_memory) grow_node(k, &task);
        live_poll(k);
    }
    k->list.count = first;
}
