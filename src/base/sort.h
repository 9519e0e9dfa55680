/* sort.h: a stable sort by a comparison that may be expensive, and one in place. Neither recurses nor allocates memory,
 * which the C library's qsort may do. */
#ifndef FROE_BASE_SORT_H
#define FROE_BASE_SORT_H
#include "support/arithmetic.h"
#include <stddef.h>
#include <stdint.h>

/** < 0, 0, > 0 as the item numbered a comes before, with or after b. */
typedef int base_compare_fn(void *user, uint32_t a, uint32_t b);
/** Sorts item numbers; `spare` holds count more. O(count log count) comparisons. */
void base_merge_sort(uint32_t *items, uint32_t *spare, size_t count, base_compare_fn *compare, void *user);

/** As qsort: heapsort (Williams 1964). Items that compare equal should be equal. O(count log count). */
void base_sort(void *items, size_t count, size_t size, int (*compare)(const void *a, const void *b));
/** For that: doubles, none of them NaN. */
int base_compare_doubles(const void *a, const void *b);
#endif
