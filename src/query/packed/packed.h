/* packed.h: queries on packed trees (tree/packed/packed.h), several leaves in flight, sixteen fragments at a time.
 *
 *     jump table -> walk -> [leaf, leaf, slice, leaf ...] -> kernels -> sure answers, unsure ones -> exact predicates
 *
 * Walks compare doubles, so nothing about them is uncertain. Blocks are prefetched while the walk goes on and
 * tested after it, so that their cache misses overlap.
 *
 * It speaks for packed_window.c, packed_vertical.c and packed_pairs.c. */
#ifndef FROE_QUERY_PACKED_PACKED_H
#define FROE_QUERY_PACKED_PACKED_H
#include "query/context.h"
#include "query/packed/packed_kernel.h"
#include "query/workers.h"
#include "tree/packed/table.h"

typedef struct packed_waiting {
    uint32_t node;
    uint32_t open; /**< bits: sides of the window that a cut of its region may still meet: x lo, x hi, y lo, y hi */
} packed_waiting;

/** A leaf to be tested, or, with an end, the leaves from one block up to another, all of them in the window. */
typedef struct packed_visit {
    uint32_t block, end, count;
} packed_visit;

/** A subtree to be searched later for what is near, and how far the point is from its region along the axes, scaled. */
typedef struct packed_far {
    double gap[2];
    uint32_t node;
} packed_far;

/** Fragments of a leaf of which a kernel does not know whether they meet. */
typedef struct packed_open {
    uint32_t i, j;
    bool bent; /**< they are surely not on one line */
} packed_open;

/** First and last corner of a fragment's object. */
typedef struct packed_corners {
    uint32_t vertex[2];
} packed_corners;

enum { PACKED_FLIGHT = 16 }; /* vertical rays in flight */

/** What a context has for packed trees. */
typedef struct packed_work {
    const packed_kernels *kernels;
    ARRAY(packed_waiting) stack; /**< room for the height of the tree */
    ARRAY(packed_visit) visits;
    ARRAY(packed_unsure) unsure;
    ARRAY(uint32_t) candidates;
    ARRAY(uint16_t) bits; /**< of a row of pairs, and boxes of fragments */
    ARRAY(packed_open) open;
    ARRAY(packed_corners) corners; /**< by fragment of a leaf */
    ARRAY(packed_far) far;         /**< room for the height of the tree */
    ARRAY(float) squares;          /**< of distances in a leaf */
    uint32_t *climbs;              /**< stacks of PACKED_FLIGHT vertical rays, of height + 2 nodes each */
    size_t climb_size;
    uint32_t flock_from; /**< windows of batches fly in flocks on trees of so many blocks */
    uint64_t decided;    /**< fragments that kernels left open, for tests and benches */
} packed_work;

/* gcc drops calls of functions that do nothing but prefetch, unless they are inlined. */
#define PACKED_ASK __attribute__((always_inline)) static inline

/** Prefetches the first lines of a small subtree: its nodes lie behind its first one, in depth-first order. */
PACKED_ASK void packed_ask_nodes(const froe_tree *t, uint32_t node) {
    const char *first = (const char *)(t->nodes + node);
    for (int at = 0; at < 256; at += 64) __builtin_prefetch(first + at);
}
/** Prefetches the block of a leaf. */
PACKED_ASK void packed_ask_block(const froe_tree *t, uint32_t block, uint32_t count) {
    const uint8_t *bytes = t->packed.blocks + (size_t)block * PACKED_BLOCK;
    for (uint32_t at = 0; at < 32 + 12 * count; at += 64) __builtin_prefetch(bytes + at);
}
/** Prefetches the entry of a point in the jump table, or what the entry names. */
PACKED_ASK void packed_ask_table(const froe_tree *t, const double *point, bool named) {
    const tree_table *table = t->packed.table;
    if (!table) return;
    const double column = tree_table_place(table, 0, point[0]), row = tree_table_place(table, 1, point[1]);
    if (!(column >= 0 && column < table->cells[0] && row >= 0 && row < table->cells[1])) return;
    if (!named) {
        __builtin_prefetch(table->entries + (size_t)column * table->cells[1] + (size_t)row);
        return;
    }
    const tree_entry entry = tree_table_at(table, (uint32_t)column, (uint32_t)row);
    if (entry.kind & TABLE_LEAF)
        packed_ask_block(t, entry.at, entry.kind & ~TABLE_LEAF);
    else
        packed_ask_nodes(t, entry.at);
}

/** For the context of a packed tree. FROE_E_MEMORY. O(height). */
froe_status packed_work_new(const froe_tree *t, packed_work **out);
void packed_work_free(packed_work *work, const froe_allocator *alloc);

/** Objects that meet a closed box: they are query->found. The caller has begun the query. FROE_E_MEMORY. */
froe_status packed_range(froe_query *query, const double *lo, const double *hi);
/** Those of each of several good boxes (lower corner, then upper), several of them in flight: appended to query->found,
 * one after the other, with their numbers in counts. FROE_E_MEMORY. */
froe_status packed_ranges(froe_query *query, const double *const *boxes, size_t count, size_t *counts);
/** How many there are. FROE_E_MEMORY. */
froe_status packed_count_range(froe_query *query, const double *lo, const double *hi, uint64_t *out);
/** Some of them, at least one if there is any. FROE_E_MEMORY. */
froe_status packed_any(froe_query *query, const double *lo, const double *hi);
/** The first segment above (1) or below (-1) each of `count` points, through it counts: that of lowest id where it
 * meets several at one point; FROE_NONE if there is none. Finite points. FROE_E_MEMORY, also for a leaf that is not
 * good. */
froe_status packed_vertical(froe_query *query, const double *points, size_t count, int direction, uint32_t *objects);
/** Checks a point to look up or down from. */
froe_status query_vertical_check(const froe_query *query, const double *point, int direction, froe_diagnostic *diag);
/** As froe_batch_pairs(). FROE_E_LIMIT, before any pair is reported: more pairs than are worth gathering;
 * FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status packed_pairs(query_workers *workers, bool shared, froe_pair_fn *fn, void *user);
#endif
