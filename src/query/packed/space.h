/* space.h: searches of packed trees of space (tree/packed/space.h), by their wide nodes (tree/packed/wide.h).
 *
 *     stack     [ ... | key, what | key, what ]     wide nodes, leaves and objects, the least key on top
 *
 * A walk takes the entry on top. It replaces a node by those of its children that may be met, and a leaf by those of
 * its objects. An object is handed out, and the caller decides it exactly. Keys are lower bounds, of a ray's parameter
 * or of squared distances. So objects come nearly in order, few of them are not the answer, and none that may be the
 * answer is missed. What a kernel is sure a ray meets need not be decided: it lowers the limit, and waits among the
 * hits of the walk, of which one is left in the end as a rule.
 *
 * It speaks for space_walk.c, space_rays.c and space_window.c. */
#ifndef FROE_QUERY_PACKED_SPACE_H
#define FROE_QUERY_PACKED_SPACE_H
#include "query/context.h"
#include "query/packed/space_kernel.h"
#include "tree/list.h"

/** What a walk is for: all objects; the first, or the nearest; any. */
typedef enum space_wanted { SPACE_ALL, SPACE_FIRST, SPACE_ANY } space_wanted;

/** An object that is certainly met, or this near, and between which keys. */
typedef struct space_hit {
    uint32_t object;
    float key, end;
} space_hit;

/** A walk along a ray, or around a point. */
typedef struct space_walk {
    bool near; /**< by distance, not along a ray */
    space_wanted wanted;
    space_ray ray;
    space_point point;
    double per;      /**< units of the ray's parameter, of squared distances, per 1 */
    double told;     /**< the limit as it was last seen, and ... */
    float limit;     /**< ... what it means for keys */
    float within;    /**< a key up to this is certainly within the first limit */
    uint32_t object; /**< the one handed out */
    ARRAY(uint64_t) stack;
    ARRAY(space_hit) hits; /**< SPACE_FIRST: what may be it, and lowered the limit */
} space_walk;

typedef struct space_ray_state space_ray_state; /* space_rays.c */

/** A node, linked to the window that may meet it; or a leaf, linked to the next one. */
typedef struct space_visit {
    uint32_t what, link;
} space_visit;

/** What a context has for packed trees of space. */
typedef struct space_work {
    const space_kernels *kernels;
    space_walk walk;
    space_ray_state *batch;  /**< NULL until a batch of rays comes */
    uint64_t turns_from[2];  /**< rays of batches take turns on trees of so many bytes: for any hit, the first */
    ARRAY(uint32_t) objects; /**< from kernels */
    ARRAY(space_visit) nodes, leaves; /**< of windows */
    ARRAY(float) keys, ends;
} space_work;

froe_status space_work_new(const froe_tree *t, space_work **out);
void space_work_free(space_work *work, const froe_allocator *alloc);

/** Begins along a ray, up to t_max, or around query->near.point. *begun false: single precision cannot hold these
 * numbers, and the general walk has to be used. FROE_E_MEMORY. */
froe_status space_walk_ray(froe_query *query, space_walk *walk, const geom_ray *ray, double t_max, space_wanted wanted,
                           bool *begun);
froe_status space_walk_near(froe_query *query, space_walk *walk, space_wanted wanted, bool *begun);
/** The next object, as a list, unless it is beyond the limit, which may have fallen; none: there is none left.
 * FROE_E_MEMORY. */
froe_status space_walk_next(froe_query *query, space_walk *walk, double limit, tree_objects *list);

/** SPACE_OBJECT: walk->object is handed out, and has to be decided. SPACE_MET, of SPACE_ANY: it is met. */
typedef enum space_step { SPACE_ON, SPACE_OBJECT, SPACE_MET, SPACE_END, SPACE_NO_MEMORY } space_step;
/** Steps up to an object or the end; or, of a walk that is one of many, one step, after which what the next one reads
 * is prefetched, so that other walks can go on until that is in the cache. */
space_step space_walk_step(froe_query *query, space_walk *walk, double limit, bool alone);
/** Is a key within the limit, which may have fallen? */
bool space_walk_reaches(space_walk *walk, double limit, float key);
/** Drops hits that are certainly not the first one: how many are left? */
size_t space_walk_settle(space_walk *walk, double limit);

/** The first hits of rays that have been checked, or, hits NULL, any object met by each. As froe_query_ray() and
 * froe_query_ray_any(), for query->tree->packed.wide. FROE_E_MEMORY. */
froe_status space_rays(froe_query *query, const double *origins, const double *directions, size_t count, double t_max,
                       froe_hit *hits, uint32_t *objects, froe_diagnostic *diag);
/** Any object that a ray meets: as space_rays() for one ray, with less around it. FROE_E_MEMORY. */
froe_status space_ray_any(froe_query *query, const double *origin, const double *direction, double t_max,
                          uint32_t *object, froe_diagnostic *diag);
void space_batch_free(space_ray_state *batch, const froe_allocator *alloc);

/** Objects that meet each of several good boxes (lower corner, then upper), or, with `any`, of a single box some of
 * them if there are any: appended to query->found, one after the other, with their numbers in counts. Begins each
 * query. FROE_E_MEMORY. */
froe_status space_ranges(froe_query *query, const double *const *boxes, size_t count, bool any, size_t *counts);
#endif
