/* Deep trees: the centroids find what plain descent finds, in few steps. */
#include "query/range/centroids.h"
#include "query/ranges.h"

enum { DEPTH = 20000 };

/* Points 0, 1, 2, ... of a line. The cut through each even one leaves the odd one before it in a leaf. */
static froe_tree *chain(void) {
    froe_scene *scene;
    tree_draft draft;
    froe_tree *tree;
    uint32_t node = 0, child;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i <= 2 * DEPTH; i++) {
        const double x[2] = {i, 0};
        assert_int_equal(trees_add(scene, FROE_POINT, 1, x, NULL, NULL), FROE_OK);
    }
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    for (uint32_t i = 0; i <= DEPTH; i++, node = child + 1) {
        const froe_cut cut = {.kind = FROE_CUT_AXIS, .value = 2 * i};
        assert_int_equal(draft_split(&draft, node, &cut, 0, &child), FROE_OK);
        assert_int_equal(draft_list(&draft, node), FROE_OK);
        assert_int_equal(draft_piece(&draft, node, 2 * i, NULL, 0), FROE_OK);
        draft_leaf(&draft, child, 0);
        if (!i) continue;
        assert_int_equal(draft_list(&draft, child), FROE_OK);
        assert_int_equal(draft_piece(&draft, child, 2 * i - 1, NULL, 0), FROE_OK);
    }
    draft_leaf(&draft, node, 0);
    const tree_meta meta = {.method = "chain", .leaf = 1};
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    return tree;
}

/* Whether the bounds are points, between points, or beyond. */
static void search_chain(froe_query *q, froe_walk walk, uint32_t each, uint64_t most) {
    for (uint32_t i = 0; i < 5000; i += each) {
        const double lo = 0.5 * trees_random(1, i, 4 * DEPTH) - 3, hi = lo + 0.5 * trees_random(2, i, 9);
        double points[4] = {lo, i % 2 ? -1 : 0, hi, 0};
        const double first = fmax(ceil(lo), 0), last = fmin(floor(hi), 2.0 * DEPTH);
        froe_range range = froe_range_defaults();
        froe_list list;
        range.walk = walk;
        range.points = points;
        if (i % 4 == 1) { /* the same as a ball, as a hull and as a segment */
            points[0] = 0.5 * (lo + hi);
            points[1] = 0;
            range.shape = FROE_SHAPE_BALL;
            range.radius = 0.5 * (hi - lo);
        }
        if (i % 4 == 2) range.shape = FROE_SHAPE_HULL, range.count = 2, points[1] = 0;
        if (i % 4 == 3) range.shape = FROE_SHAPE_SEGMENT, points[1] = 0;
        assert_int_equal(froe_query_range(q, &range, &list, NULL), FROE_OK);
        assert_int_equal(list.count, first <= last ? (size_t)(last - first) + 1 : 0);
        for (size_t j = 0; j < list.count; j++) assert_true(list.ids[j] >= first && list.ids[j] <= last);
        const froe_query_stats stats = froe_query_statistics(q);
        if (stats.nodes + stats.steps >= most)
            fail_msg("%g .. %g, shape %d, walk %s: %u nodes, %u steps", lo, hi, (int)range.shape, froe_walk_name(walk),
                     (unsigned)stats.nodes, (unsigned)stats.steps);
    }
}

static void deep_chains_are_searched_in_few_steps(void **state) {
    froe_tree *tree = chain();
    froe_query *q;
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    search_chain(q, FROE_WALK_AUTO, 1, 400);
    search_chain(q, FROE_WALK_BOX, 1, 400);
    search_chain(q, FROE_WALK_LCA, 1, 1200);
    search_chain(q, FROE_WALK_PLAIN, 9, UINT64_MAX);
    froe_query_free(q);
    froe_tree_free(tree);
}

static bool holds(const query_centroids *c, uint32_t node, const double *lo, const double *hi) {
    const double *box = query_centroid_box(c, node);
    for (int k = 0; k < c->dim; k++)
        if (!(lo[k] > box[k] && hi[k] < box[c->dim + k])) return false;
    return true;
}

/* By descent, as long as cuts are axis-parallel and the box is strictly on one side. */
static uint32_t deepest(const froe_tree *t, const query_centroids *c, const double *lo, const double *hi) {
    uint32_t node = 0;
    for (;;) {
        if (tree_is_leaf(t->nodes + node) || tree_cut_at(t, node).kind != FROE_CUT_AXIS) return node;
        const uint32_t child = t->nodes[node].child;
        if (holds(c, child, lo, hi))
            node = child;
        else if (holds(c, child + 1, lo, hi))
            node = child + 1;
        else
            return node;
    }
}

static void centroids_find_the_node_that_descent_finds(void **state) {
    static const char *const kinds[] = {"nested", "wedge"};
    size_t deep = 0;
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        world w = world_begin(kinds[i], world_generate(kinds[i], 1500));
        for (size_t t = 0; t < w.tree_count; t++) {
            const query_centroids *c;
            uint64_t steps = 0;
            assert_int_equal(query_centroids_of(w.queries[t], &c, NULL), FROE_OK);
            deep += query_is_deep(w.trees[t]);
            for (uint64_t seed = 0; seed < 3000; seed++) {
                world_dice d = {seed, 0};
                double a[2], b[2], lo[2], hi[2];
                world_point(&w, &d, a);
                world_near(&w, &d, seed % 2 ? ldexp(1, -(int)world_below(&d, 60)) : 0, a, b);
                for (int k = 0; k < 2; k++) lo[k] = fmin(a[k], b[k]), hi[k] = fmax(a[k], b[k]);
                assert_int_equal(query_centroid_find(c, lo, hi, &steps), deepest(w.trees[t], c, lo, hi));
            }
        }
        world_end(&w);
    }
    assert_true(deep > 0);
}

/* Only places near the middle of nested squares lie deep. */
static void ranges_in_deep_trees_meet_what_they_should(void **state) {
    world w = world_begin("nested", world_generate("nested", 600));
    (void)state;
    for (uint64_t seed = 0; seed < 90; seed++) {
        w.scale = ldexp(1, -(int)(seed % 60));
        w.origin[0] = w.origin[1] = -0.5 * w.scale;
        ask(&w, (froe_range_shape)(seed % FROE_SHAPE_COUNT), seed);
    }
    world_end(&w);
}

static froe_status search(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    tree_draft draft;
    const query_centroids *c;
    const double x[2] = {0, 0};
    uint32_t node = 0, child;
    const tree_meta meta = {.method = "chain", .leaf = 1};
    (void)user;
    bool drafted = false;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_add(scene, FROE_POINT, 1, x, NULL, NULL);
    if (!status) {
        status = draft_new(alloc, 2, 0, &draft);
        drafted = !status;
    }
    for (uint32_t i = 0; i < 60 && !status; i++, node = child + 1) {
        const froe_cut cut = {.kind = FROE_CUT_AXIS, .value = i + 1};
        status = draft_split(&draft, node, &cut, 0, &child);
    }
    if (!status) status = draft_seal(&draft, NULL, 0, scene, &meta, &tree);
    if (drafted) draft_free(&draft);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = query_centroids_of(q, &c, NULL);
    if (!status) assert_true(query_is_deep(tree));
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void centroids_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(search, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(deep_chains_are_searched_in_few_steps),
        cmocka_unit_test(centroids_find_the_node_that_descent_finds),
        cmocka_unit_test(ranges_in_deep_trees_meet_what_they_should),
        cmocka_unit_test(centroids_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
