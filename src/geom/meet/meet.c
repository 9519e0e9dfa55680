/* meet.c: corners as numbers of each type, and which type decides. */
#include "geom/meet/meet.h"
#include "geom/filter.h"
#include "geom/formulas.h"
#include "geom/high/high.h"
#include <string.h>

/* num_arena_bound (num/dyadic.c) is enough for PLANES, too: their corners are fractions of degree 3, differences of
 * them have degree 7 along an edge, and the longest polynomial, a squared height times squared weights, degree 44. A
 * face takes at most 120 steps of degree 14 (464 limbs) and 40 of degree 44 (1 454); a simplex has four corners of 300
 * steps of degree 4 (134). All that a step keeps is a simplex and a face. */

/* ----------------------------------------------------------------- balls -- */

static void place_corner_ball(num_arena *arena, const geom_convex *c, uint32_t i, num_ball x[3], num_ball *weight) {
    const double *p = c->core == GEOM_CORE_BOX ? NULL : geom_convex_point(c, c->core == GEOM_CORE_RAY ? 0 : i);
    (void)arena;
    *weight = num_ball_from(1);
    for (int k = 0; k < 3; k++) x[k] = num_ball_from(k < c->dim ? p ? p[k] : geom_convex_coordinate(c, i, k) : 0);
    if (c->core == GEOM_CORE_PLANES)
        for (int k = 0; k < c->dim; k++) x[k].e = c->error;
    if (c->core == GEOM_CORE_RAY && i)
        for (int k = 0; k < c->dim; k++)
            x[k] = num_ball_add(
                x[k], num_ball_mul(num_ball_from(ldexp(1, c->power)), num_ball_from(geom_convex_point(c, 1)[k])));
}

/* As far as is certain. */
static num_ball lowest_corner_ball(num_arena *arena, const geom_convex *c, const num_ball v[3], uint32_t *at,
                                   num_ball *weight) {
    double best = INFINITY, low = INFINITY;
    *at = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        num_ball x[3], value;
        place_corner_ball(arena, c, i, x, weight);
        value = vector_dot_ball(arena, v, x);
        if (!(value.e < INFINITY)) return (num_ball){0, INFINITY};
        if (value.x < best) best = value.x, *at = i;
        if (value.x - value.e < low) low = value.x - value.e;
    }
    return (num_ball){best, ((best - low) + FILTER_U * (fabs(best) + fabs(low))) * NUM_BALL_UP + NUM_BALL_TINY};
}

#include "num/ball_terms.inc"

#include "geom/meet/meet_body.inc"

/* --------------------------------------------------------------- dyadics -- */

/* A corner where planes meet, by Cramer's rule. */
static void place_meeting_dyadic(num_arena *arena, const geom_convex *c, uint32_t i, num_dyadic x[3],
                                 num_dyadic *weight) {
    const uint32_t *of = c->meetings[i].planes;
    const geom_plane *planes[3] = {c->planes + of[0], c->planes + of[1], c->planes + of[2]};
    double z[3];
    geom_corner_origin(planes, NULL, z);
    offset_of_corner_dyadic(arena, planes[0], planes[1], planes[2], z, x, weight);
    for (int k = 0; k < 3; k++) {
        x[k] = num_dyadic_add(arena, x[k], num_dyadic_mul(arena, num_dyadic_from(arena, z[k]), *weight));
        x[k].sign *= weight->sign;
    }
    weight->sign = 1;
}

static void place_corner_dyadic(num_arena *arena, const geom_convex *c, uint32_t i, num_dyadic x[3],
                                num_dyadic *weight) {
    x[2] = (num_dyadic){0};
    *weight = num_dyadic_from(arena, 1);
    switch (c->core) {
    case GEOM_CORE_PLANES:
        place_meeting_dyadic(arena, c, i, x, weight);
        return;
    case GEOM_CORE_RAY:
        for (int k = 0; k < c->dim; k++) {
            x[k] = num_dyadic_from(arena, geom_convex_point(c, 0)[k]);
            num_dyadic step = num_dyadic_mul(arena, num_dyadic_scaled(arena, 1, 1, c->power),
                                             num_dyadic_from(arena, geom_convex_point(c, 1)[k]));
            if (i) x[k] = num_dyadic_add(arena, x[k], step);
        }
        return;
    default:
        for (int k = 0; k < c->dim; k++) x[k] = num_dyadic_from(arena, geom_convex_coordinate(c, i, k));
    }
}

static num_dyadic lowest_corner_dyadic(num_arena *arena, const geom_convex *c, const num_dyadic v[3], uint32_t *at,
                                       num_dyadic *weight) {
    const size_t base = arena->top;
    num_dyadic best[3], x[3], w;
    *at = 0;
    place_corner_dyadic(arena, c, 0, best, weight);
    for (uint32_t i = 1; i < c->count; i++) {
        const size_t top = arena->top;
        place_corner_dyadic(arena, c, i, x, &w);
        for (int k = 0; k < 3; k++)
            x[k] = num_dyadic_sub(arena, num_dyadic_mul(arena, x[k], *weight), num_dyadic_mul(arena, best[k], w));
        const bool lower = vector_dot_dyadic(arena, v, x).sign < 0;
        arena->top = lower ? base : top;
        if (!lower) continue;
        *at = i;
        place_corner_dyadic(arena, c, i, best, weight);
    }
    return vector_dot_dyadic(arena, v, best);
}

#include "num/dyadic_terms.inc"

#include "geom/meet/meet_body.inc"

/* -------------------------------------------------------------- decisions -- */

enum { MOST_STEPS = 40, NO_END = -1 };

bool geom_meet(num_context *context, const geom_convex *a, const geom_convex *b) {
    int meets;
    if (a->dim > 3) return geom_high_meet(context, a, b);
    context->stats.calls++;
    return NUM_LADDER(context, meets, NUM_UNSURE, NUM_UNSURE, meet_search_ball(&context->arena, a, b, MOST_STEPS),
                      meet_search_dyadic(&context->arena, a, b, NO_END));
}

bool geom_meet_surely(num_context *context, const geom_convex *a, const geom_convex *b) {
    if (a->dim > 3) return geom_high_meet_surely(context, a, b);
    return context->first != NUM_EXACT && meet_search_ball(&context->arena, a, b, MOST_STEPS) == 1;
}

/* ------------------------------------------------------------------- boxes -- */

/* Squared gaps beside the squared reach, in doubles: terms are positive, so that their sum has a relative error, of
 * less than 30 times 2^-53. NUM_UNSURE; boxes of no reach are decided. */
static int filter_meet_boxes(int dim, const double *lo_a, const double *hi_a, const double *lo_b, const double *hi_b,
                             double reach) {
    const double sure = 1 - 0x1p-46, square = filter_capped(reach * reach);
    bool apart = false;
    double sum = 0;
    for (int k = 0; k < dim; k++) {
        const double above = lo_b[k] - hi_a[k], below = lo_a[k] - hi_b[k], gap = above > below ? above : below;
        apart |= gap > 0;
        sum += gap > 0 ? gap * gap : 0;
    }
    if (!apart || reach == 0) return !apart;
    sum = filter_capped(sum);
    if (sum * sure > square + NUM_BALL_TINY) return 0;
    return sum < square * sure - NUM_BALL_TINY ? 1 : NUM_UNSURE;
}

int geom_reach_over_gaps(num_context *context, int gaps, const double *from, const double *to, double radius_a,
                         double radius_b) {
    int sign;
    context->stats.calls++;
    return NUM_DECIDE(context, sign, NUM_UNSURE, NUM_UNSURE, reach_over_gaps, gaps, from, to, radius_a, radius_b);
}

bool geom_meet_boxes(num_context *context, int dim, const double *lo_a, const double *hi_a, double radius_a,
                     const double *lo_b, const double *hi_b, double radius_b) {
    double from[FROE_MAX_DIM], to[FROE_MAX_DIM];
    int gaps = 0;
    if (context->first == NUM_FILTER) {
        const int meets = filter_meet_boxes(dim, lo_a, hi_a, lo_b, hi_b, radius_a + radius_b);
        if (meets != NUM_UNSURE) return meets;
    }
    for (int k = 0; k < dim; k++) {
        if (hi_a[k] < lo_b[k])
            from[gaps] = hi_a[k], to[gaps++] = lo_b[k];
        else if (hi_b[k] < lo_a[k])
            from[gaps] = hi_b[k], to[gaps++] = lo_a[k];
    }
    if (!gaps || (radius_a == 0 && radius_b == 0)) return !gaps;
    return geom_reach_over_gaps(context, gaps, from, to, radius_a, radius_b) >= 0;
}
