/* convex.h: the oracle for distances and meetings of convex sets, in exact rationals (GMP).
 *
 * A set is the hull of points, grown by a radius. Brute force: of all simplices of at most dim + 1 points
 * a - b (a of one set, b of the other) it takes the one whose point p nearest to the origin satisfies what
 * defines the nearest point of a convex set,
 *
 *     p = sum of lambda x,  lambda >= 0, their sum 1,     and     p . x >= p . p  for every point x.
 *
 * A guess in doubles says which simplex to try first; what is tried is proven exactly, or all are tried. */
#ifndef FROE_TESTS_ORACLE_CONVEX_H
#define FROE_TESTS_ORACLE_CONVEX_H
#include <froe/froe.h>
#include <gmp.h>

typedef struct oracle_set {
    int dim; /* 2 or 3 */
    size_t count;
    mpq_t *x;      /* dim rationals a point */
    double *image; /* about the same */
    double radius;
    double lo[3], hi[3]; /* bounds of the points, certain */
} oracle_set;

/** Points as doubles. */
oracle_set oracle_points(int dim, const double *coords, size_t count, double radius);
/** All corners of a box. */
oracle_set oracle_box(int dim, const double *lo, const double *hi);
/** A ray as far as a sphere of radius `reach` around its origin. */
oracle_set oracle_ray(int dim, const double *origin, const double *direction, double reach);
/** A ray as far as beyond all points of a box. */
oracle_set oracle_ray_past(int dim, const double *origin, const double *direction, const double *lo, const double *hi);
/** Where halfspaces normal . x <= offset and a box meet; count 0 when they do not. */
oracle_set oracle_halfspaces(int dim, const double *normals, const double *offsets, size_t count, const double *lo,
                             const double *hi);
/** What the points of a set alone tell: 1, one of them is in all the halfspaces; 0, all are outside of one, and the
 * set has no radius; else -1. */
int oracle_halfspaces_hold(int dim, const double *normals, const double *offsets, size_t count, const oracle_set *set);
/** An object of a scene in the plane or in space. */
oracle_set oracle_object(const froe_scene *scene, uint32_t object);
void oracle_set_free(oracle_set *set);

/** The squared distance of the sets of points, whatever the radii. */
void oracle_distance2(const oracle_set *a, const oracle_set *b, mpq_t out);
/** Do the sets, grown by their radii, have a point in common? */
bool oracle_meet(const oracle_set *a, const oracle_set *b);
/** The same for objects in any dimension: points, boxes and balls against boxes with radii. */
bool oracle_meet_boxes(int dim, const double *lo_a, const double *hi_a, double radius_a, const double *lo_b,
                       const double *hi_b, double radius_b);
#endif
