/* predicates.h: on which side of a hyperplane is a point that is given by where it comes from?
 *
 * Three kinds of points occur in a BSP, and no point is ever rounded to decide anything:
 *
 *   vertex    an input vertex x                             degree 2 (2D), 3 (3D)
 *   crossing  segment uv  x  plane a                        degree 4 (2D), 6 (3D)
 *   corner    support plane s  x  plane a  x  plane b       degree 9 (3D)
 *
 * Each answer is -1, 0 or 1, exact for all finite doubles, from the first stage
 * that is sure: semi-static filter, running-error doubles (num/ball.h), dyadic
 * numbers (num/dyadic.h). Laws the tests check: scaling by 2^k, translation by
 * lattice vectors that are exact, and permuting the defining points change at most
 * the sign, as the determinant says; all stages agree wherever two are sure. */
#ifndef FROE_GEOM_PREDICATES_H
#define FROE_GEOM_PREDICATES_H
#include "geom/filter.h"
#include "geom/plane.h"

/** Side of the point x (plane->dim doubles). */
int geom_side_vertex(num_context *context, const geom_plane *plane, const double *x);
/** Side of the point where line uv meets `a`. REQUIRES: u and v not on the same
 * side of, and not both on, `a`. */
int geom_side_crossing(num_context *context, const geom_plane *plane, const double *u, const double *v,
                       const geom_plane *a);
/** Side of the point s x a x b, 3D. REQUIRES: the three normals are independent. */
int geom_side_corner(num_context *context, const geom_plane *plane, const geom_plane *s, const geom_plane *a,
                     const geom_plane *b);
/** Side of the closed ball: -1 or 1 when its interior lies there (touching
 * included), 0 when its centre is on the plane and radius is 0, 2 when the plane cuts
 * its interior. Any dimension for AXIS planes, otherwise 2 or 3. */
int geom_side_ball(num_context *context, const geom_plane *plane, const double *centre, double radius);

/** The coordinates of such points, rounded to the nearest double. Output only. */
void geom_round_crossing(num_context *context, const double *u, const double *v, const geom_plane *a, double *out);
void geom_round_corner(num_context *context, const geom_plane *s, const geom_plane *a, const geom_plane *b,
                       double *out);
/** Fast images with a certified error: |out[k] - true| <= the result for every k;
 * infinity when nothing is certain (then out may be anything). For filters and scores. An
 * image of a crossing always lies in the bounding box of u and v. */
double geom_image_crossing(const double *u, const double *v, const geom_plane *a, double *out);
double geom_image_corner(const geom_plane *s, const geom_plane *a, const geom_plane *b, double *out);
/** -1 or 1 when the image (x, error) is certainly on that side, NUM_UNSURE otherwise.
 * Input vertices have error 0. ~5 ns, so callers try it first. */
static inline int geom_side_image(const geom_plane *plane, const double *x, double error) {
    num_ball f = filter_value(plane, x);
    double reach = fabs(plane->n[0]) + fabs(plane->n[1]) + fabs(plane->n[2]) + 3 * plane->n_err;
    f.e = (f.e + (plane->form == GEOM_AXIS ? error : reach * error)) * FILTER_UP;
    return filter_sign(f);
}
#endif
