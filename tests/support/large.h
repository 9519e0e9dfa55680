/* large.h: a small tree, asked as one that no cache holds.
 *
 * Batches answer questions one after the other where the tree fits into the caches, and in flocks or in turns where it
 * does not. Tests have small trees, and have to see both ways. */
#ifndef FROE_TESTS_SUPPORT_LARGE_H
#define FROE_TESTS_SUPPORT_LARGE_H
#include "query/packed/packed.h"
#include "query/packed/space.h"

/** From now on, for batches on one thread. */
static inline void large_ask(froe_query *q, bool large) {
    if (q->packed) q->packed->flock_from = large ? 0 : UINT32_MAX;
    if (q->space) q->space->turns_from[0] = q->space->turns_from[1] = large ? 0 : UINT64_MAX;
}
#endif
