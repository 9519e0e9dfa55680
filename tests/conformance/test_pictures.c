/* test_pictures.c: every kind of scene of polygons, from nine eyes, two of them amid it: painted shapes against rays,
 * whole stacks of layers where one sees through things, edges against all that lies before them. The same on large
 * scenes: `make oracle`. */
#include "oracle/views.h"
#include "support/memory.h"
#include <froe/io.h>
#include <string.h>

static void must(froe_status status, const char *what, const froe_diagnostic *why) {
    if (status) fail_msg("%s: %s", what, why->message);
}

static void expect_right(const char *name, const char *what, const oracle_report *r) {
    if (r->faces.wrong)
        fail_msg("%s, %s: %d samples wrong, the first at (%g, %g): patch %d instead of %d", name, what,
                 (int)r->faces.wrong, r->faces.at[0], r->faces.at[1], (int)r->faces.painted, (int)r->faces.met);
    if (r->lines.wrong)
        fail_msg("%s: %d points of edges wrong, the first on edge %u at %g", name, (int)r->lines.wrong, r->lines.edge,
                 r->lines.share);
    assert_int_equal(r->faces.ties_wrong, 0);
    assert_int_equal(r->fallbacks, 0);
}

static oracle_report look(const char *name, const char *what, const oracle_task *task) {
    oracle_report sum = {.shapes = 0};
    froe_diagnostic why = {0};
    for (unsigned view = 0; view < ORACLE_VIEWS; view++) must(oracle_check_view(task, view, &sum, &why), name, &why);
    expect_right(name, what, &sum);
    return sum;
}

/* Takes the scene. Large ones are looked at with less care: layers and most edges are left to the long run. */
static void check(froe_scene *scene, const char *name, uint32_t samples, bool large) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why = {0};
    froe_tree *tree;
    froe_surface *surface;
    must(froe_build(scene, &o, &tree, &why), name, &why);
    must(froe_surface_new(scene, NULL, &surface, &why), name, &why);
    oracle_task task = {
        .tree = tree, .surface = surface, .samples = samples, .underlap = 2, .edge_step = large ? 16 : 1};
    const oracle_report opaque = look(name, "whole faces", &task);
    print_message("  %-14s %5d faces, %6d samples, %5d in ties, %4d late; %5d points of edges, %d in doubt\n", name,
                  (int)froe_scene_object_count(scene), (int)opaque.faces.covered, (int)opaque.faces.ties,
                  (int)opaque.late, (int)(opaque.lines.visible + opaque.lines.hidden), (int)opaque.lines.doubtful);
    task.clear = 3, task.underlap = 0, task.edge_step = 0;
    if (!large) look(name, "layers", &task);
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void all_kinds_of_scenes_show_what_rays_meet(void **state) {
    (void)state;
    const froe_generator_info *kind;
    for (size_t i = 0; (kind = froe_generator_at(i)) != NULL; i++) {
        froe_scene *scene;
        froe_diagnostic why = {0};
        if (kind->dim != 3 || kind->kind != FROE_POLYGON) continue;
        if (strstr(kind->name, "huge") || strstr(kind->name, "denormal")) continue; /* beyond the oracle's doubles */
        must(froe_generate(kind->name, 48, 7, NULL, &scene, &why), kind->name, &why);
        check(scene, kind->name, 40, false);
    }
}

/* 161 pairs of its triangles cross. */
static void the_teapot_shows_what_rays_meet(void **state) {
    (void)state;
    froe_scene *scene;
    froe_diagnostic why = {0};
    must(froe_read(FROE_TEST_DATA "/utah-teapot.obj", NULL, &scene, NULL, &why), "teapot", &why);
    check(scene, "teapot", 60, true);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_kinds_of_scenes_show_what_rays_meet),
        cmocka_unit_test(the_teapot_shows_what_rays_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
