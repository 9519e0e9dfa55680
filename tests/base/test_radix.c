/* test_radix.c: the radix sort is a stable sort, and keys order doubles. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/radix.h"
#include "support/fuzz.h"

/* Keys that vary in the bytes of `mask` only. */
static void check(fuzz_source *r, size_t count, uint64_t mask) {
    base_pair *pairs = malloc((count + 1) * sizeof *pairs), *spare = malloc((count + 1) * sizeof *spare);
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    assert_true(pairs && spare && keys);
    unsigned char *seen = calloc(count + 1, 1);
    assert_non_null(seen);
    for (size_t i = 0; i < count; i++) {
        keys[i] = (fuzz_bits(r) & mask) | (0x5555555555555555u & ~mask);
        pairs[i] = (base_pair){keys[i], (uint32_t)i};
    }
    base_radix_sort(pairs, spare, count);
    for (size_t i = 0; i < count; i++) {
        assert_true(pairs[i].key == keys[pairs[i].value]);
        assert_false(seen[pairs[i].value]);
        seen[pairs[i].value] = 1;
        if (i == 0) continue;
        assert_true(pairs[i - 1].key <= pairs[i].key);
        if (pairs[i - 1].key == pairs[i].key) assert_true(pairs[i - 1].value < pairs[i].value);
    }
    free(seen);
    free(keys);
    free(spare);
    free(pairs);
}

static void sorting_is_stable_and_loses_nothing(void **state) {
    (void)state;
    static const uint64_t masks[] = {0, 0xff, 0xff00, 0x3, 0xff000000000000ff, UINT64_MAX, 0x0300000000000000};
    fuzz_source r = {1};
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++)
        for (size_t count = 0; count < 40; count++) check(&r, count, masks[i]);
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) check(&r, 20000, masks[i]);
}

static void keys_order_as_the_doubles_do(void **state) {
    (void)state;
    fuzz_source r = {2};
    for (int i = 0; i < 200000; i++) {
        double x = fuzz_coordinate(&r, i % 2 ? FUZZ_BITS : FUZZ_MIXED), y = fuzz_coordinate(&r, FUZZ_MIXED);
        uint64_t a = base_double_key(x), b = base_double_key(y);
        assert_int_equal(x < y, a < b);
        assert_int_equal(x == y, a == b);
    }
    assert_true(base_double_key(-0.0) == base_double_key(0.0));
    assert_true(base_double_key(-0x1p-1074) < base_double_key(0.0));
    assert_true(base_double_key(0x1p-1074) > base_double_key(0.0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sorting_is_stable_and_loses_nothing),
        cmocka_unit_test(keys_order_as_the_doubles_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
