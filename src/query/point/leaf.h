/* leaf.h: the leaf that a point lies in.
 *
 *     jump table of a packed tree --.
 *     centroids of a deep tree ------+--> node --> cut after cut --> leaf
 *     the root in space ------------'
 *     any other in the plane            query/point/descent.h
 *
 * A point on a cut goes either way: it lies in the closed cell of the leaf all the same.
 *
 * It speaks for leaf.c and locate.c (the objects that contain a point). */
#ifndef FROE_QUERY_POINT_LEAF_H
#define FROE_QUERY_POINT_LEAF_H
#include "query/context.h"

typedef struct query_leaf {
    uint32_t place; /**< its node; of a packed tree its block */
    bool on_cut;    /**< is the point on the border of its cell? */
    bool empty;     /**< nothing is listed, as far as is known without looking */
} query_leaf;

/** The place of a node that is a leaf. */
static inline uint32_t query_leaf_place(const froe_tree *t, uint32_t node) {
    return tree_is_packed(t) ? t->nodes[node].child : node;
}
/** Finds it, exactly. dim finite doubles. FROE_E_MEMORY. O(log n) for axis-parallel cuts, O(height) below oblique ones
 * and for points on cuts. */
froe_status query_leaf_find(froe_query *query, const double *point, query_leaf *out);
/** The same for many points; in the plane their cache misses overlap. */
froe_status query_leaf_find_all(froe_query *query, const double *points, size_t count, query_leaf *leaves);

/** Is a point within the bounds of all objects? */
static inline bool query_in_scene(const froe_scene *s, const double *x) {
    bool in = s->object_count;
    for (int k = 0; k < s->dim && in; k++) in = x[k] >= s->lo[k] && x[k] <= s->hi[k];
    return in;
}
#endif
