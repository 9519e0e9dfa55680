/* foot.c: see foot.h. */
#include "geom/meet/foot.h"
#include "geom/formulas.h"
#include "geom/high/high.h"
#include "geom/meet/distance.h"
#include "num/root.h"
#include <string.h>

static void foot_in_box(const double *x, const double *lo, const double *hi, int dim, double *out) {
    for (int k = 0; k < dim; k++) out[k] = x[k] < lo[k] ? lo[k] : x[k] > hi[k] ? hi[k] : x[k];
}

static void foot_in_ball(num_context *context, const double *x, const geom_body *body, double *out) {
    const double *centre = geom_body_point(body, 0);
    num_arena *arena = num_fresh(context);
    const num_dyadic radius = num_dyadic_from(arena, body->radius);
    num_dyadic v[FROE_MAX_DIM], square = {0};
    for (int k = 0; k < body->dim; k++) {
        v[k] = num_dyadic_sub(arena, num_dyadic_from(arena, x[k]), num_dyadic_from(arena, centre[k]));
        square = num_dyadic_add(arena, square, num_dyadic_mul(arena, v[k], v[k]));
    }
    memcpy(out, x, (size_t)body->dim * sizeof *out);
    if (num_dyadic_compare(square, num_dyadic_mul(arena, radius, radius)) <= 0) return;
    const size_t mark = arena->top;
    for (int k = 0; k < body->dim; k++, arena->top = mark)
        out[k] = num_surd_round(arena, (num_surd){.p = num_dyadic_mul(arena, num_dyadic_from(arena, centre[k]), square),
                                                  .q = num_dyadic_mul(arena, radius, v[k]),
                                                  .r = square,
                                                  .s = square});
}

/* The point of the line or plane through the corners of a simplex that is nearest to x. */
static void foot_on_simplex(num_context *context, const double *x, const geom_distance *d, double *out) {
    num_arena *arena = num_fresh(context);
    num_dyadic at[4][3], e[3][3], n[3]; /* x and the corners; what lies between the first corner and each of these */
    for (int i = 0; i <= d->count; i++)
        for (int k = 0; k < 3; k++) {
            const double *p = i ? d->corner[i - 1] : x;
            at[i][k] = k < d->dim ? num_dyadic_from(arena, p[k]) : (num_dyadic){0};
        }
    for (int i = 0, j = 0; i <= d->count; i++)
        for (int k = 0; k < 3 && i != 1; k++) e[j][k] = num_dyadic_sub(arena, at[i][k], at[1][k]), j += k == 2;
    const bool plane = d->count == 3;
    if (plane)
        vector_cross_dyadic(arena, e[1], e[2], n);
    else
        memcpy(n, e[1], sizeof n);
    const num_dyadic along = vector_dot_dyadic(arena, n, e[0]), square = vector_dot_dyadic(arena, n, n);
    const size_t mark = arena->top;
    for (int k = 0; k < d->dim; k++, arena->top = mark) {
        const num_dyadic from = num_dyadic_mul(arena, at[plane ? 0 : 1][k], square);
        const num_dyadic step = num_dyadic_mul(arena, n[k], along);
        out[k] = num_dyadic_quotient(
            arena, plane ? num_dyadic_sub(arena, from, step) : num_dyadic_add(arena, from, step), square);
    }
}

void geom_foot(num_context *context, const double *x, const geom_body *body, double *out) {
    const geom_distance d = geom_distance_from(context, x, body);
    if (body->form == FROE_BALL)
        foot_in_ball(context, x, body, out);
    else if (d.lo)
        foot_in_box(x, d.lo, d.hi, d.dim, out);
    else if (d.high.count)
        geom_high_foot(context, x, body, out);
    else if (d.count > 1)
        foot_on_simplex(context, x, &d, out);
    else
        memcpy(out, d.count ? d.corner[0] : x, (size_t)d.dim * sizeof *out);
}
