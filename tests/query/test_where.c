/* Where on an object, by the public functions; that the numbers are exact is tested in tests/geom/test_places.c. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <froe/query.h>
#include <math.h>
#include <string.h>

static froe_query *ask(int dim, froe_kind kind, const double *coords, const double *radii, froe_tree **tree) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    froe_build_options b = froe_build_defaults();
    froe_query *q;
    b.purpose = "query";
    o.kind = kind, o.count = 1, o.coords = coords, o.radii = radii;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, &b, tree, NULL), FROE_OK);
    froe_scene_free(scene);
    assert_int_equal(froe_query_new(*tree, &q, NULL), FROE_OK);
    return q;
}

static void done(froe_query *q, froe_tree *tree) {
    froe_query_free(q);
    froe_tree_free(tree);
}

static void assert_place(froe_query *q, const double *o, const double *d, const double expected[3],
                         const double normal[3], double distance) {
    froe_hit_place got;
    assert_int_equal(froe_query_hit_place(q, 0, o, d, &got, NULL), FROE_OK);
    for (int k = 0; k < 3; k++) {
        assert_true(got.point[k] == expected[k]);
        assert_true(got.normal[k] == normal[k]);
    }
    assert_true(got.distance == distance);
}

/* The corners of a triangle turn left where its normal points, whichever side the ray comes from. */
static void normals_of_triangles_are_their_own(void **state) {
    (void)state;
    const double corners[] = {0, 0, 1, 4, 0, 1, 0, 4, 1};
    froe_tree *tree;
    froe_query *q = ask(3, FROE_POLYGON, corners, NULL, &tree);
    assert_place(q, (double[]){1, 1, 5}, (double[]){0, 0, -2}, (double[]){1, 1, 1}, (double[]){0, 0, 1}, 4);
    assert_place(q, (double[]){1, 1, -2}, (double[]){0, 0, 1}, (double[]){1, 1, 1}, (double[]){0, 0, 1}, 3);
    done(q, tree);
    const double turned[] = {0, 0, 1, 0, 4, 1, 4, 0, 1};
    q = ask(3, FROE_POLYGON, turned, NULL, &tree);
    assert_place(q, (double[]){1, 1, 5}, (double[]){0, 0, -2}, (double[]){1, 1, 1}, (double[]){0, 0, -1}, 4);
    done(q, tree);
}

static void normals_of_solids_point_outwards(void **state) {
    (void)state;
    const double box[] = {0, 0, 0, 2, 2, 2}, none[] = {0, 0, 0};
    froe_tree *tree;
    froe_query *q = ask(3, FROE_BOX, box, NULL, &tree);
    assert_place(q, (double[]){-3, 1, 1}, (double[]){3, 0, 0}, (double[]){0, 1, 1}, (double[]){-1, 0, 0}, 3);
    assert_place(q, (double[]){1, 1, 1}, (double[]){3, 0, 0}, (double[]){1, 1, 1}, none, 0);
    done(q, tree);
    q = ask(3, FROE_BALL, (double[]){0, 0, 0}, (double[]){5}, &tree);
    assert_place(q, (double[]){3, 4, 9}, (double[]){0, 0, -1}, (double[]){3, 4, 0}, (double[]){0.6, 0.8, 0}, 9);
    done(q, tree);
}

static void normals_of_segments_point_to_the_left(void **state) {
    (void)state;
    froe_tree *tree;
    froe_query *q = ask(2, FROE_SEGMENT, (double[]){0, 0, 10, 0}, NULL, &tree);
    assert_place(q, (double[]){3, -4}, (double[]){0, 1}, (double[]){3, 0, 0}, (double[]){0, 1, 0}, 4);
    assert_place(q, (double[]){3, 4}, (double[]){0, -1}, (double[]){3, 0, 0}, (double[]){0, 1, 0}, 4);
    done(q, tree);
}

static void the_nearest_point_of_what_contains_a_point_is_the_point(void **state) {
    (void)state;
    const double inside[] = {0.1, 0.2, 0.3}, outside[] = {9, 0.25, -1};
    double at[3];
    froe_tree *tree;
    froe_query *q = ask(3, FROE_BOX, (double[]){0, 0, 0, 1, 1, 1}, NULL, &tree);
    assert_int_equal(froe_query_nearest_point(q, 0, inside, at, NULL), FROE_OK);
    assert_memory_equal(at, inside, sizeof at);
    assert_int_equal(froe_query_nearest_point(q, 0, outside, at, NULL), FROE_OK);
    assert_memory_equal(at, ((double[]){1, 0.25, 0}), sizeof at);
    done(q, tree);
}

static void bad_questions_are_refused(void **state) {
    (void)state;
    double at[2] = {7, 7};
    const double origin[] = {0, 5}, up[] = {0, 1}, nowhere[] = {0, 0}, nan[] = {NAN, 0};
    froe_diagnostic diag;
    froe_hit_place place;
    froe_tree *tree;
    froe_query *q = ask(2, FROE_SEGMENT, (double[]){0, 0, 10, 0}, NULL, &tree);
    assert_int_equal(froe_query_nearest_point(q, 1, origin, at, &diag), FROE_E_ARG);
    assert_string_equal(diag.message, "There is no object 1 in a scene of 1.");
    assert_int_equal(froe_query_nearest_point(q, 0, nan, at, NULL), FROE_E_INPUT);
    assert_int_equal(froe_query_nearest_point(q, 0, NULL, at, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_hit_place(q, FROE_NONE, origin, up, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_hit_place(q, 0, origin, nowhere, &place, NULL), FROE_E_INPUT);
    assert_int_equal(froe_query_hit_place(q, 0, origin, NULL, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_hit_place(q, 0, origin, up, &place, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "The ray does not meet object 0.");
    assert_true(at[0] == 7 && at[1] == 7);
    done(q, tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_of_triangles_are_their_own),
        cmocka_unit_test(normals_of_solids_point_outwards),
        cmocka_unit_test(normals_of_segments_point_to_the_left),
        cmocka_unit_test(the_nearest_point_of_what_contains_a_point_is_the_point),
        cmocka_unit_test(bad_questions_are_refused),
    };
    return cmocka_run_group_tests_name("query/where", tests, NULL, NULL);
}
