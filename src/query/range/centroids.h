/* centroids.h: where in a deep tree does a box lie? In O(log nodes) instead of O(height).
 *
 * The nodes whose open regions hold a box are a path from the root; its end is where the box meets a cut first. Above
 * the first oblique cuts, regions are boxes. There each step of the search halves what is left of the tree,
 *
 *            o                 v, whose subtree has between a third and two thirds of
 *           / \                the nodes left: is the box in the region of v?
 *          o   o                  yes: go on within the subtree of v
 *         / \ / \                 no:  go on in what is left without it
 *        v   ...
 *
 * as the centroids of Schwarz, Smid and Snoeyink (An optimal algorithm for the on-line closest-pair problem,
 * 1994) do for points; de Berg's Theorem 3.1 (Linear size binary space partitions for uncluttered scenes, 2000) rests
 * on it. */
#ifndef FROE_QUERY_RANGE_CENTROIDS_H
#define FROE_QUERY_RANGE_CENTROIDS_H
#include "query/context.h"

/** A step: in or out, each a step again or, with CENTROID_END, a node of the tree. */
typedef struct query_centroid {
    uint32_t node, next[2]; /**< out, in */
} query_centroid;
#define CENTROID_END 0x80000000u

typedef struct query_centroids {
    query_part part;
    int dim;
    uint32_t node_count, count, root;
    query_centroid *steps;
    double *boxes; /**< [node]: lo, hi of its region by the axis-parallel cuts above, infinite where none is */
} query_centroids;

/** Is the tree so deep that a search by centroids is faster than plain descent? O(1). */
bool query_is_deep(const froe_tree *tree);
/** Prepares them. FROE_E_MEMORY. O(nodes log nodes), once for all forks. */
froe_status query_centroids_of(froe_query *query, const query_centroids **out, froe_diagnostic *diag);

static inline const double *query_centroid_box(const query_centroids *c, uint32_t node) {
    return c->boxes + (size_t)node * 2 * (size_t)c->dim;
}
/** The deepest node whose open region holds the closed box; adds to *steps how many steps that took. */
static inline uint32_t query_centroid_find(const query_centroids *c, const double *lo, const double *hi,
                                           uint64_t *steps) {
    uint32_t at = c->root;
    while (!(at & CENTROID_END)) {
        const query_centroid *step = c->steps + at;
        const double *box = query_centroid_box(c, step->node);
        bool in = true;
        for (int k = 0; k < c->dim; k++) in &= lo[k] > box[k] && hi[k] < box[c->dim + k];
        at = step->next[in];
        ++*steps;
    }
    return at & ~CENTROID_END;
}
#endif
