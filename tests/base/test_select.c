/* The k-th smallest number is the one that sorting puts there. */
#include "base/random.h"
#include "base/select.h"
#include "base/sort.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 300 };

static void selecting_is_sorting(void **state) {
    double values[MOST], sorted[MOST], copy[MOST];
    (void)state;
    for (uint64_t seed = 0; seed < 600; seed++) {
        const size_t count = 1 + base_below(base_hash(seed, 1, 0), MOST);
        const uint32_t different = 1 + base_below(base_hash(seed, 2, 0), seed % 3 ? MOST : 4);
        for (size_t i = 0; i < count; i++) {
            values[i] = base_below(base_hash(seed, 3, i), different);
            if (seed % 5 == 0) values[i] = (double)(seed % 2 ? i : count - i); /* in order, or backwards */
        }
        memcpy(sorted, values, sizeof sorted);
        base_sort(sorted, count, sizeof *sorted, base_compare_doubles);
        for (size_t k = 0; k < count; k += 1 + count / 7) {
            memcpy(copy, values, sizeof copy);
            assert_true(base_select(copy, count, k) == sorted[k]);
            base_sort(copy, count, sizeof *copy, base_compare_doubles);
            assert_memory_equal(copy, sorted, count * sizeof *copy);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(selecting_is_sorting)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
