/* test_refusals.c: every function about formats with arguments that are none: a status with a sentence, and no file. */
#include "../tree/trees.h"
#include "support/scenes.h"
#include "support/tree_file.h"
#include <froe/arrays.h>
#include <math.h>
#include <unistd.h>

#include "support/refusals.h" /* last: others have variables called `why` */

#define REFUSED(call, words) expect(call, FROE_E_OPTIONS, words)
#define DAMAGED(call) expect(call, FROE_E_FORMAT, "")

static froe_motion *made(const char *kind) {
    froe_motion *m;
    assert_int_equal(froe_generate_motion(kind, 3, 1, NULL, &m, NULL), FROE_OK);
    return m;
}

static bool any_part(void *user, const froe_part *part) {
    (void)user, (void)part;
    return true;
}

static froe_status any_batch(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag) {
    (void)user, (void)dim, (void)batch, (void)diag;
    return FROE_OK;
}

static void generators_are_checked(void **state) {
    (void)state;
    froe_scene *scene;
    froe_motion *motion;
    NULLS(froe_generate(NULL, 3, 1, NULL, &scene, &why));
    NULLS(froe_generate("segments", 3, 1, NULL, NULL, &why));
    NULLS(froe_generate_motion(NULL, 3, 1, NULL, &motion, &why));
    NULLS(froe_generate_motion("moving", 3, 1, NULL, NULL, &why));
    expect(froe_generate_motion("moving", ((size_t)1 << 31) - 2, 1, NULL, &motion, &why), FROE_E_LIMIT, "2^31");
}

static void readers_are_checked(void **state) {
    (void)state;
    froe_scene *scene = NULL, *model = trees_scene(3, FROE_POLYGON, 3, 0, 1, 1);
    froe_motion *motion = NULL;
    froe_read_options read = froe_read_defaults();
    froe_motion_read_options poses = froe_motion_read_defaults();
    write_text("three.csv", "x,y\n1,2\n3,4\n5,6\n");
    NULLS(froe_read_own(NULL, NULL, &scene, NULL, &why));
    NULLS(froe_read_own("three.csv", NULL, NULL, NULL, &why));
    NULLS(froe_read_batches(NULL, NULL, any_batch, NULL, NULL, &why));
    NULLS(froe_read_batches("three.csv", NULL, NULL, NULL, NULL, &why));
    NULLS(froe_read_poses(NULL, model, NULL, &motion, NULL, &why));
    NULLS(froe_read_poses("poses.csv", NULL, NULL, &motion, NULL, &why));
    NULLS(froe_read_poses("poses.csv", model, NULL, NULL, NULL, &why));
    NULLS(froe_motion_at_rest(NULL, 0, 1, NULL, &motion, &why));
    read.size = poses.size = 1;
    REFUSED(froe_read_own("three.csv", &read, &scene, NULL, &why), "froe_read_defaults");
    REFUSED(froe_read_batches("three.csv", &read, any_batch, NULL, NULL, &why), "froe_read_defaults");
    REFUSED(froe_read_poses("poses.csv", model, &poses, &motion, NULL, &why), "froe_motion_read_defaults");
    froe_scene_free(model);
}

static void writers_are_checked(void **state) {
    (void)state;
    froe_motion *plane = made("moving"), *space = made("moving-boxes");
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 3, 0, 1, "density", 1);
    froe_event_writer *events;
    const char byte = 0; /* where none is looked at */
    NULLS(froe_write_scene(NULL, "out.obj", &why));
    NULLS(froe_write_scene(tree->scene, NULL, &why));
    NULLS(froe_export(NULL, "out.obj", FROE_EXPORT_CUTS, NULL, &why));
    NULLS(froe_export(tree, NULL, FROE_EXPORT_CUTS, NULL, &why));
    NULLS(froe_tree_parts(NULL, FROE_EXPORT_CUTS, NULL, any_part, NULL, &why));
    NULLS(froe_tree_parts(tree, FROE_EXPORT_CUTS, NULL, NULL, NULL, &why));
    NULLS(froe_write_motion(NULL, "out.mfjson", &why));
    NULLS(froe_write_motion(plane, NULL, &why));
    NULLS(froe_write_contacts(NULL, NULL, 0, "out.csv", &why));
    NULLS(froe_write_contacts(plane, NULL, 0, NULL, &why));
    NULLS(froe_write_places(NULL, "out.csv", &why));
    NULLS(froe_write_places((const froe_places *)(const void *)&byte, NULL, &why));
    NULLS(froe_event_writer_new(NULL, NULL, &events, &why));
    NULLS(froe_event_writer_new("out.csv", NULL, NULL, &why));
    expect(froe_event_writer_new("nowhere/out.csv", NULL, &events, &why), FROE_E_IO, "nowhere/");
    assert_false(froe_exports_own(NULL));
    NULLS(froe_animate(NULL, NULL, 0, NULL, "out.svg", &why));
    NULLS(froe_animate(plane, NULL, 0, NULL, NULL, &why));
    froe_animation_options o = froe_animation_defaults();
    o.size = 1;
    REFUSED(froe_animate(plane, NULL, 0, &o, "out.svg", &why), "froe_animation_defaults");
    for (int i = 0; i < 6; i++) {
        o = froe_animation_defaults();
        *(i < 3 ? &o.width : &o.seconds) = (const double[]){-1, NAN, INFINITY}[i % 3];
        REFUSED(froe_animate(plane, NULL, 0, &o, "out.svg", &why), "width");
    }
    for (int up = -1; up <= 3; up += 4) {
        o = froe_animation_defaults(), o.up = up;
        REFUSED(froe_animate(space, NULL, 0, &o, "out.svg", &why), up < 0 ? "no axis -1" : "no axis 3");
    }
    expect(froe_animate(plane, &(froe_contact){.a = 7, .b = 1}, 1, NULL, "out.svg", &why), FROE_E_ARG, "contact 0");
    static const char *const none[] = {"out.obj", "out.mfjson", "out.csv", "out.svg"};
    for (int i = 0; i < 4; i++) assert_int_not_equal(access(none[i], F_OK), 0);
    froe_motion_free(plane), froe_motion_free(space);
    froe_tree_free(tree);
}

/* A body of the plane is drawn on parabolas: those are drawn, or refused as any other motion. */
static void motions_with_bodies_are_drawn_as_others_are(void **state) {
    (void)state;
    froe_motion *m = NULL;
    write_text("body.mfjson",
               "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"temporalGeometry\":"
               "{\"type\":\"MovingPoint\",\"datetimes\":[0,9],\"coordinates\":[[0,0],[1,0]],"
               "\"turns\":[[0,1],[0.6,0.8]],"
               "\"base\":{\"coordinates\":[[1,0],[0,1]],\"segments\":[[0,1]]}}}]}");
    if (froe_read_motion("body.mfjson", NULL, &m, NULL, &why)) fail_msg("%s", why.message);
    expect(froe_animate(m, NULL, 0, NULL, "out.png", &why), FROE_E_UNSUPPORTED, ".svg or .html");
    assert_int_equal(froe_animate(m, NULL, 0, NULL, "body.svg", &why), FROE_OK);
    froe_motion_free(m);
}

static void instants_are_checked(void **state) {
    (void)state;
    froe_motion *kinds[] = {made("moving"), made("moving-boxes")};
    froe_scene *scene = NULL;
    for (int i = 0; i < 2; i++) {
        const froe_motion_options window = froe_motion_window(kinds[i]);
        NULLS(froe_motion_scene(NULL, 0, NULL, &scene, &why));
        NULLS(froe_motion_scene(kinds[i], window.begin, NULL, NULL, &why));
        const double beside[] = {window.begin - 1, window.end + 1, NAN};
        for (int k = 0; k < 3; k++)
            expect(froe_motion_scene(kinds[i], beside[k], NULL, &scene, &why), FROE_E_ARG, "not in the window");
        assert_null(scene);
        assert_int_equal(froe_motion_scene(kinds[i], window.end, NULL, &scene, &why), FROE_OK);
        assert_int_equal(froe_scene_object_count(scene), froe_motion_object_count(kinds[i]));
        assert_int_equal(froe_scene_object(scene, 0).form, i ? FROE_POLYGON : FROE_SEGMENT);
        froe_scene_free(scene);
        scene = NULL;
        froe_motion_free(kinds[i]);
    }
}

/* Of two segments one lives from 0 to 1 and the other from 2 to 3: at their last instants they are gone, but for the
 * end of the window. In between nothing is there. */
static void what_has_died_is_gone(void **state) {
    (void)state;
    static const struct {
        double time;
        size_t count;
    } expected[] = {{0, 1}, {0.5, 1}, {1, 0}, {1.5, 0}, {2, 1}, {3, 1}};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *m;
    froe_scene *scene;
    w.begin = 0, w.end = 3;
    b.vertex_count = 4, b.count = 2;
    b.starts = (const size_t[]){0, 2, 4, 6, 8};
    b.times = (const double[]){0, 1, 0, 1, 2, 3, 2, 3};
    b.coords = (const double[]){0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7};
    b.births = (const double[]){0, 2};
    b.deaths = (const double[]){1, 3};
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    if (froe_motion_add(m, &b, &why)) fail_msg("%s", why.message);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_int_equal(froe_motion_scene(m, expected[i].time, NULL, &scene, &why), FROE_OK);
        assert_int_equal(froe_scene_object_count(scene), expected[i].count);
        if (expected[i].count) assert_int_equal(froe_scene_object(scene, 0).tag, expected[i].time > 1);
        froe_scene_free(scene);
    }
    froe_motion_free(m);
}

static void arrays_are_checked(void **state) {
    (void)state;
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 3, 0, 1, "density", 1);
    froe_scene_arrays scene;
    froe_piece_arrays pieces;
    froe_cell_arrays cells;
    NULLS(froe_arrays_of_scene(NULL, NULL, &scene, &why));
    NULLS(froe_arrays_of_scene(tree->scene, NULL, NULL, &why));
    NULLS(froe_arrays_of_pieces(NULL, NULL, &pieces, &why));
    NULLS(froe_arrays_of_pieces(tree, NULL, NULL, &why));
    NULLS(froe_arrays_of_cells(NULL, lo, hi, false, NULL, &cells, &why));
    NULLS(froe_arrays_of_cells(tree, lo, hi, false, NULL, NULL, &why));
    froe_scene_arrays_free(NULL), froe_piece_arrays_free(NULL), froe_cell_arrays_free(NULL);
    froe_tree_free(tree);
}

/* Files are checked when something is first asked of all of them. Each call may be that one. */
static void damaged_files_are_noticed_by_every_call(void **state) {
    (void)state;
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    tree_file f;
    froe_tree *tree = tree_file_damaged(trees_grow(3, FROE_POLYGON, 9, 0, 1, "density", 1), &f);
    froe_motion *motion = NULL;
    froe_scene_arrays scene;
    froe_piece_arrays pieces;
    froe_cell_arrays cells;
    write_text("poses.csv", "body,time,x,y,z,qx,qy,qz,qw\na,0,0,0,0,0,0,0,1\n");
    froe_tree_free(tree);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        if (i == 0) DAMAGED(froe_write_scene(tree->scene, "out.obj", &why));
        if (i == 1) DAMAGED(froe_export(tree, "out.obj", FROE_EXPORT_CUTS, NULL, &why));
        if (i == 2) DAMAGED(froe_tree_parts(tree, FROE_EXPORT_FRAGMENTS, NULL, any_part, NULL, &why));
        if (i == 3) DAMAGED(froe_read_poses("poses.csv", tree->scene, NULL, &motion, NULL, &why));
        if (i == 4) DAMAGED(froe_motion_at_rest(tree->scene, 0, 1, NULL, &motion, &why));
        if (i == 5) DAMAGED(froe_arrays_of_scene(tree->scene, NULL, &scene, &why));
        if (i == 6) DAMAGED(froe_arrays_of_pieces(tree, NULL, &pieces, &why));
        if (i == 7) DAMAGED(froe_arrays_of_cells(tree, lo, hi, false, NULL, &cells, &why));
        froe_tree_free(tree);
    }
    assert_int_not_equal(access("out.obj", F_OK), 0);
    free(f.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(generators_are_checked), cmocka_unit_test(readers_are_checked),
        cmocka_unit_test(writers_are_checked),    cmocka_unit_test(motions_with_bodies_are_drawn_as_others_are),
        cmocka_unit_test(instants_are_checked),   cmocka_unit_test(what_has_died_is_gone),
        cmocka_unit_test(arrays_are_checked),     cmocka_unit_test(damaged_files_are_noticed_by_every_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
