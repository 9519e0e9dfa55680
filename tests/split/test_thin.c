/* test_thin.c: fragments are charged, and cells in which cuts split too much are thinned out: grain makes few pieces of
 * nests, whatever their number, says so, and the audit finds out where it does not. */
#include "build/options.h"
#include "split/charge/thin.h"
#include "split/fallback.h"
#include "support/memory.h"
#include "tree/tree.h"
#include <froe/formats.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "meshes.h"

/* ------------------------------------------------------------------ scenes -- */

/** As mesh_shells(), of squares in the plane. */
static froe_scene *new_squares(size_t squares) {
    double *x = test_malloc(16 * squares * sizeof *x);
    double at[2] = {0, 0};
    fuzz_source r = {5};
    for (size_t i = squares; i-- > 0;) {
        const double s = pow(0.9, (double)i), u[4] = {0.8 * s, 0.6 * s, -0.8 * s, -0.6 * s};
        for (int k = 0; k < 2; k++) at[k] += 0.02 * s * (fuzz_unit(&r));
        for (int k = 0; k < 8; k++) { /* the ends of four sides, u turned by quarters */
            const int turn = (k + 1) / 2 % 4;
            x[16 * i + 2 * k] = at[0] + u[turn];
            x[16 * i + 2 * k + 1] = at[1] + u[(turn + 3) % 4];
        }
    }
    froe_scene *scene = mesh_of(2, x, 4 * squares);
    test_free(x);
    return scene;
}

static froe_scene *generated(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 1, NULL, &scene, NULL), FROE_OK);
    return scene;
}

/* ------------------------------------------------------------------- trees -- */

static froe_tree *build(froe_scene *scene, const char *settings, uint32_t threads) {
    froe_tree *tree = NULL;
    froe_diagnostic diag = {0};
    froe_build_options o = froe_build_defaults();
    o.method = "grain";
    o.settings = settings;
    o.threads = threads;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    return tree;
}

/** Builds and audits; frees the scene. */
static froe_report report_of(froe_scene *scene, const char *settings) {
    froe_diagnostic diag = {0};
    froe_tree *tree = build(scene, settings, 2);
    if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s", diag.message);
    froe_report r = froe_tree_report(tree);
    r.promises = NULL;
    froe_tree_free(tree);
    froe_scene_free(scene);
    return r;
}

static double pieces_each(froe_scene *scene, const char *settings) {
    const froe_report r = report_of(scene, settings);
    return (double)r.fragments / (double)r.objects;
}

/* ------------------------------------------------------------------- tests -- */

/** Without the guards they would be 6.3 and 7.3, and 12 times as many nests 10. */
static void nests_have_few_pieces_whatever_their_number(void **state) {
    (void)state;
    const double few = pieces_each(mesh_shells(85), NULL), more = pieces_each(mesh_shells(170), NULL);
    assert_true(few < 5.2 && more < 5.4);
    assert_true(log(more / few) / log(2) < 0.06);
    assert_true(pieces_each(new_squares(500), NULL) < 2.6);
}

/** 6.3 each before edges too short for doubles were drawn again, and vertices amid others no longer named planes. */
static void nests_of_all_scales_around_a_point_are_cut_through_it(void **state) {
    (void)state;
    assert_true(pieces_each(generated("nested-3d", 6000), NULL) < 1.5);
}

/** Where cuts split little, guards are not asked. */
static void other_scenes_are_cut_as_before(void **state) {
    static const char *const kinds[] = {"terrain", "cuboids", "triangles", "mixed-3d"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const froe_report a = report_of(generated(kinds[i], 1000), NULL);
        froe_scene *scene = generated(kinds[i], 1000);
        froe_tree *tree = build(scene, "guards=0", 2);
        const froe_report b = froe_tree_report(tree);
        assert_true(a.fragments == b.fragments && a.height == b.height && a.nodes == b.nodes);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/** What is promised of fragments does not hold without the guards, and the audit says so. */
static void the_audit_finds_a_builder_that_does_not_thin_out(void **state) {
    (void)state;
    froe_diagnostic diag = {0};
    froe_scene *scene = mesh_shells(85);
    froe_tree *tree = build(scene, "guards=0", 1);
    assert_int_equal(froe_tree_audit(tree, NULL, &diag), FROE_E_AUDIT);
    assert_non_null(strstr(diag.message, "charged_fragments"));
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void trees_do_not_depend_on_threads(void **state) {
    (void)state;
    froe_scene *scene = mesh_shells(170);
    froe_tree *one = build(scene, "effort=fast", 1), *three = build(scene, "effort=fast", 3);
    assert_true(one->node_count == three->node_count && one->piece_count == three->piece_count);
    assert_memory_equal(one->nodes, three->nodes, one->node_count * sizeof *one->nodes);
    assert_memory_equal(&one->meta, &three->meta, sizeof one->meta);
    froe_tree_free(one);
    froe_tree_free(three);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------ a small method -- */

static split_verdict cut_along_any(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    (void)config;
    if (cell->count < 2) return SPLIT_LEAF;
    return split_any_support(&work->set, cell, cell->path, cut) ? SPLIT_CUT : SPLIT_INSEPARABLE;
}

enum { COUNT = 200 };

typedef struct thinning {
    split_thin_rule rule;
    const char *kind; /**< NULL: nested */
    split_thin_notes notes;
    double fragments; /**< charged_fragments of the tree */
    int *patience;    /**< calls of progress that are left; NULL: it is not asked for */
} thinning;

/* Says no when it is asked for the last time. */
static bool go_on(void *user, double done) {
    (void)done;
    return --*(int *)user != 0;
}

/** A tree of cuts along any object, with cells of that rule thinned out. */
static froe_status grow_thinned(void *user, const froe_allocator *alloc) {
    thinning *t = user;
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    base_task task;
    tree_meta meta = {0};
    const split_method method = {.choose = cut_along_any, .thin = t->rule};
    froe_status status = froe_generate(t->kind ? t->kind : "nested", COUNT, 1, alloc, &scene, NULL);
    if (status) return status;
    base_task_init(&task, 1, t->patience ? go_on : NULL, t->patience);
    memset(&t->notes, 0, sizeof t->notes);
    const split_job job = {.scene = scene, .alloc = scene->alloc, .task = &task, .meta = &meta, .thinned = &t->notes};
    status = split_grow(&job, &method, &tree);
    if (!status) status = tree_measure(tree, "charged_fragments", &t->fragments);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

/** Fragments of cells where the charge ends are what the rule allows, and no fewer than without it. */
static void growth_ends_where_the_rule_says(void **state) {
    (void)state;
    thinning t = {.rule = {1.2, 16, 16}}, none = {.rule = {1.2, 16, 0}};
    const froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(grow_thinned(&t, &alloc), FROE_OK);
    assert_int_equal(grow_thinned(&none, &alloc), FROE_OK);
    assert_true(t.notes.before > 0 && none.notes.before == 0);
    assert_true(t.fragments <= 1.2001 * COUNT + (double)(t.notes.after - t.notes.before));
    assert_true(none.fragments > 1.2001 * COUNT);
}

/** However small cubes are, many of these lines cross each. */
static void what_crosses_is_not_thinned_out(void **state) {
    (void)state;
    thinning t = {.rule = {1.2, 16, 2}, .kind = "border"};
    const froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(grow_thinned(&t, &alloc), FROE_OK);
    assert_true(t.notes.before == 0);
}

static void growth_can_be_cancelled_at_every_call(void **state) {
    (void)state;
    int all = 0;
    const thinning usual = {.rule = {1.2, 16, 16}};
    const froe_allocator own = support_allocator(NULL);
    thinning t = usual;
    t.patience = &all;
    assert_int_equal(grow_thinned(&t, &own), FROE_OK);
    assert_true(all < -9);
    for (int last = 1, most = -all; last <= most; last++) {
        test_memory m;
        const froe_allocator alloc = test_memory_begin(&m);
        int left = last;
        t = usual, t.patience = &left;
        assert_int_equal(grow_thinned(&t, &alloc), FROE_E_CANCELLED);
        assert_true(left <= 0);
        test_memory_end(&m);
    }
}

static void thinning_survives_every_failing_allocation(void **state) {
    (void)state;
    thinning t = {.rule = {1.2, 16, 16}};
    test_memory_each(grow_thinned, &t);
    assert_true(t.notes.before > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nests_have_few_pieces_whatever_their_number),
        cmocka_unit_test(nests_of_all_scales_around_a_point_are_cut_through_it),
        cmocka_unit_test(other_scenes_are_cut_as_before),
        cmocka_unit_test(the_audit_finds_a_builder_that_does_not_thin_out),
        cmocka_unit_test(trees_do_not_depend_on_threads),
        cmocka_unit_test(growth_ends_where_the_rule_says),
        cmocka_unit_test(what_crosses_is_not_thinned_out),
        cmocka_unit_test(growth_can_be_cancelled_at_every_call),
        cmocka_unit_test(thinning_survives_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
