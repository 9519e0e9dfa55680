/* sort.h: a stable sort by a comparison that may be expensive: bottom-up merging, no recursion. */
#ifndef FROE_BASE_SORT_H
#define FROE_BASE_SORT_H
#include <stddef.h>
#include <stdint.h>

/** < 0, 0, > 0 as the item numbered a comes before, with or after b. */
typedef int base_compare_fn(void *user, uint32_t a, uint32_t b);
/** Sorts item numbers; `spare` holds count more. O(count log count) comparisons. */
void base_merge_sort(uint32_t *items, uint32_t *spare, size_t count, base_compare_fn *compare, void *user);
#endif
