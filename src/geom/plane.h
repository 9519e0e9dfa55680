/* plane.h: an oriented hyperplane of R^2 or R^3 that remembers where it comes from.
 *
 *     side(x) = sign of  n . (x - o) - c
 *
 * POINTS runs through d input points p[0..d-1] (o = p[0], c = 0):
 *     2D  n = (-(q-p)_y, (q-p)_x)    positive left of p -> q
 *     3D  n = (q-p) x (r-p)          positive where p, q, r turn left
 * VERTICAL (3D) runs through p[0], p[1] and their vertical translates: n as in 2D, n_z = 0.
 * AXIS is x[axis] = c; VECTOR is p[0] . x = c. Here o = 0.
 * The normal is never stored rounded for a decision: `n` is a double image with
 * a certified bound, for the filters only. */
#ifndef FROE_GEOM_PLANE_H
#define FROE_GEOM_PLANE_H
#include "num/context.h"

typedef enum geom_form { GEOM_AXIS, GEOM_POINTS, GEOM_VERTICAL, GEOM_VECTOR } geom_form;

typedef struct geom_plane {
    geom_form form;
    int dim, axis;
    double p[3][3], c;
    double n[3];  /**< rounded normal */
    double n_max; /**< max |n[k]| */
    double n_err; /**< bound on max |n[k] - true n[k]|; infinity: the filter does not apply */
} geom_plane;

geom_plane geom_plane_axis(int dim, int axis, double value);
/** Through dim points, dim doubles each; not checked for degeneracy: see geom_plane_valid. */
geom_plane geom_plane_points(int dim, const double *const points[]);
geom_plane geom_plane_vertical(const double *p, const double *q);
geom_plane geom_plane_vector(int dim, const double *normal, double value);
/** Is the normal not zero? Exact. */
bool geom_plane_valid(num_context *context, const geom_plane *plane);
#endif
