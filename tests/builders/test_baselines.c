/* test_baselines.c: kd, quad, grid, orthogonal paterson_yao, and autopartition on boxes: the cut of every node is the
 * one its rule names, found again by brute force; no scene makes them large. */
#include "build/options.h"
#include "tree/list.h"
#include <froe/io.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 512 };

static froe_scene *generate(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 3, NULL, &scene, NULL), FROE_OK);
    return scene;
}

static froe_scene *points_of(int dim, const double *coords, size_t count) {
    froe_scene *scene = NULL;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT;
    batch.count = count;
    batch.coords = coords;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    return scene;
}

static froe_tree *build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = method;
    o.settings = settings;
    o.leaf = leaf;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s: %s", method, diag.message);
    return tree;
}

static void audit(const froe_tree *tree) {
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    exact.exact_only = true;
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s: %s", froe_tree_report(tree).method, diag.message);
}

/* ------------------------------------------------------ objects of a subtree -- */

typedef struct members {
    uint32_t count, object[MOST];
} members;

/* Each object once, though it may have many pieces. Children come after their parents. */
static void collect(const froe_tree *t, uint32_t root, members *m) {
    uint32_t stack[4 * MOST], depth = 1;
    bool seen[MOST] = {false};
    stack[0] = root;
    m->count = 0;
    while (depth) {
        uint32_t node = stack[--depth];
        tree_objects list = tree_list(t, node);
        for (uint32_t i = 0; i < list.count; i++) {
            uint32_t object = tree_object(&list, i);
            if (!seen[object]) m->object[m->count++] = object;
            seen[object] = true;
        }
        if (tree_is_leaf(t->nodes + node)) continue;
        stack[depth++] = t->nodes[node].child;
        stack[depth++] = t->nodes[node].child + 1;
    }
}

typedef struct extent {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} extent;

static extent extent_of(const froe_tree *t, uint32_t object) {
    extent e;
    scene_object_bounds(t->scene, object, e.lo, e.hi);
    return e;
}

/* How x[axis] = value deals with whole objects. */
typedef struct deal {
    int below, above, on, both;
} deal;

static deal deal_of(const froe_tree *t, const members *m, int axis, double value) {
    deal d = {0, 0, 0, 0};
    for (uint32_t i = 0; i < m->count; i++) {
        extent e = extent_of(t, m->object[i]);
        int *class = e.lo[axis] < value && e.hi[axis] > value     ? &d.both
                     : e.lo[axis] == value && e.hi[axis] == value ? &d.on
                     : e.hi[axis] <= value                        ? &d.below
                                                                  : &d.above;
        ++*class;
    }
    return d;
}

static bool separates(deal d) {
    return d.on || (d.below && d.above);
}

typedef void node_fn(const froe_tree *t, const members *m, const froe_cut *cut);

/* Calls fn for all inner nodes of a tree over points or boxes, which are listed wherever they are. */
static void for_cuts(const froe_tree *t, node_fn *fn) {
    static members m;
    uint32_t inner = 0;
    assert_true(t->scene->object_count <= MOST);
    for (uint32_t i = 0; i < t->node_count; i++) {
        if (tree_is_leaf(t->nodes + i)) continue;
        froe_cut cut = tree_cut_at(t, i);
        collect(t, i, &m);
        assert_int_equal(cut.kind, FROE_CUT_AXIS);
        fn(t, &m, &cut);
        inner++;
    }
    assert_true(inner > 10);
}

/* --------------------------------------------------------------------- quad -- */

/* The largest j for which some whole multiple of 2^j lies in [from, to]: by trying them all. */
static int level_between(double from, double to) {
    for (int j = 1023; j >= -1074; j--) {
        double step = ldexp(1, j), multiple = ceil(from / step) * step;
        if (multiple >= from && multiple <= to) return j;
    }
    return -2000;
}

static void expect_coarsest(const froe_tree *t, const members *m, const froe_cut *cut) {
    int best = -3000, axis = -1, mine;
    for (int k = 0; k < t->scene->dim; k++) {
        double from = INFINITY, to = -INFINITY;
        for (uint32_t i = 0; i < m->count; i++) {
            extent e = extent_of(t, m->object[i]);
            from = fmin(from, e.hi[k]);
            to = fmax(to, e.lo[k]);
        }
        int level = from <= to ? level_between(from, to) : -3000;
        if (from <= 0 && to >= 0) level = 5000; /* 0 is a multiple of everything */
        if (level > best) best = level, axis = k;
    }
    mine = cut->value == 0 ? 5000 : level_between(cut->value, cut->value);
    assert_int_equal(cut->axis, axis);
    assert_int_equal(mine, best);
}

static void quad_cuts_where_dyadic_planes_are_coarsest(void **state) {
    static const char *const kinds[] = {"points", "points-3d", "points-8d", "sticks", "slabs"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_scene *scene = generate(kinds[i], 90);
        froe_tree *tree = build(scene, "quad", "growth=1000", 1);
        for_cuts(tree, expect_coarsest);
        audit(tree);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* Halved again and again, on both sides of 0, down to the least numbers there are. */
static void no_spread_makes_a_quadtree_large(void **state) {
    enum { N = 500 };
    double x[4 * N];
    (void)state;
    for (int i = 0; i < N; i++) {
        x[4 * i] = ldexp(1.25, -2 * i);
        x[4 * i + 1] = ldexp(1.5, -2 * i);
        x[4 * i + 2] = -x[4 * i];
        x[4 * i + 3] = i % 2 ? 1e300 : -1e-300;
    }
    froe_scene *scene = points_of(2, x, N);
    froe_tree *tree = build(scene, "quad", NULL, 1);
    for_cuts(tree, expect_coarsest);
    assert_true(tree->node_count < 2 * N);
    audit(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Times 2^k, every cut is the same, times 2^k. */
static void quadtrees_know_no_scale(void **state) {
    enum { N = 200 };
    double x[2 * N], y[2 * N];
    froe_scene *scene = generate("points", N);
    (void)state;
    for (size_t i = 0; i < N; i++) {
        memcpy(x + 2 * i, froe_scene_vertex(scene, (uint32_t)i), 2 * sizeof *x);
        y[2 * i] = ldexp(x[2 * i], -300);
        y[2 * i + 1] = ldexp(x[2 * i + 1], -300);
    }
    froe_scene *pair[2] = {points_of(2, x, N), points_of(2, y, N)};
    froe_tree *tree[2] = {build(pair[0], "quad", NULL, 1), build(pair[1], "quad", NULL, 1)};
    assert_int_equal(tree[0]->node_count, tree[1]->node_count);
    for (uint32_t i = 0; i < tree[0]->node_count; i++) {
        froe_cut a = tree_cut_at(tree[0], i), b = tree_cut_at(tree[1], i);
        assert_int_equal(a.axis, b.axis);
        assert_true(ldexp(a.value, -300) == b.value);
    }
    for (int i = 0; i < 2; i++) froe_tree_free(tree[i]), froe_scene_free(pair[i]);
    froe_scene_free(scene);
}

/* ----------------------------------------------------------------------- kd -- */

static void expect_median(const froe_tree *t, const members *m, const froe_cut *cut) {
    deal mine = deal_of(t, m, cut->axis, cut->value);
    int least = abs(mine.below - mine.above);
    assert_true(separates(mine));
    for (uint32_t i = 0; i < m->count; i++)
        for (int end = 0; end < 2; end++) {
            extent e = extent_of(t, m->object[i]);
            deal other = deal_of(t, m, cut->axis, (end ? e.hi : e.lo)[cut->axis]);
            assert_true(!separates(other) || abs(other.below - other.above) >= least);
        }
}

static double surface(int dim, const double *lo, const double *hi) {
    double sum = 0;
    for (int k = 0; k < dim; k++) {
        double facet = 1;
        for (int j = 0; j < dim; j++) facet *= j == k ? 1 : hi[j] - lo[j];
        sum += facet;
    }
    return sum;
}

static double surface_cost(const froe_tree *t, const members *m, int axis, double value) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], cost;
    deal d = deal_of(t, m, axis, value);
    for (int k = 0; k < t->scene->dim; k++) {
        lo[k] = INFINITY;
        hi[k] = -INFINITY;
        for (uint32_t i = 0; i < m->count; i++) {
            extent e = extent_of(t, m->object[i]);
            lo[k] = fmin(lo[k], e.lo[k]);
            hi[k] = fmax(hi[k], e.hi[k]);
        }
    }
    double from = lo[axis], to = hi[axis];
    if (!separates(d)) return INFINITY;
    hi[axis] = value;
    cost = surface(t->scene->dim, lo, hi) * (d.below + d.both);
    hi[axis] = to;
    lo[axis] = value;
    cost += surface(t->scene->dim, lo, hi) * (d.above + d.both);
    lo[axis] = from;
    return cost / surface(t->scene->dim, lo, hi);
}

static void expect_least_surface(const froe_tree *t, const members *m, const froe_cut *cut) {
    double mine = surface_cost(t, m, cut->axis, cut->value);
    for (uint32_t i = 0; i < m->count; i++)
        for (int k = 0; k < t->scene->dim; k++) {
            extent e = extent_of(t, m->object[i]);
            assert_true(surface_cost(t, m, k, e.lo[k]) >= mine * (1 - 1e-9));
            assert_true(surface_cost(t, m, k, e.hi[k]) >= mine * (1 - 1e-9));
        }
}

static void kd_cuts_at_medians_or_where_surfaces_are_least(void **state) {
    static const char *const kinds[] = {"points", "points-3d", "points-8d", "sticks", "slabs", "towers"};
    static const char *const medians[] = {"growth=1000", "growth=1000 axes=cycle", "growth=1000 axes=first"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_scene *scene = generate(kinds[i], 60);
        for (size_t o = 0; o < 4; o++) {
            froe_tree *tree = build(scene, "kd", o < 3 ? medians[o] : "cost=surface growth=1000", 1);
            for_cuts(tree, o < 3 ? expect_median : expect_least_surface);
            audit(tree);
            froe_tree_free(tree);
        }
        froe_scene_free(scene);
    }
}

static void kd_halves_points(void **state) {
    static const char *const kinds[] = {"points", "points-3d", "points-8d"};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        froe_scene *scene = generate(kinds[i], 1 << 12);
        froe_tree *tree = build(scene, "kd", NULL, 1);
        assert_true(froe_tree_report(tree).height <= 12);
        assert_int_equal(froe_tree_report(tree).fragments, 1 << 12);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* --------------------------------------------------------------------- grid -- */

/* All cuts of points lie on lines with equal distances: sorted, their steps are whole multiples of the least. */
static void the_lines_of_a_grid_are_even(void **state) {
    enum { N = 400 };
    froe_scene *scene = generate("points", N);
    froe_tree *tree = build(scene, "grid", "load=4", 12);
    double lo[2], hi[2];
    int cuts = 0;
    (void)state;
    assert_true(froe_scene_bounds(scene, lo, hi));
    for (uint32_t i = 0; i < tree->node_count; i++) {
        froe_cut cut = tree_cut_at(tree, i);
        if (cut.kind != FROE_CUT_AXIS) continue;
        cuts++;
        double size = hi[cut.axis] - lo[cut.axis], lines = 10, place = (cut.value - lo[cut.axis]) / size * lines;
        assert_true(fabs(place - nearbyint(place)) < 1e-9); /* 10 by 10 cells of 4 points each */
    }
    assert_true(cuts > 20);
    audit(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------- paterson_yao -- */

/* A cut that divides nothing, if an end of an object names one; and no such cut is better balanced. */
static void expect_free_first(const froe_tree *t, const members *m, const froe_cut *cut) {
    deal mine = deal_of(t, m, cut->axis, cut->value);
    int heavier = mine.below > mine.above ? mine.below : mine.above;
    assert_true(separates(mine));
    for (uint32_t i = 0; i < m->count; i++)
        for (int k = 0; k < 2 * t->scene->dim; k++) {
            extent e = extent_of(t, m->object[i]);
            deal d = deal_of(t, m, k / 2, (k % 2 ? e.hi : e.lo)[k / 2]);
            if (d.both || !separates(d)) continue;
            assert_int_equal(mine.both, 0);
            assert_true((d.below > d.above ? d.below : d.above) >= heavier);
        }
}

static void free_cuts_come_first(void **state) {
    static const char *const kinds[] = {"rows", "boxes", "sticks", "slabs", "towers", "panels", "bars", "debris-5d"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_scene *scene = generate(kinds[i], 100);
        froe_tree *tree = build(scene, "paterson_yao", NULL, 1);
        for_cuts(tree, expect_free_first);
        audit(tree);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* Axis-parallel segments and polygons are cut by axis-parallel planes alone; others are not, and slabs are for
 * segments. */
static void orthogonal_scenes_get_orthogonal_cuts(void **state) {
    static const char *const kinds[] = {"walls", "cells", "nested", "walls-3d", "cells-3d", "nested-3d"};
    froe_build_options o = froe_build_defaults();
    froe_tree *none = NULL;
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_scene *scene = generate(kinds[i], 200);
        froe_tree *tree = build(scene, "paterson_yao", NULL, 0);
        for (uint32_t v = 0; v < tree->node_count; v++)
            if (!tree_is_leaf(tree->nodes + v)) assert_int_equal(tree_cut_at(tree, v).kind, FROE_CUT_AXIS);
        audit(tree);
        o.method = "paterson_yao";
        o.settings = "rule=slabs";
        froe_tree_free(tree);
        assert_int_equal(froe_build(scene, &o, &none, NULL), i < 3 ? FROE_OK : FROE_E_UNSUPPORTED);
        froe_tree_free(none);
        none = NULL;
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------- all of them -- */

/* Long objects, and stars, which no axis-parallel cut ever thins out: 2 G n fragments by such cuts at most. */
static void axis_parallel_cuts_end(void **state) {
    static const char *const methods[] = {"kd", "quad", "grid"};
    static const char *const kinds[] = {"parallel", "hair", "star", "identical", "grid-3d", "hair-3d", "star-3d"};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = generate(kinds[k], 120);
        for (size_t i = 0; i < 3; i++) {
            froe_tree *tree = build(scene, methods[i], "growth=2", 1);
            uint64_t n = froe_scene_object_count(scene), cells = 0;
            for (uint32_t v = 0; v < tree->node_count; v++) cells += tree_cut_at(tree, v).kind == FROE_CUT_AXIS;
            assert_true(cells <= 4 * n); /* each separates something: fewer than fragments */
            audit(tree);
            froe_tree_free(tree);
        }
        froe_scene_free(scene);
    }
}

static void expect_facet(const froe_tree *t, const members *m, const froe_cut *cut) {
    bool found = false;
    for (uint32_t i = 0; i < m->count && !found; i++) {
        extent e = extent_of(t, m->object[i]);
        found = e.lo[cut->axis] == cut->value || e.hi[cut->axis] == cut->value;
    }
    assert_true(found);
}

static void autopartitions_of_boxes_run_through_facets(void **state) {
    static const char *const kinds[] = {"sticks", "slabs", "towers", "bars"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_scene *scene = generate(kinds[i], 150);
        froe_tree *best = build(scene, "autopartition", "candidates=30", 1);
        for_cuts(best, expect_facet);
        audit(best);
        froe_tree *any = build(scene, "autopartition", NULL, 1);
        assert_true(froe_tree_report(best).fragments < froe_tree_report(any).fragments);
        froe_tree_free(any);
        froe_tree_free(best);
        froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quad_cuts_where_dyadic_planes_are_coarsest),
        cmocka_unit_test(no_spread_makes_a_quadtree_large),
        cmocka_unit_test(quadtrees_know_no_scale),
        cmocka_unit_test(kd_cuts_at_medians_or_where_surfaces_are_least),
        cmocka_unit_test(kd_halves_points),
        cmocka_unit_test(the_lines_of_a_grid_are_even),
        cmocka_unit_test(free_cuts_come_first),
        cmocka_unit_test(orthogonal_scenes_get_orthogonal_cuts),
        cmocka_unit_test(axis_parallel_cuts_end),
        cmocka_unit_test(autopartitions_of_boxes_run_through_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
