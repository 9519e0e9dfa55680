/* check.c: do predicates give the same answers by filters as by exact numbers alone, as they are compiled here?
 *
 * Coordinates are small multiples of a tenth, rounded, so that many points lie on common lines and planes but for that
 * rounding, which is where filters are unsure. */
#include "geom/predicates.h"
#include "geom/selftest.h"
#include <emscripten.h>
#include <stdio.h>

enum { POINTS = 9, PREDICATES = 3 };

static uint64_t next(uint64_t *state) { /* xorshift64*, Vigna 2016 */
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return *state * UINT64_C(2685821657736338717);
}

static geom_plane plane_of(int dim, double p[][3], int first) {
    return geom_plane_points(dim, (const double *const[]){p[first], p[first + 1], p[first + dim - 1]});
}

/* The answers about one case; 3 where a predicate does not apply. */
static void answer(num_context *context, int dim, double p[][3], double radius, int out[PREDICATES]) {
    const geom_plane h = plane_of(dim, p, 0), a = plane_of(dim, p, dim);
    const int u = geom_side_vertex(context, &a, p[7]), v = geom_side_vertex(context, &a, p[8]);
    out[0] = geom_side_vertex(context, &h, p[6]);
    out[1] = u * v < 0 ? geom_side_crossing(context, &h, p[7], p[8], &a) : 3;
    out[2] = geom_side_ball(context, &h, p[6], radius);
}

/** Tries so many cases and writes a line that tells what came out. 0: all is right. */
EMSCRIPTEN_KEEPALIVE int check(int cases, uint32_t seed);
int check(int cases, uint32_t seed) {
    uint64_t state = seed | 1;
    num_context quick, exact;
    long wrong = 0, decided = 0;
    if (geom_context_new(NULL, &quick) || num_context_new(NULL, &exact)) return 2;
    const bool trusted = quick.first != NUM_EXACT;
    const char *fault = geom_formula_at_fault(&quick);
    exact.first = NUM_EXACT;
    for (int i = 0; i < cases; i++) {
        const int dim = 2 + (int)(i & 1), reach = 3 + (int)(next(&state) % 28);
        double p[POINTS][3];
        int fast[PREDICATES], right[PREDICATES];
        for (int k = 0; k < 3 * POINTS; k++)
            p[k / 3][k % 3] = 0.1 * (double)((int)(next(&state) % (uint64_t)(2 * reach + 1)) - reach);
        answer(&quick, dim, p, p[0][0] * p[0][0], fast);
        answer(&exact, dim, p, p[0][0] * p[0][0], right);
        for (int k = 0; k < PREDICATES; k++) {
            wrong += fast[k] != right[k];
            decided += right[k] != 3;
        }
    }
    printf("filters %s, formulas %s, %ld decisions, %ld wrong\n", trusted ? "trusted" : "off", fault ? fault : "right",
           decided, wrong);
    num_context_free(&quick);
    num_context_free(&exact);
    return wrong || fault || !trusted;
}
