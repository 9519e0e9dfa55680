/* high.h: the oracle for polytopes of any dimension, in exact rationals (GMP).
 *
 * Whether hulls meet, how, and where a ray meets one, are linear programs, solved in a dense table by Bland's rule.
 * Distances are found by Wolfe's algorithm, step by step, in all differences of corners. No formula and no arithmetic
 * is shared with the code under test. */
#ifndef FROE_TESTS_ORACLE_HIGH_H
#define FROE_TESTS_ORACLE_HIGH_H
#include "geom/body.h"
#include <gmp.h>

enum { HIGH_CORNERS = 256 };

/** Corners of a polytope; boxes have all of theirs. Balls are their centre. */
typedef struct high_set {
    int dim;
    size_t count;
    double radius;
    double x[HIGH_CORNERS][FROE_MAX_DIM];
} high_set;

high_set high_of(const geom_body *body);
high_set high_box(int dim, const double *lo, const double *hi);
high_set high_point(int dim, const double *x);
/** An object of a scene. */
high_set high_object(const froe_scene *scene, uint32_t object);

/** Do the hulls have a point in common, whatever the radii? */
bool high_hulls_meet(const high_set *a, const high_set *b);
/** The squared distance of the hulls. */
void high_distance2(const high_set *a, const high_set *b, mpq_t out);
/** Do the radii reach over the squared distance of the hulls? */
bool high_reach(const high_set *a, const high_set *b, mpq_t square);
/** Do the sets, grown by their radii, meet? */
bool high_meet(const high_set *a, const high_set *b);
/** Of hulls. 0 apart, 1 cross, 2 touch, 3 overlap; *corner: they have one corner in common and nothing else. */
int high_contact(const high_set *a, const high_set *b, bool *corner);
/** Where the ray meets the hull first; false: nowhere. */
bool high_ray(const double *origin, const double *direction, const high_set *a, mpq_t t);
/** Has the hull a point in the open box? Bounds may be infinite. */
bool high_meets_inside(const high_set *a, const double *lo, const double *hi);
/** The dimension of the hull. */
int high_rank(const high_set *a);
/** Is x the double nearest to the square root of the number, ties to even? */
bool high_is_root(double x, mpq_t square);
#endif
