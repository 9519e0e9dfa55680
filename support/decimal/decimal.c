/* decimal.c: see decimal.h. A decimal number is w 10^q with whole w and q. Three ways lead to the nearest double, each
 * where the one before it does not apply:
 *
 *   w and 10^|q| are doubles without rounding: one multiplication or division rounds once (Clinger, "How to read
 *   floating point numbers accurately", PLDI 1990)
 *   w has up to 19 digits: 128 bits of w 5^q decide (Lemire, "Number parsing at a gigabyte per second", Software:
 *   Practice and Experience 51, 2021, algorithm 1; Mushtak and Lemire, "Fast number parsing without fallback", 2023)
 *   otherwise strtod() */
#include "support/decimal/decimal.h"
#include "support/arithmetic.h"
#include "support/decimal/powers_of_five.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum { MOST_DIGITS = 19, MANTISSA = 52, BIAS = 1023, INFINITE = 2047 };

static bool is_digit(char c) {
    return (unsigned char)(c - '0') < 10;
}

static double assemble_double(uint64_t mantissa, int exponent) {
    const uint64_t bits = (uint64_t)exponent << MANTISSA | (mantissa & (((uint64_t)1 << MANTISSA) - 1));
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The double nearest to w 10^q, w > 0, q within the table. */
static double round_by_powers(uint64_t w, int q) {
    const int zeros = __builtin_clzll(w);
    const uint64_t *power = powers_of_five[q - LEAST_POWER];
    const wide first = (wide)(w << zeros) * power[0];
    uint64_t high = (uint64_t)(first >> 64), low = (uint64_t)first;
    if ((high & 0x1ff) == 0x1ff) { /* 64 bits of the power leave a doubt in the bits that round */
        const uint64_t more = (uint64_t)((wide)(w << zeros) * power[1] >> 64);
        low += more;
        high += low < more;
    }
    const int top = (int)(high >> 63), shift = top + 64 - MANTISSA - 3;
    uint64_t mantissa = high >> shift; /* 54 bits, of which the last rounds */
    /* floor(q log2(10)) + 63, as 217706 / 2^16 is near enough to log2(10) (Lemire, section 5) */
    const int twos = (int)(((152170 + 65536) * (int64_t)q) >> 16) + 63;
    int exponent = twos + top - zeros + BIAS;
    if (exponent <= 0) { /* no tie can be here: q < -300, and 5^-q does not divide w */
        if (exponent <= -63) return 0;
        mantissa >>= 1 - exponent;
        mantissa = (mantissa + (mantissa & 1)) >> 1;
        return assemble_double(mantissa, mantissa >> MANTISSA ? 1 : 0);
    }
    /* a tie: 5^q is short enough for w 5^q to be exact, and nothing but zeros follows the bit that rounds */
    if (low <= 1 && q >= -4 && q <= 23 && (mantissa & 3) == 1 && mantissa << shift == high) mantissa--;
    mantissa = (mantissa + (mantissa & 1)) >> 1;
    if (mantissa >> (MANTISSA + 1)) mantissa >>= 1, exponent++;
    return exponent >= INFINITE ? HUGE_VAL : assemble_double(mantissa, exponent);
}

double support_decimal_nearest(uint64_t w, long long q) {
    static const double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (w <= (uint64_t)1 << (MANTISSA + 1) && q >= -22 && q <= 22)
        return q < 0 ? (double)w / tens[-q] : (double)w * tens[q];
    if (!w || q < LEAST_POWER) return 0; /* w < 2^64 */
    return q > GREATEST_POWER ? HUGE_VAL : round_by_powers(w, (int)q);
}

/* Digits one by one. */
static inline const char *pass_digits(const char *at, uint64_t *w) {
    for (; is_digit(*at); ++at) *w = 10 * *w + (uint64_t)(*at - '0');
    return at;
}

/* ahead: bytes behind the NUL may be read. */
static inline double read_decimal(const char *text, char **end, bool ahead) {
    const char *at = text;
    while (*at == ' ' || (*at >= '\t' && *at <= '\r')) ++at;
    const bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    const char *first = at;
    uint64_t w = 0;
    at = pass_digits(at, &w); /* mostly few */
    const bool whole = at > first;
    size_t length = (size_t)(at - first);
    long long q = 0;
    if (*at == '.' && (whole || is_digit(at[1]))) {
        const char *point = ++at;
        at = ahead ? support_decimal_digits(at, &w) : pass_digits(at, &w);
        q = point - at;
        length = (size_t)(at - first) - 1;
    } else if (!whole || *at == 'x' || *at == 'X') {
        return strtod(text, end); /* nothing, infinity, NaN, or hexadecimal */
    }
    if (length > MOST_DIGITS) { /* w may have overflown: zeros before its first digit do not count */
        for (; *first == '0' || *first == '.'; first++) length -= *first == '0';
        if (length > MOST_DIGITS) return strtod(text, end);
    }
    if (*at == 'e' || *at == 'E') {
        const char *e = at + 1;
        const bool down = *e == '-';
        long long power = 0; /* cut where no text is long enough to make up for it */
        e += *e == '-' || *e == '+';
        if (is_digit(*e)) {
            for (; is_digit(*e); ++e) power = power < 1000000000000000 ? 10 * power + (*e - '0') : power;
            q += down ? -power : power;
            at = e;
        }
    }
    *end = (char *)at;
    const double value = support_decimal_nearest(w, q);
    return negative ? -value : value;
}

double support_decimal(const char *text, char **end) {
    return read_decimal(text, end, false);
}

double support_decimal_ahead(const char *text, char **end) {
    return read_decimal(text, end, true);
}

/* ------------------------------------------------------------------ output -- */

/* The whole part of |value| 10^(16 - k), which has 17 digits, and 64 bits of what is behind the point, with an error of
 * less than one: 192 bits of the product with the table's power of five, of which the last may be wrong. k becomes the
 * power of the first digit. False: the table does not reach so far. */
static bool seventeen_digits(uint64_t mantissa, int exponent, int *k, uint64_t *digits, uint64_t *behind) {
    const uint64_t least = UINT64_C(10000000000000000);
    const int zeros = __builtin_clzll(mantissa);
    for (*k = ((exponent + 63 - zeros) * 315653) >> 20;; *k += *digits < least ? -1 : 1) { /* log10(2) 2^20 */
        const int q = 16 - *k, twos = ((152170 * q) >> 16) + q;                            /* floor(q log2(10)) */
        if (q < LEAST_POWER || q > GREATEST_POWER) return false;
        const uint64_t *power = powers_of_five[q - LEAST_POWER], m = mantissa << zeros;
        const wide low = (wide)m * power[1], high = (wide)m * power[0] + (low >> 64);
        const int shift = 127 - twos - exponent + zeros - 128;
        if (shift <= 0 || shift >= 64) return false;
        *digits = (uint64_t)(high >> 64) >> shift;
        *behind = (uint64_t)(high >> 64) << (64 - shift) | (uint64_t)high >> shift;
        if (*digits >= least && *digits < 10 * least) return true;
    }
}

/* Rounds to one of the numbers with so many digits. False: 64 bits leave a doubt. */
static bool round_digits(uint64_t *digits, uint64_t behind, uint64_t unit) {
    enum { DOUBT = 4 };
    const uint64_t rest = *digits % unit, half = UINT64_C(1) << 63;
    *digits /= unit;
    if (unit == 1) {
        *digits += behind > half;
        return behind - half + DOUBT > 2 * DOUBT;
    }
    *digits += rest >= unit / 2;
    return !(rest == unit / 2 && behind <= DOUBT) && !(rest == unit / 2 - 1 && behind >= UINT64_MAX - DOUBT);
}

/* Writes `count` digits of a number whose first digit stands for 10^k. */
static char *put_digits(char *to, const char *digits, int count, int k, bool scientific) {
    if (scientific) {
        *to++ = *digits;
        if (count > 1) *to++ = '.';
        memcpy(to, digits + 1, (size_t)count - 1);
        return to + count - 1 + snprintf(to + count - 1, sizeof "e-324", "e%c%02d", k < 0 ? '-' : '+', abs(k));
    }
    if (k < 0) {
        static const char zeros[] = {'0', '.', '0', '0', '0'};
        memcpy(to, zeros, sizeof zeros);
        to += 1 - k;
        memcpy(to, digits, (size_t)count);
        return to + count;
    }
    for (int i = 0; i < count || i <= k; i++) {
        if (i == k + 1) *to++ = '.';
        *to++ = (char)(i < count ? digits[i] : '0');
    }
    return to;
}

size_t support_decimal_format(char out[SUPPORT_DECIMAL_ROOM], double value, int digits) {
    static const uint64_t units[] = {100, 10, 1};
    const uint64_t implied = (uint64_t)1 << MANTISSA;
    uint64_t bits, number, behind;
    memcpy(&bits, &value, sizeof bits);
    const int exponent = (int)(bits >> MANTISSA & INFINITE);
    const uint64_t mantissa = (bits & (implied - 1)) | (exponent ? implied : 0);
    int k, count = digits;
    if (digits < 15 || digits > 17 || exponent == INFINITE || !mantissa ||
        !seventeen_digits(mantissa, (exponent ? exponent : 1) - BIAS - MANTISSA, &k, &number, &behind) ||
        !round_digits(&number, behind, units[digits - 15]))
        return (size_t)snprintf(out, SUPPORT_DECIMAL_ROOM, "%.*g", digits, value);
    char text[20];
    for (int i = digits; i-- > 0; number /= 10) text[i] = (char)('0' + number % 10);
    if (number) text[0] = '1', k++; /* 999...9 became 10^digits */
    while (count > 1 && text[count - 1] == '0') count--;
    char *to = out;
    if (bits >> 63) *to++ = '-';
    to = put_digits(to, text, count, k, k < -4 || k >= digits);
    *to = '\0';
    return (size_t)(to - out);
}

size_t support_decimal_whole(char *out, uint64_t value) {
    char text[20], *at = text + sizeof text;
    do *--at = (char)('0' + value % 10);
    while (value /= 10);
    const size_t length = (size_t)(text + sizeof text - at);
    memcpy(out, at, length);
    return length;
}
