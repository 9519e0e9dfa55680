/* trees.h: small scenes and trees for the tests of this folder. */
#ifndef FROE_TESTS_TREE_TREES_H
#define FROE_TESTS_TREE_TREES_H
#include "build/options.h"
#include "support/memory.h"
#include "support/scatter.h"
#include "tree/draft.h"
#include "tree/packed/packed.h"
#include <string.h>

static inline froe_scene *trees_scene(int dim, froe_kind kind, size_t count, uint32_t grid, double size,
                                      uint64_t seed) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_scatter(scene, kind, count, grid, size, seed), FROE_OK);
    return scene;
}

static inline froe_tree *trees_build(froe_scene *scene, const char *method, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why;
    froe_tree *tree = NULL;
    o.method = method;
    o.leaf = leaf;
    o.threads = 1;
    if (!strcmp(method, "density")) o.settings = "k=8 stop=1 growth=4"; /* so that small scenes have a guard stage */
    if (build_tuned(scene, &o, &tree, &why) != FROE_OK) fail_msg("%s", why.message);
    return tree;
}

/** Of polygons in space, with the corners starts[i] .. starts[i+1] - 1; the tree alone holds its scene. */
static inline froe_tree *trees_of_polygons(const double *coords, const size_t *starts, size_t count,
                                           const char *method) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    o.count = count, o.coords = coords, o.starts = starts;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, method, 1);
    froe_scene_free(scene);
    return tree;
}

/** The tree alone holds its scene. */
static inline froe_tree *trees_grow(int dim, froe_kind kind, size_t count, uint32_t grid, double size,
                                    const char *method, uint32_t leaf) {
    froe_scene *scene = trees_scene(dim, kind, count, grid, size, 1);
    froe_tree *tree = trees_build(scene, method, leaf);
    froe_scene_free(scene);
    return tree;
}

static inline void trees_assert_equal(const froe_tree *a, const froe_tree *b) {
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->cut_count, b->cut_count);
    assert_int_equal(a->piece_count, b->piece_count);
    assert_int_equal(a->bound_count, b->bound_count);
    assert_int_equal(a->normal_count, b->normal_count);
    assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
    if (a->cut_count) assert_memory_equal(a->cuts, b->cuts, a->cut_count * sizeof *a->cuts);
    assert_int_equal(tree_is_packed(a), tree_is_packed(b));
    if (tree_is_packed(a)) {
        assert_int_equal(a->packed.block_count, b->packed.block_count);
        assert_memory_equal(a->packed.blocks, b->packed.blocks, (size_t)a->packed.block_count * PACKED_BLOCK);
        assert_int_equal(a->packed.owner_count, b->packed.owner_count);
        assert_memory_equal(a->packed.owners, b->packed.owners, a->packed.owner_count * sizeof *a->packed.owners);
    } else if (a->piece_count) {
        assert_memory_equal(a->pieces, b->pieces, a->piece_count * sizeof *a->pieces);
    }
    if (a->bound_count) assert_memory_equal(a->bounds, b->bounds, a->bound_count * sizeof *a->bounds);
    if (a->normal_count) assert_memory_equal(a->normals, b->normals, a->normal_count * sizeof *a->normals);
    assert_memory_equal(&a->meta, &b->meta, sizeof a->meta);
}
#endif
