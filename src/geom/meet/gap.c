/* gap.c: see gap.h. The search in doubles, in balls and in dyadic numbers. */
#include "geom/meet/gap.h"
#include "geom/formulas.h"
#include <string.h>

/* Of two conditions: 1, 0 or NUM_UNSURE. */
static int both(int a, int b) {
    return a == 0 || b == 0 ? 0 : a == 1 && b == 1 ? 1 : NUM_UNSURE;
}

/* Differences of the face are all as near along x. */
static bool is_level(const geom_gap *g, uint32_t i, uint32_t j) {
    for (int m = 0; m < g->count; m++)
        if (g->a[m] == i && g->b[m] == j) return true;
    return false;
}

#include "num/plain_terms.inc"

#include "geom/predicate_body.inc"

#include "num/plain_terms.inc"
#define LESS(a, b) ((a) < (b))
#include "geom/meet/gap_body.inc"

#include "num/ball_terms.inc"
#define LESS(a, b) ((a).x < (b).x)
#include "geom/meet/gap_body.inc"

/* The first corner that is nearer will do: to keep the least one would take room that grows with the corners. */
#include "num/dyadic_terms.inc"
/* one way: nothing is less */
#define LESS(a, b) ((void)(a), (void)(b), false)
#include "geom/meet/gap_body.inc"

enum { GUESS_STEPS = 32, BALL_STEPS = 64 }; /* far more than corners need where doubles tell them apart */

/* Any difference that counts, to begin with. */
static bool begin_gap(num_context *context, const geom_differences *s, geom_gap *g) {
    uint32_t n = geom_body_corners(s->a), m = geom_body_corners(s->b);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < m; j++) {
            num_dyadic v[3];
            if (s->star && (i == s->star_a) == (j == s->star_b)) continue;
            if (s->nonzero) {
                gap_vector_dyadic(num_fresh(context), s, i, j, v);
                if (gap_vanishes_dyadic(v) == 1) continue;
            }
            *g = (geom_gap){.count = 1, .a = {i}, .b = {j}};
            return true;
        }
    return false;
}

/* Does the origin lie outside the hull: 1, or in it: 0? Each stage begins with the same guess. */
static int sign_of_gap_ball(const geom_differences *set, const geom_gap *guess, geom_gap *out) {
    *out = *guess;
    return gap_search_ball(NULL, set, out, BALL_STEPS) == 1 ? !out->zero : NUM_UNSURE;
}

static int sign_of_gap_dyadic(num_arena *arena, const geom_differences *set, const geom_gap *guess, geom_gap *out) {
    *out = *guess;
    gap_search_dyadic(arena, set, out, UINT32_MAX);
    return !out->zero;
}

bool geom_gap_among(num_context *context, const geom_differences *set, geom_gap *out) {
    geom_gap guess;
    int sign;
    if (!begin_gap(context, set, &guess)) return false;
    context->stats.calls++;
    if (context->first == NUM_FILTER) gap_search_plain(NULL, set, &guess, GUESS_STEPS);
    guess.zero = false;
    (void)NUM_LADDER(context, sign, NUM_UNSURE, NUM_UNSURE, sign_of_gap_ball(set, &guess, out),
                     sign_of_gap_dyadic(&context->arena, set, &guess, out));
    return true;
}

bool geom_gap_guess(const geom_body *a, const geom_body *b, const geom_gap *gap, double direction[3]) {
    const geom_differences all = {.a = a, .b = b};
    double v[4][3], most = 0;
    for (int i = 0; i < gap->count; i++) gap_vector_plain(NULL, &all, gap->a[i], gap->b[i], v[i]);
    gap_face_plain(NULL, v, gap->count, (1u << gap->count) - 1, direction);
    for (int k = 0; k < 3; k++) most = fmax(most, fabs(direction[k]));
    if (!(most > 0x1p-900 && most < INFINITY)) return false;
    for (int k = 0; k < 3; k++) direction[k] /= -most;
    return true;
}
