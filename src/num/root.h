/* root.h: exact answers about square roots, without taking any. */
#ifndef FROE_NUM_ROOT_H
#define FROE_NUM_ROOT_H
#include "num/ball.h"
#include "num/dyadic.h"

/** Sign of a + b sqrt(c), c >= 0. */
int num_root_sign(num_arena *arena, num_dyadic a, num_dyadic b, num_dyadic c);
/** A quotient that is not divided; bottom > 0. */
typedef struct num_ratio {
    num_dyadic top, bottom;
} num_ratio;
/** Sign of a - b. */
int num_ratio_compare(num_arena *arena, num_ratio a, num_ratio b);
/** Sign of sqrt(a) - sqrt(b) - e, a and b >= 0. */
int num_roots_compare(num_arena *arena, num_ratio a, num_ratio b, num_dyadic e);

/** Sign of value - x. */
typedef int num_compare_fn(void *user, num_arena *arena, num_dyadic x);
/** The double nearest to a value >= 0 that can be compared with any number (ties to even; infinity beyond the
 * range). A guess that is near saves comparisons: a right one needs three. What the arena holds stays. */
double num_nearest(num_arena *arena, num_compare_fn *compare, void *user, double guess);

/** (p + q sqrt(r)) / s, r >= 0, s > 0. */
typedef struct num_surd {
    num_dyadic p, q, r, s;
} num_surd;
/** The double nearest to it, ties to even; infinity when out of range; never -0. What the arena holds stays. */
double num_surd_round(num_arena *arena, num_surd a);

/** The square root of a ball that holds no negative number (what is below 0 in it does not count). */
static inline num_ball num_ball_sqrt(num_ball a) {
    double low = a.x > a.e ? a.x - a.e : 0, root = sqrt(a.x > 0 ? a.x : 0), least = sqrt(low);
    double e = root + least > 0 ? a.e / ((root + least) * (1 - 0x1p-50)) : sqrt(a.e);
    return (num_ball){root, (e + root * 0x1p-51) * NUM_BALL_UP + NUM_BALL_TINY};
}
#endif
