/* change.c: segments enter and leave a live partition, and with them changes of flight plans.
 *
 * Where a segment comes before the one that cuts a cell, everything in that cell is made anew; with random keys that
 * is O(log^2 n) nodes on average. All nodes of a segment that leaves are made anew without it. Segments in one line
 * with it may come into the tree then. */
#include "kinetic/live.h"

static void push_insertion(froe_kinetic *k, const live_cell *cell, uint32_t parent, uint8_t slot) {
    live_task task = {*cell, 0, 0, parent, slot};
    if (!array_push(&k->alloc, &k->tasks, task)) k->short_of_memory = true;
}

static void insert_below(froe_kinetic *k, uint32_t segment, const live_task *at) {
    uint32_t node = node_at(k, at->parent)->child[at->slot], end[2];
    if (node && node_at(k, node)->segment == segment) return; /* it is there already */
    if (!node || comes_before(k, segment, node_at(k, node)->segment)) {
        live_new_list(k);
        live_list(k, segment);
        live_collect(k, node);
        live_free_tree(k, node);
        live_grow(k, &at->cell, 0, at->parent, at->slot);
        return;
    }
    node_at(k, node)->stamp = k->stamp;
    for (uint8_t slot = 0; slot < 4; slot++) {
        if (slot < UP && node_at(k, node)->wall[slot] == END_NONE) continue;
        live_cell cell = live_child_cell(k, &at->cell, node, slot);
        if (live_clip(k, segment, &cell, end)) push_insertion(k, &cell, node, slot);
    }
}

static void touch_walls(froe_kinetic *k, const live_cell *cell) {
    for (int side = 0; side < 2; side++) live_touch_wall(k, cell->wall[side]);
}

static void insert_nodes(froe_kinetic *k, uint32_t segment) {
    const live_site all = {ROOT, 0, false, live_plane()};
    size_t waiting = k->tasks.count;
    k->stamp++;
    push_insertion(k, &all.cell, ROOT, 0);
    while (k->tasks.count > waiting) {
        live_task task = k->tasks.data[--k->tasks.count];
        insert_below(k, segment, &task);
    }
    for (uint32_t n = segment_at(k, segment)->nodes; n && !k->short_of_memory; n = node_at(k, n)->next) {
        live_cell cell = live_cell_of(k, n);
        touch_walls(k, &cell);
    }
    live_certify(k, &all);
}

/* Enters it in the lists of its vertices. */
static void link_ends(froe_kinetic *k, uint32_t segment) {
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t *first = k->vertices.data + k->now.segments.data[segment].end[i];
        segment_at(k, segment)->end[i].next = *first;
        *first = 2 * segment + i;
    }
}

static void unlink_ends(froe_kinetic *k, uint32_t segment) {
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t *at = k->vertices.data + k->now.segments.data[segment].end[i];
        while (*at != 2 * segment + i) at = &segment_at(k, *at / 2)->end[*at % 2].next;
        *at = segment_at(k, segment)->end[i].next;
    }
}

void live_enroll(froe_kinetic *k, uint32_t segment) {
    live_segment *s = segment_at(k, segment);
    const uint32_t *v = k->now.segments.data[segment].end;
    if (!s->alive) link_ends(k, segment), s->bound = false;
    s->alive = true;
    if (s->here || !now_compare(&k->now, (now_name){v[0], NAME_VERTEX}, (now_name){v[1], NAME_VERTEX})) return;
    s->here = true;
    live_certify_turn(k, segment);
}

void live_insert(froe_kinetic *k, uint32_t segment) {
    live_enroll(k, segment);
    if (segment_at(k, segment)->here) insert_nodes(k, segment);
}

static void remove_nodes(froe_kinetic *k, uint32_t segment) {
    while (segment_at(k, segment)->nodes && !k->short_of_memory) {
        uint32_t node = segment_at(k, segment)->nodes;
        const live_site site = live_site_of(k, node);
        k->stamp++;
        live_new_list(k);
        segment_at(k, segment)->stamp = k->list_stamp; /* keeps it off the list */
        live_collect(k, node);
        live_free_tree(k, node);
        live_grow(k, &site.cell, 0, site.parent, site.slot);
        touch_walls(k, &site.cell);
        live_certify(k, &site);
    }
}

void live_unroll(froe_kinetic *k, uint32_t segment) {
    live_segment *s = segment_at(k, segment);
    if (s->alive) unlink_ends(k, segment);
    s->alive = s->here = false;
    live_forget_turn(k, segment);
}

void live_remove(froe_kinetic *k, uint32_t segment) {
    bool here = segment_at(k, segment)->here;
    live_unroll(k, segment);
    if (!here) return;
    remove_nodes(k, segment);
    live_partners(k, segment);
    size_t first = k->roots.count, count = k->order.count;
    if (!array_reserve(&k->alloc, &k->roots, count)) {
        k->short_of_memory = true;
        count = 0;
    }
    for (size_t i = 0; i < count; i++) k->roots.data[k->roots.count++] = k->order.data[i];
    live_forget_pairs(k, segment);
    for (size_t i = first; i < first + count; i++) insert_nodes(k, k->roots.data[i]);
    k->roots.count = first;
}

/* ---------------------------------------------------------------- schedule -- */

/* The first odd tick from `tick` on. */
static int64_t odd(int64_t tick) {
    return tick >= MOTION_FAR ? NOW_NEVER : tick | 1;
}

static void schedule(froe_kinetic *k, uint32_t *cert, cert_kind kind, uint32_t owner, int64_t tick) {
    if (tick > live_last_tick(k)) tick = NOW_NEVER;
    if (*cert == CERT_NONE)
        *cert = live_new_cert(k, kind, owner, tick, NULL);
    else
        live_set_tick(k, *cert, tick);
}

void live_schedule(froe_kinetic *k, uint32_t segment) {
    const motion_object *o = k->now.motion->objects.data + segment;
    int64_t now = k->now.tick, change = NOW_NEVER;
    bool there = o->first <= now && now <= o->last;
    if (o->first <= o->last && now < o->first) change = odd(o->first);
    if (there && o->last < k->now.motion->last_tick) change = odd(o->last + 1);
    schedule(k, &segment_at(k, segment)->life, CERT_LIFE, segment, change);
    for (int i = 0; i < 2 && there; i++) {
        int64_t last = now_course_last(&k->now, o->vertices[i]);
        schedule(k, k->courses.data + o->vertices[i], CERT_COURSE, o->vertices[i], odd(last + 1));
    }
}
