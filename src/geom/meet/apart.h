/* apart.h: a plane between two bodies that have no point in common.
 *
 *       A      |   . b            a and b are the points of A and B, without their radii, that are nearest to each
 *        . a --+--'     B         other: the plane across a b has A on one side and B on the other
 *              |
 *
 * A guess in doubles is checked exactly, and mostly right. Otherwise the nearest points are found exactly
 * (geom/high/nearest.h): w = b - a is a vector N of dyadic numbers over a dyadic number D. The plane
 *
 *     2 N . x  =  N . (a' + b') + (r_a^2 - r_b^2) D        a', b' corners furthest along N in A, and back along it in B
 *
 * is between them, by r_a + r_b < |w|. (Of two balls it is the radical plane, from whose points tangents to both are
 * equally long: no square root tells where it is.) Its coefficients are cut off after one double each, or as many more
 * as the gap is narrow (GEOM_FINE), until the exact check finds it between them. */
#ifndef FROE_GEOM_MEET_APART_H
#define FROE_GEOM_MEET_APART_H
#include "geom/body.h"
#include "geom/plane.h"

enum { GEOM_APART_NUMBERS = GEOM_FINE_ROWS * (FROE_MAX_DIM + 1) };

/** Finds a plane with all of `a` where it is <= 0 and all of `b` where it is >= 0, neither wholly in it: writes its
 * rows, dim + 1 doubles each, and returns their number; 1: a vector and a value. Bodies of any kinds, of the same
 * dimension. 0: they have a point in common, or are nearer than 2^-3000 of their greatest coordinate. Coefficients are
 * scaled so that nothing over- or underflows. Expected O(count) of the corners. Arena: num_arena_bound. */
int geom_apart(num_context *context, const geom_body *a, const geom_body *b, double rows[GEOM_APART_NUMBERS]);
#endif
