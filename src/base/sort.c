/* sort.c: merging runs of 1, 2, 4, ... items; and heapsort. */
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

static void swap(char *a, char *b, size_t size) {
    for (size_t i = 0; i < size; i++) {
        const char c = a[i];
        a[i] = b[i];
        b[i] = c;
    }
}

/** Lets the item at `top` sink until no child comes after it. */
static void sink(char *items, size_t top, size_t count, size_t size, int (*compare)(const void *, const void *)) {
    while (2 * top + 1 < count) {
        size_t child = 2 * top + 1;
        if (child + 1 < count && compare(items + child * size, items + (child + 1) * size) < 0) child++;
        if (compare(items + top * size, items + child * size) >= 0) return;
        swap(items + top * size, items + child * size, size);
        top = child;
    }
}

void base_sort(void *items, size_t count, size_t size, int (*compare)(const void *a, const void *b)) {
    char *first = items;
    for (size_t i = count / 2; i-- > 0;) sink(first, i, count, size, compare);
    for (size_t end = count; end-- > 1;) {
        swap(first, first + end * size, size);
        sink(first, 0, end, size, compare);
    }
}

int base_compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
