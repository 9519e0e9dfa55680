/* test_far_planes.c: predicates of planes n . x = c above dimension 3, started at every stage, against exact rationals
 * (GMP) straight from the definition. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/predicates.h"
#include "support/context.h"
#include "support/fuzz.h"
#include <gmp.h>

enum { TRIALS = 400, PLANES = 2, POINTS = 2 };

/* Planes h and a; points u and v, which are corners of a box, too. */
typedef struct far_case {
    int dim;
    double normals[PLANES][FROE_MAX_DIM], offsets[PLANES], points[POINTS][FROE_MAX_DIM], radius;
    geom_plane planes[PLANES];
} far_case;

static void draw_case(fuzz_source *r, fuzz_class kind, int dim, far_case *c) {
    *c = (far_case){.dim = dim, .radius = fabs(fuzz_coordinate(r, kind))};
    for (int k = 0; k < dim; k++) {
        for (int i = 0; i < PLANES; i++) c->normals[i][k] = fuzz_coordinate(r, kind);
        for (int i = 0; i < POINTS; i++) c->points[i][k] = fuzz_coordinate(r, kind);
    }
    for (int i = 0; i < PLANES; i++) {
        /* mostly one of the points is on it, up to rounding */
        const double *x = c->points[fuzz_int(r, 0, POINTS - 1)];
        double through = 0;
        for (int k = 0; k < dim; k++) through += c->normals[i][k] * x[k];
        c->offsets[i] = fuzz_int(r, 0, 2) && isfinite(through) ? through : fuzz_coordinate(r, kind);
        c->planes[i] = geom_plane_vector(dim, c->normals[i], c->offsets[i]);
    }
}

/* ------------------------------------------------------------------ oracle -- */

/* n . x - c */
static void set_value(mpq_t out, const far_case *c, int plane, const double *x) {
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_d(out, -c->offsets[plane]);
    for (int k = 0; k < c->dim; k++) {
        mpq_set_d(a, c->normals[plane][k]);
        mpq_set_d(b, x[k]);
        mpq_mul(a, a, b);
        mpq_add(out, out, a);
    }
    mpq_clears(a, b, NULL);
}

static int side_of_point(const far_case *c, int plane, const double *x) {
    mpq_t value;
    mpq_init(value);
    set_value(value, c, plane, x);
    const int side = mpq_sgn(value);
    mpq_clear(value);
    return side;
}

/* At u + t (v - u) with a(u) + t (a(v) - a(u)) = 0 the plane h has the value h(u) + t (h(v) - h(u)). */
static int side_of_meeting(const far_case *c) {
    mpq_t hu, hv, au, av, t;
    mpq_inits(hu, hv, au, av, t, NULL);
    set_value(hu, c, 0, c->points[0]);
    set_value(hv, c, 0, c->points[1]);
    set_value(au, c, 1, c->points[0]);
    set_value(av, c, 1, c->points[1]);
    mpq_sub(t, au, av);
    mpq_div(t, au, t);
    mpq_sub(hv, hv, hu);
    mpq_mul(hv, hv, t);
    mpq_add(hu, hu, hv);
    const int side = mpq_sgn(hu);
    mpq_clears(hu, hv, au, av, t, NULL);
    return side;
}

static int side_of_round(const far_case *c) {
    mpq_t value, square, x;
    mpq_inits(value, square, x, NULL);
    set_value(value, c, 0, c->points[0]);
    int side = mpq_sgn(value);
    for (int k = 0; k < c->dim; k++) {
        mpq_set_d(x, c->normals[0][k]);
        mpq_mul(x, x, x);
        mpq_add(square, square, x);
    }
    mpq_set_d(x, c->radius);
    mpq_mul(x, x, x);
    mpq_mul(square, square, x);
    mpq_mul(value, value, value);
    if (c->radius > 0 && mpq_cmp(value, square) < 0) side = 2;
    mpq_clears(value, square, x, NULL);
    return side;
}

static int side_of_all_corners(const far_case *c, const double *lo, const double *hi) {
    unsigned reached = 0;
    for (unsigned i = 0; i < 1u << c->dim && reached != 3; i++) {
        double x[FROE_MAX_DIM];
        for (int k = 0; k < c->dim; k++) x[k] = i >> k & 1 ? hi[k] : lo[k];
        const int side = side_of_point(c, 0, x);
        if (side) reached |= side > 0 ? 2 : 1;
    }
    return reached == 3 ? 2 : reached == 2 ? 1 : -(int)reached;
}

/* ------------------------------------------------------------------- tests -- */

static unsigned zeros, compared;

static void expect(num_context *context, fuzz_class kind, const char *what, const far_case *c, int expected, int side) {
    if (side != expected)
        fail_msg("%s, class %s, R^%d, stage %d: %d instead of %d", what, fuzz_names[kind], c->dim, (int)context->first,
                 side, expected);
    zeros += side == 0;
    compared++;
}

static void try_case(num_context *context, fuzz_class kind, const far_case *c) {
    const double *u = c->points[0], *v = c->points[1];
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool normal = false;
    for (int k = 0; k < c->dim; k++) {
        lo[k] = fmin(u[k], v[k]), hi[k] = fmax(u[k], v[k]);
        normal = normal || c->normals[0][k] != 0;
    }
    const int vertex = side_of_point(c, 0, u), box = side_of_all_corners(c, lo, hi), ball = side_of_round(c);
    const int at_u = side_of_point(c, 1, u), at_v = side_of_point(c, 1, v);
    const int meeting = at_u != at_v ? side_of_meeting(c) : 0;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++) {
        context->first = (num_stage)stage;
        const geom_plane *h = c->planes;
        expect(context, kind, "valid", c, normal, geom_plane_valid(context, h));
        expect(context, kind, "vertex", c, vertex, geom_side_vertex(context, h, u));
        expect(context, kind, "box", c, box, geom_side_box(context, h, lo, hi));
        if (at_u != at_v) expect(context, kind, "crossing", c, meeting, geom_side_crossing(context, h, u, v, h + 1));
        if (normal) expect(context, kind, "ball", c, ball, geom_side_ball(context, h, u, c->radius));
    }
}

static void sides_are_those_of_rationals(void **state) {
    num_context *context = *state;
    zeros = compared = 0;
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)kind};
        for (int i = 0; i < TRIALS; i++) {
            far_case c;
            draw_case(&r, (fuzz_class)kind, 4 + i % 5, &c);
            try_case(context, (fuzz_class)kind, &c);
        }
    }
    assert_true(zeros > compared / 1000);
    assert_true(context->stats.filtered > compared / 10 && context->stats.refined && context->stats.exact);
}

/* The last place of one coordinate decides, whichever it is. */
static void every_coordinate_counts(void **state) {
    num_context *context = *state;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++)
        for (int dim = 4; dim <= FROE_MAX_DIM; dim++)
            for (int k = 0; k < dim; k++) {
                double normal[FROE_MAX_DIM], x[FROE_MAX_DIM];
                for (int i = 0; i < dim; i++) normal[i] = x[i] = 1;
                context->first = (num_stage)stage;
                const geom_plane h = geom_plane_vector(dim, normal, dim);
                assert_int_equal(geom_side_vertex(context, &h, x), 0);
                x[k] = 1 + 0x1p-52;
                assert_int_equal(geom_side_vertex(context, &h, x), 1);
                /* 2^-52 / sqrt(dim) away */
                assert_int_equal(geom_side_ball(context, &h, x, 0x1p-53), dim > 4 ? 2 : 1);
                x[k] = 1 - 0x1p-53;
                assert_int_equal(geom_side_vertex(context, &h, x), -1);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_are_those_of_rationals),
        cmocka_unit_test(every_coordinate_counts),
    };
    return cmocka_run_group_tests_name("geom/far_planes", tests, context_open, context_close);
}
