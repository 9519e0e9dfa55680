/* Ranges in scenes of every scale at once, by every walk, against brute force in whole numbers. Rays, locations,
 * nearest objects, pairs and groups are asked there by tests of their own. */
#include "query/answers.h"
#include "query/tours.h"

static size_t decisions;

/* ------------------------------------------------------------------- cases -- */

/* Rationals are asked for less often. */
static bool is_due(const world *w, int i, froe_range_shape shape) {
    if (w->dim > 3) return shape == FROE_SHAPE_BOX || shape == FROE_SHAPE_BALL;
    return i % 6 == 0 || (shape != FROE_SHAPE_CAPSULE && shape != FROE_SHAPE_HALFSPACES);
}

static void check_ranges(world w, int questions) {
    for (int i = 0; i < questions; i++)
        for (int shape = 0; shape < FROE_SHAPE_COUNT; shape++)
            if (is_due(&w, i, (froe_range_shape)shape))
                decisions += ask_by(&w, (froe_range_shape)shape, 100 * (uint64_t)i + (uint64_t)shape, FROE_WALK_AUTO,
                                    (froe_walk)(FROE_WALK_COUNT - 1), exact_range_meets);
    world_end(&w);
}

static void ranges_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_ranges, 9, 3);
}

static void check_balls(world w, int questions) {
    for (int i = 0; i < questions; i++)
        decisions += ask_by(&w, FROE_SHAPE_BALL, (uint64_t)i, FROE_WALK_AUTO, (froe_walk)(FROE_WALK_COUNT - 1),
                            exact_range_meets);
    world_end(&w);
}

static void balls_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_balls, 18, 10);
}

/* Segments of the unit square, the first so short that the square of its length underflows. */
static froe_scene *short_and_long(uint64_t seed) {
    fuzz_source r = {base_hash(seed, 82, 0)};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0, count = fuzz_int(&r, 2, 5); i < count; i++) {
        const double scale = i ? 1 : ldexp(1, fuzz_int(&r, -1060, -500));
        double x[4] = {fuzz_int(&r, 0, 1) * fuzz_unit(&r), fuzz_int(&r, 0, 1)};
        extreme_beside(&r, 2, x, scale, x + 2);
        if (fuzz_int(&r, 0, 1)) x[3] = x[1];
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, x, NULL, NULL), FROE_OK);
    }
    return scene;
}

static void balls_across_very_short_segments(void **state) {
    const uint64_t first = extreme_seed(), last = first + 100 * extreme_rounds();
    (void)state;
    for (uint64_t seed = first; seed < last; seed++) {
        char name[64];
        snprintf(name, sizeof name, "short and long, FROE_SEED=%llu", (unsigned long long)seed);
        world w = world_begin(name, short_and_long(seed));
        w.scale = 4; /* balls of about the size of the scene, around it */
        for (uint64_t i = 0; i < 6; i++)
            decisions += ask_by(&w, FROE_SHAPE_BALL, i, FROE_WALK_AUTO, FROE_WALK_AUTO, exact_range_meets);
        world_end(&w);
    }
}

/* ---------------------------------------------------------------- all queries -- */

/* Vertical searches, points, neighbours, rays, pairs, groups, counts and batches, too. */
static void check_everything(world w, int rounds) {
    for (size_t t = 0; t < w.tree_count; t++) {
        char why[200];
        if (!answers_right_at_every_scale(w.queries[t], t, rounds, why, sizeof why))
            fail_msg("%s, by %s: %s", w.name, froe_tree_report(w.trees[t]).method, why);
        decisions += w.count * (size_t)rounds;
    }
    world_end(&w);
}

static void every_query_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_everything, 18, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_across_very_short_segments),
        cmocka_unit_test(balls_at_every_scale),
        cmocka_unit_test(ranges_at_every_scale),
        cmocka_unit_test(every_query_at_every_scale),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    print_message("%zu decisions\n", decisions);
    return failed;
}
