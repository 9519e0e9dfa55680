/* test_index.c: packed trees: the same for any number of threads, whole or not at all when allocations fail, with the
 * same answers for any capacity of leaves; and the capacity that is taken in the plane where none is named. */
#include "tree/trees.h"
#include <float.h>
#include <froe/io.h>
#include <froe/query.h>
#include <math.h>
#include <stdio.h>

/* Subtrees are jobs from 8192 objects on; these make them of a few hundred. */
#define JOBS "grid=4 load=2 parts=4"

typedef struct kind_of_scene {
    const char *name;
    uint32_t count, grid; /* lattice; 0: anywhere */
    double size, scale, shift;
    bool shared; /* ends are shared, so that they do not lie one after the other */
} kind_of_scene;

static const kind_of_scene kinds[] = {
    {"short", 700, 0, 0.05, 1, 0, false},
    {"chains", 700, 0, 0.05, 1, 0, true},
    {"long", 300, 0, 1.5, 1, 0, false},
    {"lattice", 500, 30, 0.2, 1, 0, false},
    {"coarse lattice", 300, 4, 1, 1, 0, true},
    {"huge", 400, 0, 0.1, 0x1p1020, 0, false},
    {"tiny", 400, 0, 0.1, 0x1p-800, 0, false},
    {"denormal lattice", 400, 30, 0.2, 0x1p-1074, 0, false},
    {"far away", 400, 0, 0.1, 1, 0x1p40, false},
    {"so far away that cells are a few units in the last place", 400, 0, 0.2, 0x1p-8, 0x1p40, false},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static double place(const kind_of_scene *k, double x) {
    return (k->grid ? floor(x * k->grid) : x) * k->scale + k->shift;
}

static froe_scene *scene_of(const kind_of_scene *k) {
    froe_scene *scene;
    double *c = calloc(4 * (size_t)k->count, sizeof *c);
    froe_objects o = froe_objects_defaults();
    assert_non_null(c);
    for (uint32_t i = 0; i < k->count; i++)
        for (uint32_t j = 0; j < 2; j++) {
            const double x = trees_unit(1, 4 * i + j), size = k->size * (trees_unit(2, 4 * i + j) - 0.5);
            c[4 * i + j] = place(k, x), c[4 * i + 2 + j] = place(k, x + size);
            if (k->shared && i % 5) c[4 * i + j] = c[4 * i - 2 + j], c[4 * i + 2 + j] = c[4 * i + j] + size * k->scale;
        }
    o.kind = FROE_SEGMENT, o.count = k->count, o.coords = c;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    free(c);
    return scene;
}

static froe_build_options options(uint32_t leaf, const char *settings, unsigned threads) {
    froe_build_options o = froe_build_defaults();
    o.method = "index", o.leaf = leaf, o.settings = settings, o.threads = threads;
    return o;
}

static froe_tree *build(froe_scene *scene, uint32_t leaf, const char *settings, unsigned threads) {
    const froe_build_options o = options(leaf, settings, threads);
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    if (build_tuned(scene, &o, &tree, &why)) fail_msg("%s", why.message);
    return tree;
}

static void assert_audited(const froe_tree *tree, const char *name) {
    froe_diagnostic why;
    if (froe_tree_audit(tree, NULL, &why)) fail_msg("%s: %s", name, why.message);
}

/* ------------------------------------------------------------------ threads -- */

static void check_threads(froe_scene *scene, const char *name, uint32_t leaf, const char *settings) {
    froe_tree *one = build(scene, leaf, settings, 1);
    const froe_predicate_stats *stats = &one->report.predicates;
    assert_audited(one, name);
    for (unsigned threads = 2; threads <= 8; threads += threads < 4 ? 1 : 4) {
        froe_tree *more = build(scene, leaf, settings, threads);
        trees_assert_equal(one, more);
        assert_memory_equal(stats, &more->report.predicates, sizeof *stats);
        froe_tree_free(more);
    }
    froe_tree_free(one);
}

static void a_tree_is_the_same_for_any_number_of_threads(void **state) {
    static const uint32_t leaves[] = {FROE_LEAF_OWN, 1, 5, 30};
    (void)state;
    for (size_t i = 0; i < KINDS; i++) {
        froe_scene *scene = scene_of(kinds + i);
        for (size_t l = 0; l < 4; l++) {
            check_threads(scene, kinds[i].name, leaves[l], JOBS);
            check_threads(scene, kinds[i].name, leaves[l], JOBS " growth=1.1");
        }
        froe_scene_free(scene);
    }
    const kind_of_scene large = {"large", 30000, 0, 0.01, 1, 0, false};
    froe_scene *scene = scene_of(&large);
    check_threads(scene, large.name, FROE_LEAF_OWN, NULL);
    froe_scene_free(scene);
}

/* Far from the origin the root box is no wider than a scene whose segments all lie in one axis-parallel line, so that
 * they lie in its border; beside them some cross it. */
static void segments_in_the_border_of_the_root_box_are_where_they_are(void **state) {
    static const double far[] = {1e15, -1e15, 0x1p60, -0x1p60, 1e300, -1e300, DBL_MAX, -DBL_MAX};
    enum { COUNT = 140 };
    double c[4 * COUNT];
    (void)state;
    for (size_t f = 0; f < sizeof far / sizeof *far; f++)
        for (int axis = 0; axis < 2; axis++)
            for (int crossed = 0; crossed < 2; crossed++) {
                froe_scene *scene;
                froe_objects o = froe_objects_defaults();
                o.kind = FROE_SEGMENT, o.count = COUNT, o.coords = c;
                for (uint32_t i = 0; i < 2 * COUNT; i++) {
                    c[2 * i + axis] = crossed && i % 10 == 0 ? nextafter(far[f], 0) : far[f];
                    c[2 * i + 1 - axis] = trees_unit(3, i);
                }
                assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
                assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
                check_threads(scene, "in the border", FROE_LEAF_OWN, NULL);
                check_threads(scene, "in the border", 5, JOBS);
                froe_scene_free(scene);
            }
}

static void trees_of_all_kinds_of_scenes_are_the_same_for_any_number_of_threads(void **state) {
    size_t space = 0, jobs = 0;
    (void)state;
    for (size_t i = 0; froe_generator_at(i); i++) {
        const char *name = froe_generator_at(i)->name;
        const froe_build_options o = options(3, JOBS, 1);
        froe_scene *scene;
        froe_tree *tree = NULL, *whole;
        assert_int_equal(froe_generate(name, 300, 7, NULL, &scene, NULL), FROE_OK);
        if (!build_tuned(scene, &o, &tree, NULL)) { /* it may not serve the kind */
            check_threads(scene, name, 3, JOBS);
            whole = build(scene, 3, NULL, 3);
            space += froe_scene_dim(scene) == 3;
            jobs += froe_scene_dim(scene) == 3 && tree->node_count != whole->node_count;
            froe_tree_free(whole);
        }
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    assert_true(space > 10 && jobs > 5); /* the sample cuts otherwise than all objects */
}

/* Objects that lie in cuts, and samples that mislead: of sixteen objects in a row one is seen, and the others are
 * elsewhere, and large. */
static void samples_that_mislead_make_right_trees_of_space(void **state) {
    (void)state;
    for (uint32_t seed = 0; seed < 20; seed++) {
        enum { COUNT = 400 };
        double c[9 * COUNT];
        froe_scene *scene;
        froe_objects o = froe_objects_defaults();
        for (uint32_t i = 0; i < COUNT; i++)
            for (uint32_t j = 0; j < 9; j++) {
                const bool odd = i % 16 == seed % 16;
                const double at = trees_unit(seed, 3 * i + j % 3),
                             size = (odd ? 0.05 : 1.5) * trees_unit(seed + 50, 9 * i + j);
                c[9 * i + j] = seed % 2 ? floor(8 * (at + size)) / 8 : at + size;
                if (i % 3 == 0 && j % 3 == seed % 3) c[9 * i + j] = floor(8 * at) / 8; /* across an axis */
            }
        o.kind = FROE_POLYGON, o.count = COUNT, o.coords = c;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        check_threads(scene, "misleading", 4, "parts=64");
        check_threads(scene, "misleading", 4, "parts=64 growth=1.5");
        froe_tree *tree = build(scene, 4, "parts=64 growth=1.5", 2);
        assert_true((double)tree->piece_count <= 2 * 1.5 * COUNT);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ----------------------------------------------------------------- capacity -- */

static int by_number(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void sorted(froe_list *list) {
    qsort((void *)(uintptr_t)list->ids, list->count, sizeof *list->ids, by_number);
}

typedef struct pair_sum {
    uint64_t count, sum;
} pair_sum;

static bool add_pair(void *user, const froe_pair *pair) {
    pair_sum *s = user;
    s->count++;
    s->sum += base_hash(1, pair->a, pair->b);
    return true;
}

static void compare_answers(const kind_of_scene *k, froe_query *a, froe_query *b, uint64_t draw) {
    double box[4], point[2];
    for (int j = 0; j < 2; j++) {
        const double x = 1.2 * trees_unit(7, 4 * draw + (uint64_t)j) - 0.1,
                     size = 0.2 * trees_unit(8, 4 * draw + (uint64_t)j);
        box[j] = place(k, x), box[2 + j] = place(k, x + size),
        point[j] = place(k, trees_unit(9, 2 * draw + (uint64_t)j));
    }
    froe_range range = froe_range_defaults();
    range.points = box;
    froe_list found[2];
    assert_int_equal(froe_query_range(a, &range, found, NULL), FROE_OK);
    assert_int_equal(froe_query_range(b, &range, found + 1, NULL), FROE_OK);
    sorted(found), sorted(found + 1);
    assert_int_equal(found[0].count, found[1].count);
    if (found[0].count) assert_memory_equal(found[0].ids, found[1].ids, found[0].count * sizeof *found[0].ids);
    uint32_t above[2];
    for (int direction = -1; direction < 2; direction += 2) {
        assert_int_equal(froe_query_vertical(a, point, direction, above, NULL), FROE_OK);
        assert_int_equal(froe_query_vertical(b, point, direction, above + 1, NULL), FROE_OK);
        assert_int_equal(above[0], above[1]);
    }
    froe_neighbours near[2];
    assert_int_equal(froe_query_near(a, point, 3, INFINITY, near, NULL), FROE_OK);
    assert_int_equal(froe_query_near(b, point, 3, INFINITY, near + 1, NULL), FROE_OK);
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(near[0].items[i].object, near[1].items[i].object);
        assert_true(near[0].items[i].distance == near[1].items[i].distance);
    }
}

/* The capacity that is taken where none is named, beside some that are. */
static void answers_do_not_depend_on_the_capacity(void **state) {
    static const uint32_t leaves[] = {1, 7, 24, 64, 100000};
    (void)state;
    for (size_t i = 0; i < KINDS; i++) {
        froe_scene *scene = scene_of(kinds + i);
        froe_tree *own = build(scene, FROE_LEAF_OWN, JOBS, 1);
        froe_query *a, *b;
        assert_int_equal(froe_query_new(own, &a, NULL), FROE_OK);
        for (size_t l = 0; l < 5; l++) {
            froe_tree *tree = build(scene, leaves[l], JOBS, 1);
            pair_sum pairs[2] = {{0, 0}, {0, 0}};
            assert_int_equal(froe_tree_report(tree).leaf, leaves[l]);
            assert_int_equal(froe_query_new(tree, &b, NULL), FROE_OK);
            for (uint64_t draw = 0; draw < 60; draw++) compare_answers(kinds + i, a, b, draw);
            assert_int_equal(froe_query_pairs(a, true, add_pair, pairs, NULL), FROE_OK);
            assert_int_equal(froe_query_pairs(b, true, add_pair, pairs + 1, NULL), FROE_OK);
            assert_memory_equal(pairs, pairs + 1, sizeof *pairs);
            froe_query_free(b);
            froe_tree_free(tree);
        }
        froe_query_free(a);
        froe_tree_free(own);
        froe_scene_free(scene);
    }
}

/* Most objects are in leaves of one depth, and those are nearly full: at any number of objects, also between those
 * where a fixed capacity suits the levels of middle cuts. */
static void leaves_of_an_even_scene_are_full_and_of_one_depth(void **state) {
    (void)state;
    for (uint32_t n = 5000; n < 100000; n = n / 4 * 5) {
        const kind_of_scene k = {"even", n, 0, 0.5 / sqrt(n), 1, 0, false};
        froe_scene *scene = scene_of(&k);
        froe_tree *tree = build(scene, FROE_LEAF_OWN, NULL, 2);
        const froe_report report = froe_tree_report(tree);
        uint64_t at[64] = {0}, most = 0;
        uint8_t *depth = calloc(tree->node_count, 1);
        assert_non_null(depth);
        for (uint32_t i = 0; i < tree->node_count; i++) {
            const tree_node *node = tree->nodes + i;
            if (tree_is_leaf(node))
                at[depth[i]] += node->u.list.count;
            else
                depth[node->child] = depth[node->child + 1] = (uint8_t)(depth[i] + 1);
        }
        for (int d = 0; d < 64; d++) most = at[d] > most ? at[d] : most;
        free(depth);
        assert_true((double)most > 0.75 * (double)report.fragments);
        assert_true((double)report.fragments > 0.6 * report.leaf * (double)report.leaves);
        assert_true(report.leaf <= 64 && !report.crowded);
        assert_int_equal(report.leaf, tree->meta.leaf);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------------- limits -- */

static froe_status build_in(void *user, const froe_allocator *alloc) {
    const kind_of_scene *k = user;
    const froe_build_options o = options(3, JOBS, k->shared ? 3 : 1);
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    const int dim = k->scale > 1 ? 3 : 2;
    froe_status status = froe_scene_new(dim, alloc, &scene);
    if (!status) status = trees_scatter(scene, dim == 3 ? FROE_POLYGON : FROE_SEGMENT, k->count, k->grid, k->size, 1);
    if (!status) status = build_tuned(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void jobs_survive_every_failing_allocation(void **state) {
    static const kind_of_scene scenes[] = {{"one thread", 40, 0, 0.3, 1, 0, false},
                                           {"three threads", 40, 0, 0.3, 1, 0, true},
                                           {"space", 60, 0, 0.3, 2, 0, false},
                                           {"space, three threads", 60, 0, 0.3, 2, 0, true}};
    (void)state;
    for (size_t i = 0; i < 4; i++) test_memory_each(build_in, (void *)(uintptr_t)(scenes + i));
}

/* Counts allocations down; the one that comes to 0 fails. */
static void *fail_at_zero(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)old_size;
    if (!new_size) return free(ptr), NULL;
    return --*(long *)user ? realloc(ptr, new_size) : NULL;
}

/* Segments of ever smaller sizes around one point, so that cuts in the middle would go deep, and medians are taken. */
static void without_memory_for_medians_there_is_no_other_tree(void **state) {
    enum { COUNT = 120 };
    double c[4 * COUNT];
    long left = 0;
    const froe_allocator alloc = {fail_at_zero, &left};
    const froe_build_options o = options(1, "height=0.001 growth=100", 1);
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene;
    froe_status status = FROE_E_MEMORY;
    (void)state;
    for (uint32_t i = 0; i < 4 * COUNT; i++) c[i] = ldexp(trees_unit(5, i) - 0.5, -(int)(i / 8));
    objects.kind = FROE_SEGMENT, objects.count = COUNT, objects.coords = c;
    assert_int_equal(froe_scene_new(2, &alloc, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    froe_tree *whole = build(scene, 1, o.settings, 1), *higher = build(scene, 1, "height=0 growth=100", 1);
    assert_true(whole->node_count != higher->node_count); /* medians are taken */
    for (long at = 1; status; at++) {
        froe_tree *tree;
        left = at;
        status = build_tuned(scene, &o, &tree, NULL);
        if (status) {
            assert_int_equal(status, FROE_E_MEMORY);
            continue;
        }
        const bool failed = left <= 0; /* and was made up for */
        trees_assert_equal(whole, tree);
        froe_tree_free(tree);
        if (failed) status = FROE_E_MEMORY;
    }
    froe_tree_free(whole);
    froe_tree_free(higher);
    froe_scene_free(scene);
}

static bool count_down(void *user, double done) {
    assert_true(done >= 0 && done <= 1);
    return --*(int *)user > 0;
}

static void jobs_keep_a_budget_to_the_piece_and_can_be_cancelled(void **state) {
    (void)state;
    for (unsigned threads = 1; threads <= 7; threads += 2) {
        froe_scene *scene = threads < 4 ? scene_of(kinds) : trees_scene(3, FROE_POLYGON, 300, 0, 0.2, 1);
        froe_tree *tree = build(scene, 5, JOBS, threads), *again = NULL;
        froe_build_options o = options(5, JOBS, threads);
        o.max_fragments = froe_tree_report(tree).fragments;
        assert_int_equal(build_tuned(scene, &o, &again, NULL), FROE_OK);
        froe_tree_free(again), again = NULL;
        o.max_fragments--;
        assert_int_equal(build_tuned(scene, &o, &again, NULL), FROE_E_BUDGET);
        o.max_fragments = 0;
        size_t cancelled = 0;
        for (int calls = 1; calls < 12; calls++) {
            int left = calls;
            o.progress = count_down, o.user = &left;
            const froe_status status = build_tuned(scene, &o, &again, NULL);
            assert_true(status == FROE_E_CANCELLED || !status);
            cancelled += status == FROE_E_CANCELLED;
            froe_tree_free(again), again = NULL;
        }
        assert_true(cancelled >= 5);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* Four boxes without depth at four doubles in a row: every cut between the first and the last is one of them, and was
 * moved on until all lay before it, so that the cell was cut in the same way for ever. */
static void flat_boxes_at_doubles_in_a_row_stay_together(void **state) {
    double c[4][6];
    int left = 1000;
    froe_scene *scene;
    froe_tree *tree = NULL;
    froe_build_options o = options(1, NULL, 1);
    (void)state;
    for (int i = 0; i < 4; i++) {
        const double box[6] = {0x1p53 + 2 * i, 0, 0, 0x1p53 + 2 * i, 4, 4};
        memcpy(c[i], box, sizeof box);
    }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, 4, c[0], NULL, NULL), FROE_OK);
    o.progress = count_down, o.user = &left;
    assert_int_equal(build_tuned(scene, &o, &tree, NULL), FROE_OK);
    assert_audited(tree, "flat boxes");
    assert_int_equal(froe_tree_report(tree).fragments, 4);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Triangles whose products of three coordinates are beyond doubles in part: a plane's distance that was infinite said
 * that the triangle is nowhere in a cell, and the tree lacked it there. */
static void triangles_near_the_end_of_doubles_are_listed_where_they_are(void **state) {
    enum { COUNT = 200 };
    static double c[9 * COUNT];
    size_t starts[COUNT + 1] = {0};
    (void)state;
    for (int exponent = 336; exponent <= 346; exponent++) {
        froe_objects o = froe_objects_defaults();
        froe_build_options b = options(8, NULL, 1);
        froe_scene *scene;
        froe_tree *tree = NULL;
        for (size_t i = 0; i < COUNT; i++) starts[i + 1] = 3 * (i + 1);
        for (uint32_t i = 0; i < 9 * COUNT; i++) c[i] = ldexp(32 * trees_unit(3, i) - 16, exponent);
        o.kind = FROE_POLYGON, o.count = COUNT, o.coords = c, o.starts = starts;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        assert_int_equal(froe_build(scene, &b, &tree, NULL), FROE_OK);
        assert_audited(tree, "triangles near the end of doubles");
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(segments_in_the_border_of_the_root_box_are_where_they_are),
        cmocka_unit_test(trees_of_all_kinds_of_scenes_are_the_same_for_any_number_of_threads),
        cmocka_unit_test(samples_that_mislead_make_right_trees_of_space),
        cmocka_unit_test(answers_do_not_depend_on_the_capacity),
        cmocka_unit_test(leaves_of_an_even_scene_are_full_and_of_one_depth),
        cmocka_unit_test(jobs_survive_every_failing_allocation),
        cmocka_unit_test(without_memory_for_medians_there_is_no_other_tree),
        cmocka_unit_test(jobs_keep_a_budget_to_the_piece_and_can_be_cancelled),
        cmocka_unit_test(flat_boxes_at_doubles_in_a_row_stay_together),
        cmocka_unit_test(triangles_near_the_end_of_doubles_are_listed_where_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
