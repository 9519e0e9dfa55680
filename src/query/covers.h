/* covers.h: the nodes above a node that list covers.
 *
 *     root  o----- covers              What meets the cell of a leaf is in the leaf's list, and in the covers of the
 *          / \                         nodes on the way to it. A search that jumps to a node deep in the tree climbs
 *         o   o--- covers  <--.        from there by these links, each of which leads to one answer at least.
 *            / \              | above
 *           o   x ------------'
 */
#ifndef FROE_QUERY_COVERS_H
#define FROE_QUERY_COVERS_H
#include "query/context.h"

typedef struct query_covers {
    query_part part;
    uint32_t node_count;
    uint32_t *above; /**< [node]: the lowest proper ancestor with covers, or FROE_NONE */
} query_covers;

/** Prepares them, of a tree that has covers. FROE_E_MEMORY. O(nodes), once for all forks. */
froe_status query_covers_of(froe_query *query, const query_covers **out, froe_diagnostic *diag);

static inline uint32_t query_covers_above(const query_covers *c, uint32_t node) {
    return c->above[node];
}
#endif
