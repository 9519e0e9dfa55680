/* plane.c: planes from points, axes and vectors, with certified images of their normals. */
#include "geom/filter.h"
#include "geom/formulas.h"
#include <math.h>
#include <string.h>

static geom_plane blank(geom_form form, int dim) {
    geom_plane plane = {.form = form, .dim = dim};
    return plane;
}

/* Fills n, n_max and n_err from the defining points. The bound is rounded up once more, so that
 * the filters may add their error terms without minding the rounding of the sum. Where
 * the rounding is wrong there is no image: then no filter and no shortcut applies. */
static void image_normal(geom_plane *plane) {
    num_ball n[3];
    plane->n_err = INFINITY; /* n not known yet */
    ball_normal(NULL, plane, n);
    double most = 0, error = 0;
    bool certain = num_rounding_trusted();
    for (int k = 0; k < 3; k++) {
        plane->n[k] = n[k].x;
        most = filter_greater(most, fabs(n[k].x));
        error = filter_greater(error, n[k].e);
        certain = certain && fabs(n[k].x) <= 0x1p1000 && n[k].e <= 0x1p1000; /* false for NaN */
    }
    plane->n_max = most;
    plane->n_err = certain ? error * (1 + 0x1p-48) : (double)INFINITY;
}

geom_plane geom_plane_axis(int dim, int axis, double value) {
    geom_plane plane = blank(GEOM_AXIS, dim);
    plane.axis = axis;
    plane.c = value;
    if (axis < 3) plane.n[axis] = 1;
    plane.n_max = 1;
    return plane;
}

geom_plane geom_plane_points(int dim, const double *const points[]) {
    geom_plane plane = blank(GEOM_POINTS, dim);
    for (int i = 0; i < dim; i++) memcpy(plane.p[i], points[i], (size_t)dim * sizeof(double));
    image_normal(&plane);
    return plane;
}

geom_plane geom_plane_vertical(const double *p, const double *q) {
    geom_plane plane = blank(GEOM_VERTICAL, 3);
    memcpy(plane.p[0], p, 3 * sizeof *p);
    memcpy(plane.p[1], q, 3 * sizeof *q);
    image_normal(&plane);
    return plane;
}

geom_plane geom_plane_vector(int dim, const double *normal, double value) {
    geom_plane plane = blank(GEOM_VECTOR, dim);
    plane.c = value;
    for (int k = 0; k < dim; k++) {
        plane.p[0][k] = plane.n[k] = normal[k];
        plane.n_max = filter_greater(plane.n_max, fabs(normal[k]));
    }
    if (!num_rounding_trusted()) plane.n_err = INFINITY;
    return plane;
}

bool geom_plane_valid(num_context *context, const geom_plane *plane) {
    if (plane->form == GEOM_AXIS) return true;
    if (context->first == NUM_FILTER && plane->n_max > plane->n_err) return true;
    num_dyadic n[3];
    context->arena.top = 0;
    dyadic_normal(&context->arena, plane, n);
    return n[0].sign || n[1].sign || n[2].sign;
}
