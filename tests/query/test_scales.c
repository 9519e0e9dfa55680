/* test_scales.c: objects of very different sizes in one tree: blocks of objects that are too small for units, and boxes
 * in classes at both ends of doubles. Another tree, or brute force, says what the answers are. */
#include "asked.h"
#include "query/context.h"
#include <math.h>

enum { SMALL = 40, LARGE = 40, BOTH = SMALL + LARGE };

/* Triangles around 0, and in a corner of [0, 1]^3 others of size 2^-power. */
static froe_scene *of_two_sizes(int power, double coords[BOTH][9]) {
    froe_scene *scene;
    size_t starts[BOTH + 1] = {0};
    for (size_t i = 0; i < BOTH; i++) {
        starts[i + 1] = 3 * (i + 1);
        for (size_t k = 0; k < 9; k++) {
            const double middle = trees_unit(21, 3 * i + k % 3), off = 0.2 * trees_unit(22, 9 * i + k);
            coords[i][k] = i < SMALL ? ldexp(middle + off, -power) : 0.25 + middle + off;
        }
    }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, BOTH, coords[0], NULL, starts), FROE_OK);
    return scene;
}

/* Which objects a box meets, as two trees say. */
static size_t compare_windows(froe_query *q, froe_query *plain, const double *lo, double size) {
    const double box[6] = {lo[0], lo[1], lo[2], lo[0] + size, lo[1] + size, lo[2] + size};
    froe_range range = froe_range_defaults();
    froe_list a, b;
    range.points = box;
    assert_int_equal(froe_query_range(q, &range, &a, NULL), FROE_OK);
    assert_int_equal(froe_query_range(plain, &range, &b, NULL), FROE_OK);
    assert_same_ids(a.ids, a.count, b.ids, b.count);
    return a.count;
}

static void compare_rays_and_neighbours(froe_query *q, froe_query *plain, const double *at, const double *way) {
    froe_hit one, other;
    froe_neighbours near, again;
    assert_int_equal(froe_query_ray(q, at, way, INFINITY, &one, NULL), FROE_OK);
    assert_int_equal(froe_query_ray(plain, at, way, INFINITY, &other, NULL), FROE_OK);
    assert_int_equal(one.object, other.object);
    for (size_t k = 1; k < BOTH; k += 20) {
        assert_int_equal(froe_query_near(q, at, k, INFINITY, &near, NULL), FROE_OK);
        assert_int_equal(froe_query_near(plain, at, k, INFINITY, &again, NULL), FROE_OK);
        assert_int_equal(near.count, again.count);
        for (size_t i = 0; i < near.count; i++) assert_true(near.items[i].distance == again.items[i].distance);
    }
}

static void blocks_of_objects_too_small_for_units_answer_as_other_trees_do(void **state) {
    static const int powers[] = {0, 300, 590, 650, 900, 1000};
    static double coords[BOTH][9];
    size_t small = 0;
    (void)state;
    for (size_t p = 0; p < sizeof powers / sizeof *powers; p++) {
        froe_scene *scene = of_two_sizes(powers[p], coords);
        froe_query *q = ask(trees_build(scene, "index", 6)), *plain = ask(trees_build(scene, "autopartition", 1));
        for (size_t i = 0; i < 60; i++) {
            const double unit = i % 2 ? ldexp(1, -powers[p]) : 1;
            double at[3], way[3];
            for (size_t k = 0; k < 3; k++) {
                at[k] = unit * (1.4 * trees_unit(23, 3 * i + k) - 0.2);
                way[k] = unit * (trees_unit(24, 3 * i + k) - 0.5);
            }
            const size_t found = compare_windows(q, plain, at, unit * 0.3);
            if (i % 2) small += found;
            compare_rays_and_neighbours(q, plain, at, way);
        }
        end_query(q), end_query(plain);
        froe_scene_free(scene);
    }
    assert_true(small > 100);
}

/* Boxes with the edges 2^e in R^5 for e at both ends and between; windows of all these sizes. */
static void classes_hold_boxes_at_both_ends_of_doubles(void **state) {
    static const int edges[] = {-1074, -1072, -1022, -500, 0, 3, 500, 1000, 1021, 1022};
    enum { DIM = 5, EDGES = sizeof edges / sizeof *edges, EACH = 8, BOXES = EDGES * EACH };
    static double boxes[BOXES][2 * DIM];
    froe_scene *scene;
    size_t sum = 0;
    (void)state;
    for (size_t i = 0; i < BOXES; i++)
        for (size_t k = 0; k < DIM; k++) {
            const double edge = ldexp(1, edges[i / EACH]);
            boxes[i][k] = edge * floor(3 * trees_unit(31, DIM * i + k) - 2);
            boxes[i][DIM + k] = boxes[i][k] + edge;
        }
    assert_int_equal(froe_scene_new(DIM, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, BOXES, boxes[0], NULL, NULL), FROE_OK);
    froe_query *q = ask(trees_build(scene, "density", 4));
    for (size_t i = 0; i < BOXES; i++)
        for (froe_walk walk = 0; walk < FROE_WALK_COUNT; walk++) {
            froe_range range = froe_range_defaults();
            froe_list found;
            uint32_t right[BOXES], any;
            size_t count = 0;
            range.points = boxes[i], range.walk = walk;
            for (uint32_t j = 0; j < BOXES; j++) {
                bool meets = true;
                for (size_t k = 0; k < DIM; k++)
                    meets &= boxes[j][k] <= boxes[i][DIM + k] && boxes[i][k] <= boxes[j][DIM + k];
                if (meets) right[count++] = j;
            }
            const froe_status status = froe_query_range(q, &range, &found, NULL);
            if (status == FROE_E_UNSUPPORTED) continue;
            assert_int_equal(status, FROE_OK);
            assert_same_ids(found.ids, found.count, right, count);
            assert_int_equal(froe_query_any(q, &range, &any, NULL), FROE_OK);
            bool is_right = false;
            for (size_t j = 0; j < count; j++) is_right |= right[j] == any;
            assert_true(is_right);
            sum += count;
        }
    assert_true(sum > 2500);
    end_query(q);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_of_objects_too_small_for_units_answer_as_other_trees_do),
        cmocka_unit_test(classes_hold_boxes_at_both_ends_of_doubles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
