/* test_reading.c: trees read from disks that are slow, interrupted or broken, and from files that become shorter while
 * they are read. Linked with --wrap=read, so that read() comes here. */
#include "trees.h"
#include <errno.h>
#include <sys/types.h>

ssize_t __real_read(int fd, void *to, size_t count);
ssize_t __wrap_read(int fd, void *to, size_t count);

/* What a call does when it is the one with this number, counted from 0. */
typedef enum behaviour { AS_USUAL, BY_BYTES, INTERRUPTED, BROKEN, ENDS } behaviour;

static struct {
    behaviour how;
    int at, calls;
} disk;

ssize_t __wrap_read(int fd, void *to, size_t count) {
    const bool now = disk.calls++ == disk.at;
    if (disk.how == BY_BYTES || (disk.how != AS_USUAL && !now)) return __real_read(fd, to, count < 1000 ? count : 1000);
    if (!now || disk.how == AS_USUAL) return __real_read(fd, to, count);
    if (disk.how == ENDS) return 0;
    errno = disk.how == INTERRUPTED ? EINTR : EIO;
    return -1;
}

static const char path[] = "read.froe";

static froe_tree *save(void) {
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 60, 0, 0.4, "autopartition", 1);
    assert_int_equal(froe_tree_save(tree, path, NULL), FROE_OK);
    return tree;
}

static froe_status open_from(behaviour how, int at, froe_tree **out, froe_diagnostic *why) {
    disk.how = how, disk.at = at, disk.calls = 0;
    const froe_status status = froe_tree_open_copy(path, NULL, out, why);
    disk.how = AS_USUAL;
    return status;
}

static void reading_goes_on_after_interruptions_and_parts(void **state) {
    (void)state;
    froe_tree *saved = save();
    for (int at = 0; at < 5; at++)
        for (int how = AS_USUAL; how <= INTERRUPTED; how++) {
            froe_tree *tree = NULL;
            assert_int_equal(open_from((behaviour)how, at, &tree, NULL), FROE_OK);
            assert_true(how == AS_USUAL || disk.calls > 5);
            assert_int_equal(froe_tree_check(tree, NULL), FROE_OK);
            trees_assert_equal(tree, saved);
            froe_tree_free(tree);
        }
    froe_tree_free(saved);
}

static void disks_that_fail_and_files_that_end_are_told(void **state) {
    (void)state;
    froe_tree_free(save());
    for (int at = 0; at < 5; at++) {
        test_memory m;
        froe_diagnostic why = {0};
        froe_tree *tree = NULL;
        const froe_allocator alloc = test_memory_begin(&m);
        disk.how = BROKEN, disk.at = at, disk.calls = 0;
        assert_int_equal(froe_tree_open_copy(path, &alloc, &tree, &why), FROE_E_IO);
        assert_non_null(strstr(why.message, strerror(EIO)));
        disk.how = ENDS, disk.calls = 0;
        assert_int_equal(froe_tree_open_copy(path, &alloc, &tree, &why), FROE_E_FORMAT);
        assert_non_null(strstr(why.message, at ? "it is truncated" : "it is empty"));
        disk.how = AS_USUAL;
        assert_null(tree);
        test_memory_end(&m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_goes_on_after_interruptions_and_parts),
        cmocka_unit_test(disks_that_fail_and_files_that_end_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
