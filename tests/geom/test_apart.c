/* test_apart.c: planes between bodies, against contacts by brute force in rationals. Planes that are found are checked
 * by plain rational arithmetic. */
#include "geom/bodies.h"
#include "geom/meet/apart.h"
#include "support/context.h"
#include <gmp.h>

/* --------------------------------------------------------------- rationals -- */

/* The sign of  normal . x - value,  or 2 for a ball that has points on both sides. */
static int side_of(int dim, const double *normal, double value, const double *x, double radius) {
    mpq_t sum, term, square;
    mpq_inits(sum, term, square, NULL);
    mpq_set_d(sum, -value);
    for (int k = 0; k < dim; k++) {
        mpq_t n;
        mpq_init(n);
        mpq_set_d(n, normal[k]);
        mpq_mul(term, n, n);
        mpq_add(square, square, term);
        mpq_set_d(term, x[k]);
        mpq_mul(term, term, n);
        mpq_add(sum, sum, term);
        mpq_clear(n);
    }
    int side = mpq_sgn(sum);
    mpq_set_d(term, radius);
    mpq_mul(term, term, term);
    mpq_mul(square, square, term);
    mpq_mul(sum, sum, sum);
    if (radius > 0 && mpq_cmp(sum, square) < 0) side = 2;
    mpq_clears(sum, term, square, NULL);
    return side;
}

/* The body lies where side * (normal . x - value) >= 0, and not wholly in the plane. */
static bool lies_on(const geom_body *b, const double *normal, double value, int side) {
    bool beside = false;
    for (uint32_t i = 0; i < geom_body_corners(b); i++) {
        double corner[3];
        geom_body_corner(b, i, corner);
        const int found = side_of(b->dim, normal, value, corner, b->form == FROE_BALL ? b->radius : 0);
        if (found != side && found != 0) return false;
        beside = beside || found == side;
    }
    return beside;
}

/* ------------------------------------------------------------- nasty bodies -- */

typedef struct tallies {
    unsigned found, meeting, narrow;
} tallies;

static void check_case(num_context *context, fuzz_class kind, const bodies_case *c, tallies *counts) {
    const geom_body *a = &c->body[0], *b = &c->body[1];
    const size_t mark = exact_mark();
    const exact_body x = exact_body_of(a), y = exact_body_of(b);
    bool corner;
    const bool meeting = exact_contact(&x, &y, &corner) != 0;
    exact_release(mark);
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        double normal[3], value;
        context->first = first;
        if (!geom_apart(context, a, b, normal, &value)) {
            if (!meeting) counts->narrow++;
            continue;
        }
        if (!lies_on(a, normal, value, -1) || !lies_on(b, normal, value, 1))
            fail_msg("%s: %s and %s: no plane between them", fuzz_names[kind], froe_kind_name(a->form),
                     froe_kind_name(b->form));
        counts->found++;
    }
    counts->meeting += meeting;
}

static void planes_are_between_nasty_bodies(void **state) {
    fuzz_source r = {7};
    tallies counts = {0};
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        /* elsewhere gaps are narrower than any doubles tell apart */
        const bool wide = kind < FUZZ_WIDE || kind == FUZZ_DENORMAL || kind == FUZZ_HUGE;
        counts.narrow = 0;
        for (int i = 0; i < bodies_trials((fuzz_class)kind, 1500); i++) {
            bodies_case c;
            bodies_draw(&r, (fuzz_class)kind, 2 + i % 2, &c);
            check_case(*state, (fuzz_class)kind, &c, &counts);
        }
        if (wide && kind != FUZZ_NEAR_FLAT) assert_int_equal(counts.narrow, 0);
    }
    assert_true(counts.found > 30000 / BODIES_SHARE && counts.meeting > 9000 / BODIES_SHARE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_between_nasty_bodies),
    };
    return cmocka_run_group_tests_name("geom/apart", tests, context_open, context_close);
}
