/* meet.c: see high.h. */
#include "geom/filter.h"
#include "geom/high/guess.h"
#include "geom/high/high.h"

/* 1: they meet, 0: they do not, NUM_UNSURE. */
static int sure_meet(const geom_guess *guess, const geom_convex *a, const geom_convex *b) {
    const double reach = a->radius + b->radius;
    double least, most;
    geom_guess_bounds(guess, a, b, &least, &most);
    if (least > reach * (1 + 0x1p-50)) return 0;
    if (reach > 0 && most < reach * (1 - 0x1p-50)) return 1;
    return geom_guess_inside(guess, a, b) ? 1 : NUM_UNSURE;
}

static bool meet_exactly(num_context *context, const geom_convex *a, const geom_convex *b, const geom_simplex *guess) {
    num_arena *arena = num_fresh(context);
    const geom_gaps gaps = {.a = a, .b = b};
    geom_nearest at;
    geom_nearest_find(context, &gaps, guess, &at);
    if (at.zero) return true;
    if (a->radius == 0 && b->radius == 0) return false;
    const num_dyadic reach =
        num_dyadic_add(arena, num_dyadic_from(arena, a->radius), num_dyadic_from(arena, b->radius));
    const num_dyadic bound = num_dyadic_mul(arena, num_dyadic_mul(arena, reach, reach), at.square.bottom);
    return num_dyadic_compare(at.square.top, bound) <= 0;
}

bool geom_high_meet(num_context *context, const geom_convex *a, const geom_convex *b) {
    geom_guess guess = {.simplex = {.count = 0}};
    int meets;
    context->stats.calls++;
    if (context->first != NUM_EXACT) guess = geom_guess_between(a, b);
    return NUM_LADDER(context, meets, sure_meet(&guess, a, b), NUM_UNSURE,
                      context->first == NUM_BALL ? sure_meet(&guess, a, b) : NUM_UNSURE,
                      meet_exactly(context, a, b, &guess.simplex));
}

bool geom_high_meet_surely(num_context *context, const geom_convex *a, const geom_convex *b) {
    if (context->first == NUM_EXACT) return false;
    const geom_guess guess = geom_guess_between(a, b);
    return sure_meet(&guess, a, b) == 1;
}

/* ----------------------------------------------------------------- distance -- */

num_ball geom_high_square_image(num_context *context, const double *point, const geom_body *body) {
    const geom_body at = geom_body_at(body->dim, point);
    const geom_convex a = geom_convex_of(body), b = geom_convex_of(&at);
    double least, most;
    if (context->first == NUM_EXACT) return (num_ball){0, INFINITY};
    const geom_guess guess = geom_guess_between(&a, &b);
    geom_guess_bounds(&guess, &a, &b, &least, &most);
    const double low = least * least, high = most * most, middle = 0.5 * low + 0.5 * high;
    const double error = (0.5 * (high - low) + FILTER_U * 4 * high) * NUM_BALL_UP + NUM_BALL_TINY;
    return error < INFINITY ? (num_ball){middle, error} : (num_ball){0, INFINITY};
}

/* Behind what the arena holds. */
static geom_nearest nearest_to(num_context *context, const double *point, const geom_body *body) {
    const geom_body at = geom_body_at(body->dim, point);
    const geom_convex a = geom_convex_of(body), b = geom_convex_of(&at);
    const geom_gaps gaps = {.a = &a, .b = &b};
    geom_guess guess = {.simplex = {.count = 0}};
    geom_nearest found;
    if (context->first != NUM_EXACT) guess = geom_guess_between(&a, &b);
    geom_nearest_find(context, &gaps, &guess.simplex, &found);
    return found;
}

num_ratio geom_high_square(num_context *context, const double *point, const geom_body *body) {
    return nearest_to(context, point, body).square;
}

void geom_high_foot(num_context *context, const double *point, const geom_body *body, double *out) {
    num_arena *arena = num_fresh(context);
    const geom_nearest found = nearest_to(context, point, body);
    const size_t mark = arena->top;
    for (int k = 0; k < body->dim; k++, arena->top = mark) {
        const num_dyadic x = num_dyadic_from(arena, point[k]);
        out[k] =
            found.zero
                ? point[k]
                : num_dyadic_quotient(arena, num_dyadic_add(arena, num_dyadic_mul(arena, x, found.scale), found.x[k]),
                                      found.scale);
    }
}
