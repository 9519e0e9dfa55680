/* plane.c: planes from points, axes and vectors, with certified images of their normals. */
#include "geom/plane.h"
#include "geom/filter.h"
#include "geom/formulas.h"
#include <math.h>
#include <string.h>

static geom_plane blank(geom_form form, int dim) {
    geom_plane plane = {.form = form, .dim = dim};
    return plane;
}

/* The same plane with all coordinates multiplied by a power of two, so that its points are about 1 apart where their
 * differences are tiny. That power; 1: not needed, or it would overflow. */
static double lifted(const geom_plane *plane, geom_plane *out) {
    int points = plane->form == GEOM_POINTS ? plane->dim : 2, dim = plane->form == GEOM_POINTS ? plane->dim : 2;
    double most = 0, largest = 0;
    for (int i = 0; i < points; i++)
        for (int k = 0; k < dim; k++) {
            most = filter_greater(most, fabs(plane->p[i][k] - plane->p[0][k]));
            largest = filter_greater(largest, fabs(plane->p[i][k]));
        }
    double lift = filter_lift(most);
    if (lift == 1 || !(largest * lift <= 0x1p500)) return 1;
    *out = *plane;
    for (int i = 0; i < points; i++)
        for (int k = 0; k < dim; k++) out->p[i][k] *= lift;
    return lift;
}

static double largest_of(const num_ball n[3]) {
    return filter_greater(filter_greater(fabs(n[0].x), fabs(n[1].x)), fabs(n[2].x));
}

/* Fills n, n_max and n_err from the defining points. The bound is rounded up once more, so that
 * the filters may add their error terms without minding the rounding of the sum. Where
 * the rounding is wrong there is no image: then no filter and no shortcut applies. */
static void image_normal(geom_plane *plane) {
    num_ball n[3];
    geom_plane multiple;
    plane->n_err = INFINITY; /* n not known yet */
    plane_normal_ball(NULL, plane, n);
    const double lift = largest_of(n) < FILTER_SMALL ? lifted(plane, &multiple) : 1;
    if (lift != 1) {
        plane_normal_ball(NULL, &multiple, n);
        const double raise = filter_raise(lift, largest_of(n));
        for (int k = 0; k < 3; k++) n[k].x *= raise, n[k].e *= raise;
    }
    double most = 0, error = 0;
    bool certain = num_rounding_trusted();
    for (int k = 0; k < 3; k++) {
        plane->n[k] = n[k].x;
        most = filter_greater(most, fabs(n[k].x));
        error = filter_greater(error, n[k].e);
        /* one way: an error is less, unless a product overflows; false for NaN */
        certain = certain && fabs(n[k].x) <= 0x1p1000 && n[k].e <= 0x1p1000;
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
        plane.normal[k] = normal[k];
        if (k < 3) plane.n[k] = normal[k];
        plane.n_max = filter_greater(plane.n_max, fabs(normal[k]));
    }
    if (!num_rounding_trusted()) plane.n_err = INFINITY;
    return plane;
}

geom_plane geom_plane_fine(int dim, const double *rows, int row_count) {
    geom_plane plane = geom_plane_vector(dim, rows, rows[dim]);
    const int width = dim + 1;
    plane.form = GEOM_FINE;
    plane.rows = rows;
    plane.row_count = row_count;
    for (int i = 1; i < row_count; i++) {
        double most = 0;
        for (int k = 0; k < dim; k++) most = filter_greater(fabs(rows[i * width + k]), most);
        plane.n_err += most * ldexp(1 + 0x1p-40, -53 * i) + NUM_BALL_TINY;
        plane.c_err += fabs(rows[i * width + dim]) * ldexp(1 + 0x1p-40, -53 * i) + NUM_BALL_TINY;
    }
    return plane;
}

num_ball filter_sum_far(const geom_plane *h, const double *w, double c) {
    double x = 0, size = fabs(c), spread = 0;
    for (int k = 0; k < h->dim; k++) {
        const double product = h->normal[k] * w[k];
        x += product;
        size += fabs(product);
        spread += fabs(w[k]);
    }
    const double error = (2 * h->dim + 8) * FILTER_U * size + h->n_err * spread + h->dim * NUM_BALL_TINY;
    return (num_ball){x - c, error * FILTER_UP};
}

geom_plane geom_plane_at_vertex(int dim, const double *p) {
    geom_plane plane = geom_plane_axis(dim, 0, p[0]);
    plane.form = GEOM_AT_VERTEX;
    plane.p[0][0] = p[0], plane.p[0][1] = p[1];
    return plane;
}

geom_plane geom_plane_at_crossing(int dim, const double *const ends[4]) {
    geom_plane plane = geom_plane_axis(dim, 0, 0);
    plane.form = GEOM_AT_CROSSING;
    for (int i = 0; i < 4; i++) plane.p[i][0] = ends[i][0], plane.p[i][1] = ends[i][1];
    /* c and c_err. The lines may cross anywhere, so nothing confines the image to a segment. */
    const double *points[2] = {plane.p[2], plane.p[3]}, *u = plane.p[0], *v = plane.p[1];
    const geom_plane line = geom_plane_points(2, points);
    num_ball share = filter_div(filter_value(&line, u), filter_slope(&line, u, v));
    num_ball x = filter_add(num_ball_from(u[0]), filter_mul(filter_difference(u[0], v[0]), share));
    bool certain = num_rounding_trusted() && fabs(x.x) <= 0x1p1000 && x.e <= 0x1p1000; /* false for NaN */
    plane.c = certain ? x.x : u[0];
    plane.c_err = certain ? x.e * FILTER_UP : (double)INFINITY;
    return plane;
}

bool geom_plane_valid(num_context *context, const geom_plane *plane) {
    if (plane->form == GEOM_AXIS || plane->form == GEOM_AT_VERTEX) return true;
    if (plane->form == GEOM_AT_CROSSING) {
        return wall_turn_dyadic(num_fresh(context), plane).sign > 0;
    }
    if (context->first == NUM_FILTER && plane->n_max > plane->n_err) return true;
    num_dyadic n[FROE_MAX_DIM];
    plane_normal_dyadic(num_fresh(context), plane, n);
    bool valid = false;
    for (int k = 0; k < plane->dim; k++) valid = valid || n[k].sign;
    return valid;
}
