/* foot.h: the point of a body that is nearest to a point, rounded once, for output.
 *
 *     point, box                on each axis the end that is nearer, if x is outside
 *     ball                      c + r (x - c) / |x - c|
 *     corner, edge, triangle    p,  p + e (e v) / e^2,  x - n (n v) / n^2      v = x - p
 *     above dimension 3         x + the shortest difference: geom/high/nearest.h
 *
 * The simplex of corners is that of the distance (distance.h), whose relative interior holds the point. */
#ifndef FROE_GEOM_MEET_FOOT_H
#define FROE_GEOM_MEET_FOOT_H
#include "geom/body.h"

/** dim coordinates, each the double nearest to the exact one; x itself if the body contains it. */
void geom_foot(num_context *context, const double *x, const geom_body *body, double *out);
#endif
