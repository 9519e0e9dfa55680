/* test_zone.c: BAR trees beyond space: points end low, whatever their scales; cells are exactly as fat as promised, and
 * the audit finds those that are not; small objects have a guard in every fat zone that they meet. */
#include "build/bar/zone_cut.h"
#include "build/bar/zone_guard.h"
#include "support/memory.h"
#include "tree/audit/aspect.h"
#include "tree/trees.h"
#include <froe/formats.h>
#include <gmp.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static froe_tree *build(froe_scene *scene, const char *settings) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "bar";
    o.settings = settings;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s: %s", settings ? settings : "", diag.message);
    return tree;
}

static double promise_of(const froe_tree *tree, const char *name, bool measured) {
    for (const froe_promise *p = froe_tree_report(tree).promises; p->name; p++)
        if (!strcmp(p->name, name)) return measured ? p->measured : p->promised;
    return -1;
}

/* -------------------------------------------------------------------- points -- */

typedef enum shape_of_points {
    UNIFORM,
    NESTED,   /* at 2^-i, on both sides of 0 */
    ONE_SIDE, /* at 2^-i, towards a corner of their box */
    SCALES,   /* at random scales down to 2^-400, axis by axis */
    CLUSTERS, /* of sizes from 1 to 2^-30 at random places */
    STEPS,    /* each coordinate near the one before, at random scales: near many facets at once */
    LINE,     /* on a line */
    MOMENT,   /* on the moment curve */
    GRID,     /* whole coordinates, many of them equal */
    CORNER,   /* down to 2^-38 beside a corner of the unit cube */
    SHAPES
} shape_of_points;
static const char *const shape_names[SHAPES] = {"uniform", "nested", "one side", "scales", "clusters",
                                                "steps",   "line",   "moment",   "grid",   "corner"};

static void make_point(shape_of_points shape, int dim, uint64_t i, size_t n, double *x) {
    const double t = (double)i / (double)n;
    const uint32_t cluster = trees_random(7, i, 30);
    for (int k = 0; k < dim; k++) {
        const uint64_t draw = 9 * i + (uint64_t)k;
        const double u = trees_unit(4, draw), sign = k % 2 ? -1 : 1;
        x[k] = u;
        if (shape == NESTED) x[k] = ldexp(sign * (1 + 0.1 * k), -(int)i);
        if (shape == ONE_SIDE) x[k] = ldexp(1 + u, -(int)i);
        if (shape == SCALES) x[k] = ldexp(u, -(int)trees_random(3, draw, 400));
        if (shape == CLUSTERS) x[k] = trees_unit(5, 9 * cluster + (uint64_t)k) + ldexp(u, -(int)cluster);
        if (shape == STEPS) x[k] = (k ? x[k - 1] : 0) + ldexp(u, -5 * (k + 1) * (int)(i % 6));
        if (shape == LINE) x[k] = t * (k + 1) + 0.1 * k;
        if (shape == MOMENT) x[k] = k ? x[k - 1] * t : t;
        if (shape == GRID) x[k] = trees_random(6, draw, 3);
        if (shape == CORNER) x[k] = k % 2 ? 1 - ldexp(u, -(int)(i % 38)) : ldexp(u, -(int)(i % 38));
    }
}

static froe_scene *make_points(shape_of_points shape, int dim, size_t n) {
    froe_scene *scene;
    double *coords = malloc(n * (size_t)dim * sizeof *coords);
    assert_non_null(coords);
    for (uint64_t i = 0; i < n; i++) make_point(shape, dim, i, n, coords + i * (size_t)dim);
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, n, coords, NULL, NULL), FROE_OK);
    free(coords);
    return scene;
}

/* The height of cubes on nested points is that of their scales: the number of points, times the dimension. */
static void points_end_low_in_every_dimension(void **state) {
    enum { COUNT = 500 };
    (void)state;
    for (int dim = 4; dim <= 8; dim++)
        for (int shape = 0; shape < SHAPES; shape++) {
            froe_scene *scene = make_points((shape_of_points)shape, dim, COUNT);
            froe_tree *tree = build(scene, NULL);
            const froe_report r = froe_tree_report(tree);
            froe_diagnostic diag = {0};
            if (!((double)r.height <= 5 * log2(COUNT)) || r.nodes > 16 * COUNT)
                fail_msg("%s, %dD: height %d, %d nodes", shape_names[shape], dim, (int)r.height, (int)r.nodes);
            assert_true(r.max_leaf <= 1 || r.inseparable > 0);
            assert_true(shape == CORNER || promise_of(tree, "height", false) >= (double)r.height);
            if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s, %dD: %s", shape_names[shape], dim, diag.message);
            froe_tree_free(tree);
            if (shape == NESTED) {
                tree = build(scene, "directions=0");
                assert_true(froe_tree_report(tree).height > 4 * COUNT / 2);
                froe_tree_free(tree);
            }
            froe_scene_free(scene);
        }
}

/** Twenty at each distance. Zooms that came before border cuts were as many as 168 in a row here. */
static void points_at_each_scale_end_low(void **state) {
    enum { COUNT = 8000 };
    (void)state;
    for (int dim = 4; dim <= 8; dim += 2) {
        double *coords = malloc(COUNT * (size_t)dim * sizeof *coords);
        froe_scene *scene;
        assert_non_null(coords);
        for (int i = 0; i < COUNT; i++)
            for (int k = 0; k < dim; k++)
                coords[i * dim + k] = ldexp((k % 2 ? -1 : 1) * (1 + (double)i / COUNT + 0.1 * k), -(i % 400));
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POINT, COUNT, coords, NULL, NULL), FROE_OK);
        froe_tree *tree = build(scene, NULL);
        const double height = (double)froe_tree_report(tree).height;
        if (!(height <= 6 * log2(COUNT))) fail_msg("%dD: height %g", dim, height);
        assert_true(promise_of(tree, "height", false) <= 60 * log2(COUNT) / log2(1.5));
        froe_tree_free(tree);
        froe_scene_free(scene);
        free(coords);
    }
}

/* -------------------------------------------------------------------- aspect -- */

enum { NODES = FROE_MAX_DIM + 1 };

typedef struct exact_zone {
    mpq_t most[NODES][NODES];
    bool there[NODES][NODES];
} exact_zone;

/** The square of the aspect, from all paths of facets, in rationals. */
static void exact_aspect(exact_zone *z, int dim, mpq_t out) {
    mpq_t sum, widest, narrowest;
    mpq_inits(sum, widest, narrowest, NULL);
    for (int k = 0; k <= dim; k++)
        for (int i = 0; i <= dim; i++)
            for (int j = 0; j <= dim; j++) {
                if (!z->there[i][k] || !z->there[k][j]) continue;
                mpq_add(sum, z->most[i][k], z->most[k][j]);
                if (z->there[i][j] && mpq_cmp(sum, z->most[i][j]) >= 0) continue;
                mpq_set(z->most[i][j], sum);
                z->there[i][j] = true;
            }
    for (int i = 1; i <= dim; i++)
        for (int j = 0; j < i; j++) {
            mpq_add(sum, z->most[i][j], z->most[j][i]);
            assert_true(mpq_sgn(sum) > 0);
            mpq_mul(sum, sum, sum);
            if (i < dim) mpq_div_2exp(sum, sum, 1);
            if (mpq_cmp(sum, widest) > 0) mpq_set(widest, sum);
            if ((i == 1 && !j) || mpq_cmp(sum, narrowest) < 0) mpq_set(narrowest, sum);
        }
    mpq_div(out, widest, narrowest);
    mpq_clears(sum, widest, narrowest, NULL);
}

static void bound(exact_zone *z, int i, int j, double most) {
    mpq_set_d(z->most[i][j], most);
    z->there[i][j] = true;
}

/** The largest aspect of a cell of the guard stage, path by path from the root. */
static double oracle_aspect(const froe_tree *t) {
    const int dim = t->scene->dim;
    uint32_t *parent = calloc(t->node_count, sizeof *parent);
    exact_zone z;
    mpq_t square;
    double most = 1;
    assert_non_null(parent);
    mpq_init(square);
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) mpq_init(z.most[i][j]);
    for (uint32_t i = 0; i < t->node_count; i++)
        if (!tree_is_leaf(t->nodes + i)) parent[t->nodes[i].child] = parent[t->nodes[i].child + 1] = i;
    for (uint32_t i = 1; i < t->node_count; i++) {
        if (!(t->nodes[parent[i]].flags & TREE_GUARD)) continue;
        memset(z.there, 0, sizeof z.there);
        for (int k = 0; k < dim; k++) {
            bound(&z, k, dim, t->meta.root_hi[k]);
            bound(&z, dim, k, -t->meta.root_lo[k]);
        }
        uint32_t path[4096], depth = 0;
        for (uint32_t at = i; at; at = parent[at]) path[depth++] = at;
        while (depth--) { /* later cuts of the same direction are tighter */
            const froe_cut cut = tree_cut_at(t, parent[path[depth]]);
            int a = cut.axis, b = dim;
            for (int k = 0; k < dim && cut.kind == FROE_CUT_PLANE; k++) {
                if (cut.normal[k] == 1) a = k;
                if (cut.normal[k] == -1) b = k;
            }
            const bool above = path[depth] != t->nodes[parent[path[depth]]].child;
            bound(&z, above ? b : a, above ? a : b, above ? -cut.value : cut.value);
        }
        for (int k = 0; k <= dim; k++) bound(&z, k, k, 0);
        exact_aspect(&z, dim, square);
        most = fmax(most, sqrt(mpq_get_d(square)));
    }
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) mpq_clear(z.most[i][j]);
    mpq_clear(square);
    free(parent);
    return most;
}

static void cells_are_exactly_as_fat_as_measured(void **state) {
    static const int dims[] = {4, 6, 8};
    (void)state;
    for (int d = 0; d < 3; d++)
        for (int shape = 0; shape < SHAPES; shape++) {
            froe_scene *scene = make_points((shape_of_points)shape, dims[d], 60);
            froe_tree *tree = build(scene, NULL);
            const double measured = promise_of(tree, "aspect", true), aspect = oracle_aspect(tree);
            if (!(measured >= aspect * (1 - 0x1p-50) && measured <= aspect * (1 + 0x1p-40) && measured <= 29))
                fail_msg("%s, %dD: aspect %.17g, measured %.17g", shape_names[shape], dims[d], aspect, measured);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

/** Cells fatter than what is proven may be asked for, and are not promised. */
static void an_aspect_that_is_not_proven_is_not_promised(void **state) {
    static const char *const settings[] = {"aspect=1.3", "aspect=2", "aspect=5", "aspect=28"};
    (void)state;
    for (int dim = 4; dim <= 5; dim++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
                froe_scene *scene = make_points((shape_of_points)shape, dim, 60);
                froe_tree *tree = build(scene, settings[i]);
                froe_diagnostic diag = {0};
                if (froe_tree_audit(tree, NULL, &diag))
                    fail_msg("%s, %dD, %s: %s", shape_names[shape], dim, settings[i], diag.message);
                froe_tree_free(tree);
                froe_scene_free(scene);
            }
}

/** A builder that makes cells thinner than it promises. */
static void the_audit_finds_thin_cells(void **state) {
    (void)state;
    for (int dim = 4; dim <= 8; dim++) {
        froe_scene *scene = make_points(NESTED, dim, 300);
        froe_tree *tree = build(scene, "aspect=4000");
        froe_diagnostic diag = {0};
        assert_int_equal(froe_tree_audit(tree, NULL, &diag), FROE_OK);
        for (uint32_t i = 0; i < tree->meta.promise_count; i++) {
            tree_promise *p = tree->meta.promises + i;
            if (strcmp(p->name, "aspect")) continue;
            assert_true(p->measured > 29);
            p->promised = tree->promises[i].promised = 29;
        }
        assert_int_equal(froe_tree_audit(tree, NULL, &diag), FROE_E_AUDIT);
        assert_non_null(strstr(diag.message, "promise 'aspect': It is 29 at most, but measured "));
        for (uint32_t i = 0; i < tree->meta.promise_count; i++)
            if (!strcmp(tree->meta.promises[i].name, "aspect")) tree->meta.promises[i].measured = 28;
        assert_int_equal(froe_tree_audit(tree, NULL, &diag), FROE_E_AUDIT);
        assert_non_null(strstr(diag.message, "promise 'aspect': It is said to be measured as 28, but is "));
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ----------------------------------------------------------------- sequences -- */

static double key(const double *x, int i, int j, int dim) {
    return x[i] - (j < dim ? x[j] : 0);
}

/** A random zone of aspect `most` at most: some cuts of the unit cube. */
static bar_zone random_zone(int dim, double most, uint64_t seed) {
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM];
    for (int k = 0; k < dim; k++) hi[k] = 1;
    bar_zone zone = bar_zone_of(dim, lo, hi);
    for (uint64_t cut = 0, draw = 0; cut < seed % 40; cut++) {
        zone_shape s;
        zone_shape_of(&zone, dim, zone.centre, &s);
        const int i = (int)trees_random(seed, draw++, (uint32_t)dim);
        const int j = i + 1 + (int)trees_random(seed, draw++, (uint32_t)(dim - i));
        const double t = trees_unit(seed, draw++), width = zone_shape_width(&s, i, j);
        const double thin = s.widest / most, room = trees_random(seed, draw++, 2) ? t * t * width : thin;
        if (width < 2.01 * thin || room < thin || room > width - thin) continue;
        const froe_cut c = zone_shape_cut(&s, i, j, room - s.most[j][i]);
        bar_zone_divide(&zone, &s, &c, (int)trees_random(seed, draw++, 2));
    }
    return zone;
}

/** A point of a zone near its border: between where a random ray leaves it and one of its corners. */
static void border_point(const bar_zone *zone, int dim, uint64_t seed, double in, double *x) {
    zone_shape s;
    double u[FROE_MAX_DIM], way = INFINITY;
    zone_shape_of(zone, dim, zone->centre, &s);
    for (int k = 0; k < dim; k++) u[k] = trees_unit(seed, 100 + (uint64_t)k) - 0.5;
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) {
            const double slope = (i < dim ? u[i] : 0) - (j < dim ? u[j] : 0);
            if (slope > 0) way = fmin(way, s.most[i][j] / slope);
        }
    const int corner = (int)trees_random(seed, 90, (uint32_t)dim + 1);
    const double t = trees_random(seed, 91, 2) ? trees_unit(seed, 92) : trees_random(seed, 93, 2);
    for (int k = 0; k < dim; k++) {
        const double y = s.most[k][corner] - s.most[dim][corner];
        x[k] = s.origin[k] + (1 - in) * (t * y + (1 - t) * way * u[k]);
    }
}

static bool is_inside(const bar_zone *zone, int dim, const double *x) {
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) {
            const double at = (i < dim ? x[i] : 0) - (j < dim ? x[j] : 0);
            if (i != j && !(at < zone->most[i][j])) return false;
        }
    return true;
}

/** Follows a cluster among other points until a part has few enough of them. */
static uint32_t cuts_of_sequence(int dim, uint64_t seed, double aspect) {
    enum { COUNT = 60 };
    bar_zone zone = random_zone(dim, aspect, seed);
    double x[COUNT][FROE_MAX_DIM], middle[FROE_MAX_DIM];
    const double size = ldexp(1, -(int)trees_random(seed, 80, 36));
    const froe_allocator alloc = support_allocator(NULL);
    zone_search search = {.cluster.radius = -1};
    uint32_t count = 0, cuts = 0;
    border_point(&zone, dim, seed, trees_unit(seed, 81) * ldexp(1, -(int)trees_random(seed, 82, 30)), middle);
    for (uint64_t i = 0; i < 10 * COUNT && count < COUNT; i++) {
        border_point(&zone, dim, seed + 7777 * (i + 1), trees_unit(seed, 200 + i), x[count]);
        for (int k = 0; k < dim && count < 5 * COUNT / 6; k++) /* most are in the cluster */
            x[count][k] = middle[k] + size * (trees_unit(seed + i, 300 + (uint64_t)k) - 0.5);
        count += is_inside(&zone, dim, x[count]);
    }
    const uint32_t goal = (uint32_t)(0.67 * count);
    while (count > goal && count > 1) {
        zone_shape s;
        froe_cut cut;
        search.rows.count = 0;
        assert_true(array_reserve(&alloc, &search.rows, count * (size_t)dim));
        for (uint32_t i = 0; i < count; i++)
            memcpy(search.rows.data + i * (size_t)dim, x[i], (size_t)dim * sizeof *x[i]);
        const bar_found found = zone_search_cut(&alloc, &search, &zone, dim, count, goal, aspect, &cut);
        if (found == BAR_NONE) break; /* too small for doubles */
        cuts++;
        uint32_t sides[2] = {0, 0};
        int i = cut.axis, j = dim;
        for (int k = 0; k < dim && cut.kind == FROE_CUT_PLANE; k++) {
            if (cut.normal[k] == 1) i = k;
            if (cut.normal[k] == -1) j = k;
        }
        for (uint32_t p = 0; p < count; p++)
            if (key(x[p], i, j, dim) != cut.value) sides[key(x[p], i, j, dim) > cut.value]++;
        zone.goal = goal;
        zone.cluster = search.cluster;
        bar_zone part[2] = {zone, zone};
        for (int side = 0; side < 2; side++) {
            bar_zone_divide(part + side, &search.shape, &cut, side);
            zone_shape_of(part + side, dim, part[side].centre, &s);
            if (!(s.widest <= aspect * s.narrowest * (1 + 0x1p-10)))
                fail_msg("seed %d, %dD: aspect %g", (int)seed, dim, s.widest / s.narrowest);
        }
        const bool above = sides[1] > sides[0];
        uint32_t kept = 0;
        for (uint32_t p = 0; p < count; p++)
            if (key(x[p], i, j, dim) != cut.value && (key(x[p], i, j, dim) > cut.value) == above)
                memmove(x[kept++], x[p], sizeof x[p]);
        count = kept;
        zone = part[above];
        assert_true(cuts < 1000);
    }
    zone_search_free(&alloc, &search);
    return cuts;
}

static void every_sequence_of_cuts_is_short(void **state) {
    (void)state;
    for (int dim = 4; dim <= 8; dim++) {
        uint32_t most = 0;
        for (uint64_t seed = 1; seed <= 1500; seed++) {
            const uint32_t cuts = cuts_of_sequence(dim, seed, 20);
            most = cuts > most ? cuts : most;
        }
        if (most > 6 * (uint32_t)dim) fail_msg("%dD: %u cuts", dim, most);
    }
}

/* -------------------------------------------------------------------- guards -- */

static froe_scene *tiny_object(froe_kind kind, int dim, const double *at, double size, uint64_t seed) {
    double coords[2 * FROE_MAX_DIM], radius = 0.5 * size * trees_unit(seed, 60);
    froe_scene *scene;
    froe_objects objects = froe_objects_defaults();
    for (int k = 0; k < dim; k++) { /* the point is anywhere in it */
        const double along = size * trees_unit(seed, 61 + (uint64_t)k), share = trees_unit(seed, 71 + (uint64_t)k);
        coords[k] = kind == FROE_BALL ? at[k] + (share - 0.5) * radius / dim : at[k] - share * along;
        coords[dim + k] = at[k] + (1 - share) * along;
    }
    objects.kind = kind, objects.count = 1, objects.coords = coords;
    if (kind == FROE_BALL) objects.radii = &radius;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    return scene;
}

static void small_objects_have_a_guard_in_every_fat_zone(void **state) {
    static const froe_kind kinds[] = {FROE_BOX, FROE_BALL};
    size_t trials = 0;
    (void)state;
    for (int dim = 4; dim <= 8; dim++)
        for (uint64_t seed = 1; seed <= 2000; seed++) {
            const bar_zone zone = random_zone(dim, 20, seed);
            double x[FROE_MAX_DIM], guard[FROE_MAX_DIM];
            zone_shape s;
            zone_shape_of(&zone, dim, zone.centre, &s);
            border_point(&zone, dim, seed, 1e-6 * trees_unit(seed, 50), x);
            if (!is_inside(&zone, dim, x)) continue;
            /* a ball of radius narrowest / ((dim + 1) sqrt 2) is around the centre, and slopes are 1 / dim at least */
            froe_scene *scene = tiny_object(kinds[seed % 2], dim, x, s.narrowest / (40 * dim * dim), seed);
            if (!zone_guard_of(scene, 0, &zone, guard)) fail_msg("seed %d, %dD: no guard", (int)seed, dim);
            assert_true(is_inside(&zone, dim, guard));
            froe_scene_free(scene);
            trials++;
        }
    assert_true(trials > 8000);
}

/** Objects of low density end in cells of few, in a low tree, at whatever scales they are. */
static void nested_boxes_and_balls_end_low(void **state) {
    enum { COUNT = 200 };
    (void)state;
    for (int dim = 4; dim <= 6; dim++)
        for (int kind = 0; kind < 2; kind++) {
            double coords[COUNT * 2 * FROE_MAX_DIM], radii[COUNT];
            froe_objects objects = froe_objects_defaults();
            froe_diagnostic diag = {0};
            froe_scene *scene;
            for (int i = 0; i < COUNT; i++) {
                radii[i] = ldexp(0.05, -i);
                for (int k = 0; k < dim; k++) {
                    const double middle = ldexp(1 + 0.1 * k, -i);
                    double *at = coords + (kind ? i * dim + k : 2 * i * dim + k);
                    at[0] = kind ? middle : middle - radii[i];
                    if (!kind) at[dim] = middle + radii[i];
                }
            }
            objects.kind = kind ? FROE_BALL : FROE_BOX;
            objects.count = COUNT, objects.coords = coords, objects.radii = kind ? radii : NULL;
            assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
            assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
            froe_tree *tree = build(scene, NULL), *cubes = build(scene, "directions=0");
            const froe_report r = froe_tree_report(tree);
            if (r.height > 60 || r.fragments > 8 * COUNT || r.height > froe_tree_report(cubes).height / 4)
                fail_msg("%dD: height %d, %d pieces; cubes %d, %d", dim, (int)r.height, (int)r.fragments,
                         (int)froe_tree_report(cubes).height, (int)froe_tree_report(cubes).fragments);
            if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s", diag.message);
            froe_tree_free(tree);
            froe_tree_free(cubes);
            froe_scene_free(scene);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_end_low_in_every_dimension),
        cmocka_unit_test(points_at_each_scale_end_low),
        cmocka_unit_test(cells_are_exactly_as_fat_as_measured),
        cmocka_unit_test(an_aspect_that_is_not_proven_is_not_promised),
        cmocka_unit_test(the_audit_finds_thin_cells),
        cmocka_unit_test(every_sequence_of_cuts_is_short),
        cmocka_unit_test(small_objects_have_a_guard_in_every_fat_zone),
        cmocka_unit_test(nested_boxes_and_balls_end_low),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
