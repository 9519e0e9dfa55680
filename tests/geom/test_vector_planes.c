/* test_vector_planes.c: predicates of planes n . x = c, of one row of doubles or more, started at every stage, against
 * exact rationals (GMP) straight from the definition. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/predicates.h"
#include "support/context.h"
#include "support/fuzz.h"
#include <gmp.h>

enum { TRIALS = 400, PLANES = 2, POINTS = 2, ROWS = 3, WIDTH = FROE_MAX_DIM + 1 };

/* Planes h and a; points u and v, which are corners of a box, too. */
typedef struct vector_case {
    int dim;
    int row_count[PLANES];
    double rows[PLANES][ROWS * WIDTH], points[POINTS][FROE_MAX_DIM], radius;
    geom_plane planes[PLANES];
} vector_case;

static void draw_case(fuzz_source *r, fuzz_class kind, int dim, vector_case *c) {
    *c = (vector_case){.dim = dim, .radius = fabs(fuzz_coordinate(r, kind))};
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < dim; k++) c->points[i][k] = fuzz_coordinate(r, kind);
    for (int i = 0; i < PLANES; i++) {
        const double *x = c->points[fuzz_int(r, 0, POINTS - 1)];
        double *row = c->rows[i], through = 0;
        c->row_count[i] = fuzz_int(r, 0, 1) ? 1 : fuzz_int(r, 1, ROWS);
        for (int k = 0; k < c->row_count[i] * (dim + 1); k++) row[k] = fuzz_coordinate(r, kind);
        /* mostly one of the points is on it, up to rounding */
        for (int k = 0; k < dim; k++) through += row[k] * x[k];
        if (fuzz_int(r, 0, 2) && isfinite(through)) row[dim] = through;
        c->planes[i] =
            c->row_count[i] > 1 ? geom_plane_fine(dim, row, c->row_count[i]) : geom_plane_vector(dim, row, row[dim]);
    }
}

/* ------------------------------------------------------------------ oracle -- */

/* Coefficient k: of the normal, or the value (k = dim). */
static void set_coefficient(mpq_t out, const vector_case *c, int plane, int k) {
    mpq_t row;
    mpq_init(row);
    mpq_set_ui(out, 0, 1);
    for (int i = 0; i < c->row_count[plane]; i++) {
        mpq_set_d(row, c->rows[plane][i * (c->dim + 1) + k]);
        mpq_div_2exp(row, row, 53 * (mp_bitcnt_t)i);
        mpq_add(out, out, row);
    }
    mpq_clear(row);
}

/* n . x - c */
static void set_value(mpq_t out, const vector_case *c, int plane, const double *x) {
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    set_coefficient(out, c, plane, c->dim);
    mpq_neg(out, out);
    for (int k = 0; k < c->dim; k++) {
        set_coefficient(a, c, plane, k);
        mpq_set_d(b, x[k]);
        mpq_mul(a, a, b);
        mpq_add(out, out, a);
    }
    mpq_clears(a, b, NULL);
}

static int side_of_point(const vector_case *c, int plane, const double *x) {
    mpq_t value;
    mpq_init(value);
    set_value(value, c, plane, x);
    const int side = mpq_sgn(value);
    mpq_clear(value);
    return side;
}

/* At u + t (v - u) with a(u) + t (a(v) - a(u)) = 0 the plane h has the value h(u) + t (h(v) - h(u)). */
static int side_of_meeting(const vector_case *c) {
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

static int side_of_round(const vector_case *c) {
    mpq_t value, square, x;
    mpq_inits(value, square, x, NULL);
    set_value(value, c, 0, c->points[0]);
    int side = mpq_sgn(value);
    for (int k = 0; k < c->dim; k++) {
        set_coefficient(x, c, 0, k);
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

static int side_of_all_corners(const vector_case *c, const double *lo, const double *hi) {
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

static void expect(num_context *context, fuzz_class kind, const char *what, const vector_case *c, int expected,
                   int side) {
    if (side != expected)
        fail_msg("%s, class %s, R^%d, stage %d: %d instead of %d", what, fuzz_names[kind], c->dim, (int)context->first,
                 side, expected);
    zeros += side == 0;
    compared++;
}

static void try_case(num_context *context, fuzz_class kind, const vector_case *c) {
    const double *u = c->points[0], *v = c->points[1];
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool normal = false;
    for (int k = 0; k < c->dim; k++) {
        lo[k] = fmin(u[k], v[k]), hi[k] = fmax(u[k], v[k]);
        mpq_t coefficient;
        mpq_init(coefficient);
        set_coefficient(coefficient, c, 0, k);
        normal = normal || mpq_sgn(coefficient);
        mpq_clear(coefficient);
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
            vector_case c;
            draw_case(&r, (fuzz_class)kind, 2 + i % 7, &c);
            try_case(context, (fuzz_class)kind, &c);
        }
    }
    assert_true(zeros > compared / 1000);
    assert_true(context->stats.filtered > compared / 10 && context->stats.refined && context->stats.exact);
}

/* Points that no doubles tell from a plane lie beside it, as the second row says. */
static void rows_are_finer_than_doubles(void **state) {
    num_context *context = *state;
    for (int stage = NUM_FILTER; stage <= NUM_EXACT; stage++)
        for (int dim = 2; dim <= FROE_MAX_DIM; dim++)
            for (int k = 0; k <= dim; k++) {
                double rows[2 * WIDTH] = {0}, x[FROE_MAX_DIM];
                for (int i = 0; i < dim; i++) rows[i] = x[i] = 1;
                rows[dim] = dim;
                rows[dim + 1 + k] = 0x1p-52;
                const geom_plane h = geom_plane_fine(dim, rows, 2);
                context->first = (num_stage)stage;
                assert_int_equal(geom_side_vertex(context, &h, x), k < dim ? 1 : -1);
                rows[dim + 1 + k] = 0;
                assert_int_equal(geom_side_vertex(context, &h, x), 0);
            }
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
        cmocka_unit_test(rows_are_finer_than_doubles),
        cmocka_unit_test(every_coordinate_counts),
    };
    return cmocka_run_group_tests_name("geom/vector_planes", tests, context_open, context_close);
}
