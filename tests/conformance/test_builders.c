/* Every builder on every kind of generated scene: the audit passes, and the tree depends on nothing but
 * scene, options and seed. Walks froe_method_at() and froe_generator_at(): a new builder or kind
 * of scene needs no line here. */
#include "base/random.h"
#include "build/options.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include "tree/tree.h"
#include <froe/io.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    OBJECTS = 60,
    MANY = 1100, /* beyond what is built in one task */
    BUDGET = 10000
};

static const char *chosen; /* the only method to look at; NULL: all of them */

static bool serves(const froe_method_info *m, const froe_scene *scene) {
    return (!chosen || !strcmp(m->name, chosen)) && froe_method_serves(m, scene, FROE_LEAF_OWN);
}

static bool may_end_in_cuts(const froe_scene *scene, const froe_method_info *method) {
    size_t n = froe_scene_object_count(scene);
    if (method->least_leaf) return false;
    return (froe_scene_dim(scene) == 2 && froe_scene_kind_count(scene, FROE_SEGMENT) == n) ||
           (froe_scene_dim(scene) == 3 && froe_scene_kind_count(scene, FROE_POLYGON) == n);
}

static void assert_same_tree(const froe_tree *a, const froe_tree *b) {
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->piece_count, b->piece_count);
    assert_int_equal(a->bound_count, b->bound_count);
    assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
    assert_int_equal(a->packed.block_count, b->packed.block_count);
    if (tree_is_packed(a))
        assert_memory_equal(a->packed.blocks, b->packed.blocks, (size_t)a->packed.block_count * 64);
    else
        assert_memory_equal(a->pieces, b->pieces, a->piece_count * sizeof *a->pieces);
    if (a->cut_count) assert_memory_equal(a->cuts, b->cuts, a->cut_count * sizeof *a->cuts);
    if (a->bound_count > 1) assert_memory_equal(a->bounds + 1, b->bounds + 1, (a->bound_count - 1) * sizeof *a->bounds);
}

static bool has_option(const froe_method_info *method, const char *name) {
    for (const froe_option_info *o = method->options; o && o->name; o++)
        if (!strcmp(o->name, name)) return true;
    return false;
}

static bool has_guard_stage(const froe_method_info *method) {
    return !strcmp(method->name, "density") || !strcmp(method->name, "bar");
}

/** What a method needs to serve every scene. */
static const char *plain_settings(const froe_method_info *method) {
    return has_option(method, "crossing") ? "crossing=split" : NULL;
}

/** Small scenes must not slip by the guard stage of methods that have one. */
static const char *settings_of(const froe_method_info *method) {
    return has_guard_stage(method) ? "k=4 stop=1" : plain_settings(method);
}

static froe_build_options options(const char *method, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    o.method = method;
    for (size_t i = 0; froe_method_at(i); i++)
        if (!strcmp(froe_method_at(i)->name, method)) o.settings = plain_settings(froe_method_at(i));
    o.leaf = leaf;
    o.threads = 1;
    return o;
}

static froe_tree *build(froe_scene *scene, const froe_build_options *o) {
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    if (build_tuned(scene, o, &tree, &diag)) fail_msg("%s: %s", o->method, diag.message);
    return tree;
}

static void audit(const froe_tree *tree, const char *scene_name, uint32_t leaf) {
    froe_audit_options o = froe_audit_defaults();
    froe_diagnostic diag = {0};
    o.exact_only = true;
    if (froe_tree_audit(tree, &o, &diag))
        fail_msg("%s on %s, leaf %u: %s", froe_tree_report(tree).method, scene_name, leaf, diag.message);
}

typedef void scene_fn(froe_scene *scene, const froe_method_info *method, const char *name);

/** Calls fn for every generated scene and every method that serves it, or for one of so many, in turn by both. */
static void for_all(size_t n, size_t share, scene_fn *fn) {
    size_t calls = 0;
    for (size_t g = 0; froe_generator_at(g); g++) {
        froe_scene *scene;
        const char *name = froe_generator_at(g)->name;
        assert_int_equal(froe_generate(name, n, 7, NULL, &scene, NULL), FROE_OK);
        for (size_t m = 0; froe_method_at(m); m++)
            if ((g + m) % share == 0 && serves(froe_method_at(m), scene)) fn(scene, froe_method_at(m), name), calls++;
        froe_scene_free(scene);
    }
    assert_true(calls > (chosen ? 0 : 20));
}

static void check_audit(froe_scene *scene, const froe_method_info *method, const char *name) {
    static const uint32_t leaves[] = {5, 1, 0};
    bool large = false; /* one audit of a large tree is enough */
    for (size_t i = 0; i < (may_end_in_cuts(scene, method) ? 3 : 2) && !large; i++) {
        froe_build_options o = options(method->name, leaves[i]);
        for (int variant = 0; variant < 2; variant++) {
            if (variant && !has_guard_stage(method)) break;
            if (variant) o.settings = settings_of(method);
            froe_tree *tree = build(scene, &o);
            audit(tree, name, leaves[i]);
            large |= froe_tree_report(tree).fragments > BUDGET;
            froe_tree_free(tree);
        }
    }
}

/* What axis-parallel cuts leave of a cell. */
typedef struct cell_bounds {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} cell_bounds;

/** An axis-parallel cut beside its cell would leave an empty one, and boxes are listed there. */
static void check_cuts(froe_scene *scene, const froe_method_info *method, const char *name) {
    froe_build_options o = options(method->name, 5);
    froe_tree *tree = build(scene, &o);
    cell_bounds *cells = calloc(tree->node_count, sizeof *cells);
    assert_non_null(cells);
    for (int k = 0; k < FROE_MAX_DIM; k++) cells[0].lo[k] = -(double)INFINITY, cells[0].hi[k] = (double)INFINITY;
    for (uint32_t i = 0; i < tree->node_count && !tree_is_packed(tree); i++) {
        if (tree_is_leaf(tree->nodes + i)) continue;
        const froe_cut cut = tree_cut_at(tree, i);
        cell_bounds *below = cells + tree->nodes[i].child, *above = below + 1;
        *below = *above = cells[i];
        if (cut.kind != FROE_CUT_AXIS) continue;
        if (!(cut.value > cells[i].lo[cut.axis] && cut.value < cells[i].hi[cut.axis]))
            fail_msg("%s on %s: node %u is cut beside its cell", method->name, name, i);
        below->hi[cut.axis] = above->lo[cut.axis] = cut.value;
    }
    free(cells);
    froe_tree_free(tree);
}

/** With the ways to find k, and without a limit to growth. */
static void check_modes(froe_scene *scene, const froe_method_info *method, const char *name) {
    static const char *const settings[] = {"mode=doubling stop=1", "mode=tuned stop=4 form=slabs growth=0",
                                           "mode=doubling guards=shape stop=1"};
    if (!has_option(method, "mode")) return;
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        froe_build_options o = options(method->name, 1);
        o.settings = settings[i];
        froe_tree *tree = build(scene, &o);
        audit(tree, name, 1);
        froe_tree_free(tree);
    }
}

/** The method itself, predicates starting at a later stage than the dispatcher would let them. */
static froe_status build_from_stage(froe_scene *scene, const build_method *method, num_stage first, froe_tree **out) {
    base_task task;
    base_task_init(&task, 1, NULL, NULL);
    build_job job = {.scene = scene,
                     .alloc = support_allocator(NULL),
                     .task = &task,
                     .leaf = 1,
                     .seed = 1,
                     .max_fragments = BUDGET,
                     .first = first};
    *out = NULL;
    assert_int_equal(options_parse(method, settings_of(&method->info), true, job.option, NULL), FROE_OK);
    if (method->resolve) method->resolve(scene, 1, job.option);
    return method->build(&job, out);
}

static void check_stages(froe_scene *scene, const froe_method_info *info, const char *name) {
    const build_method *method = (const build_method *)(const void *)info; /* info is its first member */
    froe_tree *quick, *slow;
    froe_status status = build_from_stage(scene, method, NUM_FILTER, &quick);
    (void)name;
    assert_true(status == FROE_OK || status == FROE_E_BUDGET);
    for (num_stage first = NUM_BALL; first <= NUM_EXACT; first++) {
        assert_int_equal(build_from_stage(scene, method, first, &slow), status);
        if (!status) assert_same_tree(quick, slow);
        froe_tree_free(slow);
    }
    froe_tree_free(quick);
}

static void check_threads(froe_scene *scene, const froe_method_info *method, const char *name) {
    (void)name;
    froe_tree *one = NULL, *three = NULL;
    froe_build_options o = options(method->name, 1);
    o.settings = settings_of(method);
    o.max_fragments = BUDGET; /* on scenes that need more, all numbers of threads refuse alike */
    froe_status status = build_tuned(scene, &o, &one, NULL);
    o.threads = 3;
    assert_int_equal(build_tuned(scene, &o, &three, NULL), status);
    if (!status) assert_same_tree(one, three);
    froe_tree_free(one);
    froe_tree_free(three);
}

static void check_budget(froe_scene *scene, const froe_method_info *method, const char *name) {
    froe_build_options o = options(method->name, 1);
    froe_tree *tree = build(scene, &o), *again = NULL;
    uint64_t fragments = froe_tree_report(tree).fragments;
    (void)name;
    o.max_fragments = fragments;
    assert_int_equal(build_tuned(scene, &o, &again, NULL), FROE_OK);
    froe_tree_free(again);
    again = NULL;
    o.max_fragments = fragments - 1;
    if (o.max_fragments && build_tuned(scene, &o, &again, NULL) != FROE_E_BUDGET) {
        assert_string_equal(method->name, "density"); /* where one of its ways exceeds the budget, it takes the other */
        assert_true(froe_tree_report(again).fragments <= o.max_fragments);
        assert_int_equal(froe_tree_audit(again, NULL, NULL), FROE_OK);
    }
    froe_tree_free(again);
    froe_tree_free(tree);
}

static bool refuse(void *user, double done) {
    (void)done;
    return --*(int *)user > 0;
}

static void check_cancel(froe_scene *scene, const froe_method_info *method, const char *name) {
    (void)name;
    for (int calls = 1; calls < 4; calls++) {
        int left = calls;
        froe_tree *tree = NULL;
        froe_build_options o = options(method->name, 1);
        o.progress = refuse;
        o.user = &left;
        froe_status status = build_tuned(scene, &o, &tree, NULL);
        assert_int_equal(status, left > 0 ? FROE_OK : FROE_E_CANCELLED);
        froe_tree_free(tree);
    }
}

typedef struct fault {
    const char *kind, *method, *settings;
} fault;

/** Makes a scene and a tree in memory that runs out at some moment. */
static froe_status build_in(void *user, const froe_allocator *alloc) {
    const fault *f = user;
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = options(f->method, 1);
    o.settings = f->settings;
    froe_status status = froe_generate(f->kind, 24, 7, alloc, &scene, NULL);
    if (!status) status = build_tuned(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void a_build_survives_every_failing_allocation(void **state) {
    static const fault faults[] = {{"segments", "autopartition", NULL},
                                   {"segments", "density", "k=4 stop=1"},
                                   {"balls", "density", "k=4 stop=1"},
                                   {"triangles", "autopartition", NULL},
                                   {"triangles", "density", "k=4 stop=1"},
                                   {"triangles", "grain", NULL},
                                   {"segments", "grain", "effort=min"},
                                   {"segments", "paterson_yao", "rule=slabs"},
                                   {"segments", "paterson_yao", "rule=orthogonal"},
                                   {"debris-3d", "directional", "structure=trees"},
                                   {"segments", "cylindrical", NULL},
                                   {"triangles", "cylindrical", NULL}};
    (void)state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) test_memory_each(build_in, (void *)&faults[i]);
}

static bool count_to_fifty(void *user, double done) {
    (void)done;
    return ++*(int *)user < 50;
}

/** Any two of these balls overlap, but no point is in all: every pair is looked at, and nothing separates any. */
static void long_work_on_one_cell_can_be_cancelled(void **state) {
    enum { COUNT = 90 };
    static const double centres[3][2] = {{0, 0}, {1.9, 0}, {0.95, 1.6}};
    double coords[2 * COUNT], radii[COUNT];
    froe_scene *scene;
    froe_tree *tree = NULL;
    froe_diagnostic diag = {0};
    int calls = 0;
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        coords[2 * i] = centres[i % 3][0] + i * 0x1p-14;
        coords[2 * i + 1] = centres[i % 3][1];
        radii[i] = 1;
    }
    froe_objects balls = froe_objects_defaults();
    balls.kind = FROE_BALL;
    balls.count = COUNT;
    balls.coords = coords;
    balls.radii = radii;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &balls, NULL), FROE_OK);
    froe_build_options o = options("density", 1);
    o.settings = "stop=1000";
    o.progress = count_to_fifty;
    o.user = &calls;
    assert_int_equal(build_tuned(scene, &o, &tree, &diag), FROE_E_CANCELLED);
    assert_string_equal(diag.message, "Cancelled.");
    o.progress = NULL;
    tree = build(scene, &o);
    assert_int_equal(froe_tree_report(tree).inseparable, 1);
    froe_audit_options audits = froe_audit_defaults();
    audits.threads = 1;
    audits.progress = count_to_fifty;
    audits.user = &calls;
    calls = 0;
    assert_int_equal(froe_tree_audit(tree, &audits, &diag), FROE_E_CANCELLED);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static bool count_down(void *user, double done) {
    (void)done;
    return (*(int *)user)--;
}

/** Also by the stages that only look for settings. */
static void every_cancelled_build_says_so(void **state) {
    static const char *const settings[] = {"mode=fixed", "mode=doubling", "mode=tuned"};
    (void)state;
    for (int i = 0; i < 3 * 50; i++) {
        int calls = i / 3 * 20;
        froe_scene *scene;
        froe_tree *tree = NULL;
        froe_diagnostic diag = {0};
        froe_build_options o = options("density", 1);
        o.settings = settings[i % 3];
        o.progress = count_down;
        o.user = &calls;
        assert_int_equal(froe_generate("segments", MANY, 7, NULL, &scene, NULL), FROE_OK);
        froe_status status = build_tuned(scene, &o, &tree, &diag);
        assert_int_equal(diag.status, status);
        assert_string_equal(diag.message, status ? "Cancelled." : "");
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

typedef struct last_word {
    int calls, stop; /* says no at this call; 0: at none */
} last_word;

static bool speak(void *user, double done) {
    last_word *word = user;
    word->calls++;
    return word->calls != word->stop && done >= 0;
}

/** The last call tells that all is done. Who says no then has no tree either, and can add to the scene. */
static void a_build_can_be_cancelled_by_the_last_call(void **state) {
    (void)state;
    for (size_t m = 0; froe_method_at(m); m++) {
        froe_scene *scene;
        last_word word = {0};
        froe_build_options o = options(froe_method_at(m)->name, 1);
        o.threads = 1, o.progress = speak, o.user = &word;
        assert_int_equal(froe_generate(froe_method_at(m)->kinds[2] ? "segments" : "boxes", 40, 7, NULL, &scene, NULL),
                         FROE_OK);
        if (!serves(froe_method_at(m), scene)) {
            froe_scene_free(scene);
            continue;
        }
        froe_tree_free(build(scene, &o));
        assert_true(word.calls > 1);
        froe_tree *tree = NULL;
        froe_diagnostic diag = {0};
        word.stop = word.calls, word.calls = 0;
        assert_int_equal(build_tuned(scene, &o, &tree, &diag), FROE_E_CANCELLED);
        assert_string_equal(diag.message, "Cancelled.");
        assert_null(tree);
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "more"}, NULL), FROE_OK);
        froe_scene_free(scene);
    }
}

static void settings_have_decimal_points_in_any_locale(void **state) {
    static const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C"};
    (void)state;
    for (size_t i = 0; i < sizeof locales / sizeof *locales; i++) {
        froe_scene *scene;
        froe_build_options o = options("density", 1);
        o.settings = "growth=1.25";
        setlocale(LC_ALL, locales[i]); /* where it is not installed nothing changes */
        assert_int_equal(froe_generate("segments", OBJECTS, 7, NULL, &scene, NULL), FROE_OK);
        froe_tree *tree = build(scene, &o);
        assert_non_null(strstr(froe_tree_report(tree).settings, "growth=1.25 "));
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void every_way_to_find_k_passes_the_exact_audit(void **state) {
    (void)state;
    for_all(OBJECTS, 1, check_modes);
}

static void every_tree_passes_the_exact_audit(void **state) {
    (void)state;
    for_all(OBJECTS, 1, check_audit);
}

static void every_cut_is_inside_its_cell(void **state) {
    (void)state;
    for_all(420, SANITIZED_SHARE(4), check_cuts);
}

static void a_tree_does_not_depend_on_filters(void **state) {
    (void)state;
    for_all(OBJECTS, 1, check_stages);
}

static void a_tree_does_not_depend_on_threads(void **state) {
    (void)state;
    for_all(MANY, SANITIZED ? 8 : 4, check_threads);
}

static void a_budget_is_kept_to_the_piece(void **state) {
    (void)state;
    for_all(OBJECTS, 1, check_budget);
}

static void a_build_can_be_cancelled(void **state) {
    (void)state;
    for_all(OBJECTS, 1, check_cancel);
}

/** All within one task: the callback is asked there, too. */
static void a_long_build_of_few_objects_can_be_cancelled(void **state) {
    static const char *const kinds[] = {"slats", "triangles"};
    (void)state;
    for (int m = 0; froe_method_at((size_t)m / 2); m++) {
        const froe_method_info *method = froe_method_at((size_t)m / 2);
        froe_scene *scene = NULL;
        froe_tree *tree = NULL;
        int left = 10;
        froe_build_options o = options(method->name, 1);
        o.progress = refuse;
        o.user = &left;
        assert_int_equal(froe_generate(kinds[m % 2], m % 2 ? 900 : 200, 7, NULL, &scene, NULL), FROE_OK);
        if (serves(method, scene)) assert_int_equal(build_tuned(scene, &o, &tree, NULL), FROE_E_CANCELLED);
        froe_scene_free(scene);
    }
}

/** A few objects of one kind; NULL where there are none. */
static froe_scene *scene_of_kind(int dim, froe_kind kind) {
    enum { COUNT = 12 };
    static const size_t corners[FROE_KIND_COUNT] = {1, 2, 3, 2, 1, 3};
    double coords[COUNT * 3 * FROE_MAX_DIM], radii[COUNT];
    const size_t width = (size_t)dim, each = corners[kind];
    for (size_t i = 0; i < COUNT; i++) {
        radii[i] = 0.25;
        for (size_t c = 0; c < each; c++)
            for (size_t k = 0; k < width; k++) /* corners ascend, as those of boxes must */
                coords[(i * each + c) * width + k] =
                    (double)(c + base_below(base_hash(i, k, kind), 40)) + (double)(c * (k + 1) * (k + c) % 7) / 16;
    }
    froe_scene *scene;
    froe_objects batch = froe_objects_defaults();
    batch.kind = kind, batch.count = COUNT, batch.coords = coords, batch.radii = kind == FROE_BALL ? radii : NULL;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    const froe_status status = froe_scene_add(scene, &batch, NULL);
    if (!status) return scene;
    assert_int_equal(status, FROE_E_UNSUPPORTED);
    froe_scene_free(scene);
    return NULL;
}

static void methods_serve_the_kinds_they_list_and_no_others(void **state) {
    (void)state;
    size_t served = 0, refused = 0;
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++)
        for (int kind = 0; kind < FROE_KIND_COUNT; kind++) {
            froe_scene *scene = scene_of_kind(dim, (froe_kind)kind);
            const froe_method_info *m;
            for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++) {
                const bool listed = m->kinds[dim] >> kind & 1;
                assert_true(m->kinds[0] == 0 && m->kinds[1] == 0);
                assert_true(scene || !listed);
                assert_int_equal(froe_method_serves(m, scene, FROE_LEAF_OWN), listed);
                if (!scene) continue;
                froe_tree *tree = NULL;
                froe_diagnostic why = {.message = ""};
                froe_build_options o = froe_build_defaults();
                o.method = m->name, o.settings = plain_settings(m);
                const froe_status status = froe_build(scene, &o, &tree, &why);
                if (status != (listed ? FROE_OK : FROE_E_UNSUPPORTED))
                    fail_msg("%s, %s in R^%d: status %d, %s", m->name, froe_kind_name((froe_kind)kind), dim, status,
                             why.message);
                assert_true(listed || strstr(why.message, "does not serve"));
                froe_tree_free(tree);
                served += listed, refused += !listed;
            }
            for (size_t i = 0; scene && i < 3; i++) { /* what auto stands for serves */
                froe_tree *tree = NULL;
                froe_build_options o = froe_build_defaults();
                o.purpose = (const char *const[]){"pieces", "query", "draw"}[i];
                assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
                froe_tree_free(tree);
            }
            froe_scene_free(scene);
        }
    assert_true(served > 100 && refused > 50);
}

/* With the name of a method as argument: that method alone. With "all": what is not looked at method by method. */
int main(int argc, char **argv) {
    const struct CMUnitTest each[] = {
        cmocka_unit_test(every_tree_passes_the_exact_audit),
        cmocka_unit_test(every_way_to_find_k_passes_the_exact_audit),
        cmocka_unit_test(every_cut_is_inside_its_cell),
        cmocka_unit_test(a_tree_does_not_depend_on_filters),
        cmocka_unit_test(a_tree_does_not_depend_on_threads),
        cmocka_unit_test(a_budget_is_kept_to_the_piece),
        cmocka_unit_test(a_build_can_be_cancelled),
    };
    const struct CMUnitTest all[] = {
        cmocka_unit_test(methods_serve_the_kinds_they_list_and_no_others),
        cmocka_unit_test(long_work_on_one_cell_can_be_cancelled),
        cmocka_unit_test(every_cancelled_build_says_so),
        cmocka_unit_test(a_build_can_be_cancelled_by_the_last_call),
        cmocka_unit_test(settings_have_decimal_points_in_any_locale),
        cmocka_unit_test(a_long_build_of_few_objects_can_be_cancelled),
        cmocka_unit_test(a_build_survives_every_failing_allocation),
    };
    if (argc > 1 && !strcmp(argv[1], "all")) return cmocka_run_group_tests(all, NULL, NULL);
    if (argc > 1) chosen = argv[1];
    return cmocka_run_group_tests(each, NULL, NULL);
}
