/* test_trial.c: refinement that costs too much is taken back where guard cuts cost less, and only there. */
#include "support/memory.h"
#include <froe/formats.h>
#include <froe/froe.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/** Pieces per object of a scene, by density; the tree is audited. */
static double pieces_each(const char *kind, size_t n, int threads) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_diagnostic diag = {0};
    froe_build_options o = froe_build_defaults();
    assert_int_equal(froe_generate(kind, n, 1, NULL, &scene, NULL), FROE_OK);
    o.method = "density";
    o.leaf = 1;
    o.threads = threads;
    if (froe_build(scene, &o, &tree, &diag) || froe_tree_audit(tree, NULL, &diag)) fail_msg("%s", diag.message);
    double each = (double)froe_tree_piece_count(tree) / (double)froe_scene_object_count(scene);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return each;
}

/** Refinement of the first cells would make 6, 14 and more pieces each. */
static void nested_cubes_have_few_pieces_whatever_their_number(void **state) {
    (void)state;
    for (size_t n = 1000; n <= 4000; n *= 2) assert_true(pieces_each("nested-3d", n, 2) < 5.2);
}

static void nested_squares_have_few_pieces(void **state) {
    (void)state;
    assert_true(pieces_each("nested", 3000, 2) < 6.5);
}

/** A quarter of n^2 crossings. Guard cuts would make 1.7 times as many pieces. */
static void where_every_partition_is_quadratic_refinement_stays(void **state) {
    (void)state;
    assert_true(pieces_each("slats-3d", 200, 2) < 51.5);
}

static void a_trial_ends_alike_on_any_number_of_threads(void **state) {
    (void)state;
    double one = pieces_each("nested-3d", 2000, 1);
    assert_true(one == pieces_each("nested-3d", 2000, 3));
}

/** In these squares refinement is taken back. */
static froe_status build_nested(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    (void)user;
    o.method = "density";
    o.threads = 1;
    froe_status status = froe_generate("nested", 300, 1, alloc, &scene, NULL);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void trials_survive_every_failing_allocation(void **state) {
    (void)state;
    test_memory_each(build_nested, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nested_cubes_have_few_pieces_whatever_their_number),
        cmocka_unit_test(nested_squares_have_few_pieces),
        cmocka_unit_test(where_every_partition_is_quadratic_refinement_stays),
        cmocka_unit_test(a_trial_ends_alike_on_any_number_of_threads),
        cmocka_unit_test(trials_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
