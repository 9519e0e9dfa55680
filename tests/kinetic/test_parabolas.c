/* test_parabolas.c: bodies replaced by vertices on parabolas: how far these are off, and the partition that follows
 * them, beside trees from scratch. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/flights.h"
#include "support/memory.h"
#include "support/turning.h"

/* A triangle that belongs to no body. */
static void add_free(froe_motion *m) {
    const double times[] = {-1, 20, 70, 0, 0}, coords[] = {0, 0, 9000, 1, 1, 9000, 2, 0, 9000, 5, 5, 9000, 9, 0, 9000};
    const double controls[] = {NAN, NAN, NAN, 3, 3, 9001, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3, b.count = 1, b.starts = (const size_t[]){0, 3, 4, 5}, b.times = times, b.coords = coords;
    b.controls = controls;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
}

static froe_motion *make_bodies(const flight_kind *f, int count, uint64_t seed) {
    flight_kind kind = *f;
    kind.count = count;
    return flight_new(&kind, seed);
}

/* -------------------------------------------------------------------- how near -- */

/* The greatest distance at many times. */
static double sampled(const froe_motion *m, const froe_motion *n) {
    double most = 0, p[3], q[3];
    for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++)
        for (int i = 0; i <= 4000; i++) {
            const double time = SPACE_WINDOW * (i / 4000.0);
            double square = 0;
            assert_true(froe_motion_position(m, v, time, p) && froe_motion_position(n, v, time, q));
            for (int k = 0; k < 3; k++) square += (p[k] - q[k]) * (p[k] - q[k]);
            most = fmax(most, sqrt(square));
        }
    return most;
}

static size_t knots_of(const froe_motion *m) {
    size_t all = 0;
    for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++) all += froe_motion_knot_count(m, v);
    return all;
}

static void vertices_are_as_near_as_is_told(void **state) {
    (void)state;
    const flight_kind f = {.corners = 4, .faces = 4, .grid = 700};
    enum { ROUNDS = 6 };
    for (uint64_t seed = 1; seed <= ROUNDS; seed++) {
        froe_motion *m = make_bodies(&f, 4, seed);
        size_t before = 0;
        for (double deviation = 1; deviation > 1e-7; deviation /= 1000) {
            froe_motion *n;
            double reached;
            assert_int_equal(froe_motion_without_bodies(m, deviation, NULL, &n, &reached, NULL), FROE_OK);
            const double seen = sampled(m, n);
            assert_true(reached <= deviation);
            assert_true(seen <= reached + 1e-11);       /* what froe_motion_position() rounds */
            assert_true(reached <= 3.5 * seen + 1e-11); /* a bound that says something */
            assert_int_equal(froe_motion_body_count(n), 0);
            const size_t knots = knots_of(n); /* ten times as many for a thousandth */
            if (before) assert_true(knots > 5 * before && knots < 20 * before);
            before = knots;
            froe_motion_free(n);
        }
        froe_motion_free(m);
    }
}

/* As pictures take them. What belongs to no body, parabolas too, stays as it is. */
static void bodies_of_the_plane_are_replaced_as_near_as_is_told(void **state) {
    (void)state;
    for (size_t i = 0; i < TURNING_KINDS; i++) {
        froe_motion *m = turning_new(turning_kinds + i, 4), *n;
        double reached, p[2], q[2], most = 0;
        assert_int_equal(froe_motion_without_bodies(m, 0.5, NULL, &n, &reached, NULL), FROE_OK);
        assert_true(reached <= 0.5 && !froe_motion_body_count(n) && froe_motion_window(n).dim == 2);
        for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++)
            for (int j = 0; j <= 1000; j++) {
                const double time = MOVING_TIME * (j / 1000.0);
                assert_true(froe_motion_position(m, v, time, p) && froe_motion_position(n, v, time, q));
                const double off = hypot(p[0] - q[0], p[1] - q[1]);
                if (froe_motion_vertex_body(m, v) == FROE_NONE) assert_true(off == 0);
                most = fmax(most, off);
            }
        assert_true(most <= reached + 1e-11 && (reached <= 3.5 * most + 1e-11));
        froe_motion_free(n), froe_motion_free(m);
    }
}

static void bodies_that_do_not_turn_stay_in_one_piece(void **state) {
    (void)state;
    const flight_kind f = {.corners = 4, .faces = 4, .grid = 700, .straight = true};
    froe_motion *m = make_bodies(&f, 4, 3), *n;
    double reached;
    assert_int_equal(froe_motion_without_bodies(m, 1e-6, NULL, &n, &reached, NULL), FROE_OK);
    assert_true(reached < 1e-11 && sampled(m, n) < 1e-11);
    for (uint32_t v = 0; v < froe_motion_vertex_count(n); v++) {
        assert_int_equal(froe_motion_knot_count(n, v), FLIGHT_KEYS);
        for (size_t i = 0; i < FLIGHT_KEYS; i++) assert_true(isnan(froe_motion_knot(n, v, i).control[0]));
    }
    froe_motion_free(n);
    froe_motion_free(m);
}

static void all_else_stays_as_it_is(void **state) {
    (void)state;
    const flight_kind f = {.corners = 8, .faces = 12, .grid = 700, .mortal = true};
    froe_motion *m = make_bodies(&f, 6, 5), *n;
    add_free(m);
    assert_int_equal(froe_motion_without_bodies(m, 1e-3, NULL, &n, NULL, NULL), FROE_OK);
    const froe_motion_options w = froe_motion_window(m), own = froe_motion_window(n);
    assert_true(w.begin == own.begin && w.end == own.end && w.tick == own.tick && own.dim == 3);
    assert_int_equal(froe_motion_vertex_count(n), froe_motion_vertex_count(m));
    assert_int_equal(froe_motion_object_count(n), 73);
    assert_int_equal(froe_motion_group_count(n), 6);
    assert_string_equal(froe_motion_group(n, 5).name, "body");
    size_t never = 0;
    for (uint32_t i = 0; i < 73; i++) {
        const froe_moving_object o = froe_motion_object(m, i), p = froe_motion_object(n, i);
        assert_memory_equal(o.vertices, p.vertices, sizeof o.vertices);
        assert_true(o.birth == p.birth && o.death == p.death && o.group == p.group && o.tag == p.tag);
        never += o.birth > o.death;
    }
    assert_true(never > 3);
    for (uint32_t v = 48; v < 51; v++)
        for (size_t i = 0; i < froe_motion_knot_count(m, v); i++) {
            const froe_moving_knot a = froe_motion_knot(m, v, i), b = froe_motion_knot(n, v, i);
            assert_memory_equal(&a, &b, sizeof a);
        }
    froe_motion_free(n);
    froe_motion_free(m);
}

/* Two faces of a body with corners of their own, and another body in the same place. */
static void corners_in_one_place_become_one_vertex(void **state) {
    (void)state;
    const flight_kind f = {.corners = 4, .grid = 700, .straight = true};
    fuzz_source r = {1};
    const int at[3] = {0, 0, 0};
    froe_motion *m = make_bodies(&f, 0, 1), *n;
    const uint32_t body = flight_add(m, &r, &f, at, at), other = flight_add(m, &r, &f, at, at);
    const double zeros[9] = {0};
    const double coords[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t bodies[] = {body, body, body, body, body, body, other, other, other};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 9, b.count = 3, b.starts = (const size_t[]){0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    b.times = zeros, b.coords = coords, b.bodies = bodies;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    assert_int_equal(froe_motion_without_bodies(m, 1e-3, NULL, &n, NULL, NULL), FROE_OK);
    static const uint32_t corners[3][3] = {{0, 1, 2}, {1, 4, 2}, {6, 7, 8}}; /* the third has no area */
    for (uint32_t i = 0; i < 3; i++) {
        const froe_moving_object o = froe_motion_object(n, i);
        assert_memory_equal(o.vertices, corners[i], sizeof corners[i]);
    }
    froe_motion_free(n);
    froe_motion_free(m);
}

/* --------------------------------------------------------------------- refusals -- */

static froe_status replace(void *user, const froe_allocator *alloc) {
    froe_motion *out = NULL;
    const froe_status status = froe_motion_without_bodies(user, 1e-2, alloc, &out, NULL, NULL);
    froe_motion_free(out);
    return status;
}

static void what_cannot_be_replaced_is_refused(void **state) {
    (void)state;
    const flight_kind f = {.corners = 4, .faces = 4, .grid = 700};
    froe_motion *m = make_bodies(&f, 2, 9), *n = NULL;
    froe_diagnostic why;
    const double none[] = {0, -1, (double)NAN, (double)INFINITY};
    for (int i = 0; i < 4; i++)
        assert_int_equal(froe_motion_without_bodies(m, none[i], NULL, &n, NULL, &why), FROE_E_ARG);
    assert_string_equal(why.message, "A deviation of inf is not a number above 0.");
    assert_int_equal(froe_motion_without_bodies(m, 1e-16, NULL, &n, NULL, &why), FROE_E_LIMIT);
    assert_string_equal(why.message,
                        "body 0: Doubles near it, or instants, are too far apart for a deviation of 1e-16.");
    froe_kinetic *k;
    assert_int_equal(froe_kinetic_new(m, &(froe_kinetic_options){.size = sizeof(froe_kinetic_options)}, NULL, &k, &why),
                     FROE_E_UNSUPPORTED);
    assert_null(n);
    test_memory_each(replace, m);
    froe_motion_free(m);
}

/* ----------------------------------------------------------------- in partitions -- */

/* A run of some seconds; bench_space goes on. */
static void bodies_that_turn_are_followed(void **state) {
    (void)state;
    space_counts counts = {0};
    for (uint64_t i = 0; i < FLIGHT_KINDS; i++) {
        froe_diagnostic why = {0};
        double reached;
        counts.blurs = flight_kinds[i].quarters;
        froe_motion *m = flight_on_parabolas(flight_kinds + i, i, &reached);
        froe_kinetic_options o = froe_kinetic_defaults();
        froe_kinetic *k = NULL;
        o.seed = i;
        if (froe_kinetic_new(m, &o, NULL, &k, &why)) fail_msg("%s: %s", flight_kinds[i].name, why.message);
        if (!space_follow(k, 60, &counts, &why)) fail_msg("%s: %s", flight_kinds[i].name, why.message);
        froe_kinetic_free(k);
        froe_motion_free(m);
    }
    assert_true(counts.all > 400 && counts.compared > 200 && counts.blurred < 5);
    assert_true(counts.events[FROE_EVENT_FLOP] > 4 && counts.events[FROE_EVENT_PLAN] > 40);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_as_near_as_is_told),
        cmocka_unit_test(bodies_of_the_plane_are_replaced_as_near_as_is_told),
        cmocka_unit_test(bodies_that_do_not_turn_stay_in_one_piece),
        cmocka_unit_test(all_else_stays_as_it_is),
        cmocka_unit_test(corners_in_one_place_become_one_vertex),
        cmocka_unit_test(what_cannot_be_replaced_is_refused),
        cmocka_unit_test(bodies_that_turn_are_followed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
