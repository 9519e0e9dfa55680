/* test_apart.c: planes between bodies, against contacts by brute force in rationals. Planes that are found are checked
 * by plain rational arithmetic. */
#include "geom/bodies.h"
#include "geom/meet/apart.h"
#include "support/context.h"
#include <gmp.h>

/* --------------------------------------------------------------- rationals -- */

/* n . x = c */
typedef struct exact_plane {
    int dim;
    mpq_t n[FROE_MAX_DIM + 1]; /* the last is c */
} exact_plane;

static exact_plane plane_of_rows(int dim, const double *rows, int count) {
    exact_plane h = {.dim = dim};
    mpq_t row;
    mpq_init(row);
    for (int k = 0; k <= dim; k++) {
        mpq_init(h.n[k]);
        for (int i = 0; i < count; i++) {
            mpq_set_d(row, rows[i * (dim + 1) + k]);
            mpq_div_2exp(row, row, 53 * (mp_bitcnt_t)i);
            mpq_add(h.n[k], h.n[k], row);
        }
    }
    mpq_clear(row);
    return h;
}

static void clear_plane(exact_plane *h) {
    for (int k = 0; k <= h->dim; k++) mpq_clear(h->n[k]);
}

/* The sign of  n . x - c,  or 2 for a ball that has points on both sides. */
static int side_of(const exact_plane *h, const double *x, double radius) {
    mpq_t sum, term, square;
    mpq_inits(sum, term, square, NULL);
    mpq_neg(sum, h->n[h->dim]);
    for (int k = 0; k < h->dim; k++) {
        mpq_mul(term, h->n[k], h->n[k]);
        mpq_add(square, square, term);
        mpq_set_d(term, x[k]);
        mpq_mul(term, term, h->n[k]);
        mpq_add(sum, sum, term);
    }
    int side = mpq_sgn(sum);
    mpq_set_d(term, radius);
    mpq_mul(term, term, term);
    mpq_mul(square, square, term);
    mpq_mul(sum, sum, sum);
    if (radius > 0 && mpq_cmp(sum, square) < 0) side = 2;
    mpq_clears(sum, term, square, NULL);
    return side;
}

/* The body lies where side * (n . x - c) >= 0, and not wholly in the plane. */
static bool lies_on(const geom_body *b, const exact_plane *h, int side) {
    bool beside = false;
    for (uint32_t i = 0; i < geom_body_corners(b); i++) {
        double corner[FROE_MAX_DIM];
        for (int k = 0; k < b->dim; k++) corner[k] = geom_body_point(b, b->form == FROE_BOX ? i >> k & 1 : i)[k];
        const int found = side_of(h, corner, b->form == FROE_BALL ? b->radius : 0);
        if (found != side && found != 0) return false;
        beside = beside || found == side;
    }
    return beside;
}

/* Is the plane that is found between the two? Its number of rows, which may be 0. */
static int check_plane(num_context *context, const geom_body *a, const geom_body *b, const char *what) {
    static double rows[GEOM_APART_NUMBERS];
    const int count = geom_apart(context, a, b, rows);
    if (!count) return 0;
    exact_plane h = plane_of_rows(a->dim, rows, count);
    if (!lies_on(a, &h, -1) || !lies_on(b, &h, 1))
        fail_msg("%s: %s and %s in R^%d: no plane between them", what, froe_kind_name(a->form), froe_kind_name(b->form),
                 a->dim);
    clear_plane(&h);
    return count;
}

/* ------------------------------------------------------------- nasty bodies -- */

typedef struct tallies {
    unsigned found, fine, meeting;
} tallies;

static void check_case(num_context *context, fuzz_class kind, const bodies_case *c, tallies *counts) {
    const geom_body *a = &c->body[0], *b = &c->body[1];
    const size_t mark = exact_mark();
    const exact_body x = exact_body_of(a), y = exact_body_of(b);
    bool corner;
    const bool meeting = exact_contact(&x, &y, &corner) != 0;
    exact_release(mark);
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        context->first = first;
        const int rows = check_plane(context, a, b, fuzz_names[kind]);
        if (!rows && !meeting)
            fail_msg("%s: %s and %s in R^%d, stage %d: no plane", fuzz_names[kind], froe_kind_name(a->form),
                     froe_kind_name(b->form), a->dim, (int)first);
        counts->found += rows > 0;
        counts->fine += rows > 1;
    }
    counts->meeting += meeting;
}

static void planes_are_between_nasty_bodies(void **state) {
    fuzz_source r = {7};
    tallies counts = {0};
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        for (int i = 0; i < bodies_trials((fuzz_class)kind, 600); i++) {
            bodies_case c;
            bodies_draw(&r, (fuzz_class)kind, 2 + i % 2, &c);
            check_case(*state, (fuzz_class)kind, &c, &counts);
        }
        for (int i = 0; i < bodies_trials((fuzz_class)kind, 120); i++) {
            bodies_case c;
            bodies_draw(&r, (fuzz_class)kind, 4 + i % 5, &c);
            check_case(*state, (fuzz_class)kind, &c, &counts);
        }
    }
    print_message("  %u planes, %u of more than one row, %u that meet\n", counts.found, counts.fine, counts.meeting);
    assert_true(counts.found > 12000 / BODIES_SHARE && counts.meeting > 3600 / BODIES_SHARE);
    assert_true(counts.fine);
}

/* A ball of radius r around 0, and the point (r, 1, 0 ...): 2^-105 r apart at r = 2^52. */
static void a_gap_that_no_doubles_hold_takes_rows(void **state) {
    num_context *context = *state;
    for (int dim = 2; dim <= FROE_MAX_DIM; dim++)
        for (int power = -900; power <= 900; power += 50) {
            const double r = ldexp(1, power), centre[FROE_MAX_DIM] = {0},
                         point[FROE_MAX_DIM] = {r, ldexp(1, power - 52)};
            const geom_body at = geom_body_at(dim, point);
            geom_body ball = geom_body_at(dim, centre);
            ball.form = FROE_BALL;
            ball.radius = r;
            context->first = NUM_FILTER;
            assert_true(check_plane(context, &ball, &at, "tangent") > 1);
            assert_true(check_plane(context, &at, &ball, "tangent") > 1);
            ball.radius = nextafter(r, INFINITY);
            assert_int_equal(check_plane(context, &ball, &at, "meeting"), 0);
            ball.radius = nextafter(r, 0);
            assert_true(check_plane(context, &ball, &at, "near"));
        }
}

/* The point 2^-p on the first axis lies 2^(-3 p - 2 q) above the triangle of 0, (2^q, -2^-p) and 2^q, 2^-p on the next
 * axes: its nearest point is inside. The last of the rows ends at about 2^-4200 of the normal. */
static void a_gap_that_no_rows_hold_has_no_plane(void **state) {
    static const int powers[][2] = {{300, 300}, {900, 600}, {1000, 700}, {1074, 1023}, {1074, 1020}};
    num_context *context = *state;
    unsigned found = 0, none = 0;
    for (size_t i = 0; i < sizeof powers / sizeof *powers; i++)
        for (int swap = 0; swap < 2; swap++) {
            const double small = ldexp(1, -powers[i][0]), large = ldexp(1, powers[i][1]);
            const double at[3] = {small}, corners[9] = {0, 0, 0, large, -small, 0, 0, large, small};
            const geom_body point = geom_body_at(3, at);
            const geom_body triangle = {.form = FROE_POLYGON, .dim = 3, .count = 3, .coords = corners};
            bool corner;
            const size_t mark = exact_mark();
            const exact_body x = exact_body_of(&point), y = exact_body_of(&triangle);
            assert_int_equal(exact_contact(&x, &y, &corner), 0); /* they do not meet */
            exact_release(mark);
            context->first = NUM_FILTER;
            const int rows =
                check_plane(context, swap ? &triangle : &point, swap ? &point : &triangle, "far below doubles");
            assert_int_equal(rows > 0, 3 * powers[i][0] + 2 * powers[i][1] < 4200);
            found += rows > 0, none += !rows;
        }
    assert_true(found && none);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_between_nasty_bodies),
        cmocka_unit_test(a_gap_that_no_doubles_hold_takes_rows),
        cmocka_unit_test(a_gap_that_no_rows_hold_has_no_plane),
    };
    return cmocka_run_group_tests_name("geom/apart", tests, context_open, context_close);
}
