/* Windows of packed trees of space at the edges: of boxes of leaves, of the scene, and after other questions. */
#include "query/context.h"
#include "tree/trees.h"

static bool finds(froe_query *q, uint32_t object, const double *x) {
    const double box[6] = {x[0], x[1], x[2], x[0], x[1], x[2]};
    froe_range range = froe_range_defaults();
    froe_list list;
    bool found = false;
    range.points = box;
    assert_int_equal(froe_query_range(q, &range, &list, NULL), FROE_OK);
    for (size_t i = 0; i < list.count; i++) found |= list.ids[i] == object;
    return found;
}

/* Triangles on three floors, so that boxes of leaves have no height. */
static froe_tree *tree_of_floors(void) {
    static const double height[] = {0, 0.25, 1};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < 60; i++) {
        double c[9];
        for (uint32_t j = 0; j < 9; j++) c[j] = j % 3 < 2 ? trees_unit(3, 9 * i + j) : height[i % 3];
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, c, NULL, NULL), FROE_OK);
    }
    froe_tree *t = trees_build(scene, "index", 4);
    froe_scene_free(scene);
    return t;
}

/* A corner may lie beyond the box of its leaf by 2^-20 units, and is found there. */
static void corners_just_outside_of_boxes_are_found(void **state) {
    froe_tree *t = tree_of_floors();
    froe_scene *s = t->scene;
    froe_query *q;
    size_t moved = 0;
    (void)state;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (uint32_t i = 0; i < s->object_count; i++)
        for (uint32_t c = 0; c < 18; c++) {
            double *x = s->coords + 3 * (size_t)scene_corner(s, i, c / 6) + c / 2 % 3;
            const double was = *x;
            *x += (c % 2 ? 1 : -1) * 0x1p-38;
            if (froe_tree_audit(t, NULL, NULL) == FROE_OK) {
                moved++;
                if (!finds(q, i, scene_point(s, i, c / 6))) fail_msg("object %u, corner %u", i, c / 6);
            }
            *x = was;
        }
    assert_true(moved > 300);
    froe_query_free(q);
    froe_tree_free(t);
}

/* What a context has been asked before does not matter: here, by a ball around the end of a segment, for a box that the
 * segment passes. */
static void boxes_are_boxes_after_balls(void **state) {
    const double segment[6] = {0, 1, 4, 2, 3, 2}, more[6] = {5, 5, 5, 6, 6, 6}, box[6] = {1, 0, 2, 1, 1, 3};
    froe_scene *scene;
    froe_query *q;
    froe_list list;
    froe_range range = froe_range_defaults(), ball = froe_range_defaults();
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, segment, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, more, NULL, NULL), FROE_OK);
    froe_tree *t = trees_build(scene, "index", 8);
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    ball.shape = FROE_SHAPE_BALL, ball.points = segment, ball.radius = 0.5;
    range.points = box;
    assert_int_equal(froe_query_range(q, &ball, &list, NULL), FROE_OK);
    assert_int_equal(list.count, 1);
    assert_int_equal(froe_query_range(q, &range, &list, NULL), FROE_OK);
    assert_int_equal(list.count, 0);
    froe_query_free(q);
    froe_tree_free(t);
    froe_scene_free(scene);
}

static void windows_beside_the_scene_meet_no_leaf(void **state) {
    froe_tree *t = tree_of_floors();
    froe_range range = froe_range_defaults();
    froe_query *q;
    froe_list found;
    (void)state;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    for (int side = 0; side < 6; side++) {
        double w[6];
        memcpy(w, t->meta.root_lo, 3 * sizeof *w), memcpy(w + 3, t->meta.root_hi, 3 * sizeof *w);
        const double width = w[3 + side / 2] - w[side / 2];
        w[side / 2] += (side % 2 ? 1 : -1) * 1.5 * width;
        w[3 + side / 2] = w[side / 2] + width;
        range.points = w;
        const uint64_t leaves = q->stats.leaves, nodes = q->stats.nodes;
        assert_int_equal(froe_query_range(q, &range, &found, NULL), FROE_OK);
        assert_int_equal(found.count, 0);
        assert_int_equal(q->stats.leaves, leaves);
        assert_true(q->stats.nodes <= nodes + 1);
    }
    froe_query_free(q);
    froe_tree_free(t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_just_outside_of_boxes_are_found),
        cmocka_unit_test(windows_beside_the_scene_meet_no_leaf),
        cmocka_unit_test(boxes_are_boxes_after_balls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
