/* Cubes of grids of powers of two: corners, digits, bounds and their order against integers of 2,100 bits (GMP), for
 * doubles of every size; and what lies in a cube is a run of the curve. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "query/range/cubes.h"
#include "support/fuzz.h"
#include <gmp.h>

enum { TRIALS = 4000, BITS = 2098 };

/* Of every size, or near another; not -0. */
static double draw(fuzz_source *r, double near) {
    double x = fuzz_int(r, 0, 4) ? ldexp(fuzz_unit(r), (int)fuzz_int(r, CUBE_LEAST, 1023)) : 0;
    if (!fuzz_int(r, 0, 2)) x = near + ldexp(near, -(int)fuzz_int(r, 0, 60));
    if (!isfinite(x)) x = near;
    return (fuzz_int(r, 0, 3) ? x : -x) + 0.0;
}

/* |x| in units of 2^-1074. */
static void set_units(mpz_t out, double x) {
    int exponent;
    const double mantissa = frexp(fabs(x), &exponent);
    mpz_set_d(out, ldexp(mantissa, 53));
    exponent += 1074 - 53;
    exponent >= 0 ? mpz_mul_2exp(out, out, (mp_bitcnt_t)exponent) : mpz_tdiv_q_2exp(out, out, (mp_bitcnt_t)-exponent);
}

static void corners_leave_the_digits_below_out(void **state) {
    fuzz_source r = {.state = 1};
    mpz_t x, c, edge;
    (void)state;
    mpz_inits(x, c, edge, NULL);
    for (int i = 0; i < TRIALS; i++) {
        const double at = draw(&r, 1);
        const int level = (int)fuzz_int(&r, CUBE_LEAST, CUBE_MOST + 2);
        const double corner = cube_corner(at, level);
        double lo, hi;
        assert_int_equal(signbit(corner), signbit(at));
        set_units(x, at), set_units(c, corner);
        mpz_tdiv_q_2exp(x, x, (mp_bitcnt_t)(level - CUBE_LEAST));
        mpz_mul_2exp(x, x, (mp_bitcnt_t)(level - CUBE_LEAST));
        assert_int_equal(mpz_cmp(x, c), 0);
        cube_bounds(1, &corner, level, &lo, &hi);
        assert_true(lo <= at && at <= hi && (signbit(at) ? hi : lo) == corner);
        const double far = signbit(at) ? lo : hi; /* no nearer than the edge, or infinite */
        if (!isfinite(far)) continue;
        set_units(edge, far);
        mpz_sub(edge, edge, c);
        assert_true(mpz_sizeinbase(edge, 2) >= (size_t)(level - CUBE_LEAST) + 1);
    }
    mpz_clears(x, c, edge, NULL);
}

static void digits_are_the_highest_that_differ(void **state) {
    fuzz_source r = {.state = 2};
    mpz_t x, y;
    (void)state;
    mpz_inits(x, y, NULL);
    for (int i = 0; i < TRIALS; i++) {
        const double a = draw(&r, 1), b = draw(&r, a);
        set_units(x, a), set_units(y, b);
        mpz_xor(x, x, y);
        const int expected = signbit(a) != signbit(b) ? CUBE_SIGN
                             : mpz_sgn(x) == 0        ? CUBE_ALIKE
                                                      : (int)mpz_sizeinbase(x, 2) - 1 + CUBE_LEAST;
        assert_int_equal(cube_digit(a, b), expected);
    }
    mpz_clears(x, y, NULL);
}

/* Where a comes beside b along the curve, bit by bit. */
static int order_by_bits(int dim, const double *a, const double *b) {
    mpz_t x[3], y[3];
    int order = 0;
    for (int k = 0; k < dim; k++)
        if (!order && signbit(a[k]) != signbit(b[k])) order = signbit(a[k]) ? -1 : 1;
    for (int k = 0; k < dim; k++) mpz_inits(x[k], y[k], NULL), set_units(x[k], a[k]), set_units(y[k], b[k]);
    for (int bit = BITS; bit-- > 0;)
        for (int k = 0; k < dim && !order; k++)
            order = (int)mpz_tstbit(x[k], (mp_bitcnt_t)bit) - (int)mpz_tstbit(y[k], (mp_bitcnt_t)bit);
    for (int k = 0; k < dim; k++) mpz_clears(x[k], y[k], NULL);
    return order;
}

static void the_order_is_that_of_interleaved_bits(void **state) {
    fuzz_source r = {.state = 3};
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        double a[3], b[3];
        const int dim = 1 + i % 3;
        for (int k = 0; k < dim; k++) a[k] = draw(&r, 1), b[k] = draw(&r, a[k]);
        const int found = cube_compare(dim, a, 0, b, 0);
        assert_int_equal((found > 0) - (found < 0), order_by_bits(dim, a, b));
        assert_true(cube_compare(dim, a, 1, a, 0) < 0 && cube_compare(dim, a, 0, a, 1) > 0);
        assert_int_equal(cube_compare(dim, a, 1, a, 1), 0);
    }
}

enum { POINTS = 200 };

static int compare_points(const void *a, const void *b) {
    return cube_compare(2, a, 0, b, 0);
}

static void a_cube_is_a_run_of_the_curve(void **state) {
    fuzz_source r = {.state = 4};
    double points[POINTS][2];
    (void)state;
    for (int i = 0; i < POINTS; i++)
        for (int k = 0; k < 2; k++) points[i][k] = draw(&r, i ? points[i / 2][k] : 1);
    qsort(points, POINTS, sizeof *points, compare_points);
    for (int i = 0; i < POINTS; i++)
        for (int level = CUBE_LEAST; level <= CUBE_MOST; level += 7) {
            int begins = 0, in = 0;
            for (int j = 0; j < POINTS; j++) {
                const int was = in;
                in = cube_holds(2, points[i], level, points[j]);
                begins += in && !was;
            }
            assert_int_equal(begins, 1);
        }
}

static void levels_are_longer_than_extents(void **state) {
    fuzz_source r = {.state = 5};
    (void)state;
    assert_int_equal(cube_level(0), CUBE_LEAST);
    assert_int_equal(cube_level(INFINITY), CUBE_MOST);
    for (int i = 0; i < TRIALS; i++) {
        const double lo = draw(&r, 1), hi = draw(&r, lo), extent = fabs(hi - lo);
        const int level = cube_level(extent);
        if (extent == 0 || !isfinite(extent)) continue;
        if (level < 1024) assert_true(ldexp(1, level) > extent);
        assert_true(ldexp(1, level - 1) <= extent);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_leave_the_digits_below_out),    cmocka_unit_test(digits_are_the_highest_that_differ),
        cmocka_unit_test(the_order_is_that_of_interleaved_bits), cmocka_unit_test(a_cube_is_a_run_of_the_curve),
        cmocka_unit_test(levels_are_longer_than_extents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
