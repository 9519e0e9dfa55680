/* test_change.c: segments come, go and get other plans while a partition follows them, against the oracle of the
 * present: several changes at one instant, plans that jump and plans that go on, on lattices, where all happens at
 * once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/changing.h"
#include "support/sanitized.h"

static froe_motion *motion_of_four(const double *coords, const double *times, const size_t *starts,
                                   const uint32_t *vertices) {
    froe_motion_options window = froe_motion_defaults();
    froe_motion *m = NULL;
    window.begin = 0, window.end = 16;
    assert_int_equal(froe_motion_new(&window, NULL, &m, NULL), FROE_OK);
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 4, b.count = 2, b.starts = starts, b.times = times, b.coords = coords, b.vertices = vertices;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static const size_t starts[] = {0, 2, 4, 6, 8};
static const double times[] = {0, 16, 0, 16, 0, 16, 0, 16};
static const double coords[] = {2, 1, 10, 1, 5, 1, -3, 9, 2, 0, 2, 8, 7, 2, -1, -6};

static froe_kinetic *partition_of(froe_motion *m, uint64_t seed, bool augmented) {
    froe_kinetic_options options = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    options.seed = seed, options.augmented = augmented;
    assert_int_equal(froe_kinetic_new(m, &options, NULL, &k, NULL), FROE_OK);
    return k;
}

/* Where two segments crossed before the jump was remembered as where they cross after it, at the same tick. */
static void test_no_crossing_of_an_old_plan_is_remembered(void **state) {
    (void)state;
    const uint32_t vertices[] = {1, 0, 3, 2};
    for (int augmented = 0; augmented < 2; augmented++) {
        froe_motion *m = motion_of_four(coords, times, starts, vertices);
        froe_kinetic *k = partition_of(m, 288, augmented);
        assert_int_equal(froe_kinetic_advance(k, 2, NULL, NULL, NULL), FROE_OK);
        const double now[] = {froe_kinetic_time(k), 16}, jump[] = {5, 0, 7, -4};
        assert_int_equal(froe_kinetic_replan(k, 3, 2, now, jump, NULL, NULL, NULL), FROE_OK);
        assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
}

/* A batch that is refused may have moved all plans in memory. */
static void test_plans_may_move_in_memory(void **state) {
    (void)state;
    enum { MANY = 4096 };
    static double many_times[2 * MANY], many_coords[4 * MANY];
    static size_t many_starts[MANY + 1];
    froe_motion *m = motion_of_four(coords, times, starts, NULL);
    froe_kinetic *k = partition_of(m, 1, false);
    for (size_t i = 0; i < MANY; i++) many_starts[i + 1] = 2 * i + 2, many_times[2 * i + 1] = 16;
    many_coords[4 * MANY - 1] = (double)NAN;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = MANY, b.count = MANY / 2;
    b.starts = many_starts, b.times = many_times, b.coords = many_coords;
    froe_kinetic_place place;
    assert_int_equal(froe_kinetic_locate(k, coords, &place, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_E_INPUT);
    assert_int_equal(froe_kinetic_locate(k, coords, &place, NULL), FROE_OK);
    many_coords[4 * MANY - 1] = 1;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_locate(k, coords, &place, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 9, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_audit(k, NULL), FROE_OK);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_segments_that_are_gone_need_no_plan(void **state) {
    (void)state;
    froe_motion *m = motion_of_four(coords, times, starts, NULL);
    froe_kinetic *k = partition_of(m, 1, false);
    const double when[] = {froe_kinetic_time(k), 8}, where[] = {1, 1, 2, 2};
    assert_int_equal(froe_kinetic_replan(k, 0, 2, when, where, NULL, NULL, NULL), FROE_E_INPUT);
    assert_int_equal(froe_kinetic_remove(k, 0, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_replan(k, 0, 2, when, where, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_advance(k, 16, NULL, NULL, NULL), FROE_OK);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void test_changes_against_the_oracle(void **state) {
    (void)state;
    enum { SHARE = SANITIZED_SHARE(3) };
    changing_counts sum = {0};
    beside_counts asked = {0};
    for (uint64_t seed = 1; seed <= 48; seed += SHARE) {
        changing c = {.random = {seed * 1000003}, .questions = 4};
        if (!changing_run(&c, 20)) fail_msg("seed %d: %s", (int)seed, c.all.why);
        sum.replans += c.counts.replans, sum.jumps += c.counts.jumps, sum.births += c.counts.births;
        sum.deaths += c.counts.deaths, sum.audits += c.counts.audits;
        asked.snapshots += c.all.counts.snapshots, asked.alike += c.all.counts.alike;
        asked.rays += c.all.counts.rays, asked.hits += c.all.counts.hits, asked.pairs += c.all.counts.pairs;
    }
    assert_true(sum.replans > 800 / SHARE && sum.jumps > 400 / SHARE && sum.audits > 1600 / SHARE);
    assert_true(sum.births > 400 / SHARE && sum.deaths > 200 / SHARE);
    assert_true(asked.alike > 800 / SHARE && asked.snapshots > asked.alike + 200 / SHARE);
    assert_true(asked.rays > 4800 / SHARE && asked.hits > asked.rays / 4 && asked.pairs > 800 / SHARE);
}

/* Where lines are parallel at a tick and cross just after it, and where a segment is upright at a tick alone, fragments
 * were told that end at 0 0, or that overlap. */
static void test_fragments_where_lines_are_parallel_at_a_tick(void **state) {
    (void)state;
    static const uint64_t seeds[] = {223, 558, 568, 668, 723, 743};
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        changing c = {.random = {seeds[i] * 1000003}, .questions = 6};
        if (!changing_run(&c, 20)) fail_msg("seed %d: %s", (int)seeds[i], c.all.why);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_no_crossing_of_an_old_plan_is_remembered),
                                       cmocka_unit_test(test_plans_may_move_in_memory),
                                       cmocka_unit_test(test_segments_that_are_gone_need_no_plan),
                                       cmocka_unit_test(test_changes_against_the_oracle),
                                       cmocka_unit_test(test_fragments_where_lines_are_parallel_at_a_tick)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
