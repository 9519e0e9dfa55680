/* test_directional.c: cuts of boxes: sweeps and trees agree, rooms pay for what is divided, and nothing else matters
 * than the boxes. */
#include "build/directional/boxes.h"
#include "build/options.h"
#include "tree/tree.h"
#include <float.h>
#include <froe/io.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/memory.h"

static const char *const kinds[] = {"boxes",     "boxes-3d",  "rows",   "debris", "sticks",
                                    "slabs",     "towers",    "panels", "shells", "bars",
                                    "debris-3d", "debris-5d", "bricks", "plates", "moons"};
enum { KINDS = sizeof kinds / sizeof *kinds };

static froe_scene *generate(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 3, NULL, &scene, NULL), FROE_OK);
    return scene;
}

static froe_tree *build(froe_scene *scene, const char *settings, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "directional";
    o.settings = settings;
    o.leaf = leaf;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    return tree;
}

static void audit(const froe_tree *tree, const char *what) {
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    exact.exact_only = true;
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s: %s", what, diag.message);
}

static void assert_same(const froe_tree *a, const froe_tree *b, const char *what) {
    if (a->node_count != b->node_count || a->piece_count != b->piece_count || a->cut_count != b->cut_count ||
        memcmp(a->nodes, b->nodes, a->node_count * sizeof *a->nodes) != 0 ||
        (a->piece_count && memcmp(a->pieces, b->pieces, a->piece_count * sizeof *a->pieces) != 0) ||
        (a->cut_count && memcmp(a->cuts, b->cuts, a->cut_count * sizeof *a->cuts) != 0))
        fail_msg("%s: not the same tree", what);
}

static void sweeps_and_trees_make_the_same_tree(void **state) {
    static const char *const options[] = {"boxes=solid",         "boxes=faces", "delta=0.25 trade=1",
                                          "trade=9 boxes=faces", "slack=0",     "balance=0.7 slack=0.1"};
    (void)state;
    for (size_t k = 0; k < KINDS; k++) {
        froe_scene *scene = generate(kinds[k], strcmp(kinds[k], "shells") != 0 ? 400 : 60);
        for (size_t o = 0; o < sizeof options / sizeof *options; o++) {
            char settings[2][80];
            snprintf(settings[0], sizeof settings[0], "%s structure=sweep", options[o]);
            snprintf(settings[1], sizeof settings[1], "%s structure=trees", options[o]);
            froe_tree *sweep = build(scene, settings[0], 1), *trees = build(scene, settings[1], 1);
            assert_same(sweep, trees, kinds[k]);
            audit(sweep, kinds[k]);
            froe_tree_free(sweep);
            froe_tree_free(trees);
        }
        froe_scene_free(scene);
    }
}

static double load_of(const froe_tree *tree) {
    return (double)froe_tree_report(tree).max_leaf;
}

static void disjoint_boxes_end_alone(void **state) {
    static const char *const disjoint[] = {"rows", "sticks", "slabs",  "towers", "panels",
                                           "bars", "bricks", "plates", "moons"};
    (void)state;
    for (size_t k = 0; k < sizeof disjoint / sizeof *disjoint; k++) {
        froe_scene *scene = generate(disjoint[k], 3000);
        froe_tree *tree = build(scene, NULL, 1);
        assert_true(load_of(tree) <= 1);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* A lattice of cells of which each holds one box: flat ones, full ones that touch their neighbours, and smaller ones.
 */
static froe_scene *lattice(int dim, uint32_t side, uint32_t n) {
    static double coords[512 * 2 * FROE_MAX_DIM];
    fuzz_source random = {(uint64_t)dim};
    for (uint32_t i = 0; i < n; i++) {
        uint32_t place = i;
        for (int k = 0; k < dim; k++, place /= side) {
            int lo = fuzz_int(&random, 0, 2), hi = fuzz_int(&random, lo, 2);
            coords[2 * i * (uint32_t)dim + (uint32_t)k] = 2 * (place % side) + (place % 2 ? 0 : lo);
            coords[(2 * i + 1) * (uint32_t)dim + (uint32_t)k] = 2 * (place % side) + (place % 2 ? 2 : hi);
        }
    }
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene = NULL;
    objects.kind = FROE_BOX, objects.count = n, objects.coords = coords;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    return scene;
}

static void disjoint_boxes_end_alone_in_any_dimension(void **state) {
    static const uint32_t sides[] = {0, 0, 20, 7, 4, 3, 2, 2, 2};
    (void)state;
    for (int dim = 2; dim <= 8; dim++) {
        uint32_t n = 1;
        for (int k = 0; k < dim; k++) n *= sides[dim];
        froe_scene *scene = lattice(dim, sides[dim], n);
        froe_tree *sweep = build(scene, "structure=sweep", 1), *trees = build(scene, "structure=trees", 1);
        assert_same(sweep, trees, "lattice");
        audit(sweep, "lattice");
        for (uint32_t i = 0; i < sweep->node_count; i++)
            if (sweep->nodes[i].type == TREE_LEAF) assert_true(sweep->nodes[i].u.list.count <= 1);
        froe_tree_free(sweep);
        froe_tree_free(trees);
        froe_scene_free(scene);
    }
}

/* Boxes that leave nothing to be decided by: equal, in one point, in one plane, of all sizes that doubles have. */
static void degenerate_scenes_come_to_an_end(void **state) {
    static const double wide[] = {-DBL_MAX, -1, -DBL_TRUE_MIN, 0, DBL_TRUE_MIN, 1, DBL_MAX};
    enum { WIDE = sizeof wide / sizeof *wide, EACH = 60 };
    (void)state;
    for (int dim = 2; dim <= 8; dim++)
        for (int kind = 0; kind < 4; kind++) {
            double coords[EACH * 2 * FROE_MAX_DIM];
            fuzz_source random = {(uint64_t)(10 * dim + kind)};
            for (int i = 0; i < EACH; i++)
                for (int k = 0; k < dim; k++) {
                    int lo = fuzz_int(&random, 0, WIDE - 1), hi = fuzz_int(&random, lo, WIDE - 1);
                    if (kind == 0) lo = 2, hi = 5;        /* equal boxes */
                    if (kind == 1) lo = hi = 3;           /* equal points */
                    if (kind == 2 && k == 0) lo = hi = 3; /* in one plane */
                    coords[2 * i * dim + k] = wide[lo];
                    coords[(2 * i + 1) * dim + k] = wide[hi];
                }
            froe_objects objects = froe_objects_defaults();
            froe_scene *scene = NULL;
            objects.kind = FROE_BOX, objects.count = dim < 5 ? EACH : 12, objects.coords = coords;
            assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
            assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
            for (int faces = 0; faces < 2; faces++) {
                froe_tree *sweep = build(scene, faces ? "boxes=faces structure=sweep" : "structure=sweep", 1);
                froe_tree *trees = build(scene, faces ? "boxes=faces structure=trees" : "structure=trees", 1);
                assert_same(sweep, trees, "degenerate");
                audit(sweep, "degenerate");
                froe_tree_free(sweep);
                froe_tree_free(trees);
            }
            froe_scene_free(scene);
        }
}

static void what_touches_is_not_divided(void **state) {
    froe_scene *scene = generate("bricks", 1000);
    froe_tree *tree = build(scene, NULL, 1);
    (void)state;
    assert_int_equal(froe_tree_report(tree).fragments, 1000);
    assert_true(froe_tree_report(tree).height <= 12); /* log2 of 10, rounded up, for each axis */
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void nested_boxes_are_peeled(void **state) {
    enum { N = 200 };
    froe_scene *scene = generate("shells", N);
    (void)state;
    for (int faces = 0; faces < 2; faces++) {
        froe_tree *tree = build(scene, faces ? "boxes=faces" : NULL, 1);
        const froe_report r = froe_tree_report(tree);
        assert_int_equal(r.fragments, N); /* each is a cover once, and nothing is divided */
        assert_true(r.height <= 6 * N);
        assert_true(r.covers >= N - 8); /* few that are left stay together */
        assert_true(r.max_leaf <= 8 + 1);
        audit(tree, "shells");
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

/* A scene of random boxes, or of these boxes in another order, scaled, or with axis 0 mirrored. */
enum { BOXES = 150 };
static froe_scene *variant(int dim, const uint32_t *order, double scale) {
    static double coords[BOXES * 2 * FROE_MAX_DIM];
    fuzz_source random = {5};
    double corners[BOXES][2][FROE_MAX_DIM];
    for (int i = 0; i < BOXES; i++)
        for (int k = 0; k < dim; k++) {
            double at = floor(fuzz_unit(&random) * 200);
            corners[i][0][k] = scale * at;
            corners[i][1][k] = scale * (at + 1 + floor((fuzz_unit(&random) + 1) * 20));
        }
    for (int i = 0; i < BOXES; i++)
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < dim; k++) coords[(2 * i + e) * dim + k] = corners[order ? order[i] : (uint32_t)i][e][k];
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene = NULL;
    objects.kind = FROE_BOX;
    objects.count = BOXES;
    objects.coords = coords;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    return scene;
}

/* The same cuts, times `scale`. */
static void assert_like(const froe_tree *a, const froe_tree *b, double scale) {
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->piece_count, b->piece_count);
    for (uint32_t i = 0; i < a->node_count; i++) {
        assert_int_equal(a->nodes[i].type, b->nodes[i].type);
        assert_int_equal(a->nodes[i].axis, b->nodes[i].axis);
        if (a->nodes[i].type == TREE_PLAIN) assert_true(a->nodes[i].u.value * scale == b->nodes[i].u.value);
    }
}

static void order_and_scale_change_nothing(void **state) {
    uint32_t order[BOXES];
    (void)state;
    for (uint32_t i = 0; i < BOXES; i++) order[i] = (i * 37 + 11) % BOXES;
    for (int dim = 2; dim <= 8; dim += 3) {
        froe_scene *scenes[3] = {variant(dim, NULL, 1), variant(dim, order, 1), variant(dim, NULL, 0x1p-300)};
        for (int faces = 0; faces < 2; faces++) {
            const char *settings = faces && dim < 5 ? "boxes=faces" : "boxes=solid";
            froe_tree *trees[3];
            for (int i = 0; i < 3; i++) trees[i] = build(scenes[i], settings, 2);
            assert_like(trees[0], trees[1], 1);
            assert_like(trees[0], trees[2], 0x1p-300);
            audit(trees[0], settings);
            for (int i = 0; i < 3; i++) froe_tree_free(trees[i]);
        }
        for (int i = 0; i < 3; i++) froe_scene_free(scenes[i]);
    }
}

/* ------------------------------------------------- what the lemma says, by brute force -- */

/* What a cut of a cell divides, and the rooms it goes through, from the coordinates alone. */
static bool paid_for(const boxes *b, const boxes_cell *cell, const boxes_cut *cut) {
    int64_t divided = 0, paid = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < cell->count; i++) {
        double end[FROE_MAX_DIM][4];
        unsigned alive = 0;
        boxes_ends(b, b->fragments.data[cell->first + i].object, end);
        for (int k = 0; k < b->dim; k++) {
            bool flat = end[k][BOXES_LO] == end[k][BOXES_HI];
            if (!flat && cell->lo[k] < end[k][BOXES_BEFORE]) alive |= 1u << 2 * k;
            if (!flat && end[k][BOXES_AFTER] < cell->hi[k]) alive |= 2u << 2 * k;
        }
        assert_int_equal(alive, b->fragments.data[cell->first + i].alive);
        const double *e = end[cut->axis];
        int64_t weight = boxes_weight(b, (uint16_t)alive, cut->axis);
        bool across = e[BOXES_LO] < cut->c && cut->c < e[BOXES_HI];
        divided += across ? weight : 0;
        count += across;
        if (alive >> 2 * cut->axis & 1 && e[BOXES_BEFORE] <= cut->c && cut->c <= e[BOXES_LO]) paid += weight;
        if (alive >> 2 * cut->axis & 2 && e[BOXES_HI] <= cut->c && cut->c <= e[BOXES_AFTER]) paid += weight;
    }
    assert_int_equal(count, cut->divided);
    return b->options.trade * paid >= divided;
}

/* The sum that no cut but a forced one may raise: see boxes_weight(). */
static double potential(const boxes *b) {
    double sum = 0;
    for (size_t i = 0; i < b->fragments.count; i++) sum += (double)boxes_weight(b, b->fragments.data[i].alive, b->dim);
    return sum;
}

static void rooms_pay_for_what_is_divided(void **state) {
    static const char *const scenes[] = {"sticks", "slabs", "boxes-3d", "debris-3d", "boxes"};
    (void)state;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        froe_scene *scene = generate(scenes[k], 500);
        froe_allocator alloc = support_allocator(NULL);
        uint32_t objects[500], n = scene->object_count, lemma = 0, forced = 0;
        boxes_options options = {.delta = 0.5, .trade = 2, .slack = k % 2 ? 0.5 : 0, .balance = k == 2 ? 0.5 : 0};
        boxes b;
        boxes_cell root = {.cover = FROE_NONE};
        for (uint32_t i = 0; i < n; i++) objects[i] = i;
        for (int i = 0; i < scene->dim; i++) root.lo[i] = -INFINITY, root.hi[i] = INFINITY;
        assert_int_equal(boxes_new(scene, &alloc, &options, &b), FROE_OK);
        assert_int_equal(boxes_open(&b, root, objects, n), FROE_OK);
        while (b.cells.count) {
            boxes_cell cell = b.cells.data[--b.cells.count];
            boxes_cut cut = boxes_sweep(&b, &cell);
            if (!cut.found) {
                boxes_drop(&b, &cell);
                continue;
            }
            bool pays = paid_for(&b, &cell, &cut);
            double before = potential(&b), paid = (double)b.paid;
            assert_true(cut.forced || pays || !cut.divided);
            lemma += !cut.forced && cut.divided;
            forced += cut.forced;
            assert_int_equal(boxes_divide(&b, &cell, &cut), FROE_OK);
            assert_true(potential(&b) <= before + ((double)b.paid - paid));
        }
        if (k < 3) assert_true(lemma > 20 && forced < lemma);
        boxes_free(&b);
        froe_scene_free(scene);
    }
}

/* ----------------------------------------------------------------------- limits -- */

static froe_status build_in(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    o.method = "directional";
    o.settings = user;
    o.leaf = 1;
    froe_status status = froe_generate("debris-3d", 40, 7, alloc, &scene, NULL);
    if (!status) status = build_tuned(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void a_build_survives_every_failing_allocation(void **state) {
    (void)state;
    test_memory_each(build_in, (void *)(uintptr_t) "structure=sweep boxes=faces");
    test_memory_each(build_in, (void *)(uintptr_t) "structure=trees boxes=faces");
}

static const froe_promise *taken(const froe_tree *tree) {
    const froe_promise *p = froe_tree_report(tree).promises;
    while (p->name && strcmp(p->name, "boxes_taken") != 0) p++;
    assert_non_null(p->name);
    return p;
}

/* Faces of cubes, one in the other, come off one by one: sweeps alone would take up all that is left each time. */
static void cells_that_lose_a_box_at_a_time_are_not_swept(void **state) {
    enum { COUNT = 1800 };
    double ends[COUNT][6];
    froe_objects o = froe_objects_defaults();
    froe_scene *scene = NULL;
    double swept;
    (void)state;
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < 3; k++) ends[i][k] = -ldexp(1, i / 6), ends[i][3 + k] = ldexp(1, i / 6);
        ends[i][i % 3] = ends[i][3 + i % 3] = ldexp(i % 6 < 3 ? -1 : 1, i / 6);
    }
    o.kind = FROE_BOX, o.count = COUNT, o.coords = ends[0];
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    froe_tree *tree = build(scene, NULL, 1);
    assert_int_equal(tree_measure(tree, "path_length", &swept), FROE_OK); /* nothing is divided: boxes of all cells */
    assert_true(taken(tree)->measured <= taken(tree)->promised && taken(tree)->promised < swept);
    froe_tree_free(tree);
    froe_scene_free(scene);
    for (int kind = 0; kind < KINDS; kind++) {
        scene = generate(kinds[kind], 3000);
        tree = build(scene, NULL, 1);
        assert_true(taken(tree)->measured <= taken(tree)->promised);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void weights_that_would_not_fit_are_refused(void **state) {
    froe_scene *scene = variant(8, NULL, 1);
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    (void)state;
    o.method = "directional";
    o.settings = "trade=64";
    assert_int_equal(froe_build(scene, &o, &tree, &diag), FROE_E_OPTIONS);
    assert_non_null(strstr(diag.message, "trade"));
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweeps_and_trees_make_the_same_tree),
        cmocka_unit_test(disjoint_boxes_end_alone),
        cmocka_unit_test(disjoint_boxes_end_alone_in_any_dimension),
        cmocka_unit_test(degenerate_scenes_come_to_an_end),
        cmocka_unit_test(what_touches_is_not_divided),
        cmocka_unit_test(nested_boxes_are_peeled),
        cmocka_unit_test(order_and_scale_change_nothing),
        cmocka_unit_test(rooms_pay_for_what_is_divided),
        cmocka_unit_test(a_build_survives_every_failing_allocation),
        cmocka_unit_test(cells_that_lose_a_box_at_a_time_are_not_swept),
        cmocka_unit_test(weights_that_would_not_fit_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
