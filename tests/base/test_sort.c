/* test_sort.c: the sort in place sorts, whatever the size of its items, and so does the stable one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/sort.h"
#include "support/fuzz.h"

enum { MOST = 1000 };

typedef struct item {
    uint32_t key, again;
    char letter;
} item;

static int by_key(const void *a, const void *b) {
    const item *x = a, *y = b;
    return (x->key > y->key) - (x->key < y->key);
}

static void items_of_any_size_come_in_order_and_none_is_lost(void **state) {
    fuzz_source r = {1};
    (void)state;
    for (size_t count = 0; count <= MOST; count = count < 20 ? count + 1 : 3 * count) {
        item items[MOST] = {{0}};
        int keys = fuzz_int(&r, 1, (int)count + 1), seen[MOST + 2] = {0};
        for (size_t i = 0; i < count; i++) {
            uint32_t key = (uint32_t)fuzz_int(&r, 0, keys);
            items[i] = (item){key, key, (char)key};
            seen[key]++;
        }
        base_sort(items, count, sizeof *items, by_key);
        for (size_t i = 0; i < count; i++) {
            assert_true(!i || items[i - 1].key <= items[i].key);
            assert_true(items[i].key == items[i].again && items[i].letter == (char)items[i].key);
            seen[items[i].key]--;
        }
        for (size_t i = 0; i < MOST + 2; i++) assert_int_equal(seen[i], 0);
    }
}

static void doubles_come_in_order(void **state) {
    fuzz_source r = {2};
    double x[MOST];
    (void)state;
    for (size_t i = 0; i < MOST; i++) x[i] = fuzz_coordinate(&r, i % 2 ? FUZZ_BITS : FUZZ_LATTICE);
    base_sort(x, MOST, sizeof *x, base_compare_doubles);
    for (size_t i = 1; i < MOST; i++) assert_true(x[i - 1] <= x[i]);
}

static int by_half(void *user, uint32_t a, uint32_t b) {
    const uint32_t *key = user;
    return (key[a] > key[b]) - (key[a] < key[b]);
}

static void merging_keeps_the_order_of_equals(void **state) {
    fuzz_source r = {3};
    uint32_t key[MOST], order[MOST], spare[MOST];
    (void)state;
    for (size_t count = 0; count <= MOST; count += 37) {
        for (uint32_t i = 0; i < count; i++) key[i] = (uint32_t)fuzz_int(&r, 0, 9), order[i] = i;
        base_merge_sort(order, spare, count, by_half, key);
        for (size_t i = 1; i < count; i++) {
            assert_true(key[order[i - 1]] <= key[order[i]]);
            assert_true(key[order[i - 1]] < key[order[i]] || order[i - 1] < order[i]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(items_of_any_size_come_in_order_and_none_is_lost),
        cmocka_unit_test(doubles_come_in_order),
        cmocka_unit_test(merging_keeps_the_order_of_equals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
