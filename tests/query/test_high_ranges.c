/* test_high_ranges.c: convex ranges in R^4 to R^8, on trees of all methods that serve them, against brute force in
 * rationals; within eps no object is missed, and none is further away; and what they cost. */
#include "geom/high/halfspaces.h"
#include "oracle/halfspaces.h"
#include "support/sanitized.h"
#include "tree/trees.h"
#include <froe/formats.h>
#include <froe/query.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { OBJECTS = 20, TREES = 16, MOST = 12 };

typedef struct question {
    froe_range range;
    double points[(MOST + 1) * FROE_MAX_DIM], offsets[MOST];
} question;

/* ------------------------------------------------------------------- scenes -- */

/** Whole coordinates up to `grid`, so that much touches; or any between 0 and 8. */
static double coordinate(uint64_t seed, uint64_t draw, uint32_t grid) {
    return grid ? trees_random(seed, draw, grid) : 8 * trees_unit(seed, draw);
}

/** Segments, and hulls of up to `dim` + 3 corners. */
static froe_scene *make_hulls(int dim, froe_kind kind, uint32_t grid, size_t n, uint64_t seed) {
    double *coords = malloc(n * 11 * FROE_MAX_DIM * sizeof *coords), middle[FROE_MAX_DIM];
    size_t *starts = malloc((n + 1) * sizeof *starts), at = 0;
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene;
    assert_true(coords && starts);
    for (size_t i = 0; i < n; i++) {
        const size_t corners = kind == FROE_SEGMENT ? 2 : 2 + trees_random(seed, 80000 + i, (uint32_t)dim + 2);
        starts[i] = at;
        for (size_t k = 0; k < (size_t)dim; k++) middle[k] = coordinate(seed, 20 * i + k, grid);
        for (size_t c = 0; c < corners; c++, at++)
            for (size_t k = 0; k < (size_t)dim; k++) {
                const uint64_t draw = 100000 + 200 * i + 10 * c + k;
                coords[at * (size_t)dim + k] =
                    middle[k] + (grid ? trees_random(seed, draw, 2) : trees_unit(seed, draw));
            }
    }
    starts[n] = at;
    objects.kind = kind, objects.count = n, objects.coords = coords;
    if (kind == FROE_HULL) objects.starts = starts;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    free(coords), free(starts);
    return scene;
}

static froe_scene *make_scene(int dim, froe_kind kind, uint32_t grid, size_t n, uint64_t seed) {
    if (kind == FROE_SEGMENT || kind == FROE_HULL) return make_hulls(dim, kind, grid, n, seed);
    double *coords = malloc(n * 2 * FROE_MAX_DIM * sizeof *coords), *radii = malloc(n * sizeof *radii);
    const size_t each = kind == FROE_BOX ? 2 * (size_t)dim : (size_t)dim;
    froe_objects objects = froe_objects_defaults();
    froe_scene *scene;
    assert_true(coords && radii);
    for (size_t i = 0; i < n; i++) {
        radii[i] = grid ? 1 + trees_random(seed, 90000 + i, 2) : 0.1 + trees_unit(seed, 90000 + i);
        for (size_t k = 0; k < (size_t)dim; k++) {
            coords[i * each + k] = coordinate(seed, 20 * i + k, grid);
            if (kind != FROE_BOX) continue;
            coords[i * each + (size_t)dim + k] = coords[i * each + k] + (grid ? trees_random(seed, 20 * i + 10 + k, 3)
                                                                              : trees_unit(seed, 20 * i + 10 + k));
        }
    }
    objects.kind = kind, objects.count = n, objects.coords = coords;
    if (kind == FROE_BALL) objects.radii = radii;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
    free(coords), free(radii);
    return scene;
}

/* ------------------------------------------------------------------- ranges -- */

static void make_halfspaces(int dim, uint32_t grid, uint64_t seed, question *q) {
    q->range.count = 1 + trees_random(seed, 1, dim > 5 ? 6 : 9);
    double centre[FROE_MAX_DIM];
    for (int k = 0; k < dim; k++) centre[k] = coordinate(seed, 400 + (uint64_t)k, grid);
    for (size_t i = 0; i < q->range.count; i++) {
        double value = 0;
        for (int k = 0; k < dim; k++) {
            const uint64_t draw = 500 + 10 * i + (uint64_t)k;
            double *n = q->points + i * (size_t)dim + k;
            *n = grid ? (double)trees_random(seed, draw, 3) - 1 : 2 * trees_unit(seed, draw) - 1;
            value += *n * centre[k];
        }
        q->offsets[i] = value + (grid ? (double)trees_random(seed, 700 + i, 3) - (i == 7) : trees_unit(seed, 700 + i));
    }
}

static void make_question(int dim, froe_range_shape shape, uint32_t grid, uint64_t seed, question *q) {
    const double size = trees_random(seed, 2, 2) ? 0.25 : 1;
    q->range = froe_range_defaults();
    q->range.shape = shape;
    q->range.points = q->points;
    q->range.offsets = q->offsets;
    q->range.radius = grid ? trees_random(seed, 3, 3) : 2 * trees_unit(seed, 3);
    q->range.count = shape == FROE_SHAPE_HULL ? 1 + trees_random(seed, 4, MOST) : 0;
    const size_t points = shape == FROE_SHAPE_SIMPLEX ? (size_t)dim + 1 : shape == FROE_SHAPE_HULL ? q->range.count : 2;
    for (size_t i = 0; i < points * (size_t)dim; i++) {
        q->points[i] = coordinate(seed, 30 + i, grid);
        if (!grid && i >= (size_t)dim) q->points[i] = q->points[i % (size_t)dim] + size * (q->points[i] - 4);
    }
    for (size_t k = 0; k < (size_t)dim && shape == FROE_SHAPE_BOX; k++) {
        const double a = q->points[k], b = q->points[(size_t)dim + k];
        q->points[k] = fmin(a, b), q->points[(size_t)dim + k] = fmax(a, b);
    }
    if (shape == FROE_SHAPE_HALFSPACES) make_halfspaces(dim, grid, seed, q);
}

/** The hull of the range, with its radius; not of halfspaces. */
static high_set set_of(int dim, const question *q) {
    const froe_range_shape shape = q->range.shape;
    if (shape == FROE_SHAPE_BOX) return high_box(dim, q->points, q->points + dim);
    high_set set = {.dim = dim, .count = 2, .radius = 0};
    if (shape == FROE_SHAPE_SIMPLEX) set.count = (size_t)dim + 1;
    if (shape == FROE_SHAPE_HULL) set.count = q->range.count;
    if (shape == FROE_SHAPE_BALL) set.count = 1;
    if (shape == FROE_SHAPE_BALL || shape == FROE_SHAPE_CAPSULE) set.radius = q->range.radius;
    for (size_t i = 0; i < set.count; i++)
        memcpy(set.x[i], q->points + i * (size_t)dim, (size_t)dim * sizeof *set.x[i]);
    return set;
}

static bool truth(int dim, const question *q, const froe_scene *scene, uint32_t object) {
    const high_set a = high_object(scene, object);
    if (q->range.shape == FROE_SHAPE_HALFSPACES) return halfspaces_meet(&a, q->points, q->offsets, q->range.count);
    const high_set b = set_of(dim, q);
    return high_meet(&a, &b);
}

/* ----------------------------------------------------------------- checking -- */

typedef struct forest {
    size_t count;
    froe_tree *trees[TREES];
    froe_query *queries[TREES];
} forest;

/** Trees of all methods that serve the scene. */
static forest plant(froe_scene *scene) {
    forest f = {.count = 0};
    const froe_method_info *m;
    for (size_t i = 0; (m = froe_method_at(i)); i++) {
        froe_build_options o = froe_build_defaults();
        o.method = m->name;
        o.threads = 1;
        if (!froe_method_serves(m, scene, o.leaf)) continue;
        assert_true(f.count < TREES);
        assert_int_equal(froe_build(scene, &o, &f.trees[f.count], NULL), FROE_OK);
        assert_int_equal(froe_query_new(f.trees[f.count], &f.queries[f.count], NULL), FROE_OK);
        f.count++;
    }
    assert_true(f.count >= 4);
    return f;
}

static void fell(forest *f) {
    for (size_t i = 0; i < f->count; i++) {
        froe_query_free(f->queries[i]);
        froe_tree_free(f->trees[i]);
    }
}

static bool is_listed(const froe_list *list, uint32_t object) {
    size_t i = 0;
    while (i < list->count && list->ids[i] != object) i++;
    return i < list->count;
}

static const char *where(const question *q, int dim, uint64_t seed) {
    static char text[80];
    snprintf(text, sizeof text, "%s in %dD, seed %d", froe_range_shape_name(q->range.shape), dim, (int)seed);
    return text;
}

/** All trees say what brute force says. Returns how many objects meet. */
static size_t check_exactly(forest *f, const froe_scene *scene, int dim, question *q, uint64_t seed) {
    bool meets[OBJECTS];
    size_t count = 0;
    for (uint32_t i = 0; i < OBJECTS; i++) count += meets[i] = truth(dim, q, scene, i);
    for (size_t t = 0; t < f->count; t++) {
        froe_list list;
        froe_diagnostic diag = {0};
        if (froe_query_range(f->queries[t], &q->range, &list, &diag))
            fail_msg("%s: %s", where(q, dim, seed), diag.message);
        for (uint32_t i = 0; i < OBJECTS; i++)
            if (is_listed(&list, i) != meets[i])
                fail_msg("%s, tree %d, object %d: %d expected", where(q, dim, seed), (int)t, (int)i, meets[i]);
    }
    return count;
}

/* ------------------------------------------------------------------- exactly -- */

static void check_shape(froe_range_shape shape) {
    static const froe_kind kinds[] = {FROE_POINT, FROE_BOX, FROE_BALL, FROE_SEGMENT, FROE_HULL};
    size_t met = 0, asked = 0;
    for (int dim = 4; dim <= 8; dim += dim == 5 ? 3 : 1)
        for (int kind = 0; kind < 5; kind++)
            for (uint32_t grid = 0; grid <= 4; grid += 4) {
                /* boxes of eight dimensions have 256 corners, and rationals are slow */
                const uint64_t questions = SANITIZED || (dim == 8 && kind) ? 1 : kind < 3 ? 4 : 2;
                froe_scene *scene = make_scene(dim, kinds[kind], grid, OBJECTS, 17 + (uint64_t)dim);
                forest f = plant(scene);
                for (uint64_t seed = 0; seed < questions; seed++) {
                    question q;
                    make_question(dim, shape, grid, 1000 * seed + 10 * (uint64_t)kind + grid, &q);
                    met += check_exactly(&f, scene, dim, &q, seed);
                    asked += OBJECTS;
                }
                fell(&f);
                froe_scene_free(scene);
            }
    assert_true(met > asked / 50 && met < asked - asked / 50);
}

static void simplices(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_SIMPLEX);
}
static void hulls(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_HULL);
}
static void capsules(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_CAPSULE);
}
static void segments(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_SEGMENT);
}
static void halfspaces(void **state) {
    (void)state;
    check_shape(FROE_SHAPE_HALFSPACES);
}

/** Twelve halfspaces whose planes run near the middle of a set. */
static void make_cutting_halfspaces(int dim, uint64_t seed, question *q) {
    q->range.count = MOST;
    for (size_t i = 0; i < MOST; i++) {
        double value = 0;
        for (int k = 0; k < dim; k++) {
            double *n = q->points + i * (size_t)dim + k;
            *n = 2 * trees_unit(seed, 500 + 10 * i + (uint64_t)k) - 1;
            value += *n * 3;
        }
        q->offsets[i] = value + 2 * trees_unit(seed, 700 + i) - (seed % 4 ? 0.75 : 0);
    }
}

/** Of hulls, with few corners and with more than programs have rows; and of those more halfspaces, too. */
static void hulls_meet_halfspaces(void **state) {
    const froe_allocator alloc = support_allocator(NULL);
    num_context context;
    size_t met[2] = {0, 0}, asked[2] = {0, 0};
    (void)state;
    assert_int_equal(num_context_new(&alloc, &context), FROE_OK);
    for (uint64_t seed = 0; seed < 260; seed++) {
        const bool many = seed >= 240;
        const int dim = many ? 4 : 4 + (int)(seed % 5);
        const uint32_t grid = seed / 5 % 2 && !many ? 4 : 0;
        question q;
        high_set set = {.dim = dim, .count = many ? 14 : 2 + trees_random(seed, 5, 14)};
        double corners[16 * FROE_MAX_DIM];
        bool memory = false;
        if (many)
            make_cutting_halfspaces(dim, seed, &q);
        else
            make_halfspaces(dim, grid, seed + 5000, &q);
        const double shrink = seed % 4 || many ? 0.25 : 1;
        for (size_t i = 0; i < set.count; i++)
            for (int k = 0; k < dim; k++) {
                const double x = coordinate(seed, 800 + 10 * i + (uint64_t)k, grid);
                set.x[i][k] = corners[i * (size_t)dim + (size_t)k] = shrink * x + (1 - shrink) * 2.5;
            }
        const geom_convex hull = {.dim = dim, .count = (uint32_t)set.count, .coords = corners};
        const geom_halfspaces of = {dim, q.range.count, q.points, q.offsets};
        const bool meets = halfspaces_meet(&set, q.points, q.offsets, q.range.count);
        for (int stage = NUM_FILTER; stage <= NUM_EXACT && (!many || !stage); stage += NUM_EXACT - NUM_FILTER) {
            context.first = (num_stage)stage;
            if (geom_halfspaces_meet(&context, &alloc, &of, &hull, &memory) != meets || memory)
                fail_msg("seed %d, %dD, stage %d: %d expected", (int)seed, dim, stage, meets);
        }
        met[many] += meets;
        asked[many]++;
    }
    num_context_free(&context);
    for (int many = 0; many < 2; many++)
        assert_true(met[many] > asked[many] / 10 && met[many] < asked[many] - asked[many] / 10);
}

/* ---------------------------------------------------------------- within eps -- */

/** The largest distance of two corners of a range, twice its radius added. */
static double diameter_of(int dim, const question *q) {
    const high_set set = set_of(dim, q);
    double most = 0;
    for (size_t i = 0; i < set.count; i++)
        for (size_t j = 0; j < i; j++) {
            double square = 0;
            for (int k = 0; k < dim; k++) square += (set.x[i][k] - set.x[j][k]) * (set.x[i][k] - set.x[j][k]);
            most = fmax(most, sqrt(square));
        }
    return most + 2 * set.radius;
}

/** Nothing is missed, nothing is further away than eps times the diameter, and less is visited. */
static void within_eps_less_is_visited(void **state) {
    enum { COUNT = 3000, QUESTIONS = 12 };
    static const froe_range_shape shapes[] = {FROE_SHAPE_SIMPLEX, FROE_SHAPE_HULL, FROE_SHAPE_CAPSULE};
    (void)state;
    for (int dim = 4; dim <= 6; dim += 2) {
        froe_scene *scene = make_scene(dim, FROE_POINT, 0, COUNT, 5);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        froe_query *query;
        uint64_t nodes[2] = {0, 0};
        size_t more = 0;
        o.method = "bar";
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_int_equal(froe_query_new(tree, &query, NULL), FROE_OK);
        for (uint64_t seed = 0; seed < QUESTIONS; seed++) {
            question q;
            froe_list list;
            bool exact[COUNT] = {false};
            make_question(dim, shapes[seed % 3], 0, 100 + seed, &q);
            assert_int_equal(froe_query_range(query, &q.range, &list, NULL), FROE_OK);
            for (size_t i = 0; i < list.count; i++) exact[list.ids[i]] = true;
            size_t missed = list.count;
            nodes[0] += froe_query_statistics(query).nodes;
            q.range.eps = 0.5;
            const double reach = 0.5 * diameter_of(dim, &q) * (1 + 1e-12);
            high_set grown = set_of(dim, &q);
            grown.radius += reach;
            assert_int_equal(froe_query_range(query, &q.range, &list, NULL), FROE_OK);
            nodes[1] += froe_query_statistics(query).nodes;
            for (size_t i = 0; i < list.count; i++) {
                missed -= exact[list.ids[i]];
                if (exact[list.ids[i]]) continue;
                const high_set a = high_object(scene, list.ids[i]);
                if (more++ % 8 == 0 && !high_meet(&a, &grown)) fail_msg("%s: too far away", where(&q, dim, seed));
            }
            assert_int_equal(missed, 0);
        }
        assert_true(more > 0);
        assert_true(nodes[1] < nodes[0] * 3 / 4);
        froe_query_free(query);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/** A box without one of its corners: the distance of two others is known. */
static double make_cut_box(int dim, uint64_t seed, question *q) {
    double diameter = 0, value = 0;
    q->range = froe_range_defaults();
    q->range.shape = FROE_SHAPE_HALFSPACES;
    q->range.points = q->points, q->range.offsets = q->offsets, q->range.count = 2 * (size_t)dim + 1;
    memset(q->points, 0, sizeof q->points);
    for (int k = 0; k < dim; k++) {
        const double lo = 4 * trees_unit(seed, 10 + (uint64_t)k), hi = lo + 1 + 3 * trees_unit(seed, 20 + (uint64_t)k);
        const double scale = ldexp(1, (int)trees_random(seed, 30 + (uint64_t)k, 20) - 10);
        q->points[2 * k * dim + k] = -scale;
        q->points[(2 * k + 1) * dim + k] = scale;
        q->points[2 * dim * dim + k] = 1;
        q->offsets[2 * k] = -scale * lo;
        q->offsets[2 * k + 1] = scale * hi;
        value += hi;
        diameter += (hi - lo) * (hi - lo);
    }
    q->offsets[2 * dim] = value - 0.5;
    return sqrt(diameter);
}

static void halfspaces_within_eps(void **state) {
    enum { COUNT = 3000, QUESTIONS = 8 };
    (void)state;
    for (int dim = 4; dim <= 5; dim++) {
        froe_scene *scene = make_scene(dim, FROE_POINT, 0, COUNT, 5);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        froe_query *query;
        uint64_t nodes[2] = {0, 0};
        size_t more = 0;
        o.method = "bar";
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_int_equal(froe_query_new(tree, &query, NULL), FROE_OK);
        for (uint64_t seed = 0; seed < QUESTIONS; seed++) {
            question q;
            froe_list list;
            bool exact[COUNT] = {false};
            const double diameter = make_cut_box(dim, 100 + seed, &q);
            assert_int_equal(froe_query_range(query, &q.range, &list, NULL), FROE_OK);
            for (size_t i = 0; i < list.count; i++) exact[list.ids[i]] = true;
            const size_t count = list.count;
            nodes[0] += froe_query_statistics(query).nodes;
            for (int wide = 0; wide < 2; wide++) {
                size_t missed = count;
                q.range.eps = wide ? 2 : 0.25;
                assert_int_equal(froe_query_range(query, &q.range, &list, NULL), FROE_OK);
                nodes[1] += froe_query_statistics(query).nodes * (uint64_t)wide;
                for (size_t i = 0; i < list.count; i++) {
                    missed -= exact[list.ids[i]];
                    if (exact[list.ids[i]] || more++ % 8) continue;
                    high_set grown = high_object(scene, list.ids[i]);
                    grown.radius = q.range.eps * diameter * (1 + 1e-12);
                    if (!halfspaces_meet(&grown, q.points, q.offsets, q.range.count))
                        fail_msg("%s: too far away", where(&q, dim, seed));
                }
                assert_int_equal(missed, 0);
            }
        }
        assert_true(more > 0);
        assert_true(nodes[1] < nodes[0] * 3 / 4);
        froe_query_free(query);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void what_is_not_served_says_so(void **state) {
    static const struct {
        froe_range_shape shape;
        size_t count;
        double eps;
        froe_status status;
        const char *why;
    } cases[] = {
        {FROE_SHAPE_RAY, 0, 0, FROE_E_UNSUPPORTED, "There is no ray in 4 dimensions."},
        {FROE_SHAPE_HALFSPACES, 3, 0.5, FROE_E_INPUT, "Halfspaces without a bound have no eps."},
        {FROE_SHAPE_HALFSPACES, 5, 0.5, FROE_OK, ""},
        {FROE_SHAPE_HALFSPACES, 0, 0, FROE_OK, ""},
    };
    /* four sides of a simplex, and the fifth */
    const double points[] = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 1, 1, 1, 1};
    const double bounded[] = {1, 1, 1, 1, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1};
    const double offsets[] = {16, 0, 0, 0, 0};
    froe_scene *scene = make_scene(4, FROE_POINT, 0, OBJECTS, 5);
    forest f = plant(scene);
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_range range = froe_range_defaults();
        froe_diagnostic diag = {0};
        froe_list list;
        range.shape = cases[i].shape;
        range.count = cases[i].count;
        range.points = cases[i].count == 5 ? bounded : points;
        range.offsets = offsets;
        range.eps = cases[i].eps;
        assert_int_equal(froe_query_range(f.queries[0], &range, &list, &diag), cases[i].status);
        assert_string_equal(diag.message, cases[i].why);
        if (!cases[i].status) assert_true(cases[i].count ? list.count > 0 : list.count == OBJECTS);
    }
    fell(&f);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simplices),
        cmocka_unit_test(hulls),
        cmocka_unit_test(capsules),
        cmocka_unit_test(segments),
        cmocka_unit_test(halfspaces),
        cmocka_unit_test(hulls_meet_halfspaces),
        cmocka_unit_test(within_eps_less_is_visited),
        cmocka_unit_test(halfspaces_within_eps),
        cmocka_unit_test(what_is_not_served_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
