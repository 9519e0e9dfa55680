/* Small cells of segments: whatever the table of sides cannot hold or be sure of, the tree is right. */
#include "finish_trees.h"

#include "base/random.h"

enum { SEGMENTS = 48 };

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

static uint64_t check(const double *coords, size_t count, uint32_t least) {
    froe_scene *scene = scene_of(coords, count);
    const uint64_t pieces = check_scene(scene, least);
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
