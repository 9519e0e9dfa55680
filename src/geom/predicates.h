/* predicates.h: on which side of a hyperplane is a point that is given by where it comes from?
 *
 * Three kinds of points occur in a BSP, and no point is ever rounded to decide anything:
 *
 *   vertex    an input vertex x                             degree 2 (2D, and above 3D), 3 (3D)
 *   crossing  segment uv  x  plane a                        degree 4 (2D, and above 3D), 6 (3D)
 *   corner    support plane s  x  plane a  x  plane b       degree 9 (3D)
 *
 * Each answer is -1, 0 or 1, by the stages of num/ladder.h. A side is the sign of f(x) = n . (x - o) - c, see
 * geom/plane.h; a plane is turned round by exchanging two of its defining points, which makes its normal -n. The laws
 * are numbered; the tests in tests/geom name the law that they check. For all predicates:
 *
 *   (A1) The answer is the exact one for the given doubles, whichever stage gives it.
 *   (A2) All coordinates times a power of two: the same answer, unless a coordinate loses digits.
 *   (A3) All points moved by one vector: the same answer, unless a coordinate is rounded.
 *   (A4) Planes through points, with two axes exchanged for all points: the opposite side. All three rotated: the same.
 *   (A5) Any finite double may be a coordinate, the largest and denormal ones included; -0 is 0. Infinity and NaN may
 *        not.
 *   (A6) Under another rounding mode the answers are the same; only exact numbers give them.
 *   (A7) Two input points are one point if and only if their coordinates are equal. Zeros that follow from that take
 *        no arithmetic. */
#ifndef FROE_GEOM_PREDICATES_H
#define FROE_GEOM_PREDICATES_H
#include "geom/filter.h"
#include "geom/plane.h"

/** Side of the point x (plane->dim doubles).
 *
 *   (V1) The plane turned round: the opposite side. Its three points rotated: the same side.
 *   (V2) 0 if and only if x is on the plane; its defining points are.
 *   (V3) A plane without a normal, as its points lie on one line (2D: are equal), has every x on it.
 *   (V4) AXIS compares x[axis] with the value. VERTICAL does not depend on x[2].
 *   (V5) A wall orders points by x, then by y. Only points with the x and y of its own point are on it. */
int geom_side_vertex(num_context *context, const geom_plane *plane, const double *x);
/** Side of the point where line uv meets `a`. REQUIRES: u and v not on the same
 * side of, and not both on, `a`.
 *
 *   (X1) u and v exchanged, or `a` turned round: the same side. The plane turned round: the opposite one.
 *   (X2) The plane is `a`, or has u and v on it: 0.
 *   (X3) `a` has u on it: the side of the vertex u. It has v on it: that of v.
 *   (X4) u and v are both on one side of the plane, or one of them is on the plane: that side.
 *   (X5) Beside a wall, or on one, the point is where it is for all small enough shears of the wall (geom/plane.h). */
int geom_side_crossing(num_context *context, const geom_plane *plane, const double *u, const double *v,
                       const geom_plane *a);
/** Side of the point s x a x b, 3D. REQUIRES: the three normals are independent.
 *
 *   (C1) s, a and b in any order, each turned round or not: the same side. The plane turned round: the opposite one.
 *   (C2) The plane is one of the three, or has the line on it where two of them meet: 0.
 *   (C3) A vertex is on all three: its side.
 *   (C4) s and b have u and v on them, which `a` parts: the side of the crossing of uv and `a`.
 *   (C5) Beside or on walls: as (X5). */
int geom_side_corner(num_context *context, const geom_plane *plane, const geom_plane *s, const geom_plane *a,
                     const geom_plane *b);
/** Side of the closed ball, radius >= 0: -1 or 1 when its interior lies there (touching
 * included), 0 when its centre is on the plane and radius is 0, 2 when the plane cuts
 * its interior. Any dimension.
 *
 *   (B1) The plane turned round: the opposite side; 2 stays.
 *   (B2) Radius 0: the side of the centre as a vertex.
 *   (B3) A ball that the plane cuts is cut with every greater radius, too. One beside it is there with every lesser
 *        one.
 *   (B4) A ball that touches the plane is beside it. A wall cuts it, since the shear makes the point of touch an
 *        interior one.
 *   (B5) A plane without a normal: 0, whatever the radius. */
int geom_side_ball(num_context *context, const geom_plane *plane, const double *centre, double radius);
/** Side of the closed box lo .. hi: -1 or 1 when it lies there (touching included), 0 when it lies in the plane, 2 when
 * both sides have some of it. Looks at two corners, at all of them beside planes through points. Any dimension; no
 * walls. */
int geom_side_box(num_context *context, const geom_plane *plane, const double *lo, const double *hi);

/** The coordinates of such points, rounded to the nearest double. Output only. These and the images are in image.c. */
void geom_round_crossing(num_context *context, const double *u, const double *v, const geom_plane *a, double *out);
void geom_round_corner(num_context *context, const geom_plane *s, const geom_plane *a, const geom_plane *b,
                       double *out);
/** Fast images with a certified error: |out[k] - true| <= the result for every k;
 * infinity when nothing is certain (then out may be anything). For filters and scores. An
 * image of a crossing always lies in the bounding box of u and v. */
double geom_image_crossing(const double *u, const double *v, const geom_plane *a, double *out);
double geom_image_corner(const geom_plane *s, const geom_plane *a, const geom_plane *b, double *out);
/** The same points as vectors from `from`, an input point, which lies on `s` of a corner; in plain doubles without a
 * bound, for scores. Only differences of input coordinates enter, so that a scene that is moved without rounding gives
 * the same numbers, however far from the origin. Components that are not finite are 0. Dimensions 2 and 3; planes
 * through points and across axes. */
void geom_relative_crossing(const double *u, const double *v, const geom_plane *a, const double *from, double *out);
void geom_relative_corner(const geom_plane *a, const geom_plane *b, const geom_plane *s, const double *from,
                          double *out);
/** Dimension 2 or 3: -1 or 1 when the image (x, error) is certainly on that side, NUM_UNSURE otherwise.
 * Input vertices have error 0. ~5 ns, so callers try it first.
 *
 *   (I1) A sure answer is the side of every point within `error` of x, so that of the point itself.
 *   (I2) It is never 0: of points on the plane nothing is sure. */
static inline int geom_side_image(const geom_plane *plane, const double *x, double error) {
    num_ball f = filter_value(plane, x);
    double reach = fabs(plane->n[0]) + fabs(plane->n[1]) + fabs(plane->n[2]) + 3 * plane->n_err;
    f.e = (f.e + (plane->form == GEOM_AXIS ? error : reach * error)) * FILTER_UP;
    return filter_sign(f);
}
#endif
