/* test_parabolas.c: bodies replaced by vertices on parabolas: how far these are off, and the partition that follows
 * them, beside trees from scratch. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/space.h"
#include "support/memory.h"

enum { BODIES = 12, KEYS = 4, CORNERS = 4, MOST_CORNERS = 8 };

typedef struct flight {
    int corners, faces;
    bool straight; /* it does not turn */
    bool mortal;
} flight;

/* A quaternion of length 1 but for rounding, within some 75 degrees of the one before. */
static void next_turn(fuzz_source *r, const double *before, double q[4]) {
    double square = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = 0.7 * fuzz_unit(r) + (before ? 1.4 * before[k] : k == 3);
        square += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) q[k] /= sqrt(square);
}

/* A body in a ball around a way that is straight, or leads there by parabolas whose control points are on it. */
static uint32_t add_flight(froe_motion *m, fuzz_source *r, const flight *f, const int at[3], const int to[3]) {
    double times[KEYS] = {0, 17.3, 40.1, SPACE_WINDOW}, places[3 * KEYS], controls[3 * KEYS], turns[4 * KEYS];
    for (size_t i = 0; i < KEYS; i++) {
        const double share = times[i] / SPACE_WINDOW, later = i + 1 < KEYS ? times[i + 1] / SPACE_WINDOW : 1;
        for (int k = 0; k < 3; k++) {
            places[3 * i + (size_t)k] = at[k] + share * (to[k] - at[k]);
            controls[3 * i + (size_t)k] = at[k] + (0.4 * share + 0.6 * later) * (to[k] - at[k]);
        }
        next_turn(r, i ? turns + 4 * i - 4 : NULL, turns + 4 * i);
    }
    froe_body body = froe_body_defaults();
    uint32_t id;
    body.count = KEYS, body.times = times, body.coords = places, body.turns = f->straight ? NULL : turns;
    body.controls = fuzz_int(r, 0, 1) && !f->straight ? controls : NULL;
    assert_int_equal(froe_motion_add_body(m, &body, &id, NULL), FROE_OK);
    return id;
}

static void add_faces(froe_motion *m, fuzz_source *r, const flight *f, uint32_t body, int radius) {
    static const uint32_t tetrahedron[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    static const uint32_t box[36] = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    const double zeros[MOST_CORNERS] = {0};
    double at[3 * MOST_CORNERS], births[12], deaths[12];
    uint64_t tags[12];
    size_t starts[MOST_CORNERS + 1];
    uint32_t bodies[MOST_CORNERS];
    for (int c = 0; c < f->corners; c++) {
        starts[c] = (size_t)c, bodies[c] = body;
        for (int k = 0; k < 3; k++) /* boxes reach as far as their ball */
            at[3 * c + k] = f->corners == 8 ? (c >> k & 1 ? 0.57 : -0.57) * radius : 0.57 * radius * fuzz_unit(r);
    }
    starts[f->corners] = (size_t)f->corners;
    for (int i = 0; i < f->faces; i++) {
        births[i] = f->mortal ? fuzz_int(r, -20, 70) : 0;
        deaths[i] = f->mortal ? births[i] + fuzz_int(r, 0, 40) : SPACE_WINDOW;
        tags[i] = 1000 * (uint64_t)body + (uint64_t)i;
    }
    froe_moving b = froe_moving_defaults();
    assert_int_equal(froe_motion_add_group(m, &(froe_group){.name = "body"}, &b.group), FROE_OK);
    b.vertex_count = (size_t)f->corners, b.count = (size_t)f->faces, b.starts = starts, b.times = zeros, b.coords = at;
    b.vertices = f->corners == 8 ? box : tetrahedron, b.bodies = bodies;
    b.births = births, b.deaths = deaths, b.tags = tags;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
}

/* Bodies that keep apart. */
static froe_motion *make_bodies(const flight *f, int count, uint64_t seed) {
    enum { RADIUS = 160, GRID = 700 };
    int ways[BODIES][2][3], made = 0;
    space_data d = {.random = {seed}};
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m;
    w.dim = 3, w.begin = 0, w.end = SPACE_WINDOW, w.tick = 0x1p-16;
    assert_int_equal(froe_motion_new(&w, NULL, &m, NULL), FROE_OK);
    while (made < count) {
        bool apart = true;
        for (int k = 0; k < 3; k++) {
            ways[made][0][k] = fuzz_int(&d.random, 0, GRID);
            ways[made][1][k] = fuzz_int(&d.random, 0, GRID);
        }
        for (int i = 0; i < made; i++) /* in time they may be elsewhere on their ways */
            apart &= space_are_apart(ways[made][0], ways[made][1], ways[i][0], ways[i][1], 2.6 * RADIUS);
        if (!apart) continue;
        const uint32_t body = add_flight(m, &d.random, f, ways[made][0], ways[made][1]);
        add_faces(m, &d.random, f, body, RADIUS);
        made++;
    }
    return m;
}

/* A triangle that belongs to no body. */
static void add_free(froe_motion *m) {
    const double times[] = {-1, 20, 70, 0, 0}, coords[] = {0, 0, 9000, 1, 1, 9000, 2, 0, 9000, 5, 5, 9000, 9, 0, 9000};
    const double controls[] = {NAN, NAN, NAN, 3, 3, 9001, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 3, b.count = 1, b.starts = (const size_t[]){0, 3, 4, 5}, b.times = times, b.coords = coords;
    b.controls = controls;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
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
    const flight f = {4, 4, false, false};
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

static void bodies_that_do_not_turn_stay_in_one_piece(void **state) {
    (void)state;
    const flight f = {4, 4, true, false};
    froe_motion *m = make_bodies(&f, 4, 3), *n;
    double reached;
    assert_int_equal(froe_motion_without_bodies(m, 1e-6, NULL, &n, &reached, NULL), FROE_OK);
    assert_true(reached < 1e-11 && sampled(m, n) < 1e-11);
    for (uint32_t v = 0; v < froe_motion_vertex_count(n); v++) {
        assert_int_equal(froe_motion_knot_count(n, v), KEYS);
        for (size_t i = 0; i < KEYS; i++) assert_true(isnan(froe_motion_knot(n, v, i).control[0]));
    }
    froe_motion_free(n);
    froe_motion_free(m);
}

static void all_else_stays_as_it_is(void **state) {
    (void)state;
    const flight f = {8, 12, false, true};
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
    const flight f = {4, 0, true, false};
    fuzz_source r = {1};
    const int at[3] = {0, 0, 0};
    froe_motion *m = make_bodies(&f, 0, 1), *n;
    const uint32_t body = add_flight(m, &r, &f, at, at), other = add_flight(m, &r, &f, at, at);
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
    const flight f = {4, 4, false, false};
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
    froe_motion *plane;
    froe_motion_options w = froe_motion_defaults();
    w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &plane, NULL), FROE_OK);
    assert_int_equal(froe_motion_without_bodies(plane, 1, NULL, &n, NULL, &why), FROE_E_UNSUPPORTED);
    assert_null(n);
    froe_motion_free(plane);
    test_memory_each(replace, m);
    froe_motion_free(m);
}

/* ----------------------------------------------------------------- in partitions -- */

static void follow_bodies(const flight *f, int count, uint64_t seed, double deviation, uint64_t most,
                          space_counts *counts) {
    froe_diagnostic why = {0};
    froe_motion *m = make_bodies(f, count, seed), *n;
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    double reached;
    o.seed = seed;
    assert_int_equal(froe_motion_without_bodies(m, deviation, NULL, &n, &reached, &why), FROE_OK);
    if (froe_kinetic_new(n, &o, NULL, &k, &why)) fail_msg("seed %d: %s", (int)seed, why.message);
    if (!space_follow(k, most, counts, &why)) fail_msg("seed %d: %s", (int)seed, why.message);
    froe_kinetic_free(k);
    froe_motion_free(n);
    froe_motion_free(m);
}

static void bodies_that_turn_are_followed(void **state) {
    (void)state;
    const flight flights[] = {{4, 4, false, false}, {8, 12, false, false}, {4, 4, false, true}};
    space_counts counts = {0};
    for (int i = 0; i < 3; i++)
        for (uint64_t seed = 1; seed <= 2; seed++) follow_bodies(flights + i, i == 1 ? 3 : 6, seed, 1, 300, &counts);
    assert_true(counts.all > 1000 && counts.compared > 500);
    assert_true(counts.events[FROE_EVENT_FLOP] > 10 && counts.events[FROE_EVENT_PLAN] > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_are_as_near_as_is_told),
        cmocka_unit_test(bodies_that_do_not_turn_stay_in_one_piece),
        cmocka_unit_test(all_else_stays_as_it_is),
        cmocka_unit_test(corners_in_one_place_become_one_vertex),
        cmocka_unit_test(what_cannot_be_replaced_is_refused),
        cmocka_unit_test(bodies_that_turn_are_followed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
