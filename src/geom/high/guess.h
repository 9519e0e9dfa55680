/* guess.h: how far apart are two sets of corners, in plain doubles: what is found is a guess, or certain.
 *
 * Wolfe's algorithm (nearest.h) in doubles finds a simplex of differences, weights of its corners and a direction.
 * Whatever they are worth, two things follow from them, with an error bound:
 *
 *     what both sets reach along the direction     tells how far they are apart at least
 *     the differences, by their weights            are a point of the hull, which tells how far at most
 *
 * Coordinates are measured from a corner and multiplied by a power of two, so that nothing overflows. */
#ifndef FROE_GEOM_HIGH_GUESS_H
#define FROE_GEOM_HIGH_GUESS_H
#include "geom/high/nearest.h"
#include "num/ball.h"

typedef struct geom_guess {
    geom_simplex simplex;
    double weight[GEOM_SIMPLEX]; /**< >= 0; their sum is about 1 */
    double x[FROE_MAX_DIM];      /**< about the point nearest to 0, in scaled coordinates */
    double origin[FROE_MAX_DIM]; /**< a corner, times scale */
    double scale;                /**< a power of two */
} geom_guess;

/** Lists and boxes, whatever their radii. */
geom_guess geom_guess_between(const geom_convex *a, const geom_convex *b);
/** Bounds on the distance of the two sets without their radii, certain: 0 <= *least <= distance <= *most. */
void geom_guess_bounds(const geom_guess *guess, const geom_convex *a, const geom_convex *b, double *least,
                       double *most);
/** Is 0 certainly inside of the simplex, which has dim + 1 corners? */
bool geom_guess_inside(const geom_guess *guess, const geom_convex *a, const geom_convex *b);
#endif
