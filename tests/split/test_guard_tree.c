/* The guard tree: against its rule, against itself in other orders, places and sizes, and in adversity. */
#include "guard_oracle.h"
#include "guard_scenes.h"
#include "split/guard/guard_shrink.h"
#include "split/guard/guards.h"
#include "split/guard/lowest_nodes.h"
#include "support/sanitized.h"
#include <float.h>
#include <pthread.h>

enum { WAYS = 4, SHARE = SANITIZED_SHARE(5) }; /* odd: seeds choose by their last bits */

static split_guard_tree build(const double *guards, size_t count, split_guard_options options, unsigned threads) {
    froe_allocator alloc = support_allocator(NULL);
    base_task task;
    split_guard_tree tree;
    base_task_init(&task, threads, NULL, NULL);
    assert_int_equal(split_guard_tree_build(&alloc, &task, 1, &options, guards, count, &tree), FROE_OK);
    assert_true(task.done == 1);
    return tree;
}

static void discard(split_guard_tree *tree) {
    froe_allocator alloc = support_allocator(NULL);
    split_guard_tree_free(&alloc, tree);
}

static double *scene_new(guard_scene scene, uint64_t seed, size_t count, int dim) {
    double *guards = malloc((count + 1) * (size_t)dim * sizeof *guards);
    assert_non_null(guards);
    scene_fill(scene, seed, guards, count, dim);
    return guards;
}

/* The same in another order. */
static double *shuffled(const double *guards, size_t count, int dim, uint64_t seed) {
    size_t size = (size_t)dim * sizeof *guards, d = (size_t)dim;
    double *copy = malloc((count + 1) * size), swap[FROE_MAX_DIM];
    assert_non_null(copy);
    memcpy(copy, guards, count * size);
    for (size_t p = count; p > 1; p--) {
        size_t q = base_below(base_hash(seed, 5, p), (uint32_t)p);
        memcpy(swap, copy + q * d, size);
        memmove(copy + q * d, copy + (p - 1) * d, size);
        memcpy(copy + (p - 1) * d, swap, size);
    }
    return copy;
}

/* The same trees, whatever the order of their arrays, when the second's planes are x * scale + move[axis]. */
static void assert_alike(const split_guard_tree *a, const split_guard_tree *b, double scale, const double *move) {
    froe_allocator alloc = support_allocator(NULL);
    ARRAY(uint32_t) stack = {0};
    assert_int_equal(a->nodes.count, b->nodes.count);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->leaves, b->leaves);
    assert_int_equal(a->shrinks, b->shrinks);
    assert_int_equal(a->octree_steps, b->octree_steps);
    assert_true(array_push(&alloc, &stack, 0) && array_push(&alloc, &stack, 0));
    while (stack.count) {
        const split_guard_node *y = &b->nodes.data[stack.data[--stack.count]];
        const split_guard_node *x = &a->nodes.data[stack.data[--stack.count]];
        assert_int_equal(!x->child, !y->child);
        assert_int_equal(x->guards, y->guards);
        if (!x->child) continue;
        assert_int_equal(x->axis, y->axis);
        assert_true(x->value * scale + (move ? move[x->axis] : 0) == y->value);
        for (uint32_t side = 0; side < 2; side++)
            assert_true(array_push(&alloc, &stack, x->child + side) && array_push(&alloc, &stack, y->child + side));
    }
    array_free(&alloc, &stack);
}

static void assert_identical(const split_guard_tree *a, const split_guard_tree *b) {
    assert_int_equal(a->nodes.count, b->nodes.count);
    assert_memory_equal(a->nodes.data, b->nodes.data, a->nodes.count * sizeof *a->nodes.data);
    assert_memory_equal(a->lo, b->lo, sizeof a->lo);
    assert_memory_equal(a->hi, b->hi, sizeof a->hi);
    assert_int_equal(a->phases, b->phases);
}

/* ------------------------------------------------------------------- the rule -- */

/* Every way gives the tree of the rule, from any order of the guards. */
static void check_all_ways(const double *guards, size_t count, split_guard_options options, uint64_t seed) {
    double *other = shuffled(guards, count, options.dim, seed);
    split_guard_tree first = build(guards, count, options, 1);
    oracle_check(&first, guards, count);
    for (int way = 0; way < WAYS; way++) {
        options.way = (split_guard_way)way;
        split_guard_tree tree = build(way % 2 ? guards : other, count, options, 1);
        assert_alike(&first, &tree, 1, NULL);
        discard(&tree);
    }
    discard(&first);
    free(other);
}

static void check_scenes(int dim, size_t most, unsigned rounds) {
    static const uint32_t ks[] = {0, 1, 2, 3, 8, 20, 64};
    for (uint64_t seed = 0; seed < rounds; seed += SHARE)
        for (int scene = 0; scene < SCENE_COUNT; scene++) {
            uint64_t random = base_hash(seed, 100 + (unsigned)dim, (unsigned)scene);
            size_t count = base_below(random, (uint32_t)most);
            double *guards = scene_new((guard_scene)scene, random, count, dim);
            split_guard_options options = {.dim = dim,
                                           .k = ks[base_mix(random) % (sizeof ks / sizeof *ks)],
                                           .form = (split_form)(base_mix(random + 1) % 3)};
            check_all_ways(guards, count, options, seed);
            free(guards);
        }
}

static void all_ways_follow_the_rule_in_the_plane(void **state) {
    (void)state;
    check_scenes(2, 40, 100);
    check_scenes(2, 200, 60);
    check_scenes(2, 3000, 4);
}
static void all_ways_follow_the_rule_in_space(void **state) {
    (void)state;
    check_scenes(3, 40, 60);
    check_scenes(3, 200, 30);
    check_scenes(3, 3000, 3);
}
static void all_ways_follow_the_rule_in_four_to_eight_dimensions(void **state) {
    (void)state;
    check_scenes(4, 200, 20);
    check_scenes(5, 100, 5);
    check_scenes(6, 80, 4);
    check_scenes(7, 60, 3);
    check_scenes(8, 50, 3);
}

static void roundings_and_ties_follow_the_rule(void **state) {
    (void)state;
    static const guard_scene scenes[] = {SCENE_SHELLS, SCENE_FAR, SCENE_ULPS, SCENE_DENORMAL};
    for (uint64_t seed = 0; seed < 6000; seed += SHARE) {
        int dim = 2 + (int)(seed / 4 % 2);
        size_t count = 4 + seed % 13;
        double *guards = scene_new(scenes[seed % 4], seed, count, dim);
        split_guard_options options = {.dim = dim, .k = (uint32_t)(seed / 8 % 5), .form = (split_form)(seed % 3)};
        check_all_ways(guards, count, options, seed);
        free(guards);
    }
}

/* Two guards and the rule alone. */
typedef struct two_guards {
    guard_peeler peeler;
    double points[2][2];
    bool peeled[2];
    uint32_t corner;
    size_t at[2]; /* farthest on an axis */
} two_guards;

static const double *two_farthest(guard_peeler *self, int axis) {
    two_guards *g = (two_guards *)self;
    bool second_above = g->points[1][axis] > g->points[0][axis], above = guard_above(g->corner, 2, axis);
    g->at[axis] = g->peeled[0] || (!g->peeled[1] && second_above != above);
    return g->peeled[g->at[axis]] ? NULL : g->points[g->at[axis]];
}

static void two_peel(guard_peeler *self, int axis) {
    two_guards *g = (two_guards *)self;
    g->peeled[g->at[axis]] = true;
}

static void planes_that_rounding_throws_out_of_the_cube_are_left_out(void **state) {
    (void)state;
    for (uint32_t corner = 0; corner < 4; corner += 3) {
        const guard_cube cube = {.lo = {1, 0}, .hi = {1 + 3 * DBL_EPSILON, 0.75}};
        const double x = 1 + DBL_EPSILON, y = 0.375;
        two_guards guards = {.peeler = {two_farthest, two_peel}, .points = {{x, y}, {x, y}}, .corner = corner};
        guard_shrunk shrunk;
        guard_shrink_rule(&cube, 2, corner, 1, &guards.peeler, &shrunk);
        assert_int_equal(shrunk.count, 1);
        assert_int_equal(shrunk.axes[0], 1);
        assert_true(shrunk.values[0] == 0.375);
        assert_int_equal(shrunk.inner, corner & 1);
    }
}

static void planes_never_pass_a_guard_by_rounding(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 20000; seed += SHARE) {
        uint32_t corner = 3 * (uint32_t)(seed % 2);
        double sign = corner ? -1 : 1, v = -sign * 0.7 * scene_unit(seed, 0);
        double far = sign * (0.2 + 0.3 * scene_unit(seed, 1)), near = 0.1 * scene_unit(seed, 2) * far;
        two_guards guards = {
            .peeler = {two_farthest, two_peel}, .points = {{far, near}, {near, far}}, .corner = corner};
        guard_cube cube = {.lo = {v, v}, .hi = {v + 4, v + 4}};
        if (corner) cube = (guard_cube){.lo = {v - 4, v - 4}, .hi = {v, v}};
        guard_shrunk shrunk;
        guard_shrink_rule(&cube, 2, corner, 2, &guards.peeler, &shrunk);
        assert_int_equal(shrunk.count, 2); /* both are peeled at the same distance, and on their plane or beyond */
        assert_true(corner ? far <= shrunk.cube.lo[0] : shrunk.cube.hi[0] <= far);
        assert_true(shrunk.values[1] == far);
    }
}

static void few_guards_make_one_leaf(void **state) {
    (void)state;
    const double two[] = {1, 2, 3, 4};
    for (size_t count = 0; count <= 2; count++) {
        split_guard_tree tree = build(two, count, (split_guard_options){.dim = 2, .k = 2}, 1);
        assert_int_equal(tree.nodes.count, 1);
        assert_int_equal(tree.nodes.data[0].guards, count);
        assert_int_equal(tree.height, 0);
        discard(&tree);
    }
}

static void the_root_is_a_cube_with_all_guards_inside(void **state) {
    (void)state;
    for (int scene = 0; scene < SCENE_COUNT; scene++) {
        double *guards = scene_new((guard_scene)scene, 3, 300, 3), edge = 0, unit = DBL_TRUE_MIN;
        split_guard_tree tree = build(guards, 300, (split_guard_options){.dim = 3, .k = 9}, 1);
        for (int i = 0; i < 3; i++) {
            edge = fmax(edge, 0.5 * tree.hi[i] - 0.5 * tree.lo[i]);
            unit = fmax(unit, fmax(fabs(tree.lo[i]), fabs(tree.hi[i])) * DBL_EPSILON);
        }
        for (int i = 0; i < 3; i++) {
            assert_true(isfinite(tree.lo[i]) && isfinite(tree.hi[i]));
            assert_true(edge - (0.5 * tree.hi[i] - 0.5 * tree.lo[i]) <= unit);
            for (size_t p = scene == SCENE_HUGE ? 2 : 0; p < 300; p++)
                assert_true(tree.lo[i] < guards[3 * p + (size_t)i] && guards[3 * p + (size_t)i] < tree.hi[i]);
        }
        discard(&tree);
        free(guards);
    }
}

static void equal_guards_die_in_one_shrink(void **state) {
    (void)state;
    double *guards = scene_new(SCENE_ONE_PLACE, 1, 1000, 2);
    split_guard_tree tree = build(guards, 1000, (split_guard_options){.dim = 2}, 1);
    assert_int_equal(tree.shrinks, 3);
    discard(&tree);
    free(guards);
}

static void loads_and_forms_are_as_promised(void **state) {
    (void)state;
    static const uint32_t loads[] = {0, 0, 4, 8, 16, 243, 729, 2187, 6561};
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++) {
        double zero[FROE_MAX_DIM] = {0};
        for (uint32_t k = 0; k < 2; k++) {
            split_guard_tree tree = build(zero, 1, (split_guard_options){.dim = dim, .k = k}, 1);
            assert_int_equal(tree.cell_load, loads[dim]);
            assert_int_equal(tree.form, k ? SPLIT_FORM_S : SPLIT_FORM_U);
            discard(&tree);
        }
    }
}

/* ----------------------------------------------------------------- same tree -- */

static void scaling_by_a_power_of_two_scales_the_tree(void **state) {
    (void)state;
    for (int scene = 0; scene <= SCENE_ONE_PLACE; scene++) {
        if (scene == SCENE_NESTED || scene == SCENE_CHAIN) continue; /* would fall off the exponents */
        for (int shift = -400; shift <= 400; shift += 200) {
            double *guards = scene_new((guard_scene)scene, 7, 500, 3), scale = ldexp(1, shift);
            split_guard_options options = {.dim = 3, .k = (uint32_t)scene % 5};
            split_guard_tree first = build(guards, 500, options, 1);
            for (size_t i = 0; i < 1500; i++) guards[i] *= scale;
            split_guard_tree tree = build(guards, 500, options, 1);
            assert_alike(&first, &tree, scale, NULL);
            discard(&first);
            discard(&tree);
            free(guards);
        }
    }
}

static void moving_without_rounding_moves_the_tree(void **state) {
    (void)state;
    const double move[2] = {0x1p20, -3 * 0x1p19};
    for (uint64_t seed = 0; seed < 20; seed++) {
        double *guards = scene_new(SCENE_UNIFORM, seed, 400, 2);
        split_guard_options options = {.dim = 2, .k = (uint32_t)seed % 4};
        for (size_t i = 0; i < 800; i++) guards[i] = floor(guards[i] * 256) / 256;
        split_guard_tree first = build(guards, 400, options, 1);
        for (size_t i = 0; i < 800; i++) guards[i] += move[i % 2];
        split_guard_tree tree = build(guards, 400, options, 1);
        assert_alike(&first, &tree, 1, move);
        discard(&first);
        discard(&tree);
        free(guards);
    }
}

static void threads_do_not_change_a_bit(void **state) {
    (void)state;
    static const guard_scene scenes[] = {SCENE_UNIFORM, SCENE_CLUSTERS, SCENE_NESTED, SCENE_CHAIN, SCENE_LATTICE};
    enum { COUNT = 70000 };
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        int dim = 2 + (int)(s % 2);
        double *guards = scene_new(scenes[s], s, COUNT, dim);
        split_guard_options options = {.dim = dim, .k = s % 2 ? 0 : 6};
        split_guard_tree first = build(guards, COUNT, options, 1);
        for (unsigned threads = 2; threads <= 5; threads += 3) {
            split_guard_tree tree = build(guards, COUNT, options, threads);
            assert_identical(&first, &tree);
            discard(&tree);
        }
        discard(&first);
        free(guards);
    }
}

static void large_scenes_follow_the_rule_too(void **state) {
    (void)state;
    static const guard_scene scenes[] = {SCENE_UNIFORM, SCENE_COPIES, SCENE_HUGE,  SCENE_FAR,
                                         SCENE_ULPS,    SCENE_MIXED,  SCENE_COARSE};
    static const uint32_t ks[] = {0, 5, 100, 300};
    enum { COUNT = 10000 };
    for (size_t s = 0; s < 4 * sizeof scenes / sizeof *scenes; s++) {
        double *guards = scene_new(scenes[s / 4], s, COUNT, 2);
        check_all_ways(guards, COUNT, (split_guard_options){.dim = 2, .k = ks[s % 4]}, 4);
        free(guards);
    }
}

/* ----------------------------------------------------------------- adversity -- */

typedef struct deep_scene {
    double *guards;
    split_guard_tree trees[WAYS];
} deep_scene;

static void *build_deep(void *user) {
    deep_scene *d = user;
    for (int way = 0; way < WAYS; way++)
        d->trees[way] = build(d->guards, 5000, (split_guard_options){.dim = 3, .way = (split_guard_way)way}, 1);
    return NULL;
}

static void trees_thousands_of_levels_deep_need_no_stack(void **state) {
    (void)state;
    pthread_attr_t attr;
    pthread_t thread;
    deep_scene d = {.guards = scene_new(SCENE_NESTED, 9, 5000, 3)};
    assert_int_equal(pthread_attr_init(&attr), 0);
    assert_int_equal(pthread_attr_setstacksize(&attr, 1 << 16), 0);
    assert_int_equal(pthread_create(&thread, &attr, build_deep, &d), 0);
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attr);
    assert_true(d.trees[0].height > 2900);
    assert_true(d.trees[0].phases > 0);
    for (int way = 0; way < WAYS; way++) {
        assert_alike(&d.trees[0], &d.trees[way], 1, NULL);
        if (way) discard(&d.trees[way]);
    }
    oracle_check(&d.trees[0], d.guards, 5000);
    discard(&d.trees[0]);
    free(d.guards);
}

typedef struct trial {
    const double *guards;
    size_t count;
    split_guard_options options;
    unsigned threads;
} trial;

static froe_status try_build(void *user, const froe_allocator *alloc) {
    const trial *t = user;
    base_task task;
    split_guard_tree tree;
    base_task_init(&task, t->threads, NULL, NULL);
    froe_status status = split_guard_tree_build(alloc, &task, 1, &t->options, t->guards, t->count, &tree);
    if (status == FROE_OK) split_guard_tree_free(alloc, &tree);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    static const size_t counts[] = {0, 3, 600, 9000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int way = 0; way < WAYS; way++) {
            double *guards = scene_new(c % 2 ? SCENE_CLUSTERS : SCENE_NESTED, c, counts[c], 2);
            trial t = {guards, counts[c], {.dim = 2, .k = 4, .way = (split_guard_way)way}, 1 + (unsigned)(c == 3)};
            assert_true(test_memory_each(try_build, &t) >= 3);
            free(guards);
        }
}

static bool stop_at(void *user, double done) {
    unsigned *left = user;
    (void)done;
    return (*left)-- > 1;
}

static void cancelling_leaves_nothing_behind(void **state) {
    (void)state;
    double *guards = scene_new(SCENE_UNIFORM, 1, 60000, 2);
    const split_guard_options options = {.dim = 2, .k = 4};
    for (unsigned threads = 1; threads <= 2; threads++)
        for (unsigned calls = 1; calls <= 2; calls++) {
            test_memory memory;
            froe_allocator alloc = test_memory_begin(&memory);
            base_task task;
            split_guard_tree tree;
            unsigned left = calls;
            base_task_init(&task, threads, stop_at, &left);
            assert_int_equal(split_guard_tree_build(&alloc, &task, 1, &options, guards, 60000, &tree),
                             FROE_E_CANCELLED);
            test_memory_end(&memory);
        }
    free(guards);
}

static bool watch(void *user, double done) {
    double *before = user;
    assert_true(*before <= done && done <= 0.75);
    *before = done;
    return true;
}

static void progress_rises_by_its_span(void **state) {
    (void)state;
    double *guards = scene_new(SCENE_UNIFORM, 1, 60000, 2);
    const split_guard_options options = {.dim = 2, .k = 4};
    froe_allocator alloc = support_allocator(NULL);
    for (unsigned threads = 1; threads <= 2; threads++) {
        double before = 0.25;
        base_task task;
        split_guard_tree tree;
        base_task_init(&task, threads, watch, &before);
        assert_true(base_progress(&task, 0.25));
        assert_int_equal(split_guard_tree_build(&alloc, &task, 0.5, &options, guards, 60000, &tree), FROE_OK);
        assert_true(before == 0.75);
        split_guard_tree_free(&alloc, &tree);
    }
    free(guards);
}

static void too_many_guards_are_refused(void **state) {
    (void)state;
    froe_allocator alloc = support_allocator(NULL);
    base_task task;
    split_guard_tree tree;
    const split_guard_options options = {.dim = 2};
    const double none = 0;
    base_task_init(&task, 1, NULL, NULL);
    assert_int_equal(split_guard_tree_build(&alloc, &task, 1, &options, &none, (size_t)1 << 31, &tree), FROE_E_LIMIT);
}

/* ---------------------------------------------------------- guards of a scene -- */

/* Boxes from guard to guard, or small ones, a third of them flat on some axis. */
static froe_scene *boxes_of(const double *guards, size_t count, int dim, bool small) {
    size_t d = (size_t)dim;
    double *coords = malloc((count + 1) * 2 * d * sizeof *coords);
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    assert_non_null(coords);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < d; k++) {
            double x = guards[i * d + k], y = i + 1 < count ? guards[(i + 1) * d + k] : x;
            if (small) y = x + (y - x) * 0.01;
            bool flat = !isfinite(y) || (i + k) % 3 == 0;
            coords[2 * i * d + k] = x < y || flat ? x : y;
            coords[(2 * i + 1) * d + k] = flat ? x : x < y ? y : x;
        }
    o.kind = FROE_BOX;
    o.count = count;
    o.coords = coords;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    free(coords);
    return scene;
}

typedef struct staged { /* what density has before it grows anything */
    split_grid_boxes grid_boxes;
    split_guard_tree tree;
    split_lowest_nodes lowest;
} staged;

static froe_status stage(const froe_allocator *alloc, const froe_scene *scene, split_guard_options options,
                         unsigned threads, staged *out) {
    base_task task;
    memset(out, 0, sizeof *out);
    base_task_init(&task, threads, NULL, NULL);
    froe_status status = split_grid_boxes_make(alloc, &task, scene, &out->grid_boxes);
    if (!status) status = split_guard_tree_of(alloc, &task, 1, &options, &out->grid_boxes, &out->tree);
    if (!status) assert_true(task.done == 1);
    return status ? status : split_lowest_nodes_make(alloc, &task, &out->grid_boxes, &out->tree, &out->lowest);
}

static void unstage(const froe_allocator *alloc, staged *s) {
    split_grid_boxes_free(alloc, &s->grid_boxes);
    split_guard_tree_free(alloc, &s->tree);
    split_lowest_nodes_free(alloc, &s->lowest);
}

/* Each object is among those of the node that cuts it first. */
static void check_lowest_nodes(const froe_scene *scene, const staged *s) {
    const split_guard_node *nodes = s->tree.nodes.data;
    uint32_t *lowest = malloc(scene->object_count * sizeof *lowest);
    assert_non_null(lowest);
    memset(lowest, 0xff, scene->object_count * sizeof *lowest);
    for (uint32_t v = 0; v < s->tree.nodes.count; v++)
        for (uint32_t i = 0; i < split_lowest_nodes_own(&s->lowest, &s->tree, v); i++)
            lowest[s->lowest.ids[s->lowest.at[v] + i]] = v;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        uint32_t node = 0;
        scene_object_bounds(scene, i, lo, hi);
        while (nodes[node].child) {
            bool below = lo[nodes[node].axis]<nodes[node].value, above = hi[nodes[node].axis]> nodes[node].value;
            if (below == above) break;
            node = nodes[node].child + above;
        }
        assert_int_equal(lowest[i], node);
    }
    free(lowest);
}

/* The tree of a scene is that of its guards written down. Comparisons lead to the lowest nodes that contain objects. */
static void check_scene(const froe_scene *scene, split_guard_options options) {
    froe_allocator alloc = support_allocator(NULL);
    base_task task;
    split_guards guards;
    base_task_init(&task, 1, NULL, NULL);
    assert_int_equal(split_guards_of(&alloc, &task, 1, scene, NULL, froe_scene_object_count(scene), &guards), FROE_OK);
    split_guard_tree expected = build(guards.points, guards.count, options, 1);
    for (unsigned threads = 1; threads <= 3; threads += 2) {
        staged s;
        assert_int_equal(stage(&alloc, scene, options, threads, &s), FROE_OK);
        assert_alike(&expected, &s.tree, 1, NULL);
        assert_memory_equal(expected.lo, s.tree.lo, sizeof expected.lo);
        assert_memory_equal(expected.hi, s.tree.hi, sizeof expected.hi);
        assert_true(expected.promised == s.tree.promised);
        check_lowest_nodes(scene, &s);
        unstage(&alloc, &s);
    }
    discard(&expected);
    split_guards_free(&alloc, &guards);
}

static void a_scene_has_the_tree_of_its_guards_and_lowest_nodes_in_it(void **state) {
    static const int dims[] = {2, 2, 3, 5, 8};
    static const size_t counts[] = {300, 9000, 3000, 1000, 300};
    static const uint32_t ks[] = {0, 3, 16, 256};
    (void)state;
    for (int scene = 0; scene < SCENE_COUNT; scene++)
        for (size_t i = 0; i < sizeof dims / sizeof *dims; i++) {
            double *guards = scene_new((guard_scene)scene, i, counts[i], dims[i]);
            froe_scene *boxes = boxes_of(guards, counts[i], dims[i], (scene + i) % 2);
            check_scene(boxes, (split_guard_options){.dim = dims[i], .k = ks[(scene + i) % 4]});
            froe_scene_free(boxes);
            free(guards);
        }
}

static froe_status try_stage(void *user, const froe_allocator *alloc) {
    const split_guard_options options = {.dim = 2, .k = 4};
    staged s;
    froe_status status = stage(alloc, user, options, 2, &s);
    unstage(alloc, &s);
    return status;
}

static void every_allocation_for_a_scene_may_fail(void **state) {
    static const guard_scene scenes[] = {SCENE_UNIFORM, SCENE_CLUSTERS, SCENE_NESTED};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        double *guards = scene_new(scenes[i], 1, 3000, 2);
        froe_scene *boxes = boxes_of(guards, 3000, 2, true);
        assert_true(test_memory_each(try_stage, boxes) >= 3);
        froe_scene_free(boxes);
        free(guards);
    }
}

/* Also of a box whose sides have no halves, of a point, and of one as wide as doubles go. */
static void the_root_is_around_its_box(void **state) {
    static const guard_cube boxes[] = {{{0, 0}, {0x1p-1074, 0}}, {{3, 3}, {3, 3}}, {{-1, 2}, {0x1p-1074, 2}}};
    const guard_cube widest = {{-DBL_MAX, 0}, {DBL_MAX, 0}};
    guard_cube root;
    (void)state;
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        guard_root(boxes + i, 2, &root);
        for (int k = 0; k < 2; k++) assert_true(root.lo[k] < boxes[i].lo[k] && root.hi[k] > boxes[i].hi[k]);
    }
    guard_root(&widest, 2, &root);
    for (int k = 0; k < 2; k++) assert_true(root.lo[k] == -DBL_MAX && root.hi[k] == DBL_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_root_is_around_its_box),
        cmocka_unit_test(all_ways_follow_the_rule_in_the_plane),
        cmocka_unit_test(all_ways_follow_the_rule_in_space),
        cmocka_unit_test(all_ways_follow_the_rule_in_four_to_eight_dimensions),
        cmocka_unit_test(roundings_and_ties_follow_the_rule),
        cmocka_unit_test(planes_that_rounding_throws_out_of_the_cube_are_left_out),
        cmocka_unit_test(planes_never_pass_a_guard_by_rounding),
        cmocka_unit_test(few_guards_make_one_leaf),
        cmocka_unit_test(the_root_is_a_cube_with_all_guards_inside),
        cmocka_unit_test(equal_guards_die_in_one_shrink),
        cmocka_unit_test(loads_and_forms_are_as_promised),
        cmocka_unit_test(scaling_by_a_power_of_two_scales_the_tree),
        cmocka_unit_test(moving_without_rounding_moves_the_tree),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(large_scenes_follow_the_rule_too),
        cmocka_unit_test(trees_thousands_of_levels_deep_need_no_stack),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(cancelling_leaves_nothing_behind),
        cmocka_unit_test(progress_rises_by_its_span),
        cmocka_unit_test(too_many_guards_are_refused),
        cmocka_unit_test(a_scene_has_the_tree_of_its_guards_and_lowest_nodes_in_it),
        cmocka_unit_test(every_allocation_for_a_scene_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
