/* test_memory.c: an allocator is told the size that it gave, of empty arrays, too; arrays of any size keep what is in
 * them when they grow and shrink. */
#include "support/alloc.h"
#include "support/array.h"
#include "support/memory.h"
#include "support/pages.h"

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

static void an_allocator_without_a_function_is_that_of_c(void **state) {
    (void)state;
    const froe_allocator none = {NULL, NULL}, own = support_allocator(&none), usual = support_allocator(NULL);
    test_memory m;
    const froe_allocator given = test_memory_begin(&m), same = support_allocator(&given);
    assert_true(own.fn == usual.fn && own.fn);
    assert_true(same.fn == given.fn && same.user == &m);
    int *data = support_calloc(&own, 3, sizeof *data);
    assert_true(data && !data[2]);
    support_free(&own, data, 3 * sizeof *data);
}

/* Nothing is nothing, and sizes beyond all memory are refused before anybody is asked. */
static void sizes_that_overflow_are_refused(void **state) {
    (void)state;
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    uint64_t *data = NULL;
    size_t room = 0;
    assert_null(support_realloc(&alloc, NULL, 0, 0));
    assert_null(support_calloc(&alloc, SIZE_MAX / 2, 3));
    assert_false(support_array_grow(&alloc, (void **)(void *)&data, &room, 5, SIZE_MAX - 4, sizeof *data));
    assert_false(support_array_grow(&alloc, (void **)(void *)&data, &room, 5, SIZE_MAX / 4, sizeof *data));
    assert_int_equal(m.calls, 0);
    assert_int_equal(room, 0);
    assert_null(data);
    test_memory_end(&m);
}

/* Numbers of which each says where it is. */
static void fill(uint32_t *x, size_t from, size_t to) {
    for (size_t i = from; i < to; i++) x[i] = (uint32_t)(i * 2654435761u);
}

static void check(const uint32_t *x, size_t count) {
    for (size_t i = 0; i < count; i++) assert_int_equal(x[i], (uint32_t)(i * 2654435761u));
}

static void arrays_that_grow_and_shrink_keep_what_they_hold(void **state) {
    (void)state;
    /* small and large, whole pages and not, growing in a place and to another, to large and back */
    static const size_t counts[] = {1, 1000, 1 << 20, (1 << 20) - 1, 3 << 19, (3 << 19) + 7, 5 << 20, 1 << 21, 100};
    const froe_allocator alloc = support_allocator(NULL);
    uint32_t *x = NULL;
    size_t held = 0;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        uint32_t *y = support_realloc(&alloc, x, held * sizeof *x, counts[i] * sizeof *x);
        assert_non_null(y);
        check(y, held < counts[i] ? held : counts[i]);
        fill(y, 0, counts[i]);
        if (support_pages_serve(counts[i] * sizeof *y)) assert_int_equal((uintptr_t)y % (2 << 20), 0);
        x = y, held = counts[i];
    }
    support_free(&alloc, x, held * sizeof *x);
}

static void arrays_beside_each_other_do_not_disturb_each_other(void **state) {
    (void)state;
    enum { ARRAYS = 6, LEAST = 5 << 18 };
    const froe_allocator alloc = support_allocator(NULL);
    uint32_t *x[ARRAYS];
    for (size_t round = 0; round < 3; round++)
        for (size_t i = 0; i < ARRAYS; i++) {
            const size_t held = round ? LEAST + i * round * 1000 : 0, count = LEAST + i * (round + 1) * 1000;
            x[i] = support_realloc(&alloc, round ? x[i] : NULL, held * sizeof **x, count * sizeof **x);
            assert_non_null(x[i]);
            fill(x[i], held, count);
        }
    for (size_t i = 0; i < ARRAYS; i++) check(x[i], LEAST + i * 3000);
    for (size_t i = 0; i < ARRAYS; i++) support_free(&alloc, x[i], (LEAST + i * 3000) * sizeof **x);
}

static void sizes_beyond_all_memory_are_refused_and_the_array_stays(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    if (!support_pages_serve(SIZE_MAX)) skip(); /* sanitizers end the program */
    const size_t held[] = {1000, 5 << 18}, wanted[] = {SIZE_MAX / 4, SIZE_MAX - 5, SIZE_MAX - (2 << 20)};
    for (size_t i = 0; i < 2; i++) {
        uint32_t *x = support_realloc(&alloc, NULL, 0, held[i] * sizeof *x);
        assert_non_null(x);
        fill(x, 0, held[i]);
        for (size_t k = 0; k < 3; k++) assert_null(support_realloc(&alloc, x, held[i] * sizeof *x, wanted[k]));
        check(x, held[i]);
        support_free(&alloc, x, held[i] * sizeof *x);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(an_allocator_without_a_function_is_that_of_c),
                                       cmocka_unit_test(sizes_that_overflow_are_refused),
                                       cmocka_unit_test(empty_arrays_go_back_as_they_came),
                                       cmocka_unit_test(arrays_that_grow_and_shrink_keep_what_they_hold),
                                       cmocka_unit_test(arrays_beside_each_other_do_not_disturb_each_other),
                                       cmocka_unit_test(sizes_beyond_all_memory_are_refused_and_the_array_stays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
