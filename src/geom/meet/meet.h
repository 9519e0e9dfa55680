/* meet.h: do two closed convex sets have a point in common? Exactly.
 *
 * One way for all pairs: the sets meet when their cores are no further apart than the sum of their
 * radii. Gilbert, Johnson and Keerthi (A fast procedure for computing the distance between complex
 * objects in three-dimensional space, 1988) walk to the point nearest to the origin of
 *
 *     { a - b },  a a corner of A's core, b one of B's:
 *
 *         o----o        keep the simplex of corners whose nearest point p is the best so far;
 *        /  p,  \       look for the corner furthest back towards the origin;
 *       o  /    /       there is none:            the distance is |p|
 *        \/    o        all lie beyond the radii: the sets are apart
 *     0  o----'         else add it, and go on with the face nearest to the origin
 *
 * Every step is decided by signs of polynomials in the coordinates, by running-error doubles or, where those
 * are not sure, by dyadic numbers, in which each step comes strictly nearer: so it ends, with the exact answer. */
#ifndef FROE_GEOM_MEET_MEET_H
#define FROE_GEOM_MEET_MEET_H
#include "geom/convex.h"

/** Do a and b meet? Of the same dimension; above dimension 3 (geom/high/) lists and boxes. Arena: num_arena_bound. */
bool geom_meet(num_context *context, const geom_convex *a, const geom_convex *b);
/** Do they for certain? By doubles alone: false when these are not sure. */
bool geom_meet_surely(num_context *context, const geom_convex *a, const geom_convex *b);

/** The same for boxes grown by a radius, in any dimension: points, boxes, balls. A bound of b may be infinite. */
bool geom_meet_boxes(num_context *context, int dim, const double *lo_a, const double *hi_a, double radius_a,
                     const double *lo_b, const double *hi_b, double radius_b);
/** Sign of (radius_a + radius_b)^2 minus the sum of the squares of the gaps to[i] - from[i]. */
int geom_reach_over_gaps(num_context *context, int gaps, const double *from, const double *to, double radius_a,
                         double radius_b);
#endif
