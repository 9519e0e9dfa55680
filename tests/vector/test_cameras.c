/* Cameras of films hold all that is ever there, however shortly, and hardly more. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "vector/playing.h"

enum { TIMES = 3000, SIZE = 100, MARGIN = 10 };

static froe_motion *make_window(double end) {
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = end;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    return motion;
}

/* A triangle about a place, whose first corner flies as said, with a life. */
static void add_flyer(froe_motion *motion, const double *times, const double *xz, const double *controls, size_t count,
                      double birth, double death) {
    const size_t starts[] = {0, count, count + 1, count + 2};
    double all[8] = {0}, at[24] = {0}, bends[24];
    for (size_t i = 0; i < 24; i++) bends[i] = NAN;
    for (size_t i = 0; i < count; i++) {
        all[i] = times[i], at[3 * i] = xz[2 * i], at[3 * i + 2] = xz[2 * i + 1];
        if (controls)
            bends[3 * i] = controls[2 * i], bends[3 * i + 1] = isnan(controls[2 * i]) ? NAN : 0,
                      bends[3 * i + 2] = controls[2 * i + 1];
    }
    at[3 * count] = 0.1, at[3 * count + 4] = 0.1;
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 3, m.count = 1, m.starts = starts, m.times = all, m.coords = at, m.controls = bends;
    m.births = &birth, m.deaths = &death;
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
}

/* A body with a triangle, and more vertices if so. */
static void add_turner(froe_motion *motion, const double *times, const double *turns, size_t count, size_t vertices) {
    static size_t starts[40001];
    static double zeros[40000], at[120000];
    static uint32_t bodies[40000];
    double centre[24] = {0};
    froe_body body = froe_body_defaults();
    uint32_t id;
    body.count = count, body.times = times, body.coords = centre, body.turns = turns;
    assert_int_equal(froe_motion_add_body(motion, &body, &id, NULL), FROE_OK);
    for (size_t v = 0; v <= vertices; v++) starts[v] = v;
    for (size_t v = 0; v < vertices; v++) {
        bodies[v] = id;
        for (int k = 0; k < 3; k++) at[3 * v + (size_t)k] = playing_chance() * (k ? 0.25 : 4);
    }
    froe_moving m = froe_moving_defaults();
    m.vertex_count = vertices, m.count = vertices / 3, m.starts = starts, m.times = zeros, m.coords = at;
    m.bodies = bodies;
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
}

/* How far corners are from the middle of the page to each side while they are there, as a share of where the margin
 * begins. */
static void reach(const froe_motion *motion, const froe_camera *camera, double share, double sides[4]) {
    const double end = froe_motion_window(motion).end, point[3] = {0, 0, 0};
    froe_objects one = froe_objects_defaults();
    froe_scene *scene;
    froe_projection view;
    one.kind = FROE_POINT, one.count = 1, one.coords = point;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &one, NULL), FROE_OK);
    assert_int_equal(froe_camera_place(camera, scene, &view, NULL), FROE_OK);
    froe_scene_free(scene);
    const uint32_t step = froe_motion_object_count(motion) > 1000 ? 97 : 1;
    for (uint32_t i = 0; i < froe_motion_object_count(motion); i += step) {
        const froe_moving_object o = froe_motion_object(motion, i);
        for (int n = 0; n < 3 * TIMES / (int)step; n++) {
            const double time = n < TIMES / (int)step ? o.birth + (o.death - o.birth) * n * step / TIMES
                                                      : end * share * playing_chance();
            double at[3], page[2];
            if (!(time >= o.birth && time <= o.death)) continue;
            assert_true(froe_motion_position(motion, o.vertices[n % 3], time, at));
            assert_true(froe_project(&view, at, page));
            for (int k = 0; k < 4; k++)
                sides[k] = fmax(sides[k], (k % 2 ? 1 : -1) * (page[k / 2] - 0.5 * SIZE) / (0.5 * SIZE - MARGIN));
        }
    }
}

/* Everything is on the page of every camera, and as large as the margin allows but for `loss`: from side to side, or
 * where cameras turn on one side. */
static void expect_held(froe_motion *motion, double share, double loss) {
    froe_camera cameras[7], c = froe_camera_defaults();
    froe_diagnostic diag = {.message = ""};
    c.width = c.height = SIZE, c.margin = MARGIN;
    c.eye[0] = 0, c.eye[1] = -1, c.eye[2] = 0;
    for (int kind = 0; kind < 4; kind++) {
        const int count = kind & 1 ? 7 : 1;
        double sides[4] = {-9, -9, -9, -9};
        c.parallel = kind & 2;
        if (froe_film_cameras(motion, &c, count > 1, (size_t)count, cameras, &diag)) fail_msg("%s", diag.message);
        for (int i = 0; i < count; i++) reach(motion, cameras + i, share, sides);
        const double across = fmax(fmin(sides[0], sides[1]), fmin(sides[2], sides[3])),
                     most = fmax(fmax(sides[0], sides[1]), fmax(sides[2], sides[3]));
        if (!(most < 1 + 1e-6) || !((count > 1 ? most : across) > 1 - loss))
            fail_msg("kind %d: corners reach %g of the page, and %g across", kind, most, across);
    }
    froe_motion_free(motion);
}

static const double rest[2] = {0, 64}, low[4] = {0, 0, 0, 1};

static void a_short_life_is_held(void **state) {
    (void)state;
    froe_motion *motion = make_window(64);
    add_flyer(motion, rest, low, NULL, 2, 0, 64);
    add_flyer(motion, (double[]){0, 64}, (double[]){7, 0, 9, 640}, NULL, 2, 0.1, 0.9); /* gone at the next 32nd */
    expect_held(motion, 0.02, 0.1);
    motion = make_window(64);
    add_flyer(motion, rest, low, NULL, 2, 0.25, 0.25); /* an instant is a life */
    expect_held(motion, 0.02, 0.1);
}

static void a_short_detour_is_held(void **state) {
    (void)state;
    froe_motion *motion = make_window(64);
    add_flyer(motion, (double[]){0, 0.5, 1, 64}, (double[]){0, 0, 9, 3, 0, 0, 1, 0}, NULL, 4, 0, 64);
    expect_held(motion, 0.02, 0.1);
    motion = make_window(64);
    add_flyer(motion, (double[]){0, 1, 64}, (double[]){0, 0, 1, 2, 1, 1}, (double[]){4, 9, NAN, NAN, NAN, NAN}, 3, 0,
              64);
    expect_held(motion, 0.02, 0.1);
}

/* A corner is elsewhere while nothing is there that has it: before, between, after. */
static void what_is_not_there_is_left_out(void **state) {
    (void)state;
    froe_motion *motion = make_window(64);
    const double times[] = {0, 10, 12, 20, 30, 40, 50, 64, 0, 0};
    const double at[30] = {99, 0, 9, 1, 0, 2, 0,  0, 3,  99,  0, 9, 99, 0,  5,
                           4,  0, 0, 4, 0, 1, 99, 0, 99, 0.1, 0, 0, 0,  0.1};
    const double births[] = {10, 40, 44}, deaths[] = {12, 45, 50};
    const uint32_t corners[] = {0, 1, 2, 0, 1, 2, 0, 1, 2};
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 3, m.count = 3, m.starts = (const size_t[]){0, 8, 9, 10}, m.times = times, m.coords = at;
    m.vertices = corners, m.births = births, m.deaths = deaths;
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    expect_held(motion, 1, 0.1);
}

static void arms_that_turn_are_held(void **state) {
    (void)state;
    const double half = sqrt(0.5), times[] = {0, 0.5, 1, 64};
    const double turns[] = {0, 0, 0, 1, 0, half, 0, half, 0, 0, 0, 1, 0, 0, 0, 1};
    froe_motion *motion = make_window(64);
    add_turner(motion, times, turns, 4, 6);
    expect_held(motion, 0.02, 0.1);
    motion = make_window(64); /* a body with one instant */
    add_turner(motion, times, turns + 4, 1, 6);
    expect_held(motion, 1, 0.1);
}

/* Of very many corners the box of the body is held. */
static void bodies_of_many_corners_are_held(void **state) {
    (void)state;
    const double half = sqrt(0.5), times[] = {0, 0.5, 1, 64};
    const double turns[] = {0, 0, 0, 1, 0, half, 0, half, 0, 0, 0, 1, 0, 0, 0, 1};
    froe_motion *motion = make_window(64);
    add_turner(motion, times, turns, 4, 39999);
    expect_held(motion, 0.02, 0.5);
}

static void boxes_that_tumble_are_held(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed < 4; seed++) {
        froe_motion *motion = NULL;
        assert_int_equal(froe_generate_motion("moving-boxes", 4, seed, NULL, &motion, NULL), FROE_OK);
        expect_held(motion, 1, 0.1);
    }
}

static void without_anything_there_is_no_camera(void **state) {
    (void)state;
    froe_motion *motion = make_window(64);
    froe_camera c = froe_camera_defaults();
    froe_diagnostic diag;
    add_flyer(motion, rest, low, NULL, 2, 65, 70);
    assert_int_equal(froe_film_cameras(motion, &c, false, 1, &c, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "Nothing is ever there to be seen.");
    froe_motion_free(motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_short_life_is_held),
        cmocka_unit_test(a_short_detour_is_held),
        cmocka_unit_test(what_is_not_there_is_left_out),
        cmocka_unit_test(arms_that_turn_are_held),
        cmocka_unit_test(bodies_of_many_corners_are_held),
        cmocka_unit_test(boxes_that_tumble_are_held),
        cmocka_unit_test(without_anything_there_is_no_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
