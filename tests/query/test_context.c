/* Query contexts: marks, sharing of prepared parts, failing allocations. */
#include "geom/predicates.h"
#include "query/cuts.h"
#include "tree/trees.h"
#include <pthread.h>

/* ------------------------------------------------------------------- marks -- */

/** Marks random objects of `objects` and compares with a table of all. */
static void check_marks(query_marks *marks, const froe_allocator *alloc, uint32_t objects, uint32_t count,
                        uint64_t seed) {
    bool *seen = calloc(objects, 1);
    query_marks_clear(marks);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t object = trees_random(seed, i, objects);
        assert_true(query_marks_reserve(marks, alloc, objects, 1));
        assert_int_equal(query_mark(marks, object), !seen[object]);
        seen[object] = true;
    }
    free(seen);
}

static void an_object_is_marked_once_a_query(void **state) {
    enum { OBJECTS = 1000 };
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    static query_marks marks;
    (void)state;
    for (uint32_t i = 0; i < 200; i++) check_marks(&marks, &alloc, OBJECTS, 7 * i, i);
    query_marks_free(&marks, &alloc);
    test_memory_end(&m);
}

static void small_queries_take_no_memory(void **state) {
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    static query_marks marks;
    (void)state;
    for (uint32_t i = 0; i < 100; i++) check_marks(&marks, &alloc, 1u << 20, QUERY_FEW_MOST, i);
    assert_int_equal(m.calls, 0);
    test_memory_end(&m);
}

static void marks_survive_the_overflow_of_their_counter(void **state) {
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    static query_marks marks;
    (void)state;
    check_marks(&marks, &alloc, 500, 400, 1); /* marked by query 1 */
    marks.query = UINT32_MAX - 1;
    for (uint32_t i = 0; i < 4; i++) check_marks(&marks, &alloc, 500, i % 2 ? 400 : 50, i);
    query_marks_free(&marks, &alloc);
    test_memory_end(&m);
}

/* ---------------------------------------------------------------- contexts -- */

static void bad_arguments_are_refused(void **state) {
    (void)state;
    froe_query *q = NULL;
    froe_diagnostic diag;
    assert_int_equal(froe_query_new(NULL, &q, &diag), FROE_E_ARG);
    assert_int_equal(diag.status, FROE_E_ARG);
    assert_int_equal(froe_query_fork(NULL, &q, NULL), FROE_E_ARG);
    assert_null(q);
    froe_query_free(NULL);
}

static void statistics_begin_again_when_read(void **state) {
    (void)state;
    froe_query *q;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 0.3, "autopartition", 1);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    query_begin(q);
    query_begin(q);
    assert_int_equal(froe_query_statistics(q).queries, 2);
    assert_int_equal(froe_query_statistics(q).queries, 0);
    froe_query_free(q);
    froe_tree_free(tree);
}

typedef struct asker {
    froe_query *query;
    const query_planes *planes;
    froe_status status;
} asker;

static void *ask(void *user) {
    asker *a = user;
    a->status = query_planes_of(a->query, &a->planes, NULL);
    return NULL;
}

/** However many threads ask at once. */
static void forks_share_what_is_prepared(void **state) {
    enum { THREADS = 4, ROUNDS = 50 };
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 200, 0, 0.3, "autopartition", 1);
    for (int round = 0; round < ROUNDS; round++) {
        asker askers[THREADS];
        pthread_t threads[THREADS];
        assert_int_equal(froe_query_new(tree, &askers[0].query, NULL), FROE_OK);
        for (int i = 1; i < THREADS; i++)
            assert_int_equal(froe_query_fork(askers[0].query, &askers[i].query, NULL), FROE_OK);
        for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_create(threads + i, NULL, ask, askers + i), 0);
        for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
        for (int i = 0; i < THREADS; i++) {
            assert_int_equal(askers[i].status, FROE_OK);
            assert_ptr_equal(askers[i].planes, askers[0].planes);
        }
        for (int i = 0; i < THREADS; i++) froe_query_free(askers[i].query); /* in any order */
    }
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------- cuts -- */

/** Where the filter is sure it agrees with the exact predicate. */
static void check_cuts(const froe_tree *tree, uint64_t seed) {
    froe_query *q;
    const query_planes *planes;
    uint64_t draw = 0, sure = 0;
    int dim = tree->scene->dim;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(query_planes_of(q, &planes, NULL), FROE_OK);
    for (uint32_t v = 0; v < tree->node_count; v++) {
        if (tree_is_leaf(tree->nodes + v)) continue;
        query_cut cut = query_cut_at(tree, planes, tree->nodes + v);
        geom_plane plane = tree_plane_at(tree, v);
        for (int i = 0; i < 8; i++) {
            double x[3] = {0}, error;
            for (int k = 0; k < dim; k++) x[k] = trees_unit(seed, draw++);
            if (i % 2)
                memcpy(x, scene_vertex(tree->scene, trees_random(seed, draw++, tree->scene->vertex_count)),
                       (size_t)dim * sizeof *x);
            int side = geom_side_vertex(&q->numbers, &plane, x);
            if (cut.axis >= 0) {
                assert_int_equal(side, (x[cut.axis] > cut.value) - (x[cut.axis] < cut.value));
                continue;
            }
            double value = query_plane_value(cut.plane, dim, x, &error);
            if (value > error) assert_int_equal(side, 1);
            if (value < -error) assert_int_equal(side, -1);
            sure += value > error || value < -error;
        }
    }
    assert_true(sure > 0);
    froe_query_free(q);
}

static void planes_of_cuts_are_sure_of_nothing_wrong(void **state) {
    (void)state;
    for (int grid = 0; grid <= 8; grid += 8) {
        froe_tree *tree = trees_grow(2, FROE_SEGMENT, 200, (uint32_t)grid, 0.5, "autopartition", 1);
        check_cuts(tree, 1);
        froe_tree_free(tree);
        tree = trees_grow(3, FROE_POLYGON, 100, (uint32_t)grid, 0.5, "density", 1);
        check_cuts(tree, 2);
        froe_tree_free(tree);
        tree = trees_grow(2, FROE_SEGMENT, 200, (uint32_t)grid, 0.5, "cylindrical", 1);
        check_cuts(tree, 3);
        froe_tree_free(tree);
    }
}

/* A segment and a wall cut many cells of a cylindrical tree. */
static void cuts_along_the_same_line_share_a_plane(void **state) {
    froe_query *q;
    const query_planes *planes;
    uint32_t others = 0;
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 200, 0, 0.5, "cylindrical", 1);
    for (uint32_t i = 0; i < tree->cut_count; i++) others += tree->cuts[i].kind == FROE_CUT_CROSSING;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(query_planes_of(q, &planes, NULL), FROE_OK);
    assert_non_null(planes->numbers);
    assert_true(planes->count <= tree->scene->object_count + tree->scene->vertex_count + others);
    assert_true(2 * planes->count <= tree->cut_count);
    froe_query_free(q);
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------ faults -- */

static froe_status contexts(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL, *fork = NULL;
    const query_planes *planes;
    froe_build_options o = froe_build_defaults();
    o.method = user;
    o.threads = 1;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 5, 0, 0.5, 1);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = froe_query_fork(q, &fork, NULL);
    if (!status) status = query_planes_of(q, &planes, NULL);
    if (!status) status = query_expect(q, QUERY_FEW) ? FROE_OK : FROE_E_MEMORY;
    froe_query_free(q);
    froe_query_free(fork);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    assert_true(test_memory_each(contexts, "autopartition") > 5);
    assert_true(test_memory_each(contexts, "cylindrical") > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_object_is_marked_once_a_query),
        cmocka_unit_test(small_queries_take_no_memory),
        cmocka_unit_test(marks_survive_the_overflow_of_their_counter),
        cmocka_unit_test(bad_arguments_are_refused),
        cmocka_unit_test(statistics_begin_again_when_read),
        cmocka_unit_test(forks_share_what_is_prepared),
        cmocka_unit_test(planes_of_cuts_are_sure_of_nothing_wrong),
        cmocka_unit_test(cuts_along_the_same_line_share_a_plane),
        cmocka_unit_test(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
