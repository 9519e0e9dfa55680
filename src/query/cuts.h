/* cuts.h: the cuts of a tree as queries meet them: an axis and a value, or a plane ready for filters.
 *
 * Queries use planes only to skip what they need not visit. So an answer "on both sides" is always
 * right, and nothing here needs exact numbers; what an object and a query have in common is decided
 * exactly, by the objects themselves. */
#ifndef FROE_QUERY_CUTS_H
#define FROE_QUERY_CUTS_H
#include "geom/filter.h"
#include "query/context.h"

/** n . (x - o) - c, up to n_err for each component of n; one cache line. */
typedef struct query_plane {
    union {
        struct {
            double n[3], o[3];
        };
        const double *far; /**< above dimension 3: n; o is 0 */
    };
    double c, n_err;
} query_plane;

/** Planes of the tabled cuts that are not axis-parallel. In trees that cut along the same object or through the same
 * vertex again and again, such cuts share a plane. */
typedef struct query_planes {
    query_part part;
    uint32_t count, cut_count;
    query_plane *planes; /**< [number], or [cut] */
    uint32_t *numbers;   /**< [cut]; NULL: few cuts would share a plane, and each has its own */
} query_planes;

/** A node's cut: x[axis] = value, or axis -1 and a plane. */
typedef struct query_cut {
    int axis;
    double value;
    const query_plane *plane;
} query_cut;

/** Prepares them. FROE_E_MEMORY. O(cuts), once for all forks; nothing on trees without such cuts. */
froe_status query_planes_of(froe_query *query, const query_planes **out, froe_diagnostic *diag);

/** The cut of an inner node. */
static inline query_cut query_cut_at(const froe_tree *t, const query_planes *planes, const tree_node *node) {
    if (node->type == TREE_PLAIN) return (query_cut){node->axis, node->u.value, NULL};
    const tree_cut *cut = t->cuts + node->u.cut;
    if (cut->kind == FROE_CUT_AXIS) return (query_cut){(int)cut->a, cut->u.value, NULL};
    return (query_cut){-1, 0, planes->planes + (planes->numbers ? planes->numbers[node->u.cut] : node->u.cut)};
}

static inline const double *query_plane_normal(const query_plane *h, int dim) {
    return dim > 3 ? h->far : h->n;
}
/** n . x - c above dimension 3, and a bound of its error: as filter_sum_far (geom/filter.h). */
double query_far_value(const query_plane *h, int dim, const double *x, double c, double *error);

/** n . d for a direction (in the plane d[2] = 0), and a bound of its error. */
static inline double query_plane_slope(const query_plane *h, int dim, const double *d, double *error) {
    if (dim > 3) return query_far_value(h, dim, d, 0, error);
    double p0 = h->n[0] * d[0], p1 = h->n[1] * d[1], p2 = h->n[2] * d[2];
    double size = fabs(p0) + fabs(p1) + fabs(p2), spread = fabs(d[0]) + fabs(d[1]) + fabs(d[2]);
    *error = (8 * FILTER_U * size + h->n_err * spread + NUM_BALL_TINY) * FILTER_UP;
    return p0 + p1 + p2;
}
/** The value at a point (x[2] = 0 in the plane), and a bound of its error: as filter_sum (geom/filter.h).
 * Infinite or NaN when nothing is certain: compare so that this means "both sides". */
static inline double query_plane_value(const query_plane *h, int dim, const double *x, double *error) {
    if (dim > 3) return query_far_value(h, dim, x, h->c, error);
    const double w[3] = {x[0] - h->o[0], x[1] - h->o[1], x[2] - h->o[2]};
    double sum = query_plane_slope(h, 3, w, error) - h->c;
    *error += 8 * FILTER_U * fabs(h->c);
    return sum;
}
#endif
