/* triangle.c: triangles enter and leave a partition in space. */
#include "kinetic/event/triangle.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/event/change.h"
#include "kinetic/kinetic.h"

/* The place of an edge in the order, of those of its triangles that are there; UINT64_MAX: there is none. */
static uint64_t key_of_edge(const froe_kinetic *k, uint32_t edge) {
    const now_state *now = &k->now;
    uint64_t key = UINT64_MAX;
    for (uint32_t c = now->segments.data[edge].origin; c != FROE_NONE; c = now_next_corner(now, c)) {
        const ktree_segment *surface = ktree_segment_at(&k->tree, now->faces.data[c / 3].surface);
        const uint64_t own = surface->key - 3 + c % 3;
        if (surface->here && own < key) key = own;
    }
    return key;
}

static void set_keys(froe_kinetic *k, uint32_t surface) {
    const uint32_t *edge = now_face_of(&k->now, surface)->edge;
    for (int i = 0; i < 3; i++) ktree_segment_at(&k->tree, edge[i])->key = key_of_edge(k, edge[i]);
}

static void enroll(froe_kinetic *k, uint32_t surface) {
    ktree_segment *s = ktree_segment_at(&k->tree, surface);
    s->alive = s->here = true;
    certify_flop(k, surface);
    for (int i = 0; i < 3; i++) change_enroll(k, now_face_of(&k->now, surface)->edge[i]);
}

void triangle_enroll_all(froe_kinetic *k) {
    const now_state *now = &k->now;
    for (uint32_t s = 0; s < k->tree.segments.count; s++) {
        collinear_forget(k, s);
        for (int i = 0; i < 4; i++) cert_forget(&k->certs, &k->certs.segments.data[s].end[i / 2][i % 2]);
        change_unroll(k, s);
        call_poll(&k->call);
    }
    for (uint32_t o = 0; o < now->faces.count; o++) {
        change_schedule(k, now->faces.data[o].surface);
        if (now_is_alive(now, o)) enroll(k, now->faces.data[o].surface);
        call_poll(&k->call);
    }
    for (uint32_t o = 0; o < now->faces.count; o++) set_keys(k, now->faces.data[o].surface);
}

/* While the tree changes, edges that it has already keep their places: it is found where the triangle comes first. */
void triangle_insert(froe_kinetic *k, uint32_t surface) {
    enroll(k, surface);
    change_put_in(k, surface);
    set_keys(k, surface);
}

/* Is no node above this one of the same triangle? */
static bool is_topmost(const ktree *tree, uint32_t surface, uint32_t node) {
    for (uint32_t n = ktree_node_at(tree, node)->parent; n != KTREE_ROOT; n = ktree_node_at(tree, n)->parent)
        if (ktree_is_part(tree, n, surface)) return false;
    return true;
}

/* Lists the topmost nodes of the triangle, as events.roots. */
static void find_topmost(froe_kinetic *k, uint32_t surface) {
    const ktree *tree = &k->tree;
    const uint32_t *edge = now_face_of(&k->now, surface)->edge;
    k->events.roots.count = 0;
    for (int i = 0; i < 4; i++) {
        uint32_t n = ktree_segment_at(tree, i < 3 ? edge[i] : surface)->nodes;
        for (; n && ktree_is_part(tree, n, surface); n = ktree_node_at(tree, n)->next)
            if (is_topmost(tree, surface, n)) call_push(&k->call, &k->events.roots, n);
    }
}

/* An edge of no triangle any more. What is in one line with it may come to cut. */
static void drop_edge(froe_kinetic *k, uint32_t edge) {
    const now_state *now = &k->now;
    collinear_find_partners(k, edge);
    collinear_forget(k, edge);
    for (size_t i = 0; i < k->collinear.partners.count; i++) {
        const uint32_t partner = k->collinear.partners.data[i];
        for (uint32_t c = now->segments.data[partner].origin; c != FROE_NONE; c = now_next_corner(now, c)) {
            const uint32_t surface = now->faces.data[c / 3].surface;
            if (ktree_segment_at(&k->tree, surface)->here) change_put_in(k, surface);
        }
    }
}

void triangle_remove(froe_kinetic *k, uint32_t surface) {
    const uint32_t *edge = now_face_of(&k->now, surface)->edge;
    bool dropped[3];
    find_topmost(k, surface);
    change_unroll(k, surface);
    for (int i = 0; i < 3; i++) {
        dropped[i] = key_of_edge(k, edge[i]) == UINT64_MAX;
        if (dropped[i]) change_unroll(k, edge[i]);
    }
    set_keys(k, surface);
    /* none is below another, so each lasts until its own turn */
    for (size_t i = 0; i < k->events.roots.count && !k->call.stopped; i++)
        change_make_anew(k, k->events.roots.data[i], FROE_NONE);
    for (int i = 0; i < 3; i++)
        if (dropped[i]) drop_edge(k, edge[i]);
}
