/* select.h: the k-th smallest of some numbers, without sorting them. */
#ifndef FROE_BASE_SELECT_H
#define FROE_BASE_SELECT_H
#include "support/arithmetic.h"
#include <stddef.h>

/** The number that would stand at place k < count if they were sorted; reorders them. None may be NaN.
 * O(count) expected (Hoare 1961); pivots are drawn by a fixed hash. */
double base_select(double *values, size_t count, size_t k);
#endif
