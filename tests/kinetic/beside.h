/* beside.h: a partition in motion beside the oracle of the present: the tree node for node, and what is next to points
 * and rays. The oracle is small: PRESENT_MOST segments. */
#ifndef FROE_TESTS_KINETIC_BESIDE_H
#define FROE_TESTS_KINETIC_BESIDE_H
#include "kinetic/kinetic.h"
#include "oracle/present.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct beside_counts {
    uint64_t trees, locates, rays, hits, orders, pairs, snapshots, alike;
} beside_counts;

enum { BESIDE_WORDS = 400 };

typedef struct beside {
    froe_motion *motion;
    froe_kinetic *kinetic;
    bool dead[PRESENT_MOST]; /**< taken out by froe_kinetic_remove() */
    beside_counts counts;
    char why[BESIDE_WORDS]; /**< what is wrong */
} beside;

#define BESIDE_FAIL(b, ...) (snprintf((b)->why, BESIDE_WORDS, __VA_ARGS__), false)

/** Where all is now. Clear it. */
static inline void beside_look(beside *b, present *p) {
    bool there[PRESENT_MOST];
    uint64_t key[PRESENT_MOST];
    const double now = froe_kinetic_time(b->kinetic);
    for (uint32_t s = 0; s < froe_motion_object_count(b->motion); s++) {
        const froe_moving_object o = froe_motion_object(b->motion, s);
        there[s] = !b->dead[s] && o.birth <= now && now <= o.death;
        key[s] = ktree_segment_at(&b->kinetic->tree, s)->key;
    }
    present_init(p, b->motion, now, there, key);
}

/** Are they the same, node for node? */
static inline bool beside_tree(beside *b, const present *p) {
    const froe_kinetic *k = b->kinetic;
    b->counts.trees++;
    const uint32_t root = ktree_node_at(&k->tree, KTREE_ROOT)->child[0];
    uint32_t live[4096];
    int made[4096], top = 0;
    if (!root != !p->node_count) return BESIDE_FAIL(b, "an empty tree, or none");
    if (root) live[top] = root, made[top++] = 0;
    while (top) {
        const ktree_node *n = ktree_node_at(&k->tree, live[--top]);
        const present_node *o = p->nodes + made[top];
        if (n->segment != o->segment || n->wall[0] != o->wall[0] || n->wall[1] != o->wall[1])
            return BESIDE_FAIL(b, "a node of segment %u with walls %x %x is one of segment %u with walls %x %x",
                               n->segment, n->wall[0], n->wall[1], o->segment, o->wall[0], o->wall[1]);
        for (int i = 0; i < 4; i++) {
            if (!n->child[i] != (o->child[i] < 0))
                return BESIDE_FAIL(b, "a node of segment %u has child %d, or not", n->segment, i);
            if (top == 4096) abort();
            if (n->child[i]) live[top] = n->child[i], made[top++] = o->child[i];
        }
    }
    return true;
}

/** What is asked of a point, */
static inline bool beside_locate(beside *b, present *p, const double at[2]) {
    froe_kinetic_place place;
    if (froe_kinetic_locate(b->kinetic, at, &place, NULL)) return BESIDE_FAIL(b, "locate");
    b->counts.locates++;
    bool on = false;
    for (uint32_t s = 0; s < p->count; s++) on |= present_is_on(p, s, at);
    if (on != (place.on != FROE_NONE) || (on && !present_is_on(p, place.on, at)))
        return BESIDE_FAIL(b, "%g %g lies on a segment: %d, on %d", at[0], at[1], on, (int)place.on);
    const uint32_t above = on ? place.on : present_next(p, at, 1), below = on ? place.on : present_next(p, at, -1);
    if (place.above != above || place.below != below)
        return BESIDE_FAIL(b, "%g %g has above and below it %d %d, not %d %d", at[0], at[1], (int)place.above,
                           (int)place.below, (int)above, (int)below);
    return true;
}

/** of a ray, */
static inline bool beside_ray(beside *b, present *p, const double from[2], const double to[2]) {
    uint32_t hit;
    bool first[PRESENT_MOST];
    if (froe_kinetic_ray(b->kinetic, from, to, &hit, NULL)) return BESIDE_FAIL(b, "ray");
    b->counts.rays++, b->counts.hits += hit != FROE_NONE;
    const bool some = present_ray(p, from, to, first);
    if (some != (hit != FROE_NONE) || (some && !first[hit]))
        return BESIDE_FAIL(b, "the ray from %g %g to %g %g meets a segment: %d, hits %d", from[0], from[1], to[0],
                           to[1], some, (int)hit);
    return true;
}

enum { BESIDE_FRAGMENTS = 4096 };

typedef struct beside_painting {
    uint32_t object[BESIDE_FRAGMENTS];
    double ends[BESIDE_FRAGMENTS][4];
    int count;
} beside_painting;

static inline bool beside_paint(void *user, uint32_t object, const double ends[4]) {
    beside_painting *o = user;
    if (o->count == BESIDE_FRAGMENTS) abort();
    o->object[o->count] = object;
    for (int i = 0; i < 4; i++) o->ends[o->count][i] = ends[i];
    o->count++;
    return true;
}

/* Which fragment of an object has a point well inside it; -1: none. */
static inline int beside_fragment(const beside_painting *o, uint32_t object, const double q[2]) {
    for (int i = 0; i < o->count; i++) {
        const double *f = o->ends[i], way[2] = {f[2] - f[0], f[3] - f[1]};
        const double length = way[0] * way[0] + way[1] * way[1];
        const double along = (q[0] - f[0]) * way[0] + (q[1] - f[1]) * way[1];
        if (o->object[i] == object && along > 1e-6 * length && along < (1 - 1e-6) * length) return i;
    }
    return -1;
}

/** and of an eye: what a line of sight meets sooner is painted later, and all that is painted is where it should be. */
static inline bool beside_order(beside *b, present *p, const double eye[2], const double to[2]) {
    static beside_painting o;
    o.count = 0;
    if (froe_kinetic_order(b->kinetic, eye, beside_paint, &o, NULL)) return BESIDE_FAIL(b, "order");
    b->counts.orders++;
    for (int i = 0; i < o.count; i++)
        for (int e = 0; e < 4; e += 2)
            if (!present_is_near(p, o.object[i], o.ends[i] + e))
                return BESIDE_FAIL(b, "a fragment of segment %u ends at %g %g, beside it", o.object[i], o.ends[i][e],
                                   o.ends[i][e + 1]);
    double share[PRESENT_MOST];
    int fragment[PRESENT_MOST];
    for (uint32_t s = 0; s < p->count; s++) {
        fragment[s] = -1;
        if (!present_share(p, s, eye, to, share + s)) continue;
        const double q[2] = {eye[0] + share[s] * (to[0] - eye[0]), eye[1] + share[s] * (to[1] - eye[1])};
        fragment[s] = beside_fragment(&o, s, q);
        for (uint32_t t = 0; t < s; t++) {
            if (fragment[t] < 0 || fragment[s] < 0 || fabs(share[s] - share[t]) < 1e-9) continue;
            b->counts.pairs++;
            if ((share[s] < share[t]) != (fragment[s] > fragment[t]))
                return BESIDE_FAIL(b, "from %g %g segments %u and %u are painted the wrong way round", eye[0], eye[1],
                                   s, t);
        }
    }
    return true;
}

/* The segments of a snapshot, standing still. */
static inline froe_motion *beside_frozen(const present *p, const bool *there, const froe_tree *tree) {
    const froe_scene *scene = froe_tree_scene(tree);
    size_t starts[2 * PRESENT_MOST + 1] = {0};
    double times[2 * PRESENT_MOST] = {0}, coords[4 * PRESENT_MOST] = {0};
    uint32_t object = 0;
    for (uint32_t s = 0; s < p->count; s++) {
        for (uint32_t e = 0; e < 2; e++) {
            starts[2 * s + e + 1] = 2 * s + e + 1;
            if (!there[s]) continue;
            const double *at = froe_scene_vertex(scene, froe_scene_corner(scene, object, e));
            if (!at) at = froe_scene_vertex(scene, froe_scene_corner(scene, object, 0)); /* a point has one corner */
            memcpy(coords + 4 * s + 2 * e, at, 2 * sizeof *at);
        }
        object += there[s];
    }
    froe_motion_options window = froe_motion_defaults();
    froe_motion *m = NULL;
    window.begin = 0, window.end = 2, window.tick = 1;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * p->count, b.count = p->count, b.starts = starts, b.times = times, b.coords = coords;
    if (froe_motion_new(&window, NULL, &m, NULL) || froe_motion_add(m, &b, NULL)) abort();
    return m;
}

static inline bool beside_same_nodes(const present *p, const present *q) {
    if (p->node_count != q->node_count) return false;
    for (int i = 0; i < p->node_count; i++) {
        const present_node *a = p->nodes + i, *b = q->nodes + i;
        if (a->segment != b->segment || memcmp(a->wall, b->wall, sizeof a->wall) ||
            memcmp(a->child, b->child, sizeof a->child))
            return false;
    }
    return true;
}

/** Is a snapshot alike, that is, is what it has cut as the present is? Not tested where segments are points. */
static inline bool beside_snapshot(beside *b, present *p) {
    froe_snapshot s;
    if (froe_kinetic_snapshot(b->kinetic, NULL, &s, NULL)) return BESIDE_FAIL(b, "snapshot");
    bool there[PRESENT_MOST], points = false;
    for (uint32_t i = 0; i < p->count; i++) there[i] = ktree_segment_at(&b->kinetic->tree, i)->alive;
    froe_motion *frozen = beside_frozen(p, there, s.tree);
    present q;
    present_init(&q, frozen, 1, there, p->key);
    present_build(&q);
    for (uint32_t i = 0; i < p->count; i++) points = points || (there[i] && !(q.here[i] && p->here[i]));
    const bool alike = beside_same_nodes(p, &q), good = points || alike == s.alike;
    b->counts.snapshots += !points, b->counts.alike += !points && alike;
    present_clear(&q);
    froe_motion_free(frozen);
    froe_tree_free(s.tree), froe_places_free(s.places);
    return good || BESIDE_FAIL(b, "a snapshot is said to be alike: %d, and is: %d", !alike, alike);
}
#endif
