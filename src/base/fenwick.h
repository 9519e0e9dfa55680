/* fenwick.h: counts at positions 1 .. size, with sums of prefixes and the position of the k-th item (Fenwick 1994). */
#ifndef FROE_BASE_FENWICK_H
#define FROE_BASE_FENWICK_H
#include "support/alloc.h"

typedef struct base_fenwick {
    uint32_t size, total;
    uint32_t *sum; /**< [0 .. size] */
} base_fenwick;

/** All counts 0. sum == NULL after this: out of memory. */
static inline base_fenwick base_fenwick_new(const froe_allocator *alloc, uint32_t size) {
    return (base_fenwick){size, 0, support_calloc(alloc, (size_t)size + 1, sizeof(uint32_t))};
}
static inline void base_fenwick_free(const froe_allocator *alloc, base_fenwick *f) {
    support_free(alloc, f->sum, ((size_t)f->size + 1) * sizeof(uint32_t));
    f->sum = NULL;
}
/** `by` is 1 or -1 (as an unsigned number). O(log size), as all that follows. */
static inline void base_fenwick_add(base_fenwick *f, uint32_t at, uint32_t by) {
    f->total += by;
    for (; at <= f->size; at += at & -at) f->sum[at] += by;
}
/** Items at positions up to `at`. */
static inline uint32_t base_fenwick_prefix(const base_fenwick *f, uint32_t at) {
    uint32_t sum = 0;
    for (; at; at &= at - 1) sum += f->sum[at];
    return sum;
}
/** Position of the k-th item, k >= 1; size + 1 if there are fewer. */
static inline uint32_t base_fenwick_select(const base_fenwick *f, uint32_t k) {
    uint32_t at = 0, step = 1;
    while (step <= f->size / 2) step *= 2;
    for (; step; step /= 2)
        if (at + step <= f->size && f->sum[at + step] < k) {
            at += step;
            k -= f->sum[at];
        }
    return at + 1;
}
#endif
