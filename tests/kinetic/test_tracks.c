/* test_tracks.c: segments on tracks of many pieces, as they are sampled from cars and bodies: at common times, or each
 * at its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/kinetic.h"
#include "support/fuzz.h"

enum { MOST = 400, PIECES = 30, KNOTS = PIECES + 1 };

/* From 0 to 1. */
static double share(fuzz_source *r) {
    return 0.5 + 0.5 * fuzz_unit(r);
}

/* Short segments anywhere in the unit square, each on its way through a tenth of it, from time 0 to 1. */
static froe_motion *tracks(uint32_t n, bool together) {
    static double times[2 * MOST * KNOTS], xy[4 * MOST * KNOTS];
    static size_t starts[2 * MOST + 1];
    fuzz_source r = {n};
    froe_motion_options window = froe_motion_defaults();
    froe_moving batch = froe_moving_defaults();
    froe_motion *m = NULL;
    window.begin = 0, window.end = 1;
    assert_int_equal(froe_motion_new(&window, NULL, &m, NULL), FROE_OK);
    for (uint32_t s = 0; s < n; s++) {
        double at[2], half[2], way[2];
        const double late = together ? 0 : 0.8 * (share(&r) - 0.5);
        for (int c = 0; c < 2; c++) {
            at[c] = share(&r), way[c] = 0.2 * (share(&r) - 0.5);
            half[c] = 0.7 / sqrt(n) * (share(&r) - 0.5);
        }
        for (uint32_t j = 0; j < KNOTS; j++)
            for (uint32_t e = 0; e < 2; e++) {
                const size_t knot = (2 * s + e) * (size_t)KNOTS + j;
                times[knot] = j ? j < PIECES ? (j + late) / PIECES : 1 : 0;
                for (uint32_t c = 0; c < 2; c++) {
                    at[c] += (way[c] + 0.1 * (share(&r) - 0.5)) / KNOTS;
                    xy[2 * knot + c] = at[c] + (e ? half[c] : -half[c]);
                }
            }
    }
    for (uint32_t v = 0; v <= 2 * n; v++) starts[v] = v * (size_t)KNOTS;
    batch.vertex_count = 2 * (size_t)n, batch.count = n;
    batch.starts = starts, batch.times = times, batch.coords = xy;
    assert_int_equal(froe_motion_add(m, &batch, NULL), FROE_OK);
    return m;
}

static froe_kinetic *partition(froe_motion *m, bool augmented) {
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    o.augmented = augmented;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    return k;
}

typedef struct instant {
    size_t events, plans;
    uint32_t last; /* whose plan went on */
    bool in_order;
} instant;

static bool see_plans(void *user, const froe_event *event) {
    instant *i = user;
    i->events++;
    if (event->kind != FROE_EVENT_PLAN) return true;
    i->in_order &= !i->plans || i->last < event->objects[0];
    i->last = event->objects[0];
    i->plans++;
    return true;
}

/* Lemma 3.1: only certificates change. */
static void plans_that_go_on_touch_no_node(void **state) {
    (void)state;
    for (int together = 0; together < 2; together++) {
        const uint32_t n = together ? 300 : 60;
        froe_motion *m = tracks(n, together);
        froe_kinetic *k = partition(m, false);
        size_t alone = 0, still = 0, plans = 0;
        while (froe_kinetic_next(k) <= 1) {
            instant i = {0, 0, 0, true};
            const uint64_t before = froe_kinetic_statistics(k).nodes_touched;
            assert_int_equal(froe_kinetic_advance(k, froe_kinetic_next(k), see_plans, &i, NULL), FROE_OK);
            assert_true(i.in_order);
            plans += i.plans;
            if (i.plans || !together) assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
            if (!i.plans || i.plans < i.events) continue;
            alone++;
            still += froe_kinetic_statistics(k).nodes_touched == before;
        }
        assert_int_equal(plans, n * (PIECES - 1));
        assert_true(alone >= PIECES - 5 && still == alone);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

typedef struct witness {
    const froe_motion *motion;
    size_t passed, seen;
} witness;

/* Does an end of a pass an end of b? */
static bool ends_pass(const froe_motion *m, const froe_event *e) {
    for (int i = 0; i < 4; i++) {
        int side[2];
        for (int late = 0; late < 2; late++) {
            double p[2], q[2];
            const double time = late ? e->late : e->early;
            froe_motion_position(m, froe_motion_object(m, e->objects[0]).vertices[i / 2], time, p);
            froe_motion_position(m, froe_motion_object(m, e->objects[1]).vertices[i % 2], time, q);
            side[late] = (p[0] > q[0]) - (p[0] < q[0]);
        }
        if (side[0] != side[1]) return true;
    }
    return false;
}

static bool see_ends(void *user, const froe_event *event) {
    witness *w = user;
    if (event->kind != FROE_EVENT_VERTICES) return true;
    w->seen++;
    w->passed += ends_pass(w->motion, event);
    return true;
}

/* Where a segment left for another piece, two ends that were then next to each other and had passed since the last
 * event were told to pass when it entered again. */
static void ends_pass_between_the_times_of_their_event(void **state) {
    (void)state;
    for (int augmented = 0; augmented < 2; augmented++) {
        froe_motion *m = tracks(100, false);
        froe_kinetic *k = partition(m, augmented);
        witness w = {m, 0, 0};
        assert_int_equal(froe_kinetic_advance(k, 1, see_ends, &w, NULL), FROE_OK);
        assert_true(w.seen > 500);
        assert_int_equal(w.passed, w.seen);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(plans_that_go_on_touch_no_node),
                                       cmocka_unit_test(ends_pass_between_the_times_of_their_event)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
