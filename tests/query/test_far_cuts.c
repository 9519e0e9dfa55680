/* test_far_cuts.c: queries to trees above dimension 3 whose cuts are oblique, against a tree of one leaf. */
#include "tree/tree.h"
#include "tree/validate.h"
#include <froe/query.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/scatter.h"

enum { OBJECTS = 120, QUESTIONS = 150 };

/* Balls, boxes and points, most of them disjoint. */
static froe_scene *scatter(int dim, uint64_t seed) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_BALL, OBJECTS / 2, 0, 0.9, seed), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_BOX, OBJECTS / 4, 0, 0.5, seed + 1), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_POINT, OBJECTS / 4, 0, 0, seed + 2), FROE_OK);
    return scene;
}

static froe_tree *build(froe_scene *scene, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree;
    o.method = "density";
    o.leaf = leaf;
    o.threads = exact.threads = 1;
    exact.exact_only = true;
    if (froe_build(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s", diag.message);
    return tree;
}

static uint32_t oblique_cuts(const froe_tree *tree) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < tree->cut_count; i++) count += tree->cuts[i].kind != FROE_CUT_AXIS;
    return count;
}

static froe_query *ask(const froe_tree *tree) {
    froe_query *query;
    assert_int_equal(froe_query_new(tree, &query, NULL), FROE_OK);
    return query;
}

static void assert_same_list(froe_list a, froe_list b) {
    assert_int_equal(a.count, b.count);
    bool has[2][OBJECTS] = {{false}}; /* they come in any order */
    for (size_t i = 0; i < a.count; i++) has[0][a.ids[i]] = has[1][b.ids[i]] = true;
    assert_memory_equal(has[0], has[1], sizeof has[0]);
}

static void compare_range(froe_query *one, froe_query *other, const froe_range *range) {
    froe_list a, b;
    assert_int_equal(froe_query_range(one, range, &a, NULL), FROE_OK);
    assert_int_equal(froe_query_range(other, range, &b, NULL), FROE_OK);
    assert_same_list(a, b);
}

static void compare_queries(fuzz_source *r, const froe_tree *tree, const froe_tree *plain) {
    const int dim = tree->scene->dim;
    froe_query *one = ask(tree), *other = ask(plain);
    for (int i = 0; i < QUESTIONS; i++) {
        double x[2 * FROE_MAX_DIM], d[FROE_MAX_DIM];
        froe_list a, b;
        for (int k = 0; k < dim; k++) {
            x[k] = tree->scene->lo[k] + (tree->scene->hi[k] - tree->scene->lo[k]) * (0.5 + 0.5 * fuzz_unit(r));
            d[k] = fuzz_unit(r);
            x[dim + k] = x[k] + 0.3 * fabs(d[k]);
        }
        if (i % 3 == 0) /* corners and centres lie in and near cuts */
            memcpy(x, scene_point(tree->scene, base_below(fuzz_bits(r), tree->scene->object_count), 0),
                   (size_t)dim * sizeof *x);
        for (int k = 0; k < dim; k++) x[dim + k] = x[k] + 0.3 * fabs(d[k]);
        assert_int_equal(froe_query_locate(one, x, &a, NULL), FROE_OK);
        assert_int_equal(froe_query_locate(other, x, &b, NULL), FROE_OK);
        assert_same_list(a, b);
        froe_range range = froe_range_defaults();
        range.points = x;
        compare_range(one, other, &range);
        range.shape = FROE_SHAPE_BALL;
        range.radius = 0.2;
        compare_range(one, other, &range);
        froe_hit hit, same;
        assert_int_equal(froe_query_ray(one, x, d, 10, &hit, NULL), FROE_OK);
        assert_int_equal(froe_query_ray(other, x, d, 10, &same, NULL), FROE_OK);
        assert_int_equal(hit.object, same.object);
        froe_neighbours near, likewise;
        assert_int_equal(froe_query_near(one, x, 5, INFINITY, &near, NULL), FROE_OK);
        assert_int_equal(froe_query_near(other, x, 5, INFINITY, &likewise, NULL), FROE_OK);
        assert_int_equal(near.count, likewise.count);
        for (size_t k = 0; k < near.count; k++) assert_int_equal(near.items[k].object, likewise.items[k].object);
    }
    froe_query_free(one), froe_query_free(other);
}

static bool add_pair(void *user, const froe_pair *pair) {
    *(uint64_t *)user += base_mix(pair->a * 65536 + pair->b + ((uint64_t)pair->kind << 40));
    return true;
}

static uint64_t pairs_of(const froe_tree *tree) {
    froe_query *query = ask(tree);
    uint64_t sum = 0;
    assert_int_equal(froe_query_pairs(query, true, add_pair, &sum, NULL), FROE_OK);
    froe_query_free(query);
    return sum;
}

static void answers_are_those_of_one_leaf(void **state) {
    (void)state;
    fuzz_source r = {5};
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++) {
        froe_scene *scene = scatter(dim, (uint64_t)dim);
        froe_tree *tree = build(scene, 1), *plain = build(scene, OBJECTS);
        assert_true(oblique_cuts(tree) > 3);
        assert_int_equal(plain->node_count, 1);
        compare_queries(&r, tree, plain);
        assert_true(pairs_of(tree) == pairs_of(plain));
        froe_tree_free(tree), froe_tree_free(plain), froe_scene_free(scene);
    }
}

/* Two balls 2^-101 of their size apart, across a direction of 3, 4. */
static froe_scene *narrow(int dim) {
    const double k = 0x1p49, radii[2] = {5 * k, 5 * k};
    double centres[2 * FROE_MAX_DIM] = {0};
    froe_scene *scene;
    centres[dim] = 6 * k + 4;
    centres[dim + 1] = 8 * k - 3;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BALL, 2, centres, radii, NULL), FROE_OK);
    return scene;
}

static void cuts_finer_than_doubles_are_kept_in_files(void **state) {
    (void)state;
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++) {
        froe_scene *scene = narrow(dim);
        froe_tree *tree = build(scene, 1), *again;
        const double touch[FROE_MAX_DIM] = {3 * 0x1p49, 4 * 0x1p49}; /* of the first ball */
        uint32_t fine = 0;
        assert_int_equal(froe_tree_report(tree).inseparable, 0);
        while (fine < tree->cut_count && tree->cuts[fine].kind != FROE_CUT_FINE) fine++;
        assert_true(fine < tree->cut_count);
        assert_int_equal(froe_tree_save(tree, "fine.froe", NULL), FROE_OK);
        assert_int_equal(froe_tree_open("fine.froe", NULL, &again, NULL), FROE_OK);
        assert_int_equal(froe_tree_audit(again, NULL, NULL), FROE_OK);
        const froe_node_info info = froe_tree_node(again, froe_tree_root(again));
        assert_int_equal(info.cut.kind, FROE_CUT_FINE);
        assert_true(info.cut.value == info.cut.normal[dim] && isfinite(info.cut.value) && info.cut.value != 0);
        froe_query *query = ask(again);
        froe_list found;
        assert_int_equal(froe_query_locate(query, touch, &found, NULL), FROE_OK);
        assert_true(found.count == 1 && found.ids[0] == 0);
        froe_query_free(query);
        /* numbers of rows that there cannot be */
        uint32_t *rows = &tree->cuts[fine].u.id.b;
        const uint32_t right = *rows, wrong[] = {0, GEOM_FINE_ROWS + 1, right + 1, UINT32_MAX};
        assert_int_equal(tree_validate(tree, NULL), FROE_OK);
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
            *rows = wrong[i];
            assert_int_equal(tree_validate(tree, NULL), FROE_E_FORMAT);
        }
        *rows = right;
        froe_tree_free(tree), froe_tree_free(again), froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_those_of_one_leaf),
        cmocka_unit_test(cuts_finer_than_doubles_are_kept_in_files),
    };
    return cmocka_run_group_tests_name("query/far_cuts", tests, NULL, NULL);
}
