/* asked.h: contexts and scenes of groups for tests that compare lists. */
#ifndef FROE_TESTS_QUERY_ASKED_H
#define FROE_TESTS_QUERY_ASKED_H
#include "query/context.h"
#include "tree/trees.h"
#include <froe/query.h>

static inline froe_query *ask(froe_tree *tree) {
    froe_query *q;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    return q;
}

static inline void end_query(froe_query *q) {
    froe_tree *tree = (froe_tree *)(uintptr_t)q->tree;
    froe_query_free(q);
    froe_tree_free(tree);
}

static inline int ascending(const void *a, const void *b) {
    return (*(const uint32_t *)a > *(const uint32_t *)b) - (*(const uint32_t *)a < *(const uint32_t *)b);
}

static inline void assert_same_ids(const uint32_t *a, size_t a_count, const uint32_t *b, size_t b_count) {
    uint32_t x[4096], y[4096];
    assert_int_equal(a_count, b_count);
    assert_true(a_count <= 4096);
    if (!a_count) return;
    memcpy(x, a, a_count * sizeof *x), memcpy(y, b, b_count * sizeof *y);
    qsort(x, a_count, sizeof *x, ascending), qsort(y, b_count, sizeof *y, ascending);
    assert_memory_equal(x, y, a_count * sizeof *x);
}

static inline uint32_t add_group(froe_scene *scene) {
    const froe_group group = {.name = "g"};
    uint32_t id;
    assert_int_equal(froe_scene_add_group(scene, &group, &id), FROE_OK);
    return id;
}

static inline void add_to(froe_scene *scene, uint32_t group, froe_kind kind, size_t count, const double *coords,
                          const double *radii) {
    froe_objects o = froe_objects_defaults();
    o.kind = kind, o.count = count, o.coords = coords, o.radii = radii, o.group = group;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
}

/* 0: a square; 1: a triangle within; 2: two points, both in 0, one in 1; 3: nothing; and a segment without a group. */
static inline froe_scene *areas(void) {
    static const double square[] = {0, 0, 4, 0, 4, 0, 4, 4, 4, 4, 0, 4, 0, 4, 0, 0};
    static const double triangle[] = {1, 1, 3, 1, 3, 1, 1, 3, 1, 3, 1, 1}, points[] = {1.5, 1.25, 3.5, 3.5};
    static const double loose[] = {-1, -1, 5, 5};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    add_to(scene, add_group(scene), FROE_SEGMENT, 4, square, NULL);
    add_to(scene, add_group(scene), FROE_SEGMENT, 3, triangle, NULL);
    add_to(scene, add_group(scene), FROE_POINT, 2, points, NULL);
    add_group(scene);
    add_to(scene, FROE_NONE, FROE_SEGMENT, 1, loose, NULL);
    return scene;
}

#endif
