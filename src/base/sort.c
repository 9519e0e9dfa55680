/* sort.c: merging runs of 1, 2, 4, ... items. */
#include "base/sort.h"
#include <stdbool.h>
#include <string.h>

static void merge(const uint32_t *from, uint32_t *to, size_t middle, size_t end, base_compare_fn *compare, void *user) {
    size_t i = 0, j = middle;
    for (size_t k = 0; k < end; k++) {
        const bool left = i < middle && (j == end || compare(user, from[i], from[j]) <= 0);
        to[k] = left ? from[i++] : from[j++];
    }
}

void base_merge_sort(uint32_t *items, uint32_t *spare, size_t count, base_compare_fn *compare, void *user) {
    uint32_t *from = items, *to = spare;
    for (size_t run = 1; run < count; run *= 2) {
        for (size_t i = 0; i < count; i += 2 * run) {
            const size_t end = count - i < 2 * run ? count - i : 2 * run;
            merge(from + i, to + i, run < end ? run : end, end, compare, user);
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != items) memcpy(items, from, count * sizeof *items);
}
