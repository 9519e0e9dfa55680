/* Segments, simplices and hulls of R^4 .. R^8 among points, boxes and balls: every builder that serves them, audited
 * and saved, and every question, against brute force in rationals. */
#include "oracle/high.h"
#include "query/context.h"
#include "support/fuzz.h"
#include "support/memory.h"
#include <stdio.h>

enum { OBJECTS = 16, QUESTIONS = 2 };

typedef struct trial {
    fuzz_source r;
    int dim;
    bool lattice;
    double scale;
    froe_scene *scene;
    uint32_t count;
    high_set sets[OBJECTS];
    froe_tree *tree;
    froe_query *query;
} trial;

static double coordinate(trial *t) {
    return t->scale * (t->lattice ? fuzz_int(&t->r, 0, 2) : fuzz_unit(&t->r));
}

static void add(trial *t, froe_kind kind, size_t corners) {
    double points[(2 * FROE_MAX_DIM + 2) * FROE_MAX_DIM], radius = fabs(coordinate(t)) / 2;
    const size_t dim = (size_t)t->dim, starts[2] = {0, corners};
    froe_objects o = froe_objects_defaults();
    froe_diagnostic why;
    for (size_t i = 0; i < corners * dim; i++) points[i] = coordinate(t);
    for (size_t k = 0; k < dim && kind == FROE_BOX; k++) {
        const double x = points[k], y = points[dim + k];
        points[k] = fmin(x, y), points[dim + k] = fmax(x, y);
    }
    o.kind = kind, o.count = 1, o.coords = points;
    if (kind == FROE_HULL) o.starts = starts;
    if (kind == FROE_BALL) o.radii = &radius;
    if (froe_scene_add(t->scene, &o, &why)) fail_msg("%s", why.message);
}

/* Two segments that cross in the middle of a cube. */
static void add_crossing(trial *t) {
    double points[4 * FROE_MAX_DIM];
    froe_objects o = froe_objects_defaults();
    for (int k = 0; k < t->dim; k++) {
        points[k] = 0, points[t->dim + k] = 2 * t->scale;
        points[2 * t->dim + k] = (k ? k == 1 ? 0 : 1 : 2) * t->scale;
        points[3 * t->dim + k] = (k ? k == 1 ? 2 : 1 : 0) * t->scale;
    }
    o.kind = FROE_SEGMENT, o.count = 2, o.coords = points;
    assert_int_equal(froe_scene_add(t->scene, &o, NULL), FROE_OK);
}

/* The oracle knows boxes by their corners, 2^dim of them. */
static void fill(trial *t) {
    assert_int_equal(froe_scene_new(t->dim, NULL, &t->scene), FROE_OK);
    for (int i = 0; i < 4; i++) add(t, FROE_SEGMENT, 2);
    for (int i = 0; i < 3; i++) add(t, FROE_HULL, (size_t)t->dim + 1);
    for (int i = 0; i < 3; i++) add(t, FROE_HULL, (size_t)fuzz_int(&t->r, 1, 2 * t->dim));
    add_crossing(t);
    add(t, FROE_POINT, 1);
    add(t, FROE_BALL, 1);
    add(t, t->dim > 5 ? FROE_POINT : FROE_BOX, t->dim > 5 ? 1 : 2);
    t->count = (uint32_t)froe_scene_object_count(t->scene);
    for (uint32_t i = 0; i < t->count; i++) t->sets[i] = high_object(t->scene, i);
}

/* ---------------------------------------------------------------- questions -- */

static void check_range(trial *t, const froe_range *range, const high_set *set) {
    froe_list got;
    uint64_t count = 0, expected = 0;
    bool found[OBJECTS] = {false};
    froe_diagnostic why;
    if (froe_query_range(t->query, range, &got, &why)) fail_msg("%s", why.message);
    for (size_t i = 0; i < got.count; i++) found[got.ids[i]] = true;
    for (uint32_t i = 0; i < t->count; i++) {
        const bool meets = high_meet(&t->sets[i], set);
        expected += meets;
        if (found[i] != meets)
            fail_msg("R^%d, %s, %s: object %u is%s met", t->dim, froe_tree_report(t->tree).method,
                     froe_range_shape_name(range->shape), i, meets ? "" : " not");
    }
    assert_int_equal(froe_query_count(t->query, range, &count, NULL), FROE_OK);
    assert_int_equal(count, expected);
}

static void ask_ranges(trial *t) {
    double points[2 * FROE_MAX_DIM];
    froe_range range = froe_range_defaults();
    range.points = points;
    for (int i = 0; i < t->dim; i++) {
        const double x = coordinate(t), y = coordinate(t);
        points[i] = fmin(x, y), points[t->dim + i] = fmax(x, y);
    }
    if (t->dim <= 5) {
        const high_set box = high_box(t->dim, points, points + t->dim);
        check_range(t, &range, &box);
    }
    high_set ball = high_point(t->dim, points);
    range.shape = FROE_SHAPE_BALL;
    range.radius = ball.radius = fabs(coordinate(t));
    check_range(t, &range, &ball);
    /* a box without extent, and the objects at a point */
    const high_set point = high_point(t->dim, points);
    memcpy(points + t->dim, points, (size_t)t->dim * sizeof *points);
    range.shape = FROE_SHAPE_BOX;
    check_range(t, &range, &point);
    froe_list at;
    size_t expected = 0;
    assert_int_equal(froe_query_locate(t->query, points, &at, NULL), FROE_OK);
    for (uint32_t i = 0; i < t->count; i++) expected += high_meet(&t->sets[i], &point);
    assert_int_equal(at.count, expected);
}

/* The distances of polytopes; those of balls are compared by their centres, and left out here. */
static void ask_near(trial *t) {
    double x[FROE_MAX_DIM];
    froe_neighbours got;
    mpq_t square, last;
    mpq_inits(square, last, NULL);
    for (int k = 0; k < t->dim; k++) x[k] = coordinate(t);
    const high_set at = high_point(t->dim, x);
    assert_int_equal(froe_query_near(t->query, x, t->count, INFINITY, &got, NULL), FROE_OK);
    assert_int_equal(got.count, t->count);
    bool first = true;
    for (size_t i = 0, before = 0; i < got.count; i++) {
        const high_set *s = &t->sets[got.items[i].object];
        if (s->radius > 0) continue;
        high_distance2(s, &at, square);
        assert_true(high_is_root(got.items[i].distance, square));
        const int order = first ? -1 : mpq_cmp(last, square);
        assert_true(order < 0 || (order == 0 && before < got.items[i].object));
        mpq_set(last, square);
        before = got.items[i].object;
        first = false;
    }
    mpq_clears(square, last, NULL);
}

static void ask_ray(trial *t) {
    double o[FROE_MAX_DIM], d[FROE_MAX_DIM];
    bool goes = false, met[OBJECTS] = {false};
    froe_hits hits;
    froe_hit hit;
    mpq_t at, nearest;
    mpq_inits(at, nearest, NULL);
    for (int k = 0; k < t->dim; k++) {
        o[k] = coordinate(t), d[k] = coordinate(t) - o[k];
        goes = goes || d[k] != 0;
    }
    if (!goes) d[0] = t->scale;
    assert_int_equal(froe_query_ray_all(t->query, o, d, INFINITY, &hits, NULL), FROE_OK);
    for (size_t i = 0; i < hits.count; i++) met[hits.hits[i].object] = true;
    for (uint32_t i = 0; i < t->count; i++) {
        if (t->sets[i].radius > 0) continue;
        if (high_ray(o, d, &t->sets[i], at) != met[i])
            fail_msg("R^%d, %s: object %u is%s met by a ray", t->dim, froe_tree_report(t->tree).method, i,
                     met[i] ? " not" : "");
    }
    for (size_t i = 1; i < hits.count; i++) assert_true(hits.hits[i - 1].t <= hits.hits[i].t);
    assert_int_equal(froe_query_ray(t->query, o, d, INFINITY, &hit, NULL), FROE_OK);
    assert_int_equal(hit.object, hits.count ? hits.hits[0].object : FROE_NONE);
    mpq_clears(at, nearest, NULL);
}

typedef struct pair_reader {
    trial *t;
    int kind[OBJECTS][OBJECTS];
} pair_reader;

static bool read_pair(void *user, const froe_pair *p) {
    static const int kinds[] = {[FROE_MEET_CROSS] = 1, [FROE_MEET_TOUCH] = 2, [FROE_MEET_OVERLAP] = 3};
    pair_reader *r = user;
    assert_int_equal(r->kind[p->a][p->b], 0);
    r->kind[p->a][p->b] = kinds[p->kind];
    return true;
}

static uint64_t seen[4];

static void ask_pairs(trial *t) {
    pair_reader all = {.t = t}, some = {.t = t};
    assert_int_equal(froe_query_pairs(t->query, true, read_pair, &all, NULL), FROE_OK);
    assert_int_equal(froe_query_pairs(t->query, false, read_pair, &some, NULL), FROE_OK);
    for (uint32_t a = 0; a < t->count; a++)
        for (uint32_t b = a + 1; b < t->count; b++) {
            bool corner;
            if (t->sets[a].radius > 0 || t->sets[b].radius > 0) continue;
            const int expected = high_contact(&t->sets[a], &t->sets[b], &corner);
            seen[expected]++;
            if (all.kind[a][b] != expected || some.kind[a][b] != (corner ? 0 : expected))
                fail_msg("R^%d, %s: objects %u and %u: %d and %d, not %d (corner %d)", t->dim,
                         froe_tree_report(t->tree).method, a, b, all.kind[a][b], some.kind[a][b], expected, corner);
        }
}

/* -------------------------------------------------------------------- trees -- */

/* All questions of a tree, as it was built and as it comes back from its file. */
static void ask_tree(trial *t, bool pairs) {
    static const char path[] = "high.froe";
    froe_diagnostic why;
    if (froe_tree_audit(t->tree, NULL, &why))
        fail_msg("R^%d, %s: %s", t->dim, froe_tree_report(t->tree).method, why.message);
    assert_int_equal(froe_tree_save(t->tree, path, NULL), FROE_OK);
    froe_tree *saved = NULL, *built = t->tree;
    if (froe_tree_open(path, NULL, &saved, &why)) fail_msg("%s", why.message);
    if (froe_tree_audit(saved, NULL, &why)) fail_msg("%s", why.message);
    t->tree = saved;
    assert_int_equal(froe_query_new(t->tree, &t->query, NULL), FROE_OK);
    for (int i = 0; i < QUESTIONS; i++) ask_ranges(t), ask_ray(t);
    ask_near(t);
    if (pairs) ask_pairs(t);
    froe_query_free(t->query);
    froe_tree_free(saved);
    t->tree = built;
    remove(path);
}

static void ask_scene(trial *t) {
    fill(t);
    bool pairs = true; /* by one tree: how two objects meet does not depend on it */
    int served = 0;
    for (size_t m = 0; froe_method_at(m); m++) {
        const froe_method_info *method = froe_method_at(m);
        if (!froe_method_serves(method, t->scene, 2)) continue;
        froe_build_options o = froe_build_defaults();
        froe_diagnostic why;
        o.method = method->name;
        o.leaf = 2;
        if (froe_build(t->scene, &o, &t->tree, &why)) fail_msg("%s: %s", method->name, why.message);
        ask_tree(t, pairs);
        froe_tree_free(t->tree);
        pairs = false;
        served++;
    }
    assert_true(served >= 5); /* bar, density, grid, kd, quad */
    froe_scene_free(t->scene);
}

static void questions_are_answered_as_in_rationals(void **state) {
    (void)state;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim++) {
        trial t = {.r = {(uint64_t)dim}, .dim = dim, .lattice = dim % 2 == 0, .scale = 1};
        ask_scene(&t);
    }
    for (int i = 1; i < 4; i++) assert_true(seen[i] > 2);
}

static void questions_at_the_ends_of_the_range_of_doubles_are_too(void **state) {
    static const double scales[] = {1e300, 1e-300, 0x1p-1073};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        trial t = {.r = {i}, .dim = 4, .lattice = true, .scale = scales[i]};
        ask_scene(&t);
    }
}

/* The form of a segment is that of a hull, of one without length a point; equal ones are found. */
static void segments_are_hulls_of_two_corners(void **state) {
    (void)state;
    const double points[] = {0, 0, 0, 0, 1, 2, 3, 4, /**/ 1, 2, 3, 4, 0, 0, 0, 0, /**/ 5, 5, 5, 5, 5, 5, 5, 5};
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    assert_int_equal(froe_scene_new(4, NULL, &scene), FROE_OK);
    o.kind = FROE_SEGMENT, o.count = 3, o.coords = points;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    const froe_object a = froe_scene_object(scene, 0), c = froe_scene_object(scene, 2);
    assert_true(a.kind == FROE_SEGMENT && a.form == FROE_HULL && a.corners == 2);
    assert_true(c.kind == FROE_SEGMENT && c.form == FROE_POINT && c.corners == 1);
    froe_defects defects = {.size = sizeof defects};
    assert_int_equal(froe_scene_defects(scene, 1, NULL, NULL, &defects, NULL), FROE_OK);
    assert_true(defects.duplicates == 1 && defects.zero_length == 1);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_are_hulls_of_two_corners),
        cmocka_unit_test(questions_are_answered_as_in_rationals),
        cmocka_unit_test(questions_at_the_ends_of_the_range_of_doubles_are_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
