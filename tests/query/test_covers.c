/* Trees with covers: every question beside brute force, by every builder that serves the scene, in R^2 to R^8. Among
 * them are boxes one in the other, equal ones, boxes that are all of a cell, boxes without extent, and other kinds
 * within boxes. */
#include "query/answers.h"
#include "query/covers.h"
#include "query/range/centroids.h"

enum { ROUNDS = 4, DEEP = 60 };

typedef struct made {
    double coords[200 * 2 * FROE_MAX_DIM];
    size_t count;
    int dim;
} made;

static void put_box(made *m, const double *lo, const double *hi) {
    double *to = m->coords + 2 * m->count++ * (size_t)m->dim;
    memcpy(to, lo, (size_t)m->dim * sizeof *to);
    memcpy(to + m->dim, hi, (size_t)m->dim * sizeof *to);
}

/* From -size - shift to size on all axes. */
static void put_cube(made *m, double size, double shift) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (int k = 0; k < m->dim; k++) lo[k] = -size - shift, hi[k] = size;
    put_box(m, lo, hi);
}

static froe_scene *scene_of(const made *m) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(m->dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BOX, m->count, m->coords, NULL, NULL), FROE_OK);
    return scene;
}

/* Cubes one in the other, each so many times. */
static froe_scene *nested(int dim, int count, int times) {
    static made m;
    m = (made){.dim = dim};
    for (int i = 1; i <= count; i++)
        for (int t = 0; t < times; t++) put_cube(&m, i, i % 3 ? 0 : 0.5);
    return scene_of(&m);
}

/* A box around all, halves and quarters of it, which are all of a cell once it is cut, flat boxes within and on its
 * border, and points. */
static froe_scene *quarters(int dim) {
    static made m;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    m = (made){.dim = dim};
    put_cube(&m, 8, 0);
    put_cube(&m, 8, 0);
    for (uint32_t i = 0; i < 1u << (dim < 4 ? dim : 4); i++) {
        for (int k = 0; k < dim; k++) lo[k] = i >> k & 1 ? 0 : -8, hi[k] = lo[k] + 8;
        put_box(&m, lo, hi);
        if (i % 2) hi[0] = 8, lo[0] = -8, put_box(&m, lo, hi);
    }
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < dim; k++) lo[k] = (i * 5 + k * 3) % 9 - 4, hi[k] = lo[k] + (i + k) % 4;
        if (i % 3 == 0) lo[i % dim] = hi[i % dim] = i % 2 ? 8 : 4;
        put_box(&m, lo, hi);
    }
    return scene_of(&m);
}

/* Many small objects of several kinds, and boxes that hold some or all of them. */
static froe_scene *mixture(int dim, uint32_t grid) {
    const unsigned kinds = 1 << FROE_POINT | 1 << FROE_SEGMENT | 1 << FROE_BOX | 1 << FROE_BALL | 1 << FROE_HULL;
    froe_scene *scene = world_mixture(dim, kinds | (dim == 3 ? 1u << FROE_POLYGON : 0), 6, grid, 0.3, 3);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    static made m;
    m = (made){.dim = dim};
    assert_true(froe_scene_bounds(scene, lo, hi));
    for (int i = 0; i < 9; i++) {
        if (i > 3)
            for (int k = 0; k < dim; k++) (i + k) % 3 ? (hi[k] = 0.75 * hi[k] + 0.25 * lo[k]) : 0;
        put_box(&m, lo, hi);
    }
    assert_int_equal(trees_add(scene, FROE_BOX, m.count, m.coords, NULL, NULL), FROE_OK);
    return scene;
}

static uint64_t trees, with_covers;

static void check_tree(const char *name, froe_tree *tree, int rounds) {
    char why[200];
    froe_diagnostic diag = {0};
    const froe_report r = froe_tree_report(tree);
    if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s, %s: %s", name, r.method, diag.message);
    if (!answers_right(tree, trees, rounds, why, sizeof why)) fail_msg("%s, %s: %s", name, r.method, why);
    trees++;
    with_covers += r.covers > 0;
    froe_tree_free(tree);
}

/* By every method, with two settings of directional. Takes over the scene. */
static void check(const char *name, froe_scene *scene, int rounds) {
    for (size_t i = 0; froe_method_at(i); i++)
        for (int faces = 0; faces < 2; faces++) {
            froe_build_options o = froe_build_defaults();
            froe_tree *tree;
            o.method = froe_method_at(i)->name;
            o.threads = 1;
            o.max_fragments = 20000;
            if (faces && strcmp(o.method, "directional") != 0) continue;
            if (faces) o.settings = "boxes=faces";
            const froe_status status = froe_build(scene, &o, &tree, NULL);
            if (!status)
                check_tree(name, tree, rounds);
            else
                assert_true(status == FROE_E_UNSUPPORTED || status == FROE_E_OPTIONS || status == FROE_E_BUDGET);
        }
    froe_scene_free(scene);
}

static void answers_are_right_in_every_dimension(void **state) {
    (void)state;
    for (int dim = 2; dim <= 8; dim++) {
        check("nested", nested(dim, 14, 1), ROUNDS);
        check("nested, three times", nested(dim, 12, 3), ROUNDS);
        check("quarters", quarters(dim), ROUNDS);
        check("one box", nested(dim, 1, 1), 2);
    }
    print_message("%llu trees, %llu of them with covers\n", (unsigned long long)trees, (unsigned long long)with_covers);
    assert_true(with_covers > 80);
}

static void answers_are_right_among_other_kinds(void **state) {
    (void)state;
    with_covers = 0;
    for (int dim = 2; dim <= 3; dim++) {
        check("mixture", mixture(dim, 0), ROUNDS);
        check("mixture on a lattice", mixture(dim, 12), ROUNDS);
    }
    assert_true(with_covers >= 10);
}

/* Where trees are so deep that searches jump, they pass nodes with covers. */
static void searches_that_jump_miss_no_cover(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++) {
        froe_scene *scene = nested(dim, DEEP, 1);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        o.method = "directional";
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_true(query_is_deep(tree));
        check_tree("deep", tree, 3 * ROUNDS);
        froe_scene_free(scene);
    }
}

/* What is tested is what is answered, and a few more; what is visited does not depend on the height. */
static void locating_pays_for_answers_only(void **state) {
    (void)state;
    froe_scene *scene = nested(3, 200, 1);
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    froe_query *q;
    o.method = "directional";
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    assert_true(froe_tree_report(tree).height > 1000);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (int i = 0; i < 200; i++) {
        const double x[3] = {i + 0.25, 0.3, 0.2};
        const froe_query_stats before = froe_query_statistics(q);
        froe_list found;
        assert_int_equal(froe_query_locate(q, x, &found, NULL), FROE_OK);
        const froe_query_stats after = froe_query_statistics(q);
        assert_int_equal(found.count, 200 - i);
        assert_true(after.tests - before.tests <= found.count + 9);
        assert_true(after.nodes - before.nodes + after.steps - before.steps <= 60);
    }
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_query *q = NULL;
    froe_list found;
    froe_tree *tree = NULL;
    froe_scene *scene = NULL;
    const double x[2] = {0.25, 0.5};
    double coords[4 * 12];
    for (int i = 0; i < 12; i++)
        for (int k = 0; k < 4; k++) coords[4 * i + k] = k < 2 ? -i - 1 : i + 1;
    froe_objects boxes = froe_objects_defaults();
    boxes.kind = FROE_BOX, boxes.count = 12, boxes.coords = coords;
    froe_build_options o = froe_build_defaults();
    o.method = "kd";
    o.threads = 1;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = froe_scene_add(scene, &boxes, NULL);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    if (!status) status = froe_query_locate(q, x, &found, NULL);
    if (!status) assert_int_equal(found.count, 12);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    test_memory_each(ask_without_memory, NULL);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_right_in_every_dimension),
        cmocka_unit_test(answers_are_right_among_other_kinds),
        cmocka_unit_test(searches_that_jump_miss_no_cover),
        cmocka_unit_test(locating_pays_for_answers_only),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
