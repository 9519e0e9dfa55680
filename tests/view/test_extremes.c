/* Pictures of scenes of any scale: times a power of two a scene looks as before, and points of the page show what exact
 * rays meet. */
#include "pages.h"
#include "query/worlds.h"

enum { SAMPLES = 60, CAMERAS = 3 };

static froe_camera camera_at(int number) {
    froe_camera c = froe_camera_defaults();
    c.parallel = number == 1;
    if (number == 2) c.eye[0] = -2, c.eye[1] = 1, c.eye[2] = 7;
    return c;
}

/* What a picture shows, in numbers. */
typedef struct summary {
    size_t shapes, strokes;
    double length;
} summary;

static summary look(const froe_scene *unit, int power, int camera) {
    froe_scene *scene = world_scaled(unit, power);
    froe_tree *tree = trees_build(scene, "density", 1);
    const froe_camera c = camera_at(camera);
    page p;
    open_page(&p, tree);
    p.options.lines = FROE_LINE_BORDER;
    place(&p, &c);
    check_view(&p, SAMPLES, (uint32_t)camera);
    summary s = {froe_picture_shape_count(p.picture), froe_picture_stroke_count(p.picture), 0};
    for (size_t i = 0; i < s.strokes; i++) {
        const froe_stroke stroke = froe_picture_stroke(p.picture, i);
        s.length += length_of(&stroke);
    }
    assert_true(p.shown > SAMPLES / 10);
    froe_picture_free(p.picture);
    close_page(&p);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return s;
}

static void a_scene_times_a_power_of_two_looks_the_same(void **state) {
    static const int powers[] = {-998, -900, -600, -500, -350, -100, 100, 350, 500, 600, 900, 996};
    froe_scene *unit = world_mixture(3, 1 << FROE_POLYGON, 16, 0, 0.8, 3);
    (void)state;
    for (int camera = 0; camera < CAMERAS; camera++) {
        const summary before = look(unit, 0, camera);
        for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
            const summary s = look(unit, powers[i], camera);
            if (s.shapes != before.shapes || s.strokes != before.strokes ||
                !(fabs(s.length - before.length) < 1e-9 * before.length))
                fail_msg("times 2^%d: %zu shapes, %zu strokes of length %.17g; not %zu, %zu, %.17g", powers[i],
                         s.shapes, s.strokes, s.length, before.shapes, before.strokes, before.length);
        }
    }
    froe_scene_free(unit);
}

/* Around triangles whose smallest and largest differ by a factor of 2^600. */
static void tiny_faces_beside_huge_ones_are_painted(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        froe_scene *scene;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        for (uint32_t i = 0; i < 24; i++) {
            double x[9];
            const double scale = ldexp(1, -(int)(i % 6) * 120);
            for (uint32_t k = 0; k < 9; k++) x[k] = scale * (trees_unit(seed, 9 * i + k) - 0.5);
            assert_int_equal(trees_add(scene, FROE_POLYGON, 1, x, NULL, NULL), FROE_OK);
        }
        froe_tree *tree = trees_build(scene, "density", 1);
        froe_scene_free(scene);
        for (int camera = 0; camera < CAMERAS; camera++) {
            const froe_camera c = camera_at(camera);
            page p;
            open_page(&p, tree);
            place(&p, &c);
            check_view(&p, SAMPLES, (uint32_t)seed);
            assert_true(p.shown > 0);
            froe_picture_free(p.picture);
            close_page(&p);
        }
        froe_tree_free(tree);
    }
}

/* What is smaller or larger is refused by what is the matter with it. */
static void scenes_beyond_cameras_are_refused(void **state) {
    static const int powers[] = {-1070, -1010, 1010, 1021};
    froe_scene *unit = world_mixture(3, 1 << FROE_POLYGON, 4, 0, 0.8, 3);
    (void)state;
    for (size_t i = 0; i < sizeof powers / sizeof *powers; i++) {
        froe_scene *scene = world_scaled(unit, powers[i]);
        const froe_camera c = froe_camera_defaults();
        froe_projection view;
        froe_diagnostic why;
        assert_int_equal(froe_camera_place(&c, scene, &view, &why), FROE_E_UNSUPPORTED);
        assert_non_null(strstr(why.message, "2^-1000 to 2^1000"));
        froe_scene_free(scene);
    }
    froe_scene_free(unit);
}

/* Half of the least double is 0, so an extent computed from halves would be that of a point. */
static void a_scene_as_large_as_the_least_double_is_no_point(void **state) {
    static const double corners[] = {0, 0, 0, 0x1p-1074, 0, 0, 0, 0x1p-1074, 0};
    const froe_camera c = froe_camera_defaults();
    froe_scene *scene;
    froe_projection view;
    froe_diagnostic why;
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, corners, NULL, NULL), FROE_OK);
    assert_int_equal(froe_camera_place(&c, scene, &view, &why), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(why.message, "2^-1000 to 2^1000"));
    froe_scene_free(scene);
}

/* Two of the three components of its normal are 0, and the products of which the third is the difference overflow. */
static void a_huge_face_across_an_axis_has_corners(void **state) {
    (void)state;
    double x[] = {1, 0, 2, 1, 1, 1, 1, 2, 1};
    froe_scene *scene;
    froe_surface *surface;
    froe_visibility *v;
    froe_visibility_options look = froe_visibility_defaults();
    for (int k = 0; k < 9; k++) x[k] = ldexp(x[k], 900);
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, x, NULL, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 1);
    assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
    look.eye.at[0] = 0x1p903;
    assert_int_equal(froe_visibility_new(tree, surface, &look, &v, NULL), FROE_OK);
    assert_int_equal(froe_visibility_piece_count(v), 1);
    double corners[9];
    assert_int_equal(froe_visibility_corners(v, 0, corners, 3), 3);
    for (int k = 0; k < 9; k++) assert_true(corners[k] > -0x1p880 && corners[k] < 0x1.0001p901);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* The way from the target to the eye, or its length, is no double: it is seen from there as from where a way leads that
 * is 2^1023 times as short. */
static void eyes_further_away_than_doubles_reach_see_as_near_ones(void **state) {
    static const double eyes[][3] = {{1, -1, 0.5}, {-1.5, 1, 1.75}, {0, 0, 1.5}, {1.75, 1.75, 1.75}};
    froe_scene *scene = world_mixture(3, 1 << FROE_POLYGON, 8, 0, 0.8, 3);
    froe_projection views[2];
    froe_camera around[2][3];
    (void)state;
    for (int i = 0; i < 8; i++) {
        for (int far = 0; far < 2; far++) {
            froe_camera c = froe_camera_defaults();
            c.parallel = i % 2;
            for (int k = 0; k < 3; k++) {
                c.eye[k] = far ? ldexp(eyes[i / 2][k], 1023) : eyes[i / 2][k];
                c.target[k] = i / 2 == 3 ? 0 : -c.eye[k];
            }
            assert_int_equal(froe_camera_place(&c, scene, &views[far], NULL), FROE_OK);
            assert_int_equal(froe_camera_turn(&c, scene, 3, around[far], NULL), FROE_OK);
        }
        assert_memory_equal(views[0].window, views[1].window, sizeof views->window);
        for (int turn = 0; turn < 3; turn++) {
            for (int far = 0; far < 2; far++)
                assert_int_equal(froe_camera_place(&around[far][turn], scene, &views[far], NULL), FROE_OK);
            for (int k = 0; k < 3; k++) assert_true(fabs(views[0].back[k] - views[1].back[k]) < 1e-3);
            assert_true(fabs(views[0].scale / views[1].scale - 1) < 1e-3);
        }
    }
    froe_scene_free(scene);
}

/* The eye is 10^-4 from both faces, as far as doubles there are from one another: a point of the scene that is computed
 * near it is as far away as any. At that place of the page the first face is nearer, elsewhere the second one. */
static void an_eye_at_two_faces_far_from_the_origin_sees_the_nearer_one(void **state) {
    static const double units[] = {-1.2508544921875,
                                   0.659912109375,
                                   0,
                                   0.29541015625,
                                   -0.955322265625,
                                   0,
                                   0,
                                   0,
                                   1,
                                   -0.6597900390625,
                                   -1.2508544921875,
                                   1,
                                   -0.2955322265625,
                                   0.955322265625,
                                   1,
                                   0.659912109375,
                                   1.2509765625,
                                   -1},
                        from[] = {-0.2388916015625, -0.0738525390625, 0.5};
    double x[18];
    (void)state;
    for (int far = 0; far < 2; far++) {
        const double origin = far ? 0x1p40 : 0;
        froe_camera c = froe_camera_defaults();
        froe_scene *scene;
        page p;
        for (int k = 0; k < 18; k++) x[k] = units[k] + origin;
        for (int k = 0; k < 3; k++) c.eye[k] = from[k] + origin, c.target[k] = origin + (k == 2);
        c.fit = false;
        c.width = c.height = 400, c.margin = 8;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POLYGON, 2, x, NULL, NULL), FROE_OK);
        froe_tree *tree = trees_build(scene, "density", 1);
        open_page(&p, tree);
        place(&p, &c);
        assert_int_equal(froe_picture_new(tree, p.surface, &p.options, &p.picture, NULL), FROE_OK);
        uint32_t last[2] = {FROE_NONE, FROE_NONE};
        for (size_t i = 0; i < froe_picture_shape_count(p.picture); i++) {
            const froe_shape shape = froe_picture_shape(p.picture, i);
            if (inside_shape(&p, &shape, 160, 373)) last[0] = shape.patch;
            if (inside_shape(&p, &shape, 200.5, 300)) last[1] = shape.patch;
        }
        assert_int_equal(last[0], p.surface->patch_of[0]);
        assert_int_equal(last[1], p.surface->patch_of[1]);
        froe_picture_free(p.picture);
        close_page(&p);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_times_a_power_of_two_looks_the_same),
        cmocka_unit_test(tiny_faces_beside_huge_ones_are_painted),
        cmocka_unit_test(a_huge_face_across_an_axis_has_corners),
        cmocka_unit_test(scenes_beyond_cameras_are_refused),
        cmocka_unit_test(an_eye_at_two_faces_far_from_the_origin_sees_the_nearer_one),
        cmocka_unit_test(eyes_further_away_than_doubles_reach_see_as_near_ones),
        cmocka_unit_test(a_scene_as_large_as_the_least_double_is_no_point),
    };
    return cmocka_run_group_tests_name("view/extremes", tests, NULL, NULL);
}
