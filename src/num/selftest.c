/* selftest.c: may the filters trust this machine, this compiler and these flags?
 *
 * Every operand is volatile, so that the answers come from the processor at run
 * time and not from the compiler's own arithmetic. */
#include "num/context.h"
#include "support/fail.h"
#include <fenv.h>
#include <float.h>
#include <math.h>

#if defined(__x86_64__) && defined(__GNUC__)
/* Rounding (bits 13 and 14), flush to zero (15) and denormals are zero (6) in the control register. */
bool num_rounding_trusted(void) {
    return (__builtin_ia32_stmxcsr() & 0xe040) == 0;
}
#else
/* Upwards the first sum is larger, downwards and towards zero the second is not. No products of denormals: on
 * processors where those are slow, this takes a third of the time. */
bool num_rounding_trusted(void) {
    volatile double unknown[] = {1, 0x1p-1074, 0x1p-1022};
    double one = unknown[0], denormal = unknown[1], tiny = unknown[2];
    return one + 0x1p-53 == one && one + 0x1.8p-53 > one && denormal > 0 && 0x1.8p-1022 - tiny > 0;
}
#endif

typedef struct computation {
    double computed, expected;
} computation;

froe_status num_rounding_check(froe_diagnostic *diag) {
    if (num_rounding_trusted()) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "The processor rounds doubles otherwise than to nearest, or flushes denormal numbers, and "
                        "cannot be set to do as froe needs it.");
}

/* All are computed, and none decides alone, so that one way through this function tests all of it. */
bool num_machine_trusted(void) {
    volatile double one = 1, half_ulp = 0x1p-53, ulp = 0x1p-52;
    volatile double bit = 0x1p-53 + 0x1p-64, greatest = DBL_MAX;
    volatile double factor = 1 + 0x1p-27, square = 1 + 0x1p-26;
    volatile double smallest = DBL_MIN, denormal = smallest * 0.5, least = 0x1p-1074;
    volatile double big = 0x1p60, small = 1.5;
    const double f = factor, g = factor, product = g * g, rounded = square, a = big, b = small, s = a + b, t = s - a;
    const volatile computation tests[] = {
        /* to nearest, ties to even */
        {(one + ulp) + half_ulp, 1 + 0x1p-51},
        {-one - half_ulp, -1},
        {one / 3, 0x1.5555555555555p-2},
        /* once: extended precision (x87) would round twice, and reach farther */
        {one + bit, 1 + 0x1p-52},
        {greatest * 2, INFINITY},
        /* nothing is contracted: (1 + 2^-27)^2 = 1 + 2^-26 + 2^-54 loses its last bit, unless mul and add are fused */
        {f * f - rounded, 0},
        /* but on demand */
        {fma(g, g, -product), 0x1p-54},
        /* gradual underflow */
        {denormal, 0x1p-1023},
        {denormal * 2, DBL_MIN},
        {least * 0x1p1000, 0x1p-74},
        /* TwoSum and its like are not "simplified" by a compiler that treats doubles as real numbers */
        {s, 0x1p60},
        {(a - (s - t)) + (b - t), 1.5},
    };
    bool right = num_rounding_trusted();
    right &= fegetround() == FE_TONEAREST;
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) right &= tests[i].computed == tests[i].expected;
    return right;
}
