/* contents.h: what lies below every node, in a box each.
 *
 *     +-----+---------------+     The box of a leaf has what is in its cell: the bounds of its objects, cut down to the
 *     | +---+-------+       |     region that the axis-parallel cuts above leave; that of an inner node has its
 *     | | __|__---- |       |     children's, and the objects in its cut. The point of an object nearest to a query
 *     | |'  |       |       |     lies in some box whose node lists the object.
 *     | +---+-------+       |
 *     +-----+---------------+
 *
 * So boxes bound distances from below whatever the cuts are like, oblique ones too, as in a hierarchy of bounding
 * volumes (Rubin and Whitted: A 3-dimensional representation for fast rendering of complex scenes, 1980). */
#ifndef FROE_QUERY_NEAR_CONTENTS_H
#define FROE_QUERY_NEAR_CONTENTS_H
#include "query/context.h"

typedef struct query_contents {
    query_part part;
    size_t dim, node_count;
    double *boxes; /**< [node]: lo, hi; lo > hi where there is nothing */
} query_contents;

/** Prepares them. FROE_E_MEMORY. O(nodes + list entries), once for all forks. */
froe_status query_contents_of(froe_query *query, const query_contents **out, froe_diagnostic *diag);

static inline const double *query_contents_box(const query_contents *c, uint32_t node) {
    return c->boxes + node * 2 * c->dim;
}
#endif
