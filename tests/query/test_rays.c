/* What rays meet, against brute force in whole numbers: every builder; rays along axes, cuts and objects, through
 * corners, from anywhere, of any length. */
#include "query/context.h"
#include "query/tours.h"

static uint64_t decisions, hits, ties, verticals; /* all but hits and ties: of objects by trees */

/** One object met, by the oracle. */
typedef struct met {
    uint32_t object;
    exact_value t;
} met;

typedef struct ask {
    double origin[FROE_MAX_DIM], direction[FROE_MAX_DIM], t_max;
} ask;

/** From the first to the last corner of an object, beginning there or not. */
static void aim_along(const world *w, world_dice *d, ask *a) {
    const uint32_t object = world_below(d, (uint32_t)w->count), corners = froe_scene_object(w->scene, object).corners;
    const double *p = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 0));
    const double *q = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, corners - 1));
    const bool begin = world_below(d, 2);
    for (int k = 0; k < w->dim; k++) {
        a->direction[k] = q[k] - p[k];
        if (begin) a->origin[k] = p[k] - (world_below(d, 2) ? a->direction[k] : 0);
    }
}

static bool usable(const world *w, const ask *a) {
    bool any = false;
    for (int k = 0; k < w->dim; k++) {
        if (!isfinite(a->origin[k]) || !isfinite(a->direction[k])) return false;
        any = any || a->direction[k] != 0;
    }
    return any;
}

static void aim(const world *w, world_dice *d, ask *a) {
    static const double ends[] = {INFINITY, INFINITY, 1, 0.5, 0};
    double to[FROE_MAX_DIM];
    world_point(w, d, a->origin);
    world_point(w, d, to);
    if (w->extreme) {
        fuzz_source r = world_fuzz(d);
        for (int k = 0; k < w->dim && fuzz_int(&r, 0, 1); k++) to[k] = a->origin[k] + extreme_number(&r, w->scene);
    }
    const uint32_t style = world_below(d, 4), axis = world_below(d, (uint32_t)w->dim);
    for (int k = 0; k < w->dim; k++) {
        a->direction[k] = to[k] - a->origin[k];
        if (style == 0) a->direction[k] = (uint32_t)k != axis ? 0 : world_below(d, 2) ? 1 : -2;
    }
    if (style == 1 && w->count) aim_along(w, d, a);
    a->t_max = ends[world_below(d, 5)];
    if (usable(w, a)) return;
    for (int k = 0; k < w->dim; k++) a->origin[k] = w->origin[k], a->direction[k] = 1;
}

/** Objects met, by t, then number: insertion, which is easy to believe. */
static size_t brute_force(const world *w, const ask *a, const exact_body *bodies, met *out) {
    size_t count = 0;
    exact_value end = exact_value_of(isinf(a->t_max) ? 1 : a->t_max, 0);
    for (uint32_t i = 0; i < w->count; i++) {
        const size_t mark = exact_mark();
        met m = {.object = i};
        exact_value t;
        decisions += w->tree_count;
        if (!exact_ray(a->origin, a->direction, &bodies[i], &t)) continue;
        m.t = exact_keep(mark, &t);
        if (!isinf(a->t_max) && exact_compare(&m.t, &end) > 0) continue;
        size_t at = count++;
        for (; at && exact_compare(&m.t, &out[at - 1].t) < 0; at--) out[at] = out[at - 1];
        ties += at && !exact_compare(&m.t, &out[at - 1].t);
        out[at] = m;
    }
    hits += count;
    return count;
}

/** The first segment met, if the ray goes straight up or down. */
static void check_vertical(const world *w, froe_query *q, const ask *a, const met *expected, size_t count) {
    uint32_t object;
    size_t i = 0;
    while (i < count && froe_scene_object(w->scene, expected[i].object).kind != FROE_SEGMENT) i++;
    assert_int_equal(froe_query_vertical(q, a->origin, a->direction[1] > 0 ? 1 : -1, &object, NULL), FROE_OK);
    assert_int_equal(object, i < count ? expected[i].object : FROE_NONE);
    verticals += w->count;
}

static void check_tree(const world *w, froe_query *q, const ask *a, const met *expected, size_t count) {
    froe_hit first;
    froe_hits all;
    uint32_t any;
    assert_int_equal(froe_query_ray(q, a->origin, a->direction, a->t_max, &first, NULL), FROE_OK);
    if (first.object != (count ? expected[0].object : FROE_NONE))
        fail_msg("%s, %s: object %u, not %u", w->name, froe_tree_report(q->tree).method, first.object,
                 count ? expected[0].object : FROE_NONE);
    if (count && !exact_rounds_to(&expected[0].t, first.t, 0))
        fail_msg("%s, %s: object %u is not met at %a", w->name, froe_tree_report(q->tree).method, first.object,
                 first.t);
    assert_int_equal(froe_query_ray_all(q, a->origin, a->direction, a->t_max, &all, NULL), FROE_OK);
    assert_int_equal(all.count, count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(all.hits[i].object, expected[i].object);
        assert_true(exact_rounds_to(&expected[i].t, all.hits[i].t, 0));
    }
    assert_int_equal(froe_query_ray_any(q, a->origin, a->direction, a->t_max, &any, NULL), FROE_OK);
    bool found = !count && any == FROE_NONE;
    for (size_t i = 0; i < count && !found; i++) found = expected[i].object == any;
    assert_true(found);
    if (w->dim == 2 && a->direction[0] == 0 && isinf(a->t_max)) check_vertical(w, q, a, expected, count);
}

static void check_world(world w, int rays) {
    world_dice d = {7, 0};
    met *expected = calloc(w.count + 1, sizeof *expected);
    exact_body *bodies = calloc(w.count + 1, sizeof *bodies);
    const int shift = exact_world_shift(&w);
    for (int i = 0; i < rays; i++) {
        ask a = {.t_max = 0};
        aim(&w, &d, &a);
        const int power = exact_shift(exact_shift(shift, a.origin, FROE_MAX_DIM), a.direction, FROE_MAX_DIM);
        exact_world_begin(&w, power, bodies);
        size_t count = brute_force(&w, &a, bodies, expected);
        for (size_t t = 0; t < w.tree_count; t++) check_tree(&w, w.queries[t], &a, expected, count);
    }
    free(bodies);
    free(expected);
    world_end(&w);
}

static void rays_in_generated_scenes(void **state) {
    (void)state;
    tour_generators(check_world, 30, 8);
}
static void rays_among_all_kinds_on_lattices_and_off(void **state) {
    (void)state;
    tour_mixtures(check_world, 6, 120);
}
static void rays_through_real_scenes(void **state) {
    (void)state;
    tour_files(check_world, 8);
}
static void rays_at_every_scale(void **state) {
    (void)state;
    tour_extremes(check_world, 40, 12);
}
static void rays_in_scenes_of_one_object_or_none(void **state) {
    (void)state;
    tour_tiny(check_world);
}

/* ----------------------------------------------------------------- refusals -- */

static void bad_rays_are_refused_and_change_nothing(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 0.3, "density", 1);
    froe_query *q;
    froe_diagnostic why;
    const double o[2] = {-1, 0.5}, d[2] = {1, 0}, nan[2] = {0, NAN}, far[2] = {INFINITY, 0}, none[2] = {0, 0};
    froe_hit before, hit;
    froe_hits hits_before, hits_after;
    uint32_t object;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_ray(q, o, d, INFINITY, &before, NULL), FROE_OK);
    assert_int_equal(froe_query_ray_all(q, o, d, INFINITY, &hits_before, NULL), FROE_OK);
    hit = before;
    assert_int_equal(froe_query_ray(q, nan, d, INFINITY, &hit, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "Coordinate 1 of the origin of a ray is nan, not a finite number.");
    assert_int_equal(why.axis, 1);
    assert_int_equal(froe_query_ray(q, o, far, INFINITY, &hit, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "Coordinate 0 of the direction of a ray is inf, not a finite number.");
    assert_int_equal(froe_query_ray(q, o, none, INFINITY, &hit, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "The direction of a ray is 0.");
    assert_int_equal(froe_query_ray(q, o, d, NAN, &hit, &why), FROE_E_INPUT);
    assert_int_equal(froe_query_ray(q, o, d, -1, &hit, &why), FROE_E_INPUT);
    assert_string_equal(why.message, "The end of a ray, t = -1, is not a number >= 0.");
    assert_int_equal(froe_query_ray_all(q, nan, d, 1, &hits_after, NULL), FROE_E_INPUT);
    assert_int_equal(froe_query_ray_any(q, nan, d, 1, &object, NULL), FROE_E_INPUT);
    assert_memory_equal(&hit, &before, sizeof hit);
    assert_int_equal(froe_query_vertical(q, o, 0, &object, &why), FROE_E_ARG);
    assert_int_equal(froe_query_vertical(q, nan, 1, &object, &why), FROE_E_INPUT);
    assert_int_equal(froe_query_ray(NULL, o, d, 1, &hit, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_ray(q, NULL, d, 1, &hit, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_ray_all(q, o, d, INFINITY, &hits_after, NULL), FROE_OK);
    assert_int_equal(hits_after.count, hits_before.count);
    froe_query_free(q);
    froe_tree_free(tree);
    tree = trees_grow(3, FROE_SEGMENT, 5, 0, 0.3, "density", 1);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_vertical(q, (const double[]){0, 0, 0}, 1, &object, &why), FROE_E_UNSUPPORTED);
    froe_query_free(q);
    froe_tree_free(tree);
}

/** New context, two queries, everything freed. */
static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q;
    froe_hits all;
    froe_hit first;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    status = froe_query_ray(q, (const double[]){-1, 0.4}, (const double[]){1, 0.1}, INFINITY, &first, NULL);
    if (!status)
        status = froe_query_ray_all(q, (const double[]){-1, 0.4}, (const double[]){1, 0.1}, INFINITY, &all, NULL);
    if (!status) assert_true(all.count > 5 && all.hits[0].object == first.object);
    froe_query_free(q);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 100, 0, 0.3, "density", 1);
    assert_true(test_memory_each(ask_without_memory, tree) > 5);
    froe_tree_free(tree);
}

static void after_some_queries_none_takes_memory(void **state) {
    (void)state;
    froe_tree *grown = trees_grow(2, FROE_SEGMENT, 300, 0, 0.3, "density", 1), tree = *grown;
    test_memory m;
    froe_query *q;
    froe_hit hit;
    tree.alloc = test_memory_begin(&m);
    assert_int_equal(froe_query_new(&tree, &q, NULL), FROE_OK);
    world_dice d = {3, 0};
    size_t calls = 0;
    for (int round = 0; round < 2; round++) {
        calls = m.calls;
        d.counter = 0;
        for (int i = 0; i < 200; i++) {
            const double o[2] = {world_unit(&d), world_unit(&d)}, way[2] = {world_unit(&d), world_unit(&d) - 0.5};
            assert_int_equal(froe_query_ray(q, o, way, INFINITY, &hit, NULL), FROE_OK);
        }
    }
    assert_int_equal(m.calls, calls);
    froe_query_free(q);
    test_memory_end(&m);
    froe_tree_free(grown);
}

/** Along a parabola every support has all other segments on one side: a chain of cuts. */
static void trees_may_be_deep(void **state) {
    (void)state;
    enum { DEEP = 3000 };
    double *xy = calloc(DEEP, 4 * sizeof *xy);
    froe_scene *scene;
    for (int i = 0; i < 2 * DEEP; i++) {
        const double x = (i + 1) / 2; /* NOLINT(bugprone-integer-division) */
        xy[2 * i] = x, xy[2 * i + 1] = x * x;
    }
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, DEEP, xy, NULL, NULL), FROE_OK);
    free(xy);
    froe_tree *tree = trees_build(scene, "autopartition", 1);
    assert_true(froe_tree_report(tree).height > DEEP / 2);
    froe_query *q;
    froe_hits all;
    uint32_t object;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (uint32_t i = 0; i < DEEP; i += 7) {
        assert_int_equal(froe_query_vertical(q, (const double[]){i + 0.5, -1}, 1, &object, NULL), FROE_OK);
        assert_int_equal(object, i);
        assert_int_equal(froe_query_vertical(q, (const double[]){i, 1e9}, -1, &object, NULL), FROE_OK);
        assert_int_equal(object, i ? i - 1 : 0);
    }
    assert_int_equal(froe_query_ray_all(q, (const double[]){-1, 100}, (const double[]){1, 0}, INFINITY, &all, NULL),
                     FROE_OK);
    assert_int_equal(all.count, 2);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/** Trapezoids lie between upright walls: a ray up passes cuts, and none of the walls of its column. */
static void rays_up_meet_their_ceiling_and_no_more(void **state) {
    (void)state;
    enum { MANY = 2000 };
    froe_scene *scene = world_generate("disjoint", MANY);
    froe_tree *tree = trees_build(scene, "cylindrical", 0);
    const size_t height = froe_tree_report(tree).height;
    double lo[2], hi[2], x[2];
    froe_query *q;
    uint32_t object;
    assert_true(froe_scene_bounds(scene, lo, hi));
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (uint64_t i = 0; i < MANY; i++) {
        for (size_t k = 0; k < 2; k++) x[k] = lo[k] + (hi[k] - lo[k]) * trees_unit(k, i);
        assert_int_equal(froe_query_vertical(q, x, i % 2 ? 1 : -1, &object, NULL), FROE_OK);
    }
    assert_true(froe_query_statistics(q).nodes < MANY * height);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_in_generated_scenes),
        cmocka_unit_test(rays_among_all_kinds_on_lattices_and_off),
        cmocka_unit_test(rays_through_real_scenes),
        cmocka_unit_test(rays_at_every_scale),
        cmocka_unit_test(rays_in_scenes_of_one_object_or_none),
        cmocka_unit_test(bad_rays_are_refused_and_change_nothing),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(after_some_queries_none_takes_memory),
        cmocka_unit_test(trees_may_be_deep),
        cmocka_unit_test(rays_up_meet_their_ceiling_and_no_more),
    };
    int failed = cmocka_run_group_tests_name("query/rays", tests, NULL, NULL);
    print_message("%llu decisions, %llu hits, %llu ties, %llu vertical\n", (unsigned long long)decisions,
                  (unsigned long long)hits, (unsigned long long)ties, (unsigned long long)verticals);
    if (EXACT_SHARE == 1) assert_true(decisions > 1000000 && ties > 4000 && verticals > 100000);
    return failed;
}
