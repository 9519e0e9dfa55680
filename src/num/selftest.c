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

static bool rounds_to_nearest_even(void) {
    volatile double one = 1, half_ulp = 0x1p-53, ulp = 0x1p-52;
    volatile double even = (one + ulp) + half_ulp, minus = -one - half_ulp, third = one / 3;
    return fegetround() == FE_TONEAREST && num_rounding_trusted() && even == 1 + 0x1p-51 && minus == -1 &&
           third == 0x1.5555555555555p-2;
}

/* Extended precision (x87) would round twice: 1 + (2^-53 + 2^-64) must give 1 + 2^-52. */
static bool rounds_once(void) {
    volatile double one = 1, bit = 0x1p-53 + 0x1p-64, sum = one + bit;
    volatile double big = DBL_MAX, product = big * 2;
    return sum == 1 + 0x1p-52 && isinf(product);
}

/* (1 + 2^-27)^2 = 1 + 2^-26 + 2^-54 loses its last bit, unless mul and add were fused. */
static bool contracts_nothing(void) {
    volatile double factor = 1 + 0x1p-27, rounded = 1 + 0x1p-26;
    double a = factor, b = rounded, difference = a * a - b;
    return difference == 0;
}

static bool fuses_on_demand(void) {
    volatile double factor = 1 + 0x1p-27;
    double a = factor, p = a * a;
    return fma(a, a, -p) == 0x1p-54;
}

static bool underflows_gradually(void) {
    volatile double smallest = DBL_MIN, half = 0.5, denormal = smallest * half, restored = denormal * 2;
    volatile double least = 0x1p-1074, lifted = least * 0x1p1000;
    return denormal > 0 && denormal < smallest && restored == smallest && lifted == 0x1p-74;
}

/* TwoSum and its like must not be "simplified" by a compiler that treats doubles as real numbers. */
static bool keeps_residues(void) {
    volatile double big = 0x1p60, small = 1.5;
    double a = big, b = small, s = a + b, t = s - a, residue = (a - (s - t)) + (b - t);
    return s == 0x1p60 && residue == 1.5;
}

froe_status num_rounding_check(froe_diagnostic *diag) {
    if (num_rounding_trusted()) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "The processor rounds doubles otherwise than to nearest, or flushes denormal numbers, and "
                        "cannot be set to do as froe needs it.");
}

bool num_machine_trusted(void) {
    return rounds_to_nearest_even() && rounds_once() && contracts_nothing() && fuses_on_demand() &&
           underflows_gradually() && keeps_residues();
}
