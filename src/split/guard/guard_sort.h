/* guard_sort.h: guards in the order of each axis. */
#ifndef FROE_SPLIT_GUARD_GUARD_SORT_H
#define FROE_SPLIT_GUARD_GUARD_SORT_H
#include "base/radix.h"
#include "support/arithmetic.h"
#include <stdbool.h>
#include <stddef.h>

/** order[i], count pairs each: the guards sorted by coordinate i (base_double_key), equal ones by
 * coordinates 0, 1, .. in turn, and their numbers. spare: count pairs. O(dim * count) */
void guard_sort(const double *points, size_t count, int dim, base_pair **order, base_pair *spare);
#endif
