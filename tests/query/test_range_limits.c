/* Ranges at the limits: odd scenes, numbers at the ends of their range, bad queries, no memory. */
#include "query/ranges.h"

/* ------------------------------------------------------------- other worlds -- */

static void check_world(froe_scene *scene, const char *name, bool lattice, size_t rounds) {
    world w = world_begin(name, scene);
    w.lattice = lattice;
    for (uint64_t seed = 0; seed < rounds; seed++)
        for (int shape = 0; shape < FROE_SHAPE_COUNT; shape++)
            if (w.dim <= 3 || shape == FROE_SHAPE_BOX || shape == FROE_SHAPE_BALL)
                ask(&w, (froe_range_shape)shape, 100 * seed + (uint64_t)shape);
    world_end(&w);
}

static void empty_scenes_and_single_objects(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        check_world(world_mixture(dim, 0, 0, 0, 0, 1), "nothing", false, 5);
        for (int kind = 0; kind < FROE_KIND_COUNT; kind++)
            if (dim == 3 || kind != FROE_POLYGON) {
                check_world(world_mixture(dim, 1u << kind, 1, 0, 0.5, 1), "one object", false, 20);
                check_world(world_mixture(dim, 1u << kind, 2, 2, 1, 2), "two on a lattice", true, 20);
            }
    }
}

static void the_ends_of_the_range_of_doubles(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        unsigned kinds = FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL | (dim == 3 ? 1 << FROE_POLYGON : 0);
        froe_scene *unit = world_mixture(dim, kinds, 5, 0, 0.5, 9), *lattice = world_mixture(dim, kinds, 5, 6, 0.6, 9);
        check_world(world_scaled(unit, 1000), "around 1e300", false, 3);
        check_world(world_scaled(unit, -1020), "around 1e-307", false, 3);
        check_world(world_scaled(lattice, -1074), "denormals", false, 3);
        check_world(world_scaled(lattice, 1019), "a lattice around 1e307", false, 3);
        froe_scene_free(unit);
        froe_scene_free(lattice);
    }
}

/* Beside a very short segment the square of its line's normal is denormal, or 0, when the line is not moved near the
 * origin: what a ball reaches must not come out as nothing. By segments of four numbers. */
static void balls_reach_across_cuts_along_very_short_segments(void **state) {
    static const double segments[][4] = {{-1e-300, 1, 0x1p-1022, 1},  {1e300, 0x1p-1074, 0, -1},
                                         {-1e-300, 1, 1e-300, 1},     {1e10, 0, 0, -1},
                                         {-1e-300, 1, 0x1p-1022, 1},  {1e-300, 0x1p-1074, 1.5e308, 1e-300},
                                         {-1, -1, 1e160, 0x1p-1022},  {1e300, 0x1p-1074, 1e-300, 1e160},
                                         {1e160, 1.5e308, 3, 1e-160}, {-1, -1.5e308, 1e160, -1e-300},
                                         {1e300, 0x1p-1074, 0, -1}};
    static const size_t scenes[][2] = {{0, 2}, {2, 4}, {4, 11}};
    static const double balls[][3] = {{-1, 3, 1e300}, {-1, 3, 10}, {0, 3, 3}, {-1, 3, 2.5}, {0, 1, 0}};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        froe_scene *scene = world_mixture(2, 0, 0, 0, 0, 1);
        for (size_t j = scenes[i][0]; j < scenes[i][1]; j++)
            assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, segments[j], NULL, NULL), FROE_OK);
        world w = world_begin("short segments", scene);
        for (size_t b = 0; b < sizeof balls / sizeof *balls; b++) {
            question q = {.range = froe_range_defaults()};
            bool meets[16];
            size_t expected = 0;
            q.range.shape = FROE_SHAPE_BALL;
            q.range.points = memcpy(q.points, balls[b], 2 * sizeof **balls);
            q.range.radius = balls[b][2];
            make_oracle(&w, &q);
            for (uint32_t o = 0; o < w.count; o++) expected += meets[o] = truth(&w, &q, o);
            compare(&w, &q, meets, expected);
            oracle_set_free(&q.set);
        }
        world_end(&w);
    }
}

static void many_dimensions(void **state) {
    (void)state;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++) {
        unsigned kinds = 1 << FROE_POINT | SOLID_KINDS;
        check_world(world_mixture(dim, kinds, 30, 0, 0.7, 1), "anywhere", false, 60);
        check_world(world_mixture(dim, kinds, 30, 3, 0.8, 2), "on a lattice", true, 60);
    }
}

static void a_real_map_and_a_real_model(void **state) {
    (void)state;
    check_world(world_read("fzk-haus-boxes.csv"), "boxes of a house", false, 3);
    check_world(world_generate("rooms-3d", 200), "rooms", false, 4);
    check_world(world_generate("blocks", 500), "town", false, 4);
}

/* The normal of a halfspace is no point of it, although both are two numbers. */
static void a_point_like_the_normal_is_outside(void **state) {
    const double point[2] = {1, 1}, normal[2] = {1, 1};
    froe_scene *scene = world_mixture(2, 0, 0, 0, 0, 1);
    (void)state;
    assert_int_equal(trees_add(scene, FROE_POINT, 1, point, NULL, NULL), FROE_OK);
    world w = world_begin("a point", scene);
    for (int i = 0; i < 2; i++) {
        const double offset = i ? 2 : nextafter(2, 0);
        froe_range range = froe_range_defaults();
        uint64_t count;
        range.shape = FROE_SHAPE_HALFSPACES;
        range.points = normal;
        range.offsets = &offset;
        range.count = 1;
        for (size_t t = 0; t < w.tree_count; t++) {
            assert_int_equal(froe_query_count(w.queries[t], &range, &count, NULL), FROE_OK);
            assert_int_equal(count, i);
        }
    }
    world_end(&w);
}

/* Whole subtrees of what halfspaces hold need no test. */
static void halfspaces_take_slices(void **state) {
    const double normals[4] = {1, 0.25, -1, 0.25}, offsets[2] = {0.8, 0};
    world w = world_begin("segments", world_mixture(2, 1 << FROE_SEGMENT, 2000, 0, 0.01, 1));
    froe_range range = froe_range_defaults();
    uint64_t count;
    (void)state;
    range.shape = FROE_SHAPE_HALFSPACES;
    range.points = normals;
    range.offsets = offsets;
    range.count = 2;
    for (size_t t = 0; t < w.tree_count; t++) {
        froe_query_statistics(w.queries[t]);
        assert_int_equal(froe_query_count(w.queries[t], &range, &count, NULL), FROE_OK);
        if (tree_is_packed(w.trees[t])) assert_true(froe_query_statistics(w.queries[t]).slices > 0);
    }
    world_end(&w);
}

/* -------------------------------------------------------------------- faults -- */

static froe_status ask_all_shapes(void *user, const froe_allocator *alloc) {
    static const double points[] = {-1, -1, 2, 2, 2, -1};
    static const double offsets[] = {9, 0.7, 9};
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL;
    froe_list list;
    froe_build_options o = froe_build_defaults();
    (void)user;
    o.method = "autopartition";
    o.threads = 1;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 9, 0, 0.9, 1);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    for (int shape = 0; shape < FROE_SHAPE_COUNT && !status; shape++) {
        froe_range range = froe_range_defaults();
        range.shape = (froe_range_shape)shape;
        range.points = points;
        range.offsets = offsets;
        range.count = 3;
        range.eps = shape == FROE_SHAPE_HULL ? 0.1 : 0;
        status = froe_query_range(q, &range, &list, NULL);
    }
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    assert_true(test_memory_each(ask_all_shapes, NULL) > 20);
}

/** Whatever was asked once may be asked again without memory. */
static void warm_contexts_take_no_memory(void **state) {
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    froe_scene *scene;
    froe_tree *tree;
    froe_query *q;
    world w = {.dim = 3, .scale = 1};
    size_t calls = 0;
    (void)state;
    assert_int_equal(froe_scene_new(3, &alloc, &scene), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_POLYGON, 300, 0, 0.3, 1), FROE_OK);
    tree = trees_build(scene, "density", 4);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    w.scene = scene;
    for (int round = 0; round < 2; round++) {
        calls = m.calls;
        for (uint64_t seed = 0; seed < 400; seed++) {
            world_dice d = {seed, 0};
            question ask;
            froe_list list;
            make(&w, &d, (froe_range_shape)(seed % FROE_SHAPE_COUNT), &ask);
            assert_int_equal(froe_query_range(q, &ask.range, &list, NULL), FROE_OK);
            oracle_set_free(&ask.set);
        }
    }
    assert_int_equal(m.calls, calls);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    test_memory_end(&m);
}

/* ---------------------------------------------------------------- bad ranges -- */

typedef struct bad_range {
    froe_range_shape shape;
    double points[6], offset, radius, eps;
    size_t count;
    froe_status status;
    const char *message;
} bad_range;

static void bad_ranges_are_refused_with_a_reason(void **state) {
    static const bad_range bad[] = {
        {FROE_SHAPE_BOX, .points = {0, 0, NAN, 1}, .status = FROE_E_INPUT,
         .message = "A coordinate of a box is nan, not a finite number."},
        {FROE_SHAPE_BOX, .points = {INFINITY, 0, INFINITY, 1}, .status = FROE_E_INPUT,
         .message = "A coordinate of a box is inf, not a finite number."},
        {FROE_SHAPE_BOX, .points = {0, 2, 1, 1}, .status = FROE_E_INPUT,
         .message = "The low corner 2 of a box is above its high corner 1 on axis 1."},
        {FROE_SHAPE_BOX, .points = {-INFINITY, 0, 1, 1}, .eps = 0.1, .status = FROE_E_INPUT,
         .message = "A box without a bound has no eps."},
        {FROE_SHAPE_BOX, .points = {0, 0, 1, 1}, .eps = -1, .status = FROE_E_INPUT,
         .message = "The eps of a range, -1, is not a finite number >= 0."},
        {FROE_SHAPE_BALL, .points = {0, 0}, .radius = -1, .status = FROE_E_INPUT,
         .message = "The radius of a ball is -1, not a finite number >= 0."},
        {FROE_SHAPE_BALL, .points = {0, 0}, .radius = INFINITY, .status = FROE_E_INPUT,
         .message = "The radius of a ball is inf, not a finite number >= 0."},
        {FROE_SHAPE_CAPSULE, .points = {0, 0, 1, 1}, .radius = NAN, .status = FROE_E_INPUT,
         .message = "The radius of a capsule is"},
        {FROE_SHAPE_SIMPLEX, .points = {0, 0, 1, 1, 0, -INFINITY}, .status = FROE_E_INPUT,
         .message = "A coordinate of a simplex is -inf, not a finite number."},
        {FROE_SHAPE_RAY, .points = {1, 1, 0, -0.0}, .status = FROE_E_INPUT, .message = "A ray has no direction."},
        {FROE_SHAPE_RAY, .points = {1, 1, 0, 1}, .eps = 1, .status = FROE_E_INPUT,
         .message = "A ray without a bound has no eps."},
        {FROE_SHAPE_HALFSPACES, .points = {1, 1}, .offset = NAN, .count = 1, .status = FROE_E_INPUT,
         .message = "The offset of a halfspace is nan, not a finite number."},
        {FROE_SHAPE_HALFSPACES, .points = {1, 1}, .eps = 0.5, .count = 1, .status = FROE_E_INPUT,
         .message = "Halfspaces without a bound have no eps."},
        {FROE_SHAPE_HULL, .count = 0, .status = FROE_E_INPUT, .message = "A hull has no points."},
        {FROE_SHAPE_HALFSPACES, .points = {1, INFINITY}, .count = 1, .status = FROE_E_INPUT,
         .message = "A coordinate of a halfspace is inf, not a finite number."},
        {FROE_SHAPE_COUNT, .status = FROE_E_OPTIONS, .message = "There is no shape of number"},
    };
    (void)state;
    world w = world_begin("two", world_mixture(2, 1 << FROE_SEGMENT, 2, 0, 0.5, 1));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        froe_range range = froe_range_defaults();
        froe_list list = {NULL, 77};
        froe_diagnostic diag;
        range.shape = bad[i].shape;
        range.points = bad[i].points;
        range.offsets = &bad[i].offset;
        range.radius = bad[i].radius;
        range.eps = bad[i].eps;
        range.count = bad[i].count;
        assert_int_equal(froe_query_range(w.queries[0], &range, &list, &diag), bad[i].status);
        assert_int_equal(diag.status, bad[i].status);
        if (strncmp(diag.message, bad[i].message, strlen(bad[i].message)))
            fail_msg("'%s' is not '%s'", diag.message, bad[i].message);
        assert_int_equal(list.count, 77);
    }
    froe_range raw = {0}, none = froe_range_defaults();
    froe_list list;
    assert_int_equal(froe_query_range(w.queries[0], &raw, &list, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_query_range(w.queries[0], &none, &list, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_range(NULL, &none, &list, NULL), FROE_E_ARG);
    world_end(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_scenes_and_single_objects),
        cmocka_unit_test(the_ends_of_the_range_of_doubles),
        cmocka_unit_test(balls_reach_across_cuts_along_very_short_segments),
        cmocka_unit_test(many_dimensions),
        cmocka_unit_test(a_real_map_and_a_real_model),
        cmocka_unit_test(a_point_like_the_normal_is_outside),
        cmocka_unit_test(halfspaces_take_slices),
        cmocka_unit_test(bad_ranges_are_refused_with_a_reason),
        cmocka_unit_test(warm_contexts_take_no_memory),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
