/* test_motion.c: flight plans: where vertices are, against rational numbers; and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/motion/motion.h"
#include "support/fuzz.h"
#include "support/memory.h"
#include "support/rational.h"
#include <string.h>

static froe_motion *motion_in(unsigned dim, double begin, double end, double tick) {
    froe_motion_options o = froe_motion_defaults();
    o.dim = dim;
    o.begin = begin;
    o.end = end;
    o.tick = tick;
    froe_motion *m = NULL;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_OK);
    return m;
}

static froe_motion *motion_over(double begin, double end, double tick) {
    return motion_in(2, begin, end, tick);
}

/* ----------------------------------------------------------------- rationals -- */

static void set_whole(mpq_t out, num_short x) {
    unsigned __int128 size = (unsigned __int128)(x < 0 ? -x : x);
    uint64_t limbs[2] = {(uint64_t)size, (uint64_t)(size >> 64)};
    mpz_import(mpq_numref(out), 2, -1, 8, 0, 0, limbs);
    mpz_set_ui(mpq_denref(out), 1);
    if (x < 0) mpq_neg(out, out);
}

static void set_dyadic(mpq_t out, num_dyadic a) {
    mpz_import(mpq_numref(out), a.count, -1, 8, 0, 0, a.limbs);
    mpz_set_ui(mpq_denref(out), 1);
    if (a.exponent >= 0)
        mpq_mul_2exp(out, out, 64 * (mp_bitcnt_t)a.exponent);
    else
        mpq_div_2exp(out, out, 64 * (mp_bitcnt_t)-a.exponent);
    if (a.sign < 0) mpq_neg(out, out);
}

static void scale(mpq_t x, int power) {
    if (power >= 0)
        mpq_mul_2exp(x, x, (mp_bitcnt_t)power);
    else
        mpq_div_2exp(x, x, (mp_bitcnt_t)-power);
}

/* begin + u 2^power */
static void time_of(mpq_t out, const froe_motion *m, int64_t tick) {
    mpq_t begin;
    mpq_init(begin);
    mpq_set_d(begin, m->begin);
    mpq_set_si(out, tick, 1);
    scale(out, m->power);
    mpq_add(out, out, begin);
    mpq_clear(begin);
}

static int compare_time(const mpq_t time, double x) {
    mpq_t q;
    mpq_init(q);
    mpq_set_d(q, x);
    int order = mpq_cmp(time, q);
    mpq_clear(q);
    return order;
}

/* The definition in froe/kinetic.h, for the piece between two knots; `degree` may be 0. */
static void expected(mpq_t out, const motion_piece *piece, const mpq_t time, int k) {
    mpq_t p, q, c, a, b, w;
    mpq_inits(p, q, c, a, b, w, NULL);
    mpq_set_d(p, piece->from->at[k]);
    mpq_set(out, p);
    if (piece->degree) {
        mpq_set_d(q, piece->to->at[k]);
        mpq_set_d(a, piece->to->time);
        mpq_sub(a, a, time);
        mpq_set_d(b, piece->from->time);
        mpq_sub(b, time, b);
        mpq_add(w, a, b);
        mpq_div(a, a, w);
        mpq_div(b, b, w);
        for (int n = 0; n < piece->degree; n++) mpq_mul(p, p, a), mpq_mul(q, q, b);
        mpq_add(out, p, q);
        for (int i = 1; i < piece->degree; i++) { /* twice one control point, or three times two */
            mpq_set_d(c, i == 1 ? piece->from->control[k] : piece->second[k]);
            for (int n = 0; n < piece->degree; n++) mpq_mul(c, c, n < i ? b : a);
            for (int n = 0; n < piece->degree; n++) mpq_add(out, out, c);
        }
    }
    mpq_clears(p, q, c, a, b, w, NULL);
}

static void assert_within(double x, double error, const mpq_t truth) {
    mpq_t a, e;
    mpq_inits(a, e, NULL);
    if (isfinite(error)) {
        mpq_set_d(a, x);
        mpq_set_d(e, error);
        mpq_sub(a, a, truth);
        mpq_abs(a, a);
        assert_true(mpq_cmp(a, e) <= 0);
    }
    mpq_clears(a, e, NULL);
}

/* ------------------------------------------------------------- random motions -- */

enum { KNOTS = 5, MOST_VERTICES = 6 };

static int by_value(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Adds a vertex whose plan covers the window; false if the random times were too few. */
static bool add_random(fuzz_source *r, fuzz_class kind, froe_motion *m, int degree) {
    double times[KNOTS + 2], at[3 * (KNOTS + 2)], controls[3 * (KNOTS + 2)], seconds[3 * (KNOTS + 2)];
    const size_t dim = (size_t)m->dim;
    size_t starts[2] = {0, 0};
    for (int i = 0; i < KNOTS; i++) {
        double share = (double)fuzz_int(r, 0, 1000) / (fuzz_int(r, 0, 1) ? 1000 : 1024);
        times[i] = m->begin + share * (m->end - m->begin);
    }
    times[KNOTS] = m->begin - fuzz_int(r, 0, 1);
    times[KNOTS + 1] = m->end + fuzz_int(r, 0, 1);
    qsort(times, KNOTS + 2, sizeof *times, by_value);
    for (int i = 0; i < KNOTS + 2; i++)
        if (!starts[1] || times[i] > times[starts[1] - 1]) times[starts[1]++] = times[i];
    fuzz_points(r, kind, m->dim, at, starts[1]);
    fuzz_points(r, kind, m->dim, controls, starts[1]);
    fuzz_points(r, kind, m->dim, seconds, starts[1]);
    for (size_t i = 0; i < starts[1]; i++) {
        const bool straight = degree < 2 || fuzz_int(r, 0, 2) == 0, cubic = !straight && fuzz_int(r, 0, 2);
        for (size_t k = 0; k < dim && straight; k++) controls[dim * i + k] = NAN;
        for (size_t k = 0; k < dim && !cubic; k++) seconds[dim * i + k] = NAN;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 1;
    b.starts = starts;
    b.times = times;
    b.coords = at;
    b.controls = degree > 1 ? controls : NULL;
    b.second_controls = degree > 2 ? seconds : NULL;
    return froe_motion_add(m, &b, NULL) == FROE_OK;
}

typedef struct seen {
    int whole, wide, near;
} tally;

static void check_whole(const froe_motion *m, const motion_piece *piece, int64_t tick, mpq_t *truth, tally *seen) {
    const int dim = m->dim;
    num_short xyw[4];
    if (!motion_whole(m, piece, tick, xyw)) {
        seen->wide++;
        return;
    }
    seen->whole++;
    assert_true(xyw[dim] > 0);
    mpq_t x, w;
    mpq_inits(x, w, NULL);
    set_whole(w, xyw[dim]);
    for (int k = 0; k < dim; k++) {
        set_whole(x, xyw[k]);
        mpq_div(x, x, w);
        scale(x, m->unit);
        assert_true(mpq_equal(x, truth[k]));
    }
    mpq_clears(x, w, NULL);
}

static void check_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                         mpq_t *truth) {
    const int dim = m->dim;
    num_dyadic xyw[4];
    num_ball ball[4];
    arena->top = 0;
    motion_dyadic(arena, m, piece, tick, xyw);
    motion_ball(m, piece, tick, ball);
    assert_int_equal(xyw[dim].sign, 1);
    mpq_t x, w;
    mpq_inits(x, w, NULL);
    set_dyadic(w, xyw[dim]);
    assert_within(ball[dim].x, ball[dim].e, w);
    for (int k = 0; k < dim; k++) {
        set_dyadic(x, xyw[k]);
        assert_within(ball[k].x, ball[k].e, x);
        mpq_div(x, x, w);
        assert_true(mpq_equal(x, truth[k]));
    }
    assert_in_range(arena->top, 0, 6000);
    mpq_clears(x, w, NULL);
}

/* The curve about one tick, evaluated at another. */
static void check_curve(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t from, int64_t tick,
                        mpq_t *truth) {
    arena->top = 0;
    motion_dyadic_curve curve;
    motion_ball_curve balls;
    motion_curve_dyadic(arena, m, piece, from, &curve);
    motion_curve_ball(m, piece, from, &balls);
    mpq_t x, s, c, w;
    mpq_inits(x, s, c, w, NULL);
    set_dyadic(w, curve.w);
    const num_dyadic *exact[] = {curve.x, curve.y, curve.z};
    const num_ball *near[] = {balls.x, balls.y, balls.z};
    for (int k = 0; k < m->dim; k++) {
        mpq_set_ui(x, 0, 1);
        for (int i = MOTION_DEGREE; i >= 0; i--) {
            const int power = balls.power;
            set_dyadic(c, exact[k][i]);
            if (power > 0) mpq_div_2exp(s, c, (mp_bitcnt_t)power);
            if (power <= 0) mpq_mul_2exp(s, c, (mp_bitcnt_t)-power);
            num_ball ball = near[k][i];
            assert_within(ball.x, ball.e, s);
            mpq_set_si(s, tick - from, 1);
            mpq_mul(x, x, s);
            mpq_add(x, x, c);
            if (i > piece->degree) assert_int_equal(mpq_sgn(c), 0);
        }
        mpq_div(x, x, w);
        assert_true(mpq_equal(x, truth[k]));
    }
    assert_in_range(arena->top, 0, 12000);
    mpq_clears(x, s, c, w, NULL);
}

static void check_tick(num_arena *arena, const froe_motion *m, uint32_t vertex, int64_t tick, int64_t from,
                       tally *seen) {
    motion_piece piece = motion_piece_at(m, vertex, tick);
    mpq_t time, truth[3];
    mpq_inits(time, truth[0], truth[1], truth[2], NULL);
    time_of(time, m, tick);
    if (piece.degree) {
        assert_true(compare_time(time, piece.from->time) >= 0 && compare_time(time, piece.to->time) <= 0);
        assert_true(tick <= piece.last);
    }
    for (int k = 0; k < m->dim; k++) expected(truth[k], &piece, time, k);
    check_whole(m, &piece, tick, truth, seen);
    check_dyadic(arena, m, &piece, tick, truth);
    check_curve(arena, m, &piece, from, tick, truth);
    double near[3] = {0, 0, 0}, error = motion_near(m, &piece, tick, near);
    seen->near += isfinite(error) && error <= 1e-9 * (1 + fabs(near[0]) + fabs(near[1]) + fabs(near[2]));
    for (int k = 0; k < m->dim; k++) assert_within(near[k], error, truth[k]);
    mpq_clears(time, truth[0], truth[1], truth[2], NULL);
}

static const struct {
    double begin, end, tick;
} windows[] = {{0, 30, 0},           {300000, 330000, 0x1p-17}, {1.7e9, 1.7e9 + 1, 0},
               {-0.3, 0.1, 0x1p-20}, {0, 0x1p-1070, 0},         {-1e300, 1e300, 0}};

static void check_motion(fuzz_source *r, num_arena *arena, unsigned dim, fuzz_class kind, size_t window, int degree,
                         tally *seen) {
    froe_motion *m = motion_in(dim, windows[window].begin, windows[window].end, windows[window].tick);
    for (int i = 0; i < MOST_VERTICES; i++) assert_true(add_random(r, kind, m, degree));
    for (uint32_t v = 0; v < MOST_VERTICES; v++) {
        for (int i = 0; i < 4; i++) {
            int64_t tick = (int64_t)(fuzz_bits(r) % (uint64_t)(m->last_tick + 1));
            check_tick(arena, m, v, tick, (int64_t)(fuzz_bits(r) % (uint64_t)(m->last_tick + 1)), seen);
        }
        check_tick(arena, m, v, 0, m->last_tick, seen);
        check_tick(arena, m, v, m->last_tick, 0, seen);
    }
    froe_motion_free(m);
}

static void check_places(unsigned dim) {
    fuzz_source r = {1};
    num_arena arena;
    froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(num_arena_new(&alloc, &arena), FROE_OK);
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        tally seen = {0, 0, 0};
        for (size_t window = 0; window < sizeof windows / sizeof *windows; window++)
            for (int degree = 1; degree <= MOTION_DEGREE; degree++)
                check_motion(&r, &arena, dim, (fuzz_class)kind, window, degree, &seen);
        if (kind == FUZZ_LATTICE) assert_true(seen.whole > 50 && seen.near > 100);
        if (kind == FUZZ_RANDOM) assert_true(seen.whole > 50 && seen.near > 100);
        if (kind == FUZZ_WIDE) assert_true(seen.wide > 100);
    }
    num_arena_free(&alloc, &arena);
}

static void places_are_exact_in_every_representation(void **state) {
    (void)state;
    check_places(2);
    check_places(3);
}

static void pieces_meet_in_their_knots_and_ticks_know_their_piece(void **state) {
    (void)state;
    froe_motion *m = motion_over(0, 8, 0.5);
    const double times[] = {0, 1, 1.1, 1.2, 4.25, 8}, xy[] = {0, 0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 1;
    b.starts = (const size_t[]){0, 6};
    b.times = times;
    b.coords = xy;
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    const int64_t first[] = {0, 2, 3, 9};
    const double from[] = {0, 1, 1.2, 4.25};
    for (int64_t tick = 0; tick <= m->last_tick; tick++) {
        motion_piece piece = motion_piece_at(m, 0, tick);
        int i = 3;
        while (first[i] > tick) i--;
        assert_true(piece.from->time == from[i]);
        assert_int_equal(piece.last, i == 0 ? 1 : i == 1 ? 2 : i == 2 ? 8 : MOTION_FAR);
    }
    double at[2];
    assert_true(froe_motion_position(m, 0, 4.25, at) && at[0] == 4);
    assert_true(froe_motion_position(m, 0, 8, at) && at[0] == 5);
    assert_false(froe_motion_position(m, 0, 8.5, at));
    assert_false(froe_motion_position(m, 1, 1, at));
    assert_int_equal(froe_motion_knot_count(m, 0), 6);
    assert_true(froe_motion_knot(m, 0, 2).time == 1.1 && isnan(froe_motion_knot(m, 0, 2).control[0]));
    froe_motion_free(m);
}

static void ticks_of_times_are_rounded_exactly(void **state) {
    (void)state;
    fuzz_source r = {7};
    mpq_t t, tick;
    mpq_inits(t, tick, NULL);
    for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
        froe_motion *m = motion_over(windows[w].begin, windows[w].end, windows[w].tick);
        for (int i = 0; i < 2000; i++) {
            double time = ldexp((double)fuzz_int(&r, 0, 1 << 20), m->power + fuzz_int(&r, -3, 12)) + m->begin;
            if (i % 3 == 0) time = nextafter(time, fuzz_int(&r, 0, 1) ? 1e308 : -1e308);
            int64_t before = motion_tick_before(m, time), after = motion_tick_after(m, time);
            time_of(t, m, before);
            assert_true(compare_time(t, time) <= 0);
            assert_int_equal(after, before + (compare_time(t, time) < 0));
            time_of(t, m, before + 1);
            assert_true(compare_time(t, time) > 0);
        }
        froe_motion_free(m);
    }
    froe_motion *m = motion_over(0, 0x1p-1070, 0);
    assert_true(motion_tick_after(m, 1e300) == MOTION_FAR && motion_tick_before(m, -1) == -MOTION_FAR);
    froe_motion_free(m);
    mpq_clears(t, tick, NULL);
}

/* ------------------------------------------------------------------ refusals -- */

typedef struct bad_plan {
    double times[3], xy[6], controls[6];
    const char *message;
} bad_plan;

static const bad_plan bad_plans[] = {
    {{0, 5, 5}, {0, 1, 2, 3, 4, 5}, {NAN, NAN, NAN, NAN}, "vertex 1: Time 2, 5, is not after time 1, 5."},
    {{0, NAN, 10}, {0, 1, 2, 3, 4, 5}, {NAN, NAN, NAN, NAN}, "vertex 1: Its time 1 is nan, not a finite number."},
    {{0, 5, 10}, {0, 1, 2, INFINITY, 4, 5}, {NAN, NAN, NAN, NAN}, "vertex 1: Its y 1 is inf, not a finite number."},
    {{0, 5, 10}, {0, 1, 2, 3, NAN, 5}, {NAN, NAN, NAN, NAN}, "vertex 1: Its x 2 is nan, not a finite number."},
    {{0, 5, 10},
     {0, 1, 2, 3, 4, 5},
     {NAN, NAN, NAN, 1},
     "vertex 1: Its x of control point 1 is nan, not a finite number."},
    {{0, 5, 9},
     {0, 1, 2, 3, 4, 5},
     {NAN, NAN, NAN, NAN},
     "segment 0: The plan of its vertex 1 ends at 9, before "
     "the segment's time in the window does, at 10."},
    {{1, 5, 10},
     {0, 1, 2, 3, 4, 5},
     {NAN, NAN, NAN, NAN},
     "segment 0: The plan of its vertex 1 begins at 1, after "
     "the segment's time in the window does, at 0."},
};

static void assert_fails(froe_motion *m, const froe_moving *b, froe_status status, const char *message) {
    froe_diagnostic diag;
    size_t vertices = m->plans.count, knots = m->knots.count, objects = m->objects.count;
    assert_int_equal(froe_motion_add(m, b, &diag), status);
    assert_string_equal(diag.message, message);
    assert_true(m->plans.count == vertices && m->knots.count == knots && m->objects.count == objects);
}

static void bad_plans_are_refused_by_name_and_nothing_is_lost(void **state) {
    (void)state;
    froe_motion *m = motion_over(0, 10, 0);
    const size_t starts[] = {0, 1, 4};
    for (size_t i = 0; i < sizeof bad_plans / sizeof *bad_plans; i++) {
        double times[4] = {0}, xy[8] = {0}, controls[8] = {0};
        memcpy(times + 1, bad_plans[i].times, sizeof bad_plans[i].times);
        memcpy(xy + 2, bad_plans[i].xy, sizeof bad_plans[i].xy);
        memcpy(controls + 2, bad_plans[i].controls, sizeof bad_plans[i].controls);
        froe_moving b = froe_moving_defaults();
        b.vertex_count = 2;
        b.count = 1;
        b.starts = starts;
        b.times = times;
        b.coords = xy;
        b.controls = controls;
        assert_fails(m, &b, FROE_E_INPUT, bad_plans[i].message);
    }
    froe_motion_free(m);
}

static void bad_batches_are_refused(void **state) {
    (void)state;
    froe_motion *m = motion_over(0, 10, 0);
    const double times[] = {0, 10, 0}, xy[] = {0, 0, 1, 1, 5, 5};
    froe_moving good = froe_moving_defaults(), b;
    good.vertex_count = 2;
    good.count = 1;
    good.starts = (const size_t[]){0, 2, 3};
    good.times = times;
    good.coords = xy;
    b = good, b.starts = (const size_t[]){0, 0, 1};
    assert_fails(m, &b, FROE_E_INPUT, "vertex 0: It has no flight plan.");
    b = good, b.starts = (const size_t[]){0, 2, 1};
    assert_fails(m, &b, FROE_E_ARG, "The plan of vertex 1 ends before it starts.");
    b = good, b.vertices = (const uint32_t[]){0, 2};
    assert_fails(m, &b, FROE_E_INPUT, "segment 0: There is no vertex 2.");
    b = good, b.births = (const double[]){5}, b.deaths = (const double[]){4};
    assert_fails(m, &b, FROE_E_INPUT, "segment 0: Its life from 5 to 4 is none.");
    b = good, b.births = (const double[]){NAN};
    assert_fails(m, &b, FROE_E_INPUT, "segment 0: Its life from nan to 10 is none.");
    b = good, b.group = 0;
    assert_fails(m, &b, FROE_E_INPUT, "segment 0: There is no group 0.");
    b = good, b.size = 0;
    assert_fails(m, &b, FROE_E_OPTIONS, "The options do not come from froe_moving_defaults().");
    b = good, b.times = NULL;
    assert_fails(m, &b, FROE_E_ARG, "The batch has segments without flight plans.");
    assert_int_equal(froe_motion_add(m, &good, NULL), FROE_OK);
    assert_int_equal(froe_motion_object_count(m), 1);
    froe_motion_free(m);
}

/* The moving corners of two triangles that share an edge; and what is refused of them. */
static void triangles_have_three_corners(void **state) {
    (void)state;
    froe_motion *m = motion_in(3, 0, 10, 0);
    const double times[] = {0, 10, 0, 0, 0}, at[] = {0, 0, 0, 0, 0, 8, 1, 0, 0, 0, 1, 0, 1, 1, 5};
    const double controls[] = {0, 0, 2, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    froe_moving good = froe_moving_defaults(), b;
    good.vertex_count = 4;
    good.count = 2;
    good.starts = (const size_t[]){0, 2, 3, 4, 5};
    good.times = times;
    good.coords = at;
    good.controls = controls;
    good.vertices = (const uint32_t[]){0, 1, 2, 2, 1, 3};
    b = good, b.vertices = (const uint32_t[]){0, 1, 2, 2, 3, 2};
    assert_fails(m, &b, FROE_E_INPUT, "triangle 1: Two of its corners are the vertex 2.");
    b = good, b.vertices = (const uint32_t[]){0, 1, 2, 2, 1, 4};
    assert_fails(m, &b, FROE_E_INPUT, "triangle 1: There is no vertex 4.");
    b = good, b.coords = (const double[]){0, 0, 0, 0, 0, 8, 1, 0, NAN, 0, 1, 0, 1, 1, 5};
    assert_fails(m, &b, FROE_E_INPUT, "vertex 1: Its z 0 is nan, not a finite number.");
    b = good, b.controls = (const double[]){0, 0, NAN};
    assert_fails(m, &b, FROE_E_INPUT, "vertex 0: Its z of control point 0 is nan, not a finite number.");
    b = good, b.times = (const double[]){0, 9, 0, 0, 0};
    assert_fails(m, &b, FROE_E_INPUT,
                 "triangle 0: The plan of its vertex 0 ends at 9, before the triangle's time in the window does, at "
                 "10.");
    assert_int_equal(froe_motion_add(m, &good, NULL), FROE_OK);
    assert_int_equal(froe_motion_object(m, 1).vertices[2], 3);
    assert_int_equal(froe_motion_window(m).dim, 3);
    double where[3];
    assert_true(froe_motion_position(m, 0, 5, where) && where[2] == 3 && froe_motion_knot(m, 0, 0).control[2] == 2);
    froe_motion_free(m);
    froe_motion_options o = froe_motion_defaults();
    o.begin = 0, o.end = 1, o.dim = 4;
    assert_int_equal(froe_motion_new(&o, NULL, &m, NULL), FROE_E_OPTIONS);
}

static froe_status window_status(double begin, double end, double tick) {
    froe_motion_options o = froe_motion_defaults();
    o.begin = begin;
    o.end = end;
    o.tick = tick;
    froe_motion *m = NULL;
    froe_status status = froe_motion_new(&o, NULL, &m, NULL);
    assert_int_equal(status == FROE_OK, m != NULL);
    froe_motion_free(m);
    return status;
}

static void bad_windows_are_refused(void **state) {
    (void)state;
    assert_int_equal(window_status(0, 1, 0), FROE_OK);
    assert_int_equal(window_status(1, 1, 0), FROE_E_INPUT);
    assert_int_equal(window_status(NAN, 1, 0), FROE_E_INPUT);
    assert_int_equal(window_status(-1.7e308, 1.7e308, 0), FROE_E_INPUT);
    assert_int_equal(window_status(0, INFINITY, 0), FROE_E_INPUT);
    assert_int_equal(window_status(0, 1, 0.3), FROE_E_OPTIONS);
    assert_int_equal(window_status(0, 1, -1), FROE_E_OPTIONS);
    assert_int_equal(window_status(0, 1, 2), FROE_E_OPTIONS);
    assert_int_equal(window_status(0, 1, 0x1p-60), FROE_E_OPTIONS);
    assert_int_equal(window_status(0, 1, 0x1p-52), FROE_OK);
    assert_int_equal(window_status(0, 1.5, 0x1p-51), FROE_OK);
    assert_int_equal(window_status(0, 1.5, 0x1p-52), FROE_E_OPTIONS);
}

static void lives_are_clipped_to_the_window(void **state) {
    (void)state;
    froe_motion *m = motion_over(0, 10, 0.25);
    const double times[] = {2, 8, 2, 8}, xy[] = {0, 0, 1, 1, 5, 5, 6, 6};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2;
    b.count = 3;
    b.starts = (const size_t[]){0, 2, 4};
    b.times = times;
    b.coords = xy;
    b.vertices = (const uint32_t[]){0, 1, 1, 0, 0, 1};
    b.births = (const double[]){2.1, 2, 11};
    b.deaths = (const double[]){7.9, 8, 12};
    assert_int_equal(froe_motion_add(m, &b, NULL), FROE_OK);
    assert_int_equal(m->objects.data[0].first, 9);
    assert_int_equal(m->objects.data[0].last, 31);
    assert_true(m->objects.data[2].first > m->objects.data[2].last);
    assert_true(froe_motion_object(m, 1).death == 8);
    assert_int_equal(froe_motion_object(m, 3).vertices[0], FROE_NONE);
    const double life[] = {2, 8}, short_times[] = {2, 7}, long_times[] = {1, 9}, at[] = {0, 0, 9, 9};
    froe_diagnostic diag;
    assert_int_equal(motion_replan(m, 1, 2, short_times, at, NULL, NULL, life, &diag), FROE_E_INPUT);
    assert_string_equal(diag.message, "The plan of vertex 1 ends at 7, before 8.");
    assert_int_equal(froe_motion_knot(m, 1, 1).time, 8);
    assert_int_equal(motion_replan(m, 1, 2, long_times, at, NULL, NULL, life, &diag), FROE_OK);
    assert_true(froe_motion_knot(m, 1, 1).time == 9);
    froe_motion_free(m);
}

/* -------------------------------------------------------------------- faults -- */

static froe_status make_one(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_motion_options o = froe_motion_defaults();
    o.begin = 0;
    o.end = 10;
    froe_motion *m = NULL;
    froe_status status = froe_motion_new(&o, alloc, &m, NULL);
    if (status) return status;
    uint32_t group;
    const froe_group names = {.name = "car"};
    status = froe_motion_add_group(m, &names, &group);
    const double times[] = {0, 10, 0}, xy[] = {0, 0, 1, 1, 5, 5};
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2;
    b.count = 1;
    b.starts = (const size_t[]){0, 2, 3};
    b.times = times;
    b.coords = xy;
    b.group = 0;
    if (!status) status = froe_motion_add(m, &b, NULL);
    if (!status) assert_string_equal(froe_motion_group(m, froe_motion_object(m, 0).group).name, "car");
    const double life[] = {0, 10};
    if (!status) status = motion_replan(m, 0, 2, times, xy, NULL, NULL, life, NULL);
    assert_int_equal(froe_motion_object_count(m) + m->plans.count, m->plans.count ? 3 : 0);
    froe_motion_free(m);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(make_one, NULL) >= 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_exact_in_every_representation),
        cmocka_unit_test(pieces_meet_in_their_knots_and_ticks_know_their_piece),
        cmocka_unit_test(ticks_of_times_are_rounded_exactly),
        cmocka_unit_test(triangles_have_three_corners),
        cmocka_unit_test(bad_plans_are_refused_by_name_and_nothing_is_lost),
        cmocka_unit_test(bad_batches_are_refused),
        cmocka_unit_test(bad_windows_are_refused),
        cmocka_unit_test(lives_are_clipped_to_the_window),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
