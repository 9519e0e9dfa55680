/* ray.h: what does a ray meet?
 *
 *     ray_walk.c    the lists along a ray, nearest first: an iterator
 *     ray.c         the objects in them that it meets: the first one, any, or all in order
 *     vertical.c    the segment above or below a point
 *
 * It speaks for these. Where a ray meets one segment, triangle, box or ball is decided in geom/ray/ray.c. */
#ifndef FROE_QUERY_RAY_RAY_H
#define FROE_QUERY_RAY_RAY_H
#include "geom/ray/ray.h"
#include "support/array.h"
#include "tree/list.h"
#include <froe/query.h>

/** A node, or the list of a cut, that waits; the ray is in its closed region for some t in enter .. leave at most. */
typedef struct query_step {
    uint32_t node;
    bool list;
    double enter, leave;
} query_step;

typedef struct query_met {
    geom_hit hit;
    uint32_t object;
} query_met;

typedef struct query_ray {
    geom_ray ray;
    double limit; /**< what the ray reaches only after this is passed over; may fall while it is walked */
    bool packed;  /**< walked by query/packed/space.h */
    ARRAY(query_step) steps;
    ARRAY(query_met) met;
    ARRAY(uint32_t) order;
    ARRAY(froe_hit) hits;
} query_ray;

struct froe_query;
struct tree_objects;
void query_ray_free(query_ray *r, const froe_allocator *alloc);
/** Is the origin finite, the direction too and not 0, and t_max >= 0? */
froe_status query_ray_check(int dim, const double *origin, const double *direction, double t_max,
                            froe_diagnostic *diag);
/** Prepares query->ray for a ray that has been checked. */
void query_ray_set(struct froe_query *query, const double *origin, const double *direction, double t_max);
/** The same for one that has not been. */
froe_status query_ray_take(struct froe_query *query, const double *origin, const double *direction, double t_max,
                           froe_diagnostic *diag);
/** The object of certain kinds (bits, as added) that the ray taken meets first: query->ray.met has it, or nothing. */
froe_status query_ray_first(struct froe_query *query, double t_max, uint32_t kinds, froe_diagnostic *diag);
/** The first object that a ray meets, or, hit NULL, any: by the walk that goes through trees of all kinds. The ray has
 * been checked. */
froe_status query_ray_walked(struct froe_query *query, const double *origin, const double *direction, double t_max,
                             froe_hit *hit, uint32_t *object, froe_diagnostic *diag);
/** Does a ray meet an object up to t_max? */
bool query_ray_meets(struct froe_query *query, const geom_ray *ray, uint32_t object, double t_max, query_met *out);
/** Does it meet one before another? Where it meets both at once, that of lower id. */
bool query_ray_nearer(struct froe_query *query, const geom_ray *ray, const query_met *met, const query_met *best);
/** An upper bound of a parameter. */
double query_ray_latest(const geom_hit *hit);

/** Begins to walk along query->ray.ray from t = 0 on. Components of the direction may be rounded: it may differ by half
 * a unit in the last place. FROE_E_MEMORY. */
froe_status query_walk_begin(struct froe_query *query, froe_diagnostic *diag);
/** The next list that may hold an object which the ray meets no later than query->ray.limit. FROE_OK with a list of no
 * objects: there is none left. FROE_E_MEMORY. */
froe_status query_walk_next(struct froe_query *query, struct tree_objects *list);
#endif
