/* The nearest objects, against brute force in whole numbers: every builder; points anywhere, on vertices and cuts,
 * at equal distances from several objects, far outside. */
#include "query/context.h"
#include "query/tours.h"
#include "support/rational.h"

static uint64_t decisions, ties;

/** An object and its distance, times 2^shift, by the oracle. */
typedef struct item {
    uint32_t object;
    exact_value distance;
} item;

typedef struct ask {
    double point[FROE_MAX_DIM], bound;
    size_t k;
} ask;

static void draw(const world *w, world_dice *d, ask *a) {
    static const size_t counts[] = {1, 1, 2, 5, 1000};
    world_point(w, d, a->point);
    if (world_below(d, 8) == 0)
        for (int k = 0; k < w->dim; k++) a->point[k] += w->scale * 3;
    for (int k = 0; k < w->dim; k++)
        if (!isfinite(a->point[k])) a->point[k] = w->origin[k];
    a->k = counts[world_below(d, 5)];
    a->bound = world_below(d, 3) ? INFINITY : world_below(d, 2) ? 0 : w->scale * 0.25;
    if (w->extreme && !isinf(a->bound)) a->bound = world_length(w, d, 1, a->point);
    if (w->lattice && !isinf(a->bound)) a->bound = floor(a->bound);
}

/** Where an item belongs among those sorted by distance, then number; it has the highest number. */
static size_t place_of(const item *x, const item *sorted, size_t count) {
    size_t low = 0;
    while (low < count) {
        const size_t middle = (low + count) / 2;
        if (exact_compare(&x->distance, &sorted[middle].distance) < 0)
            count = middle;
        else
            low = middle + 1;
    }
    return low;
}

/** The first k objects within the bound. */
static size_t brute_force(const world *w, const ask *a, const exact_body *bodies, int shift, item *out) {
    size_t count = 0;
    exact_value bound = exact_value_of(isinf(a->bound) ? 1 : a->bound, shift);
    for (uint32_t i = 0; i < w->count; i++) {
        const size_t mark = exact_mark();
        const exact_value distance = exact_distance(a->point, &bodies[i]);
        item x = {i, exact_keep(mark, &distance)};
        decisions += w->tree_count;
        if (!isinf(a->bound) && exact_compare(&x.distance, &bound) > 0) continue;
        const size_t at = place_of(&x, out, count);
        ties += at && !exact_compare(&x.distance, &out[at - 1].distance);
        if (at >= a->k) continue;
        count += count < a->k;
        memmove(out + at + 1, out + at, (count - 1 - at) * sizeof *out);
        out[at] = x;
    }
    return count;
}

static void check_tree(const world *w, froe_query *q, const ask *a, const item *expected, size_t count, int shift) {
    froe_neighbours got;
    const size_t most = count < a->k ? count : a->k;
    assert_int_equal(froe_query_near(q, a->point, a->k, a->bound, &got, NULL), FROE_OK);
    assert_int_equal(got.count, most);
    for (size_t i = 0; i < most; i++) {
        if (got.items[i].object != expected[i].object)
            fail_msg("%s, %s: neighbour %zu is %u, not %u", w->name, froe_tree_report(q->tree).method, i,
                     got.items[i].object, expected[i].object);
        if (i < 20) assert_true(exact_rounds_to(&expected[i].distance, got.items[i].distance, shift));
    }
}

static void check_world(world w, int points) {
    world_dice d = {7, 0};
    item *expected = calloc(w.count + 1, sizeof *expected);
    exact_body *bodies = calloc(w.count + 1, sizeof *bodies);
    const int shift = exact_world_shift(&w);
    for (int i = 0; i < points; i++) {
        ask a = {.k = 0};
        draw(&w, &d, &a);
        const int power =
            exact_shift(exact_shift(shift, a.point, FROE_MAX_DIM), &(double){isinf(a.bound) ? 0 : a.bound}, 1);
        exact_world_begin(&w, power, bodies);
        const size_t count = brute_force(&w, &a, bodies, power, expected);
        for (size_t t = 0; t < w.tree_count; t++) check_tree(&w, w.queries[t], &a, expected, count, power);
    }
    free(bodies);
    free(expected);
    world_end(&w);
}

static void neighbours_in_generated_scenes(void **state) {
    (void)state;
    tour_generators(check_world, 20, 8);
}
static void neighbours_among_all_kinds_on_lattices_and_off(void **state) {
    (void)state;
    tour_mixtures(check_world, 6, 120);
}
static void neighbours_in_real_scenes(void **state) {
    (void)state;
    tour_files(check_world, 8);
}
static void neighbours_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_world, 40, 12);
}
static void neighbours_in_scenes_of_one_object_or_none(void **state) {
    (void)state;
    tour_tiny(check_world);
}

/* Points alone, whose coordinates are scanned: 0 .. grid - 1, or anywhere in 0 .. 1, times a scale, plus a shift. */
static froe_scene *cloud(int dim, uint32_t count, uint32_t grid, double scale, double shift, uint64_t seed) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < count; i++) {
        double x[FROE_MAX_DIM];
        for (int k = 0; k < dim; k++) {
            const uint64_t number = (uint64_t)i * FROE_MAX_DIM + (uint64_t)k;
            const double at = grid ? trees_random(seed, number, grid) : trees_unit(seed, number);
            x[k] = at * scale + shift;
        }
        assert_int_equal(trees_add(scene, FROE_POINT, 1, x, NULL, NULL), FROE_OK);
    }
    return scene;
}

static void neighbours_among_points(void **state) {
    (void)state;
    for (int dim = 2; dim <= 5; dim++) {
        const uint64_t seed = (uint64_t)dim;
        const int questions = 50 / EXACT_SHARE;
        check_world(world_begin("anywhere", cloud(dim, 200, 0, 1, 0, seed)), questions);
        check_world(world_begin("lattice, many at one place", cloud(dim, 200, 4, 1, 0, seed)), questions);
        check_world(world_begin("far away", cloud(dim, 150, 0, 0x1p-8, 0x1p40, seed)), questions);
        check_world(world_begin("huge", cloud(dim, 100, 5, 0x1p1000, 0, seed)), 20 / EXACT_SHARE);
        check_world(world_begin("at 1e300", cloud(dim, 100, 0, 1e300, 0, seed)), 20 / EXACT_SHARE);
        check_world(world_begin("tiny", cloud(dim, 100, 0, 0x1p-600, 0, seed)), 20 / EXACT_SHARE);
        check_world(world_begin("denormal", cloud(dim, 100, 6, 0x1p-1074, 0, seed)), 20 / EXACT_SHARE);
    }
}

static void bad_questions_are_refused_and_change_nothing(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 0.3, "density", 1);
    froe_query *q;
    froe_diagnostic why;
    froe_neighbours before, got;
    const double x[2] = {0.5, 0.5}, nan[2] = {NAN, 0};
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_near(q, x, 3, INFINITY, &before, NULL), FROE_OK);
    const uint32_t first = before.items[0].object;
    assert_int_equal(froe_query_near(q, nan, 3, INFINITY, &got, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "Coordinate 0 of a point is nan, not a finite number.");
    assert_int_equal(froe_query_near(q, x, 3, -1, &got, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "The distance of neighbours, -1, is not a number >= 0.");
    assert_int_equal(froe_query_near(q, x, 3, NAN, &got, NULL), FROE_E_INPUT);
    assert_int_equal(froe_query_near(NULL, x, 3, 1, &got, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_near(q, NULL, 3, 1, &got, NULL), FROE_E_ARG);
    assert_int_equal(before.items[0].object, first);
    assert_int_equal(froe_query_near(q, x, 0, INFINITY, &got, NULL), FROE_OK);
    assert_int_equal(got.count, 0);
    froe_query_free(q);
    froe_tree_free(tree);
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q;
    froe_neighbours got;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = froe_query_near(q, (const double[]){0.4, 0.6}, 30, INFINITY, &got, NULL);
    if (!status) assert_int_equal(got.count, 30);
    froe_query_free(q);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 100, 0, 0.3, "density", 1);
    assert_true(test_memory_each(ask_without_memory, tree) > 5);
    froe_tree_free(tree);
}

/* Two triangles in one plane along the axes: distances are often halfway between two doubles. */
static void walls_in_one_plane_are_equally_near_without_exact_numbers(void **state) {
    const double walls[18] = {-9, -9, 0.625, 9, -9, 0.625, 0, 9, 0.625, -7, -8, 0.625, 8, -7, 0.625, 0.5, 7, 0.625};
    froe_build_options o = froe_build_defaults();
    froe_scene *scene;
    froe_tree *tree;
    froe_query *q;
    froe_neighbours found;
    mpq_t exact, coordinate;
    (void)state;
    mpq_inits(exact, coordinate, NULL);
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 2, walls, NULL, NULL), FROE_OK);
    for (int packed = 0; packed < 2; packed++) {
        o.method = packed ? "index" : "density";
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        for (uint64_t i = 0; i < 200; i++) {
            const double x[3] = {trees_unit(51, i), trees_unit(52, i), 0.625 - 3 * trees_unit(53, i)};
            assert_int_equal(froe_query_near(q, x, 2, INFINITY, &found, NULL), FROE_OK);
            assert_int_equal(found.count, 2);
            assert_true(found.items[0].object == 0 && found.items[1].object == 1);
            mpq_set_d(exact, 0.625);
            mpq_set_d(coordinate, x[2]);
            mpq_sub(exact, exact, coordinate);
            assert_true(rational_rounds_to(exact, found.items[0].distance));
            assert_true(found.items[0].distance == found.items[1].distance);
        }
        assert_int_equal(q->numbers.stats.exact, 0);
        froe_query_free(q);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
    mpq_clears(exact, coordinate, NULL);
}

/* Edges of a turned model are on one line but for the last digits of their corners: which is nearer, doubles cannot
 * tell, and pairs of doubles can. */
static void edges_nearly_on_one_line_need_no_exact_numbers(void **state) {
    const double near = 0x1p-42 + 0x1p-75, far = 0x1.8p-41 + 0x1p-75;
    const double corners[18] = {1, 0, 0, 1, 4, 0x1p-40, 2, 1, 1, 1, 1, near, 1, 3, far, 2, 1.25, -1};
    froe_build_options o = froe_build_defaults();
    froe_scene *scene;
    froe_tree *tree;
    froe_query *q, *exact;
    froe_neighbours found, wanted;
    (void)state;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 2, corners, NULL, NULL), FROE_OK);
    o.method = "index";
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_new(tree, &exact, NULL), FROE_OK);
    exact->numbers.first = NUM_EXACT;
    for (uint64_t i = 0; i < 200; i++) {
        const double x[3] = {0.8 * trees_unit(61, i), 1.2 + 1.6 * trees_unit(62, i), 0.05 + 0.1 * trees_unit(63, i)};
        assert_int_equal(froe_query_near(q, x, 1, INFINITY, &found, NULL), FROE_OK);
        assert_int_equal(froe_query_near(exact, x, 1, INFINITY, &wanted, NULL), FROE_OK);
        assert_int_equal(found.items[0].object, wanted.items[0].object);
        assert_true(found.items[0].distance == wanted.items[0].distance);
    }
    assert_true(exact->numbers.stats.exact > 200);
    assert_int_equal(q->numbers.stats.exact, 0);
    froe_query_free(q);
    froe_query_free(exact);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Of 4,096 short segments. */
static void the_next_neighbours_cost_few_tests(void **state) {
    static const char *const methods[] = {"index", "density", "grain", "kd"};
    enum { N = 4096, QUESTIONS = 100, NEXT = 10 };
    (void)state;
    for (int m = 0; m < 4; m++) {
        froe_tree *tree = trees_grow(2, FROE_SEGMENT, N, 0, 0.01, methods[m], 1);
        froe_query *q;
        froe_neighbours found;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        for (uint64_t i = 0; i < QUESTIONS; i++) {
            const double x[2] = {trees_unit(71, i), trees_unit(72, i)};
            assert_int_equal(froe_query_near(q, x, NEXT, INFINITY, &found, NULL), FROE_OK);
            assert_int_equal(found.count, NEXT);
        }
        assert_true(froe_query_statistics(q).tests < QUESTIONS * 10 * NEXT);
        froe_query_free(q);
        froe_tree_free(tree);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_in_generated_scenes),
        cmocka_unit_test(neighbours_among_all_kinds_on_lattices_and_off),
        cmocka_unit_test(neighbours_in_real_scenes),
        cmocka_unit_test(neighbours_among_points),
        cmocka_unit_test(neighbours_at_every_scale),
        cmocka_unit_test(neighbours_in_scenes_of_one_object_or_none),
        cmocka_unit_test(bad_questions_are_refused_and_change_nothing),
        cmocka_unit_test(walls_in_one_plane_are_equally_near_without_exact_numbers),
        cmocka_unit_test(edges_nearly_on_one_line_need_no_exact_numbers),
        cmocka_unit_test(the_next_neighbours_cost_few_tests),
        cmocka_unit_test(every_allocation_may_fail),
    };
    int failed = cmocka_run_group_tests_name("query/near", tests, NULL, NULL);
    print_message("%llu decisions, %llu ties\n", (unsigned long long)decisions, (unsigned long long)ties);
    if (EXACT_SHARE == 1) assert_true(decisions > 1000000 && ties > 10000);
    return failed;
}
