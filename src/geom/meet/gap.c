/* gap.c: see gap.h. The search in doubles, in balls and in dyadic numbers. */
#include "geom/meet/gap.h"
#include "geom/formulas.h"
#include <string.h>

static int sign_of(double x) {
    return (x > 0) - (x < 0);
}

#define T double
#define FORMULA(f) f##_plain
#define FROM(x) (x)
#define ADD(a, b) ((a) + (b))
#define SUB(a, b) ((a) - (b))
#define MUL(a, b) ((a) * (b))
#define SHEAR(a) ((void)(a), 0.0)
#include "geom/predicate_body.inc"

#define T double
#define FORMULA(f) f##_plain
#define FROM(x) (x)
#define ADD(a, b) ((a) + (b))
#define SUB(a, b) ((a) - (b))
#define MUL(a, b) ((a) * (b))
#define SIGN(a) sign_of(a)
#define LESS(a, b) ((a) < (b))
#include "geom/meet/gap_body.inc"

#include "num/ball_terms.inc"
#define SIGN(a) num_ball_sign(a)
#define LESS(a, b) ((a).x < (b).x)
#include "geom/meet/gap_body.inc"

/* The first corner that is nearer will do: to keep the least one would take room that grows with the corners. */
#include "num/dyadic_terms.inc"
#define SIGN(a) ((a).sign)
#define LESS(a, b) ((void)(a), (void)(b), false)
#include "geom/meet/gap_body.inc"

enum { GUESS_STEPS = 32, BALL_STEPS = 64 }; /* far more than corners need where doubles tell them apart */

/* Does the difference vanish, exactly? */
static bool vanishes(num_context *context, const geom_differences *s, uint32_t i, uint32_t j) {
    num_dyadic v[3];
    context->arena.top = 0;
    gap_vector_dyadic(&context->arena, s, i, j, v);
    return gap_vanishes_dyadic(v) == 1;
}

/* Any difference that counts, to begin with. */
static bool begin_gap(num_context *context, const geom_differences *s, geom_gap *g) {
    uint32_t n = geom_body_corners(s->a), m = geom_body_corners(s->b);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < m; j++) {
            if (s->star && (i == s->star_a) == (j == s->star_b)) continue;
            if (s->nonzero && vanishes(context, s, i, j)) continue;
            *g = (geom_gap){.count = 1, .a = {i}, .b = {j}};
            return true;
        }
    return false;
}

bool geom_gap_among(num_context *context, const geom_differences *set, geom_gap *out) {
    geom_gap guess;
    if (!begin_gap(context, set, &guess)) return false;
    context->stats.calls++;
    if (context->first == NUM_FILTER) gap_search_plain(NULL, set, &guess, GUESS_STEPS);
    *out = guess;
    out->zero = false;
    if (context->first <= NUM_BALL && gap_search_ball(NULL, set, out, BALL_STEPS) == 1) {
        context->stats.refined++;
        return true;
    }
    context->stats.exact++;
    *out = guess;
    out->zero = false;
    gap_search_dyadic(&context->arena, set, out, UINT32_MAX);
    context->stats.exact_zero += out->zero;
    return true;
}
