/* near.h: regions of a tree in the order of their distance.
 *
 *     near_walk.c   the lists of a tree, those of the nearest regions first: an iterator
 *     near.c        the k nearest objects in them
 */
#ifndef FROE_QUERY_NEAR_H
#define FROE_QUERY_NEAR_H
#include "base/array.h"
#include "geom/distance.h"
#include <froe/query.h>

typedef struct query_neighbour {
    geom_distance distance;
    uint32_t object;
} query_neighbour;

/** A node that waits. */
typedef struct query_place {
    double bound; /**< of its distance */
    uint32_t node;
} query_place;

/** Distances of nodes are squares of lower bounds, all coordinates times `scale`, a power of 2 that keeps the squares
 * in range. */
typedef struct query_near {
    double point[FROE_MAX_DIM];
    double scale;
    double limit;   /**< what is further away is passed over; may fall while the tree is walked */
    bool packed;    /**< walked by query/space.h */
    bool one;       /**< only the nearest is wanted */
    query_place at; /**< where to go on; node FROE_NONE: at the nearest that waits */
    ARRAY(query_place) places;
    ARRAY(uint32_t) free; /**< places to be used again */
    ARRAY(uint32_t) heap; /**< of places */
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
/** A lower bound of the squared distance from a box, scaled. */
double query_near_box(const query_near *n, int dim, const double *lo, const double *hi);
/** An upper bound of the square of a distance, scaled. */
double query_near_square(const query_near *n, double distance);
#endif
