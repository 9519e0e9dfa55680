/* image.c: where crossings and corners lie: rounded exactly for output, or fast with
 * a certified error for filters and scores. */
#include "geom/formulas.h"
#include "geom/predicates.h"

/* origin + offset / divisor, rounded. */
static double rounded_image(num_arena *arena, double origin, num_dyadic offset, num_dyadic divisor) {
    num_dyadic shift = num_dyadic_mul(arena, num_dyadic_from(arena, origin), divisor);
    return num_dyadic_quotient(arena, num_dyadic_add(arena, shift, offset), divisor);
}

/* The same where both are polynomials in eps: its limit. */
static double limit(num_arena *arena, double origin, const num_sheared *offset, const num_sheared *divisor) {
    int order = num_sheared_order(divisor);
    if (order == NUM_SHEARED_TERMS) order = 0; /* a file may say that parallel planes meet */
    return rounded_image(arena, origin, offset->a[order], divisor->a[order]);
}

void geom_round_crossing(num_context *context, const double *u, const double *v, const geom_plane *a, double *out) {
    num_arena *arena = num_fresh(context);
    if (geom_is_sheared(a)) {
        num_sheared offset[3], divisor;
        offset_of_crossing_sheared(arena, u, v, a, offset, &divisor);
        for (int k = 0; k < a->dim; k++) out[k] = limit(arena, u[k], &offset[k], &divisor);
    } else {
        num_dyadic offset[3], divisor;
        offset_of_crossing_dyadic(arena, u, v, a, offset, &divisor);
        for (int k = 0; k < a->dim; k++) out[k] = rounded_image(arena, u[k], offset[k], divisor);
    }
}

void geom_round_corner(num_context *context, const geom_plane *s, const geom_plane *a, const geom_plane *b,
                       double *out) {
    const geom_plane *planes[3] = {s, a, b};
    num_arena *arena = num_fresh(context);
    double z[3];
    geom_corner_origin(planes, NULL, z);
    if (geom_is_sheared(s) || geom_is_sheared(a) || geom_is_sheared(b)) {
        num_sheared offset[3], divisor;
        offset_of_corner_sheared(arena, planes[0], planes[1], planes[2], z, offset, &divisor);
        for (int k = 0; k < 3; k++) out[k] = limit(arena, z[k], &offset[k], &divisor);
    } else {
        num_dyadic offset[3], divisor;
        offset_of_corner_dyadic(arena, planes[0], planes[1], planes[2], z, offset, &divisor);
        for (int k = 0; k < 3; k++) out[k] = rounded_image(arena, z[k], offset[k], divisor);
    }
}

/* Keeps x, an image of a number between p and q, between them; returns its error. */
static double confine(num_ball image, double p, double q, double *x) {
    double low = p < q ? p : q, high = p < q ? q : p, width = (high - low) * (1 + 0x1p-50);
    *x = image.x > low ? image.x < high ? image.x : high : low; /* a NaN becomes low */
    return image.e < width ? image.e : width;
}

double geom_image_crossing(const double *u, const double *v, const geom_plane *a, double *out) {
    num_ball share = filter_div(filter_value(a, u), filter_slope(a, u, v));
    double worst = 0;
    for (int k = 0; k < a->dim; k++) {
        num_ball step = filter_mul(filter_difference(u[k], v[k]), share);
        double error = confine(filter_add(num_ball_from(u[k]), step), u[k], v[k], out + k);
        worst = error > worst ? error : worst;
    }
    if (a->form == GEOM_AXIS || a->form == GEOM_AT_VERTEX) out[a->axis] = a->c;
    return geom_is_sheared(a) ? worst + NUM_BALL_TINY : worst; /* never exact: the true point is infinitely near */
}

double geom_image_corner(const geom_plane *s, const geom_plane *a, const geom_plane *b, double *out) {
    const geom_plane *planes[3] = {s, a, b};
    filter_vector n[3], across[3];
    num_ball at[3];
    double z[3], worst = 0;
    geom_corner_origin(planes, NULL, z);
    for (int i = 0; i < 3; i++) n[i] = filter_normal(planes[i]), at[i] = filter_value(planes[i], z);
    if (geom_has_origin(planes[0])) at[0] = num_ball_from(0);
    for (int i = 0; i < 3; i++) across[i] = filter_cross(&n[(i + 1) % 3], &n[(i + 2) % 3]);
    num_ball divisor = filter_dot(&n[0], &across[0]);
    for (int k = 0; k < 3; k++) {
        num_ball offset = {0, 0}; /* -s(z) ab[k] - a(z) bs[k] - b(z) sa[k] */
        for (int i = 0; i < 3; i++)
            offset = filter_sub(offset, filter_mul(at[i], (num_ball){across[i].x[k], across[i].e}));
        const num_ball x = filter_add(num_ball_from(z[k]), filter_div(offset, divisor));
        out[k] = x.x;
        if (!(x.e <= 0x1p1000)) return INFINITY; /* NaN too */
        worst = filter_greater(worst, x.e);
    }
    for (int i = 0; i < 3; i++)
        if (planes[i]->form == GEOM_AXIS) out[planes[i]->axis] = planes[i]->c;
    return worst;
}

void geom_relative_crossing(const double *u, const double *v, const geom_plane *a, const double *from, double *out) {
    const double share = -filter_value(a, u).x / filter_slope(a, u, v).x;
    const double t = share > 0 ? share < 1 ? share : 1 : 0; /* a NaN becomes 0 */
    for (int k = 0; k < a->dim; k++) {
        const double x = (u[k] - from[k]) + t * (v[k] - u[k]);
        out[k] = isfinite(x) ? x : 0;
    }
}

/* By Cramer's rule, as the image of a corner. */
void geom_relative_corner(const geom_plane *a, const geom_plane *b, const geom_plane *s, const double *from,
                          double *out) {
    const double *n = s->n, *m = a->n, *o = b->n, at_a = filter_value(a, from).x, at_b = filter_value(b, from).x;
    double across[2][3]; /* b x s, s x a */
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        across[0][k] = o[i] * n[j] - o[j] * n[i];
        across[1][k] = n[i] * m[j] - n[j] * m[i];
    }
    const double divisor = m[0] * across[0][0] + m[1] * across[0][1] + m[2] * across[0][2];
    for (int k = 0; k < 3; k++) {
        const double x = -(at_a * across[0][k] + at_b * across[1][k]) / divisor;
        out[k] = isfinite(x) ? x : 0;
    }
}
