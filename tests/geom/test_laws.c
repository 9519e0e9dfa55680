/* test_laws.c: the laws of geom/predicates.h that are algebra: scaling, exact translation, permuting what defines a
 * plane or a point, mirrors. A test begins with the numbers of the laws that it checks; test_degenerate.c has the
 * others, and A1, X5 and C5 are checked by test_sides.c and test_walls.c against rationals. And how often which stage
 * is needed. */
#include "geom/filter.h"
#include "geom/sides.h"
#include "support/context.h"
#include <fenv.h>

typedef struct answers {
    int vertex, crossing, corner, ball;
} answers;

typedef struct frame { /* what a law does to the points */
    double scale;
    double shift[3];
    int axis[3]; /* new coordinate k is old coordinate axis[k] */
} frame;

static void place(const frame *f, const double *points, double *out) {
    for (int i = 0; i < SIDES_POINTS * 3; i++) {
        int k = i % 3;
        out[i] = points[i - k + f->axis[k]] * f->scale + f->shift[k];
    }
}

static geom_plane triangle(const double *p, int i, int j, int k) {
    const double *points[3] = {p + 3 * i, p + 3 * j, p + 3 * k};
    return geom_plane_points(3, points);
}

static answers ask(num_context *context, const double *p, double radius) {
    geom_plane h = triangle(p, 0, 1, 2), s = triangle(p, 3, 4, 5), a = triangle(p, 6, 7, 8), b = triangle(p, 9, 10, 11);
    const double *u = p + 36, *v = p + 39;
    answers out = {geom_side_vertex(context, &h, u), 0, 0, geom_side_ball(context, &h, u, radius)};
    int at_u = geom_side_vertex(context, &a, u), at_v = geom_side_vertex(context, &a, v);
    if (at_u != at_v) out.crossing = geom_side_crossing(context, &h, u, v, &a);
    rational_plane r[3];
    rational_point x;
    const geom_plane *planes[3] = {&s, &a, &b};
    for (int i = 0; i < 3; i++) rational_plane_init(&r[i]), rational_plane_set(&r[i], planes[i]);
    rational_point_init(&x);
    if (rational_corner(&x, &r[0], &r[1], &r[2])) out.corner = geom_side_corner(context, &h, &s, &a, &b);
    for (int i = 0; i < 3; i++) rational_plane_clear(&r[i]);
    rational_point_clear(&x);
    return out;
}

static void assert_same(answers a, answers b, int sign) {
    assert_int_equal(a.vertex, sign * b.vertex);
    assert_int_equal(a.crossing, sign * b.crossing);
    assert_int_equal(a.corner, sign * b.corner);
    assert_int_equal(a.ball, b.ball == 2 ? 2 : sign * b.ball);
}

static const fuzz_class exact_classes[] = {FUZZ_SMALL_LATTICE, FUZZ_LATTICE, FUZZ_FLAT, FUZZ_CONCURRENT};

static void a2_scaling_by_a_power_of_two_changes_nothing(void **state) {
    num_context *context = *state;
    fuzz_source r = {1};
    double p[SIDES_POINTS * 3], q[SIDES_POINTS * 3];
    for (int i = 0; i < 2000; i++) {
        fuzz_points(&r, (fuzz_class)(i % FUZZ_ULPS), 3, p, SIDES_POINTS);
        frame f = {ldexp(1, fuzz_int(&r, -900, 900)), {0}, {0, 1, 2}};
        place(&f, p, q);
        assert_same(ask(context, q, 0.25 * f.scale), ask(context, p, 0.25), 1);
    }
}

static void a3_an_exact_translation_changes_nothing(void **state) {
    num_context *context = *state;
    fuzz_source r = {2};
    double p[SIDES_POINTS * 3], q[SIDES_POINTS * 3];
    for (int i = 0; i < 2000; i++) {
        fuzz_points(&r, exact_classes[i % 4], 3, p, SIDES_POINTS);
        frame f = {1, {fuzz_int(&r, -1000, 1000), 0x1p40, -0x1p50 + fuzz_int(&r, 0, 9)}, {0, 1, 2}};
        place(&f, p, q);
        assert_same(ask(context, q, 3), ask(context, p, 3), 1);
    }
}

static void a4_exchanging_two_axes_mirrors_and_rotating_all_three_does_not(void **state) {
    num_context *context = *state;
    fuzz_source r = {3};
    double p[SIDES_POINTS * 3], q[SIDES_POINTS * 3];
    for (int i = 0; i < 2000; i++) {
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, p, SIDES_POINTS);
        frame mirror = {1, {0}, {1, 0, 2}}, turn = {1, {0}, {1, 2, 0}};
        answers plain = ask(context, p, 0.5);
        place(&mirror, p, q);
        assert_same(ask(context, q, 0.5), plain, -1);
        place(&turn, p, q);
        assert_same(ask(context, q, 0.5), plain, 1);
    }
}

static void v1_x1_permuting_the_points_of_a_plane_gives_the_sign_of_the_permutation(void **state) {
    num_context *context = *state;
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
    fuzz_source r = {4};
    double p[SIDES_POINTS * 3];
    for (int i = 0; i < 3000; i++) {
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, p, SIDES_POINTS);
        geom_plane h = triangle(p, 0, 1, 2), a = triangle(p, 6, 7, 8);
        const double *u = p + 36, *v = p + 39, *u2 = p, *v2 = p + 3;
        bool cross = geom_side_vertex(context, &a, u) != geom_side_vertex(context, &a, v);
        int side = geom_side_vertex(context, &h, u), crossing = cross ? geom_side_crossing(context, &h, u, v, &a) : 0;
        for (int k = 0; k < 6; k++) {
            geom_plane g = triangle(p, order[k][0], order[k][1], order[k][2]);
            assert_int_equal(geom_side_vertex(context, &g, u), k < 3 ? side : -side);
            if (!cross) continue;
            assert_int_equal(geom_side_crossing(context, &g, u, v, &a), k < 3 ? crossing : -crossing);
            assert_int_equal(geom_side_crossing(context, &g, v, u, &a), k < 3 ? crossing : -crossing);
            geom_plane turned = triangle(p, 6 + order[k][0], 6 + order[k][1], 6 + order[k][2]);
            assert_int_equal(geom_side_crossing(context, &h, u, v, &turned), crossing);
        }
        geom_plane l = geom_plane_points(2, (const double *const[]){u2, v2}),
                   m = geom_plane_points(2, (const double *const[]){v2, u2});
        assert_int_equal(geom_side_vertex(context, &l, u), -geom_side_vertex(context, &m, u));
    }
}

static void c1_c2_permuting_the_planes_of_a_corner_changes_nothing(void **state) {
    num_context *context = *state;
    fuzz_source r = {5};
    sides_case c;
    sides_oracle o;
    sides_oracle_init(&o);
    for (int i = 0; i < 3000; i++) {
        sides_draw(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, &c);
        sides_oracle_set(&o, &c, 4);
        if (!rational_corner(&o.x, &o.planes[1], &o.planes[2], &o.planes[3])) continue;
        const geom_plane *h = &c.planes[0], *s = h + 1, *a = h + 2, *b = h + 3;
        int side = geom_side_corner(context, h, s, a, b);
        assert_int_equal(geom_side_corner(context, h, b, s, a), side);
        assert_int_equal(geom_side_corner(context, h, a, s, b), side);
        assert_int_equal(geom_side_corner(context, s, s, a, b), 0);
        assert_int_equal(geom_side_corner(context, b, s, a, b), 0);
    }
    sides_oracle_clear(&o);
}

/* What neighbours in a mesh share is known without arithmetic. */
static void a7_shared_corners_and_edges_are_zeros_by_id(void **state) {
    num_context *context = *state;
    fuzz_source r = {6};
    double p[8 * 3];
    context->stats = (froe_predicate_stats){0};
    for (int i = 0; i < 1000; i++) {
        fuzz_points(&r, FUZZ_RANDOM, 3, p, 8);
        geom_plane h = triangle(p, 0, 1, 2), s = triangle(p, 1, 0, 3), a = triangle(p, 4, 0, 5),
                   b = triangle(p, 6, 7, 4);
        for (int k = 0; k < 3; k++) assert_int_equal(geom_side_vertex(context, &h, p + 3 * k), 0);
        geom_plane c = triangle(p, 0, 6, 7);
        assert_int_equal(geom_side_corner(context, &h, &s, &a, &c), 0); /* all through p[0] */
        assert_int_equal(geom_side_corner(context, &h, &b, &s, &h), 0);
        if (geom_side_vertex(context, &b, p) != geom_side_vertex(context, &b, p + 3))
            assert_int_equal(geom_side_crossing(context, &s, p, p + 3, &b), 0); /* along an edge of s */
    }
    assert_int_equal(context->stats.exact, 0);
    assert_int_equal(context->stats.refined, 0);
    assert_true(context->stats.by_id >= 5000);
}

static froe_predicate_stats measure(num_context *context, fuzz_class kind) {
    fuzz_source r = {7};
    double p[SIDES_POINTS * 3];
    context->stats = (froe_predicate_stats){0};
    for (int i = 0; i < 4000; i++) {
        fuzz_points(&r, kind, 3, p, SIDES_POINTS);
        ask(context, p, 0.3);
    }
    return context->stats;
}

static void filters_decide_nearly_all_random_input(void **state) {
    num_context *context = *state;
    froe_predicate_stats s = measure(context, FUZZ_RANDOM);
    assert_int_equal(s.filtered, s.calls);
    s = measure(context, FUZZ_FAR);
    assert_true(s.filtered + s.refined == s.calls && (double)s.refined < 0.001 * (double)s.calls);
    s = measure(context, FUZZ_LATTICE);
    assert_int_equal(s.exact, 0);
}

static void balls_certify_nearly_all_zeros_of_lattices(void **state) {
    num_context *context = *state;
    for (int i = 0; i < 4; i++) {
        froe_predicate_stats s = measure(context, exact_classes[i]);
        assert_true((double)s.exact < 0.01 * (double)s.calls);
    }
}

static void a5_extreme_exponents_stay_within_the_arena(void **state) {
    num_context *context = *state;
    fuzz_source r = {8};
    sides_case c;
    sides_oracle o;
    sides_oracle_init(&o);
    context->first = NUM_EXACT;
    for (int i = 0; i < 300; i++) {
        double out[3];
        sides_draw(&r, FUZZ_EXTREMES, 3, &c);
        sides_oracle_set(&o, &c, 4);
        ask(context, c.points, 1e308);
        if (!rational_corner(&o.x, &o.planes[1], &o.planes[2], &o.planes[3])) continue;
        geom_side_corner(context, &c.planes[0], &c.planes[1], &c.planes[2], &c.planes[3]);
        geom_round_corner(context, &c.planes[1], &c.planes[2], &c.planes[3], out);
    }
    sides_oracle_clear(&o);
    print_message("  %zu of %zu limbs\n", context->arena.high, context->arena.capacity);
    assert_true(context->arena.high > 4000);
    assert_true(2 * context->arena.high <= num_arena_bound);
}

/* Under another rounding mode the filters keep silent, and every answer stays right. */
static void a6_a_wrong_rounding_mode_makes_slow_not_wrong(void **state) {
    static const int modes[3] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    num_context *context = *state, strange;
    for (int m = 0; m < 3; m++) {
        fuzz_source r = {9};
        double p[SIDES_POINTS * 3];
        for (int i = 0; i < 500; i++) {
            fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, p, SIDES_POINTS);
            answers plain = ask(context, p, 0.5);
            fesetround(modes[m]);
            assert_int_equal(num_context_new(NULL, &strange), FROE_OK);
            answers other = ask(&strange, p, 0.5);
            geom_plane h = triangle(p, 0, 1, 2);
            int image = geom_side_image(&h, p + 36, 0);
            fesetround(FE_TONEAREST);
            assert_int_equal(strange.first, NUM_EXACT);
            assert_int_equal(strange.stats.exact, strange.stats.calls);
            assert_int_equal(image, NUM_UNSURE);
            assert_same(other, plain, 1);
            num_context_free(&strange);
        }
    }
}

/* Vertices beside planes through tiny differences: no need for exact numbers as long as these are normal. */
static void filters_know_no_scale(void **state) {
    num_context *context = *state;
    for (int exponent = 0; exponent > -900; exponent -= 30) {
        fuzz_source r = {7};
        froe_predicate_stats before = context->stats;
        for (int i = 0; i < 200; i++) {
            double p[4][3];
            const double *points[3] = {p[0], p[1], p[2]};
            for (int j = 0; j < 12; j++) p[j / 3][j % 3] = ldexp(fuzz_unit(&r), j < 9 ? exponent : exponent / 2);
            for (int dim = 2; dim <= 3; dim++) {
                geom_plane plane = geom_plane_points(dim, points);
                geom_side_vertex(context, &plane, p[3]);
            }
        }
        assert_true(context->stats.filtered - before.filtered > 396);
        assert_true(context->stats.exact == before.exact);
    }
}

/* Where the differences themselves are denormal, and keep some 20 bits. */
static void filters_decide_denormal_scenes(void **state) {
    num_context *context = *state;
    for (int exponent = -900; exponent >= -1050; exponent -= 30) {
        fuzz_source r = {8};
        const froe_predicate_stats before = context->stats;
        int sure = 0;
        for (int i = 0; i < 200; i++) {
            double p[4][3];
            const double *points[3] = {p[0], p[1], p[2]};
            for (int j = 0; j < 12; j++) p[j / 3][j % 3] = ldexp(fuzz_unit(&r), exponent);
            for (int dim = 2; dim <= 3; dim++) {
                const geom_plane plane = geom_plane_points(dim, points);
                geom_side_vertex(context, &plane, p[3]);
            }
            const filter_line line = filter_line_through(p[0], p[1], true);
            const double w[2] = {fabs(p[3][0] - p[0][0]), fabs(p[3][1] - p[0][1])};
            const double f = filter_line_value(&line, p[3][0], p[3][1]), e = filter_line_bound(&line, w[0], w[1]);
            const geom_plane plane = geom_plane_points(2, points);
            sure += fabs(f) > e;
            const geom_plane wall = geom_plane_axis(3, 0, 0.5 * p[2][0] + 0.5 * p[3][0]);
            const geom_plane other = geom_plane_points(3, (const double *[3]){p[3], p[1], p[2]});
            geom_side_crossing(context, &wall, p[0], p[3], &other);
            geom_side_crossing(context, &other, p[0], p[1], &wall);
            if (fabs(f) > e) assert_int_equal(geom_side_vertex(context, &plane, p[3]), f > 0 ? 1 : -1);
        }
        assert_true(sure > 195);
        assert_true(context->stats.filtered - before.filtered > 770);
        assert_true(context->stats.exact - before.exact < 10);
    }
}

int main(void) {
#define LAW(name) cmocka_unit_test_setup_teardown(name, context_open, context_close)
    const struct CMUnitTest tests[] = {
        LAW(filters_know_no_scale),
        LAW(filters_decide_denormal_scenes),
        LAW(a2_scaling_by_a_power_of_two_changes_nothing),
        LAW(a3_an_exact_translation_changes_nothing),
        LAW(a4_exchanging_two_axes_mirrors_and_rotating_all_three_does_not),
        LAW(v1_x1_permuting_the_points_of_a_plane_gives_the_sign_of_the_permutation),
        LAW(c1_c2_permuting_the_planes_of_a_corner_changes_nothing),
        LAW(a7_shared_corners_and_edges_are_zeros_by_id),
        LAW(filters_decide_nearly_all_random_input),
        LAW(balls_certify_nearly_all_zeros_of_lattices),
        LAW(a5_extreme_exponents_stay_within_the_arena),
        LAW(a6_a_wrong_rounding_mode_makes_slow_not_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
