/* nearest.h: the point of a hull of differences that is nearest to 0, in any dimension, exactly.
 *
 * Two sets of corners in R^d, A and B, are as far apart as 0 is from the hull of all differences a - b. The point x of
 * it nearest to 0 lies in a simplex of at most d + 1 of them (Gilbert, Johnson and Keerthi: A fast procedure for
 * computing the distance between complex objects, 1988; Wolfe: Finding the nearest point in a polytope, 1976):
 *
 *     take        the difference furthest back along x, if one lies before the plane across x, and add it
 *     reduce      the simplex to the face with the point nearest to 0: faces are tried one corner more or less at a
 *                 time, the last corner that is wrong first, which comes to no face twice (Murty: Note on a
 *                 Bard-type scheme for solving the complementarity problem, 1974)
 *     solve       the normal equations of a face, by num/solve.h
 *
 * Each simplex is strictly nearer than the one before, so the search ends, however degenerate the corners. It begins
 * with a guess in plain doubles (guess.h), which mostly is right and just confirmed. */
#ifndef FROE_GEOM_HIGH_NEAREST_H
#define FROE_GEOM_HIGH_NEAREST_H
#include "geom/convex.h"
#include "num/root.h"

enum { GEOM_SIMPLEX = FROE_MAX_DIM + 1 };

/** Which differences of corners count. Lists and boxes; radii do not matter. */
typedef struct geom_gaps {
    const geom_convex *a, *b;
    bool star;               /**< only those with one of the corners star_a, star_b, not with both, and not 0: the */
    uint32_t star_a, star_b; /*     generators of a cone, where these two are one point */
} geom_gaps;

/** A simplex of differences. */
typedef struct geom_simplex {
    int count;
    uint32_t a[GEOM_SIMPLEX], b[GEOM_SIMPLEX]; /**< corners of each difference */
} geom_simplex;

typedef struct geom_nearest {
    bool zero;                       /**< 0 is in the hull */
    geom_simplex simplex;            /**< affinely independent; its relative interior holds the point */
    num_dyadic scale;                /**< > 0 */
    num_dyadic weight[GEOM_SIMPLEX]; /**< of each difference, > 0: their sum is the scale */
    num_dyadic x[FROE_MAX_DIM];      /**< the point, times the scale; 0 from dim on */
    num_ratio square;                /**< of its distance from 0 */
} geom_nearest;

/** Begins with a simplex, which may be wrong; count 0: with any difference. The numbers lie in the arena behind what it
 * holds, up to half of num_arena_bound. False: there is no difference. */
bool geom_nearest_find(num_context *context, const geom_gaps *gaps, const geom_simplex *guess, geom_nearest *out);
#endif
