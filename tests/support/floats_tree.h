/* floats_tree.h: a small tree for tests of how the calling thread computes. */
#ifndef FROE_TESTS_SUPPORT_FLOATS_TREE_H
#define FROE_TESTS_SUPPORT_FLOATS_TREE_H
#include "support/settings.h"

/** Segments of the plane or triangles in space, strewn by a multiplication, in a cube of that size. */
static inline froe_tree *floats_tree(floats_run *r, int dim, double size, froe_scene **scene) {
    enum { OBJECTS = 25, MOST = OBJECTS * 9 };
    froe_build_options b = froe_build_defaults();
    froe_objects o = froe_objects_defaults();
    double coords[MOST];
    froe_tree *tree;
    for (uint32_t i = 0; i < MOST; i++) {
        const double centre = (i / (uint32_t)(dim * dim) * 2654435761u >> (3 * i % 9)) % 1000;
        coords[i] = (centre + (i * 40503u >> 4) % 300) * size / 1000;
    }
    o.kind = dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    o.count = OBJECTS;
    o.coords = coords;
    b.purpose = "draw";
    MUST(r, froe_scene_new(dim, NULL, scene));
    MUST(r, froe_scene_add(*scene, &o, NULL));
    MUST(r, froe_build(*scene, &b, &tree, NULL));
    return tree;
}
#endif
