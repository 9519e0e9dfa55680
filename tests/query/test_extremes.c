/* Ranges in scenes of every scale at once, by every walk, against brute force in whole numbers. Rays, locations,
 * nearest objects, pairs and groups are asked there by tests of their own. */
#include "query/ranges.h"
#include "query/tours.h"

static size_t decisions;

/* ------------------------------------------------------------------- truth -- */

/* A range as a body, where it is one. */
static geom_body body_of(const world *w, const question *q) {
    static const froe_kind forms[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BOX] = FROE_BOX,
                                                      [FROE_SHAPE_BALL] = FROE_BALL,
                                                      [FROE_SHAPE_SIMPLEX] = FROE_HULL,
                                                      [FROE_SHAPE_HULL] = FROE_HULL,
                                                      [FROE_SHAPE_SEGMENT] = FROE_SEGMENT};
    const uint32_t counts[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BOX] = 2,
                                               [FROE_SHAPE_BALL] = 1,
                                               [FROE_SHAPE_SIMPLEX] = (uint32_t)w->dim + 1,
                                               [FROE_SHAPE_HULL] = (uint32_t)q->range.count,
                                               [FROE_SHAPE_SEGMENT] = 2};
    const froe_range_shape shape = q->range.shape;
    return (geom_body){
        .form = forms[shape], .dim = w->dim, .count = counts[shape], .coords = q->points, .radius = q->range.radius};
}

static bool is_unbounded(const question *q, int dim) {
    for (int k = 0; k < 2 * dim && q->range.shape == FROE_SHAPE_BOX; k++)
        if (isinf(q->points[k])) return true;
    return false;
}

/* Whole numbers where the shape lets them: rationals of thousands of bits are slow. */
static bool truth_at_scale(const world *w, const question *q, uint32_t object) {
    const froe_range_shape shape = q->range.shape;
    if (shape == FROE_SHAPE_CAPSULE || shape == FROE_SHAPE_HALFSPACES || is_unbounded(q, w->dim))
        return truth(w, q, object);
    const int whole = exact_shift(exact_world_shift(w), q->points, MOST_POINTS * FROE_MAX_DIM),
              shift = exact_shift(whole, &q->range.radius, 1);
    exact_begin(shift);
    const geom_body body = scene_body(w->scene, object), range = body_of(w, q);
    const exact_body a = exact_body_of(&body);
    exact_value at;
    bool corner;
    if (shape == FROE_SHAPE_RAY) return exact_ray(q->points, q->points + w->dim, &a, &at);
    if (shape == FROE_SHAPE_BALL) {
        const exact_value reach = exact_value_of(q->range.radius, shift);
        at = exact_distance(q->points, &a);
        return exact_compare(&at, &reach) <= 0;
    }
    const exact_body b = exact_body_of(&range);
    return exact_contact(&a, &b, &corner) != 0;
}

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
                                    (froe_walk)(FROE_WALK_COUNT - 1), truth_at_scale);
    world_end(&w);
}

static void ranges_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_ranges, 12, 6);
}

static void check_balls(world w, int questions) {
    for (int i = 0; i < questions; i++)
        decisions +=
            ask_by(&w, FROE_SHAPE_BALL, (uint64_t)i, FROE_WALK_AUTO, (froe_walk)(FROE_WALK_COUNT - 1), truth_at_scale);
    world_end(&w);
}

static void balls_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_balls, 40, 10);
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
            decisions += ask_by(&w, FROE_SHAPE_BALL, i, FROE_WALK_AUTO, FROE_WALK_AUTO, truth_at_scale);
        world_end(&w);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_across_very_short_segments),
        cmocka_unit_test(balls_at_every_scale),
        cmocka_unit_test(ranges_at_every_scale),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    print_message("%zu decisions\n", decisions);
    return failed;
}
