/* ball.h: "rball", a double with a running error bound that charges the true rounding residue.
 *
 *   true value  in  [x - e, x + e]
 *
 * Operations that happen to be exact cost no error, so x == 0 && e == 0 certifies
 * a zero; no rounding mode is ever changed. Needs round-to-nearest, no contraction
 * (num_machine_trusted() checks both). Measured against directed rounding: better
 * on near-degenerate data, equal on lattices, cheaper at degree 4. */
#ifndef FROE_NUM_BALL_H
#define FROE_NUM_BALL_H
#include <math.h>

typedef struct num_ball {
    double x, e;
} num_ball;

#define NUM_BALL_UP (1.0 + 0x1p-50) /* covers the rounding of the error sums themselves */
#define NUM_BALL_TINY 0x1p-1000     /* swallows every underflow */
#define NUM_UNSURE 2                /* "sign not known yet" */

static inline num_ball num_ball_from(double x) {
    return (num_ball){x, 0};
}
static inline num_ball num_ball_add(num_ball a, num_ball b) {
    double s = a.x + b.x, t = s - a.x, residue = (a.x - (s - t)) + (b.x - t); /* TwoSum (Knuth) */
    return (num_ball){s, (a.e + b.e + fabs(residue)) * NUM_BALL_UP};
}
static inline num_ball num_ball_neg(num_ball a) {
    return (num_ball){-a.x, a.e};
}
static inline num_ball num_ball_sub(num_ball a, num_ball b) {
    return num_ball_add(a, num_ball_neg(b));
}
static inline num_ball num_ball_mul(num_ball a, num_ball b) {
    double p = a.x * b.x, residue = fma(a.x, b.x, -p);
    double e = (fabs(a.x) * b.e + (fabs(b.x) + b.e) * a.e + fabs(residue)) * NUM_BALL_UP;
    int underflow = !(fabs(p) > 0x1p-900) | (a.e != 0) | (b.e != 0);
    int live = ((a.x != 0) | (a.e != 0)) & ((b.x != 0) | (b.e != 0)); /* zero times anything is zero */
    return (num_ball){p, e + (underflow & live ? NUM_BALL_TINY : 0)};
}
/** -1, 0 (certified), 1 or NUM_UNSURE (also for NaN and infinity). */
static inline int num_ball_sign(num_ball a) {
    return a.x > a.e ? 1 : a.x < -a.e ? -1 : a.x == 0 && a.e == 0 ? 0 : NUM_UNSURE;
}
/** The sign of a quotient from the signs of both, where the lower is not 0. */
static inline int num_quotient_sign(int top, int bottom) {
    if (top == 0) return 0;
    return top == NUM_UNSURE || bottom == NUM_UNSURE ? NUM_UNSURE : top * bottom;
}
#endif
