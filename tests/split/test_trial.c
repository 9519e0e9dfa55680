/* test_trial.c: refinement that costs too much is taken back where guard cuts cost less, and only there; what a tree
 * is promised to be follows from what trials allow, and fails where nothing is taken back. */
#include "base/random.h"
#include "build/options.h"
#include "support/memory.h"
#include <froe/formats.h>
#include <froe/froe.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static froe_scene *generate(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 1, NULL, &scene, NULL), FROE_OK);
    return scene;
}

static froe_tree *build(froe_scene *scene, const char *settings, int threads) {
    froe_tree *tree = NULL;
    froe_diagnostic diag = {0};
    froe_build_options o = froe_build_defaults();
    o.method = "density";
    o.settings = settings;
    o.leaf = 1;
    o.threads = threads;
    if (build_tuned(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    return tree;
}

static void audit(const froe_tree *tree) {
    froe_diagnostic diag = {0};
    if (froe_tree_audit(tree, NULL, &diag)) fail_msg("%s", diag.message);
}

/** Pieces per object of a scene, which is freed; the tree is audited. */
static double pieces_each(froe_scene *scene, const char *settings, int threads) {
    froe_tree *tree = build(scene, settings, threads);
    audit(tree);
    double each = (double)froe_tree_piece_count(tree) / (double)froe_scene_object_count(scene);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return each;
}

static const froe_promise *promise_of(const froe_report *report, const char *name) {
    for (const froe_promise *p = report->promises; p->name; p++)
        if (!strcmp(p->name, name)) return p;
    return NULL;
}

/* A small cell is finished at once. So refinement may be complete when it is found to exceed its allowance, and where
 * guard cuts exceed theirs it has to be judged again, as no cell of it is pending. */
static void refinement_that_is_complete_when_it_exceeds_its_allowance_is_judged_again(void **state) {
    static const char *const kinds[] = {"slats-3d", "grid-3d", "border-3d", "mixed-3d"};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (size_t n = 24; n <= 96; n += 24) pieces_each(generate(kinds[i], n), "k=4 stop=1", 1);
}

/* ------------------------------------------------- scenes of low density -- */

enum { DEEP = 20, MOST = 4096 };

typedef struct soup {
    double x[MOST][3][3];
    size_t count, most;
} soup;

static double unit(uint64_t *state) {
    return (double)(base_mix(++*state) >> 11) * 0x1p-53;
}

/** The columns of a random rotation. */
static void turn(uint64_t *state, double out[3][3]) {
    double q[4], square = 0;
    for (int k = 0; k < 4; k++) q[k] = unit(state) - 0.5, square += q[k] * q[k];
    for (int k = 0; k < 4; k++) q[k] /= sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                            {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                            {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    memcpy(out, r, sizeof r);
}

static void put_triangle(soup *s, const double at[3], const double axes[3][3], const double x[3][3]) {
    if (s->count == s->most) return;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            s->x[s->count][c][k] = at[k] + x[c][0] * axes[0][k] + x[c][1] * axes[1][k] + x[c][2] * axes[2][k];
    s->count++;
}

static void put_cube(soup *s, const double at[3], double h, const double axes[3][3]) {
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side < 2; side += 2)
            for (int half = 0; half < 2; half++) {
                double x[3][3];
                for (int c = 0; c < 3; c++) {
                    const int corner = half ? (int[]){0, 2, 3}[c] : c; /* of 00 10 11 01 */
                    x[c][axis] = side * h;
                    x[c][(axis + 1) % 3] = corner == 1 || corner == 2 ? h : -h;
                    x[c][(axis + 2) % 3] = corner >= 2 ? h : -h;
                }
                put_triangle(s, at, axes, x);
            }
}

/** Where the i-th of some groups lies, 4 apart and far from the origin. */
static void group_at(size_t i, double at[3]) {
    at[0] = 1000 + 1.0 / 3 + 4 * (double)(i % 3);
    at[1] = 77.7 + 4 * (double)(i / 3 % 3);
    at[2] = 4 * (double)(i / 9);
}

/** Nests of cubes side by side, each tilted its own way. */
static void nests(soup *s, uint64_t *state) {
    for (size_t i = 0; s->count < s->most; i++) {
        double at[3], axes[3][3];
        group_at(i, at);
        turn(state, axes);
        for (int level = 0; level < DEEP; level++) put_cube(s, at, ldexp(1, -level), axes);
    }
}

/** Nests that are all tilted the same way, so that their faces nearly lie in common planes. */
static void aligned_nests(soup *s, uint64_t *state) {
    double axes[3][3];
    turn(state, axes);
    for (size_t i = 0; s->count < s->most; i++) {
        double at[3], from[3];
        group_at(i, from);
        for (int k = 0; k < 3; k++)
            at[k] = from[0] * axes[0][k] + from[1] * axes[1][k] + from[2] * axes[2][k] + 1e-9 * unit(state);
        for (int level = 0; level < DEEP; level++) put_cube(s, at, ldexp(1, -level), axes);
    }
}

/** Shells, each off the centre of the one around it. */
static void shells(soup *s, uint64_t *state) {
    for (size_t i = 0; s->count < s->most; i++) {
        double at[3], axes[3][3], h = 1;
        group_at(i, at);
        turn(state, axes);
        for (int level = 0; level < DEEP; level++, h *= 0.5) {
            put_cube(s, at, h, axes);
            for (int k = 0; k < 3; k++) at[k] += h * (0.45 * axes[0][k] + 0.4 * axes[1][k] - 0.3 * axes[2][k]);
        }
    }
}

/** Shells with long sticks that lean around each of them. */
static void leaning(soup *s, uint64_t *state) {
    for (size_t i = 0; s->count < s->most; i++) {
        double at[3], axes[3][3], h = 0.25;
        group_at(i, at);
        turn(state, axes);
        for (int level = 0; level < DEEP / 2; level++, h *= 0.25) {
            put_cube(s, at, h, axes);
            for (int stick = 0; stick < 8; stick++) {
                double around[3][3];
                const double u = h * (unit(state) - 0.5), v = 0.9 * h, w = 0.9 * h * (unit(state) - 0.5);
                const double x[3][3] = {{1.9 * h - u, -v, -w}, {1.9 * h + u, v, w}, {1.92 * h + u, v, w + 0.03 * h}};
                turn(state, around);
                put_triangle(s, at, around, x);
            }
        }
    }
}

/** Triangles of all scales around a dense cluster, which the planes of all of them cross. */
static void orbits(soup *s, uint64_t *state) {
    const double still[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, at[3] = {0, 0, 0};
    for (size_t i = 0; s->count < s->most / 2; i++) {
        const double h = ldexp(1, -(int)(i / 12));
        const double x[3][3] = {{h, 0, 0}, {1.4 * h, 0.25 * h, 0}, {1.4 * h, -0.25 * h, 0}};
        double axes[3][3];
        turn(state, axes);
        put_triangle(s, at, axes, x);
    }
    const double h = ldexp(1, -(int)(s->most / 24) - 2), e = h / cbrt((double)s->most);
    while (s->count < s->most) {
        double from[3], x[3][3];
        for (int k = 0; k < 3; k++) from[k] = h * (unit(state) - 0.5);
        for (int c = 0; c < 9; c++) x[c / 3][c % 3] = e * (unit(state) - 0.5);
        put_triangle(s, from, still, x);
    }
}

typedef void make_soup(soup *s, uint64_t *state);

static froe_scene *soup_of(make_soup *make, size_t n) {
    soup *s = calloc(1, sizeof *s);
    uint64_t state = 1;
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    assert_true(s && n <= MOST);
    s->most = n;
    make(s, &state);
    o.kind = FROE_POLYGON;
    o.count = n;
    o.coords = &s->x[0][0][0];
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    free(s);
    return scene;
}

/* ---------------------------------------------------------------- pieces -- */

/** Without guards (k = 10^9) 3,000 triangles of the first four have 19, 21, 7.3 and 7.0 pieces each. */
static void scenes_of_low_density_have_few_pieces(void **state) {
    static const struct {
        make_soup *make;
        double most;
    } scenes[] = {{nests, 8.8}, {aligned_nests, 9}, {shells, 8.2}, {leaning, 7.6}, {orbits, 1.6}};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        for (size_t n = 1000; n <= 2000; n *= 2) {
            double each = pieces_each(soup_of(scenes[i].make, n), NULL, 2);
            if (each > scenes[i].most) fail_msg("%zu triangles of scene %zu have %g pieces each", n, i, each);
        }
}

/** Refinement of the first cells would make 6, 14 and more pieces each. */
static void nested_cubes_have_few_pieces_whatever_their_number(void **state) {
    (void)state;
    for (size_t n = 1000; n <= 4000; n *= 2) assert_true(pieces_each(generate("nested-3d", n), NULL, 2) < 5.2);
}

static void nested_squares_have_few_pieces(void **state) {
    (void)state;
    assert_true(pieces_each(generate("nested", 3000), NULL, 2) < 6.5);
}

/** A quarter of n^2 crossings. Guard cuts would make 1.7 times as many pieces. */
static void where_every_partition_is_quadratic_refinement_stays(void **state) {
    (void)state;
    assert_true(pieces_each(generate("slats-3d", 200), NULL, 2) < 51.5);
}

static void a_trial_ends_alike_on_any_number_of_threads(void **state) {
    (void)state;
    froe_scene *scene = generate("nested-3d", 2000);
    froe_tree *one = build(scene, NULL, 1), *three = build(scene, NULL, 3);
    const froe_report a = froe_tree_report(one), b = froe_tree_report(three);
    assert_true(a.fragments == b.fragments && a.nodes == b.nodes && a.height == b.height);
    for (size_t i = 0; a.promises[i].name; i++) {
        assert_string_equal(a.promises[i].name, b.promises[i].name);
        assert_true(a.promises[i].promised == b.promises[i].promised);
        assert_true(a.promises[i].measured == b.promises[i].measured);
    }
    froe_tree_free(one);
    froe_tree_free(three);
    froe_scene_free(scene);
}

/* -------------------------------------------------------------- promises -- */

/** What is promised, over n; for the height, as it is. */
static void promised(froe_scene *scene, double pieces, double levels) {
    froe_tree *tree = build(scene, NULL, 2);
    const froe_report r = froe_tree_report(tree);
    const double n = (double)froe_scene_object_count(scene);
    audit(tree);
    const froe_promise *fragments = promise_of(&r, "fragments"), *height = promise_of(&r, "height");
    assert_non_null(promise_of(&r, "tests"));
    assert_true(fragments && fragments->measured == (double)r.fragments && fragments->promised < pieces * n);
    assert_true(height && height->measured == (double)r.height && height->promised < levels);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void promises_are_small_where_the_density_is_low(void **state) {
    (void)state;
    promised(soup_of(nests, 2000), 16, 400);
    promised(soup_of(orbits, 2000), 12, 400);
    promised(generate("nested-3d", 2000), 13, 200);
    promised(generate("nested", 2000), 10, 120);
    promised(generate("cuboids", 2000), 12, 70);
    promised(generate("segments", 2000), 5, 60);
}

static void fails_to_keep(const char *kind, size_t n, const char *settings, const char *promise) {
    froe_diagnostic diag = {0};
    froe_scene *scene = generate(kind, n);
    froe_tree *tree = build(scene, settings, 2);
    assert_int_equal(froe_tree_audit(tree, NULL, &diag), FROE_E_AUDIT);
    if (!strstr(diag.message, promise)) fail_msg("%s", diag.message);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/** Nothing is taken back; there are no guards besides; refinement is allowed next to no tests. */
static void crippled_methods_fail_to_keep_their_promises(void **state) {
    (void)state;
    fails_to_keep("nested-3d", 2000, "trials=0", "'fragments'");
    fails_to_keep("nested", 2000, "trials=0", "'fragments'");
    fails_to_keep("slats-3d", 200, "trials=0", "'fragments'");
    fails_to_keep("nested-3d", 2000, "trials=0 stop=1000000000", "'fragments'");
    fails_to_keep("slats-3d", 200, "trials=1e-9", "'tests'");
}

/** Where refinement is refused everything, cells end in the leaves of the guard tree, cut along their fragments. */
static void refinement_that_is_allowed_nothing_ends_all_the_same(void **state) {
    (void)state;
    static const char *const kinds[] = {"nested-3d", "slats-3d", "segments", "balls",
                                        "boxes-3d",  "debris",   "points-3d"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        froe_audit_options o = froe_audit_defaults();
        froe_diagnostic diag = {0};
        froe_scene *scene = generate(kinds[i], 300);
        froe_tree *tree = build(scene, "trials=1e-9 stop=0", 2);
        froe_status status = froe_tree_audit(tree, &o, &diag);
        if (status && !strstr(diag.message, "promise 'tests'")) fail_msg("%s: %s", kinds[i], diag.message);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------- height -- */

static froe_scene *nested_points(size_t n, int scales) {
    double *xy = malloc(2 * n * sizeof *xy);
    uint64_t state = 1;
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    assert_non_null(xy);
    for (size_t i = 0; i < 2 * n; i++) xy[i] = ldexp(2 * unit(&state) - 1, -(int)(i / 2 % (size_t)scales));
    o.kind = FROE_POINT;
    o.count = n;
    o.coords = xy;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    free(xy);
    return scene;
}

/** The guard tree is 2,000 levels high. */
static void points_of_many_scales_make_a_low_tree(void **state) {
    (void)state;
    froe_scene *scene = nested_points(32000, 1000);
    froe_tree *low = build(scene, NULL, 2), *high = build(scene, "height=0", 2);
    audit(low);
    assert_true((double)froe_tree_report(low).height < 5 * log2(32000));
    assert_true((double)froe_tree_report(high).height > 10 * log2(32000));
    froe_tree_free(low);
    froe_tree_free(high);
    froe_scene_free(scene);
}

/* ---------------------------------------------------------------- limits -- */

/** Neither way has so few pieces; both are given up long before they are done. */
static void a_limit_of_pieces_ends_trials(void **state) {
    (void)state;
    froe_scene *scene = generate("slats-3d", 600);
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    froe_diagnostic diag = {0};
    o.method = "density";
    o.leaf = 1;
    for (o.max_fragments = 1000; o.max_fragments < 90000; o.max_fragments *= 4)
        assert_int_equal(froe_build(scene, &o, &tree, &diag), FROE_E_BUDGET);
    assert_non_null(strstr(diag.message, "no more are allowed"));
    o.max_fragments = 200000;
    assert_int_equal(froe_build(scene, &o, &tree, &diag), FROE_OK);
    audit(tree);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/** Hulls that nearly all meet, of which each cut divides many; the scene is one cell of 4096 guard leaves. */
static froe_scene *crowded_hulls(const froe_allocator *alloc) {
    enum { DIM = 6, HULLS = 60, CORNERS = 9 };
    static double x[HULLS * CORNERS * DIM];
    size_t starts[HULLS + 1];
    uint64_t state = 1;
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    for (size_t i = 0; i <= HULLS; i++) starts[i] = i * CORNERS;
    for (size_t i = 0; i < HULLS; i++) {
        double low[DIM];
        for (size_t k = 0; k < DIM; k++) low[k] = unit(&state);
        for (size_t c = 0; c < CORNERS * DIM; c++) x[i * CORNERS * DIM + c] = low[c % DIM] + 2 * unit(&state);
    }
    o.kind = FROE_HULL;
    o.count = HULLS;
    o.coords = x;
    o.starts = starts;
    assert_int_equal(froe_scene_new(DIM, alloc, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

/** Refinement is given up where it exceeds the limit, and not where it exceeds what the trial allows. So arrays
 * grow to the pieces of a small tree: 60 calls for memory, and 131 when refinement goes on. */
static void a_limit_of_pieces_ends_refinement_of_one_crowded_cell_soon(void **state) {
    (void)state;
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    froe_scene *scene = crowded_hulls(&alloc);
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    o.method = "density", o.leaf = 1, o.threads = 1, o.max_fragments = 100;
    const size_t before = m.calls;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_E_BUDGET);
    assert_in_range(m.calls - before, 20, 100);
    froe_scene_free(scene);
    test_memory_end(&m);
}

/** In these squares refinement is taken back, and in these slats it waits and goes on. */
static froe_status build_on_trial(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    o.method = "density";
    o.threads = 1;
    froe_status status = froe_generate(user, 300, 1, alloc, &scene, NULL);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void trials_survive_every_failing_allocation(void **state) {
    (void)state;
    test_memory_each(build_on_trial, "nested");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refinement_that_is_complete_when_it_exceeds_its_allowance_is_judged_again),
        cmocka_unit_test(scenes_of_low_density_have_few_pieces),
        cmocka_unit_test(nested_cubes_have_few_pieces_whatever_their_number),
        cmocka_unit_test(nested_squares_have_few_pieces),
        cmocka_unit_test(where_every_partition_is_quadratic_refinement_stays),
        cmocka_unit_test(a_trial_ends_alike_on_any_number_of_threads),
        cmocka_unit_test(promises_are_small_where_the_density_is_low),
        cmocka_unit_test(crippled_methods_fail_to_keep_their_promises),
        cmocka_unit_test(refinement_that_is_allowed_nothing_ends_all_the_same),
        cmocka_unit_test(points_of_many_scales_make_a_low_tree),
        cmocka_unit_test(a_limit_of_pieces_ends_trials),
        cmocka_unit_test(a_limit_of_pieces_ends_refinement_of_one_crowded_cell_soon),
        cmocka_unit_test(trials_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
