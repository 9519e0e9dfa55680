/* test_machine.c: machines that froe does not run on, or does not save trees on: those that round otherwise, and those
 * of the other order of bytes. Linked with --wrap, so that the checks of both come here. */
#include "num/context.h"
#include "support/fail.h"
#include "support/tree_file.h"
#include "trees.h"
#include <froe/kinetic.h>
#include <string.h>
#include <unistd.h>

froe_status __real_num_rounding_check(froe_diagnostic *diag);
froe_status __wrap_num_rounding_check(froe_diagnostic *diag);
froe_status __real_file_check_machine(froe_diagnostic *diag);
froe_status __wrap_file_check_machine(froe_diagnostic *diag);

static enum { USUAL, ROUNDS_OTHERWISE, OTHER_ORDER } machine;

froe_status __wrap_num_rounding_check(froe_diagnostic *diag) {
    if (machine != ROUNDS_OTHERWISE) return __real_num_rounding_check(diag);
    return support_fail(diag, FROE_E_UNSUPPORTED, "It rounds otherwise.");
}

froe_status __wrap_file_check_machine(froe_diagnostic *diag) {
    if (machine != OTHER_ORDER) return __real_file_check_machine(diag);
    return support_fail(diag, FROE_E_UNSUPPORTED, "It has another order of bytes.");
}

static const char path[] = "machine.froe";
static const char *const said[] = {"", "It rounds otherwise.", "It has another order of bytes."};

static void no_tree_is_opened_on_a_machine_that_cannot(void **state) {
    (void)state;
    froe_tree *saved = trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "autopartition", 1);
    tree_file file = {0};
    assert_int_equal(froe_tree_save(saved, path, NULL), FROE_OK);
    assert_int_equal(froe_tree_write(saved, tree_file_receive, &file, NULL), FROE_OK);
    for (int m = USUAL; m <= OTHER_ORDER; m++)
        for (int way = 0; way < 3; way++) {
            test_memory memory;
            const froe_allocator alloc = test_memory_begin(&memory);
            froe_diagnostic why = {0};
            froe_tree *tree = NULL;
            machine = m;
            const froe_status status = way == 0   ? froe_tree_open(path, &alloc, &tree, &why)
                                       : way == 1 ? froe_tree_open_copy(path, &alloc, &tree, &why)
                                                  : froe_tree_open_memory(file.bytes, file.size, &alloc, &tree, &why);
            machine = USUAL;
            assert_int_equal(status, m == USUAL ? FROE_OK : FROE_E_UNSUPPORTED);
            assert_int_equal(memory.calls > 0, m == USUAL);
            if (m == USUAL) trees_assert_equal(tree, saved);
            if (m != USUAL) assert_null(tree);
            if (m != USUAL) assert_string_equal(why.message, said[m]);
            froe_tree_free(tree);
            test_memory_end(&memory);
        }
    free(file.bytes);
    froe_tree_free(saved);
}

/* Where rounding differs there are no scenes, hence no trees. */
static void no_tree_is_saved_where_bytes_have_another_order(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "autopartition", 1);
    for (int m = USUAL; m <= OTHER_ORDER; m += OTHER_ORDER) {
        froe_diagnostic why = {0};
        tree_file file = {0};
        unlink(path);
        machine = m;
        assert_int_equal(froe_tree_save(tree, path, &why), m == USUAL ? FROE_OK : FROE_E_UNSUPPORTED);
        assert_string_equal(why.message, said[m]);
        assert_int_equal(froe_tree_write(tree, tree_file_receive, &file, &why),
                         m == USUAL ? FROE_OK : FROE_E_UNSUPPORTED);
        machine = USUAL;
        assert_int_equal(access(path, F_OK) == 0, m == USUAL);
        assert_int_equal(file.size, m == USUAL ? froe_tree_saved_size(tree) : 0);
        free(file.bytes);
    }
    froe_tree_free(tree);
}

static void nothing_is_begun_where_rounding_differs(void **state) {
    (void)state;
    froe_scene *scene = NULL;
    froe_motion *motion = NULL;
    machine = ROUNDS_OTHERWISE;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_E_UNSUPPORTED);
    froe_motion_options options = froe_motion_defaults();
    froe_diagnostic why = {0};
    assert_int_equal(froe_motion_new(&options, NULL, &motion, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, said[ROUNDS_OTHERWISE]);
    machine = USUAL;
    assert_null(scene);
    assert_null(motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_tree_is_opened_on_a_machine_that_cannot),
        cmocka_unit_test(no_tree_is_saved_where_bytes_have_another_order),
        cmocka_unit_test(nothing_is_begun_where_rounding_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
