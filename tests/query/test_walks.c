/* All walks find the same objects, on deep trees and on shallow ones; what they prepare is what they take it for. */
#include "query/range/jump.h"
#include "query/ranges.h"
#include "support/memory.h"

/* ---------------------------------------------------------------- ancestors -- */

/* By climbing from the later of the two, again and again: parents have lower numbers. */
static uint32_t lowest_by_force(const uint32_t *parents, uint32_t a, uint32_t b) {
    while (a != b) *(a > b ? &a : &b) = parents[a > b ? a : b];
    return a;
}

static void check_ancestors(const world *w, size_t t) {
    const froe_tree *tree = w->trees[t];
    const query_ancestors *ancestors;
    uint32_t *parents = calloc(tree->node_count, sizeof *parents);
    for (uint32_t v = 0; v < tree->node_count; v++)
        for (uint32_t side = 0; side < 2 && !tree_is_leaf(tree->nodes + v); side++)
            parents[tree->nodes[v].child + side] = v;
    assert_int_equal(query_ancestors_of(w->queries[t], &ancestors, NULL), FROE_OK);
    for (uint64_t i = 0; i < 4000; i++) {
        const uint32_t a = trees_random(1, i, tree->node_count), b = trees_random(2, i, tree->node_count);
        assert_int_equal(query_ancestors_lowest(ancestors, a, b), lowest_by_force(parents, a, b));
        assert_int_equal(query_ancestors_lowest(ancestors, a, a), a);
        assert_int_equal(query_ancestors_lowest(ancestors, a, parents[a]), parents[a]);
    }
    free(parents);
}

static void lowest_common_ancestors_are_those_of_climbing(void **state) {
    static const size_t counts[] = {1, 2, 3, 17, 900};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        world w = world_begin("nested", world_generate("nested", counts[i]));
        for (size_t t = 0; t < w.tree_count; t++) check_ancestors(&w, t);
        world_end(&w);
    }
}

/* -------------------------------------------------------------------- walks -- */

/* Both ways of jumping end at the same node, wherever they begin. */
static void box_and_lca_find_the_same_node(void **state) {
    world w = world_begin("nested", world_generate("nested", 600));
    uint64_t further = 0;
    (void)state;
    for (size_t t = 0; t < w.tree_count; t++) {
        query_jump box, lca;
        assert_int_equal(query_jump_prepare(w.queries[t], FROE_WALK_BOX, &box), FROE_OK);
        assert_int_equal(query_jump_prepare(w.queries[t], FROE_WALK_LCA, &lca), FROE_OK);
        for (uint64_t seed = 0; seed < 2000; seed++) {
            world_dice d = {seed, 0};
            double a[2], b[2], lo[2][2], hi[2][2];
            world_point(&w, &d, a);
            world_near(&w, &d, seed % 2 ? ldexp(1, -(int)world_below(&d, 60)) : 0, a, b);
            for (int k = 0; k < 4; k++)
                lo[k / 2][k % 2] = fmin(a[k % 2], b[k % 2]), hi[k / 2][k % 2] = fmax(a[k % 2], b[k % 2]);
            const uint32_t from = seed % 3 ? 0 : world_below(&d, w.trees[t]->node_count);
            const uint32_t to = query_jump_below(&box, from, lo[0], hi[0]);
            assert_int_equal(query_jump_below(&lca, from, lo[1], hi[1]), to);
            further += to > from;
        }
    }
    assert_true(further > 10000);
    world_end(&w);
}

static void check_world(const char *name, froe_scene *scene, size_t seeds, bool deep) {
    world w = world_begin(name, scene);
    for (uint64_t seed = 0; seed < seeds; seed++) {
        if (deep) w.scale = ldexp(1, -(int)(seed % 60)), w.origin[0] = w.origin[1] = -0.5 * w.scale;
        const uint64_t shapes = w.dim > 3 ? 2 : FROE_SHAPE_COUNT; /* boxes and balls come first */
        ask_by(&w, (froe_range_shape)(seed % shapes), seed, FROE_WALK_PLAIN, (froe_walk)(FROE_WALK_COUNT - 1), truth);
    }
    world_end(&w);
}

static void walks_agree_in_nested_scenes(void **state) {
    (void)state;
    check_world("nested", world_generate("nested", 500), 60, true);
    check_world("wedge", world_generate("wedge", 200), 60, false);
}

static void walks_agree_among_all_kinds(void **state) {
    (void)state;
    check_world("plane", world_mixture(2, 63 & ~(1u << FROE_POLYGON), 12, 0, 0.3, 3), 80, false);
    check_world("plane, lattice", world_mixture(2, 63 & ~(1u << FROE_POLYGON), 12, 9, 0.3, 4), 80, false);
    check_world("space", world_mixture(3, 63, 8, 0, 0.4, 5), 40, false);
}

static void walks_agree_among_boxes(void **state) {
    (void)state;
    check_world("boxes", world_mixture(2, 1 << FROE_BOX, 150, 0, 0.1, 6), 80, false);
    check_world("boxes, lattice", world_mixture(3, 1 << FROE_BOX, 80, 7, 0.3, 7), 80, false);
    check_world("boxes and balls in five dimensions", world_mixture(5, SOLID_KINDS, 40, 0, 0.4, 8), 80, false);
}

static void walks_agree_where_there_is_little_or_nothing(void **state) {
    (void)state;
    check_world("none", world_mixture(2, 0, 0, 0, 1, 1), 16, false);
    check_world("one", world_mixture(2, 1 << FROE_SEGMENT, 1, 0, 1, 1), 80, false);
}

/* ------------------------------------------------------------------- limits -- */

static void bad_walks_are_refused(void **state) {
    world w = world_begin("one", world_mixture(2, 1 << FROE_SEGMENT, 1, 0, 1, 1));
    const double points[4] = {0, 0, 1, 1};
    froe_range range = froe_range_defaults();
    froe_list list;
    froe_diagnostic why;
    (void)state;
    range.points = points;
    range.walk = FROE_WALK_COUNT;
    for (size_t t = 0; t < w.tree_count; t++)
        assert_int_equal(froe_query_range(w.queries[t], &range, &list, &why), FROE_E_OPTIONS);
    assert_string_equal(froe_walk_name(FROE_WALK_LCA), "lca");
    assert_null(froe_walk_name(FROE_WALK_COUNT));
    world_end(&w);
}

static froe_status search(void *user, const froe_allocator *alloc) {
    const double points[4] = {0, 0, 0.5, 0.5};
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    froe_list list;
    froe_range range = froe_range_defaults();
    froe_build_options o = froe_build_defaults();
    (void)user;
    o.method = "quad";
    range.points = points;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 30, 0, 0.3, 3);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    for (range.walk = FROE_WALK_AUTO; range.walk < FROE_WALK_COUNT && !status; range.walk++)
        status = froe_query_range(q, &range, &list, NULL);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void walks_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(search, NULL) > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lowest_common_ancestors_are_those_of_climbing),
        cmocka_unit_test(box_and_lca_find_the_same_node),
        cmocka_unit_test(walks_agree_in_nested_scenes),
        cmocka_unit_test(walks_agree_among_all_kinds),
        cmocka_unit_test(walks_agree_among_boxes),
        cmocka_unit_test(walks_agree_where_there_is_little_or_nothing),
        cmocka_unit_test(bad_walks_are_refused),
        cmocka_unit_test(walks_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
