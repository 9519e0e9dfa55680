/* pair.h: unevaluated sums of two doubles, about 106 bits (Dekker: A floating-point technique for extending the
 * available precision, 1971), from + - * alone.
 *
 * Each operation is off by less than 2^-100 of the sum of its operands' sizes, or of their product's, unless something
 * overflows, or a product's rounding error underflows: for callers to exclude. */
#ifndef FROE_NUM_PAIR_H
#define FROE_NUM_PAIR_H

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
    num_pair s = num_pair_sum(a.hi, b.hi), t = num_pair_sum(a.lo, b.lo);
    s = num_pair_tidy(s.hi, s.lo + t.hi);
    return num_pair_tidy(s.hi, s.lo + t.lo);
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
#endif
