/* test_rare.c: sides, ranges and sets that searches seldom ask about: sheared walls seen from afar, ends of lines,
 * planes finer than doubles, round boxes, empty boxes, a rounding mode that is not froe's; and no memory. */
#include "geom/between.h"
#include "geom/body.h"
#include "geom/eye.h"
#include "geom/high/nearest.h"
#include "geom/meet/meet.h"
#include "geom/polytope.h"
#include "geom/predicates.h"
#include "geom/range.h"
#include "geom/ray/ray.h"
#include "geom/selftest.h"
#include "support/memory.h"
#include <fenv.h>
#include <math.h>

static num_context context;

static int begin(void **state) {
    (void)state;
    return geom_context_new(NULL, &context) || num_arena_reserve(&context.alloc, &context.arena, geom_meet_arena);
}

static int end(void **state) {
    (void)state;
    num_context_free(&context);
    return 0;
}

/* The normal of a sheared wall is (1, eps, 0): the second coordinate decides where the first is 0. */
static void eyes_far_away_see_sheared_walls_by_their_shear(void **state) {
    static const double ways[6][3] = {{1, -9, 0}, {-1, 9, 0}, {0, 2, 1}, {0, -2, 1}, {0, 0, 3}, {0x1p-1074, -1, 0}};
    static const int sides[6] = {1, -1, 1, -1, 0, 1};
    const geom_plane wall = geom_plane_at_vertex(3, (const double[]){5, 5, 5});
    (void)state;
    for (int i = 0; i < 6; i++) {
        const geom_eye eye = geom_eye_make(true, ways[i], NULL);
        assert_int_equal(geom_side_of_eye(&context, &wall, &eye), sides[i]);
    }
}

static void ends_of_lines_lie_on_them(void **state) {
    static const double u[3] = {1, 2, 3}, v[3] = {4, -1, 5}, beside[3] = {2, 7, 1};
    const geom_line line = {.kind = GEOM_SIGHT_EDGE, .u = u, .v = v};
    (void)state;
    for (int parallel = 0; parallel < 2; parallel++) {
        const geom_eye eye = geom_eye_make(parallel, (const double[]){9, 8, 20}, NULL);
        assert_int_equal(geom_line_side_point(&context, &eye, &line, u), 0);
        assert_int_equal(geom_line_side_point(&context, &eye, &line, v), 0);
        assert_int_not_equal(geom_line_side_point(&context, &eye, &line, beside), 0);
    }
}

/* Where the rounding is not to nearest no error bound of a filter holds: planes say so. */
static void planes_trust_no_other_rounding(void **state) {
    static const double p[2] = {0.1, 0.2}, q[2] = {0.7, 0.3};
    (void)state;
    const geom_plane right = geom_plane_points(2, (const double *const[]){p, q});
    const geom_plane vector = geom_plane_vector(2, p, 0.25),
                     fine = geom_plane_fine(2, (const double[]){0.1, 0.2, 0.3}, 1);
    fesetround(FE_UPWARD);
    const geom_plane up = geom_plane_points(2, (const double *const[]){p, q});
    const geom_plane fine_up = geom_plane_fine(2, (const double[]){0.1, 0.2, 0.3}, 1);
    fesetround(FE_TONEAREST);
    assert_true(right.n_err < 1 && fine.n_err < 1 && vector.n_err == 0);
    assert_true(isinf(up.n_err) && isinf(fine_up.n_err));
}

/* Two planes of the same sums are one, whatever their rows; of other rows they are not. */
static void fine_planes_are_told_apart(void **state) {
    static const double rows[2][6] = {{1, 2, 3, 4, 5, 6}, {1, 2, 3, 4, 5, 7}};
    const double x[2] = {1, 1};
    (void)state;
    const geom_plane one = geom_plane_fine(2, rows[0], 2), same = geom_plane_fine(2, rows[0], 2);
    const geom_plane less = geom_plane_fine(2, rows[0], 1), other = geom_plane_fine(2, rows[1], 2);
    const geom_plane *all[] = {&one, &same, &less, &other};
    static const double u[2] = {-9, 4}, v[2] = {9, 5};
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++) { /* where the line u v crosses plane a: on a itself, by definition or exactly */
            const int side = geom_side_crossing(&context, all[b], u, v, all[a]);
            if (a == b || a + b == 1) assert_int_equal(side, 0);
            if ((a == 2) != (b == 2) || (a == 3) != (b == 3)) assert_int_not_equal(side, 0);
        }
    assert_int_equal(geom_side_vertex(&context, &less, x), 0); /* 1 + 2 = 3 */
    assert_int_equal(geom_side_vertex(&context, &one, x), 1);  /* and 2^-53 (4 + 5 - 6) */
}

static void boxes_lie_beside_vertical_planes(void **state) {
    static const double p[3] = {0, 0, 0}, q[3] = {1, 1, 0};
    const geom_plane wall = geom_plane_vertical(p, q);
    (void)state;
    const int side = geom_side_box(&context, &wall, (const double[]){2, 0, 0}, (const double[]){3, 1, 1});
    assert_int_equal(geom_side_box(&context, &wall, (const double[]){0, 2, 0}, (const double[]){1, 3, 1}), -side);
    assert_int_equal(geom_side_box(&context, &wall, (const double[]){0, 0, 0}, (const double[]){1, 2, 1}), 2);
    assert_true(side == 1 || side == -1);
    for (int k = 0; k < 3; k++) /* and beside planes across an axis, up to where they touch */
        for (int at = -1; at <= 4; at++) {
            double lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9};
            lo[k] = 1, hi[k] = 2;
            const geom_plane across = geom_plane_axis(3, k, 0.5 * at);
            assert_int_equal(geom_side_box(&context, &across, lo, hi), at <= 2 ? 1 : at >= 4 ? -1 : 2);
        }
}

/* Where segments of the plane cross lines given by vectors, beside walls through points: left or right, then below or
 * above, whatever the line is given by. */
static void crossings_of_vectors_lie_beside_sheared_walls(void **state) {
    static const double ways[][2] = {{1, 0}, {0, 1}, {1, 2}, {-3, 1}};
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int x = 1; x < 4 && i != j; x++)
                for (int y = 1; y < 4; y++) {
                    const double u[2] = {2 - ways[i][0], 2 - ways[i][1]}, v[2] = {2 + ways[i][0], 2 + ways[i][1]};
                    const double n[2] = {-ways[j][1], ways[j][0]};
                    const geom_plane line = geom_plane_vector(2, n, 2 * n[0] + 2 * n[1]); /* both cross at 2, 2 */
                    const geom_plane wall = geom_plane_at_vertex(2, (const double[]){x, y});
                    const int side = x != 2 ? (x < 2) - (x > 2) : (y < 2) - (y > 2);
                    assert_int_equal(geom_side_crossing(&context, &wall, u, v, &line), side);
                }
}

/* A point that is no segment has no crossing with a wall, whichever wall it is. */
static void nothing_crosses_where_nothing_is(void **state) {
    static const double u[2] = {1, 2}, v[2] = {3, 2};
    double out[2];
    (void)state;
    const geom_plane wall = geom_plane_at_vertex(2, (const double[]){2, 7});
    geom_round_crossing(&context, u, v, &wall, out);
    assert_true(out[0] == 2 && out[1] == 2);
    geom_round_crossing(&context, u, u, &wall, out);
    assert_true(isnan(out[0]) && isnan(out[1]));
}

/* Tiny normals are scaled by powers of two, up to about 2^200, wherever they begin. */
static void tiny_normals_are_raised(void **state) {
    (void)state;
    for (int power = -1074; power < -800; power++) {
        const double most = ldexp(1.5, power < -1073 ? -1073 : power), lift = filter_lift(most);
        assert_true(lift * most >= 0x1p-80 && lift * most < 0x1p200);
        for (int less = 0; less > -1900; less -= 100) {
            const double normal = ldexp(1.5, less), raise = filter_raise(lift, normal);
            int exponent;
            assert_true(frexp(raise, &exponent) == 0.5);
            if (lift < 0x1p800) assert_true(raise == 1);
            if (lift >= 0x1p800 && less >= -800) assert_true(raise * normal >= 0x1p199 && raise * normal < 0x1p201);
            if (lift >= 0x1p800 && less < -900 && normal > 0) assert_true(raise == 0x1p1000);
        }
        assert_true(filter_raise(lift, 0) == 1 && filter_raise(lift, 0x1p200) == 1);
    }
}

static void no_vector_is_fine_that_overflows(void **state) {
    static const filter_vector vectors[] = {{{3, 4, 0}, 4, 1},
                                            {{3, 4, 0}, 4, 3},
                                            {{INFINITY, 0, 0}, INFINITY, 1},
                                            {{INFINITY, 0, 0}, INFINITY, INFINITY},
                                            {{0x1p999, 0, 0}, 0x1p999, 1}};
    static const bool fine[] = {true, false, false, false, true};
    (void)state;
    for (int i = 0; i < 5; i++) assert_int_equal(filter_is_fine(vectors + i, 0.5), fine[i]);
}

/* ------------------------------------------------------------------------ sets -- */

static void ranks_of_bodies(void **state) {
    static const double box[] = {0, 0, 0, 1, 0, 2}, ball[] = {1, 1, 1, 4};
    (void)state;
    geom_body b = {.form = FROE_BOX, .dim = 3, .coords = box, .count = 2};
    assert_int_equal(geom_body_rank(&context, &b), 2);
    b = (geom_body){.form = FROE_BALL, .dim = 3, .coords = ball, .count = 1};
    assert_int_equal(geom_body_rank(&context, &b), 3);
    b = (geom_body){.form = FROE_POINT, .dim = 3, .coords = box, .count = 1};
    assert_int_equal(geom_body_rank(&context, &b), 0);
    b = (geom_body){.form = FROE_SEGMENT, .dim = 3, .coords = box, .count = 2};
    assert_int_equal(geom_body_rank(&context, &b), 1);
}

/* Gaps of 3 and 4 are bridged by radii of 5 in all, whichever of the two has them. */
static void round_boxes_meet_across_gaps(void **state) {
    static const double lo_a[] = {0, 0}, hi_a[] = {1, 1}, lo_b[] = {4, 5}, hi_b[] = {9, 9};
    (void)state;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
        context.first = (num_stage)stage;
        for (int part = 0; part <= 5; part++) {
            assert_true(geom_meet_boxes(&context, 2, lo_a, hi_a, part, lo_b, hi_b, 5 - part));
            assert_false(geom_meet_boxes(&context, 2, lo_a, hi_a, part, lo_b, hi_b, nextafter(5 - part, -1) - 0x1p-50));
        }
        assert_false(geom_meet_boxes(&context, 2, lo_a, hi_a, 0, lo_b, hi_b, 0));
        assert_true(geom_meet_boxes(&context, 2, lo_a, hi_a, 0, hi_a, hi_b, 0));
    }
    context.first = NUM_FILTER;
}

static void sets_meet_surely_only_by_error_bounds(void **state) {
    static const double a[] = {0, 0, 4, 0, 0, 4}, b[] = {1, 1, 9, 1, 1, 9};
    const geom_convex one = {.core = GEOM_CORE_LIST, .dim = 2, .count = 3, .coords = a};
    const geom_convex two = {.core = GEOM_CORE_LIST, .dim = 2, .count = 3, .coords = b};
    (void)state;
    assert_true(geom_meet(&context, &one, &two));
    assert_true(geom_meet_surely(&context, &one, &two));
    context.first = NUM_EXACT;
    assert_true(geom_meet(&context, &one, &two));
    assert_false(geom_meet_surely(&context, &one, &two));
    context.first = NUM_FILTER;
}

static void ranges_of_nothing_shrink_to_nothing(void **state) {
    (void)state;
    const geom_range thin = {.kind = GEOM_RANGE_THIN, .dim = 2, .lo = {0, 0}, .hi = {2, 2}};
    assert_false(geom_range_holds(&context, &thin, 0, (const double[]){1, 1}, (const double[]){1, 1}));
    geom_range box = {.kind = GEOM_RANGE_BOX, .dim = 2, .lo = {0, 0}, .hi = {2, 2}};
    double lo[2] = {1, 1}, hi[2] = {0.5, 2};
    assert_false(geom_range_shrink(&box, lo, hi));
    hi[0] = 1;
    assert_true(geom_range_shrink(&box, lo, hi));
    assert_true(geom_range_holds(&context, &box, 0, lo, hi));
    hi[0] = 2.5;
    assert_false(geom_range_holds(&context, &box, 0, lo, hi));
    assert_true(geom_range_holds(&context, &box, 1, lo, hi)); /* the corner rounded off is far away */
    context.first = NUM_EXACT;
    assert_false(geom_range_holds(&context, &box, 1, lo, hi)); /* by doubles only */
    context.first = NUM_FILTER;
}

/* The guess is a hint: three times the same difference, the furthest one, a good one, or none. */
static void wrong_guesses_change_no_distance(void **state) {
    static const double a[] = {0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0}, b[] = {1, 1, 3, 0, 1, 1, 5, 7, 9, 1, 3, 0};
    static const geom_simplex guesses[] = {{.count = 0},
                                           {.count = 3, .a = {1, 1, 1}, .b = {2, 2, 2}},
                                           {.count = 1, .a = {2}, .b = {2}},
                                           {.count = 3, .a = {0, 1, 2}, .b = {0, 0, 0}},
                                           {.count = 4, .a = {0, 0, 1, 1}, .b = {0, 1, 0, 1}}};
    const geom_convex one = {.core = GEOM_CORE_LIST, .dim = 4, .count = 3, .coords = a};
    const geom_convex two = {.core = GEOM_CORE_LIST, .dim = 4, .count = 3, .coords = b};
    const geom_gaps gaps = {.a = &one, .b = &two};
    (void)state;
    for (size_t i = 0; i < sizeof guesses / sizeof *guesses; i++) {
        geom_nearest found;
        context.arena.top = 0;
        assert_true(geom_nearest_find(&context, &gaps, &guesses[i], &found));
        assert_false(found.zero); /* (1, 1, 3, 0) is 3 above the triangle */
        const num_dyadic nine = num_dyadic_from(&context.arena, 9);
        const num_dyadic wanted = num_dyadic_mul(&context.arena, nine, found.square.bottom);
        assert_int_equal(num_dyadic_compare(found.square.top, wanted), 0);
    }
    context.arena.top = 0;
}

/* What a ball is met by lies before the ray, at every stage. */
static void balls_are_met_ahead(void **state) {
    const geom_ray ray = {2, {0, 0, 0}, {1, 0, 0}};
    const geom_hit hit = {.source = GEOM_SPHERE};
    (void)state;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
        context.first = (num_stage)stage;
        assert_int_equal(geom_hit_sign(&context, &ray, &hit), 1);
    }
    context.first = NUM_FILTER;
}

/* ---------------------------------------------------------------------- memory -- */

static froe_status cut_a_box(void *user, const froe_allocator *alloc) {
    const int dim = *(int *)user;
    static const double normals[2][24] = {
        {1, 1, -1, 1, 1, -1, -1, -1, 1, 2, 2, 1, 0, 0, -1, 2, -2, 1, 1, -2, 2, -1, -1, -2},
        {1, 1, 1, -1, 1, 1, 1, -1, 1, 1, 1, -1, 0, 0, 0, -1, -1, 1, -1, 1, -1, 1, -1, -1}};
    static const double offsets[12] = {1, 1, 1, 1, 1.5, 1.5, 0, 1.7, 1.7, 1.7, 1.7, 1.7};
    static const double lo[3] = {-1, -1, -1}, hi[3] = {1, 1, 1};
    geom_polytope p = {.error = 0};
    const bool room =
        geom_polytope_make(&context, alloc, dim, normals[dim - 2], offsets, dim == 2 ? 12 : 8, lo, hi, &p);
    if (room) assert_true(p.corners.count >= 8);
    geom_polytope_free(&p, alloc);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static void polytopes_may_lack_memory(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) assert_true(test_memory_each(cut_a_box, &dim) >= 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eyes_far_away_see_sheared_walls_by_their_shear),
        cmocka_unit_test(ends_of_lines_lie_on_them),
        cmocka_unit_test(planes_trust_no_other_rounding),
        cmocka_unit_test(fine_planes_are_told_apart),
        cmocka_unit_test(boxes_lie_beside_vertical_planes),
        cmocka_unit_test(crossings_of_vectors_lie_beside_sheared_walls),
        cmocka_unit_test(nothing_crosses_where_nothing_is),
        cmocka_unit_test(tiny_normals_are_raised),
        cmocka_unit_test(no_vector_is_fine_that_overflows),
        cmocka_unit_test(ranks_of_bodies),
        cmocka_unit_test(round_boxes_meet_across_gaps),
        cmocka_unit_test(sets_meet_surely_only_by_error_bounds),
        cmocka_unit_test(ranges_of_nothing_shrink_to_nothing),
        cmocka_unit_test(wrong_guesses_change_no_distance),
        cmocka_unit_test(balls_are_met_ahead),
        cmocka_unit_test(polytopes_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
