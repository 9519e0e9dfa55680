/* test_bar.c: cells are as fat as promised, exactly; points end low and alone; small objects have a guard in every
 * fat cell they meet; and what has no directions says so. */
#include "build/bar/bar_guards.h"
#include "build/bar/bar_shape.h"
#include "builders/bar_oracle.h"
#include "support/memory.h"
#include "tree/list.h"
#include "tree/trees.h"
#include <froe/io.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static froe_scene *generate(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 3, NULL, &scene, NULL), FROE_OK);
    return scene;
}

static froe_tree *build(froe_scene *scene, const char *settings) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "bar";
    o.settings = settings;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s: %s", settings ? settings : "", diag.message);
    return tree;
}

static void audit(const froe_tree *tree, const char *what) {
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    exact.exact_only = true;
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s: %s", what, diag.message);
}

/** What is promised under a name; -1: nothing. */
static double promise_of(const froe_tree *tree, const char *name, bool measured) {
    for (const froe_promise *p = froe_tree_report(tree).promises; p->name; p++)
        if (!strcmp(p->name, name)) return measured ? p->measured : p->promised;
    return -1;
}

/* -------------------------------------------------------------------- points -- */

typedef enum shape_of_points {
    UNIFORM,
    SCALES, /* everywhere between 2^-40 and 1, towards one corner */
    LINE,   /* nearly on a line */
    EDGE,   /* down to 2^-40 above a side */
    CIRCLE,
    FRACTAL, /* clusters in clusters, in corners */
    CORNER,  /* along a diagonal, into a corner, thinner and thinner */
    DUPLICATES,
    AXIS,    /* on a line along an axis */
    OBLIQUE, /* whole coordinates on one line */
    LATTICE,
    ONE,       /* all at one place */
    HUGE_ONES, /* up to 1e300 */
    SHAPES
} shape_of_points;
static const char *const shape_names[SHAPES] = {"uniform", "scales", "line",       "edge", "circle",
                                                "fractal", "corner", "duplicates", "axis", "oblique",
                                                "lattice", "one",    "huge"};

static void make_point(shape_of_points shape, int dim, uint64_t i, double *x) {
    const double z = ldexp(1, -(int)trees_random(3, 9 * i, 41)), turn = trees_unit(5, i);
    const double u = (1 - turn * turn) / (1 + turn * turn);
    double cell = 1;
    for (int k = 0; k < dim; k++) {
        x[k] = trees_unit(4, 9 * i + (uint64_t)k);
        if (shape == SCALES) x[k] *= z;
        if (shape == LINE && k) x[k] = x[0] + 1e-9 * x[k];
        if (shape == EDGE && k) x[k] = z;
        if (shape == CIRCLE) x[k] = k == 0 ? u : k == 1 ? 2 * turn / (1 + turn * turn) : 0.5;
        if (shape == CORNER) x[k] = k ? sqrt(sqrt(z)) * x[k] * 1e-3 : 1 - sqrt(sqrt(z)); /* above the floor */
        if (shape == DUPLICATES || shape == LATTICE) x[k] = (double)(int)((shape == LATTICE ? 40 : 5) * x[k]);
        if (shape == AXIS && k) x[k] = 0.25;
        if (shape == OBLIQUE) x[k] = (double)(7 * i) * (k + 2) - 3;
        if (shape == ONE) x[k] = -0.1 * k;
        if (shape == HUGE_ONES) x[k] = 2e300 * x[k] - 1e300;
    }
    for (int level = 0; level < 5 && shape == FRACTAL; level++, cell *= 0x1p-7)
        for (int k = 0; k < dim; k++) {
            const uint32_t corner = trees_random(6, 9 * i + (uint64_t)level, 3);
            x[k] = (level ? x[k] : 0) + cell * (corner == (uint32_t)k ? 0.97 : corner == 2 ? 0.5 : 0.01);
        }
}

static froe_scene *make_points(shape_of_points shape, int dim, size_t n) {
    froe_scene *scene;
    double *coords = malloc(n * (size_t)dim * sizeof *coords);
    assert_non_null(coords);
    for (uint64_t i = 0; i < n; i++) make_point(shape, dim, i, coords + i * (size_t)dim);
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, n, coords, NULL, NULL), FROE_OK);
    free(coords);
    return scene;
}

static const char *const settings_of[2][2] = {{"directions=3", "directions=4"},
                                              {"directions=7", "directions=7 aspect=8"}};

static void points_end_low_and_alone(void **state) {
    enum { COUNT = 900 };
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int s = 0; s < 2; s++) {
                froe_scene *scene = make_points((shape_of_points)shape, dim, COUNT);
                froe_tree *tree = build(scene, settings_of[dim - 2][s]);
                const froe_report r = froe_tree_report(tree);
                const double most = 2.5 * log2(COUNT) + 4, proven = promise_of(tree, "height", false);
                const bool proves = shape != CORNER || s; /* which takes three directions up to five cuts */
                if (!((double)r.height <= most) || (proves && proven < (double)r.height) || r.nodes > 4 * COUNT)
                    fail_msg("%s, %s: height %d, %g promised, %d nodes", shape_names[shape], settings_of[dim - 2][s],
                             (int)r.height, proven, (int)r.nodes);
                assert_true(r.max_leaf <= 1 || r.inseparable > 0);
                assert_int_equal(r.fragments, COUNT);
                assert_true(promise_of(tree, "aspect", true) <= promise_of(tree, "aspect", false));
                audit(tree, shape_names[shape]);
                froe_tree_free(tree);
                froe_scene_free(scene);
            }
}

/** Points closer to each other than doubles tell cells apart: they still end alone, by cuts that promise nothing. */
static void points_below_the_floor_end_alone_all_the_same(void **state) {
    enum { COUNT = 64 };
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        double coords[COUNT * 3];
        froe_scene *scene;
        for (int i = 0; i < COUNT * dim; i++) coords[i] = 1 + 0x1p-52 * trees_random(8, (uint64_t)i, 64);
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POINT, COUNT, coords, NULL, NULL), FROE_OK);
        froe_tree *tree = build(scene, NULL);
        const froe_report r = froe_tree_report(tree);
        assert_true(r.max_leaf <= 1 || r.inseparable > 0);
        assert_true(promise_of(tree, "height", false) < 0);
        audit(tree, "below the floor");
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------------- fatness -- */

/** The regions of all nodes, from the cuts that led there. A hole (NAN) below the guard stage. */
static bar_region *regions_of(const froe_tree *t, const split_directions *d) {
    bar_region *region = calloc(t->node_count, sizeof *region);
    assert_non_null(region);
    region[0] = bar_region_of(d->dim, t->meta.root_lo, t->meta.root_hi);
    for (uint32_t i = 0; i < t->node_count; i++) {
        const tree_node *n = t->nodes + i;
        if (tree_is_leaf(n)) continue;
        const froe_cut cut = tree_cut_at(t, i);
        int direction = cut.kind == FROE_CUT_AXIS ? cut.axis : -1;
        for (int j = d->dim; j < d->count && cut.kind == FROE_CUT_PLANE; j++)
            if (!memcmp(cut.normal, d->normals[j], (size_t)d->dim * sizeof(double))) direction = j;
        assert_true(direction >= 0 || !(n->flags & TREE_GUARD));
        region[n->child] = region[n->child + 1] = region[i];
        if (!(n->flags & TREE_GUARD)) region[n->child].lo[0] = region[n->child + 1].lo[0] = NAN;
        if (n->flags & TREE_GUARD) region[n->child].hi[direction] = region[n->child + 1].lo[direction] = cut.value;
    }
    return region;
}

/** Compares every cell of the guard stage with the promise, and the fattest with what was measured. */
static void check_fatness(const froe_tree *t, const split_directions *d, const char *what) {
    bar_region *region = regions_of(t, d);
    bar_oracle oracle;
    mpq_t square, most, promised;
    mpq_inits(square, most, promised, NULL);
    mpq_set_d(promised, promise_of(t, "aspect", false));
    mpq_mul(promised, promised, promised);
    bar_oracle_init(&oracle, d);
    for (uint32_t i = 1; i < t->node_count; i++) {
        if (isnan(region[i].lo[0])) continue;
        bar_oracle_aspect(&oracle, &region[i], square);
        if (mpq_sgn(square) <= 0 || mpq_cmp(square, promised) > 0)
            fail_msg("%s: node %u has aspect %g", what, i, sqrt(mpq_get_d(square)));
        if (mpq_cmp(square, most) > 0) mpq_set(most, square);
    }
    assert_true(fabs(sqrt(mpq_get_d(most)) - promise_of(t, "aspect", true)) < 1e-6);
    bar_oracle_clear(&oracle);
    mpq_clears(square, most, promised, NULL);
    free(region);
}

static void check_scene_is_fat(froe_scene *scene, const char *settings, const char *what) {
    split_directions d;
    froe_tree *tree = build(scene, settings);
    const int dim = froe_scene_dim(scene);
    assert_true(split_directions_of(dim, dim == 3 ? 7 : strstr(settings, "directions=3") ? 3 : 4, &d));
    check_fatness(tree, &d, what);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void cells_are_exactly_as_fat_as_promised(void **state) {
    static const char *const kinds[][2] = {{"segments", "directions=3 stop=1 k=0"},
                                           {"wedge", "stop=1 k=0"},
                                           {"nested", "guards=pairs"},
                                           {"blocks", "aspect=3.5"},
                                           {"balls", "stop=1"},
                                           {"degenerate", "k=0 stop=1 growth=0"},
                                           {"huge", "stop=1"}};
    static const char *const space[][2] = {
        {"disjoint-3d", "k=0 stop=1 growth=0"}, {"boxes-3d", "stop=1"}, {"nested-3d", ""}};
    (void)state;
    for (int shape = 0; shape < SHAPES; shape++)
        if (shape != ONE) {
            check_scene_is_fat(make_points((shape_of_points)shape, 2, 250), "directions=3", shape_names[shape]);
            check_scene_is_fat(make_points((shape_of_points)shape, 2, 250), "directions=4", shape_names[shape]);
            check_scene_is_fat(make_points((shape_of_points)shape, 3, 40), "directions=7", shape_names[shape]);
        }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        check_scene_is_fat(generate(kinds[i][0], 60), kinds[i][1], kinds[i][0]);
    for (size_t i = 0; i < sizeof space / sizeof *space; i++)
        check_scene_is_fat(generate(space[i][0], 24), space[i][1], space[i][0]);
}

/* -------------------------------------------------------------------- guards -- */

/** A random fat cell of the unit square or cube. */
static void random_cell(const split_directions *d, double most, uint64_t seed, bar_region *region, bar_shape *shape) {
    static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    *region = bar_region_of(d->dim, zero, one);
    assert_true(bar_shape_of(d, region, shape));
    for (uint64_t cut = 0, draw = 0; cut < 1 + seed % 9; cut++) {
        double lo, hi, aspect[2];
        const int i = (int)trees_random(seed, draw++, (uint32_t)d->count);
        const double t = trees_unit(seed, draw++);
        const bool high = trees_random(seed, draw++, 2);
        if (!bar_shape_interval(shape, i, most, &lo, &hi)) continue;
        const double at = trees_random(seed, draw++, 2) ? lo + t * (hi - lo) : t < 0.5 ? lo : hi;
        bar_shape_halves(shape, i, at, aspect);
        if (aspect[high] > most) continue;
        const double room = 0.05 * (shape->hi[i] - shape->lo[i]); /* a corner may be fat down to nothing */
        if (at < shape->lo[i] + room || at > shape->hi[i] - room) continue;
        (high ? region->lo : region->hi)[i] = bar_shape_global(shape, i, at);
        assert_true(bar_shape_of(d, region, shape));
    }
}

/** A point of the cell near its border: most of the way from one of two corners to a mixture of all. */
static void border_point(const bar_shape *shape, uint64_t seed, double *x) {
    const bar_corner *a = shape->corners + trees_random(seed, 50, shape->count);
    const bar_corner *b = shape->corners + trees_random(seed, 51, shape->count);
    const double t = trees_unit(seed, 52) * (double)trees_random(seed, 53, 2), in = 0.0008 * trees_unit(seed, 54);
    for (int k = 0; k < shape->directions->dim; k++) {
        double middle = 0;
        for (uint32_t c = 0; c < shape->count; c++) middle += shape->corners[c].at[k] / shape->count;
        x[k] = bar_shape_global(shape, k, (1 - in) * ((1 - t) * a->at[k] + t * b->at[k]) + in * middle);
    }
}

static bool is_inside(const split_directions *d, const bar_region *region, const double *x) {
    for (int i = 0; i < d->count; i++) {
        const double key = split_key(d, i, x);
        if (!(key > region->lo[i] && key < region->hi[i])) return false;
    }
    return true;
}

/** Of many tiny segments that reach into fat cells, how many have no guard inside? */
static size_t unguarded(int dim, int directions, bar_guard_kind kind) {
    enum { TRIALS = 2400 };
    size_t missed = 0;
    split_directions d;
    bar_guards guards;
    assert_true(split_directions_of(dim, directions, &d));
    bar_guards_make(&d, kind, &guards);
    for (uint64_t seed = 0; seed < TRIALS; seed++) {
        bar_region region;
        bar_shape shape;
        froe_scene *scene;
        double ends[6], points[BAR_GUARDS_MOST * 3];
        bool found = false;
        random_cell(&d, 6, seed, &region, &shape);
        border_point(&shape, seed, ends);
        if (!is_inside(&d, &region, ends)) continue;
        const double share = trees_unit(seed, 70);
        for (int k = 0; k < dim; k++) { /* the point is anywhere on the segment */
            const double along = 0.02 * shape.width * (trees_unit(seed, 60 + (uint64_t)k) - 0.5);
            ends[dim + k] = ends[k] + (1 - share) * along;
            ends[k] -= share * along;
        }
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, ends, NULL, NULL), FROE_OK);
        const uint32_t count = bar_guards_of(&guards, scene, 0, points);
        assert_true(count <= guards.count);
        for (uint32_t i = 0; i < count && !found; i++) found = is_inside(&d, &region, points + i * (uint32_t)dim);
        missed += !found;
        froe_scene_free(scene);
    }
    return missed;
}

static void small_objects_have_a_guard_in_every_fat_cell(void **state) {
    (void)state;
    for (int kind = BAR_HEMISPHERE; kind <= BAR_PAIRS; kind++) {
        assert_int_equal(unguarded(2, 3, (bar_guard_kind)kind), 0);
        assert_int_equal(unguarded(2, 4, (bar_guard_kind)kind), 0);
    }
    assert_int_equal(unguarded(3, 7, BAR_HEMISPHERE), 0);
    assert_true(unguarded(2, 3, BAR_BOXES) > 10); /* corners of boxes do not guard: the source of the other kinds */
    assert_true(unguarded(2, 4, BAR_BOXES) > 10);
    assert_true(unguarded(3, 7, BAR_BOXES) > 10);
}

static void guards_are_as_many_as_sectors(void **state) {
    static const int set[][3] = {{2, 3, 6}, {2, 4, 8}, {3, 7, 32}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        split_directions d;
        bar_guards guards;
        assert_true(split_directions_of(set[i][0], set[i][1], &d));
        bar_guards_make(&d, BAR_HEMISPHERE, &guards);
        assert_int_equal(guards.count, set[i][2]);
    }
}

/* --------------------------------------------------------------------- cells -- */

/** Different objects in the fullest cell of the guard stage. */
static uint32_t largest_load(const froe_tree *t) {
    uint32_t *stamp = calloc(t->scene->object_count, sizeof *stamp), most = 0;
    assert_non_null(stamp);
    for (uint32_t i = 1; i < t->node_count; i++) {
        uint32_t parent = i, load = 0, first = i, last = i;
        while (tree_is_leaf(t->nodes + parent) || (t->nodes[parent].child != i && t->nodes[parent].child + 1 != i)) {
            if (!parent--) break;
        }
        if (!(t->nodes[parent].flags & TREE_GUARD) || (!tree_is_leaf(t->nodes + i) && t->nodes[i].flags & TREE_GUARD))
            continue;
        while (!tree_is_leaf(t->nodes + last)) last = t->nodes[last].child + 1;
        const tree_objects head = tree_list(t, first), tail = tree_list(t, last);
        uint32_t begin = head.first;
        if (t->nodes[first].type == TREE_PLAIN) {
            while (t->nodes[first].type == TREE_PLAIN) first = t->nodes[first].child;
            begin = tree_list(t, first).first;
        }
        for (uint32_t p = begin; p < tail.first + tail.count; p++) {
            load += stamp[t->pieces[p].object] != i;
            stamp[t->pieces[p].object] = i;
        }
        most = load > most ? load : most;
    }
    free(stamp);
    return most;
}

static uint32_t load_of(const char *kind, const char *settings) {
    froe_scene *scene = generate(kind, 400);
    froe_tree *tree = build(scene, settings);
    const uint32_t load = largest_load(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return load;
}

/** Scenes of low density: the numbers are what they come to, rounded up, and do not grow with n. */
static void cells_without_guards_meet_few_objects(void **state) {
    static const struct {
        const char *kind, *settings;
        uint32_t most;
    } cases[] = {{"disjoint", "k=0 stop=1 growth=0", 6},
                 {"clusters", "k=0 stop=1 growth=0", 8},
                 {"nested", "k=0 stop=1 growth=0", 8},
                 {"wedge", "k=0 stop=1 growth=0", 8},
                 {"disjoint-3d", "k=0 stop=1 growth=0", 8},
                 {"cuboids", "k=0 stop=1 growth=0", 40},
                 {"disjoint", "k=0 stop=1 growth=0 directions=0", 6}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const uint32_t load = load_of(cases[i].kind, cases[i].settings);
        if (load > cases[i].most) fail_msg("%s, %s: %u objects", cases[i].kind, cases[i].settings, load);
    }
}

/* ----------------------------------------------------------------- refusals -- */

/* Leaves of no object: a cut runs through the last one, too. */
static void segments_of_no_length_end_in_cuts_as_low_as_promised(void **state) {
    (void)state;
    for (size_t count = 1; count <= 12; count++) {
        froe_scene *scene;
        double x[4 * 12];
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        for (size_t i = 0; i < 4 * count; i++) x[i] = trees_unit(count, 2 * (i / 4) + i % 2);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, count, x, NULL, NULL), FROE_OK);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        o.method = "bar", o.leaf = 0;
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        audit(tree, "no length");
        assert_true(promise_of(tree, "height", true) > 0);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/** A stage that ends at once leaves each object whole, in one cell. */
static void a_growth_below_one_half_promises_a_piece_for_each_object(void **state) {
    static const char *const methods[] = {"bar", "density"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        froe_scene *scene = generate("disjoint", 60);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        o.method = methods[i];
        o.settings = "growth=0.25";
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_true(promise_of(tree, "guard_fragments", false) >= 60);
        audit(tree, methods[i]);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void what_has_no_directions_says_so(void **state) {
    const double far[] = {0, 0, 1.7e308, -1.7e308, 1, 1};
    froe_scene *scene;
    (void)state;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 3, far, NULL, NULL), FROE_OK);
    froe_tree *tree = build(scene, NULL);
    assert_non_null(strstr(froe_tree_report(tree).settings, "directions=0"));
    assert_true(promise_of(tree, "aspect", false) < 0);
    audit(tree, "no directions");
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void directions_that_do_not_exist_are_refused(void **state) {
    static const struct {
        const char *kind, *settings, *why;
        froe_status status;
    } cases[] = {
        {"points", "directions=7", "option 'directions': There are no 7 in dimension 2.", FROE_E_OPTIONS},
        {"points-3d", "directions=4", "option 'directions': There are no 4 in dimension 3.", FROE_E_OPTIONS},
        {"points-8d", "directions=7", "option 'directions': There are no 7 in dimension 8.", FROE_E_OPTIONS},
        {"denormal", "directions=4", "Method 'bar' has no directions for coordinates of ", FROE_E_UNSUPPORTED},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_scene *scene = generate(cases[i].kind, 50);
        froe_build_options o = froe_build_defaults();
        froe_diagnostic diag = {0};
        froe_tree *tree = NULL;
        o.method = "bar";
        o.settings = cases[i].settings;
        assert_int_equal(froe_build(scene, &o, &tree, &diag), cases[i].status);
        assert_non_null(strstr(diag.message, cases[i].why));
        assert_null(tree);
        froe_scene_free(scene);
    }
}

static froe_status build_in(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    o.method = "bar";
    o.settings = "stop=1 k=4";
    o.threads = 1;
    froe_status status = froe_generate(user, 24, 7, alloc, &scene, NULL);
    if (!status) status = build_tuned(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void a_build_survives_every_failing_allocation(void **state) {
    static const char *const kinds[] = {"points", "segments", "balls-3d", "debris-5d"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char kind[16];
        snprintf(kind, sizeof kind, "%s", kinds[i]);
        test_memory_each(build_in, kind);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_end_low_and_alone),
        cmocka_unit_test(points_below_the_floor_end_alone_all_the_same),
        cmocka_unit_test(cells_are_exactly_as_fat_as_promised),
        cmocka_unit_test(small_objects_have_a_guard_in_every_fat_cell),
        cmocka_unit_test(guards_are_as_many_as_sectors),
        cmocka_unit_test(cells_without_guards_meet_few_objects),
        cmocka_unit_test(segments_of_no_length_end_in_cuts_as_low_as_promised),
        cmocka_unit_test(a_growth_below_one_half_promises_a_piece_for_each_object),
        cmocka_unit_test(what_has_no_directions_says_so),
        cmocka_unit_test(directions_that_do_not_exist_are_refused),
        cmocka_unit_test(a_build_survives_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
