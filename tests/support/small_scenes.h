/* small_scenes.h: small scenes and trees to draw, for tests that see the public interface only. */
#ifndef FROE_TESTS_SUPPORT_SMALL_SCENES_H
#define FROE_TESTS_SUPPORT_SMALL_SCENES_H
#include "support/memory.h"
#include <froe/froe.h>
#include <string.h>

static inline double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline froe_tree *tree_of(froe_scene *scene, const char *method, uint32_t leaf) {
    froe_build_options b = froe_build_defaults();
    froe_diagnostic diag = {.message = ""};
    froe_tree *tree = NULL;
    b.method = method;
    b.leaf = leaf;
    b.threads = 1;
    if (froe_build(scene, &b, &tree, &diag) != FROE_OK) fail_msg("%s", diag.message);
    froe_scene_free(scene);
    return tree;
}

static inline void add(froe_scene *scene, froe_kind kind, size_t count, const double *coords, const double *radii,
                       const size_t *starts) {
    froe_objects o = froe_objects_defaults();
    o.kind = kind;
    o.count = count;
    o.coords = coords;
    o.radii = radii;
    o.starts = starts;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
}

static inline froe_scene *scene_of(int dim) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    return scene;
}

/** Short random segments in the unit square times `factor`, plus `shift`. */
static inline froe_scene *random_segments(size_t count, double length, double factor, double shift) {
    froe_scene *scene = scene_of(2);
    uint64_t state = 7;
    for (size_t i = 0; i < count; i++) {
        double c[4];
        for (int k = 0; k < 2; k++) {
            double at = next_random(&state);
            c[k] = at * factor + shift;
            c[2 + k] = (at + length * (next_random(&state) - 0.5)) * factor + shift;
        }
        add(scene, FROE_SEGMENT, 1, c, NULL, NULL);
    }
    return scene;
}

/** Random triangles in the unit cube. */
static inline froe_scene *random_triangles(size_t count, double size) {
    froe_scene *scene = scene_of(3);
    uint64_t state = 11;
    for (size_t i = 0; i < count; i++) {
        double c[9];
        for (int k = 0; k < 3; k++) {
            double at = next_random(&state);
            for (int j = 0; j < 3; j++) c[3 * j + k] = at + size * (next_random(&state) - 0.5);
        }
        add(scene, FROE_POLYGON, 1, c, NULL, NULL);
    }
    return scene;
}

/** One of every kind that the dimension has. */
static inline froe_scene *mixed_scene(int dim) {
    froe_scene *scene = scene_of(dim);
    const double point2[] = {0.1, 0.9}, segment2[] = {0, 0, 1, 0.3}, box2[] = {0.5, 0.5, 0.8, 0.9};
    const double ball2[] = {0.2, 0.6}, hull2[] = {0.7, 0.1, 0.9, 0.2, 0.8, 0.4, 0.8, 0.2};
    const double point3[] = {0.1, 0.9, 0.5}, segment3[] = {0, 0, 0, 1, 0.3, 0.9},
                 box3[] = {0.5, 0.5, 0.3, 0.8, 0.9, 0.7};
    const double ball3[] = {0.2, 0.6, 0.5};
    const double hull3[] = {0.7, 0.1, 0.2, 0.9, 0.2, 0.4, 0.8, 0.4, 0.7, 0.8, 0.2, 0.6, 0.6, 0.3, 0.3};
    const double polygon3[] = {0, 0, 0.5, 0.4, 0, 0.5, 0.4, 0.4, 0.5, 0, 0.4, 0.5};
    const size_t four[] = {0, 4}, five[] = {0, 5};
    const double radius = 0.15;
    add(scene, FROE_POINT, 1, dim == 2 ? point2 : point3, NULL, NULL);
    add(scene, FROE_SEGMENT, 1, dim == 2 ? segment2 : segment3, NULL, NULL);
    add(scene, FROE_BOX, 1, dim == 2 ? box2 : box3, NULL, NULL);
    add(scene, FROE_BALL, 1, dim == 2 ? ball2 : ball3, &radius, NULL);
    add(scene, FROE_HULL, 1, dim == 2 ? hull2 : hull3, NULL, dim == 2 ? four : five);
    if (dim == 3) add(scene, FROE_POLYGON, 1, polygon3, NULL, four);
    return scene;
}
#endif
