/* select.h: the item that would have some place if all were sorted. Hoare's FIND (1961), with the middle of three as
 * pivot; where that divides badly too often, the rest is sorted. */
#ifndef FROE_SHARDS_SELECT_H
#define FROE_SHARDS_SELECT_H
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef int shards_compare_fn(const void *a, const void *b);

static inline void select_swap(char *a, char *b, size_t size) {
    for (size_t at = 0; at < size; at += 8) {
        uint64_t x, y;
        memcpy(&x, a + at, 8), memcpy(&y, b + at, 8);
        memcpy(a + at, &y, 8), memcpy(b + at, &x, 8);
    }
}

/* Brings the middle one of the first, middle and last item to the front. */
static inline void select_pivot(char *first, size_t count, size_t size, shards_compare_fn *compare) {
    char *middle = first + count / 2 * size, *last = first + (count - 1) * size;
    if (compare(middle, last) > 0) select_swap(middle, last, size);
    if (compare(first, middle) < 0) select_swap(first, middle, size); /* now first is not below middle */
    if (compare(first, last) > 0) select_swap(first, last, size);
}

/** Brings the item number `place` in the order of `compare` to its place, those below in front of it and those above
 * behind it; place < count. Items have `size` bytes, a multiple of 8. O(count) mostly, and never more than sorting. */
static inline void shards_select(void *items, size_t count, size_t size, size_t place, shards_compare_fn *compare) {
    enum { MOST = 96 }; /* divisions; of 2^31 items about 60 */
    char *first = items;
    for (int turn = 0; count > 1; turn++) {
        if (turn == MOST) {
            qsort(first, count, size, compare);
            return;
        }
        select_pivot(first, count, size, compare);
        size_t below = 0, end = count; /* items 1 .. below are not above the pivot, from `end` on none is below it */
        while (below + 1 < end) {
            if (compare(first + (below + 1) * size, first) < 0)
                below++;
            else if (compare(first + (end - 1) * size, first) > 0)
                end--;
            else
                select_swap(first + ++below * size, first + --end * size, size);
        }
        select_swap(first, first + below * size, size);
        if (below == place) return;
        if (place < below) {
            count = below;
        } else {
            first += (below + 1) * size;
            count -= below + 1;
            place -= below + 1;
        }
    }
}
#endif
