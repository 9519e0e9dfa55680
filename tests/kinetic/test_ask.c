/* test_ask.c: questions to partitions of moving segments, against all segments one by one in exact numbers; snapshots,
 * against the live partition node for node. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "kinetic/beside.h"
#include "kinetic/moving.h"

/* ------------------------------------------------------------------ snapshots -- */

static void check_snapshot(froe_kinetic *k) {
    froe_snapshot s = {0};
    assert_int_equal(froe_kinetic_snapshot(k, NULL, &s, NULL), FROE_OK);
    assert_int_equal(s.rounded, 0);
    assert_true(s.alike);
    froe_tree_free(s.tree);
    froe_places_free(s.places);
}

/* ------------------------------------------------------------------------ runs -- */

/* At a vertex, on a segment, above or below an end, or anywhere on the lattice of halves. */
static void any_spot(const froe_kinetic *k, fuzz_source *r, int grid, double at[2]) {
    const froe_moving_object o =
        froe_motion_object(k->now.motion, (uint32_t)fuzz_int(r, 0, (int)froe_motion_object_count(k->now.motion) - 1));
    const int what = fuzz_int(r, 0, 4);
    double end[2][2];
    bool there = true;
    for (int e = 0; e < 2; e++)
        there = there && froe_motion_position(k->now.motion, o.vertices[e], froe_kinetic_time(k), end[e]);
    for (int c = 0; c < 2; c++) {
        at[c] = 0.5 * fuzz_int(r, -grid, 2 * grid);
        if (!there || what > 2) continue;
        if (what == 0) at[c] = end[0][c];
        if (what == 1) at[c] = 0.5 * (end[0][c] + end[1][c]);
        if (what == 2) at[c] = end[c][c] + (c ? fuzz_int(r, -1, 1) : 0);
    }
}

static const moving_kind kinds[] = {
    {.name = "lattice", .count = 24, .grid = 8, .length = 4, .speed = 1, .spin = 1},
    {.name = "no turns", .count = 30, .grid = 8, .length = 4, .speed = 1},
    {.name = "upright", .count = 24, .grid = 12, .length = 8, .speed = 1, .upright = true},
    {.name = "chains", .count = 25, .grid = 20, .length = 6, .speed = 1, .spin = 1, .chains = true},
    {.name = "lanes", .count = 24, .grid = 12, .length = 5, .speed = 2, .spin = 1, .lanes = true},
    {.name = "mortal", .count = 24, .grid = 16, .length = 6, .speed = 2, .spin = 1, .mortal = true},
    {.name = "loose", .count = 30, .grid = 200, .length = 60, .speed = 5, .spin = 3},
};

static void ask(beside *b, fuzz_source *r, int grid) {
    present p;
    beside_look(b, &p);
    for (int j = 0; j < 60; j++) {
        double from[2], to[2];
        any_spot(b->kinetic, r, grid, from), any_spot(b->kinetic, r, grid, to);
        if (!beside_locate(b, &p, from) || !beside_ray(b, &p, from, to)) fail_msg("%s", b->why);
        if (j % 10 == 0 && !beside_order(b, &p, from, to)) fail_msg("%s", b->why);
    }
    present_clear(&p);
}

/* Ticks are fine, or as long as it takes for much to be aligned at them. */
static void test_against_all(void **state) {
    (void)state;
    beside_counts sum = {0};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (uint64_t seed = 1; seed <= 3; seed++) {
            moving_kind kind = kinds[i];
            kind.tick = (double[]){0, 0.25, 1}[seed % 3];
            beside b = {.motion = moving_new(&kind, seed, NULL)};
            froe_kinetic_options options = froe_kinetic_defaults();
            fuzz_source r = {seed + 100 * i};
            options.seed = seed;
            options.augmented = seed % 2;
            assert_int_equal(froe_kinetic_new(b.motion, &options, NULL, &b.kinetic, NULL), FROE_OK);
            for (double time = 0; time < 12; time += 0.7) {
                assert_int_equal(
                    froe_kinetic_advance(b.kinetic, fmax(time, froe_kinetic_time(b.kinetic)), NULL, NULL, NULL),
                    FROE_OK);
                ask(&b, &r, kind.grid);
                if (kind.tick == 0) check_snapshot(b.kinetic);
            }
            assert_int_equal(froe_kinetic_audit(b.kinetic, NULL), FROE_OK);
            sum.rays += b.counts.rays, sum.hits += b.counts.hits, sum.pairs += b.counts.pairs;
            froe_kinetic_free(b.kinetic);
            froe_motion_free(b.motion);
        }
    assert_true(sum.hits > sum.rays / 4 && sum.hits < sum.rays);
    assert_true(sum.pairs > 1000);
}

/* ------------------------------------------------------------------- instants -- */

typedef struct timing {
    froe_kinetic *k;
    unsigned exact, contacts;
} timing;

/* At the end of a bar that falls on a floor, the time of its contact is known. */
static bool time_it(void *user, const froe_event *event) {
    timing *t = user;
    double at[2];
    assert_int_equal(froe_kinetic_instant(t->k, at, NULL), FROE_OK);
    assert_true(at[0] <= at[1] && at[0] >= event->early - 1e-9 && at[1] <= event->late + 1e-9);
    if (event->kind != FROE_EVENT_CONTACT) return true;
    const double truth[3] = {3, 64.0 / 3, 16 * sqrt(2)}; /* y = 3 - t; 64 - 3 t; 32 - t^2 / 16 */
    for (int i = 0; i < 3; i++)
        if (fabs(at[0] - truth[i]) < 1e-6) {
            assert_true(at[0] <= nextafter(truth[i], 99) && at[1] >= nextafter(truth[i], 0));
            assert_true(at[1] <= nextafter(at[0], 99));
            t->exact += at[0] == at[1];
            t->contacts++;
        }
    return true;
}

static void test_instants(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 4, 6, 8, 10, 12, 14};
    const double times[] = {0, 0, 0, 64, 0, 64, 0, 64, 0, 64, 0, 64, 0, 64};
    const double coords[] = {-100, 0,    100, 0,  0,  3,  0,  -61, 1,  9,    1,  9,  10, 64,
                             10,   -128, 11,  80, 11, 80, 20, 32,  20, -224, 21, 90, 21, 90};
    double controls[28];
    for (int i = 0; i < 28; i++) controls[i] = (double)NAN;
    controls[20] = 20, controls[21] = 32; /* at rest at first */
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    w.begin = 0, w.end = 64;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 8, b.count = 4, b.starts = starts, b.times = times, b.coords = coords, b.controls = controls;
    froe_diagnostic why = {0};
    if (froe_motion_add(m, &b, &why)) fail_msg("%s", why.message);
    froe_kinetic_options o = froe_kinetic_defaults();
    timing t = {0};
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &t.k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(t.k, 64, time_it, &t, NULL), FROE_OK);
    assert_int_equal(t.contacts, 3);
    assert_int_equal(t.exact, 1);
    double at[2];
    assert_int_equal(froe_kinetic_instant(t.k, at, NULL), FROE_E_ARG);
    froe_kinetic_free(t.k);
    froe_motion_free(m);
}

/* What is straight above and below points over and under the ends of two floors. */
static void test_up_is_inclined_to_the_left(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 3, 4};
    const double times[4] = {0}, coords[] = {0, 5, 4, 5, 0, -5, 4, -5};
    froe_motion_options window = froe_motion_defaults();
    window.begin = 0, window.end = 1;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&window, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    const uint32_t above[3] = {FROE_NONE, 0, 0}, below[3] = {1, 1, FROE_NONE};
    for (int i = 0; i < 3; i++) {
        froe_kinetic_place place;
        assert_int_equal(froe_kinetic_locate(k, (double[]){2.0 * i, 0}, &place, NULL), FROE_OK);
        assert_int_equal(place.on, FROE_NONE);
        assert_int_equal(place.above, above[i]);
        assert_int_equal(place.below, below[i]);
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_refusals(void **state) {
    (void)state;
    froe_motion *m = moving_new(kinds, 1, NULL);
    froe_kinetic_options options = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_kinetic_place place;
    uint32_t hit;
    const double good[2] = {1, 2}, bad[2] = {1, (double)NAN}, far[2] = {(double)INFINITY, 0};
    assert_int_equal(froe_kinetic_new(m, &options, NULL, &k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_locate(k, bad, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_locate(NULL, good, &place, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_locate(k, good, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_ray(k, good, far, &hit, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_order(k, good, NULL, NULL, NULL), FROE_E_ARG);
    froe_snapshot snapshot;
    assert_int_equal(froe_kinetic_snapshot(k, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_snapshot(NULL, NULL, &snapshot, NULL), FROE_E_ARG);
    assert_int_equal(froe_kinetic_snapshot(k, &(froe_snapshot_options){.size = 1}, &snapshot, NULL), FROE_E_OPTIONS);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_against_all), cmocka_unit_test(test_instants),
                                       cmocka_unit_test(test_up_is_inclined_to_the_left),
                                       cmocka_unit_test(test_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
