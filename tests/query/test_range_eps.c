/* Approximate ranges: all that meet, and nothing further away than eps times the diameter. */
#include "query/exact_ranges.h"
#include "query/standing.h"
#include "query/tours.h"

static size_t decisions, beyond;

/* What brute force says about an object, as far as it has been asked. */
typedef enum verdict { UNKNOWN, MEETS, NEAR, FAR } verdict;

/* Nothing is too far from a range grown beyond all doubles. */
static verdict judge(const world *w, const question *q, const oracle_set *grown, uint32_t object) {
    if ((w->extreme ? exact_range_meets : truth)(w, q, object)) return MEETS;
    return !isfinite(grown->radius) || oracle_meet(&w->objects[object], grown) ? NEAR : FAR;
}

/* False: the range is refused. */
static bool check_tree(const world *w, size_t t, const question *q, const oracle_set *grown, verdict *verdicts,
                       size_t *more) {
    froe_list list;
    if (froe_query_range(w->queries[t], &q->range, &list, NULL)) return false;
    decisions += w->count;
    bool *found = calloc(w->count + 1, sizeof *found);
    for (size_t i = 0; i < list.count; i++) {
        assert_false(found[list.ids[i]]);
        found[list.ids[i]] = true;
    }
    for (uint32_t i = 0; i < w->count; i++) {
        if (!verdicts[i]) verdicts[i] = judge(w, q, grown, i);
        if (found[i] ? verdicts[i] == FAR : verdicts[i] == MEETS) explain(w, q, t, i, found[i]);
        *more += found[i] && verdicts[i] == NEAR;
    }
    free(found);
    return true;
}

/** All that meet, and nothing further away than eps times the diameter. */
static void check_eps(const world *w, froe_range_shape shape, uint64_t seed, double eps, size_t *more) {
    world_dice d = {seed, 0};
    question q;
    make(w, &d, shape, &q);
    q.range.eps = eps;
    double quarter = 0;                   /* of the diameter */
    if (shape == FROE_SHAPE_HALFSPACES) { /* all of them */
        static const double lo[3] = {-1e9, -1e9, -1e9}, hi[3] = {1e9, 1e9, 1e9};
        oracle_set_free(&q.set);
        q.set = oracle_halfspaces(w->dim, q.points, q.offsets, q.range.count, lo, hi);
    }
    for (size_t i = 0; i < q.set.count; i++)
        for (size_t j = 0; j < i; j++) {
            double length = 0; /* hypot() squares nothing that overflows */
            for (size_t k = 0; k < (size_t)w->dim; k++)
                length = hypot(length,
                               0.25 * q.set.image[i * (size_t)w->dim + k] - 0.25 * q.set.image[j * (size_t)w->dim + k]);
            quarter = fmax(quarter, length);
        }
    oracle_set grown = q.set;
    grown.radius += 4 * eps * (quarter + 0.5 * grown.radius) * (1 + 1e-12) + 0x1p-1072;
    verdict *verdicts = calloc(w->count + 1, sizeof *verdicts);
    for (size_t t = 0; t < w->tree_count; t++)
        if (!check_tree(w, t, &q, &grown, verdicts, more)) break; /* unbounded */
    free(verdicts);
    oracle_set_free(&q.set);
}

static void approximate_answers_keep_their_contract(void **state) {
    (void)state;
    for (int shape = 0; shape <= FROE_SHAPE_HULL; shape++) {
        size_t more = 0;
        for (uint64_t seed = 0; seed < 7; seed++)
            for (size_t i = 0; i < world_count; i++)
                check_eps(&worlds[i], (froe_range_shape)shape, 7000 * seed + i, seed % 2 ? 0.5 : 0.05, &more);
        assert_true(more > 0); /* otherwise nothing was tested */
    }
    assert_true(decisions > 1000000);
}

static void check_world(const char *name, froe_scene *scene, uint64_t seeds) {
    world w = world_begin(name, scene);
    size_t more = 0;
    for (uint64_t seed = 0; seed < seeds; seed++)
        for (int shape = 0; shape <= FROE_SHAPE_HULL; shape++)
            if (shape != FROE_SHAPE_HALFSPACES)
                check_eps(&w, (froe_range_shape)shape, seed, seed % 2 ? 0.5 : 0.05, &more);
    world_end(&w);
}

static void at_the_limits_they_keep_it_too(void **state) {
    const size_t before = decisions;
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const unsigned kinds = FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL;
        froe_scene *unit = world_mixture(dim, kinds, 8, 0, 0.5, 9);
        check_world("nothing", world_mixture(dim, 0, 0, 0, 0, 1), 2);
        check_world("one object", world_mixture(dim, 1 << FROE_SEGMENT, 1, 0, 0.5, 1), 8);
        check_world("around 1e-60", world_scaled(unit, -200), 2);
        check_world("around 1e60", world_scaled(unit, 200), 2);
        froe_scene_free(unit);
    }
    check_world("boxes of a house", world_read("fzk-haus-boxes.csv"), 2);
    assert_true(decisions - before > 10000);
}

/* Diameters that are denormal, or overflow, and objects of every size around. */
static void check_extremes(world w, int rounds) {
    size_t more = 0;
    for (uint64_t seed = 0; seed < (uint64_t)rounds && w.dim <= 3; seed++)
        for (int shape = 0; shape <= FROE_SHAPE_HULL; shape++)
            if (shape != FROE_SHAPE_HALFSPACES && shape != FROE_SHAPE_CAPSULE)
                check_eps(&w, (froe_range_shape)shape, seed, seed % 2 ? 0.5 : 0.05, &more);
    world_end(&w);
    beyond += more;
}

static void at_every_scale_they_keep_it_too(void **state) {
    (void)state;
    tour_extremes(check_extremes, 9, 2);
    assert_true(EXACT_SHARE > 1 || beyond > 4);
}

/* With the name of a case as argument: that case alone. */
int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(approximate_answers_keep_their_contract),
        cmocka_unit_test(at_the_limits_they_keep_it_too),
        cmocka_unit_test(at_every_scale_they_keep_it_too),
    };
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    return cmocka_run_group_tests(tests, standing_begin, standing_end);
}
