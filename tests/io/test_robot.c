/* The robot of data/: an animation of a model from its file to its pictures. */
#include "vector/playing.h"
#include <froe/io.h>

static void its_pictures_are_what_rays_meet(void **state) {
    (void)state;
    froe_motion *motion = NULL;
    froe_motion_report read;
    froe_diagnostic diag = {.message = ""};
    if (froe_read_animation(FROE_TEST_DATA "/robot.gltf", NULL, &motion, &read, &diag)) fail_msg("%s", diag.message);
    assert_true(read.deviation > 0 && read.deviation <= 1e-3 * read.extent && read.jumps == 2 && read.up == 1);
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    froe_film_report report;
    playing_counts c = {0, 0, 0};
    for (int k = 0; k < 3; k++) o.camera.up[k] = k == 1;
    o.camera.width = 800, o.camera.height = 600, o.camera.eye[0] = 3, o.camera.eye[1] = 2, o.camera.eye[2] = 5;
    film.frames = 60;
    if (froe_film(motion, "robot.svg", &o, &film, &report, &diag)) fail_msg("%s", diag.message);
    assert_true(report.changes > 10 && report.bytes < 2000000);
    playing_read("robot.svg");
    playing_compare(motion, &o, false, film.frames, &c);
    assert_true(c.hits > 500 && c.empty > 200 && c.unclear < c.hits);
    froe_motion_free(motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(its_pictures_are_what_rays_meet)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
