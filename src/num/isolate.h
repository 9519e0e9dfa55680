/* isolate.h: the real roots of a polynomial between 0 and 1, each in an interval of its own, as narrow as wanted.
 *
 *     0 --------(---x---)-------------- 1        lo < root < lo + 2^-depth, lo a multiple of 2^-depth
 *                                                or root == lo, when it is found to be so (`exact`)
 *
 * Intervals are halves of halves of 0 .. 1: any two are apart, or one lies in the other. */
#ifndef FROE_NUM_ISOLATE_H
#define FROE_NUM_ISOLATE_H
#include "num/poly.h"

enum {
    NUM_FRACTION_LIMBS = 32,
    NUM_MOST_DEPTH = 64 * NUM_FRACTION_LIMBS - 1 /* roots that are closer than 2^-2047 are not told apart */
};

typedef struct num_isolation num_isolation;
typedef struct num_isolated {
    const num_isolation *of;
    int depth;
    int low_sign; /**< of the polynomial at lo */
    bool even;    /**< the same sign at the upper end: a root of even multiplicity */
    bool exact;
    uint64_t lo[NUM_FRACTION_LIMBS]; /**< of 2^(-64 NUM_FRACTION_LIMBS) */
} num_isolated;

/** A polynomial with its roots, ascending. Coefficients live in the arena. Not to be moved. */
struct num_isolation {
    num_chain
        chain; /**< of the polynomial without its roots at 0 and 1; only that if its roots are simple and far apart */
    num_ball_poly near;
    int count; /**< -1: two roots are too close */
    num_isolated root[NUM_DEGREE];
};
/** f not zero. */
void num_isolate(num_arena *arena, const num_poly *f, num_isolation *out);

/** Halves the interval, unless the root is known exactly. False: NUM_MOST_DEPTH is reached. */
bool num_isolated_refine(num_arena *arena, num_isolated *root);
/** Refines until the interval is 2^-depth wide, or the root is known. */
bool num_isolated_narrow(num_arena *arena, num_isolated *root, int depth);

num_dyadic num_isolated_low(const num_isolated *root); /**< lives as long as the root is not refined */
num_dyadic num_isolated_high(num_arena *arena, const num_isolated *root);
/** Everything between low and high. */
num_ball num_isolated_ball(const num_isolated *root);

/** Sign of g at the root. g of degree <= NUM_DEGREE. */
int num_isolated_sign(num_arena *arena, const num_isolated *root, const num_poly *g, const num_ball_poly *near);
/** Sign of a - b; refines both until they are apart, unless they are equal. NUM_UNSURE: too close. */
int num_isolated_compare(num_arena *arena, num_isolated *a, num_isolated *b);
#endif
