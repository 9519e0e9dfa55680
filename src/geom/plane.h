/* plane.h: an oriented hyperplane of R^2 .. R^8, kept as the input that defines it.
 *
 *     side(x) = sign of  n . (x - o) - c
 *
 * POINTS runs through d input points p[0..d-1] (o = p[0], c = 0):
 *     2D  n = (-(q-p)_y, (q-p)_x)    positive left of p -> q
 *     3D  n = (q-p) x (r-p)          positive where p, q, r turn left
 * VERTICAL (3D) runs through p[0], p[1] and their vertical translates: n as in 2D, n_z = 0.
 * AXIS is x[axis] = c; VECTOR is normal . x = c. Here o = 0. FINE is a VECTOR whose dim + 1 coefficients are sums: that
 * of rows[i * (dim + 1) + k] 2^(-53 i) over i, so that planes fit between bodies that no doubles tell apart.
 *
 * Above dimension 3 there are AXIS, VECTOR and FINE, and of the predicates those of vertices, crossings and balls:
 *     geom_plane_vector, geom_plane_fine, geom_plane_valid, filter_value, filter_slope (filter.h),
 *     geom_side_vertex, geom_side_crossing, geom_side_ball (predicates.h)
 * `n` has only three components, and nothing there reads it: geom_plane_normal() is the normal in any dimension.
 *
 * AT_VERTEX and AT_CROSSING are the walls of cylindrical partitions: the line x[0] = c (3D: the plane) through
 * p[0], or through the point where the line p[0]p[1] meets p[2]p[3] (3D: their projections), sheared by an
 * infinitesimal amount, n = (1, eps, 0): points beside it are ordered by x, those with the same x by y.
 * So no segment lies in such a line, and of two different points (x, y) one is on its left.
 *
 *         \
 *     left  p  right       where x = p_x, what is above p is on its right, what is below on its left
 *            \
 *
 * The normal is never stored rounded for a decision: `n` is a double image with
 * a certified bound, for the filters only; of a tiny normal it is the image of a positive multiple. */
#ifndef FROE_GEOM_PLANE_H
#define FROE_GEOM_PLANE_H
#include "num/context.h"

typedef enum geom_form {
    GEOM_AXIS,
    GEOM_AT_VERTEX, /* these three have the normal of an axis, as far as filters see */
    GEOM_AT_CROSSING,
    GEOM_POINTS,
    GEOM_VERTICAL,
    GEOM_VECTOR,
    GEOM_FINE
} geom_form;

typedef struct geom_plane {
    geom_form form;
    int dim, axis;
    union {
        double p[4][3];
        struct {
            double normal[FROE_MAX_DIM]; /**< VECTOR; FINE: rounded */
            const double *rows;          /**< FINE: they lie elsewhere */
            int row_count;
        };
    };
    double c;     /**< AT_CROSSING, FINE: rounded */
    double c_err; /**< bound on |c - true c|, 0 but for AT_CROSSING and FINE */
    double n[3];  /**< rounded normal; dimension <= 3 */
    double n_max; /**< max |n[k]|, in any dimension */
    double n_err; /**< bound on max |n[k] - true n[k]|; infinity: the filter does not apply */
} geom_plane;

geom_plane geom_plane_axis(int dim, int axis, double value);
/** Through dim points, dim doubles each; not checked for degeneracy: see geom_plane_valid. */
geom_plane geom_plane_points(int dim, const double *const points[]);
geom_plane geom_plane_vertical(const double *p, const double *q);
geom_plane geom_plane_vector(int dim, const double *normal, double value);
/** Numbers of a FINE plane are of degree 2, as normals of planes through points are: so many limbs take 60 rows. */
enum { GEOM_FINE_ROWS = 60 };
geom_plane geom_plane_fine(int dim, const double *rows, int row_count);
geom_plane geom_plane_at_vertex(int dim, const double *p);
/** Through the crossing of the lines ends[0] ends[1] and ends[2] ends[3], of which only x and y count. The second
 * must cross the first from its right to its left (geom_plane_valid finds out). */
geom_plane geom_plane_at_crossing(int dim, const double *const ends[4]);
/** Is it given by a normal and a value? */
static inline bool geom_is_vector(const geom_plane *plane) {
    return plane->form >= GEOM_VECTOR;
}
/** The image of the normal: dim numbers at least. Not for AXIS above dimension 3. */
static inline const double *geom_plane_normal(const geom_plane *plane) {
    return plane->dim > 3 ? plane->normal : plane->n;
}
/** Is it a wall of a cylindrical partition, sheared? */
static inline bool geom_is_sheared(const geom_plane *plane) {
    return plane->form == GEOM_AT_VERTEX || plane->form == GEOM_AT_CROSSING;
}
/** Is the normal not zero, and do the lines of an AT_CROSSING cross as they must? Exact. */
bool geom_plane_valid(num_context *context, const geom_plane *plane);
#endif
