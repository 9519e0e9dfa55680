/* finish_trees.h: trees of small cells that are finished from tables of sides, with filters and without. */
#ifndef FROE_TESTS_SPLIT_FINISH_TREES_H
#define FROE_TESTS_SPLIT_FINISH_TREES_H
#include "build/options.h"
#include "support/memory.h"
#include "tree/tree.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

extern const build_method build_method_density;

/** Predicates start at the stage `first`. */
static froe_tree *build(froe_scene *scene, uint32_t leaf, const char *settings, num_stage first) {
    base_task task;
    froe_tree *tree = NULL;
    const build_method *density = &build_method_density;
    base_task_init(&task, 1, NULL, NULL);
    build_job job = {
        .scene = scene, .alloc = support_allocator(NULL), .task = &task, .leaf = leaf, .seed = 1, .first = first};
    job.meta.leaf = leaf;
    assert_int_equal(options_parse(density, settings, true, job.option, NULL), FROE_OK);
    density->resolve(scene, leaf, job.option);
    assert_int_equal(density->build(&job, &tree), FROE_OK);
    return tree;
}

static void audit(const froe_tree *tree) {
    froe_audit_options o = froe_audit_defaults();
    froe_diagnostic diag = {0};
    o.exact_only = true;
    if (froe_tree_audit(tree, &o, &diag)) fail_msg("%s", diag.message);
}

static void assert_same_tree(const froe_tree *a, const froe_tree *b) {
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->cut_count, b->cut_count);
    assert_int_equal(a->piece_count, b->piece_count);
    assert_int_equal(a->bound_count, b->bound_count);
    assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
    assert_memory_equal(a->cuts, b->cuts, a->cut_count * sizeof *a->cuts);
    assert_memory_equal(a->pieces, b->pieces, a->piece_count * sizeof *a->pieces);
    assert_memory_equal(a->bounds, b->bounds, a->bound_count * sizeof *a->bounds);
}

static void assert_lowest_of_equals(const froe_tree *t) {
    for (uint32_t i = 0; i < t->cut_count; i++)
        for (uint32_t lower = 0; t->cuts[i].kind == FROE_CUT_OBJECT && lower < t->cuts[i].a; lower++)
            assert_false(scene_equal(t->scene, lower, t->cuts[i].a));
}

/** Right with leaves of that size or 3, and the same when no filter is trusted. Returns the pieces of the first. */
static uint64_t check_scene(froe_scene *scene, uint32_t least) {
    uint64_t pieces = 0;
    for (uint32_t leaf = least; leaf <= 3; leaf += 3 - least) {
        froe_tree *tree = build(scene, leaf, NULL, NUM_FILTER), *exact = build(scene, leaf, NULL, NUM_EXACT);
        audit(tree);
        assert_lowest_of_equals(tree);
        assert_same_tree(tree, exact);
        if (leaf == least) pieces = froe_tree_report(tree).fragments;
        froe_tree_free(tree);
        froe_tree_free(exact);
    }
    return pieces;
}
#endif
