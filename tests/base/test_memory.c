/* test_memory.c: an allocator is told the size that it gave, of empty arrays, too. */
#include "support/alloc.h"
#include "support/memory.h"

static void empty_arrays_go_back_as_they_came(void **state) {
    (void)state;
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    uint64_t *none = support_calloc(&alloc, 0, sizeof *none), *some = support_calloc(&alloc, 3, sizeof *some);
    assert_non_null(none);
    support_free(&alloc, none, 0 * sizeof *none); /* test_memory_fn() compares */
    support_free(&alloc, some, 3 * sizeof *some);
    support_free(&alloc, NULL, 0);
    test_memory_end(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(empty_arrays_go_back_as_they_came)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
