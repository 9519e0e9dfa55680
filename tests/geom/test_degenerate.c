/* test_degenerate.c: the degenerate cases among the laws of geom/predicates.h: planes without a normal, points that are
 * known by definition, balls that touch. A test begins with the numbers of the laws that it checks. Each question is
 * asked from every stage on. */
#include "geom/sides.h"
#include "support/context.h"

static geom_plane plane_of(int dim, const double *p, const double *q, const double *r) {
    return geom_plane_points(dim, (const double *const[]){p, q, r});
}

/* The plane turned round. */
static geom_plane turned(const geom_plane *h) {
    return plane_of(h->dim, h->p[1], h->p[0], h->p[2]);
}

#define FROM_EVERY_STAGE(context)                                                                                      \
    for (int stage = ((context)->first = NUM_FILTER); stage <= NUM_EXACT; (context)->first = (num_stage)++stage)

static void v2_the_points_of_a_plane_are_on_it_and_others_are_not(void **state) {
    num_context *context = *state;
    fuzz_source r = {1};
    for (int i = 0; i < 500; i++) {
        double p[3 * 3];
        fuzz_points(&r, FUZZ_LATTICE, 3, p, 3);
        const geom_plane h = plane_of(3, p, p + 3, p + 6);
        if (!geom_plane_valid(context, &h)) continue;
        double beside[3] = {p[0] + h.n[0], p[1] + h.n[1], p[2] + h.n[2]}; /* exact on this lattice */
        FROM_EVERY_STAGE(context) {
            for (int k = 0; k < 3; k++) assert_int_equal(geom_side_vertex(context, &h, p + 3 * k), 0);
            assert_int_equal(geom_side_vertex(context, &h, beside), 1);
        }
    }
}

static void v3_b5_a_plane_without_a_normal_has_everything_on_it(void **state) {
    num_context *context = *state;
    fuzz_source r = {2};
    for (int i = 0; i < 500; i++) {
        double p[3 * 3], x[3];
        fuzz_points(&r, FUZZ_LATTICE, 3, p, 2);
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, x, 1);
        for (int k = 0; k < 3; k++) p[6 + k] = p[k] + 3 * (p[3 + k] - p[k]); /* on the line of the first two */
        const geom_plane line = plane_of(3, p, p + 3, p + 6), point = plane_of(2, p, p, NULL);
        FROM_EVERY_STAGE(context) {
            assert_int_equal(geom_side_vertex(context, &line, x), 0);
            assert_int_equal(geom_side_vertex(context, &point, x), 0);
            assert_int_equal(geom_side_ball(context, &line, x, 1), 0);
            assert_int_equal(geom_side_ball(context, &point, x, 0x1p-1074), 0);
        }
    }
}

static void v4_axes_compare_and_vertical_planes_know_no_height(void **state) {
    num_context *context = *state;
    fuzz_source r = {3};
    for (int i = 0; i < 2000; i++) {
        double p[4 * 3];
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, p, 4);
        const int axis = fuzz_int(&r, 0, 2);
        const geom_plane level = geom_plane_axis(3, axis, p[axis]), h = geom_plane_vertical(p, p + 3);
        const double *x = p + 6, moved[3] = {x[0], x[1], p[11]};
        FROM_EVERY_STAGE(context) {
            assert_int_equal(geom_side_vertex(context, &level, x), (x[axis] > p[axis]) - (x[axis] < p[axis]));
            assert_int_equal(geom_side_vertex(context, &h, moved), geom_side_vertex(context, &h, x));
        }
    }
}

static void v5_walls_order_by_x_then_by_y(void **state) {
    num_context *context = *state;
    fuzz_source r = {4};
    for (int i = 0; i < 2000; i++) {
        double p[2 * 2];
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 2, p, 2);
        if (i % 2) p[2] = p[0];
        const geom_plane wall = geom_plane_at_vertex(2, p);
        const int by_x = (p[2] > p[0]) - (p[2] < p[0]), by_y = (p[3] > p[1]) - (p[3] < p[1]);
        FROM_EVERY_STAGE(context) {
            assert_int_equal(geom_side_vertex(context, &wall, p + 2), by_x ? by_x : by_y);
        }
    }
}

/* Crossings of a segment with a plane that parts its ends, or has one of them on it. */
static void x2_x3_x4_crossings_known_from_the_ends_of_their_segment(void **state) {
    num_context *context = *state;
    fuzz_source r = {5};
    int asked[3] = {0};
    for (int i = 0; i < 4000; i++) {
        double p[8 * 3];
        const int dim = 2 + i % 2;
        fuzz_points(&r, (fuzz_class)(i / 2 % FUZZ_CLASSES), dim, p, 8);
        const double *u = p + 6 * dim, *v = p + 7 * dim;
        const geom_plane h = plane_of(dim, p, p + dim, p + 2 * dim);
        const geom_plane a = plane_of(dim, p + 3 * dim, i % 3 ? p + 4 * dim : u, p + 5 * dim);
        const geom_plane along = plane_of(dim, u, v, p);
        context->first = NUM_FILTER;
        const int at_u = geom_side_vertex(context, &a, u), at_v = geom_side_vertex(context, &a, v);
        if (at_u == at_v || at_u * at_v > 0) continue;
        const int u_side = geom_side_vertex(context, &h, u), v_side = geom_side_vertex(context, &h, v);
        FROM_EVERY_STAGE(context) {
            const int side = geom_side_crossing(context, &h, u, v, &a);
            assert_int_equal(geom_side_crossing(context, &a, u, v, &a), 0);
            assert_int_equal(geom_side_crossing(context, &along, u, v, &a), 0);
            if (at_u == 0) asked[0]++, assert_int_equal(side, u_side);
            if (at_v == 0) asked[1]++, assert_int_equal(side, v_side);
            if (at_u * at_v < 0 && u_side * v_side >= 0) asked[2]++, assert_int_equal(side, u_side ? u_side : v_side);
        }
    }
    for (int k = 0; k < 3; k++) assert_true(asked[k] > 100);
}

static void c1_c3_c4_corners_that_are_vertices_or_crossings(void **state) {
    num_context *context = *state;
    fuzz_source r = {6};
    int vertices = 0, crossings = 0;
    for (int i = 0; i < 4000; i++) {
        double p[10 * 3], out[3];
        fuzz_points(&r, (fuzz_class)(i % FUZZ_CLASSES), 3, p, 10);
        const double *u = p, *v = p + 3;
        const geom_plane h = plane_of(3, p + 6, p + 9, p + 12), s = plane_of(3, u, v, p + 15),
                         b = plane_of(3, p + 18, v, u), a = plane_of(3, i % 2 ? u : p + 21, p + 24, p + 27);
        const geom_plane t[3] = {turned(&s), turned(&a), turned(&b)};
        context->first = NUM_FILTER;
        if (!(geom_image_corner(&s, &a, &b, out) < INFINITY)) continue; /* else the normals are independent */
        const int at_u = geom_side_vertex(context, &a, u), at_v = geom_side_vertex(context, &a, v);
        FROM_EVERY_STAGE(context) {
            const int side = geom_side_corner(context, &h, &s, &a, &b);
            assert_int_equal(geom_side_corner(context, &h, &t[0], &a, &b), side);
            assert_int_equal(geom_side_corner(context, &h, &s, &t[1], &b), side);
            assert_int_equal(geom_side_corner(context, &h, &b, &s, &t[1]), side);
            assert_int_equal(geom_side_corner(context, &h, &t[2], &t[1], &t[0]), side);
            if (i % 2) vertices++, assert_int_equal(side, geom_side_vertex(context, &h, u));
            if (at_u != at_v && at_u * at_v <= 0)
                crossings++, assert_int_equal(side, geom_side_crossing(context, &h, u, v, &a));
        }
    }
    assert_true(vertices > 1000 && crossings > 1000);
}

static void b1_b2_b3_balls_grow_from_their_centre(void **state) {
    num_context *context = *state;
    fuzz_source r = {7};
    for (int i = 0; i < 4000; i++) {
        double p[5 * 3];
        const int dim = 2 + i % 2;
        fuzz_points(&r, (fuzz_class)(i / 2 % FUZZ_CLASSES), dim, p, 5);
        const double *x = p + 3 * dim, less = fmin(fabs(p[4 * dim]), fabs(p[4 * dim + 1])),
                     more = fmax(fabs(p[4 * dim]), fabs(p[4 * dim + 1]));
        const geom_plane h = plane_of(dim, p, p + dim, p + 2 * dim), back = turned(&h);
        FROM_EVERY_STAGE(context) {
            const int small = geom_side_ball(context, &h, x, less), large = geom_side_ball(context, &h, x, more),
                      small_back = geom_side_ball(context, &back, x, less);
            assert_int_equal(small_back, small == 2 ? 2 : -small);
            assert_int_equal(geom_side_ball(context, &h, x, 0), geom_side_vertex(context, &h, x));
            if (small == 2) assert_int_equal(large, 2);
            if (large != 2) assert_int_equal(small, large);
        }
    }
}

static void b4_balls_that_touch_are_beside_planes_and_cut_by_walls(void **state) {
    num_context *context = *state;
    const double zero[3] = {0, 0, 0}, along[3] = {-4, 3, 0}, up[3] = {0, 0, 1}, centre[3] = {3, 4, 0}, away[2] = {5, 0};
    const geom_plane slant = plane_of(2, zero, along, NULL), tilted = plane_of(3, zero, along, up),
                     axis = geom_plane_axis(3, 1, 9), wall = geom_plane_at_vertex(2, zero);
    const double above = nextafter(5, 6), below = nextafter(5, 4);
    FROM_EVERY_STAGE(context) {
        const int side = geom_side_vertex(context, &slant, centre), other = geom_side_vertex(context, &tilted, centre);
        assert_true(side && other);
        assert_int_equal(geom_side_ball(context, &slant, centre, 5), side);
        assert_int_equal(geom_side_ball(context, &slant, centre, below), side);
        assert_int_equal(geom_side_ball(context, &slant, centre, above), 2);
        assert_int_equal(geom_side_ball(context, &tilted, centre, 5), other);
        assert_int_equal(geom_side_ball(context, &tilted, centre, above), 2);
        assert_int_equal(geom_side_ball(context, &axis, centre, 5), -1);
        assert_int_equal(geom_side_ball(context, &axis, centre, above), 2);
        assert_int_equal(geom_side_ball(context, &wall, away, 5), 2);
        assert_int_equal(geom_side_ball(context, &wall, away, below), 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(v2_the_points_of_a_plane_are_on_it_and_others_are_not),
        cmocka_unit_test(v3_b5_a_plane_without_a_normal_has_everything_on_it),
        cmocka_unit_test(v4_axes_compare_and_vertical_planes_know_no_height),
        cmocka_unit_test(v5_walls_order_by_x_then_by_y),
        cmocka_unit_test(x2_x3_x4_crossings_known_from_the_ends_of_their_segment),
        cmocka_unit_test(c1_c3_c4_corners_that_are_vertices_or_crossings),
        cmocka_unit_test(b1_b2_b3_balls_grow_from_their_centre),
        cmocka_unit_test(b4_balls_that_touch_are_beside_planes_and_cut_by_walls),
    };
    return cmocka_run_group_tests(tests, context_open, context_close);
}
