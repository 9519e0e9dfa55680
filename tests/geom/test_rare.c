/* test_rare.c: sides, ranges and sets that searches seldom ask about: sheared walls seen from afar, ends of lines,
 * planes finer than doubles, round boxes, empty boxes, a rounding mode that is not froe's; and no memory. */
#include "geom/between.h"
#include "geom/body.h"
#include "geom/eye.h"
#include "geom/high/halfspaces.h"
#include "geom/high/nearest.h"
#include "geom/meet/distance.h"
#include "geom/meet/meet.h"
#include "geom/polytope.h"
#include "geom/predicates.h"
#include "geom/range.h"
#include "geom/ray/ray.h"
#include "geom/selftest.h"
#include "geom/turn.h"
#include "support/memory.h"
#include <fenv.h>
#include <math.h>

static num_context context;

static int begin(void **state) {
    (void)state;
    return geom_context_new(NULL, &context);
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

/* Neither does what has a filter of its own: turns, and points and rays beside triangles. */
static void filters_are_asked_in_one_rounding_alone(void **state) {
    static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, above[3] = {0.25, 0.25, 1};
    const geom_body triangle = {FROE_POLYGON, 3, 3, corners, NULL, 0};
    const geom_ray ray = {3, {0.25, 0.25, 1}, {0, 0, -1}};
    (void)state;
    for (int up = 0; up < 2; up++) {
        geom_hit hit;
        if (up) fesetround(FE_UPWARD);
        const int turn = geom_turn(&context, corners, corners + 3, corners + 6);
        const geom_distance d = geom_distance_from(&context, above, &triangle);
        const bool meets = geom_ray_meets(&context, &ray, &triangle, &hit);
        fesetround(FE_TONEAREST);
        assert_true(turn == 1 && meets);
        assert_int_equal(geom_distance_compare_to(&context, above, &d, 1), 0);
        assert_true(geom_hit_round(&context, &ray, &hit) == 1);
    }
}

/* Where a line crosses another is known up to an error; where nothing is known, the error is infinite: lines that are
 * parallel but for what doubles lose, a crossing near 2^1010, and another rounding. */
static void crossings_that_doubles_cannot_tell_have_no_bound(void **state) {
    static const double lines[][8] = {{0, 0, 1, 1, 0, 1, 1, 0},
                                      {0, 0, 0.1, 0.3, 0.2, 0.6, 0.1 + 0.2, 0.9},
                                      {0x1p1010, 0, 0x1.8p1010, 1, 0x1p1010, 1, 0x1.8p1010, 0}};
    (void)state;
    for (int up = 0; up < 2; up++)
        for (int i = 0; i < 3; i++) {
            const double *const ends[4] = {lines[i], lines[i] + 2, lines[i] + 4, lines[i] + 6};
            if (up) fesetround(FE_UPWARD);
            const geom_plane wall = geom_plane_at_crossing(2, ends);
            fesetround(FE_TONEAREST);
            assert_int_equal(wall.c_err < INFINITY, !up && i == 0);
            assert_true(isfinite(wall.c));
            if (i == 0) assert_true(up || fabs(wall.c - 0.5) <= wall.c_err);
        }
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
        for (int less = 0; less >= -548; less -= 137) { /* lifted numbers are multiples of 2^-274 */
            const double normal = ldexp(1.5, less), raise = filter_raise(lift, normal);
            int exponent;
            assert_true(frexp(raise, &exponent) == 0.5);
            if (lift < 0x1p800) assert_true(raise == 1);
            if (lift >= 0x1p800) assert_true(raise * normal >= 0x1p199 && raise * normal < 0x1p201);
        }
        assert_true(filter_raise(lift, 0) == 1);
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

/* ------------------------------------------------------------------ dimension 4 -- */

/* A point as far inside a facet of a simplex as 2^-power, in it, or as far outside. */
static void points_near_facets_are_in_simplices_or_not(void **state) {
    static const double corners[] = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const geom_convex simplex = {.core = GEOM_CORE_LIST, .dim = 4, .count = 5, .coords = corners};
    (void)state;
    for (int power = 10; power < 200; power++)
        for (int way = -1; way <= 1; way++) {
            const double x[4] = {0.25, 0.25, 0.25, ldexp(way, -power)};
            const geom_convex point = {.core = GEOM_CORE_LIST, .dim = 4, .count = 1, .coords = x};
            assert_int_equal(geom_meet(&context, &simplex, &point), way >= 0);
        }
}

enum { SIGNS = 16 };

/* Of each corner of the cube [-1, 1]^4 a halfspace that lacks that corner alone, or much more. */
static void fill_signs(double corners[SIGNS][4], double offsets[SIGNS], double offset) {
    for (int i = 0; i < SIGNS; i++) {
        offsets[i] = offset;
        for (int k = 0; k < 4; k++) corners[i][k] = i >> k & 1 ? 1 : -1;
    }
}

/* Corners and halfspaces are so many that any five of these are looked at: 3 leaves most of the cube, -1 nothing. */
static void hulls_of_many_corners_meet_many_halfspaces(void **state) {
    static double corners[SIGNS][4], offsets[SIGNS];
    const geom_halfspaces cuts = {4, SIGNS, corners[0], offsets};
    const geom_convex hull = {.core = GEOM_CORE_LIST, .dim = 4, .count = SIGNS, .coords = corners[0]};
    (void)state;
    for (int offset = -1; offset <= 3; offset += 2) {
        bool memory = false;
        fill_signs(corners, offsets, offset);
        assert_int_equal(geom_halfspaces_meet(&context, &context.alloc, &cuts, &hull, &memory), offset > 0);
        assert_false(memory);
    }
}

/* Two, or all, halfspaces that have no point in common have none in common with a ball, however large. */
static void balls_do_not_meet_halfspaces_without_common_points(void **state) {
    static double corners[SIGNS][4], offsets[SIGNS];
    const double opposite[2][4] = {{1, 0, 0, 0}, {-1, 0, 0, 0}}, centre[4] = {0.5, 0.25, 0, 0};
    const geom_convex ball = {.core = GEOM_CORE_LIST, .dim = 4, .count = 1, .coords = centre, .radius = 99};
    (void)state;
    fill_signs(corners, offsets, -1);
    for (int many = 0; many < 2; many++)
        for (int inside = 0; inside < 2; inside++) {
            bool memory = false;
            for (int i = 0; i < SIGNS; i++) offsets[i] = inside ? 0 : -1; /* 0 alone is in all, or on both planes */
            const geom_halfspaces cuts = {4, many ? SIGNS : 2, many ? corners[0] : opposite[0], offsets};
            assert_int_equal(geom_halfspaces_meet(&context, &context.alloc, &cuts, &ball, &memory), inside);
            assert_false(memory);
        }
}

static froe_status meet_halfspaces(void *user, const froe_allocator *alloc) {
    static double corners[SIGNS][4], offsets[SIGNS];
    const geom_halfspaces cuts = {4, SIGNS, corners[0], offsets};
    const geom_convex box = {.core = GEOM_CORE_BOX, .dim = 4, .count = SIGNS, .coords = user};
    bool memory = false;
    fill_signs(corners, offsets, 3);
    const bool meets = geom_halfspaces_meet(&context, alloc, &cuts, &box, &memory);
    assert_int_equal(meets, !memory);
    return memory ? FROE_E_MEMORY : FROE_OK;
}

static void halfspaces_may_lack_memory(void **state) {
    static double ends[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
    (void)state;
    assert_true(test_memory_each(meet_halfspaces, ends) > 0);
}

/* A cube, a halfspace alone, none, all of space, a cube beside nothing, and two that are apart. */
static void balls_are_found_in_halfspaces_where_there_are_such(void **state) {
    double rows[9][4] = {{0}}, offsets[9] = {1, 1, 1, 1, 1, 1, 1, 1, 5};
    static const struct {
        size_t first, count;
        double offset, least;
    } cases[] = {{0, 8, 1, 0.99}, {0, 1, 1, 1e-9}, {0, 0, 1, 0}, {8, 1, 1, 0}, {0, 9, 1, 0.99}, {0, 2, -1, 0}};
    (void)state;
    for (int k = 0; k < 4; k++) rows[2 * k][k] = 1, rows[2 * k + 1][k] = -1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double x[4] = {0.5, -0.25, 3, 0};
        offsets[0] = offsets[1] = cases[i].offset;
        const geom_halfspaces of = {4, cases[i].count, rows[cases[i].first], offsets + cases[i].first};
        const double radius = geom_halfspaces_ball(&of, x);
        assert_true(radius >= cases[i].least && radius < INFINITY);
        if (cases[i].least == 0) assert_true(radius == 0);
        for (size_t row = 0; row < of.count && radius > 0; row++)
            for (int k = 0; k < 4; k++)
                if (of.normals[4 * row + (size_t)k] != 0)
                    assert_true(of.normals[4 * row + (size_t)k] * x[k] + radius <= of.offsets[row]);
    }
}

/* Points of a body may be all that there are, or be named by numbers. */
static void rays_meet_bodies_whose_points_have_no_numbers(void **state) {
    static const double ends[] = {2, -1, 0, 0, 4, 3, 0, 0};
    static const uint32_t numbers[] = {1, 0};
    const geom_ray ray = {4, {0}, {1, 0, 0, 0}};
    (void)state;
    for (int named = 0; named < 2; named++) {
        const geom_body body = {FROE_SEGMENT, 4, 2, ends, named ? numbers : NULL, 0};
        geom_hit hit;
        assert_true(geom_ray_meets(&context, &ray, &body, &hit));
        assert_true(geom_hit_round(&context, &ray, &hit) == 2.5);
    }
}

/* ------------------------------------------------------------- distances and rays -- */

/* A triangle so thin that squares of its normal underflow is as near as its plane; so is a box. */
static void thin_triangles_are_as_near_as_their_planes(void **state) {
    static const double thin[] = {0, 0, 0, 1, 0, 0, 1, 0x1p-320, 0}, wide[] = {0, -4, 0, 4, 4, 0, 0, 4, 0};
    static const double box[] = {-1, -1, 0, 2, 2, 0}, above[3] = {0.75, 0x1p-322, 1}, on[3] = {0.75, 0x1p-322, 0};
    geom_body bodies[3] = {
        {FROE_POLYGON, 3, 3, thin, NULL, 0}, {FROE_POLYGON, 3, 3, wide, NULL, 0}, {FROE_BOX, 3, 2, box, NULL, 0}};
    (void)state;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++)
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                for (int inside = 0; inside < 2; inside++) {
                    const double *x = inside ? on : above;
                    context.first = (num_stage)stage;
                    const geom_distance first = geom_distance_from(&context, x, bodies + a);
                    const geom_distance second = geom_distance_from(&context, x, bodies + b);
                    assert_int_equal(geom_distance_compare(&context, x, &first, &second), 0);
                    assert_true(geom_distance_round(&context, x, &first) == !inside);
                }
    context.first = NUM_FILTER;
}

static geom_hit wall_at(const double corners[9]) {
    return (geom_hit){.source = GEOM_PLANE, .p = corners, .q = corners + 3, .r = corners + 6, .t = {0, INFINITY}};
}

/* Of walls across one axis the coordinates are compared; beside an oblique one they say nothing. */
static void walls_are_met_in_their_order(void **state) {
    static const double at[] = {1, 0, 0, 1, 1, 0, 1, 0, 1}, again[] = {1, 5, 0, 1, 6, 0, 1, 5, 9};
    static const double next[] = {0x1.0000000000001p0, 0, 0, 0x1.0000000000001p0, 1, 0, 0x1.0000000000001p0, 0, 1};
    static const double oblique[] = {1, 0, 0, 2, 1, 0, 1, 0, 1};
    const geom_ray ray = {3, {0.1, 0, 0}, {0.3, 0, 0}};
    const geom_hit hits[] = {wall_at(at), wall_at(again), wall_at(oblique), wall_at(next)};
    (void)state;
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++)
            assert_int_equal(geom_hit_compare(&context, &ray, hits + a, hits + b), (a == 3) - (b == 3));
}

/* Gaps and directions of any size, whose quotient is a double: 3/4 2^(gap - way). */
static void walls_are_met_at_rounded_quotients_of_any_size(void **state) {
    static const int powers[] = {-1000, -250, -100, 0, 150, 199, 250, 1000};
    enum { POWERS = sizeof powers / sizeof *powers };
    (void)state;
    for (int i = 0; i < POWERS; i++)
        for (int j = 0; j < POWERS; j++) {
            const int gap = powers[i], way = powers[j];
            if (gap - way > 1000 || gap - way < -1000) continue;
            const double x = ldexp(0.75, gap), corners[9] = {x, 0, 0, x, 1, 0, x, 0, 1};
            const geom_ray ray = {3, {0, 0, 0}, {ldexp(1, way), 0, 0}};
            const geom_hit hit = wall_at(corners);
            assert_true(geom_hit_round(&context, &ray, &hit) == ldexp(0.75, gap - way));
        }
}

/* Rays that pass all edges of a triangle on one side, certainly, although they lie so nearly in its plane that filters
 * cannot tell whether they cross it upwards: they hit it where exact numbers say. */
static void rays_nearly_in_a_triangle_are_decided_exactly(void **state) {
    static const struct {
        double way[3], corners[9];
    } cases[] = {
        {{1, -0x1.e2a67e2ca0ef8p-4, -0x1.555e9ad2d9528p-54},
         {0x1.a3691aeccb948p-28, -0x1.55fcec19fde2cp-27, -0x1.49f4b75e57f4ap-67, 0x1.5a164a39ba11p-2,
          0x1.7ba81085e087p-5, -0x1.0ef10232153dap-69, -0x1.1e799cb7a1bf8p-3, -0x1.75d3b871148ap-4,
          0x1.b2839b4355a9cp-54}},
        {{1, -0x1.7f56675edb8e2p-4, 0x1.b1d4da2007e78p-51},
         {0x1.1da8f6d6d5276p-28, 0x1.972173e04f654p-28, -0x1.641e84bd5c45p-69, 0x1.759bb2f56bcp-4, 0x1.cf299803af978p-2,
          0x1.47c8ca23f6168p-48, -0x1.fdbf34c40debp-3, -0x1.0a64a1e0594cep-2, -0x1.9c18b6fe4510cp-49}}};
    int hits = 0;
    (void)state;
    for (int i = 0; i < 2; i++)
        for (int back = 0; back < 2; back++) {
            const geom_body body = {FROE_POLYGON, 3, 3, cases[i].corners, NULL, 0};
            bool met[2];
            double at[2] = {0, 0};
            geom_ray ray = {.dim = 3};
            for (int k = 0; k < 3; k++) ray.d[k] = back ? -cases[i].way[k] : cases[i].way[k];
            for (int exact = 0; exact < 2; exact++) {
                geom_hit hit;
                context.first = exact ? NUM_EXACT : NUM_FILTER;
                met[exact] = geom_ray_meets(&context, &ray, &body, &hit);
                if (met[exact]) at[exact] = geom_hit_round(&context, &ray, &hit);
            }
            context.first = NUM_FILTER;
            assert_true(met[0] == met[1] && at[0] == at[1]);
            hits += met[0];
        }
    assert_int_equal(hits, 2); /* of a line and its two directions one hits */
}

enum { STACKED = 900 };

/* Triangles behind one another, one seen along the ray through the next: each corner replaces one of the last. */
static void hulls_of_stacked_triangles_are_entered_at_the_first(void **state) {
    static const double ways[3][2] = {{2, 1}, {-2, 1}, {0, -3}};
    static double corners[STACKED][3];
    const geom_ray ray = {3, {0, 0, -1}, {0, 0, 1}};
    const geom_body hull = {FROE_HULL, 3, STACKED, corners[0], NULL, 0};
    (void)state;
    for (int i = 0; i < STACKED; i++) {
        corners[i][0] = ways[i % 3][0], corners[i][1] = ways[i % 3][1];
        corners[i][2] = STACKED - i / 3;
    }
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
        geom_hit hit;
        context.first = (num_stage)stage;
        assert_true(geom_ray_meets(&context, &ray, &hull, &hit));
        assert_true(geom_hit_round(&context, &ray, &hit) == STACKED - STACKED / 3 + 2);
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
        cmocka_unit_test(filters_are_asked_in_one_rounding_alone),
        cmocka_unit_test(crossings_that_doubles_cannot_tell_have_no_bound),
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
        cmocka_unit_test(points_near_facets_are_in_simplices_or_not),
        cmocka_unit_test(hulls_of_many_corners_meet_many_halfspaces),
        cmocka_unit_test(balls_do_not_meet_halfspaces_without_common_points),
        cmocka_unit_test(halfspaces_may_lack_memory),
        cmocka_unit_test(balls_are_found_in_halfspaces_where_there_are_such),
        cmocka_unit_test(rays_meet_bodies_whose_points_have_no_numbers),
        cmocka_unit_test(thin_triangles_are_as_near_as_their_planes),
        cmocka_unit_test(walls_are_met_in_their_order),
        cmocka_unit_test(walls_are_met_at_rounded_quotients_of_any_size),
        cmocka_unit_test(hulls_of_stacked_triangles_are_entered_at_the_first),
        cmocka_unit_test(rays_nearly_in_a_triangle_are_decided_exactly),
        cmocka_unit_test(polytopes_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
