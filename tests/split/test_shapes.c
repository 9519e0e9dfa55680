/* Shapes of many parts: which objects are one shape, their boxes, and bounds of the guard stage that count shapes. */
#include "split/guard/shapes.h"
#include "support/memory.h"
#include "tree/trees.h"
#include <math.h>
#include <string.h>

/* `shapes` zigzags of `parts` segments in cells of a grid, of one group each; then `alone` points without a group. One
 * more group in front is of no object. */
static froe_scene *zigzags(const froe_allocator *alloc, uint32_t shapes, uint32_t parts, uint32_t alone) {
    froe_scene *scene = NULL;
    froe_group group = {.name = "none"};
    if (froe_scene_new(2, alloc, &scene)) return NULL;
    froe_status status = froe_scene_add_group(scene, &group, NULL);
    for (uint32_t i = 0; i < shapes && !status; i++) {
        froe_objects one = froe_objects_defaults();
        group.name = "zigzag";
        status = froe_scene_add_group(scene, &group, &one.group);
        one.kind = FROE_SEGMENT, one.count = 1;
        for (uint32_t j = 0; j < parts && !status; j++) {
            const double x = i % 8, y = floor(i / 8.0), high = j % 2 ? 0.75 : 0;
            const double line[4] = {x + 0.75 * j / parts, y + high, x + 0.75 * (j + 1) / parts, y + 0.75 - high};
            one.coords = line;
            status = froe_scene_add(scene, &one, NULL);
        }
    }
    for (uint32_t i = 0; i < alone && !status; i++) {
        const double point[2] = {i + 0.875, 0.875};
        froe_objects one = froe_objects_defaults();
        one.kind = FROE_POINT, one.count = 1, one.coords = point;
        status = froe_scene_add(scene, &one, NULL);
    }
    if (!status) return scene;
    froe_scene_free(scene);
    return NULL;
}

static void shapes_are_groups_and_objects_without_one(void **state) {
    const froe_allocator alloc = support_allocator(NULL);
    froe_scene *scene = zigzags(NULL, 10, 7, 3);
    split_shapes shapes;
    (void)state;
    assert_int_equal(split_shapes_make(&alloc, scene, &shapes), FROE_OK);
    assert_int_equal(shapes.count, 13);
    assert_int_equal(froe_scene_object_count(shapes.boxes), 13);
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++)
        assert_int_equal(shapes.of[i], i < 70 ? i / 7 : 10 + i - 70);
    for (uint32_t shape = 0; shape < 13; shape++) {
        double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, box_lo[2], box_hi[2];
        for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
            if (shapes.of[i] != shape) continue;
            for (uint32_t corner = 0; corner < froe_scene_object(scene, i).corners; corner++)
                for (int k = 0; k < 2; k++) {
                    const double x = froe_scene_vertex(scene, froe_scene_corner(scene, i, corner))[k];
                    lo[k] = fmin(lo[k], x), hi[k] = fmax(hi[k], x);
                }
        }
        scene_object_bounds(shapes.boxes, shape, box_lo, box_hi);
        assert_memory_equal(lo, box_lo, sizeof lo);
        assert_memory_equal(hi, box_hi, sizeof hi);
    }
    split_shapes_free(&alloc, &shapes);
    froe_scene_free(scene);
}

static void each_shape_is_counted_once(void **state) {
    const froe_allocator alloc = support_allocator(NULL);
    froe_scene *scene = zigzags(NULL, 4, 5, 2);
    split_shapes shapes;
    split_shape_marks marks;
    (void)state;
    assert_int_equal(split_shapes_make(&alloc, scene, &shapes), FROE_OK);
    assert_int_equal(split_shape_marks_make(&alloc, &shapes, &marks), FROE_OK);
    marks.turn = UINT32_MAX - 1; /* turns begin again at 1 */
    for (int turn = 0; turn < 3; turn++) {
        uint32_t count = 0;
        split_shapes_begin(&marks);
        for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) count += split_shapes_first(&shapes, &marks, i);
        assert_int_equal(count, 6);
    }
    split_shape_marks_free(&alloc, &marks);
    split_shapes_free(&alloc, &shapes);
    froe_scene_free(scene);
}

/* What a tree of the guard stage alone promises, and whether it holds. */
static double promised(const froe_scene *scene, const char *settings, const char *name) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    double out = -1;
    o.method = "density", o.leaf = 1, o.settings = settings;
    assert_int_equal(build_tuned((froe_scene *)scene, &o, &tree, NULL), FROE_OK);
    assert_int_equal(froe_tree_audit(tree, NULL, NULL), FROE_OK);
    const froe_report report = froe_tree_report(tree);
    for (size_t i = 0; report.promises[i].name; i++) {
        assert_true(report.promises[i].measured <= report.promises[i].promised);
        if (!strcmp(report.promises[i].name, name)) out = report.promises[i].promised;
    }
    froe_tree_free(tree);
    return out;
}

/* 64 disjoint shapes of 4 to 256 parts: fewer cells than (2^d - 1)(2 m / k - 1) + 1 for the m guards of 64 boxes, and
 * doubling ends at lambda = 2 whatever the parts, since no cell meets more than 10 shapes. Guards of parts grow with
 * them, and so does lambda, because a zigzag is as dense as it has parts. */
static void bounds_of_the_guard_stage_count_shapes(void **state) {
    (void)state;
    double last = 0;
    for (uint32_t parts = 4; parts <= 256; parts *= 4) {
        froe_scene *scene = zigzags(NULL, 64, parts, 0);
        assert_true(promised(scene, "k=4 guards=shape", "guard_leaves") == 3 * (2 * 256.0 / 4 - 1) + 1);
        assert_true(promised(scene, "mode=doubling guards=shape", "guard_load") == 10);
        assert_true(promised(scene, "k=4", "guard_leaves") >= parts * 100.0);
        const double load = promised(scene, "mode=doubling", "guard_load");
        assert_true(load >= last);
        last = load;
        froe_scene_free(scene);
    }
    assert_true(last >= 160);
}

/* Without groups each object is a shape of its own, and has the guards of its own box. */
static void objects_without_groups_are_shapes_of_their_own(void **state) {
    static const double coords[] = {0, 0, 1, 2, 3, 0, 4, 1, 0, 5, 6, 5, 2, 3, 5, 4};
    const froe_allocator alloc = support_allocator(NULL);
    (void)state;
    froe_scene *scene = NULL;
    froe_objects lines = froe_objects_defaults();
    split_shapes shapes;
    lines.kind = FROE_SEGMENT, lines.count = 4, lines.coords = coords;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &lines, NULL), FROE_OK);
    assert_int_equal(split_shapes_make(&alloc, scene, &shapes), FROE_OK);
    assert_int_equal(shapes.count, 4);
    for (uint32_t i = 0; i < 4; i++) assert_int_equal(shapes.of[i], i);
    split_shapes_free(&alloc, &shapes);
    assert_true(promised(scene, "k=2 guards=shape", "guard_leaves") == promised(scene, "k=2", "guard_leaves"));
    froe_scene_free(scene);
}

static froe_status build_shapes(void *user, const froe_allocator *alloc) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    (void)user;
    o.method = "density", o.leaf = 1, o.settings = "mode=doubling guards=shape stop=1", o.threads = 1;
    froe_scene *scene = zigzags(alloc, 6, 8, 2);
    if (!scene) return FROE_E_MEMORY;
    const froe_status status = build_tuned(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void shapes_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(build_shapes, NULL) > 60);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_are_groups_and_objects_without_one),
        cmocka_unit_test(each_shape_is_counted_once),
        cmocka_unit_test(bounds_of_the_guard_stage_count_shapes),
        cmocka_unit_test(objects_without_groups_are_shapes_of_their_own),
        cmocka_unit_test(shapes_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
