/* pair_lists.h: pairs that threads find in any order, reported in the order of their ids.
 *
 *     thread 0    a < 4096 | a < 8192 | ...     what it finds, parted by the first id
 *     thread 1    a < 4096 | a < 8192 | ...
 *                     |          |
 *                  sorted     sorted            each part by one thread: counted by the first id, then by the second
 *                     `----------'-----> reported
 *
 * Each pair is added once, so that their order does not depend on which thread found which pair. It speaks for
 * pair_lists.c and pairs.c (the public calls). */
#ifndef FROE_QUERY_PAIRS_PAIR_LISTS_H
#define FROE_QUERY_PAIRS_PAIR_LISTS_H
#include "base/apart.h"
#include "base/task.h"
#include "support/array.h"
#include <froe/query.h>

enum { PAIR_PARTS = 256, PAIRS_EACH = 16, PAIRS_MORE = 1 << 20 };

typedef struct pair_item {
    uint32_t a, b; /**< b with the kind above its PAIR_KIND bits */
} pair_item;
#define PAIR_KIND 30

/** What one thread has found. */
typedef struct pair_list {
    ARRAY(pair_item) parts[PAIR_PARTS];
    uint32_t room; /**< pairs it may add before it takes more room */
    base_apart apart;
} pair_list;

typedef struct pair_lists {
    const froe_allocator *alloc;
    uint32_t objects;
    unsigned shift; /**< from a first id to its part */
    unsigned threads;
    pair_list *lists;              /**< [thread] */
    atomic_uint left;              /**< of the pairs that may be added by all threads */
    size_t firsts[PAIR_PARTS + 1]; /**< of each part, once sorted */
    uint32_t *starts;              /**< [object], one more: its pairs in ... */
    uint32_t *sorted;              /**< ... the b of all pairs */
} pair_lists;

/** For pairs of at most 2^30 objects: PAIRS_EACH for each object, and PAIRS_MORE, but less than 2^32.
 * FROE_E_MEMORY. */
froe_status pair_lists_take(pair_lists *out, const froe_allocator *alloc, uint32_t objects, unsigned threads);
void pair_lists_give(pair_lists *lists);
/** Adds a pair, in either order. FROE_E_LIMIT: there are too many; FROE_E_MEMORY. */
froe_status pair_lists_add(pair_lists *lists, unsigned thread, uint32_t a, uint32_t b, froe_meeting kind);
/** Once all have been added. FROE_E_MEMORY, FROE_E_CANCELLED. O(pairs log most of one object). */
froe_status pair_lists_sort(pair_lists *lists, base_task *task, double span);
/** Reports the pairs by a, then b, until the visitor returns false. */
void pair_lists_tell(const pair_lists *lists, froe_pair_fn *fn, void *user);
#endif
