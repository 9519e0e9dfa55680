/* eye.h: what an eye sees of points, lines and planes, exactly. The eye is a point, or
 * infinitely far away in a direction.
 *
 *            . x           A point x is seen as its ray r(x), a vector of R^3 up to a positive factor; a
 *           /              line of the picture is a plane through the eye, which is a covector h of the same
 *      eye o------ . y     space:  sign h.r(x) tells the side of x.  The line through x and y is r(x) x r(y), two
 *           \              lines g, h meet in g x h, and that meets f where det(g, h, f) = 0: everything is
 *            . z           a determinant, and nothing is ever divided (Stolfi, Oriented Projective Geometry, 1991).
 *
 *     eye at e                r(x) = e - x
 *     parallel, towards d     r(x) = (w_i d_k - w_k d_i, w_j d_k - w_k d_j, s d_k),  w = x - origin, d_k the largest of
 *                             d, s about as large as the scene, so that no component vanishes beside another
 *
 * In both, det(r(p), r(q), r(r)) > 0 where p, q, r turn left as the eye sees them. A picture of all
 * directions around an eye at a point is a sphere: rays behind the eye count like any others.
 *
 * Three kinds of lines occur. EDGE runs through two points: degree 2. CUT is where plane a cuts an object with support
 * s: h(x) = a(E) s(x) - s(E) a(x), the plane of the pencil of s and a through the eye; degree 5. STOP runs through the
 * point where plane a cuts an edge uv, which is seen along a(v) r(u) - a(u) r(v), and through the ray e_axis of an
 * axis: it marks that point on any line but those through e_axis. */
#ifndef FROE_GEOM_EYE_H
#define FROE_GEOM_EYE_H
#include "geom/filter.h"

typedef struct geom_eye {
    bool parallel;
    int axis;         /**< k: where |at| is largest; parallel only */
    double at[3];     /**< the point, or the direction towards the eye */
    double origin[3]; /**< any point near the scene; parallel only */
    double size;      /**< s, a power of two from 2^-1000 to 2^1000; parallel only */
} geom_eye;

/** `at` finite, and for a parallel eye not zero. `origin` may be NULL. The scene is about 1 large. */
geom_eye geom_eye_make(bool parallel, const double *at, const double *origin);
/** For a scene of which the longest side is `extent`. */
void geom_eye_set_extent(geom_eye *eye, double extent);
/** Side of a plane (of R^2 or R^3) on which the eye is: -1, 0 or 1. */
int geom_side_of_eye(num_context *context, const geom_plane *plane, const geom_eye *eye);
/** The same for the plane through p, q and r, without making it: -1, 1 or NUM_UNSURE. ~5 ns. */
int geom_side_of_eye_filter(const double *p, const double *q, const double *r, const geom_eye *eye);

typedef enum geom_sight { GEOM_SIGHT_EDGE, GEOM_SIGHT_CUT, GEOM_SIGHT_STOP } geom_sight;
typedef struct geom_line {
    geom_sight kind;
    const double *u, *v;     /**< EDGE, STOP */
    const geom_plane *s, *a; /**< CUT: not parallel, and the eye not on s. STOP: only a */
    int axis;                /**< STOP */
} geom_line;

/** Images for filters: every component within .e of the true one. */
filter_vector geom_ray_image(const geom_eye *eye, const double *x);
filter_vector geom_line_image(const geom_eye *eye, const geom_line *line);
/** -1, 1 or NUM_UNSURE. */
static inline int geom_line_image_side(const filter_vector *line, const filter_vector *ray) {
    return filter_sign(filter_dot(line, ray));
}

/** Side of line h on which the point x is. */
int geom_line_side_point(num_context *context, const geom_eye *eye, const geom_line *h, const double *x);
/** Sign of det(a, b, h): side of h on which the ray a x b is. */
int geom_line_side_meeting(num_context *context, const geom_eye *eye, const geom_line *h, const geom_line *a,
                           const geom_line *b);
/** Of two points on line h: 1 where its direction, in which u -> v of an EDGE leads, leads from x to y, -1 where it
 * leads back, 0 where they are seen as one. REQUIRES: less than half a turn parts them. */
int geom_line_order(num_context *context, const geom_eye *eye, const geom_line *h, const double *x, const double *y);
/** Compares two lines, whatever their directions, by the shares of their other components in component k, which neither
 * has as 0. 0: they are one line. */
int geom_line_compare(num_context *context, const geom_eye *eye, const geom_line *a, const geom_line *b, int k);
/** A line's covector, and the ray a x b, divided by their largest components and then rounded: lines that are equal
 * have the same up to a sign. For that, for output, and for images that filters can use where the quick ones are too
 * coarse. False, and zeros: the line is none, since an eye sees u and v as one point. REQUIRES: the ray is not zero. */
bool geom_line_round(num_context *context, const geom_eye *eye, const geom_line *line, double out[3]);
void geom_meeting_round(num_context *context, const geom_eye *eye, const geom_line *a, const geom_line *b,
                        double out[3]);
/** The t, rounded, for which u + t (v - u) is seen on the line. REQUIRES: u and v are on different sides. */
double geom_share_round(num_context *context, const geom_eye *eye, const geom_line *line, const double *u,
                        const double *v);
#endif
