/* test_overfull.c: leaves with more objects than they may hold, and their reasons: audits find the false ones. */
#include "audits.h"

/* All objects in one leaf of capacity 1. Takes the scene. */
static froe_tree *one_leaf(froe_scene *scene, uint8_t flags) {
    const tree_meta one = {.method = "by hand", .leaf = 1};
    tree_draft draft;
    froe_tree *tree;
    assert_int_equal(draft_new(NULL, scene->dim, 0, &draft), FROE_OK);
    draft_leaf(&draft, 0, flags);
    assert_int_equal(draft_list(&draft, 0), FROE_OK);
    for (uint32_t i = 0; i < scene->object_count; i++) assert_int_equal(draft_piece(&draft, 0, i, NULL, 0), FROE_OK);
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &one, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    return tree;
}

static froe_tree *crowd(int dim, froe_kind kind, size_t count, const double *coords, const double *radii,
                        const size_t *starts, uint8_t flags) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, kind, count, coords, radii, starts), FROE_OK);
    return one_leaf(scene, flags);
}

static void assert_crowd(froe_tree *tree, const char *what) {
    if (what)
        assert_wrong(tree, what);
    else
        assert_right(tree);
    froe_tree_free(tree);
}

static void overfull_leaves_are_found(void **state) {
    (void)state;
    const double points[4] = {0, 0, 1, 0}, same[4] = {2, 2, 2, 2}, segments[8] = {0, 0, 1, 1, 0, 1, 1, 0};
    assert_crowd(crowd(2, FROE_POINT, 2, points, NULL, NULL, 0), "The leaf has 2 pieces, and room for 1.");
    assert_crowd(crowd(2, FROE_POINT, 2, points, NULL, NULL, TREE_INSEPARABLE), "called inseparable");
    assert_crowd(crowd(2, FROE_POINT, 2, same, NULL, NULL, TREE_INSEPARABLE), NULL);
    assert_crowd(crowd(2, FROE_POINT, 1, same, NULL, NULL, TREE_INSEPARABLE), "not over capacity");
    assert_crowd(crowd(2, FROE_SEGMENT, 2, segments, NULL, NULL, TREE_INSEPARABLE), "support");
}

static void crowds_that_are_none_are_found(void **state) {
    (void)state;
    /* two overlapping pairs of three; one of three; a flat box, which ends in a cut, in another */
    const double most[12] = {0, 0, 2, 2, 1, 1, 4, 4, 3, 3, 5, 5}, few[12] = {0, 0, 2, 2, 1, 1, 4, 4, 5, 5, 6, 6};
    const double flat[8] = {0, 0, 2, 2, 1, -1, 1, 3}, points[4] = {0, 0, 1, 0};
    const double centres[6] = {0, 0, 1, 1, 2, 2}, radii[3] = {1, 1, 1}, small[3] = {1, 0.3, 1};
    assert_crowd(crowd(2, FROE_BOX, 3, most, NULL, NULL, TREE_CROWDED), NULL);
    assert_crowd(crowd(2, FROE_BOX, 3, few, NULL, NULL, TREE_CROWDED), "called crowded, but most pairs");
    assert_crowd(crowd(2, FROE_BOX, 2, flat, NULL, NULL, TREE_CROWDED), "called crowded, but most pairs");
    assert_crowd(crowd(2, FROE_BOX, 1, most, NULL, NULL, TREE_CROWDED), "called crowded, but is not over capacity");
    assert_crowd(crowd(2, FROE_POINT, 2, points, NULL, NULL, TREE_CROWDED), "called crowded, but the support");
    assert_crowd(crowd(2, FROE_BALL, 3, centres, radii, NULL, TREE_CROWDED), NULL);
    assert_crowd(crowd(2, FROE_BALL, 3, centres, small, NULL, TREE_CROWDED), "called crowded, but most pairs");
}

/* A ball beside a corner of the unit box, in one leaf: they touch where the radius is sqrt(dim) / 2. */
static froe_tree *ball_and_box(int dim, double radius) {
    double box[2 * FROE_MAX_DIM], centre[FROE_MAX_DIM];
    froe_scene *scene;
    for (int k = 0; k < dim; k++) box[k] = 0, box[dim + k] = 1, centre[k] = 1.5;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BALL, 1, centre, &radius, NULL), FROE_OK);
    return one_leaf(scene, TREE_INSEPARABLE);
}

/* A builder that gives up a pair is found, down to the last place of the radius. */
static void separable_solids_of_unlike_kinds_are_found(void **state) {
    (void)state;
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++) {
        const double touch = sqrt(dim) / 2; /* rounded: the box begins there, or at the next double */
        assert_crowd(ball_and_box(dim, 0.6), "called inseparable, but a plane");
        assert_crowd(ball_and_box(dim, nextafter(touch, 0)), "called inseparable, but a plane");
        assert_crowd(ball_and_box(dim, nextafter(touch, 2)), NULL);
        assert_crowd(ball_and_box(dim, touch + 0.01), NULL);
    }
}

static void separable_boxes_are_found(void **state) {
    (void)state;
    const double overlapping[12] = {0, 0, 2, 2, 1, 1, 3, 3, 1, 0, 2, 3}, touching[8] = {0, 0, 1, 1, 1, 0, 2, 1};
    const double flat[8] = {0, 0, 2, 2, 1, -1, 1, 3};
    assert_crowd(crowd(2, FROE_BOX, 3, overlapping, NULL, NULL, TREE_INSEPARABLE), NULL);
    assert_crowd(crowd(2, FROE_BOX, 2, touching, NULL, NULL, TREE_INSEPARABLE), "axis-parallel");
    assert_crowd(crowd(2, FROE_BOX, 2, flat, NULL, NULL, TREE_INSEPARABLE), "axis-parallel"); /* by the flat one */
}

static void separable_balls_and_hulls_are_found(void **state) {
    (void)state;
    const double centres[6] = {0, 0, 1.5, 1.5, 0.5, 0.5}, radii[3] = {1, 1, 1}, large[3] = {2, 2, 2};
    assert_crowd(crowd(2, FROE_BALL, 2, centres, large, NULL, TREE_INSEPARABLE), NULL);
    assert_crowd(crowd(2, FROE_BALL, 3, centres, large, NULL, TREE_INSEPARABLE), NULL);
    assert_crowd(crowd(2, FROE_BALL, 2, centres, radii, NULL, TREE_INSEPARABLE), "a plane separates");
    const double hulls[12] = {0, 0, 4, 0, 0, 4, 4, 4, 4, 0.5, 0.5, 4},
                 crossing[12] = {0, 0, 4, 0, 0, 4, 3, 3, 1, 1, 0, 1};
    const size_t starts[3] = {0, 3, 6};
    assert_crowd(crowd(2, FROE_HULL, 2, hulls, NULL, starts, TREE_INSEPARABLE), "a plane separates");
    assert_crowd(crowd(2, FROE_HULL, 2, crossing, NULL, starts, TREE_INSEPARABLE), NULL);
    const double solid[24] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 2, 2, 5, 0, 0, 0, 5, 0, 0, 0, 5};
    const size_t four[3] = {0, 4, 8};
    assert_crowd(crowd(3, FROE_HULL, 2, solid, NULL, four, TREE_INSEPARABLE), "a plane separates");
}

static void leaf_zero_means_empty_leaves(void **state) {
    (void)state;
    froe_tree *t = trees_grow(2, FROE_SEGMENT, 30, 0, 0.5, "autopartition", 0);
    assert_right(t);
    froe_tree_free(t);
    t = trees_grow(2, FROE_SEGMENT, 30, 0, 0.5, "autopartition", 1);
    t->meta.leaf = t->report.leaf = 0;
    assert_wrong(t, "room for 0.");
    froe_tree_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overfull_leaves_are_found),
        cmocka_unit_test(crowds_that_are_none_are_found),
        cmocka_unit_test(separable_boxes_are_found),
        cmocka_unit_test(separable_solids_of_unlike_kinds_are_found),
        cmocka_unit_test(separable_balls_and_hulls_are_found),
        cmocka_unit_test(leaf_zero_means_empty_leaves),
    };
    return cmocka_run_group_tests_name("tree/overfull", tests, NULL, NULL);
}
