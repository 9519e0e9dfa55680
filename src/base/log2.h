/* log2.h: a logarithm from + - * / alone, so that scores, and with them trees, are the same
 * bit for bit everywhere. (The C library's log2 differs between systems.) */
#ifndef FROE_BASE_LOG2_H
#define FROE_BASE_LOG2_H
#include <stdint.h>
#include <string.h>

/** log2(x) to about 12 digits, x a normal number > 0. */
static inline double base_log2(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    double exponent = (double)((int64_t)(bits >> 52) - 1023), m;
    bits = (bits & 0xfffffffffffffu) | 0x3ff0000000000000u;
    memcpy(&m, &bits, sizeof m); /* 1 <= m < 2; log m = 2 artanh t */
    if (m > 1.4142135623730951) m *= 0.5, exponent += 1;
    double t = (m - 1) / (m + 1), s = t * t;
    double series = 1 + s * (1.0 / 3 + s * (1.0 / 5 + s * (1.0 / 7 + s * (1.0 / 9 + s * (1.0 / 11 + s / 13)))));
    return exponent + 2.8853900817779268 * t * series; /* 2 / ln 2 */
}
#endif
