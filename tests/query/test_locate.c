/* Locating points against brute force in rationals, and batches against single queries. */
#include "query/standing.h"
#include "query/tours.h"

enum { DECISIONS = 1000000 };

static int begin(void **state) {
    (void)state;
    standing_add("lattice", world_mixture(2, FLAT_KINDS, 80, 12, 0.4, 2), true);
    standing_add("solids in the plane", world_mixture(2, FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL, 60, 0, 0.4, 3),
                 false);
    standing_add("lattice of solids", world_mixture(2, FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL, 40, 12, 0.5, 4),
                 true);
    standing_add("lattice in space", world_mixture(3, FLAT_KINDS | 1 << FROE_POLYGON, 40, 6, 0.6, 6), true);
    standing_add("solids in space", world_mixture(3, SOLID_KINDS | 1 << FROE_HULL, 50, 0, 0.5, 7), false);
    standing_add("floor plan", world_read("freedoom-e1m1.geojson"), false);
    return 0;
}

/* point: x as a set, up to three dimensions */
static bool holds(const world *w, uint32_t object, const double *x, const oracle_set *point) {
    const froe_object o = froe_scene_object(w->scene, object);
    if (w->dim <= 3) return oracle_meet(&w->objects[object], point);
    const double *lo = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 0));
    const double *hi = o.form == FROE_BOX ? froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 1)) : lo;
    return oracle_meet_boxes(w->dim, lo, hi, o.radius, x, x, 0);
}

static size_t locate(const world *w, uint64_t seed, size_t *held) {
    world_dice d = {seed, 0};
    double x[FROE_MAX_DIM];
    bool *found = calloc(w->count, sizeof *found);
    world_point(w, &d, x);
    oracle_set point = oracle_points(w->dim <= 3 ? w->dim : 3, x, 1, 0);
    for (size_t t = 0; t < w->tree_count; t++) {
        froe_list list;
        assert_int_equal(froe_query_locate(w->queries[t], x, &list, NULL), FROE_OK);
        memset(found, 0, w->count * sizeof *found);
        for (size_t i = 0; i < list.count; i++) {
            assert_false(found[list.ids[i]]);
            found[list.ids[i]] = true;
        }
        for (uint32_t i = 0; i < w->count; i++)
            if (found[i] != holds(w, i, x, &point))
                fail_msg("%s, tree %zu: object %u is%s found at %a %a", w->name, t, i, found[i] ? "" : " not", x[0],
                         x[1]);
        *held += list.count;
    }
    oracle_set_free(&point);
    free(found);
    return w->count * w->tree_count;
}

static void points_are_found_in_what_contains_them(void **state) {
    size_t decisions = 0, held = 0;
    (void)state;
    for (uint64_t seed = 0; decisions < DECISIONS; seed++)
        for (size_t i = 0; i < world_count; i++) decisions += locate(&worlds[i], 100 * seed + i, &held);
    print_message("%zu decisions\n", decisions);
    assert_true(held > 1000);
}

static size_t held_at_limits;

static size_t locate_in(const char *name, froe_scene *scene, uint64_t points) {
    world w = world_begin(name, scene);
    size_t decisions = 0;
    for (uint64_t seed = 0; seed < points; seed++) decisions += locate(&w, seed, &held_at_limits);
    world_end(&w);
    return decisions;
}

static void points_are_found_at_the_limits(void **state) {
    size_t decisions = 0;
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const unsigned kinds = FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL | (dim == 3 ? 1u << FROE_POLYGON : 0);
        froe_scene *unit = world_mixture(dim, kinds, 8, 0, 0.5, 9), *lattice = world_mixture(dim, kinds, 8, 6, 0.6, 9);
        locate_in("nothing", world_mixture(dim, 0, 0, 0, 0, 1), 10);
        for (int kind = 0; kind < FROE_KIND_COUNT; kind++)
            if (kinds >> kind & 1) decisions += locate_in("one", world_mixture(dim, 1u << kind, 1, 3, 1, 1), 60);
        decisions += locate_in("around 1e300", world_scaled(unit, 1000), 15);
        decisions += locate_in("around 1e-307", world_scaled(unit, -1020), 15);
        decisions += locate_in("denormals", world_scaled(lattice, -1074), 15);
        decisions += locate_in("a lattice around 1e307", world_scaled(lattice, 1019), 15);
        froe_scene_free(unit);
        froe_scene_free(lattice);
    }
    decisions += locate_in("a map", world_read("states-albers-10m.json"), 1);
    decisions += locate_in("boxes of a house", world_read("fzk-haus-boxes.csv"), 60);
    print_message("%zu decisions at the limits, %zu held\n", decisions, held_at_limits);
    assert_true(decisions > 80000 && held_at_limits > 500);
}

static void check_extremes(world w, int points) {
    for (uint64_t seed = 0; seed < (uint64_t)points; seed++) locate(&w, seed, &held_at_limits);
    world_end(&w);
}

static void points_are_found_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_extremes, 27, 20);
}

static void points_outside_and_bad_points(void **state) {
    const double far[3] = {1e300, -1e300, 1e300}, bad[3] = {0, NAN, 0};
    froe_list list;
    froe_diagnostic diag;
    (void)state;
    for (size_t i = 0; i < world_count; i++)
        for (size_t t = 0; t < worlds[i].tree_count; t++) {
            assert_int_equal(froe_query_locate(worlds[i].queries[t], far, &list, NULL), FROE_OK);
            assert_int_equal(list.count, 0);
        }
    assert_int_equal(froe_query_locate(worlds[0].queries[0], bad, &list, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "Coordinate 1 of a point is nan, not a finite number.");
    assert_int_equal(froe_query_locate(worlds[0].queries[0], NULL, &list, NULL), FROE_E_ARG);
}

/* ------------------------------------------------------------------ batches -- */

enum { MANY = 1500 };

static void batches_answer_as_single_queries_with_any_number_of_threads(void **state) {
    const world *w = &worlds[1];
    static question questions[MANY];
    static froe_range ranges[MANY];
    static double points[2 * MANY];
    (void)state;
    for (size_t i = 0; i < MANY; i++) {
        world_dice d = {i, 5};
        make(w, &d, (froe_range_shape)(i % FROE_SHAPE_COUNT), &questions[i]);
        ranges[i] = questions[i].range;
        world_point(w, &d, points + 2 * i);
    }
    for (unsigned threads = 1; threads <= 4; threads += 3)
        for (int kind = 0; kind < 2; kind++) {
            froe_batch_options o = froe_batch_defaults();
            froe_answers answers;
            froe_list list;
            o.threads = threads;
            froe_query_statistics(w->queries[0]);
            if (kind)
                assert_int_equal(froe_batch_range(w->queries[0], ranges, MANY, &o, &answers, NULL), FROE_OK);
            else
                assert_int_equal(froe_batch_locate(w->queries[0], points, MANY, &o, &answers, NULL), FROE_OK);
            assert_int_equal(froe_query_statistics(w->queries[0]).queries, MANY);
            assert_int_equal(answers.queries, MANY);
            for (size_t i = 0; i < MANY; i++) {
                if (kind)
                    assert_int_equal(froe_query_range(w->queries[0], &ranges[i], &list, NULL), FROE_OK);
                else
                    assert_int_equal(froe_query_locate(w->queries[0], points + 2 * i, &list, NULL), FROE_OK);
                assert_int_equal(answers.starts[i + 1] - answers.starts[i], list.count);
                if (list.count)
                    assert_memory_equal(answers.ids + answers.starts[i], list.ids, list.count * sizeof *list.ids);
            }
            froe_answers_free(&answers);
        }
    for (size_t i = 0; i < MANY; i++) oracle_set_free(&questions[i].set);
}

static void the_first_bad_query_of_a_batch_is_named(void **state) {
    static double points[2 * MANY];
    froe_answers answers = {.queries = 77};
    froe_diagnostic diag;
    froe_batch_options raw = {0};
    (void)state;
    points[2 * 700 + 1] = NAN;
    points[2 * 1400] = INFINITY;
    assert_int_equal(froe_batch_locate(worlds[0].queries[0], points, MANY, NULL, &answers, &diag), FROE_E_INPUT);
    assert_int_equal(diag.object, 700);
    assert_int_equal(answers.queries, 77);
    assert_int_equal(froe_batch_locate(worlds[0].queries[0], points, 1, &raw, &answers, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_batch_locate(worlds[0].queries[0], points, 0, NULL, &answers, NULL), FROE_OK);
    assert_int_equal(answers.starts[0], 0);
    froe_answers_free(&answers);
    froe_answers_free(NULL);
}

static froe_status locate_many(void *user, const froe_allocator *alloc) {
    static double points[2 * 600];
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    froe_answers answers = {0};
    froe_build_options build = froe_build_defaults();
    froe_batch_options o = froe_batch_defaults();
    (void)user;
    build.method = "autopartition";
    build.threads = 1;
    o.threads = 2;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 9, 3, 0.9, 1);
    if (!status) status = froe_build(scene, &build, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = froe_batch_locate(q, points, 600, &o, &answers, NULL);
    froe_answers_free(&answers);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void batches_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(locate_many, NULL) > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_found_in_what_contains_them),
        cmocka_unit_test(points_are_found_at_the_limits),
        cmocka_unit_test(points_are_found_at_every_scale),
        cmocka_unit_test(points_outside_and_bad_points),
        cmocka_unit_test(batches_answer_as_single_queries_with_any_number_of_threads),
        cmocka_unit_test(the_first_bad_query_of_a_batch_is_named),
        cmocka_unit_test(batches_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, begin, standing_end);
}
