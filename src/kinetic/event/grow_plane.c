/* grow_plane.c: the partition of some segments in a cell of the plane, from scratch. It is what grow.c would make of
 * them. A part of a segment is known by where it ends in its cell, so in each part of that cell only what is new is
 * looked at: the segment that cuts it, and the walls at its ends.
 *
 *      :      :  .'  :                 The first segment s in order cuts the cell. A part of another one is compared
 *      :    a :-----s--: b             with the walls at a and b, if there are any; if it reaches in between, its
 *      :  ----:------- :               segment's ends are above or below s. That tells all four parts of the cell. */
#include "kinetic/event/surgery.h"
#include "kinetic/kinetic.h"

/* A wall of the node that cuts. */
typedef struct new_wall {
    name_point name; /* NAME_NONE: there is none */
    now_spot spot;
} new_wall;

/* A node, and what there is to know of it to cut parts by it. */
typedef struct cutter {
    uint32_t segment;
    const ktree_cell *cell;
    new_wall wall[2];
    now_spot end[2]; /* of its segment */
} cutter;

static name_point name_of_end(const ktree *tree, const surgery_part *p, const ktree_cell *cell, int side) {
    return p->end[side] == KTREE_NO_WALL ? cell->wall[side] : ktree_wall_name(tree, p->segment, p->end[side]);
}

/* The order of an end of a part and a wall inside of its cell: -1, 0, 1. */
static int order_at(froe_kinetic *k, const surgery_part *p, int side, const new_wall *wall) {
    if (p->end[side] == KTREE_NO_WALL) return side ? 1 : -1;
    const double d = p->at[side].x - wall->spot.x;
    const double error = (p->at[side].error + wall->spot.error + fabs(d) * 0x1p-52) * NUM_BALL_UP;
    if (fabs(d) > error) return d < 0 ? -1 : 1;
    return surgery_order(&k->tree, ktree_wall_name(&k->tree, p->segment, p->end[side]), wall->name);
}

/* On which side of the segment that cuts are the ends of another one? */
static void sides_of_part(froe_kinetic *k, const cutter *c, const surgery_part *p, int8_t side[2]) {
    const name_point cut = name_crossing(p->segment, c->segment);
    for (int i = 0; i < 2; i++) {
        int sign = now_side_of_spots(c->end[0], c->end[1], p->vertex[i]);
        if (sign == NUM_UNSURE) sign = now_side(&k->now, c->segment, now_vertex(&k->now, p->segment, i));
        side[i] = (int8_t)sign;
        if (!side[i]) turn_bind(&k->tree, cut, cut);
    }
    if (!side[0] && !side[1]) collinear_watch(k, c->segment, p->segment);
}

/* Lets a part end where its segment crosses the one that cuts, at the side that is out, unless it ends before. Where
 * three lines meet in one point the left end is at the top and the right one at the bottom. False: nothing is left. */
static bool cut_part(froe_kinetic *k, const cutter *c, surgery_part *p, int slot, int out) {
    ktree *tree = &k->tree;
    const name_point cut = name_crossing(p->segment, c->segment);
    const uint32_t old = p->end[out], replaced = slot == KTREE_UP ? c->cell->bottom : c->cell->top;
    if (old == KTREE_NO_WALL || (!ktree_is_end(old) && old != replaced)) {
        const int order = surgery_order(tree, cut, name_of_end(tree, p, c->cell, out));
        const bool first = (out == KTREE_LEFT) == (slot == KTREE_DOWN) && old != KTREE_NO_WALL;
        if ((out == KTREE_LEFT ? order : -order) < !first) return true;
    }
    p->end[out] = c->segment;
    p->at[out] = now_spot_of(&k->now, cut);
    return surgery_order(tree, name_of_end(tree, p, c->cell, KTREE_LEFT), name_of_end(tree, p, c->cell, KTREE_RIGHT)) <
           0;
}

/* -------------------------------------------------------------------- parts -- */

/* How the ends of a part lie to the walls of the node. A part has a length. */
static void compare_part(froe_kinetic *k, const cutter *c, const surgery_part *p, surgery_orders *out) {
    bool middle = true;
    for (int i = 0; i < 2; i++) {
        int8_t *order = out->order[i];
        if (!name_exists(c->wall[i].name)) continue;
        order[KTREE_LEFT] = (int8_t)order_at(k, p, KTREE_LEFT, c->wall + i);
        order[KTREE_RIGHT] = order[KTREE_LEFT] >= 0 ? 1 : (int8_t)order_at(k, p, KTREE_RIGHT, c->wall + i);
        middle = middle && (i == KTREE_LEFT ? order[KTREE_RIGHT] > 0 : order[KTREE_LEFT] < 0);
    }
    out->middle = middle;
    if (middle) sides_of_part(k, c, p, out->side);
}

/* What of a part is beyond a wall. */
static bool take_beyond(const surgery_orders *o, int slot, surgery_part *p) {
    const int8_t *order = o->order[slot];
    if (slot == KTREE_LEFT ? order[KTREE_LEFT] >= 0 : order[KTREE_RIGHT] <= 0) return false;
    if (slot == KTREE_LEFT ? order[KTREE_RIGHT] >= 0 : order[KTREE_LEFT] <= 0) p->end[1 - slot] = KTREE_NO_WALL;
    return true;
}

/* What of a part is on one side of the segment that cuts, between the walls. */
static bool take_middle(froe_kinetic *k, const cutter *c, const surgery_orders *o, int slot, surgery_part *p) {
    const int inside = slot == KTREE_UP ? 1 : -1, left = o->side[KTREE_LEFT] * inside,
              right = o->side[KTREE_RIGHT] * inside, out = left < 0 ? KTREE_LEFT : KTREE_RIGHT;
    const bool cut = left < 0 || right < 0;
    if (!o->middle || (left <= 0 && right <= 0) || (cut && !cut_part(k, c, p, slot, out))) return false;
    for (int i = 0; i < 2; i++) {
        int order[2] = {o->order[i][KTREE_LEFT], o->order[i][KTREE_RIGHT]};
        if (!name_exists(c->wall[i].name)) continue;
        if (cut) order[out] = order_at(k, p, out, c->wall + i);
        if (i == KTREE_LEFT ? order[KTREE_RIGHT] <= 0 : order[KTREE_LEFT] >= 0) return false;
        if (i == KTREE_LEFT ? order[KTREE_LEFT] <= 0 : order[KTREE_RIGHT] >= 0) p->end[i] = KTREE_NO_WALL;
    }
    return true;
}

/* -------------------------------------------------------------------- growth -- */

/* A subtree is to be made of what of the parts of a node is in one of its children. */
static void push_part_of_cell(froe_kinetic *k, const cutter *c, const surgery_task *task, uint32_t node, int slot) {
    surgery_work *work = &k->surgery;
    const size_t first = work->parts.count, count = task->count - 1;
    if (!call_reserve(&k->call, &work->parts, count)) return;
    for (size_t i = 0; i < count; i++) {
        surgery_part *p = work->parts.data + work->parts.count;
        *p = work->parts.data[task->first + 1 + i];
        const surgery_orders *o = work->orders.data + i;
        work->parts.count += slot < KTREE_UP ? take_beyond(o, slot, p) : take_middle(k, c, o, slot, p);
    }
    if (work->parts.count == first) return;
    const ktree_cell cell = ktree_child_cell(&k->tree, &task->cell, node, slot);
    call_push(&k->call, &work->tasks, (surgery_task){cell, first, work->parts.count - first, node, (uint8_t)slot});
}

static void grow_node(froe_kinetic *k, const surgery_task *task) {
    surgery_work *work = &k->surgery;
    work->parts.count = task->first + task->count;
    const surgery_part first = work->parts.data[task->first];
    const uint32_t node = ktree_new_node(&k->tree, first.segment, first.end);
    ktree_attach(&k->tree, task->parent, task->slot, node);
    k->counts.nodes_touched++;
    cutter c = {.segment = first.segment, .cell = &task->cell, .end = {first.vertex[0], first.vertex[1]}};
    for (int side = 0; side < 2 && node; side++) {
        const uint32_t end = first.end[side];
        if (ktree_is_end(end)) ktree_touch_end(&k->tree, 2 * first.segment + (KTREE_END_0 - end));
        c.wall[side] = (new_wall){ktree_wall_name(&k->tree, first.segment, end), first.at[side]}; /* or none */
    }
    work->orders.count = 0;
    if (task->count == 1 || !node || !call_reserve(&k->call, &work->orders, task->count - 1)) return;
    for (size_t i = 0; i + 1 < task->count; i++)
        compare_part(k, &c, work->parts.data + task->first + 1 + i, work->orders.data + i);
    for (int slot = 0; slot < 4; slot++)
        if (slot >= KTREE_UP || name_exists(c.wall[slot].name)) push_part_of_cell(k, &c, task, node, slot);
}

/* The parts of the segments on the list in a cell. */
static void find_parts(froe_kinetic *k, const ktree_cell *cell) {
    const ktree *tree = &k->tree;
    if (!call_reserve(&k->call, &k->surgery.parts, tree->list.count)) return;
    for (size_t i = 0; i < tree->list.count; i++) {
        surgery_part p = {.segment = tree->list.data[i]};
        if (surgery_find(k, p.segment, cell, p.end) != SURGERY_INSIDE) continue;
        for (int side = 0; side < 2; side++) {
            p.vertex[side] = p.at[side] = now_vertex_spot(&k->now, now_vertex(&k->now, p.segment, side));
            if (p.end[side] < KTREE_END_1) p.at[side] = now_spot_of(&k->now, name_crossing(p.segment, p.end[side]));
        }
        k->surgery.parts.data[k->surgery.parts.count++] = p;
    }
}

void surgery_grow_plane(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot) {
    surgery_work *work = &k->surgery;
    const size_t waiting = work->tasks.count;
    work->parts.count = 0;
    find_parts(k, cell);
    if (work->parts.count) call_push(&k->call, &work->tasks, (surgery_task){*cell, 0, work->parts.count, parent, slot});
    while (work->tasks.count > waiting) {
        const surgery_task task = work->tasks.data[--work->tasks.count];
        if (!k->call.stopped) grow_node(k, &task);
        call_poll(&k->call);
    }
}
