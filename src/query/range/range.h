/* range.h: what meets a window, or any other range?
 *
 *     froe_range --range_take.c--> query_range        checked; bounds, facets, the set itself
 *                --range_walk.c--> lists of nodes     whose closed regions the range may meet
 *                --range_meet.c--> objects            that it does meet, exactly
 *
 * It speaks for these and range.c, the public calls, which send windows on packed trees to packed_window.c or
 * space_window.c. */
#ifndef FROE_QUERY_RANGE_RANGE_H
#define FROE_QUERY_RANGE_RANGE_H
#include "geom/high/halfspaces.h"
#include "geom/polytope.h"
#include "geom/range.h"
#include <froe/query.h>

typedef struct query_range {
    froe_range_shape shape;
    froe_walk walk;
    geom_range range;
    double margin;          /**< what lies within it of the range may be reported: eps x diameter, rounded down */
    bool any;               /**< is one object enough? */
    const froe_range *from; /**< the caller's; during a query */
    geom_polytope polytope; /**< of halfspaces, once it is needed */
    bool polytope_made;
    ARRAY(uint32_t) nodes; /**< waiting, with ... */
    ARRAY(double) boxes;   /**< ... the bounds of their regions and of the range within, or an interval of parameters */
} query_range;

/** Those of a range of halfspaces. */
static inline geom_halfspaces query_halfspaces(const query_range *r) {
    return (geom_halfspaces){r->range.dim, r->from->count, r->from->points, r->from->offsets};
}
struct froe_query;
void query_range_free(query_range *range, const froe_allocator *alloc);
/** Checks a range and prepares query->range for it. */
froe_status query_range_take(struct froe_query *query, const froe_range *range, froe_diagnostic *diag);
/** Prepares query->range, for query_range_meets() only, for a box that has been checked and is taken exactly. */
void query_range_of_box(struct froe_query *query, const froe_range *box);
/** The dimension, if it is a box on a packed tree, answered by query/packed/; otherwise 0. It need not be checked. */
int query_range_window(const struct froe_query *query, const froe_range *range);
/** Only checks it. */
froe_status query_range_check(const froe_range *range, int dim, froe_diagnostic *diag);
/** Checks, prepares, walks: what meets the range is in query->found; at least one object of it with `any`. */
froe_status query_range_ask(struct froe_query *query, const froe_range *range, bool any, froe_diagnostic *diag);
/** The objects that contain a point, in query->found. */
froe_status query_locate(struct froe_query *query, const double *point, froe_diagnostic *diag);
struct query_leaf;
/** ... whose leaf is known; not of packed trees. */
froe_status query_locate_in(struct froe_query *query, const double *point, const struct query_leaf *leaf,
                            froe_diagnostic *diag);
/** Reports the objects that meet query->range. FROE_E_MEMORY. */
froe_status query_range_walk(struct froe_query *query);
/** Does the object meet query->range? *memory: was there none to find out? */
bool query_range_meets(struct froe_query *query, uint32_t object, bool *memory);
/** Does it meet a closed box, whose bounds may be infinite? */
bool query_object_meets_box(struct froe_query *query, uint32_t object, const double *lo, const double *hi);
#endif
