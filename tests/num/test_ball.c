/* test_ball.c: a ball always holds the true value; its zeros are zeros; the self-test sees
 * what would break it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "num/ball.h"
#include "num/context.h"
#include "support/fuzz.h"
#include "support/memory.h"
#include "support/rational.h"

enum { NUMBERS = 6 };

typedef struct pool {
    num_ball ours[NUMBERS];
    mpq_t theirs[NUMBERS];
    int zeros, sure;
} pool;

static bool finite_ball(num_ball a) {
    return isfinite(a.x) && isfinite(a.e);
}

static void assert_holds(pool *p, num_ball a, const mpq_t b) {
    int sign = num_ball_sign(a);
    if (sign != NUM_UNSURE) assert_int_equal(sign, mpq_sgn(b));
    p->zeros += sign == 0;
    p->sure += sign != NUM_UNSURE;
    if (!finite_ball(a)) {
        assert_int_equal(sign, NUM_UNSURE);
        return;
    }
    mpq_t distance, error;
    mpq_init(distance);
    mpq_init(error);
    mpq_set_d(distance, a.x);
    mpq_sub(distance, distance, b);
    mpq_abs(distance, distance);
    mpq_set_d(error, a.e);
    assert_true(mpq_cmp(distance, error) <= 0);
    mpq_clear(distance);
    mpq_clear(error);
}

static void step(fuzz_source *r, pool *p) {
    int i = fuzz_int(r, 0, NUMBERS - 1), j = fuzz_int(r, 0, NUMBERS - 1), to = fuzz_int(r, 0, NUMBERS - 1);
    num_ball a = p->ours[i], b = p->ours[j];
    switch (fuzz_int(r, 0, 2)) {
    case 0:
        p->ours[to] = num_ball_add(a, b);
        mpq_add(p->theirs[to], p->theirs[i], p->theirs[j]);
        break;
    case 1:
        p->ours[to] = num_ball_sub(a, b);
        mpq_sub(p->theirs[to], p->theirs[i], p->theirs[j]);
        break;
    default:
        p->ours[to] = num_ball_mul(a, b);
        mpq_mul(p->theirs[to], p->theirs[i], p->theirs[j]);
    }
    assert_holds(p, p->ours[to], p->theirs[to]);
}

static void balls_hold_the_true_value(void **state) {
    (void)state;
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)kind};
        pool p = {0};
        for (int k = 0; k < NUMBERS; k++) mpq_init(p.theirs[k]);
        for (int i = 0; i < 1200; i++) {
            double x[NUMBERS * 3];
            fuzz_points(&r, (fuzz_class)kind, 3, x, NUMBERS);
            for (int k = 0; k < NUMBERS; k++) p.ours[k] = num_ball_from(x[k]), mpq_set_d(p.theirs[k], x[k]);
            for (int k = 0; k < 16; k++) step(&r, &p);
        }
        if (kind == FUZZ_SMALL_LATTICE || kind == FUZZ_DENORMAL) assert_true(p.zeros > 500);
        if (kind == FUZZ_RANDOM) assert_true(p.sure > 0.9 * 1200 * 16);
        for (int k = 0; k < NUMBERS; k++) mpq_clear(p.theirs[k]);
    }
}

static void zero_times_anything_is_a_certified_zero(void **state) {
    (void)state;
    num_ball third = num_ball_mul(num_ball_from(0.1), num_ball_from(1.0 / 3)), zero = num_ball_from(0);
    assert_true(third.e > 0);
    assert_int_equal(num_ball_sign(num_ball_mul(third, zero)), 0);
    assert_int_equal(num_ball_sign(num_ball_mul(zero, third)), 0);
    assert_int_equal(num_ball_sign(num_ball_mul(num_ball_from(0x1p-600), num_ball_from(0x1p-600))), NUM_UNSURE);
    assert_int_equal(num_ball_sign(num_ball_mul(zero, num_ball_mul(num_ball_from(1e200), num_ball_from(1e200)))),
                     NUM_UNSURE);
}

static void infinity_and_nan_are_never_sure(void **state) {
    (void)state;
    num_ball big = num_ball_from(0x1.fffffffffffffp1023), inf = num_ball_add(big, big), nan = num_ball_sub(inf, inf);
    assert_int_equal(num_ball_sign(inf), NUM_UNSURE);
    assert_int_equal(num_ball_sign(num_ball_mul(big, big)), NUM_UNSURE);
    assert_int_equal(num_ball_sign(nan), NUM_UNSURE);
    assert_int_equal(num_ball_sign(num_ball_add(nan, big)), NUM_UNSURE);
    assert_int_equal(num_ball_sign(num_ball_mul(inf, num_ball_from(0))), NUM_UNSURE);
}

static void this_machine_is_trusted_as_long_as_it_rounds_to_nearest(void **state) {
    static const int modes[3] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    (void)state;
    assert_true(num_machine_trusted());
    for (int i = 0; i < 3; i++) {
        fesetround(modes[i]);
        bool machine = num_machine_trusted(), rounding = num_rounding_trusted();
        froe_diagnostic diag;
        froe_status status = num_rounding_check(&diag);
        fesetround(FE_TONEAREST);
        assert_int_equal(status, FROE_E_UNSUPPORTED);
        assert_non_null(strstr(diag.message, "cannot be set to do as froe needs it"));
        assert_false(machine);
        assert_false(rounding);
    }
    assert_true(num_machine_trusted());
}

static void flushed_denormals_are_noticed(void **state) {
    (void)state;
#if defined(__SSE2__)
    static const unsigned flags[2] = {0x8000, 0x0040}; /* flush to zero, denormals are zero */
    unsigned before = _mm_getcsr();
    for (int i = 0; i < 2; i++) {
        _mm_setcsr(before | flags[i]);
        bool machine = num_machine_trusted(), rounding = num_rounding_trusted();
        _mm_setcsr(before);
        assert_false(machine);
        assert_false(rounding);
    }
#else
    skip();
#endif
}

static froe_status make_context(void *user, const froe_allocator *alloc) {
    (void)user;
    num_context context;
    froe_status status = num_context_new(alloc, &context);
    if (status == FROE_OK) num_context_free(&context);
    return status;
}

static void a_context_without_memory_is_a_status(void **state) {
    (void)state;
    assert_int_equal(test_memory_each(make_context, NULL), 1);
}

static void statistics_add_up(void **state) {
    (void)state;
    froe_predicate_stats sum = {1, 2, 3, 4, 5, 6, {0}}, more = {10, 20, 30, 40, 50, 60, {0}};
    num_stats_add(&sum, &more);
    assert_memory_equal(&sum, (&(froe_predicate_stats){11, 22, 33, 44, 55, 66, {0}}), sizeof sum);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_hold_the_true_value),
        cmocka_unit_test(zero_times_anything_is_a_certified_zero),
        cmocka_unit_test(infinity_and_nan_are_never_sure),
        cmocka_unit_test(this_machine_is_trusted_as_long_as_it_rounds_to_nearest),
        cmocka_unit_test(flushed_denormals_are_noticed),
        cmocka_unit_test(a_context_without_memory_is_a_status),
        cmocka_unit_test(statistics_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
