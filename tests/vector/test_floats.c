/* test_floats.c: however the calling thread computes, rendered pictures have the same bytes, the thread computes so
 * afterwards, and so do the callbacks. (conformance/test_floats.c has everything else.) */
#include "support/floats_tree.h"
#include <froe/formats.h>
#include <froe/render.h>

static bool note_path(void *user, const froe_render_path *path) {
    for (size_t i = 0; i < path->count; i++)
        if (!floats_bytes(user, path->outlines[i].points, 2 * path->outlines[i].count * sizeof(double))) return false;
    return true;
}

static bool note_line(void *user, const froe_stroke *line) {
    return floats_bytes(user, line->points, 2 * line->count * sizeof *line->points) &&
           floats_bytes(user, line->space, 3 * line->count * sizeof *line->space);
}

static void renderings(floats_run *r, void *user) {
    static const char *const files[] = {"floats.svg", "floats.pdf", "floats.eps", "floats.csv", "floats.geojson"};
    const froe_allocator memory = {floats_memory, r};
    froe_render_options o = froe_render_defaults();
    froe_camera cameras[2];
    froe_scene *scene;
    froe_tree *tree = floats_tree(r, 3, 1, &scene);
    (void)user;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    for (int f = 0; f < FROE_RENDER_FORMAT_COUNT; f++) {
        MUST(r, froe_render(tree, files[f], &o, NULL, NULL));
        floats_note_file(r, files[f]);
        MUST(r, froe_render_write(tree, (froe_render_format)f, floats_bytes, r, &o, NULL, NULL));
    }
    MUST(r, froe_render_paths(tree, 100, note_path, r, &o, NULL, NULL));
    MUST(r, froe_render_lines(tree, note_line, r, &o, NULL, NULL));
    MUST(r, froe_camera_turn(&o.camera, scene, 2, cameras, NULL));
    MUST(r, froe_render_animation(tree, files[0], &o, cameras, 2, 3, NULL, NULL));
    floats_note_file(r, files[0]);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void films(floats_run *r, void *user) {
    const froe_allocator memory = {floats_memory, r};
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    froe_camera cameras[2];
    froe_motion *motion, *rest;
    froe_scene *scene;
    (void)user;
    o.alloc = &memory, o.progress = floats_progress, o.user = r;
    film.frames = 3;
    MUST(r, froe_generate_motion("moving-boxes", 2, 1, &memory, &motion, NULL));
    MUST(r, froe_film(motion, "floats.svg", &o, &film, NULL, NULL));
    floats_note_file(r, "floats.svg");
    MUST(r, froe_film_write(motion, floats_bytes, r, &o, &film, NULL, NULL));
    MUST(r, froe_film_cameras(motion, &o.camera, true, 2, cameras, NULL));
    floats_note(r, cameras[1].eye, sizeof cameras[1].eye);
    MUST(r, froe_motion_scene(motion, 0.1, &memory, &scene, NULL));
    floats_note(r, froe_scene_vertex(scene, 1), 3 * sizeof(double));
    MUST(r, froe_motion_at_rest(scene, 0, 1, &memory, &rest, NULL));
    film.turn = film.exact = true;
    MUST(r, froe_film(rest, "turn.svg", &o, &film, NULL, NULL));
    floats_note_file(r, "turn.svg");
    froe_scene_free(scene);
    froe_motion_free(rest);
    froe_motion_free(motion);
}

static bool note_sight(void *user, double low, double high) {
    const double at[2] = {low, high};
    floats_note(user, at, sizeof at);
    return true;
}

/* A triangle flies by behind another. */
static void exact_films(floats_run *r, void *user) {
    const froe_allocator memory = {floats_memory, r};
    froe_motion_options w = froe_motion_defaults();
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    froe_moving m = froe_moving_defaults();
    const size_t starts[] = {0, 1, 2, 3, 5, 7, 9};
    const double times[] = {0, 0, 0, 0, 1, 0, 1, 0, 1};
    const double at[] = {-1,   0, -1,   1, 0,   -1.1, 0,    0, 1.3, /* at rest */
                         -2.1, 1, -0.2, 2, 1.1, 0.3,  -2.3, 1, 0.4, 1.9, 1, 0.2, -1.7, 1.2, 0.1, 2.2, 1.3, 0.7};
    froe_sight_options sight = froe_sight_defaults();
    froe_motion *motion;
    (void)user;
    w.dim = 3, w.begin = 0, w.end = 1;
    m.vertex_count = 6, m.count = 2, m.starts = starts, m.times = times, m.coords = at;
    o.alloc = &memory, o.progress = floats_progress, o.user = r;
    film.frames = 3, film.exact = true;
    sight.at[0] = 0.3, sight.at[1] = -7.1, sight.at[2] = 0.2;
    MUST(r, froe_motion_new(&w, &memory, &motion, NULL));
    MUST(r, froe_motion_add(motion, &m, NULL));
    MUST(r, froe_motion_sights(motion, &sight, note_sight, r, NULL));
    MUST(r, froe_film(motion, "exact.svg", &o, &film, NULL, NULL));
    floats_note_file(r, "exact.svg");
    froe_motion_free(motion);
}

static void films_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(films, NULL);
    floats_compare(exact_films, NULL);
}

static void renderings_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(renderings, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(renderings_have_the_same_bytes),
                                       cmocka_unit_test(films_have_the_same_bytes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
