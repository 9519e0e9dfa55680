/* jump.h: from a node of the tree down past all cuts that a piece of a range does not meet.
 *
 *     plain    cut after cut
 *     box      where do the bounds of the piece lie? One search by centroids (centroids.h), after CUTS_BEFORE_JUMP
 *              cuts passed in a row, which cost about as much as the search
 *     lca      de Berg (Linear size binary space partitions for uncluttered scenes, 2000), section 3.3: along each
 *              axis both extreme points of the piece are located by centroids; of the lowest common ancestors of each
 *              two, the highest has the first cut that the piece meets (Claim 3.3). Done at every node that is no leaf
 *     auto     box in deep trees, plain in others
 *
 * Box and lca find the same node. An open region that holds points at both ends of the piece's bounds along each axis
 * is a box, so it holds the bounds; and that which holds the bounds holds the points. So it does not matter where on
 * the sides of the bounds the extreme points are taken: their centres will do. */
#ifndef FROE_QUERY_RANGE_JUMP_H
#define FROE_QUERY_RANGE_JUMP_H
#include "query/range/ancestors.h"
#include "query/range/centroids.h"

typedef struct query_jump {
    const query_centroids *centroids; /**< NULL: cut after cut */
    const query_ancestors *ancestors; /**< NULL: no lca */
    froe_query_stats *stats;
} query_jump;

/** Prepares what a walk takes. FROE_E_MEMORY. O(nodes log nodes), once for all forks. */
froe_status query_jump_prepare(froe_query *query, froe_walk walk, query_jump *out);
/** Is a jump due after so many cuts passed in a row? */
static inline bool query_jump_is_due(const query_jump *jump, int passed) {
    enum { CUTS_BEFORE_JUMP = 16 };
    return jump->centroids && (jump->ancestors || passed == CUTS_BEFORE_JUMP);
}
/** The deepest node below this one whose region holds what of a box is in this one's: it, or one further down. The box
 * must reach into the region, and is cut down to it. */
uint32_t query_jump_below(const query_jump *jump, uint32_t node, double *lo, double *hi);
#endif
