/* max_tree.h: a range-maximum tree: numbers at 0 .. size - 1, raised over ranges; finds the first or last >= a bound.
 *
 *             max                    each node: what was added to its whole range, and the maximum of what
 *            /    \                  its children have on top of that. Sums commute with maxima, so a raise
 *         max      max               touches O(log size) nodes, and a search skips every node that is too low.
 *        /   \    /   \
 *       x0   x1  x2   x3
 */
#ifndef FROE_BASE_MAX_TREE_H
#define FROE_BASE_MAX_TREE_H
#include "support/alloc.h"

typedef struct base_max_tree_node {
    int64_t add; /**< to all below, itself included */
    int64_t max; /**< of all below, with add, without the adds above */
} base_max_tree_node;

typedef struct base_max_tree {
    uint32_t size;            /**< a power of two */
    base_max_tree_node *node; /**< [1] is the root, [2 i] and [2 i + 1] the children of [i] */
} base_max_tree;
#define BASE_MAX_TREE_NONE UINT32_MAX

/** All numbers 0. FROE_E_MEMORY. */
froe_status base_max_tree_new(const froe_allocator *alloc, uint32_t size, base_max_tree *out);
void base_max_tree_free(const froe_allocator *alloc, base_max_tree *s);
/** Adds `by` to the numbers at from .. end - 1; nothing when end <= from. O(log size). */
void base_max_tree_raise(base_max_tree *s, uint32_t from, uint32_t end, int64_t by);
/** The first position in from .. end - 1 whose number is at least `level`, or BASE_MAX_TREE_NONE.
 * O(log^2 size), as the last one and the greatest number. */
uint32_t base_max_tree_first(const base_max_tree *s, uint32_t from, uint32_t end, int64_t level);
/** The last one. */
uint32_t base_max_tree_last(const base_max_tree *s, uint32_t from, uint32_t end, int64_t level);
/** The greatest number in from .. end - 1, from < end. */
int64_t base_max_tree_max(const base_max_tree *s, uint32_t from, uint32_t end);
#endif
