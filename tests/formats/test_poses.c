/* test_poses.c: a table of poses over a model: parts become bodies, and what is wrong is said with line or part. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/memory.h"
#include <froe/formats.h>
#include <math.h>
#include <stdio.h>

/* A floor of two triangles, a square lid above it, and a strut without area. */
static froe_scene *make_model(void) {
    static const double floor_at[] = {-4, -4, 0, 4, -4, 0, 0, 4, 0}, lid[] = {-1, -1, 3, 1, -1, 3, 1, 1, 3, -1, 1, 3};
    static const double strut[] = {9, 9, 0, 9, 9, 4, 9, 9, 4};
    static const char *const names[] = {"floor", "lid", "strut"};
    static const double *const corners[] = {floor_at, lid, strut};
    static const uint32_t counts[] = {3, 4, 3};
    froe_scene *scene = NULL;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t g = 0; g < 3; g++) {
        uint32_t id;
        const size_t starts[] = {0, counts[g]};
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = names[g]}, &id), FROE_OK);
        froe_objects o = froe_objects_defaults();
        o.kind = FROE_POLYGON, o.count = 1, o.coords = corners[g], o.starts = starts, o.group = id;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return scene;
}

static void put(const char *text) {
    FILE *file = fopen("poses.csv", "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

typedef struct found {
    froe_contact first;
    int count;
} found;

static bool note(void *user, const froe_contact *c) {
    found *f = user;
    if (!f->count++) f->first = *c;
    return true;
}

/* The lid falls, tilts, and touches the floor with its lower edge. The table is as spreadsheets write it, with a byte
 * order mark. */
static void parts_fly_by_their_rows(void **state) {
    (void)state;
    froe_scene *model = make_model();
    froe_motion *m = NULL;
    froe_motion_report report;
    found f = {.count = 0};
    put("\xEF\xBB\xBFtime;note;qx;qy;qz;qw;x;y;z;body\n0;a;0;0;0;1;0;0;0;lid\n\n4;b;0;0;0;1;0;0;-4;lid\n8;c;0,6;0;0;0,"
        "8;0;0;-4;"
        "lid\n");
    assert_int_equal(froe_read_poses("poses.csv", model, NULL, &m, &report, NULL), FROE_OK);
    froe_scene_free(model);
    assert_true(report.features == 1 && report.still == 2 && report.pieces == 2);
    assert_int_equal(froe_motion_object_count(m), 4);
    assert_string_equal(froe_motion_group(m, froe_motion_object(m, 1).group).name, "lid");
    assert_true(froe_motion_window(m).begin == 0 && froe_motion_window(m).end == 8);
    double at[3];
    assert_true(froe_motion_position(m, froe_motion_object(m, 1).vertices[0], 2, at) && at[2] == 1);
    assert_int_equal(froe_motion_contacts(m, NULL, note, &f, NULL), FROE_OK);
    assert_true(f.count == 2 && f.first.a == 0 && f.first.begin[0] == 3 && f.first.begin[1] == 3);
    froe_motion_free(m);
}

/* A door of a plan turns by a quarter about its hinge, and its end meets the wall beyond. */
static void parts_of_a_plan_turn_by_their_rows(void **state) {
    (void)state;
    froe_scene *plan = NULL;
    froe_motion *m = NULL;
    froe_motion_report report;
    found f = {.count = 0};
    const double walls[] = {0, 0, 5, 0, 5, 0, 5, 1, 3, 4, 9, 4};
    assert_int_equal(froe_scene_new(2, NULL, &plan), FROE_OK);
    for (uint32_t g = 0; g < 2; g++) {
        uint32_t id;
        assert_int_equal(froe_scene_add_group(plan, &(froe_group){.name = g ? "wall" : "door"}, &id), FROE_OK);
        froe_objects o = froe_objects_defaults();
        o.kind = FROE_SEGMENT, o.count = 2 - g, o.coords = walls + 8 * g, o.group = id;
        assert_int_equal(froe_scene_add(plan, &o, NULL), FROE_OK);
    }
    put("body,time,x,y,qz,qw,z\ndoor,0,0,0,0,1,7\ndoor,2,0,0,0.70710678118654757,0.70710678118654757,7\n");
    assert_int_equal(froe_read_poses("poses.csv", plan, NULL, &m, &report, NULL), FROE_OK);
    assert_true(report.features == 1 && report.still == 1 && report.pieces == 1);
    assert_true(froe_motion_window(m).dim == 2 && froe_motion_object_count(m) == 3);
    assert_int_equal(froe_motion_vertex_count(m), 5); /* the door's two segments share one */
    assert_int_equal(froe_motion_contacts(m, NULL, note, &f, NULL), FROE_OK);
    assert_true(f.count == 2 && f.first.b == 2);
    double at[2];
    assert_true(froe_motion_position(m, froe_motion_object(m, 0).vertices[1], 2, at) && at[1] == 5);
    froe_motion_free(m);
    m = NULL;
    froe_diagnostic why;
    put("body,time,x,y,qz,qw,z\ndoor,0,0,0,0,1,7\ndoor,2,0,0,0,1,8\n");
    assert_int_equal(froe_read_poses("poses.csv", plan, NULL, &m, NULL, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "poses.csv: part 'door': At the time 2 its z is 8 and not 7, and the model is in "
                                     "the plane.");
    put("body,time,x,y,qx,qz,qw\ndoor,0,0,0,0,0,1\ndoor,2,0,0,1,0,0\n");
    assert_int_equal(froe_read_poses("poses.csv", plan, NULL, &m, NULL, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "poses.csv: part 'door': At the time 2 its qx is 1 and not 0, and the model is in "
                                     "the plane.");
    froe_diagnostic diag;
    put("body,time,x,y,qz\ndoor,0,0,0,0\n");
    assert_int_equal(froe_read_poses("poses.csv", plan, NULL, &m, NULL, &diag), FROE_E_FORMAT);
    assert_string_equal(diag.message, "poses.csv: The table of poses has no column 'qw'.");
    froe_scene_free(plan);
}

static void a_part_of_one_row_stands_where_it_says(void **state) {
    (void)state;
    froe_scene *model = make_model();
    froe_motion *m = NULL;
    double at[3];
    put("body,time,x,y,z\nstrut,0,1,0,0\nlid,0,0,0,0\nlid,2,0,0,1\n");
    assert_int_equal(froe_read_poses("poses.csv", model, NULL, &m, NULL, NULL), FROE_OK);
    const froe_moving_object o = froe_motion_object(m, 3);
    assert_true(froe_motion_position(m, o.vertices[0], 1.5, at) && at[0] == 10 && o.birth == 0 && o.death == 2);
    froe_motion_free(m);
    froe_scene_free(model);
}

static void what_is_wrong_is_said_with_line_or_part(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
        froe_status status;
    } bad[] = {
        {"body,time,x,y,z\nlid,0,0,0,\"0\n", "poses.csv: line 2: A quotation mark is not closed.", FROE_E_FORMAT},
        {"body,time,x,y,z\nlid,0,0,0,0,9\n", "poses.csv: line 2: The row has 6 columns, and the header 5.",
         FROE_E_FORMAT},
        {"body,time,x,y\n", "poses.csv: The table of poses has no column 'z'.", FROE_E_FORMAT},
        {"body,time,x,y,z,qx,qy,qz\n", "poses.csv: The table of poses has no column 'qw'.", FROE_E_FORMAT},
        {"body,time,x,y,z\n", "poses.csv: There are no poses.", FROE_E_INPUT},
        {"body,time,x,y,z\nlid,2,0,0,0\nfloor,2,0,0,0\n", "poses.csv: All of the file is at one instant, 2.",
         FROE_E_INPUT},
        {"body,time,x,y,z\nlid,0,0,0,0\nroof,1,0,0,0\n", "poses.csv: line 3: The model has no part 'roof'.",
         FROE_E_INPUT},
        {"body,time,x,y,z\nlid,0,0,nan,0\n", "poses.csv: line 2: There is no finite number, but 'nan'.", FROE_E_INPUT},
        {"body,time,x,y,z\nlid,0,0,,0\n", "poses.csv: line 2: There is no finite number, but ''.", FROE_E_INPUT},
        {"body,time,x,y,z\nlid,0,0,0\n", "poses.csv: line 2: The row has 4 columns, and the header 5.", FROE_E_FORMAT},
        {"body,time,x,y,z\nlid,1,0,0,0\nlid,1,0,0,0\nlid,2,0,0,0\n",
         "poses.csv: part 'lid': body 1: Time 1, 1, is not after time 0, 1.", FROE_E_INPUT},
        {"body,time,x,y,z,qx,qy,qz,qw\nlid,0,0,0,0,0,0,0,0\nlid,1,0,0,0,0,0,0,1\n",
         "poses.csv: part 'lid': body 1: The quaternion of turn 0, 0 0 0 0, has not the length 1.", FROE_E_INPUT},
    };
    froe_scene *model = make_model();
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        froe_motion *m = NULL;
        froe_diagnostic diag;
        put(bad[i].text);
        assert_int_equal(froe_read_poses("poses.csv", model, NULL, &m, NULL, &diag), bad[i].status);
        assert_string_equal(diag.message, bad[i].message);
        assert_null(m);
    }
    froe_scene_free(model);
    froe_diagnostic diag;
    froe_motion *m = NULL;
    put("body,time,x,y,z\nlid,0,0,0,0\n"); /* without groups there are no parts */
    assert_int_equal(froe_scene_new(3, NULL, &model), FROE_OK);
    assert_int_equal(froe_read_poses("poses.csv", model, NULL, &m, NULL, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "poses.csv: line 2: The model has no part 'lid'.");
    froe_scene_free(model);
    assert_int_equal(froe_scene_new(4, NULL, &model), FROE_OK);
    assert_int_equal(froe_read_poses("poses.csv", model, NULL, &m, NULL, &diag), FROE_E_UNSUPPORTED);
    assert_string_equal(diag.message, "poses.csv: The model is not of the plane or of space.");
    froe_scene_free(model);
}

/* A window in which no part that moves is there would give an answer about nothing. */
static void a_window_beside_all_motion_is_refused(void **state) {
    (void)state;
    static const double windows[][2] = {{3, 4}, {-2, -1}, {2.5, NAN}, {0, 1}, {2, 3}, {-1, 0}};
    froe_scene *model = make_model();
    put("body,time,x,y,z\nstrut,0,1,0,0\nlid,0,0,0,0\nlid,2,0,0,1\nfloor,9,0,0,0\n");
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
        froe_motion_read_options o = froe_motion_read_defaults();
        froe_motion *m = NULL;
        froe_diagnostic diag;
        o.from = windows[i][0], o.to = windows[i][1];
        const froe_status status = froe_read_poses("poses.csv", model, &o, &m, NULL, &diag);
        assert_int_equal(status, i < 3 ? FROE_E_INPUT : FROE_OK);
        if (!i) assert_string_equal(diag.message, "poses.csv: No part moves from 3 to 4. All rows are from 0 to 9.");
        froe_motion_free(m);
    }
    put("body,time,x,y,z\nlid,5,0,0,1\n"); /* where nothing is to move, anything may be asked */
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_motion *m = NULL;
    o.from = 0, o.to = 1;
    assert_int_equal(froe_read_poses("poses.csv", model, &o, &m, NULL, NULL), FROE_OK);
    froe_motion_free(m);
    froe_scene_free(model);
}

static froe_status read_with(void *user, const froe_allocator *alloc) {
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_motion *m = NULL;
    o.alloc = alloc;
    const froe_status status = froe_read_poses("poses.csv", user, &o, &m, NULL, NULL);
    froe_motion_free(m);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_scene *model = make_model();
    put("body,time,x,y,z\nstrut,0,1,0,0\nlid,0,0,0,0\nlid,2,0,0,1\n");
    assert_true(test_memory_each(read_with, model) > 10);
    froe_scene_free(model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_fly_by_their_rows),
        cmocka_unit_test(parts_of_a_plan_turn_by_their_rows),
        cmocka_unit_test(a_part_of_one_row_stands_where_it_says),
        cmocka_unit_test(what_is_wrong_is_said_with_line_or_part),
        cmocka_unit_test(a_window_beside_all_motion_is_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
