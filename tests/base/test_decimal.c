/* test_decimal.c: decimal numbers against strtod() of the C library, which is correctly rounded, and the powers of five
 * against GMP. */
#include "base/random.h"
#include "support/decimal/decimal.h"
#include "support/decimal/powers_of_five.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <gmp.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(const char *text) {
    const size_t length = strlen(text);
    char *ahead = malloc(length + 1 + SUPPORT_DECIMAL_AHEAD), *stop;
    assert_non_null(ahead);
    memcpy(ahead, text, length + 1);
    memset(ahead + length + 1, '5', SUPPORT_DECIMAL_AHEAD); /* which must not count */
    const double expected = strtod(text, &stop);
    for (int i = 0; i < 2; i++) {
        char *end;
        const double found = i ? support_decimal_ahead(ahead, &end) : support_decimal(text, &end);
        const ptrdiff_t passed = end - (i ? ahead : text);
        uint64_t a, b;
        memcpy(&a, &expected, sizeof a);
        memcpy(&b, &found, sizeof b);
        if (passed != stop - text || (a != b && !(isnan(expected) && isnan(found))))
            fail_msg("'%s': %a up to %td, not %a up to %td", text, found, passed, expected, stop - text);
    }
    free(ahead);
}

/* clang-format off */
static const char *const texts[] = {
    "", " ", "-", "+", ".", "-.", "e5", ".e5", "1", "-1", "+1", "1.", ".5", "-.5", "1.e3", "1e", "1e+",
    "1e-x", "1E5", "1e5e", "1.5.5", "  7", "\t\n\v\f\r8", "--1", "+-1", "0", "-0", "-0.0e5", "00012",
    "0.00012", "0x10", "0X1p3", "-0x.8p1", "0x", "inf", "-Infinity", "nan", "nan(7)x", "1,5", "1;", "1 2",
    "12abc", "infx", "1_000", "1'000", "", "9007199254740992", "9007199254740993", "9007199254740993e0",
    "9007199254740993.0", "9007199254740992.5", "9007199254740995", "18014398509481985e0", "1e22", "1e23",
    "1e-22", "1e-23", "8.5e22", "123456789012345678e-19", "1.7976931348623157e308", "1.7976931348623158e308",
    "1.7976931348623159e308", "1.797693134862315807e308", "1e309", "-1e400", "2.2250738585072014e-308",
    "2.2250738585072011e-308", "2.2250738585072012e-308",
    "2.225073858507201e-308", "4.9e-324", "5e-324", "2.4703282292062327e-324",
    "2.4703282292062328e-324", "2.47e-324", "2.5e-324", "1e-400", "-1e-400", "1e99999999999",
    "1e-99999999999", "1e99999999999999999999", "0e99999999999", "9999999999999999999", "99999999999999999999",
    "12345678901234567890123456789", "0.1234567890123456789012345",
    "1.00000000000000000000000000000000000000000001", "10000000000000000000e-19", "18446744073709551615",
    "18446744073709551616", "9223372036854775808e0", "0.000000000000000000000000000000001",
    "6.631236846766476e-316", "3.2378839133029012895883524125015321748630094e-319", "7.3177701707893310e+15"};
/* clang-format on */

static void texts_end_where_strtod_ends(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) check(texts[i]);
}

/* A power that takes back as many zeros. */
static void long_rows_of_zeros_count(void **state) {
    (void)state;
    enum { ZEROS = 150000 };
    char *text = malloc(ZEROS + 64);
    assert_non_null(text);
    memset(text, '0', ZEROS);
    memcpy(text, "0.", 2);
    snprintf(text + ZEROS, 64, "7e%d", ZEROS - 1);
    check(text);
    *text = '7', text[1] = '0';
    snprintf(text + ZEROS, 64, "e-%d", ZEROS - 1);
    check(text);
    free(text);
}

/* Random digits and powers; doubles as printed with 1 to 19 digits; and numbers half way between two doubles, and one
 * last digit beside that, where they have at most 19 digits. */
static void random_texts_give_the_doubles_of_strtod(void **state) {
    (void)state;
    char text[128];
    for (uint64_t i = 0; i < 600000; i++) {
        const uint64_t word = base_hash(1, 0, i), more = base_hash(1, 1, i);
        double value;
        memcpy(&value, &word, sizeof value);
        const int digits = 1 + (int)(more % 19);
        uint64_t w = word;
        for (int k = 19; k > digits; k--) w /= 10;
        snprintf(text, sizeof text, "%" PRIu64 "e%d", w, (int)(more >> 32) % 350);
        check(text);
        snprintf(text, sizeof text, "-%" PRIu64 ".%06" PRIu64, w % 1000000000000, more % 1000000);
        check(text);
        if (isfinite(value)) {
            snprintf(text, sizeof text, "%.*e", digits - 1, value);
            check(text);
        }
        const uint64_t half = ((word >> 11) | (uint64_t)1 << 52) * 2 + 1; /* 54 bits: half way */
        const int shift = (int)(more % 10);
        snprintf(text, sizeof text, "%" PRIu64, half << shift);
        check(text);
        snprintf(text, sizeof text, "%" PRIu64, (half << shift) + (more >> 60 & 1 ? 1 : (uint64_t)-1));
        check(text);
        mpz_t z; /* half / 2^k = half 5^k / 10^k */
        mpz_init_set_ui(z, (unsigned long)half);
        for (int k = 0; k < shift % 5; k++) mpz_mul_ui(z, z, 5);
        gmp_snprintf(text, sizeof text, "%Zde-%d", z, shift % 5);
        check(text);
        mpz_clear(z);
    }
}

static void check_format(double value) {
    for (int digits = 14; digits <= 18; digits++) {
        char expected[64], found[SUPPORT_DECIMAL_ROOM];
        const int length = snprintf(expected, sizeof expected, "%.*g", digits, value);
        const size_t written = support_decimal_format(found, value, digits);
        if (written != (size_t)length || strcmp(expected, found) != 0)
            fail_msg("%a with %d digits: '%s', not '%s'", value, digits, found, expected);
    }
}

static void numbers_are_printed_as_by_printf(void **state) {
    (void)state;
    static const double values[] = {0.0,
                                    -0.0,
                                    1,
                                    -1,
                                    10,
                                    0.1,
                                    0.5,
                                    0.25,
                                    1e-4,
                                    9.9999e-5,
                                    99999999999999.95,
                                    1e15,
                                    1e16,
                                    1e17,
                                    1e18,
                                    999999999999999.9,
                                    9999999999999998,
                                    99999999999999992.0,
                                    1e22,
                                    1e23,
                                    5e-324,
                                    2.2250738585072014e-308,
                                    1.7976931348623157e308,
                                    1e-300,
                                    1e300,
                                    INFINITY,
                                    -INFINITY,
                                    NAN,
                                    1000000000000000.5,
                                    1000000000000001.5,
                                    100000000000000.05};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) check_format(values[i]);
    for (int q = -330; q <= 308; q++) { /* powers of ten, and their neighbours */
        char text[16];
        snprintf(text, sizeof text, "1e%d", q);
        const double power = strtod(text, NULL);
        check_format(power), check_format(nextafter(power, 0)), check_format(nextafter(power, INFINITY));
        check_format(power * 0.5), check_format(ldexp(1, q));
    }
    for (uint64_t i = 0; i < 150000; i++) {
        const uint64_t word = base_hash(2, 0, i), more = base_hash(2, 1, i);
        double value;
        memcpy(&value, &word, sizeof value);
        check_format(value);
        check_format((double)(word >> 11) * 0x1p-53);
        check_format((double)(word % 1000000) / 1000);
        check_format((double)(word >> 11) / (double)(1 << more % 12)); /* half way between numbers of 15 or 16 digits */
    }
}

/* 5^q < (n + 1) 2^k and 5^q >= n 2^k with 2^127 <= n < 2^128; or, below 0, n is the least above 5^q / 2^k. */
static void powers_of_five_are_those_of_gmp(void **state) {
    (void)state;
    mpz_t power, kept, one;
    mpz_inits(power, kept, one, NULL);
    for (int q = LEAST_POWER; q <= GREATEST_POWER; q++) {
        const uint64_t *words = powers_of_five[q - LEAST_POWER];
        mpz_import(kept, 2, 1, sizeof *words, 0, 0, words);
        mpz_ui_pow_ui(power, 5, (unsigned long)abs(q));
        assert_int_equal(mpz_sizeinbase(kept, 2), 128);
        const size_t bits = mpz_sizeinbase(power, 2);
        if (q >= 0) {
            if (bits <= 128)
                mpz_mul_2exp(power, power, 128 - bits);
            else
                mpz_tdiv_q_2exp(power, power, bits - 128);
        } else { /* 2^m / 5^-q, with m such that it has 128 bits */
            mpz_set_ui(one, 1);
            mpz_mul_2exp(one, one, bits + 127);
            mpz_tdiv_q(power, one, power);
            mpz_add_ui(power, power, 1);
        }
        if (mpz_cmp(power, kept) != 0) {
            mpz_sub_ui(power, power, 1); /* of long powers the specification takes more bits, and cuts them */
            assert_true(q < -27 && mpz_cmp(power, kept) == 0);
        }
    }
    mpz_clears(power, kept, one, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_end_where_strtod_ends),
        cmocka_unit_test(long_rows_of_zeros_count),
        cmocka_unit_test(random_texts_give_the_doubles_of_strtod),
        cmocka_unit_test(numbers_are_printed_as_by_printf),
        cmocka_unit_test(powers_of_five_are_those_of_gmp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
