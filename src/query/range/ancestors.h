/* ancestors.h: the lowest common ancestor of two nodes, in constant time.
 *
 *     nodes        numbered in preorder 1 .. n, so that a subtree is an interval of numbers
 *     paths        a node's path is the number of its interval with the most zeros at the end; nodes of one
 *                  path hang below each other
 *     binary tree  of these numbers as bits: 100 above 010 and 110 above 001, 011, ...; a path lies below
 *                  another in the tree only if its number does in this one
 *
 * Schieber and Vishkin (On finding lowest common ancestors: simplification and parallelization, 1988), a simpler form
 * of the structure of Harel and Tarjan (Fast algorithms for finding nearest common ancestors, 1984). De Berg's range
 * queries rest on the latter (jump.h). */
#ifndef FROE_QUERY_RANGE_ANCESTORS_H
#define FROE_QUERY_RANGE_ANCESTORS_H
#include "query/context.h"

typedef struct query_ancestor {
    uint32_t order;     /**< in preorder, from 1: an ancestor comes before what is below it */
    uint32_t path;      /**< number of its path */
    uint32_t ascending; /**< the lowest bits of the numbers of its path and of those above */
} query_ancestor;

typedef struct query_ancestors {
    query_part part;
    uint32_t node_count;
    query_ancestor *of; /**< [node] */
    uint32_t *above;    /**< [path]: the node that its highest node is a child of */
} query_ancestors;

/** Prepares them. FROE_E_MEMORY. O(nodes), 16 bytes each, once for all forks. */
froe_status query_ancestors_of(froe_query *query, const query_ancestors **out, froe_diagnostic *diag);
/** The lowest node with both below it, itself counted. O(1). */
uint32_t query_ancestors_lowest(const query_ancestors *ancestors, uint32_t a, uint32_t b);
#endif
