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

/** sqrt(a / b) for a, b > 0; off by less than 2^-96 of itself. The quotient of the upper halves has a root that is off
 * by 2.5 times 2^-53 of itself, of which a Newton step leaves the square. */
static inline num_pair num_pair_root(num_pair a, num_pair b) {
    const double y = sqrt(a.hi / b.hi);
    const num_pair rest = num_pair_sub(a, num_pair_mul(num_pair_product(y, y), b));
    return num_pair_tidy(y, rest.hi / (2 * y * b.hi));
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
/* What is missing in the product of the upper halves: two roundings of numbers below 2^-52 of it. */
static inline double num_pair_rest(num_pair a, num_pair b, num_pair upper) {
    return upper.lo + (a.hi * b.lo + a.lo * b.hi);
}
/** Off by less than 2^-100 of the sum of the products' sizes: lower halves, below 2^-50 of it, are rounded some ten
 * times. */
static inline num_pair num_pair_dot(const num_pair a[3], const num_pair b[3]) {
    num_pair p[3];
    for (int k = 0; k < 3; k++) p[k] = num_pair_product(a[k].hi, b[k].hi);
    const num_pair s = num_pair_sum(p[0].hi, p[1].hi), t = num_pair_sum(s.hi, p[2].hi);
    double rest = s.lo + t.lo;
    for (int k = 0; k < 3; k++) rest += num_pair_rest(a[k], b[k], p[k]);
    return num_pair_tidy(t.hi, rest);
}
/** The same for each coordinate. */
static inline void num_pair_cross(const num_pair a[3], const num_pair b[3], num_pair out[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = k == 2 ? 0 : k + 1, j = k ? k - 1 : 2;
        const num_pair p = num_pair_product(a[i].hi, b[j].hi), q = num_pair_product(a[j].hi, b[i].hi);
        const num_pair s = num_pair_sum(p.hi, -q.hi);
        out[k] = num_pair_tidy(s.hi, s.lo + (num_pair_rest(a[i], b[j], p) - num_pair_rest(a[j], b[i], q)));
    }
}
#endif
