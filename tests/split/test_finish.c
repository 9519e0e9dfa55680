/* Small cells of segments: whatever the table of sides cannot hold or be sure of, the tree is right. */
#include "base/random.h"
#include "build/options.h"
#include "support/memory.h"
#include "tree/tree.h"
#include <string.h>

enum { SEGMENTS = 48 };

extern const build_method build_method_density;

static froe_scene *scene_of(const double *coords, size_t count) {
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT;
    o.count = count;
    o.coords = coords;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

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
static uint64_t check(const double *coords, size_t count, uint32_t least) {
    froe_scene *scene = scene_of(coords, count);
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
    froe_scene_free(scene);
    return pieces;
}

static void a_cell_that_outgrows_the_table_is_handed_back(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (int i = 0; i < SEGMENTS; i++) { /* a grid of 24 x 24 lines, slanted so that none is parallel to an axis */
        double at = i / 2 + 1, slant = 0.37 * i;
        const double along[4] = {0, at, 30, at + slant}, up[4] = {at, 0, at - slant, 30};
        memcpy(coords + 4 * (size_t)i, i % 2 ? along : up, sizeof along);
    }
    assert_true(check(coords, SEGMENTS, 0) > 64 + SEGMENTS);
}

static void segments_that_touch_or_lie_in_a_line_are_told_exactly(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        for (uint32_t i = 0; i < 4 * SEGMENTS; i++)
            coords[i] = base_below(base_hash(round, 1, i), 2 + (uint32_t)round % 5);
        check(coords, SEGMENTS, 0);
    }
}

static void segments_beside_a_line_by_less_than_rounding_are_told_exactly(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (uint64_t round = 0; round < 20; round++) {
        for (uint32_t i = 0; i < 4 * SEGMENTS; i += 2) { /* near the line y = 0.3 x + 0.1 */
            double x = base_below(base_hash(round, 2, i), 1000) * 0.001;
            coords[i] = x;
            coords[i + 1] = 0.3 * x + 0.1 + 0x1p-53 * base_below(base_hash(round, 3, i), 3);
        }
        check(coords, SEGMENTS, 0);
    }
}

/* A copy that faces the other way measures from its other end, so its row may be sure of more or of less. */
static void of_equal_segments_the_lowest_is_the_cut(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (uint64_t round = 0; round < 40; round++) {
        for (uint32_t i = 0; i < 4 * SEGMENTS; i += 2) {
            double x = base_below(base_hash(round, 8, i), 1000) * 0.001;
            coords[i] = i % 4 ? x : -1000 * x;
            coords[i + 1] = 0.3 * coords[i] + 0.1 + 0x1p-52 * base_below(base_hash(round, 9, i), 5);
        }
        for (uint32_t i = 0; i < SEGMENTS / 2; i++) {
            double *copy = coords + 4 * (size_t)(i + SEGMENTS / 2), *from = coords + 4 * (size_t)i;
            copy[0] = from[2], copy[1] = from[3], copy[2] = from[0], copy[3] = from[1];
        }
        check(coords, SEGMENTS, 0);
    }
}

static void a_power_of_two_changes_nothing(void **state) {
    double coords[4 * SEGMENTS], scaled[4 * SEGMENTS];
    (void)state;
    for (uint32_t i = 0; i < 4 * SEGMENTS; i++) coords[i] = base_below(base_hash(5, 4, i), 1u << 20);
    froe_scene *scene = scene_of(coords, SEGMENTS);
    froe_tree *tree = build(scene, 1, "stop=64", NUM_FILTER);
    for (int power = -400; power <= 400; power += 100) {
        for (uint32_t i = 0; i < 4 * SEGMENTS; i++) scaled[i] = ldexp(coords[i], power);
        froe_scene *other = scene_of(scaled, SEGMENTS);
        froe_tree *same = build(other, 1, "stop=64", NUM_FILTER);
        assert_same_tree(tree, same);
        froe_tree_free(same);
        froe_scene_free(other);
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void points_and_segments_in_one_cell_get_along(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (uint32_t i = 0; i < 4 * SEGMENTS; i++) coords[i] = base_below(base_hash(6, 4, i), 100);
    for (uint32_t i = 0; i < 4 * SEGMENTS; i += 16) coords[i + 2] = coords[i], coords[i + 3] = coords[i + 1];
    check(coords, SEGMENTS, 1);
}

static void small_0_leaves_all_cells_to_cuts_one_by_one(void **state) {
    double coords[4 * SEGMENTS];
    (void)state;
    for (uint32_t i = 0; i < 4 * SEGMENTS; i++) coords[i] = base_below(base_hash(7, 4, i), 1000);
    froe_scene *scene = scene_of(coords, SEGMENTS);
    froe_tree *cuts = build(scene, 1, "small=0", NUM_FILTER), *table = build(scene, 1, NULL, NUM_FILTER);
    audit(cuts);
    audit(table);
    assert_true(table->piece_count <= cuts->piece_count); /* more lines compete */
    froe_tree_free(cuts);
    froe_tree_free(table);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_that_outgrows_the_table_is_handed_back),
        cmocka_unit_test(segments_that_touch_or_lie_in_a_line_are_told_exactly),
        cmocka_unit_test(segments_beside_a_line_by_less_than_rounding_are_told_exactly),
        cmocka_unit_test(of_equal_segments_the_lowest_is_the_cut),
        cmocka_unit_test(a_power_of_two_changes_nothing),
        cmocka_unit_test(points_and_segments_in_one_cell_get_along),
        cmocka_unit_test(small_0_leaves_all_cells_to_cuts_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
