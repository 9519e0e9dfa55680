/* distance.h: how far a point is from a body: compared exactly, rounded once, for output.
 *
 * The distance is   sqrt(S) - r,   or 0 where that is negative: S the squared distance from the body or, for
 * balls, its centre, a quotient of ring expressions; r the radius, else 0. Kept is where S comes from, and a
 * certified image of S that decides most comparisons.
 *
 *     point, box, ball's centre   S = sum over the axes of (what is outside lo .. hi)^2      degree 2
 *     corner, edge, triangle      S = |v|^2,  |v x e|^2 / |e|^2,  (n v)^2 / n^2    degrees 2, 4 / 2, 6 / 4
 *
 * of a segment, polygon or hull, v from the point to a corner: see gap.h; above dimension 3 geom/high/nearest.h. Images
 * may be infinite. */
#ifndef FROE_GEOM_MEET_DISTANCE_H
#define FROE_GEOM_MEET_DISTANCE_H
#include "geom/body.h"
#include "num/ball.h"

typedef struct geom_distance {
    const double *lo, *hi;   /**< boxes, points and centres; NULL: the simplex counts */
    const double *corner[3]; /**< a simplex of corners; in the plane at most 2 of them matter */
    int dim, count;          /**< corners of the simplex; 0: the point is inside, the distance 0 */
    double radius;
    num_ball square; /**< S */
    geom_body high;  /**< a segment or hull above dimension 3, of which the image alone is known; else count 0 */
} geom_distance;

/** Of a point from a body. Keeps pointers to the body's points. */
geom_distance geom_distance_from(num_context *context, const double *point, const geom_body *body);
/** Is the distance of the body certainly d, as the corner or edge that d comes from is the nearest of it, too? False:
 * it is not, or filters cannot tell. Both bodies have their points in one array. */
bool geom_distance_shared(num_context *context, const double *point, const geom_body *body, const geom_distance *d);
/** Sign of a - b, for the same point. */
int geom_distance_compare(num_context *context, const double *point, const geom_distance *a, const geom_distance *b);
/** Sign of a - bound, bound >= 0 or infinite. */
int geom_distance_compare_to(num_context *context, const double *point, const geom_distance *a, double bound);
/** The nearest double. */
double geom_distance_round(num_context *context, const double *point, const geom_distance *a);

/** An image of the distance itself. */
num_ball geom_distance_image(const geom_distance *a);
#endif
