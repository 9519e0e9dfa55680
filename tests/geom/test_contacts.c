/* How bodies meet, and how far points are from them, against the oracle: every pair of kinds, every class of
 * coordinates, every stage of the predicates. */
#include "geom/bodies.h"
#include "geom/meet/contact.h"
#include "geom/meet/distance.h"
#include <stdlib.h>

static uint64_t counts[GEOM_CONTACTS], corners, total;

typedef struct fixture {
    num_context context;
    bodies_case c;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return !f || num_context_new(NULL, &f->context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    froe_predicate_stats *s = &f->context.stats;
    print_message("  %llu calls, %llu exact, %llu of these zero\n", (unsigned long long)s->calls,
                  (unsigned long long)s->exact, (unsigned long long)s->exact_zero);
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    num_context_free(&f->context);
    free(f);
    return 0;
}

typedef void trial_fn(fixture *f, fuzz_class kind);

static void run_trials(fixture *f, int dim, int trials, trial_fn *fn) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(kind * 1000 + dim)};
        for (int i = 0; i < bodies_trials((fuzz_class)kind, trials); i++) {
            bodies_draw(&r, (fuzz_class)kind, dim, &f->c);
            fn(f, (fuzz_class)kind);
        }
    }
}

static const char *names[] = {"apart", "cross", "touch", "overlap"};

static void try_meeting(fixture *f, fuzz_class kind) {
    const geom_body *a = &f->c.body[0], *b = &f->c.body[1];
    exact_body x = exact_body_of(a), y = exact_body_of(b);
    signed char sides[2 * BODIES_EACH];
    bool corner;
    int expected = exact_contact(&x, &y, &corner);
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        f->context.first = first;
        geom_contact m = geom_contact_of(&f->context, a, b, sides);
        if ((int)m.kind != expected || (m.kind == GEOM_TOUCH && (m.touch == GEOM_TOUCH_AT_CORNER) != corner))
            fail_msg("%s: %s and %s: %s, not %s (corner %d)", fuzz_names[kind], froe_kind_name(a->form),
                     froe_kind_name(b->form), names[m.kind], names[expected], corner);
        total++;
    }
    counts[expected]++;
    corners += corner;
}

static void try_distance(fixture *f, fuzz_class kind) {
    const double *x = f->c.point;
    exact_body bodies[2] = {exact_body_of(&f->c.body[0]), exact_body_of(&f->c.body[1])};
    exact_value value[2] = {exact_distance(x, &bodies[0]), exact_distance(x, &bodies[1])};
    int expected = exact_compare(&value[0], &value[1]);
    double bound = fabs(f->c.direction[0]);
    int power = exact_shift(0, f->c.points, (size_t)(BODIES_POINTS * f->c.dim));
    exact_value limit = exact_value_of(bound, power);
    int beyond = exact_compare(&value[0], &limit);
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        f->context.first = first;
        geom_distance d[2];
        for (int i = 0; i < 2; i++) d[i] = geom_distance_from(&f->context, x, &f->c.body[i]);
        int got = geom_distance_compare(&f->context, x, &d[0], &d[1]);
        int got_beyond = geom_distance_compare_to(&f->context, x, &d[0], bound);
        double rounded = geom_distance_round(&f->context, x, &d[0]);
        if (got != expected || got_beyond != beyond || !exact_rounds_to(&value[0], rounded, power))
            fail_msg("%s: %s and %s: %d not %d, %d not %d, or %.17g", fuzz_names[kind],
                     froe_kind_name(f->c.body[0].form), froe_kind_name(f->c.body[1].form), got, expected, got_beyond,
                     beyond, rounded);
        num_ball image = geom_distance_image(&d[0]);
        if (isfinite(image.e) && isfinite(image.x) && rounded > 0)
            assert_true(rounded <= (image.x + image.e) * (1 + 0x1p-50) &&
                        rounded >= (image.x - image.e) * (1 - 0x1p-50));
        assert_int_equal(geom_distance_compare_to(&f->context, x, &d[0], INFINITY), -1);
        total++;
    }
    counts[1 + expected]++;
}

static void meetings_in_the_plane(void **state) {
    memset(counts, 0, sizeof counts);
    run_trials(*state, 2, 800, try_meeting);
    for (int i = 0; i < GEOM_CONTACTS; i++) assert_true(counts[i] > 20 / BODIES_SHARE);
}

static void meetings_in_space(void **state) {
    memset(counts, 0, sizeof counts);
    corners = 0;
    run_trials(*state, 3, 600, try_meeting);
    for (int i = 0; i < GEOM_CONTACTS; i++) assert_true(counts[i] > 20 / BODIES_SHARE);
    assert_true(corners > 20 / BODIES_SHARE);
}

static void meetings_in_five_dimensions(void **state) {
    memset(counts, 0, sizeof counts);
    run_trials(*state, 5, 800, try_meeting);
    assert_true(counts[GEOM_TOUCH] > 20 / BODIES_SHARE && counts[GEOM_OVERLAP] > 40 / BODIES_SHARE);
}

static void distances(void **state) {
    memset(counts, 0, sizeof counts);
    run_trials(*state, 2, 400, try_distance);
    run_trials(*state, 3, 400, try_distance);
    run_trials(*state, 5, 400, try_distance);
    for (int i = 0; i < 3; i++) assert_true(counts[i] > 20 / BODIES_SHARE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(meetings_in_the_plane, setup, teardown),
        cmocka_unit_test_setup_teardown(meetings_in_space, setup, teardown),
        cmocka_unit_test_setup_teardown(meetings_in_five_dimensions, setup, teardown),
        cmocka_unit_test_setup_teardown(distances, setup, teardown),
    };
    int failed = cmocka_run_group_tests_name("geom/meet", tests, NULL, NULL);
    print_message("%llu comparisons\n", (unsigned long long)total);
    return failed;
}
