/* test_verdict.c: froe check says no, with exit code 1 and the violation, about a
 * tree that the file format lets pass: whole and valid, but with two objects swapped. */
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
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_as_it_was_built_passes),
        cmocka_unit_test(swapped_objects_are_found_and_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
