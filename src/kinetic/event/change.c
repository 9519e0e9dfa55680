/* change.c: segments enter and leave a partition in motion. */
#include "kinetic/event/change.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/event/triangle.h"
#include "kinetic/kinetic.h"

static void push_insertion(froe_kinetic *k, const ktree_cell *cell, uint32_t parent, uint8_t slot) {
    call_push(&k->call, &k->surgery.tasks, (surgery_task){*cell, 0, 0, parent, slot});
}

static void insert_below(froe_kinetic *k, uint32_t segment, const surgery_task *at) {
    ktree *tree = &k->tree;
    uint32_t node = ktree_node_at(tree, at->parent)->child[at->slot];
    if (node && ktree_is_part(tree, node, segment)) return; /* it is there already */
    if (!node || ktree_before(tree, segment, ktree_node_at(tree, node)->segment)) {
        ktree_new_list(tree);
        ktree_list(tree, segment);
        ktree_collect(tree, node);
        surgery_free_tree(k, node);
        surgery_grow(k, &at->cell, at->parent, at->slot);
        return;
    }
    ktree_node_at(tree, node)->stamp = tree->stamp;
    for (uint8_t slot = 0; slot < 4; slot++) {
        if (slot < KTREE_UP && ktree_node_at(tree, node)->wall[slot] == KTREE_NO_WALL) continue;
        ktree_cell cell = ktree_child_cell(tree, &at->cell, node, slot);
        if (surgery_reaches(k, segment, &cell)) push_insertion(k, &cell, node, slot);
    }
}

static void touch_walls(ktree *tree, const ktree_cell *cell) {
    for (int side = 0; side < 2; side++) ktree_touch_wall(tree, cell->wall[side]);
}

static void touch_nodes(froe_kinetic *k, uint32_t segment) {
    uint32_t n = ktree_segment_at(&k->tree, segment)->nodes;
    for (; n && !k->call.stopped; n = ktree_node_at(&k->tree, n)->next) {
        ktree_cell cell = ktree_cell_of(&k->tree, n);
        touch_walls(&k->tree, &cell);
    }
}

void change_put_in(froe_kinetic *k, uint32_t segment) {
    const ktree_site all = {KTREE_ROOT, 0, false, ktree_plane()};
    size_t waiting = k->surgery.tasks.count;
    surgery_begin(k);
    push_insertion(k, &all.cell, KTREE_ROOT, 0);
    while (k->surgery.tasks.count > waiting) {
        surgery_task task = k->surgery.tasks.data[--k->surgery.tasks.count];
        insert_below(k, segment, &task);
    }
    touch_nodes(k, segment);
    for (int i = 0; i < 3 && now_is_surface(&k->now, segment); i++)
        touch_nodes(k, now_face_of(&k->now, segment)->edge[i]);
    certify_site(k, &all);
}

void change_make_anew(froe_kinetic *k, uint32_t node, uint32_t without) {
    ktree *tree = &k->tree;
    const ktree_site site = ktree_site_of(tree, node);
    surgery_begin(k);
    ktree_new_list(tree);
    if (without != FROE_NONE) ktree_segment_at(tree, without)->stamp = tree->list_stamp; /* keeps it off the list */
    ktree_collect(tree, node);
    surgery_free_tree(k, node);
    surgery_grow(k, &site.cell, site.parent, site.slot);
    touch_walls(tree, &site.cell);
    certify_site(k, &site);
}

void change_enroll(froe_kinetic *k, uint32_t segment) {
    ktree_segment *s = ktree_segment_at(&k->tree, segment);
    const uint32_t *v = k->now.segments.data[segment].end;
    for (uint32_t i = 0; i < 2 && !s->alive; i++) { /* enters it in the lists of its vertices, from the last on */
        uint32_t *at = k->tree.vertices.data + v[i];
        while (*at != FROE_NONE && *at > 2 * segment + i) at = &ktree_segment_at(&k->tree, *at / 2)->end[*at % 2].next;
        s->end[i].next = *at;
        *at = 2 * segment + i;
    }
    if (!s->alive) s->bound = false;
    s->alive = true;
    if (s->here || !now_compare(&k->now, (name_point){v[0], NAME_VERTEX}, (name_point){v[1], NAME_VERTEX})) return;
    s->here = true;
    certify_turn(k, segment);
}

void change_insert(froe_kinetic *k, uint32_t segment) {
    if (now_is_surface(&k->now, segment)) {
        triangle_insert(k, segment);
        return;
    }
    change_enroll(k, segment);
    if (ktree_segment_at(&k->tree, segment)->here) change_put_in(k, segment);
}

void change_unroll(froe_kinetic *k, uint32_t segment) {
    ktree_segment *s = ktree_segment_at(&k->tree, segment);
    for (uint32_t i = 0; i < 2 && s->alive && !now_is_surface(&k->now, segment); i++) {
        uint32_t *at = k->tree.vertices.data + k->now.segments.data[segment].end[i];
        while (*at != 2 * segment + i) at = &ktree_segment_at(&k->tree, *at / 2)->end[*at % 2].next;
        *at = s->end[i].next;
    }
    s->alive = s->here = s->stays = false;
    cert_forget(&k->certs, &k->certs.segments.data[segment].turn);
}

void change_remove(froe_kinetic *k, uint32_t segment) {
    const ktree_segment *s = ktree_segment_at(&k->tree, segment);
    const bool here = s->here;
    if (now_is_surface(&k->now, segment)) {
        if (here) triangle_remove(k, segment);
        return;
    }
    change_unroll(k, segment);
    if (!here) return;
    while (s->nodes && !k->call.stopped) change_make_anew(k, s->nodes, segment);
    collinear_find_partners(k, segment);
    collinear_forget(k, segment);
    for (size_t i = 0; i < k->collinear.partners.count; i++) change_put_in(k, k->collinear.partners.data[i]);
}

/* ---------------------------------------------------------------- schedule -- */

/* The first odd tick from `tick` on. */
static int64_t odd(int64_t tick) {
    return tick >= MOTION_FAR ? NOW_NEVER : tick | 1;
}

static void schedule(froe_kinetic *k, uint32_t *cert, cert_kind kind, uint32_t owner, int64_t tick) {
    if (tick > now_last_tick(&k->now)) tick = NOW_NEVER;
    if (*cert == FROE_NONE)
        *cert = cert_new(&k->certs, kind, owner, tick, NULL);
    else
        cert_set_tick(&k->certs, *cert, tick);
}

void change_schedule(froe_kinetic *k, uint32_t segment) {
    const uint32_t object = now_object_of(&k->now, segment);
    const motion_object *o = k->now.motion->objects.data + object;
    const bool there = now_is_alive(&k->now, object);
    int64_t change = NOW_NEVER;
    if (o->first <= o->last && k->now.tick < o->first) change = odd(o->first);
    if (there && o->last < k->now.motion->last_tick) change = odd(o->last + 1);
    schedule(k, &k->certs.segments.data[segment].life, CERT_LIFE, segment, change);
    for (int i = 0; i < k->now.motion->dim; i++) {
        uint32_t *course = k->certs.courses.data + o->vertices[i];
        if (there)
            schedule(k, course, CERT_COURSE, o->vertices[i], odd(now_course_last(&k->now, o->vertices[i]) + 1));
        else if (*course != FROE_NONE && k->certs.all.data[*course].tick <= k->now.tick) /* ranges have passed it */
            cert_set_tick(&k->certs, *course, NOW_NEVER);
    }
}
