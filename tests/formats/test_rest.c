/* test_rest.c: models at rest as motions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/memory.h"
#include <froe/formats.h>
#include <string.h>

/* A square, and a triangle that shares an edge with it; each a group. */
static froe_scene *make_model(void) {
    froe_scene *scene = NULL;
    const double at[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 2, 1};
    const size_t starts[] = {0, 4, 7};
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t id;
        froe_objects o = froe_objects_defaults();
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = i ? "roof" : "floor"}, &id), FROE_OK);
        o.kind = FROE_POLYGON, o.count = 1, o.coords = at, o.starts = starts + i, o.group = id;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return scene;
}

static void polygons_are_triangles_that_rest(void **state) {
    (void)state;
    froe_scene *model = make_model();
    froe_motion *m = NULL;
    double at[3], again[3];
    assert_int_equal(froe_motion_at_rest(model, -1, 3, NULL, &m, NULL), FROE_OK);
    froe_scene_free(model);
    assert_int_equal(froe_motion_object_count(m), 3);
    assert_true(froe_motion_window(m).begin == -1 && froe_motion_window(m).end == 3);
    assert_string_equal(froe_motion_group(m, froe_motion_object(m, 2).group).name, "roof");
    assert_int_equal(froe_motion_object(m, 0).group, froe_motion_object(m, 1).group);
    size_t shared = 0;
    for (uint32_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t v = froe_motion_object(m, i).vertices[k];
            assert_true(froe_motion_position(m, v, -1, at) && froe_motion_position(m, v, 3, again));
            assert_memory_equal(at, again, sizeof at);
            for (int n = 0; n < 3 && i; n++) shared += v == froe_motion_object(m, 0).vertices[n];
        }
    assert_int_equal(shared, 3); /* equal corners are one vertex: two of the square's other half, one of the roof */
    froe_motion_free(m);
}

static void what_is_no_model_is_refused(void **state) {
    (void)state;
    froe_scene *plane = NULL, *model = make_model();
    froe_motion *m = NULL;
    froe_diagnostic diag;
    const double segment[] = {0, 0, 0, 1, 1, 1};
    froe_objects o = froe_objects_defaults();
    assert_int_equal(froe_scene_new(2, NULL, &plane), FROE_OK);
    assert_int_equal(froe_motion_at_rest(plane, 0, 1, NULL, &m, &diag), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_motion_at_rest(model, 1, 1, NULL, &m, &diag), FROE_E_INPUT);
    assert_int_equal(froe_motion_at_rest(model, 0, 1, NULL, NULL, &diag), FROE_E_ARG);
    o.kind = FROE_SEGMENT, o.count = 1, o.coords = segment;
    assert_int_equal(froe_scene_add(model, &o, NULL), FROE_OK);
    assert_int_equal(froe_motion_at_rest(model, 0, 1, NULL, &m, &diag), FROE_E_UNSUPPORTED);
    assert_string_equal(diag.message, "object 2: It is a segment, and only polygons can be a motion at rest.");
    assert_null(m);
    froe_scene_free(plane), froe_scene_free(model);
}

static froe_status rest_once(void *user, const froe_allocator *alloc) {
    froe_motion *m = NULL;
    const froe_status status = froe_motion_at_rest(user, 0, 1, alloc, &m, NULL);
    froe_motion_free(m);
    return status;
}

static void allocations_may_fail(void **state) {
    (void)state;
    froe_scene *model = make_model();
    assert_true(test_memory_each(rest_once, model) > 5);
    froe_scene_free(model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_are_triangles_that_rest),
        cmocka_unit_test(what_is_no_model_is_refused),
        cmocka_unit_test(allocations_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
