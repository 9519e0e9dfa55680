/* test_walls.c: laws V5, X5 and C5 of geom/predicates.h: sides of and on sheared walls, started at every stage, against
 * exact rationals in which the infinitesimal is a number, 2^-65536 (support/rational.h). */
#include "geom/walls.h"
#include "support/sanitized.h"

enum { SHARE = SANITIZED_SHARE(8) };

typedef struct fixture {
    num_context context;
    sides_oracle oracle;
    sides_tally tally;
    sides_case c;
} fixture;

typedef void trial_fn(fixture *f, fuzz_class kind);

static void run_trials(fixture *f, int dim, int trials, trial_fn *fn) {
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(kind * 1000 + dim + 500)};
        for (int i = 0; i < trials / SHARE; i++) {
            walls_draw(&r, (fuzz_class)kind, dim, &f->c);
            sides_oracle_set(&f->oracle, &f->c, SIDES_PLANES);
            fn(f, (fuzz_class)kind);
        }
    }
    assert_true(f->tally.compared > (uint64_t)(trials * FUZZ_CLASSES / SHARE) / 4);
}

static void try_vertex(fixture *f, fuzz_class kind) {
    int expected = rational_side(&f->oracle.planes[0], &f->oracle.u);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_vertex(&f->context, &f->c.planes[0], f->c.u));
}

/* Within one unit in the last place; the oracle is an infinitesimal beside the limit. */
static void assert_rounded(rational_point *x, const double *out) {
    mpq_t error, gap;
    mpq_init(error);
    mpq_init(gap);
    for (int k = 0; k < x->dim; k++) {
        if (isinf(out[k])) continue;
        rational_coordinate(error, x, k);
        mpq_set_d(gap, out[k]);
        mpq_sub(error, error, gap);
        mpq_abs(error, error);
        mpq_set_d(gap, fabs(out[k]) < 0x1p1000 ? nextafter(fabs(out[k]), INFINITY) - fabs(out[k]) : 0x1p971);
        assert_true(mpq_cmp(error, gap) <= 0);
    }
    mpq_clear(error);
    mpq_clear(gap);
}

/* Planes that meet at infinity when they are not sheared have no corner to round. */
static bool is_near(rational_point *x) {
    mpq_t at, far;
    mpq_init(at);
    mpq_init(far);
    mpq_set_ui(far, 1, 1);
    mpq_mul_2exp(far, far, RATIONAL_EPS_BITS / 2);
    bool near = true;
    for (int k = 0; k < x->dim; k++) {
        rational_coordinate(at, x, k);
        mpq_abs(at, at);
        near = near && mpq_cmp(at, far) < 0;
    }
    mpq_clear(at);
    mpq_clear(far);
    return near;
}

static void try_crossing(fixture *f, fuzz_class kind) {
    sides_oracle *o = &f->oracle;
    const geom_plane *h = &f->c.planes[0], *a = &f->c.planes[1];
    double out[3];
    int at_u = rational_side(&o->planes[1], &o->u), at_v = rational_side(&o->planes[1], &o->v);
    if (at_u * at_v > 0 || (at_u == 0 && at_v == 0) || !rational_meet(&o->x, &o->planes[1], &o->u, &o->v)) return;
    int expected = rational_side(&o->planes[0], &o->x);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_crossing(&f->context, h, f->c.u, f->c.v, a));
    geom_round_crossing(&f->context, f->c.u, f->c.v, a, out);
    assert_rounded(&o->x, out);
    double error = geom_image_crossing(f->c.u, f->c.v, a, out);
    int sure = geom_side_image(h, out, error);
    assert_true(sure == NUM_UNSURE || sure == expected);
}

static void try_corner(fixture *f, fuzz_class kind) {
    sides_oracle *o = &f->oracle;
    const geom_plane *p = f->c.planes;
    double out[3];
    if (!rational_corner(&o->x, &o->planes[1], &o->planes[2], &o->planes[3])) return;
    int expected = rational_side(&o->planes[0], &o->x);
    SIDES_CHECK(&f->context, &f->tally, expected, kind, geom_side_corner(&f->context, p, p + 1, p + 2, p + 3));
    if (is_near(&o->x)) {
        geom_round_corner(&f->context, p + 1, p + 2, p + 3, out);
        assert_rounded(&o->x, out);
    }
    double error = geom_image_corner(p + 1, p + 2, p + 3, out);
    int sure = geom_side_image(p, out, error);
    assert_true(sure == NUM_UNSURE || sure == expected);
}

/* A wall that a ball only touches counts as cutting it. */
static void try_ball(fixture *f, fuzz_class kind) {
    const double radius = f->c.radius;
    f->context.first = NUM_EXACT;
    if (!geom_plane_valid(&f->context, &f->c.planes[0])) return;
    int expected = rational_side_ball(&f->oracle.planes[0], &f->oracle.u, radius);
    int exact = geom_side_ball(&f->context, &f->c.planes[0], f->c.u, radius);
    assert_true(exact == expected || exact == 2);
    assert_true(expected != 2 || exact == 2);
    SIDES_CHECK(&f->context, &f->tally, exact, kind, geom_side_ball(&f->context, &f->c.planes[0], f->c.u, radius));
}

static void sides_of_vertices_beside_walls(void **state) {
    run_trials(*state, 2, 300, try_vertex);
    run_trials(*state, 3, 200, try_vertex);
}
static void sides_of_crossings_with_walls_in_the_plane(void **state) {
    run_trials(*state, 2, 250, try_crossing);
}
static void sides_of_crossings_with_walls_in_space(void **state) {
    run_trials(*state, 3, 250, try_crossing);
}
static void sides_of_corners_with_walls(void **state) {
    run_trials(*state, 3, 150, try_corner);
}
static void sides_of_balls_beside_walls(void **state) {
    run_trials(*state, 2, 120, try_ball);
    run_trials(*state, 3, 120, try_ball);
}

static void walls_need_lines_that_cross_as_they_must(void **state) {
    fixture *f = *state;
    const double p[4][2] = {{0, 0}, {4, 0}, {1, -1}, {2, 5}};
    const double *up[4] = {p[0], p[1], p[2], p[3]}, *down[4] = {p[0], p[1], p[3], p[2]};
    const double *flat[4] = {p[0], p[1], p[1], p[0]};
    geom_plane wall = geom_plane_at_crossing(2, up);
    assert_true(geom_plane_valid(&f->context, &wall));
    wall = geom_plane_at_crossing(2, down);
    assert_false(geom_plane_valid(&f->context, &wall));
    wall = geom_plane_at_crossing(2, flat);
    assert_false(geom_plane_valid(&f->context, &wall));
}

static int setup(void **state) {
    static fixture f;
    memset(&f.tally, 0, sizeof f.tally);
    sides_oracle_init(&f.oracle);
    *state = &f;
    return num_context_new(NULL, &f.context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    assert_true(f->context.arena.high <= f->context.arena.capacity / 2); /* far from the bound */
    sides_oracle_clear(&f->oracle);
    num_context_free(&f->context);
    return 0;
}

int main(void) {
#define TRIAL(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TRIAL(sides_of_vertices_beside_walls),
        TRIAL(sides_of_crossings_with_walls_in_the_plane),
        TRIAL(sides_of_crossings_with_walls_in_space),
        TRIAL(sides_of_corners_with_walls),
        TRIAL(sides_of_balls_beside_walls),
        TRIAL(walls_need_lines_that_cross_as_they_must),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
