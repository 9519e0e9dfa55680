/* near.h: what a claim is about, as polynomials in doubles over a range of ticks, each with one bound on its error.
 *
 *     c[0] + c[1] u + c[2] u^2 + ...        u = s / span from 0 to 1, for the tick s ticks from now
 *
 * One bound for the whole range costs a fraction of a bound for each coefficient, since sums and products of
 * polynomials are then sums and products of two numbers beside their coefficients: the sum of |c|, which bounds every
 * value, and the error. It loses little, because errors of flight plans are bounds for whole pieces anyway (course.c).
 * Points are taken relative to an end of a segment, so that numbers are as small as what they tell apart. */
#ifndef FROE_KINETIC_NEAR_H
#define FROE_KINETIC_NEAR_H
#include "kinetic/now/now.h"

typedef struct near_poly {
    int degree;
    double size;  /**< at least the sum of |c| */
    double error; /**< no value in the range is further off */
    double c[POLY_TERMS];
} near_poly;

typedef struct near_claim {
    near_poly value;   /**< > 0 while the claim holds, until a denominator changes its sign; in x, or y */
    near_poly turn[2]; /**< the denominators, if the points are crossings: how their lines turn */
    bool has_turn[2];
} near_claim;

/** From now until `span` ticks later, span > 0. REQUIRES: the claim holds, or is not one NOW_ALONG, and no piece of a
 * plan ends before. */
void near_find(now_state *now, const now_claim *claim, int axis, double span, near_claim *out);
/** The same in balls, where bodies turn. False: they say too little. */
bool near_find_turning(now_state *now, const now_claim *claim, int axis, double span, near_poly *out);
/** The sign at u: 1, -1, or 0 where the error leaves it open. */
static inline int near_sign_at(const near_poly *p, double u) {
    double y = 0;
    for (int i = p->degree; i >= 0; i--) y = y * u + p->c[i];
    const double error = p->error + p->size * 0x1p-48;
    return y > error ? 1 : y < -error ? -1 : 0;
}
#endif
