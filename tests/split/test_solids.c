/* test_solids.c: boxes, balls and hulls that overlap or touch: what is told apart, at what cost, and that the exact
 * audit agrees. */
#include "build/options.h"
#include "split/grow.h"
#include <froe/froe.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "support/fuzz.h"
#include "support/gaps.h"
#include "support/scatter.h"

typedef struct solids {
    froe_scene *scene;
    fuzz_source random;
} solids;

static solids begin(int dim) {
    solids s = {.random = {1}};
    assert_int_equal(froe_scene_new(dim, NULL, &s.scene), FROE_OK);
    return s;
}

static void add(solids *s, froe_kind kind, size_t count, const double *coords, const double *radii,
                const size_t *starts) {
    assert_int_equal(trees_add(s->scene, kind, count, coords, radii, starts), FROE_OK);
}

/** A hull of n random points of a sphere. */
static void add_round(solids *s, size_t n, double x, double radius) {
    double *coords = test_malloc(3 * n * sizeof *coords);
    const size_t starts[2] = {0, n};
    for (size_t i = 0; i < n; i++) {
        double *p = coords + 3 * i, square = 0;
        for (int k = 0; k < 3; k++) {
            p[k] = fuzz_unit(&s->random);
            square += p[k] * p[k];
        }
        for (int k = 0; k < 3; k++) p[k] = p[k] / sqrt(square) * radius + (k == 0 ? x : 0);
    }
    add(s, FROE_HULL, 1, coords, NULL, starts);
    test_free(coords);
}

/** Builds, audits by exact arithmetic alone, and frees the scene. */
static froe_tree *build(solids *s, uint32_t leaf, uint64_t most) {
    froe_build_options o = froe_build_defaults();
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "density";
    o.leaf = leaf;
    o.threads = exact.threads = 1;
    o.max_fragments = most;
    exact.exact_only = true;
    if (froe_build(s->scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s", diag.message);
    froe_scene_free(s->scene);
    return tree;
}

static uint64_t inseparable_of(solids *s) {
    froe_tree *tree = build(s, 1, 0);
    uint64_t count = froe_tree_report(tree).inseparable;
    froe_tree_free(tree);
    return count;
}

/* ------------------------------------------------------------------- hulls -- */

/** Trying all planes would take 400^4 / 12 questions: 2 * 10^9. */
static void hulls_of_many_corners_are_told_apart_by_few_questions(void **state) {
    (void)state;
    for (int overlap = 0; overlap < 2; overlap++) {
        solids s = begin(3);
        add_round(&s, 200, 0, 1);
        add_round(&s, 200, overlap ? 1.5 : 1.9999, 1); /* their boxes overlap in both cases, nearly */
        froe_tree *tree = build(&s, 1, 0);
        assert_true(froe_tree_report(tree).predicates.calls < 20000);
        assert_int_equal(froe_tree_report(tree).inseparable, overlap);
        froe_tree_free(tree);
    }
}

/** Two tetrahedra, one face each in the plane x + y + z = 1. */
static void hulls_that_touch_are_told_apart(void **state) {
    static const double coords[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const size_t starts[] = {0, 4, 8};
    solids s = begin(3);
    (void)state;
    add(&s, FROE_HULL, 2, coords, NULL, starts);
    assert_int_equal(inseparable_of(&s), 0);
}

/** A triangle, as a hull, on a slanted face of a tetrahedron: the cut holds it. */
static void a_flat_hull_on_another_ends_in_the_cut(void **state) {
    static const double coords[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 1, 1, 1, 2, 1, 1, 1, 2};
    static const size_t starts[] = {0, 4, 7};
    solids s = begin(3);
    (void)state;
    add(&s, FROE_HULL, 2, coords, NULL, starts);
    froe_tree *tree = build(&s, 1, 0);
    assert_int_equal(froe_tree_report(tree).inseparable, 0);
    assert_int_equal(froe_tree_report(tree).in_cut, 1);
    froe_tree_free(tree);
}

/** Two triangles in the plane z = x + y, on either side of y = x - 1/4. */
static void hulls_in_one_plane_are_told_apart(void **state) {
    static const double coords[] = {0, 0, 0, 3, 3, 6, 0, 3, 3, 0.5, 0, 0.5, 3.5, 3, 6.5, 3.5, 0, 3.5};
    static const size_t starts[] = {0, 3, 6};
    solids s = begin(3);
    (void)state;
    add(&s, FROE_HULL, 2, coords, NULL, starts);
    assert_int_equal(inseparable_of(&s), 0);
}

/* ------------------------------------------------------------ unlike kinds -- */

/** Plates whose four corners lie in a plane but for a rounding, stacked at an odd angle, so that planes are counted
 * again by exact numbers; and boxes and balls about them, which have no corners that are vertices. */
static void plates_that_seem_flat_are_told_from_boxes_and_balls(void **state) {
    enum { PLATES = 12, OTHERS = 8, SCENES = 20 };
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        solids s = begin(3);
        s.random.state = seed;
        double plates[PLATES][4][3], boxes[OTHERS][2][3], balls[OTHERS][3], radii[OTHERS];
        size_t starts[PLATES + 1] = {0};
        for (size_t i = 0; i < PLATES; i++) {
            starts[i + 1] = starts[i] + 4;
            for (int j = 0; j < 4; j++) {
                const double x = j == 1 || j == 2, y = j > 1, z = 0.1 * (double)(i / 2), u = x + (double)(i % 2);
                plates[i][j][0] = cos(0.7) * u - sin(0.7) * z;
                plates[i][j][1] = y;
                plates[i][j][2] = sin(0.7) * u + cos(0.7) * z;
            }
        }
        for (size_t i = 0; i < OTHERS; i++) {
            radii[i] = 0.2;
            for (int k = 0; k < 3; k++) {
                balls[i][k] = 2 * fuzz_unit(&s.random);
                boxes[i][0][k] = 2 * fuzz_unit(&s.random);
                boxes[i][1][k] = boxes[i][0][k] + 0.2;
            }
        }
        add(&s, FROE_HULL, PLATES, plates[0][0], NULL, starts);
        add(&s, FROE_BOX, OTHERS, boxes[0][0], NULL, NULL);
        add(&s, FROE_BALL, OTHERS, balls[0], radii, NULL);
        froe_tree_free(build(&s, 1, 0));
    }
}

/** Unit vectors at right angles: the first is the direction of the gap. */
static void draw_frame(solids *s, int dim, double frame[3][3]) {
    for (int i = 0; i < dim;) {
        double length = 0;
        for (int k = 0; k < dim; k++) frame[i][k] = fuzz_unit(&s->random);
        for (int j = 0; j < i; j++) {
            double along = 0;
            for (int k = 0; k < dim; k++) along += frame[i][k] * frame[j][k];
            for (int k = 0; k < dim; k++) frame[i][k] -= along * frame[j][k];
        }
        for (int k = 0; k < dim; k++) length += frame[i][k] * frame[i][k];
        length = sqrt(length);
        for (int k = 0; k < dim; k++) frame[i][k] /= length;
        if (length > 0.1) i++;
    }
}

/** A ball, a hull or a box on the side `way` of the plane across frame[0] through the origin, about `gap` from it. */
static void add_beside(solids *s, int dim, froe_kind kind, double way, double gap, double frame[3][3]) {
    enum { CORNERS = 6 };
    double coords[CORNERS * 3], radius = 0.6 + 0.3 * fuzz_unit(&s->random);
    const size_t starts[2] = {0, CORNERS};
    for (int i = 0; i < CORNERS; i++)
        for (int k = 0; k < dim; k++) coords[i * dim + k] = way * gap * frame[0][k];
    if (kind == FROE_BALL)
        for (int k = 0; k < dim; k++) coords[k] += way * radius * frame[0][k];
    for (int i = 0; i < CORNERS && kind == FROE_HULL; i++) /* the first dim corners are as near as the gap says */
        for (int j = 0; j < dim; j++) {
            const double step = j ? fuzz_unit(&s->random) : i < dim ? 0 : way * radius;
            for (int k = 0; k < dim; k++) coords[i * dim + k] += step * frame[j][k];
        }
    for (int k = 0; k < dim && kind == FROE_BOX; k++)
        coords[way * frame[0][k] > 0 ? dim + k : k] += way * frame[0][k] > 0 ? radius : -radius;
    add(s, kind, 1, coords, kind == FROE_BALL ? &radius : NULL, kind == FROE_HULL ? starts : NULL);
}

/** Gaps down to a few units in the last place of the coordinates; axis-parallel planes separate few of these pairs. */
static void disjoint_solids_of_any_kinds_are_told_apart(void **state) {
    static const froe_kind kinds[] = {FROE_BALL, FROE_HULL, FROE_BOX};
    (void)state;
    solids s = {.random = {11}};
    for (int i = 0; i < 3000; i++) {
        const int dim = 2 + i % 2;
        double frame[3][3], gap = pow(10, -1 - i / 2 % 15);
        assert_int_equal(froe_scene_new(dim, NULL, &s.scene), FROE_OK);
        draw_frame(&s, dim, frame);
        add_beside(&s, dim, kinds[i % 3], 1, gap, frame);
        add_beside(&s, dim, kinds[i / 3 % 3], -1, gap, frame);
        if (inseparable_of(&s)) fail_msg("case %d, gap %g", i, gap);
    }
}

/** Pairs of every two kinds, near and far, as narrow as doubles go. */
static void pairs_of_every_two_kinds_are_told_apart_in_all_dimensions(void **state) {
    static const gaps_place places[] = {{1e-1, 1, 0},       {1e-5, 1, 0},      {1e-10, 1, 0},
                                        {1e-15, 1, 0},      {1e-15, 1, 1e6},   {1e-14, 1e-300, 0},
                                        {1e-15, 1e-300, 1}, {1e-14, 1e307, 0}, {1e-15, 1e307, 3}};
    (void)state;
    fuzz_source random = {17};
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++)
        for (int i = 0; i < GAPS_KINDS * GAPS_KINDS; i++)
            for (size_t at = 0; at < sizeof places / sizeof *places; at++) {
                solids s = begin(dim);
                gaps_pair pair;
                gaps_draw(&random, dim, gaps_kinds[i / GAPS_KINDS], gaps_kinds[i % GAPS_KINDS], places[at], &pair);
                bool served = true;
                for (int k = 0; k < 2; k++) {
                    const geom_body *b = &pair.body[k];
                    const size_t starts[2] = {0, b->count};
                    served =
                        served && !trees_add(s.scene, b->form, 1, b->coords, b->form == FROE_BALL ? &b->radius : NULL,
                                             b->form == FROE_HULL ? starts : NULL);
                }
                if (!served) { /* segments and hulls above dimension 3 */
                    assert_true(dim > 3);
                    froe_scene_free(s.scene);
                    continue;
                }
                if (inseparable_of(&s)) fail_msg("R^%d, kinds %d, place %zu", dim, i, at);
            }
}

/* --------------------------------------------------------- heavy overlap -- */

/** From 0 to 1. */
static double share(solids *s) {
    return 0.5 + 0.5 * fuzz_unit(&s->random);
}

/** n boxes in the unit cube, half as wide as `reach` to one and a half times; bars: all across on some axis. */
static void add_boxes(solids *s, int dim, size_t n, double reach, bool bars) {
    for (size_t i = 0; i < n; i++) {
        double coords[2 * FROE_MAX_DIM];
        int across = bars ? (int)(i % (size_t)dim) : -1;
        for (int k = 0; k < dim; k++) {
            double at = share(s), half = k == across ? 1 : reach * (0.5 + share(s));
            coords[k] = at - half;
            coords[dim + k] = at + half;
        }
        add(s, FROE_BOX, 1, coords, NULL, NULL);
    }
}

static void add_balls(solids *s, int dim, size_t n, double radius) {
    for (size_t i = 0; i < n; i++) {
        double centre[3] = {0};
        for (int k = 0; k < dim; k++) centre[k] = share(s);
        add(s, FROE_BALL, 1, centre, &radius, NULL);
    }
}

/** Hulls of 2^dim points, one in each orthant around a centre, none further than `reach` from it on any axis. */
static void add_hulls(solids *s, int dim, size_t n, double reach) {
    const size_t corners = (size_t)1 << dim, starts[2] = {0, corners};
    for (size_t i = 0; i < n; i++) {
        double coords[8 * 3], centre[3];
        for (int k = 0; k < dim; k++) centre[k] = share(s);
        for (size_t j = 0; j < corners; j++)
            for (int k = 0; k < dim; k++)
                coords[j * (size_t)dim + (size_t)k] = centre[k] + (j >> k & 1 ? reach : -reach) * (1 - 0.5 * share(s));
        add(s, FROE_HULL, 1, coords, NULL, starts);
    }
}

/** Pairs of objects whose bounding boxes overlap. */
static uint64_t overlaps(const froe_scene *scene) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++)
        for (uint32_t j = 0; j < i; j++) {
            double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM];
            bool meet = true;
            scene_object_bounds(scene, i, lo[0], hi[0]);
            scene_object_bounds(scene, j, lo[1], hi[1]);
            for (int k = 0; k < scene->dim; k++) meet &= hi[0][k] > lo[1][k] && hi[1][k] > lo[0][k];
            count += meet;
        }
    return count;
}

/** Pairs that overlap are in the leaves of any partition. So at most three entries for each of them, and for each
 * object, are few: to tell all separable pairs apart takes up to 10^6 pieces and more. */
static void assert_few_pieces(solids *s) {
    uint64_t most = 3 * (s->scene->object_count + overlaps(s->scene));
    froe_tree *tree = build(s, 1, most);
    froe_report r = froe_tree_report(tree);
    assert_true(r.fragments <= most);
    assert_true(r.max_leaf <= 1 || r.inseparable + r.crowded > 0);
    froe_tree_free(tree);
}

static void overlapping_balls_cost_no_more_than_they_overlap(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (double radius = 0.5; radius > 0.01; radius /= 2) {
            solids s = begin(dim);
            add_balls(&s, dim, 300, radius);
            assert_few_pieces(&s);
        }
}

static void overlapping_boxes_cost_no_more_than_they_overlap(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++)
        for (int bars = 0; bars < 1 + (dim == 2); bars++) /* in space, bars that are disjoint cost many pieces, too */
            for (double reach = 0.4; reach > 0.01; reach /= 3) {
                solids s = begin(dim);
                add_boxes(&s, dim, 250, reach, bars);
                assert_few_pieces(&s);
            }
}

static void overlapping_hulls_cost_no_more_than_they_overlap(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (double reach = 0.4; reach > 0.01; reach /= 4) {
            solids s = begin(dim);
            add_hulls(&s, dim, 100, reach);
            assert_few_pieces(&s);
        }
}

/** Three layers of a brick wall, without mortar. */
static void what_only_touches_is_always_told_apart(void **state) {
    solids s = begin(2);
    (void)state;
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < 20; i++) {
            const double coords[4] = {2 * i + row % 2, row, 2 * i + row % 2 + 2, row + 1};
            add(&s, FROE_BOX, 1, coords, NULL, NULL);
        }
    froe_tree *tree = build(&s, 1, 0);
    assert_int_equal(froe_tree_report(tree).max_leaf, 1);
    froe_tree_free(tree);
}

/* However few or many candidates a cell has, the audit agrees. */
static void candidates_may_be_few_or_many(void **state) {
    static const char *const settings[] = {"supports=1 quantiles=40 small=0", "supports=1 quantiles=0 small=0 free=no",
                                           "supports=0 quantiles=40 edges=0", "quantiles=12 k=2 stop=1"};
    (void)state;
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        for (int kind = 0; kind < 3; kind++) {
            solids s = begin(3);
            const froe_kind kinds[] = {FROE_BALL, FROE_POLYGON, FROE_BOX};
            for (int j = 0; j < 9; j++) {
                double at[9], radius = 1;
                for (int c = 0; c < 9; c++) at[c] = fuzz_int(&s.random, 0, 9);
                for (int c = 0; c < 3 && kinds[kind] == FROE_BOX; c++) at[3 + c] = at[c] + 3;
                add(&s, kinds[kind], 1, at, kinds[kind] == FROE_BALL ? &radius : NULL, NULL);
            }
            froe_build_options o = froe_build_defaults();
            froe_diagnostic diag = {0};
            froe_tree *tree = NULL;
            o.method = "density", o.settings = settings[i], o.leaf = 1, o.threads = 1;
            if (build_tuned(s.scene, &o, &tree, &diag)) fail_msg("%s: %s", settings[i], diag.message);
            if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s: %s", settings[i], diag.message);
            assert_true(froe_tree_report(tree).nodes > 9);
            froe_tree_free(tree);
            froe_scene_free(s.scene);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overlapping_balls_cost_no_more_than_they_overlap),
        cmocka_unit_test(overlapping_boxes_cost_no_more_than_they_overlap),
        cmocka_unit_test(overlapping_hulls_cost_no_more_than_they_overlap),
        cmocka_unit_test(what_only_touches_is_always_told_apart),
        cmocka_unit_test(hulls_of_many_corners_are_told_apart_by_few_questions),
        cmocka_unit_test(hulls_that_touch_are_told_apart),
        cmocka_unit_test(a_flat_hull_on_another_ends_in_the_cut),
        cmocka_unit_test(hulls_in_one_plane_are_told_apart),
        cmocka_unit_test(plates_that_seem_flat_are_told_from_boxes_and_balls),
        cmocka_unit_test(disjoint_solids_of_any_kinds_are_told_apart),
        cmocka_unit_test(candidates_may_be_few_or_many),
        cmocka_unit_test(pairs_of_every_two_kinds_are_told_apart_in_all_dimensions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
