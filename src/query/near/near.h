/* near.h: the objects nearest to a point, by regions of a tree in the order of their distance.
 *
 *     near_walk.c     the lists of a tree, those of the nearest regions first: an iterator
 *     near_points.c   where all objects are points: candidates, few more than k, by doubles side by side
 *     near_space.c    the one nearest object of a packed tree of space
 *     near_packed.c   segments and points of a packed tree of the plane: candidates, by blocks of 16-bit units
 *     near.c          the k nearest objects in them
 *
 * It speaks for these. */
#ifndef FROE_QUERY_NEAR_NEAR_H
#define FROE_QUERY_NEAR_NEAR_H
#include "geom/meet/distance.h"
#include "support/array.h"
#include "tree/list.h"
#include <froe/query.h>

typedef struct query_neighbour {
    geom_distance distance;
    double square; /**< of a candidate (below); NaN: nothing is known beside the distance */
    uint32_t object;
} query_neighbour;

/** A node to be visited later. */
typedef struct query_place {
    double bound; /**< of its distance */
    uint32_t node;
} query_place;

/** An object that may be among the nearest. */
typedef struct query_candidate {
    double square;    /**< of a lower bound of its distance, scaled; of a point with `at`: of its distance, rounded */
    const double *at; /**< coordinates of a point; NULL: those of the scene count */
    uint32_t object;
} query_candidate;

enum { QUERY_NEAR_FLOCK = 8 }; /* points of a batch whose candidates are found before any is measured */

/** Distances of nodes are squares of lower bounds, all coordinates times `scale`, a power of 2 that keeps the squares
 * in range. */
typedef struct query_near {
    double point[FROE_MAX_DIM], scaled[FROE_MAX_DIM];
    double scale;
    double limit;   /**< what is further away is passed over; may fall while the tree is walked */
    bool packed;    /**< walked by query/packed/space.h */
    query_place at; /**< where to go on; node FROE_NONE: at the nearest that waits */
    ARRAY(query_place) places;
    ARRAY(uint32_t) free; /**< places to be used again */
    ARRAY(uint32_t) heap; /**< of places */
    ARRAY(double) best;   /**< a heap of the k least squares among candidates */
    ARRAY(query_candidate) candidates;
    ARRAY(query_candidate) flock;        /**< those of several points, one after the other */
    size_t flock_ends[QUERY_NEAR_FLOCK]; /**< of the candidates of each point */
    ARRAY(query_neighbour) found;
    ARRAY(uint32_t) order;
    ARRAY(froe_neighbour) out;
} query_near;

struct froe_query;
struct tree_objects;
void query_near_free(query_near *n, const froe_allocator *alloc);

/** Begins with query->near.point. FROE_E_MEMORY. */
froe_status query_near_begin(struct froe_query *query, froe_diagnostic *diag);
/** The next list; with no objects: there is none left within query->near.limit. FROE_E_MEMORY. */
froe_status query_near_next(struct froe_query *query, struct tree_objects *list);
/** Where all objects are points and lists have their coordinates: *done, and query->near.candidates has the k nearest
 * to query->near.point, or all within the bound if there are fewer, and whatever doubles do not tell from them.
 * FROE_E_MEMORY. */
froe_status query_near_points(struct froe_query *query, size_t k, double bound, bool *done, froe_diagnostic *diag);
/** Are candidates found by blocks (near_packed.c)? On packed trees of the plane, but for several of many points, which
 * near_points.c finds more quickly. FROE_E_MEMORY. */
froe_status query_near_by_blocks(struct froe_query *query, size_t k, bool *out, froe_diagnostic *diag);
/** On a packed tree of space, unless single precision cannot hold the point: *done, and query->near.order has the
 * nearest object to query->near.point, if there is one within the bound. FROE_E_MEMORY. */
froe_status query_near_in_space(struct froe_query *query, double bound, bool *done);
/** On a packed tree of the plane: query->near.candidates has the k nearest to query->near.point, or all within the
 * bound if there are fewer, and what 16-bit units do not tell from them; none twice. FROE_E_MEMORY. */
froe_status query_near_packed(struct froe_query *query, size_t k, double bound);
/** The same for each of up to QUERY_NEAR_FLOCK points, into query->near.flock: while the points of these candidates
 * come from memory, the next are found. `left` points are to come, these included. FROE_E_MEMORY. */
froe_status query_near_flock(struct froe_query *query, const double *points, size_t count, size_t left, size_t k,
                             double bound);
/** Measures the candidates of point i of a flock: the k nearest are query->near.out. FROE_E_MEMORY. */
froe_status query_near_settle(struct froe_query *query, const double *point, size_t i, size_t k, double bound);
/** Checks a point and a bound. */
froe_status query_near_check(const struct froe_query *query, const double *point, double bound, froe_diagnostic *diag);
/** Puts a square among the k least, for which there is room, if it belongs there, and lowers the limit to the greatest
 * of k. */
void query_near_keep(query_near *n, double square, size_t k);
/** Drops candidates beyond the limit. */
void query_near_sift(query_near *n);
/** Sorts few candidates by their squares; many are left as they are. */
void query_near_order(query_near *n);
/** A power of 2 that brings the greatest coordinate near 1: then squares neither overflow nor, where it matters,
 * underflow. */
double query_near_scale(const froe_scene *scene, const double *point);
/** What no true square up to that of a candidate comes out above. */
static inline double query_near_reach(double square) {
    return square * (1 + 0x1p-46) + 0x1p-1030;
}
/** A lower bound of the squared distance from a box, scaled. */
double query_near_box(const query_near *n, int dim, const double *lo, const double *hi);
/** An upper bound of the square of a distance, scaled. */
double query_near_square(const query_near *n, double distance);
#endif
