/* feature.h: the corner, edge or interior nearest to a point, of a triangle of space or a segment of the plane
 * (Ericson: Real-time collision detection, 2005, 5.1.2 and 5.1.5), decided by filters. */
#ifndef FROE_GEOM_MEET_FEATURE_H
#define FROE_GEOM_MEET_FEATURE_H
#include "num/ball.h"
#include <stdbool.h>

typedef struct geom_feature {
    int count;               /**< of corners: 1 a corner, 2 an edge or segment, 3 a triangle */
    const double *corner[3]; /**< the nearest point is in the relative interior of their hull */
    num_ball square;         /**< an image of the squared distance */
} geom_feature;

/** False: doubles cannot tell. Keeps pointers to corners. */
bool geom_feature_nearest(const double *point, const double *const corner[3], geom_feature *out);
bool geom_feature_of_segment(const double *point, const double *const corner[2], geom_feature *out);
/** Is the corner or edge (of `count` corners) that is the nearest of another triangle one of this triangle, too, and
 * its nearest? False: it is not, or doubles cannot tell. */
bool geom_feature_shared(const double *point, const double *const corner[3], const double *const *nearest, int count);
#endif
