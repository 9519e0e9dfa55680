/* limit.c: places for output, in doubles. Most are where a point is at the tick; but two lines may be parallel at the
 * tick and cross just after it, and a segment may be upright then and not just after it. A value that is 0 / 0 at the
 * tick has a limit from after it: the quotient of the first coefficients in time of which the lower one is not 0. */
#include "kinetic/now/now.h"
#include <math.h>

/* The limit of top / bottom, which is bounded; NaN: 0 / 0 for as long as the pieces last. */
static double limit_of(num_arena *arena, const poly_exact *top, const poly_exact *bottom) {
    for (int i = 0; i <= bottom->degree; i++)
        if (bottom->c[i].sign) return i > top->degree ? 0 : num_dyadic_quotient(arena, top->c[i], bottom->c[i]);
    return (double)NAN;
}

void now_place_near(now_state *now, name_point p, double out[2]) {
    const now_spot spot = now_spot_of(now, p);
    out[0] = now_lowered(now, spot.x), out[1] = now_lowered(now, spot.y);
    if (spot.error < (double)INFINITY) return;
    exact_point e;
    now_exact_named(now, p, true, &e);
    out[0] = limit_of(&now->context.arena, &e.x, &e.w);
    out[1] = limit_of(&now->context.arena, &e.y, &e.w);
}

/* How far a segment has gone from end 0 to end 1 where it has the x of a point: with w for the point and a, b for the
 * ends, (w - a) / (b - a) in x. */
static double share_before(now_state *now, uint32_t segment, name_point p) {
    num_arena *arena = &now->context.arena;
    const uint32_t *end = now->segments.data[segment].end;
    exact_point w, a, b;
    now_exact_named(now, p, true, &w);
    now_exact_along(now, end[0], &a), now_exact_along(now, end[1], &b);
    const poly_exact zero = {.degree = 0, .c = {num_dyadic_from(arena, 0)}};
    poly_exact gone, whole, top, bottom; /* gone times the denominators of w and a, whole times those of b and a */
    exact_determinant(arena, (poly_exact[]){w.x, w.w}, (poly_exact[]){a.x, a.w}, &gone);
    exact_determinant(arena, (poly_exact[]){b.x, b.w}, (poly_exact[]){a.x, a.w}, &whole);
    exact_determinant(arena, (poly_exact[]){gone, zero}, (poly_exact[]){zero, b.w}, &top);
    exact_determinant(arena, (poly_exact[]){whole, zero}, (poly_exact[]){zero, w.w}, &bottom);
    return limit_of(arena, &top, &bottom);
}

double now_height_near(now_state *now, uint32_t segment, name_point p) {
    const uint32_t *end = now->segments.data[segment].end;
    const now_spot spot = now_spot_of(now, p), u = now_vertex_spot(now, end[0]), v = now_vertex_spot(now, end[1]);
    double share = (spot.x - u.x) / (v.x - u.x), a[2], b[2], at[2];
    now_place_near(now, (name_point){end[0], NAME_VERTEX}, a);
    now_place_near(now, (name_point){end[1], NAME_VERTEX}, b);
    if (!(fabs(v.x - u.x) > u.error + v.error && spot.error < (double)INFINITY)) share = share_before(now, segment, p);
    const double low = fmin(a[1], b[1]), high = fmax(a[1], b[1]);
    double y = a[1] + share * (b[1] - a[1]);
    if (isnan(share)) { /* upright for good: at the point */
        now_place_near(now, p, at);
        y = at[1];
    }
    return fmin(fmax(y, low), high);
}
