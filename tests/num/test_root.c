/* Signs of expressions with square roots, and the doubles nearest to them, against integers of GMP. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "num/root.h"
#include "support/fuzz.h"
#include <gmp.h>
#include <stdlib.h>

static num_arena arena;
static froe_allocator alloc;

static int setup(void **state) {
    (void)state;
    alloc = support_allocator(NULL);
    return num_arena_new(&alloc, &arena) != FROE_OK;
}

static int teardown(void **state) {
    (void)state;
    num_arena_free(&alloc, &arena);
    return 0;
}

static num_dyadic whole(long x) {
    return num_dyadic_scaled(&arena, x < 0 ? -1 : 1, (uint64_t)labs(x), 0);
}

/* Sign of a + b sqrt(c) + d sqrt(e), with 2000 bits: more than integers of this size can agree on without being equal.
 */
static int by_bits(long a, long b, long c, long d, long e) {
    mpf_t sum, t;
    mpf_init2(sum, 2000);
    mpf_init2(t, 2000);
    mpf_set_si(sum, a);
    const long factors[2] = {b, d}, roots[2] = {c, e};
    for (int i = 0; i < 2; i++) {
        mpf_sqrt_ui(t, (unsigned long)roots[i]);
        mpf_mul_ui(t, t, (unsigned long)labs(factors[i]));
        factors[i] < 0 ? mpf_sub(sum, sum, t) : mpf_add(sum, sum, t);
    }
    mpf_set_ui(t, 1);
    mpf_div_2exp(t, t, 1500);
    int sign = mpf_sgn(sum);
    mpf_abs(sum, sum);
    if (mpf_cmp(sum, t) < 0) sign = 0;
    mpf_clear(sum);
    mpf_clear(t);
    return sign;
}

static void signs_of_sums_with_roots(void **state) {
    (void)state;
    fuzz_source r = {1};
    int zeros = 0;
    for (int i = 0; i < 20000; i++) {
        long a = fuzz_int(&r, -9, 9), b = fuzz_int(&r, -9, 9), c = fuzz_int(&r, 0, 9);
        arena.top = 0;
        int sign = num_root_sign(&arena, whole(a), whole(b), whole(c));
        assert_int_equal(sign, by_bits(a, b, c, 0, 0));
        zeros += !sign;
    }
    assert_true(zeros > 100);
}

static void differences_of_roots(void **state) {
    (void)state;
    fuzz_source r = {2};
    int zeros = 0;
    for (int i = 0; i < 20000; i++) {
        long a = fuzz_int(&r, 0, 30), b = fuzz_int(&r, 0, 30), s = fuzz_int(&r, 1, 4), e = fuzz_int(&r, -6, 6);
        num_ratio x, y;
        arena.top = 0;
        x.top = whole(a), y.top = whole(b * s * s), y.bottom = whole(s * s), x.bottom = whole(1);
        int sign = num_roots_compare(&arena, x, y, whole(e));
        assert_int_equal(sign, by_bits(-e, 1, a, -1, b));
        zeros += !sign;
    }
    assert_true(zeros > 100);
}

typedef struct square {
    double below; /* the value is sqrt(below) */
} square;

static int against(void *user, num_arena *a, num_dyadic x) {
    num_dyadic of = num_dyadic_from(a, ((const square *)user)->below);
    return num_dyadic_compare(of, num_dyadic_mul(a, x, x));
}

/** sqrt() rounds correctly: an oracle for the search, whatever the guess. */
static void the_nearest_double_is_found_from_any_guess(void **state) {
    (void)state;
    fuzz_source r = {3};
    for (int i = 0; i < 4000; i++) {
        square s = {fabs(fuzz_finite(&r))};
        double guess = i % 2 ? fabs(fuzz_finite(&r)) : sqrt(s.below) * (1 + fuzz_int(&r, -3, 3) * 0x1p-52);
        if (i % 100 == 0) s.below = 0;
        if (i % 100 == 1) guess = INFINITY;
        if (i % 100 == 2) guess = NAN;
        arena.top = 0;
        assert_true(num_nearest(&arena, against, &s, guess) == sqrt(s.below));
    }
}

static int far_away(void *user, num_arena *a, num_dyadic x) {
    (void)user;
    return num_dyadic_compare(num_dyadic_scaled(a, 1, 1, 1024), x);
}

static int half_way(void *user, num_arena *a, num_dyadic x) { /* from an odd or even double to the next */
    return num_dyadic_compare(num_dyadic_scaled(a, 1, 2 * *(const uint64_t *)user + 1, -1), x);
}

static void ties_go_to_even_and_beyond_the_range_is_infinite(void **state) {
    (void)state;
    arena.top = 0;
    assert_true(num_nearest(&arena, far_away, NULL, 1) == (double)INFINITY);
    uint64_t even = (uint64_t)1 << 52, odd = even + 1;
    assert_true(num_nearest(&arena, half_way, &even, 1) == (double)even);
    assert_true(num_nearest(&arena, half_way, &odd, 1) == (double)(odd + 1));
}

static void square_roots_of_balls_hold_the_truth(void **state) {
    (void)state;
    fuzz_source r = {4};
    for (int i = 0; i < 100000; i++) {
        double x = fabs(fuzz_unit(&r)), e = ldexp(fabs(fuzz_unit(&r)), -fuzz_int(&r, 0, 60)), y = x + e * fuzz_unit(&r);
        if (y < 0) continue;
        num_ball root = num_ball_sqrt((num_ball){x, e + x * 0x1p-52});
        assert_true(fabs(sqrt(y) - root.x) <= root.e);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_of_sums_with_roots),
        cmocka_unit_test(differences_of_roots),
        cmocka_unit_test(the_nearest_double_is_found_from_any_guess),
        cmocka_unit_test(ties_go_to_even_and_beyond_the_range_is_infinite),
        cmocka_unit_test(square_roots_of_balls_hold_the_truth),
    };
    return cmocka_run_group_tests_name("num/root", tests, setup, teardown);
}
