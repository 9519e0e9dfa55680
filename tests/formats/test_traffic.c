/* test_traffic.c: contacts in real and made-up files against exact brute force over all pairs. */
#include "support/scenes.h"

#include "oracle/moving.h"
#include "support/found.h"
#include <math.h>
#include <stdlib.h>

/* The box of an object over its whole life, exactly: the hull of its knots and control points. */
static void hull_of(const froe_motion *m, uint32_t object, double lo[2], double hi[2]) {
    froe_moving_object o = froe_motion_object(m, object);
    for (int k = 0; k < 2; k++) lo[k] = (double)INFINITY, hi[k] = -(double)INFINITY;
    for (int i = 0; i < 2; i++)
        for (size_t j = 0; j < froe_motion_knot_count(m, o.vertices[i]); j++) {
            froe_moving_knot knot = froe_motion_knot(m, o.vertices[i], j);
            for (int k = 0; k < 2; k++) {
                lo[k] = fmin(lo[k], fmin(knot.at[k], isnan(knot.control[k]) ? knot.at[k] : knot.control[k]));
                hi[k] = fmax(hi[k], fmax(knot.at[k], isnan(knot.control[k]) ? knot.at[k] : knot.control[k]));
            }
        }
}

static void assert_encloses(const double ours[2], mpq_t theirs[2]) {
    mpq_t low, high;
    mpq_inits(low, high, NULL);
    mpq_set_d(low, ours[0]);
    mpq_set_d(high, ours[1]);
    assert_true(mpq_cmp(low, theirs[1]) <= 0 && mpq_cmp(theirs[0], high) <= 0);
    mpq_clears(low, high, NULL);
}

/* The contacts of one pair, in order, against those of the oracle; returns how many. */
static size_t check_pair(const froe_motion *m, const found *f, uint32_t a, uint32_t b, oracle_contacts *truth) {
    int seen = 0;
    oracle_contacts_find(truth, m, a, b);
    for (size_t i = 0; i < f->count; i++) {
        const froe_contact *c = &f->list[i];
        if (c->a != a || c->b != b) continue;
        assert_true(seen < truth->count);
        assert_encloses(c->begin, truth->list[seen].begin);
        assert_encloses(c->end, truth->list[seen].end);
        assert_int_equal(c->instant, truth->list[seen].instant);
        seen++;
    }
    assert_int_equal(seen, truth->count);
    return (size_t)seen;
}

static size_t check_all(const froe_motion *m) {
    static found f;
    f.count = 0;
    found_in(m, NULL, &f);
    size_t confirmed = 0;
    oracle_contacts truth;
    oracle_contacts_init(&truth);
    for (uint32_t a = 0; a < froe_motion_object_count(m); a++) {
        double lo[2], hi[2];
        hull_of(m, a, lo, hi);
        for (uint32_t b = a + 1; b < froe_motion_object_count(m); b++) {
            double low[2], high[2];
            froe_moving_object p = froe_motion_object(m, a), q = froe_motion_object(m, b);
            hull_of(m, b, low, high);
            if (lo[0] > high[0] || low[0] > hi[0] || lo[1] > high[1] || low[1] > hi[1]) continue;
            if (p.vertices[1] == q.vertices[0] || p.vertices[0] == q.vertices[1]) continue; /* of one polygon */
            confirmed += check_pair(m, &f, a, b, &truth);
        }
    }
    oracle_contacts_clear(&truth);
    assert_int_equal(confirmed, f.count);
    return confirmed;
}

static void contacts_of_real_cars_are_confirmed_pair_by_pair(void **state) {
    (void)state;
    froe_motion *m = NULL;
    assert_int_equal(froe_read_motion(FROE_TEST_DATA "/cars-bologna.mfjson", NULL, &m, NULL, NULL), FROE_OK);
    assert_int_equal(check_all(m), 18);
    froe_motion_free(m);
}

static void contacts_of_made_up_motions_are_confirmed(void **state) {
    (void)state;
    static const char *const kinds[] = {"moving-lattice", "moving-rigid", "moving-polygons"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_motion *m = NULL;
        assert_int_equal(froe_generate_motion(kinds[i], i == 0 ? 12 : 9, 3, NULL, &m, NULL), FROE_OK);
        assert_true(check_all(m) > 0);
        froe_motion_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_of_real_cars_are_confirmed_pair_by_pair),
        cmocka_unit_test(contacts_of_made_up_motions_are_confirmed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
