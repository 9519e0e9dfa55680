/* radix.h: stable least-significant-digit radix sort of (key, value) pairs. */
#ifndef FROE_BASE_RADIX_H
#define FROE_BASE_RADIX_H
#include "support/arithmetic.h"
#include <stddef.h>
#include <stdint.h>

typedef struct base_pair {
    uint64_t key;
    uint32_t value;
} base_pair;
/** Sorts by key, stably; `spare` holds count items more. Digits all equal are skipped. O(count). */
void base_radix_sort(base_pair *pairs, base_pair *spare, size_t count);

/** A key whose unsigned order is the order of finite doubles (-0 and +0 alike). */
uint64_t base_double_key(double x);
#endif
