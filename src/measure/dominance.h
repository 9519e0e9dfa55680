/* dominance.h: counts the points below a corner on all axes: a range tree with fractional cascading.
 *
 *     axis 0          node j has the points (j - lowbit j, j] of its list, ascending on the axis: those up to r
 *      |  |  |        fall into the nodes r, r - lowbit r, ... (Fenwick 1994)
 *     axis 1 ...      a node of its own for each of these, and so on
 *      |
 *     last two        one list, ascending on the last axis, split by halves of the axis before it; each entry
 *                     counts those before it that go left, which is where a search goes on in either half
 *
 * Bentley, Multidimensional divide-and-conquer, CACM 1980; Lueker 1978 for the cascading, which saves a logarithm;
 * Chazelle, A functional approach to data structures, SIAM J. Comput. 1988, for counts in place of pointers. */
#ifndef FROE_MEASURE_DOMINANCE_H
#define FROE_MEASURE_DOMINANCE_H
#include "support/array.h"

typedef struct measure_dominance_node {
    size_t keys;    /**< where its ranks on its axis begin, ascending; before the last axis those on that one follow */
    size_t next;    /**< its first child, or where its bits begin */
    uint32_t count; /**< of points */
} measure_dominance_node;

typedef struct measure_dominance_bits {
    uint64_t right;  /**< does the entry go right? */
    uint32_t before; /**< entries of the level before these that do */
} measure_dominance_bits;

typedef struct measure_dominance {
    froe_allocator alloc;
    int dim;
    ARRAY(measure_dominance_node) nodes;
    ARRAY(uint32_t) keys;
    ARRAY(measure_dominance_bits) bits;
} measure_dominance;

/** rank[k][i]: that of point i on axis k, all of 0 .. count - 1 once; dim >= 2. FROE_E_MEMORY; free it all the same.
 * O(count log^(dim - 1) count) time and space. */
froe_status measure_dominance_new(const froe_allocator *alloc, int dim, uint32_t count, uint32_t *const rank[],
                                  measure_dominance *out);
void measure_dominance_free(measure_dominance *d);
/** Points with a rank < below[k] on each axis k. O(log^(dim - 1) count). */
uint32_t measure_dominance_count(const measure_dominance *d, const uint32_t below[]);
#endif
