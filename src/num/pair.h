/* pair.h: unevaluated sums of two doubles, about 106 bits (Dekker: A floating-point technique for extending the
 * available precision, 1971), from + - * alone.
 *
 * Each operation is off by less than 2^-100 of the sum of its operands' sizes, or of their product's, unless something
 * overflows, or a product's rounding error underflows: for callers to exclude. */
#ifndef FROE_NUM_PAIR_H
#define FROE_NUM_PAIR_H
#include <math.h>

typedef struct num_pair {
    double hi, lo;
} num_pair;

static inline num_pair num_pair_sum(double a, double b) { /* exact: Knuth, 4.2.2 */
    double s = a + b, t = s - a;
    return (num_pair){s, (a - (s - t)) + (b - t)};
}
static inline num_pair num_pair_product(double a, double b) { /* exact */
    double p = a * b, s = 0x1.0000002p27 * a, t = 0x1.0000002p27 * b;
    double ah = s - (s - a), bh = t - (t - b), al = a - ah, bl = b - bh;
    return (num_pair){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}
static inline num_pair num_pair_tidy(double hi, double lo) { /* |hi| >= |lo| */
    double s = hi + lo;
    return (num_pair){s, lo - (s - hi)};
}
static inline num_pair num_pair_add(num_pair a, num_pair b) {
    num_pair s = num_pair_sum(a.hi, b.hi);
    return num_pair_tidy(s.hi, s.lo + (a.lo + b.lo)); /* three roundings of numbers below 2^-51 of the sizes */
}
static inline num_pair num_pair_sub(num_pair a, num_pair b) {
    return num_pair_add(a, (num_pair){-b.hi, -b.lo});
}
static inline num_pair num_pair_mul(num_pair a, num_pair b) {
    num_pair p = num_pair_product(a.hi, b.hi);
    return num_pair_tidy(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
/** Off by less than 2^-98 of itself. */
static inline num_pair num_pair_div(num_pair a, num_pair b) {
    double q = a.hi / b.hi;
    num_pair r = num_pair_sub(a, num_pair_mul((num_pair){q, 0}, b));
    return num_pair_tidy(q, r.hi / b.hi);
}
/** For a > 0; off by less than 2^-98 of itself. */
static inline num_pair num_pair_sqrt(num_pair a) {
    double y = sqrt(a.hi); /* a Newton step doubles its 52 bits */
    num_pair r = num_pair_sub(a, num_pair_product(y, y));
    return num_pair_tidy(y, r.hi / (2 * y));
}

/* ----------------------------------------------------------------- vectors -- */

/** q - p, exactly. Returns its size: the sum of its coordinates'. */
static inline double num_pair_between(const double p[3], const double q[3], num_pair out[3]) {
    double size = 0;
    for (int k = 0; k < 3; k++) {
        out[k] = num_pair_sum(q[k], -p[k]);
        size += fabs(out[k].hi);
    }
    return size;
}
static inline num_pair num_pair_dot(const num_pair a[3], const num_pair b[3]) {
    num_pair sum = num_pair_add(num_pair_mul(a[0], b[0]), num_pair_mul(a[1], b[1]));
    return num_pair_add(sum, num_pair_mul(a[2], b[2]));
}
static inline void num_pair_cross(const num_pair a[3], const num_pair b[3], num_pair out[3]) {
    for (int k = 0; k < 3; k++) {
        int i = k == 2 ? 0 : k + 1, j = k ? k - 1 : 2;
        out[k] = num_pair_sub(num_pair_mul(a[i], b[j]), num_pair_mul(a[j], b[i]));
    }
}
#endif
