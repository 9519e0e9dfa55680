/* Guards of scenes: which vertices, how often, and in which order. */
#include "support/memory.h"

#include "split/guard/guards.h"
#include <string.h>

static froe_scene *new_scene(int dim, froe_kind kind, size_t count, const double *coords, const double *radii) {
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.kind = kind;
    o.count = count;
    o.coords = coords;
    o.radii = radii;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

static split_guards guards_of(const froe_scene *scene, const uint32_t *ids, size_t count, unsigned threads) {
    froe_allocator alloc = support_allocator(NULL);
    base_task task;
    split_guards guards;
    base_task_init(&task, threads, NULL, NULL);
    assert_int_equal(split_guards_of(&alloc, &task, 1, scene, ids, count, &guards), FROE_OK);
    assert_int_equal(guards.dim, froe_scene_dim(scene));
    return guards;
}

static void discard(froe_scene *scene, split_guards *guards) {
    froe_allocator alloc = support_allocator(NULL);
    split_guards_free(&alloc, guards);
    froe_scene_free(scene);
}

static void assert_points(const split_guards *guards, size_t count, const double *points) {
    assert_int_equal(guards->count, count);
    for (size_t i = 0; i < count * (size_t)guards->dim; i++) assert_true(guards->points[i] == points[i]);
}

static void a_segment_has_the_corners_of_its_box(void **state) {
    (void)state;
    const double coords[] = {1, 5, 3, 4};
    const double corners[] = {1, 4, 3, 4, 1, 5, 3, 5};
    froe_scene *scene = new_scene(2, FROE_SEGMENT, 1, coords, NULL);
    split_guards guards = guards_of(scene, NULL, 1, 1);
    assert_points(&guards, 4, corners);
    discard(scene, &guards);
}

static void flat_boxes_have_each_vertex_once(void **state) {
    (void)state;
    const double coords[] = {1, 2, 3, 1, 2, 3, /* a point */
                             0, 2, 3, 1, 2, 3, /* a side */
                             0, 2, 0, 1, 2, 3 /* a face */};
    const double corners[] = {1, 2, 3, 0, 2, 3, 1, 2, 3, 0, 2, 0, 1, 2, 0, 0, 2, 3, 1, 2, 3};
    froe_scene *scene = new_scene(3, FROE_BOX, 3, coords, NULL);
    split_guards guards = guards_of(scene, NULL, 3, 1);
    assert_points(&guards, 7, corners);
    discard(scene, &guards);
}

static void a_box_in_eight_dimensions_has_256_different_guards(void **state) {
    (void)state;
    const double coords[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
    bool seen[256] = {false};
    froe_scene *scene = new_scene(8, FROE_BOX, 1, coords, NULL);
    split_guards guards = guards_of(scene, NULL, 1, 1);
    assert_int_equal(guards.count, 256);
    for (size_t g = 0; g < guards.count; g++) {
        unsigned code = 0;
        for (int i = 0; i < 8; i++) code = 2 * code + (guards.points[8 * g + (size_t)i] > 0);
        assert_false(seen[code]);
        seen[code] = true;
    }
    discard(scene, &guards);
}

static void equal_objects_keep_their_own_guards(void **state) {
    (void)state;
    const double coords[] = {1, 2, 1, 2, 1, 2}, twice[] = {1, 2, 1, 2};
    const uint32_t ids[] = {2, 0};
    froe_scene *scene = new_scene(2, FROE_POINT, 3, coords, NULL);
    split_guards guards = guards_of(scene, ids, 2, 1);
    assert_points(&guards, 2, twice);
    discard(scene, &guards);
}

static void the_order_of_ids_is_the_order_of_guards(void **state) {
    (void)state;
    const double coords[] = {0, 0, 1, 1, 2, 2}, chosen[] = {2, 2, 0, 0};
    const uint32_t ids[] = {2, 0};
    froe_scene *scene = new_scene(2, FROE_POINT, 3, coords, NULL);
    split_guards guards = guards_of(scene, ids, 2, 1);
    assert_points(&guards, 2, chosen);
    discard(scene, &guards);
}

static void guards_of_a_ball_enclose_it(void **state) {
    (void)state;
    const double centre[] = {0.1, 0.2}, radius[] = {0.3};
    froe_scene *scene = new_scene(2, FROE_BALL, 1, centre, radius);
    split_guards guards = guards_of(scene, NULL, 1, 1);
    assert_int_equal(guards.count, 4);
    assert_true(guards.points[0] <= 0.1 - 0.3 && guards.points[6] >= 0.1 + 0.3);
    discard(scene, &guards);
}

static void nothing_has_no_guards(void **state) {
    (void)state;
    froe_scene *scene = new_scene(2, FROE_POINT, 0, NULL, NULL);
    split_guards guards = guards_of(scene, NULL, 0, 2);
    assert_int_equal(guards.count, 0);
    discard(scene, &guards);
}

enum { MANY = 50000 };

/* Boxes of which every third is flat. */
static froe_scene *many_boxes(void) {
    double *coords = malloc(MANY * 4 * sizeof *coords);
    assert_non_null(coords);
    for (size_t b = 0; b < MANY; b++) {
        double *c = coords + 4 * b;
        c[0] = (double)b;
        c[1] = (double)(b % 7);
        c[2] = c[0] + 0.5;
        c[3] = c[1] + (double)(b % 3);
    }
    froe_scene *scene = new_scene(2, FROE_BOX, MANY, coords, NULL);
    free(coords);
    return scene;
}

static void threads_do_not_change_a_guard(void **state) {
    (void)state;
    froe_scene *scene = many_boxes();
    split_guards one = guards_of(scene, NULL, MANY, 1), three = guards_of(scene, NULL, MANY, 3);
    froe_allocator alloc = support_allocator(NULL);
    size_t flat = (MANY + 2) / 3;
    assert_int_equal(one.count, 4 * (MANY - flat) + 2 * flat);
    assert_int_equal(three.count, one.count);
    assert_memory_equal(one.points, three.points, one.count * 2 * sizeof(double));
    split_guards_free(&alloc, &three);
    discard(scene, &one);
}

static froe_status try_guards(void *user, const froe_allocator *alloc) {
    base_task task;
    split_guards guards;
    base_task_init(&task, 2, NULL, NULL);
    froe_status status = split_guards_of(alloc, &task, 1, user, NULL, MANY, &guards);
    if (status == FROE_OK) split_guards_free(alloc, &guards);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_scene *scene = many_boxes();
    assert_int_equal(test_memory_each(try_guards, scene), 2);
    froe_scene_free(scene);
}

static bool refuse(void *user, double done) {
    (void)user;
    return done < 0.6;
}

static void cancelling_leaves_nothing_behind(void **state) {
    (void)state;
    froe_scene *scene = many_boxes();
    test_memory memory;
    froe_allocator alloc = test_memory_begin(&memory);
    base_task task;
    split_guards guards;
    base_task_init(&task, 1, refuse, NULL);
    assert_int_equal(split_guards_of(&alloc, &task, 1, scene, NULL, MANY, &guards), FROE_E_CANCELLED);
    test_memory_end(&memory);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_segment_has_the_corners_of_its_box),
        cmocka_unit_test(flat_boxes_have_each_vertex_once),
        cmocka_unit_test(a_box_in_eight_dimensions_has_256_different_guards),
        cmocka_unit_test(equal_objects_keep_their_own_guards),
        cmocka_unit_test(the_order_of_ids_is_the_order_of_guards),
        cmocka_unit_test(guards_of_a_ball_enclose_it),
        cmocka_unit_test(nothing_has_no_guards),
        cmocka_unit_test(threads_do_not_change_a_guard),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(cancelling_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
