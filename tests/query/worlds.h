/* worlds.h: scenes to ask, with a tree by every builder that serves them and an oracle for every object. */
#ifndef FROE_TESTS_QUERY_WORLDS_H
#define FROE_TESTS_QUERY_WORLDS_H
#include "oracle/convex.h"
#include "query/extremes.h"
#include "tree/trees.h"
#include <froe/io.h>
#include <froe/query.h>
#include <math.h>
#include <stdio.h>

typedef struct world {
    const char *name;
    int dim;
    size_t count; /**< of objects */
    froe_scene *scene;
    oracle_set *objects; /**< up to three dimensions */
    froe_tree **trees;   /**< by every method that serves the scene, with several loads of leaves */
    froe_query **queries;
    size_t tree_count;
    double scale; /**< queries lie in about 0 .. scale on each axis, plus `origin` */
    double origin[FROE_MAX_DIM];
    bool lattice;
    bool extreme; /**< places and lengths are those of query/extremes.h */
} world;

/** Adds a tree, unless the builder does not serve the scene. */
static inline void world_build(world *w, const char *method, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.method = method;
    o.leaf = leaf;
    o.threads = 1;
    o.max_fragments = 40 * w->count + 40000;
    if (!strcmp(method, "density")) o.settings = "k=8 stop=1 growth=4";
    if (!strcmp(method, "cylindrical")) o.settings = "crossing=split";
    froe_status status = build_tuned(w->scene, &o, &tree, NULL);
    if (status) {
        assert_true(status == FROE_E_UNSUPPORTED || status == FROE_E_OPTIONS || status == FROE_E_BUDGET);
        return;
    }
    assert_int_equal(froe_query_new(tree, &w->queries[w->tree_count], NULL), FROE_OK);
    w->trees[w->tree_count++] = tree;
}

/** Takes over the scene; all builders, each with leaves of one object and, by turns, with full or free ones; of a large
 * scene one of both, by turns. */
static inline world world_begin(const char *name, froe_scene *scene) {
    world w = {.name = name, .dim = froe_scene_dim(scene), .count = froe_scene_object_count(scene), .scene = scene};
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    size_t methods = 0;
    while (froe_method_at(methods)) methods++;
    w.trees = calloc(2 * methods, sizeof *w.trees);
    w.queries = calloc(2 * methods, sizeof *w.queries);
    for (size_t m = 0; m < methods; m++) {
        const bool large = w.count > 500;
        if (!large || m % 2) world_build(&w, froe_method_at(m)->name, 1);
        if (!large || m % 2 == 0) world_build(&w, froe_method_at(m)->name, w.dim == 2 && (w.count + m / 2) % 2 ? 0 : 6);
    }
    assert_true(w.tree_count > 0);
    froe_scene_bounds(scene, lo, hi);
    for (int k = 0; k < w.dim; k++) w.origin[k] = lo[k], w.scale = fmax(w.scale, hi[k] - lo[k]);
    if (w.scale == 0) w.scale = 1;
    w.objects = calloc(w.count + 1, sizeof *w.objects);
    for (uint32_t i = 0; i < w.count && w.dim <= 3; i++) w.objects[i] = oracle_object(scene, i);
    return w;
}

static inline void world_end(world *w) {
    for (size_t i = 0; i < w->tree_count; i++) {
        froe_query_free(w->queries[i]);
        froe_tree_free(w->trees[i]);
    }
    for (uint32_t i = 0; i < w->count && w->dim <= 3; i++) oracle_set_free(&w->objects[i]);
    free(w->trees);
    free(w->queries);
    free(w->objects);
    froe_scene_free(w->scene);
}

/** A scene of several kinds, `count` of each in the mask. */
static inline froe_scene *world_mixture(int dim, unsigned kinds, size_t count, uint32_t grid, double size,
                                        uint64_t seed) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++)
        if (kinds >> kind & 1)
            assert_int_equal(trees_scatter(scene, (froe_kind)kind, count, grid, size, seed + (uint64_t)kind), FROE_OK);
    return scene;
}

/** Coordinates times a power of two, so that everything is as exact as it was. */
static inline froe_scene *world_scaled(const froe_scene *from, int power) {
    froe_scene *to;
    int dim = froe_scene_dim(from);
    assert_int_equal(froe_scene_new(dim, NULL, &to), FROE_OK);
    for (uint32_t i = 0; i < froe_scene_object_count(from); i++) {
        froe_object o = froe_scene_object(from, i);
        double coords[16 * 3];
        const size_t starts[2] = {0, o.corners};
        double radius = ldexp(o.radius, power);
        for (uint32_t c = 0; c < o.corners; c++)
            for (int k = 0; k < dim; k++)
                coords[c * (uint32_t)dim + (uint32_t)k] =
                    ldexp(froe_scene_vertex(from, froe_scene_corner(from, i, c))[k], power);
        bool runs = o.form == FROE_HULL || o.form == FROE_POLYGON;
        assert_int_equal(trees_add(to, o.form, 1, coords, o.form == FROE_BALL ? &radius : NULL, runs ? starts : NULL),
                         FROE_OK);
    }
    return to;
}

static inline froe_scene *world_read(const char *file) {
    char path[500];
    froe_scene *scene;
    snprintf(path, sizeof path, "%s/%s", FROE_TEST_DATA, file);
    assert_int_equal(froe_read(path, NULL, &scene, NULL, NULL), FROE_OK);
    return scene;
}

static inline froe_scene *world_generate(const char *kind, size_t n) {
    froe_scene *scene;
    assert_int_equal(froe_generate(kind, n, 5, NULL, &scene, NULL), FROE_OK);
    return scene;
}

/** Random numbers of one test. */
typedef struct world_dice {
    uint64_t seed, counter;
} world_dice;
static inline uint32_t world_below(world_dice *d, uint32_t n) {
    return trees_random(d->seed, d->counter++, n);
}
static inline double world_unit(world_dice *d) {
    return trees_unit(d->seed, d->counter++);
}

/** The same for extremes.h. */
static inline fuzz_source world_fuzz(world_dice *d) {
    return (fuzz_source){base_hash(d->seed, 79, d->counter++)};
}

/** Puts a point into axis-parallel cuts of some tree: one, or as many as there are axes. */
static inline void world_into_cuts(const world *w, world_dice *d, double *x) {
    if (!w->tree_count) return;
    const froe_tree *t = w->trees[world_below(d, (uint32_t)w->tree_count)];
    for (uint32_t cuts = 1 + world_below(d, (uint32_t)w->dim); cuts > 0 && t->node_count; cuts--) {
        const froe_cut cut = tree_cut_at(t, world_below(d, t->node_count));
        if (cut.kind == FROE_CUT_AXIS) x[cut.axis] = cut.value;
    }
}
/** A point to ask about: anywhere, on a vertex, with coordinates of vertices, which cuts have, too, or in cuts. */
static inline void world_point(const world *w, world_dice *d, double *x) {
    if (w->extreme) {
        fuzz_source r = world_fuzz(d);
        extreme_point(&r, w->scene, x);
        if (!world_below(d, 4)) world_into_cuts(w, d, x);
        return;
    }
    uint32_t vertices = (uint32_t)froe_scene_vertex_count(w->scene), style = world_below(d, 5);
    for (int k = 0; k < w->dim; k++) {
        x[k] = w->origin[k] + w->scale * (1.2 * world_unit(d) - 0.1);
        if (w->lattice) x[k] = floor(x[k]);
        if (style == 1 && vertices) x[k] = froe_scene_vertex(w->scene, world_below(d, vertices))[k];
    }
    if (style == 2 && vertices)
        memcpy(x, froe_scene_vertex(w->scene, world_below(d, vertices)), (size_t)w->dim * sizeof *x);
    if (style == 3) world_into_cuts(w, d, x);
}
/** One near another, by about `size` of the scene. */
static inline void world_near(const world *w, world_dice *d, double size, const double *from, double *x) {
    if (w->extreme) {
        fuzz_source r = world_fuzz(d);
        extreme_beside(&r, w->dim, from, extreme_scale(&r, w->scene), x);
        if (fuzz_int(&r, 0, 1)) world_point(w, d, x);
        return;
    }
    for (int k = 0; k < w->dim; k++) {
        x[k] = from[k] + w->scale * size * (2 * world_unit(d) - 1);
        if (w->lattice) x[k] = floor(x[k]);
    }
}
/** A length up to about `size` of the scene, for what is asked at x. */
static inline double world_length(const world *w, world_dice *d, double size, const double *x) {
    if (w->extreme) {
        fuzz_source r = world_fuzz(d);
        return extreme_length(&r, w->scene, x);
    }
    const double length = size * w->scale * world_unit(d);
    return w->lattice ? floor(length) : length;
}
#endif
