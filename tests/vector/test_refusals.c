/* test_refusals.c: every function that renders with arguments that are none: a status with a sentence, and no file. */
#include "support/scenes.h"
#include <froe/formats.h>
#include <froe/render.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "support/refusals.h" /* last: others have variables called `why` */

#define REFUSED(call, words) expect(call, FROE_E_OPTIONS, words)

static bool take_bytes(void *user, const void *bytes, size_t count) {
    (void)user, (void)bytes, (void)count;
    return true;
}

static bool take_path(void *user, const froe_render_path *path) {
    (void)user, (void)path;
    return true;
}

static bool take_line(void *user, const froe_stroke *line) {
    (void)user, (void)line;
    return true;
}

static void films_are_checked(void **state) {
    (void)state;
    froe_motion *plane, *space;
    froe_camera cameras[2] = {froe_camera_defaults(), froe_camera_defaults()};
    froe_render_options o = froe_render_defaults();
    froe_film_options f = froe_film_defaults();
    assert_int_equal(froe_generate_motion("moving", 3, 1, NULL, &plane, &why), FROE_OK);
    assert_int_equal(froe_generate_motion("moving-boxes", 3, 1, NULL, &space, &why), FROE_OK);
    NULLS(froe_film_cameras(NULL, cameras, false, 1, cameras, &why));
    NULLS(froe_film_cameras(space, NULL, false, 1, cameras, &why));
    NULLS(froe_film_cameras(space, cameras, false, 1, NULL, &why));
    NULLS(froe_film_cameras(space, cameras, false, 0, cameras, &why));
    expect(froe_film_cameras(plane, cameras, false, 1, cameras, &why), FROE_E_UNSUPPORTED, "plane");
    cameras[0].size = 0, cameras[0].fit = false;
    REFUSED(froe_film_cameras(space, cameras, false, 1, cameras, &why), "froe_camera_defaults");
    NULLS(froe_film(NULL, "film.svg", NULL, NULL, NULL, &why));
    NULLS(froe_film(space, NULL, NULL, NULL, NULL, &why));
    NULLS(froe_film_write(NULL, take_bytes, NULL, NULL, NULL, NULL, &why));
    NULLS(froe_film_write(space, NULL, NULL, NULL, NULL, NULL, &why));
    expect(froe_film(plane, "film.svg", NULL, NULL, NULL, &why), FROE_E_UNSUPPORTED, "of the plane");
    static const unsigned frames[] = {0, 1000001};
    for (int i = 0; i < 2; i++) {
        f.frames = frames[i];
        REFUSED(froe_film(space, "film.svg", NULL, &f, NULL, &why), "option 'frames'");
    }
    f = froe_film_defaults(), f.halvings = 21;
    REFUSED(froe_film(space, "film.svg", NULL, &f, NULL, &why), "option 'halvings'");
    static const double seconds[] = {0, -1, 1e7, NAN};
    for (int i = 0; i < 4; i++) {
        f = froe_film_defaults(), f.seconds = seconds[i];
        REFUSED(froe_film(space, "film.svg", NULL, &f, NULL, &why), "option 'seconds'");
    }
    f = froe_film_defaults(), f.size = 1;
    REFUSED(froe_film(space, "film.svg", NULL, &f, NULL, &why), "froe_film_defaults");
    o.size = 1;
    REFUSED(froe_film(space, "film.svg", &o, NULL, NULL, &why), "froe_render_defaults");
    memset(&o, 0xA5, sizeof o); /* pointers that lead nowhere are not followed */
    REFUSED(froe_film(space, "film.svg", &o, NULL, NULL, &why), "froe_render_defaults");
    for (int i = 0; i < 3; i++) {
        o = froe_render_defaults();
        o.layers = i == 0, o.interleaved = i == 1, o.seams = i == 2 ? FROE_SEAMS_TWICE : o.seams;
        REFUSED(froe_film(space, "film.svg", &o, NULL, NULL, &why), "no layers");
    }
    o = froe_render_defaults(), o.background = 0xFF0000FF;
    REFUSED(froe_film(space, "film.svg", &o, NULL, NULL, &why), "is not like 0xRRGGBB");
    assert_int_not_equal(access("film.svg", F_OK), 0);
    froe_motion_free(plane), froe_motion_free(space);
}

static void pictures_are_checked(void **state) {
    (void)state;
    froe_scene *scene;
    froe_tree *tree;
    const froe_camera camera = froe_camera_defaults();
    froe_build_options b = froe_build_defaults();
    assert_int_equal(froe_generate("cuboids", 2, 1, NULL, &scene, &why), FROE_OK);
    assert_int_equal(froe_build(scene, &b, &tree, &why), FROE_OK);
    NULLS(froe_render(NULL, "picture.svg", NULL, NULL, &why));
    NULLS(froe_render(tree, NULL, NULL, NULL, &why));
    NULLS(froe_render_write(NULL, FROE_RENDER_SVG, take_bytes, NULL, NULL, NULL, &why));
    NULLS(froe_render_write(tree, FROE_RENDER_SVG, NULL, NULL, NULL, NULL, &why));
    for (int i = -1; i <= FROE_RENDER_FORMAT_COUNT; i += 1 + FROE_RENDER_FORMAT_COUNT)
        expect(froe_render_write(tree, (froe_render_format)i, take_bytes, NULL, NULL, NULL, &why), FROE_E_OPTIONS,
               "format");
    NULLS(froe_render_paths(NULL, 1, take_path, NULL, NULL, NULL, &why));
    NULLS(froe_render_paths(tree, 1, NULL, NULL, NULL, NULL, &why));
    NULLS(froe_render_lines(NULL, take_line, NULL, NULL, NULL, &why));
    NULLS(froe_render_lines(tree, NULL, NULL, NULL, NULL, &why));
    NULLS(froe_render_animation(NULL, "picture.svg", NULL, &camera, 1, 1, NULL, &why));
    NULLS(froe_render_animation(tree, NULL, NULL, &camera, 1, 1, NULL, &why));
    NULLS(froe_render_animation(tree, "picture.svg", NULL, NULL, 1, 1, NULL, &why));
    NULLS(froe_render_animation(tree, "picture.svg", NULL, &camera, 0, 1, NULL, &why));
    static const double numbers[] = {0, -1, 1e7, NAN};
    for (int i = 0; i < 4; i++) {
        assert_int_not_equal(froe_render_paths(tree, numbers[i], take_path, NULL, NULL, NULL, NULL), FROE_OK);
        assert_int_not_equal(froe_render_animation(tree, "picture.svg", NULL, &camera, 1, numbers[i], NULL, NULL),
                             FROE_OK);
    }
    static const uint32_t colours[] = {0x1000000, 0xFF0000FF, FROE_DRAW_BY_FORMAT - 1};
    for (int i = 0; i < 3; i++) {
        froe_render_options o = froe_render_defaults();
        o.background = colours[i];
        REFUSED(froe_render(tree, "picture.svg", &o, NULL, &why), "is not like 0xRRGGBB");
        REFUSED(froe_render_animation(tree, "picture.svg", &o, &camera, 1, 1, NULL, &why), "is not like 0xRRGGBB");
    }
    assert_int_not_equal(access("picture.svg", F_OK), 0);
    assert_int_equal(froe_render(tree, "picture.svg", NULL, NULL, &why), FROE_OK); /* all the same */
    assert_int_equal(remove("picture.svg"), 0);
    froe_tree_free(tree), froe_scene_free(scene);
}

static void names_are_those_of_options(void **state) {
    (void)state;
    assert_string_equal(froe_shading_name(FROE_SHADE_NONE), "none");
    assert_string_equal(froe_seams_name(FROE_SEAMS_TWICE), "twice");
    assert_null(froe_shading_name(FROE_SHADING_COUNT));
    assert_null(froe_shading_name((froe_shading)-1));
    assert_null(froe_seams_name(FROE_SEAMS_COUNT));
    assert_null(froe_seams_name((froe_seams)-1));
}

/* Of a scene with a group: opacities that are none, and lines with options that are none. */
static void opacities_are_shares(void **state) {
    (void)state;
    static const double coords[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, bad[] = {-0.5, 1.5, INFINITY};
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_objects batch = froe_objects_defaults();
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "wall"}, &batch.group), FROE_OK);
    batch.count = 1, batch.coords = coords;
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    froe_render_options o = froe_render_defaults();
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        o.opacity = bad + i;
        REFUSED(froe_render(tree, "picture.svg", &o, NULL, &why), "group 0: Its opacity is");
        REFUSED(froe_render_lines(tree, take_line, NULL, &o, NULL, &why), "group 0: Its opacity is");
    }
    froe_tree_free(tree), froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_are_checked),
        cmocka_unit_test(pictures_are_checked),
        cmocka_unit_test(names_are_those_of_options),
        cmocka_unit_test(opacities_are_shares),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
