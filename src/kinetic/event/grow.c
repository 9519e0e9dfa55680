/* grow.c: the partition of some segments in a cell, from scratch: the definition of the tree, with which all updates
 * agree. The first segment in order cuts the cell; each part gets those of the others that reach into it.
 *
 * Cells are open, walls are points in the order of x + eps y: an end on a wall needs none of its own, and what lies in
 * the line of an edge, touches it or ends on it from outside is not in the cell. This covers shared ends, ends on
 * segments, vertical segments, segments in one line, and many crossings in one point. */
#include "base/sort.h"
#include "kinetic/event/surgery.h"
#include "kinetic/kinetic.h"

int surgery_order(ktree *tree, name_point p, name_point q) {
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
    if (ktree_is_end(end[out]) || (surgery_order(&k->tree, cut, at[out]) > 0) == (out == KTREE_LEFT)) {
        at[out] = cut;
        end[out] = border;
    }
    return true;
}

/* Past which border the segment leaves the cell at an end that is no vertex of it. */
static surgery_way way_past(const ktree_cell *cell, uint32_t end) {
    return ktree_is_end(end) ? SURGERY_BESIDE : end == cell->top ? SURGERY_ABOVE : SURGERY_BELOW;
}

surgery_way surgery_find(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]) {
    now_state *now = &k->now;
    name_point at[2];
    for (int i = 0; i < 2; i++) {
        at[i] = (name_point){now_vertex(now, segment, i), NAME_VERTEX};
        end[i] = KTREE_END_0 - (uint32_t)now_end(now, segment, i);
    }
    const name_point left = cell->wall[KTREE_LEFT], right = cell->wall[KTREE_RIGHT];
    if (name_exists(left) && surgery_order(&k->tree, at[KTREE_RIGHT], left) <= 0) return SURGERY_BESIDE;
    if (name_exists(right) && surgery_order(&k->tree, at[KTREE_LEFT], right) >= 0) return SURGERY_BESIDE;
    if (cell->top != FROE_NONE && !clip_border(k, segment, cell->top, -1, at, end)) return SURGERY_ABOVE;
    if (cell->bottom != FROE_NONE && !clip_border(k, segment, cell->bottom, 1, at, end)) return SURGERY_BELOW;
    const bool cut = !ktree_is_end(end[KTREE_LEFT]) || !ktree_is_end(end[KTREE_RIGHT]);
    /* of a part that ends before the left wall, or begins after the right one, the rest went past a border */
    if (cut && name_exists(left) && surgery_order(&k->tree, at[KTREE_RIGHT], left) <= 0)
        return way_past(cell, end[KTREE_RIGHT]);
    if (cut && name_exists(right) && surgery_order(&k->tree, at[KTREE_LEFT], right) >= 0)
        return way_past(cell, end[KTREE_LEFT]);
    if (cut && surgery_order(&k->tree, at[KTREE_LEFT], at[KTREE_RIGHT]) >= 0) return way_past(cell, end[KTREE_LEFT]);
    for (int side = 0; side < 2; side++) {
        const name_point wall = cell->wall[side];
        if (!name_exists(wall) || surgery_order(&k->tree, at[side], wall) * (side ? -1 : 1) > 0) continue;
        at[side] = wall, end[side] = KTREE_NO_WALL;
    }
    return SURGERY_INSIDE;
}

bool surgery_clip(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]) {
    return surgery_find(k, segment, cell, end) == SURGERY_INSIDE;
}

/* Does a triangle meet a cell? Either an edge reaches into it, as seen from above, or the triangle spans it: then edges
 * pass above and below. Triangles are disjoint, so that one comparison with ceiling and floor each is enough. */
static bool triangle_meets(froe_kinetic *k, uint32_t surface, const ktree_cell *cell) {
    const uint32_t object = k->now.segments.data[surface].origin;
    const now_face *f = k->now.faces.data + object;
    uint32_t end[2];
    bool passes[4] = {false, false, false, false};
    if (surface == cell->ceiling || surface == cell->floor) return false;
    for (int i = 0; i < 3 && !passes[SURGERY_INSIDE]; i++)
        if (ktree_segment_at(&k->tree, f->edge[i])->here) passes[surgery_find(k, f->edge[i], cell, end)] = true;
    const bool closed = name_exists(cell->wall[KTREE_LEFT]) && name_exists(cell->wall[KTREE_RIGHT]);
    if (!passes[SURGERY_INSIDE] && !(closed && passes[SURGERY_ABOVE] && passes[SURGERY_BELOW])) return false;
    if (cell->ceiling != FROE_NONE && now_above(&k->now, object, k->now.segments.data[cell->ceiling].origin) >= 0)
        return false;
    return cell->floor == FROE_NONE || now_above(&k->now, object, k->now.segments.data[cell->floor].origin) > 0;
}

bool surgery_reaches(froe_kinetic *k, uint32_t segment, const ktree_cell *cell) {
    uint32_t end[2];
    if (now_is_surface(&k->now, segment)) return triangle_meets(k, segment, cell);
    return surgery_clip(k, segment, cell, end);
}

/* What cuts a cell that an object meets: of a triangle its first edge that reaches into it, and where that ends, or
 * else its surface. */
static uint32_t first_cut(froe_kinetic *k, uint32_t segment, const ktree_cell *cell, uint32_t end[2]) {
    if (now_is_surface(&k->now, segment)) {
        const now_face *f = k->now.faces.data + k->now.segments.data[segment].origin;
        for (int i = 0; i < 3; i++)
            if (ktree_segment_at(&k->tree, f->edge[i])->here && surgery_clip(k, f->edge[i], cell, end))
                return f->edge[i];
        end[0] = end[1] = KTREE_NO_WALL;
        return segment;
    }
    return surgery_clip(k, segment, cell, end) ? segment : FROE_NONE;
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
    uint32_t *list = k->tree.list.data;
    for (size_t i = first; i < end; i++)
        if (surgery_reaches(k, list[i], &task.cell)) list[k->tree.list.count++] = list[i], task.count++;
    if (task.count) call_push(&k->call, &k->surgery.tasks, task);
}

static void grow_node(froe_kinetic *k, const surgery_task *task) {
    uint32_t end[2];
    const uint32_t first = k->tree.list.data[task->first], segment = first_cut(k, first, &task->cell, end);
    const size_t done = segment == first; /* a triangle goes on until its surface has cut */
    k->tree.list.count = task->first + task->count;
    if (segment == FROE_NONE) return;
    uint32_t node = ktree_new_node(&k->tree, segment, end);
    ktree_attach(&k->tree, task->parent, task->slot, node);
    k->counts.nodes_touched++;
    for (int side = 0; side < 2 && node; side++)
        if (ktree_is_end(end[side])) ktree_touch_end(&k->tree, 2 * segment + (KTREE_END_0 - end[side]));
    for (int slot = 0; slot < 4 && node && task->count > done; slot++) {
        if (slot < KTREE_UP && end[slot] == KTREE_NO_WALL) continue;
        const ktree_cell cell = ktree_child_cell(&k->tree, &task->cell, node, slot);
        push_task(k, (surgery_task){cell, task->first + done, task->count - done, node, (uint8_t)slot});
    }
}

static void grow_in_space(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot) {
    const size_t waiting = k->surgery.tasks.count;
    push_task(k, (surgery_task){*cell, 0, k->tree.list.count, parent, slot});
    while (k->surgery.tasks.count > waiting) {
        const surgery_task task = k->surgery.tasks.data[--k->surgery.tasks.count];
        if (!k->call.stopped) grow_node(k, &task);
        call_poll(&k->call);
    }
}

void surgery_grow(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot) {
    ktree_attach(&k->tree, parent, slot, KTREE_LEAF);
    sort_list(k);
    if (now_is_in_space(&k->now))
        grow_in_space(k, cell, parent, slot);
    else
        surgery_grow_plane(k, cell, parent, slot);
    k->tree.list.count = 0;
}
