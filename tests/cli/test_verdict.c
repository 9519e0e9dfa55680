/* test_verdict.c: what froe says of trees that no command of its own saves: valid files with two objects swapped, of
 * which froe check says no, with exit code 1 and the violation; without objects; with settings of other builders. */
#include "tree/tree.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h> /* needs setjmp.h and stdarg.h before it */

/* Two leaves, one point each. */
static froe_tree *two_points(void) {
    static const double coords[] = {0, 0, 10, 10};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    froe_objects points = froe_objects_defaults();
    points.kind = FROE_POINT;
    points.count = 2;
    points.coords = coords;
    assert_int_equal(froe_scene_add(scene, &points, NULL), FROE_OK);
    const froe_build_options options = froe_build_defaults();
    froe_tree *tree;
    assert_int_equal(froe_build(scene, &options, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    return tree;
}

/* Runs `froe ARGUMENTS`; its exit code, and what it prints in `said`. */
static int run_froe(const char *arguments, char *said, size_t size) {
    char command[400];
    const char *folder = getenv("FROE_BIN");
    assert_non_null(folder);
    snprintf(command, sizeof command, "'%s/froe' %s 2>&1", folder, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(said, 1, size - 1, pipe);
    said[length] = '\0';
    const int status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void a_tree_as_it_was_built_passes(void **state) {
    (void)state;
    char said[2000];
    froe_tree *tree = two_points();
    assert_int_equal(froe_tree_save(tree, "right.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(run_froe("check right.froe", said, sizeof said), 0);
    assert_non_null(strstr(said, "every invariant holds"));
}

static void swapped_objects_are_found_and_named(void **state) {
    (void)state;
    char said[2000];
    froe_tree *tree = two_points();
    assert_int_equal(tree->piece_count, 2);
    tree->pieces[0].object = 1 - tree->pieces[0].object;
    tree->pieces[1].object = 1 - tree->pieces[1].object;
    assert_int_equal(froe_tree_save(tree, "wrong.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(run_froe("check wrong.froe", said, sizeof said), 1);
    assert_non_null(strstr(said, "froe: wrong.froe: "));
    assert_non_null(strstr(said, "object "));
    assert_int_equal(run_froe("check wrong.froe --json 2>/dev/null", said, sizeof said), 1);
    assert_non_null(strstr(said, "\"ok\": false"));
    assert_non_null(strstr(said, "\"violation\""));
    assert_int_equal(run_froe("check wrong.froe --json >/dev/full", said, sizeof said), 4);
}

/* A program may save a tree without objects, which no file of a scene has. */
static void a_tree_of_nothing_is_told_about_and_asked(void **state) {
    (void)state;
    static const struct {
        const char *arguments, *said;
    } lines[] = {
        {"info nothing.froe", "pieces per object  0\n"},
        {"info nothing.froe --json", "\"bounds\": {}"},
        {"check nothing.froe", "every invariant holds"},
        {"draw nothing.froe -o nothing.svg", "nothing.svg"},
        {"export nothing.froe -o nothing.csv", "nothing.csv"},
        {"pairs nothing.froe --count", "kind,count\ncross,0\ntouch,0\noverlap,0\n"},
        {"locate nothing.froe --queries point.csv", "query,object,group\n"},
        {"near nothing.froe --queries point.csv", "query,object,distance\n"},
    };
    char said[8000];
    froe_scene *scene;
    froe_tree *tree;
    const froe_build_options options = froe_build_defaults();
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    const froe_crs degrees = {.kind = FROE_CRS_GEOGRAPHIC, .name = "WGS 84", .code = "EPSG:4326"};
    assert_int_equal(froe_scene_set_crs(scene, &degrees), FROE_OK);
    assert_int_equal(froe_build(scene, &options, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    assert_int_equal(froe_tree_save(tree, "nothing.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    FILE *points = fopen("point.csv", "w");
    assert_non_null(points);
    fputs("lon,lat\n1,2\n", points);
    fclose(points);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (run_froe(lines[i].arguments, said, sizeof said) || !strstr(said, lines[i].said))
            fail_msg("froe %s: %s", lines[i].arguments, said);
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_build(scene, &options, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    assert_int_equal(froe_tree_save(tree, "space.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(run_froe("render space.froe -o space.svg", said, sizeof said), 3);
    assert_string_equal(said, "froe: space.froe: There is nothing before the eye to fit.\n");
}

/* Settings are words of the builder's, numbers or not; a file may hold others. */
static void settings_are_told_as_they_are(void **state) {
    (void)state;
    char said[8000];
    froe_tree *tree = two_points();
    snprintf(tree->meta.settings, sizeof tree->meta.settings,
             "whole=7 real=0.5 huge=1e300 low=-1e300 far=inf more=1e999 text=7x none= word long=%070d", 1);
    memset(tree->meta.promises, 0, sizeof tree->meta.promises);
    tree->meta.promise_count = 1;
    tree->meta.promises[0] = (tree_promise){.name = "far", .promised = 123456789.5, .measured = 2};
    assert_int_equal(froe_tree_save(tree, "settings.froe", NULL), FROE_OK);
    froe_tree_free(tree);
    assert_int_equal(run_froe("info settings.froe --json", said, sizeof said), 0);
    const char *settings = strstr(said, "\"settings\"");
    assert_non_null(settings);
    assert_non_null(strstr(settings, "\"whole\": 7,"));
    assert_non_null(strstr(settings, "\"real\": 0.5,"));
    assert_non_null(strstr(settings, "\"huge\": 1e+300,"));
    assert_non_null(strstr(settings, "\"low\": -1e+300,"));
    assert_non_null(strstr(settings, "\"far\": \"inf\","));
    assert_non_null(strstr(settings, "\"more\": \"1e999\","));
    assert_non_null(strstr(settings, "\"text\": \"7x\","));
    assert_non_null(strstr(settings, "\"none\": \"\","));
    assert_non_null(strstr(settings, "0001\""));
    assert_null(strstr(settings, "word"));
    assert_int_equal(run_froe("info settings.froe", said, sizeof said), 0);
    assert_non_null(strstr(said, "  bounds     promised  measured\n    far   1.23457e+08         2\n"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_as_it_was_built_passes),
        cmocka_unit_test(swapped_objects_are_found_and_named),
        cmocka_unit_test(a_tree_of_nothing_is_told_about_and_asked),
        cmocka_unit_test(settings_are_told_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
