/* apart.h: a plane with doubles for coefficients between two bodies that have no point in common.
 *
 *       A      |   . b            a and b are the points of A and B that are nearest to each other: the plane across
 *        . a --+--'     B         a b, halfway, has A on one side and B on the other
 *              |
 *
 * The direction from a to b is known exactly up to a positive factor (gap.h). Its coordinates and the offset are
 * rounded to doubles, and the rounded plane is checked exactly. Where the gap is about as wide as what rounding moves,
 * the direction is rounded at many lengths, each of which is another direction. */
#ifndef FROE_GEOM_MEET_APART_H
#define FROE_GEOM_MEET_APART_H
#include "geom/body.h"

/** Finds  normal . x = value  with all of `a` where it is <= 0 and all of `b` where it is >= 0, neither wholly in it.
 * 2D and 3D; bodies of any kinds. False: they have a point in common, or no such plane was found, which never happens
 * to bodies further apart than 2^-45 of the largest coordinate. The coefficients are scaled so that nothing over- or
 * underflows. Expected O(count) of the corners. Arena: num_arena_bound. */
bool geom_apart(num_context *context, const geom_body *a, const geom_body *b, double normal[3], double *value);
#endif
