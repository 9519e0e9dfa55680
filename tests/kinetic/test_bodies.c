/* test_bodies.c: rigid bodies in motion: where their vertices are, against rationals, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/motion/motion.h"
#include "oracle/touching.h"
#include "support/fuzz.h"
#include "support/memory.h"
#include <float.h>

enum { BODIES = 12, KEYS = 4, CORNERS = 3 };

static froe_motion *empty_motion(void) {
    froe_motion_options o = froe_motion_defaults();
    froe_motion *m = NULL;
    o.dim = 3, o.begin = 0, o.end = 8;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_OK);
    return m;
}

/* A quaternion of length 1, but for rounding. */
static void random_turn(fuzz_source *r, double q[4]) {
    double square = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = fuzz_unit(r);
        square += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) q[k] /= sqrt(square);
}

/* Bodies along straight lines and parabolas, each with a triangle. */
static froe_motion *random_bodies(fuzz_source *r, fuzz_class kind) {
    froe_motion *m = empty_motion();
    double at[3 * CORNERS * BODIES];
    size_t starts[CORNERS * BODIES + 1];
    uint32_t bodies[CORNERS * BODIES];
    static const double zeros[CORNERS * BODIES];
    for (uint32_t i = 0; i < BODIES; i++) {
        double times[KEYS] = {0, 1 + 2 * fabs(fuzz_unit(r)), 4 + fuzz_unit(r), 8}, places[3 * KEYS], controls[3 * KEYS];
        double turns[4 * KEYS];
        froe_body body = froe_body_defaults();
        for (int k = 0; k < KEYS; k++) random_turn(r, turns + 4 * k);
        fuzz_points(r, kind, 3, places, KEYS);
        fuzz_points(r, kind, 3, controls, KEYS);
        body.count = KEYS, body.times = times, body.coords = places, body.turns = turns;
        body.controls = i % 2 ? controls : NULL;
        uint32_t id;
        assert_int_equal(froe_motion_add_body(m, &body, &id, NULL), FROE_OK);
        assert_int_equal(id, i);
    }
    fuzz_points(r, kind, 3, at, (size_t)CORNERS * BODIES);
    for (uint32_t v = 0; v <= CORNERS * BODIES; v++) starts[v] = v;
    for (uint32_t v = 0; v < CORNERS * BODIES; v++) bodies[v] = v / CORNERS;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = (size_t)CORNERS * BODIES, b.count = BODIES, b.starts = starts, b.times = zeros, b.coords = at;
    b.bodies = bodies;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    return m;
}

static int compare(const mpq_t q, double x) {
    return oracle_compare_time(q, x);
}

/* Between two times of one piece, at several rational instants. */
static void check_box(const froe_motion *m, uint32_t vertex, double from, double to) {
    const motion_piece piece = motion_piece_at_time(m, vertex, from);
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    motion_extend(m, &piece, from, to, m->dim, lo, hi);
    mpq_t a, b, at[3];
    mpq_inits(a, b, at[0], at[1], at[2], NULL);
    for (int i = 0; i <= 8; i++) {
        mpq_set_d(a, from);
        mpq_set_d(b, to);
        mpq_sub(b, b, a);
        mpq_set_si(at[0], i, 8);
        mpq_canonicalize(at[0]);
        mpq_mul(b, b, at[0]);
        mpq_add(a, a, b);
        oracle_corner(m, vertex, a, at);
        for (int k = 0; k < 3; k++) { /* boxes end with the doubles */
            assert_true(compare(at[k], lo[k]) >= 0 || lo[k] == -DBL_MAX);
            assert_true(compare(at[k], hi[k]) <= 0 || hi[k] == DBL_MAX);
        }
    }
    mpq_clears(a, b, at[0], at[1], at[2], NULL);
}

static void check_position(const froe_motion *m, uint32_t vertex, double time) {
    double near[3];
    mpq_t t, at[3];
    mpq_inits(t, at[0], at[1], at[2], NULL);
    mpq_set_d(t, time);
    oracle_corner(m, vertex, t, at);
    assert_true(froe_motion_position(m, vertex, time, near));
    for (int k = 0; k < 3; k++) assert_true(fabs(mpq_get_d(at[k]) - near[k]) <= 1e-13 * (10 + fabs(near[k])));
    mpq_clears(t, at[0], at[1], at[2], NULL);
}

static void places_of_bodies_are_those_of_rationals(void **state) {
    (void)state;
    fuzz_source r = {4};
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        froe_motion *m = random_bodies(&r, (fuzz_class)kind);
        assert_int_equal(froe_motion_body_count(m), BODIES);
        for (uint32_t v = 0; v < CORNERS * BODIES; v++) {
            const uint32_t body = froe_motion_vertex_body(m, v);
            assert_int_equal(body, v / CORNERS);
            for (size_t k = 0; k + 1 < KEYS; k++) {
                const double from = froe_motion_body_knot(m, body, k).time;
                const double to = froe_motion_body_knot(m, body, k + 1).time, part = 0.25 * (to - from);
                check_box(m, v, from, to);
                check_box(m, v, from + part, from + 2 * part);
                if (kind == FUZZ_RANDOM || kind == FUZZ_LATTICE) check_position(m, v, from + part);
            }
            double at[3];
            assert_false(froe_motion_position(m, v, 8.5, at));
        }
        froe_motion_free(m);
    }
}

/* ------------------------------------------------------------------ refusals -- */

static void assert_refused(froe_motion *m, const froe_body *body, froe_status status, const char *message) {
    froe_diagnostic diag;
    const size_t knots = m->knots.count, turns = m->turns.count, bodies = m->bodies.count;
    assert_int_equal(froe_motion_add_body(m, body, NULL, &diag), status);
    assert_string_equal(diag.message, message);
    assert_true(m->knots.count == knots && m->turns.count == turns && m->bodies.count == bodies);
}

static void bad_bodies_are_refused_by_name(void **state) {
    (void)state;
    froe_motion *m = empty_motion();
    const double times[] = {0, 8}, at[] = {0, 0, 0, 1, 1, 1}, turns[] = {0, 0, 0, 1, 0.6, 0, 0, 0.8};
    froe_body good = froe_body_defaults(), b;
    good.count = 2, good.times = times, good.coords = at, good.turns = turns;
    assert_int_equal(froe_motion_add_body(m, &good, NULL, NULL), FROE_OK);
    b = good, b.turns = (const double[]){0, 0, 0, 1, 0, 0, 0, 0};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: The quaternion of turn 1, 0 0 0 0, has not the length 1.");
    b = good, b.turns = (const double[]){0, 0, 0, 1.001, 0, 0, 0, 1};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: The quaternion of turn 0, 0 0 0 1.001, has not the length 1.");
    b = good, b.turns = (const double[]){0, NAN, 0, 1, 0, 0, 0, 1};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: Its y of turn 0 is nan, not a finite number.");
    b = good, b.turns = (const double[]){0, 0, 0, 1, 1, 0, 0, 0x1p-21};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: Turns 0 and 1 are half a turn apart, which does not tell the way.");
    b = good, b.times = (const double[]){8, 8};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: Time 1, 8, is not after time 0, 8.");
    b = good, b.coords = (const double[]){0, 0, 0, 1, 1, INFINITY};
    assert_refused(m, &b, FROE_E_INPUT, "body 1: Its z 1 is inf, not a finite number.");
    b = good, b.count = 0;
    assert_refused(m, &b, FROE_E_INPUT, "body 1: It has no flight plan.");
    b = good, b.size = 0;
    assert_refused(m, &b, FROE_E_OPTIONS, "The options do not come from froe_body_defaults().");
    /* rounded to 24 bits, and the other of q and -q */
    b = good, b.turns = (const double[]){0, 0, 0, 1, -0.6f, 0, 0, -0.8f};
    assert_int_equal(froe_motion_add_body(m, &b, NULL, NULL), FROE_OK);
    assert_true(froe_motion_body_knot(m, 1, 1).turn[3] == 0.8f);
    froe_motion_free(m);
}

static void bad_vertices_of_bodies_are_refused(void **state) {
    (void)state;
    froe_motion *m = empty_motion();
    const double times[] = {0, 0, 0}, at[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, keys[] = {0, 7};
    froe_body body = froe_body_defaults();
    body.count = 2, body.times = keys, body.coords = at;
    for (int i = 0; i < 2; i++) assert_int_equal(froe_motion_add_body(m, &body, NULL, NULL), FROE_OK);
    froe_moving good = froe_moving_defaults(), b;
    good.vertex_count = 3, good.count = 1, good.times = times, good.coords = at;
    good.starts = (const size_t[]){0, 1, 2, 3};
    froe_diagnostic diag;
    b = good, b.bodies = (const uint32_t[]){0, 2, 0};
    assert_int_equal(froe_motion_add(m, &b, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "vertex 1: There is no body 2.");
    b = good, b.bodies = (const uint32_t[]){0, 1, 0}, b.deaths = (const double[]){7};
    assert_int_equal(froe_motion_add(m, &b, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "triangle 0: Its corners do not belong to the same body.");
    b = good, b.bodies = (const uint32_t[]){0, 0, 0}, b.count = 0, b.starts = (const size_t[]){0, 2, 3, 3};
    b.times = (const double[]){0, 8, 0};
    assert_int_equal(froe_motion_add(m, &b, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "vertex 0: It belongs to body 0, and has a plan of its own.");
    b = good, b.bodies = (const uint32_t[]){0, 0, 0};
    assert_int_equal(froe_motion_add(m, &b, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "triangle 0: The plan of its vertex 0 ends at 7, before the triangle's time in "
                                      "the window does, at 8.");
    b.deaths = (const double[]){7};
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_of_bodies_are_those_of_rationals),
        cmocka_unit_test(bad_bodies_are_refused_by_name),
        cmocka_unit_test(bad_vertices_of_bodies_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
