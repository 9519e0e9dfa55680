/* test_wide.c: integers of 320 bits against GMP. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <gmp.h>

#include "num/wide.h"
#include "support/fuzz.h"

static void set(mpz_t out, num_wide a) {
    const num_wide size = num_wide_sign(a) < 0 ? num_wide_sub((num_wide){{0}}, a) : a;
    mpz_import(out, NUM_WIDE_LIMBS, -1, sizeof *size.d, 0, 0, size.d);
    if (num_wide_sign(a) < 0) mpz_neg(out, out);
}

/* Of up to 127 bits: few ones, few zeros, or any. */
static num_short any_short(fuzz_source *r) {
    num_limbs2 x = (num_limbs2)fuzz_bits(r) << 64 | fuzz_bits(r);
    int kind = fuzz_int(r, 0, 3);
    if (kind == 0) x = 0;
    if (kind == 1) x = ~(num_limbs2)0;
    x >>= fuzz_int(r, 1, 127);
    return fuzz_int(r, 0, 1) ? (num_short)x : -(num_short)x;
}

static void assert_is(num_wide a, const mpz_t truth) {
    mpz_t value;
    mpz_init(value);
    set(value, a);
    assert_int_equal(mpz_cmp(value, truth), 0);
    assert_int_equal(num_wide_sign(a), mpz_sgn(truth));
    mpz_clear(value);
}

/* A product of two, and a sum or difference with another product, each as wide as may be. */
static void check(fuzz_source *r) {
    num_wide a = num_wide_from(any_short(r)), b = num_wide_from(any_short(r)), c = num_wide_from(any_short(r));
    const int power = fuzz_int(r, 0, NUM_WIDE_BITS - 127 - 127 - 2);
    mpz_t x, y, z;
    mpz_inits(x, y, z, NULL);
    set(x, a), set(y, b), set(z, c);
    mpz_mul(y, x, y);
    mpz_mul(z, x, z);
    mpz_mul_2exp(z, z, (mp_bitcnt_t)power);
    b = num_wide_mul(a, b);
    c = num_wide_mul(num_wide_power(power), num_wide_mul(a, c));
    assert_is(b, y);
    assert_is(c, z);
    mpz_add(x, y, z);
    assert_is(num_wide_add(b, c), x);
    mpz_sub(x, y, z);
    assert_is(num_wide_sub(b, c), x);
    assert_int_equal(num_wide_sign(num_wide_sub(b, b)), 0);
    mpz_clears(x, y, z, NULL);
}

static void sums_and_products_are_those_of_gmp(void **state) {
    (void)state;
    fuzz_source r = {7};
    for (int i = 0; i < 200000; i++) check(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_and_products_are_those_of_gmp)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
