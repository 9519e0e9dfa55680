/* test_pages.c: large arrays where a library of the program has put itself in the place of mremap(). */
#include "support/alloc.h"
#include "support/memory.h"

/* As UCX does, which MPICH uses: its function passes on four arguments, and not where to move to. The system refuses
 * the call, or for root moves the mapping to address 0. */
void *__wrap_mremap(void *at, size_t old_length, size_t length, int flags, ...);
void *__wrap_mremap(void *at, size_t old_length, size_t length, int flags, ...) {
    (void)at, (void)old_length, (void)length, (void)flags;
    return NULL;
}

static void arrays_grow_where_mremap_is_replaced(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    enum { SMALL = 9 << 20, LARGE = 33 << 20 };
    unsigned char *bytes = support_realloc(&alloc, NULL, 0, SMALL);
    assert_non_null(bytes);
    for (size_t i = 0; i < SMALL; i += 4096) bytes[i] = (unsigned char)(i >> 12);
    unsigned char *grown = support_realloc(&alloc, bytes, SMALL, LARGE);
    assert_non_null(grown);
    for (size_t i = 0; i < SMALL; i += 4096) assert_int_equal(grown[i], (unsigned char)(i >> 12));
    grown[LARGE - 1] = 1;
    support_free(&alloc, grown, LARGE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(arrays_grow_where_mremap_is_replaced)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
