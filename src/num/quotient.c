/* quotient.c: the one division, for output: a / b rounded to the nearest double.
 *
 * As in schoolbook division the leading words guess the quotient, to a few more bits
 * than a double has; exact remainders then correct the guess and decide the rounding. */
#include "num/dyadic.h"
#include <math.h>

__extension__ typedef unsigned __int128 wide;

enum { LEAST_POWER = -1074, MOST_POWER = 1024, SPARE_BITS = 2 };

/* The 64 leading bits of |a|, and the power of 2 of their last. */
static uint64_t leading(num_dyadic a, int *power) {
    uint64_t high = a.limbs[a.count - 1], low = a.count > 1 ? a.limbs[a.count - 2] : 0;
    int shift = __builtin_clzll(high);
    *power = 64 * (a.exponent + (int)a.count - 1) - shift;
    return shift ? high << shift | low >> (64 - shift) : high;
}

/* About (a / b) / 2^unit, where the quotient of the leading bits is  ha / hb 2^power. */
static uint64_t guess(uint64_t ha, uint64_t hb, int power, int unit) {
    int shift = 62 + unit - power; /* >= 5: (ha 2^62 / hb) 2^-shift */
    return shift < 64 ? (uint64_t)(((wide)ha << 62) / hb) >> shift : 0;
}

/* The double nearest to  whole 2^unit  (plus a little, if `sticky`), ties to even. At
 * least SPARE_BITS bits go. */
static double round_whole(uint64_t whole, bool sticky, int unit) {
    int bits = whole ? 64 - __builtin_clzll(whole) : 0, drop = bits - 53;
    if (drop < LEAST_POWER - unit) drop = LEAST_POWER - unit;
    uint64_t kept = whole >> drop, rest = whole - (kept << drop), half = (uint64_t)1 << (drop - 1);
    if (rest > half || (rest == half && (sticky || (kept & 1)))) kept++;
    return ldexp((double)kept, unit + drop);
}

double num_dyadic_quotient(num_arena *arena, num_dyadic a, num_dyadic b) {
    if (!b.sign) return NAN; /* occurs with corrupted trees only */
    if (!a.sign) return 0;
    int sign = a.sign * b.sign, power_a, power_b;
    uint64_t ha = leading(a, &power_a), hb = leading(b, &power_b);
    int power = power_a - power_b;
    if (power > MOST_POWER + 1) return sign * (double)INFINITY;
    int unit = power - 1 - 53 - SPARE_BITS; /* |a / b| lies in 2^power (1/2 .. 2) */
    if (unit < LEAST_POWER - SPARE_BITS) unit = LEAST_POWER - SPARE_BITS;
    a.sign = b.sign = 1;
    uint64_t whole = guess(ha, hb, power, unit);
    num_dyadic step = num_dyadic_mul(arena, b, num_dyadic_scaled(arena, 1, 1, unit));
    num_dyadic rest = num_dyadic_sub(arena, a, num_dyadic_mul(arena, step, num_dyadic_scaled(arena, 1, whole, 0)));
    for (; rest.sign < 0; whole--) rest = num_dyadic_add(arena, rest, step);
    for (; num_dyadic_compare(rest, step) >= 0; whole++) rest = num_dyadic_sub(arena, rest, step);
    double q = round_whole(whole, rest.sign != 0, unit);
    return q != 0 ? sign * q : 0;
}
