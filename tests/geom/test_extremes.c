/* Filters at both ends of the range of doubles: quotients of denormals, lengths whose squares underflow or overflow,
 * and sums of squares that come out infinite although the true ones do not. */
#include "geom/filter.h"
#include "geom/meet/meet.h"
#include "geom/range.h"
#include "support/fuzz.h"
#include "support/rational.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { QUOTIENTS = 400000, LENGTHS = 100000, BALLS = 200000 };

/* ----------------------------------------------------------------- filters -- */

/* A number of any scale, denormal ones often. */
static double any_number(fuzz_source *r) {
    static const int scales[] = {-1074, -1060, -1022, -900, -500, -1, 0, 500, 1000};
    const int scale = fuzz_int(r, 0, 2) ? scales[fuzz_int(r, 0, 8)] : fuzz_int(r, -1074, 1000);
    return ldexp(fuzz_int(r, 0, 1) ? fuzz_int(r, -9, 9) : 16 * fuzz_unit(r), scale);
}

/* |q - x / y| <= e, for all x within e_x and y within e_y: it is furthest off at the ends. */
static void quotients_keep_their_error(void **state) {
    fuzz_source r = {1};
    size_t known = 0;
    (void)state;
    for (int i = 0; i < QUOTIENTS; i++) {
        const num_ball x = {any_number(&r), fuzz_int(&r, 0, 1) ? 0 : fabs(any_number(&r))},
                       y = {any_number(&r), fuzz_int(&r, 0, 1) ? 0 : fabs(any_number(&r)) * 0x1p-20};
        const num_ball q = filter_div(x, y);
        if (!(q.e < INFINITY) || !isfinite(q.x)) continue;
        known++;
        mpq_t top, bottom, t, e;
        mpq_init(top), mpq_init(bottom), mpq_init(t), mpq_init(e);
        for (int end = 0; end < 4; end++) {
            mpq_set_d(top, x.x), mpq_set_d(t, end & 1 ? x.e : -x.e), mpq_add(top, top, t);
            mpq_set_d(bottom, y.x), mpq_set_d(t, end & 2 ? y.e : -y.e), mpq_add(bottom, bottom, t);
            assert_true(mpq_sgn(bottom) != 0);
            mpq_div(top, top, bottom);
            mpq_set_d(t, q.x), mpq_sub(top, top, t), mpq_abs(top, top);
            mpq_set_d(e, q.e);
            if (mpq_cmp(top, e) > 0) fail_msg("%a +- %a / %a +- %a is not %a +- %a", x.x, x.e, y.x, y.e, q.x, q.e);
        }
        mpq_clear(top), mpq_clear(bottom), mpq_clear(t), mpq_clear(e);
    }
    assert_true(known > QUOTIENTS / 4);
}

/* At least the length, and not much more but for denormals. */
static void lengths_are_neither_lost_nor_infinite(void **state) {
    fuzz_source r = {2};
    (void)state;
    assert_true(filter_length((const double[3]){0, 0, 0}) == 0);
    for (int i = 0; i < LENGTHS; i++) {
        const double n[3] = {any_number(&r), any_number(&r), fuzz_int(&r, 0, 1) ? 0 : any_number(&r)};
        const double length = filter_length(n), most = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
        mpq_t sum, t;
        mpq_init(sum), mpq_init(t);
        for (int k = 0; k < 3; k++) mpq_set_d(t, n[k]), mpq_mul(t, t, t), mpq_add(sum, sum, t);
        mpq_set_d(t, length), mpq_mul(t, t, t);
        if (mpq_cmp(t, sum) < 0 || !(length <= 1.74 * most + 0x1p-1073))
            fail_msg("%a of %a %a %a", length, n[0], n[1], n[2]);
        mpq_clear(sum), mpq_clear(t);
    }
}

/* ------------------------------------------------------------------- balls -- */

/* A point at about the distance r from the origin, in eight dimensions. */
static void point_about(fuzz_source *r, double radius, double x[8]) {
    double square = 0;
    for (int k = 0; k < 8; k++) x[k] = 0.1 + fabs(fuzz_unit(r)), square += x[k] * x[k];
    for (int k = 0; k < 8; k++) x[k] *= radius / sqrt(square);
}

static bool truly_in(const double x[8], double radius) {
    mpq_t sum, t;
    mpq_init(sum), mpq_init(t);
    for (int k = 0; k < 8; k++) mpq_set_d(t, x[k]), mpq_mul(t, t, t), mpq_add(sum, sum, t);
    mpq_set_d(t, radius), mpq_mul(t, t, t);
    const bool in = mpq_cmp(sum, t) <= 0;
    mpq_clear(sum), mpq_clear(t);
    return in;
}

/* 2^512 squared is no double, and neither are sums a little below 2^1024 that are rounded up. */
static void squares_that_overflow_decide_nothing(void **state) {
    static const double radii[] = {0x1.fffffffffffffp511, 0x1p512, 0x1.ffffffffffffep511, 0x1.0000000000001p512};
    static const double origin[8] = {0};
    num_context context;
    fuzz_source r = {3};
    (void)state;
    assert_int_equal(num_context_new(NULL, &context), FROE_OK);
    for (int i = 0; i < BALLS; i++) {
        double x[8], radius = radii[i % 4];
        point_about(&r, radius, x);
        const bool in = truly_in(x, radius);
        geom_range ball = {.kind = GEOM_RANGE_BALL, .dim = 8, .set = {.dim = 8, .count = 1, .coords = origin}};
        ball.set.radius = radius;
        assert_int_equal(geom_meet_boxes(&context, 8, x, x, 0, origin, origin, radius), in);
        const int has = geom_range_has(&ball, x);
        assert_true(has == NUM_UNSURE || has == in);
        if (in) assert_false(geom_range_misses(&ball, x, x));
        if (!in) assert_false(geom_range_holds(&context, &ball, 0, x, x));
    }
    num_context_free(&context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quotients_keep_their_error),
        cmocka_unit_test(lengths_are_neither_lost_nor_infinite),
        cmocka_unit_test(squares_that_overflow_decide_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
