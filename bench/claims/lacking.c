/* lacking.c: methods that lack what claims rest on. They are no methods of the library: nothing but the claims uses
 * them. */
#include "base/task.h"
#include "claims.h"
#include "scene/scene.h"
#include "split/fallback.h"
#include "split/grow.h"
#include "support/alloc.h"
#include <stdlib.h>
#include <string.h>

/** The line or plane of the first fragment of the cell, in the order of the scene: no random order, no free cuts. */
static split_verdict choose_first(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const uint32_t *leaf = config;
    if (cell->count <= *leaf) return SPLIT_LEAF;
    *cut = scene_support_cut(work->set.scene, work->set.items.data[cell->first + cell->attempt].object);
    return SPLIT_CUT;
}

static froe_tree *sorted_supports(froe_scene *scene, uint32_t leaf) {
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    base_task task;
    tree_meta meta = {.method = "sorted", .leaf = leaf == FROE_LEAF_OWN ? 1 : leaf};
    base_task_init(&task, 1, NULL, NULL);
    const split_method sorted = {.config = &meta.leaf, .choose = choose_first};
    const split_job job = {
        .scene = scene, .alloc = support_allocator(NULL), .task = &task, .meta = &meta, .diag = &diag};
    bench_must(split_grow(&job, &sorted, &tree), &diag);
    return tree;
}

/* Trapezoids in the order of the scene. */
static froe_tree *sorted_cylinders(froe_scene *scene, uint32_t leaf) {
    const size_t n = froe_scene_object_count(scene);
    uint32_t *order = bench_take(n, sizeof *order);
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    for (size_t i = 0; i < n; i++) order[i] = (uint32_t)i;
    o.method = "cylindrical", o.leaf = leaf, o.order = order, o.order_count = n, o.threads = 1;
    bench_must(froe_build(scene, &o, &tree, &diag), &diag);
    free(order);
    return tree;
}

froe_tree *claims_lacking(froe_scene *scene, const char *method, uint32_t leaf) {
    if (method && !strcmp(method, "sorted")) return sorted_supports(scene, leaf);
    if (method && !strcmp(method, "sorted cylinders")) return sorted_cylinders(scene, leaf);
    return NULL;
}
