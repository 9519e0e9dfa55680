/* poly.h: polynomials of low degree with dyadic coefficients: signs, and how many roots lie where, exactly.
 *
 * Remainders are pseudo-remainders, scaled by positive numbers; what is known to divide them is divided out, so that
 * coefficients grow in proportion to the degree (subresultants: Knuth, The Art of Computer Programming, volume 2, 3rd
 * edition, 4.6.1, algorithm C). Roots are counted by Sturm's
 * theorem, and signs at roots by Tarski's generalisation of it (Basu, Pollack, Roy: Algorithms in Real Algebraic
 * Geometry, 2006, section 2.2.2): with the signed remainder sequence f, f'g, ... and V its variations in sign,
 *     V(lo) - V(hi)  =  sum of sign g(x) over the roots x of f between lo and hi,
 * multiple roots counted once, lo and hi no roots. With g = 1 that is their number. */
#ifndef FROE_NUM_POLY_H
#define FROE_NUM_POLY_H
#include "num/ball.h"
#include "num/dyadic.h"

enum {
    NUM_DEGREE = 12, /* of polynomials that callers give */
    NUM_COEFFICIENTS = 2 * NUM_DEGREE,
    NUM_BALL_COEFFICIENTS = NUM_DEGREE + 4 /* many of these polynomials stand on the stack at once */
};

typedef struct num_poly {
    int degree; /**< -1: zero */
    num_dyadic c[NUM_COEFFICIENTS];
} num_poly;

/** A polynomial with error bounds; of a num_poly, or made as such. */
typedef struct num_ball_poly {
    int degree;
    num_ball c[NUM_BALL_COEFFICIENTS];
} num_ball_poly;

/** Strips leading zeros: sets the degree from at most `most`. */
void num_poly_trim(num_poly *f, int most);
num_ball_poly num_poly_balls(num_arena *arena, const num_poly *f); /**< what the arena holds stays */
num_ball num_ball_poly_at(const num_ball_poly *f, num_ball x);

int num_poly_sign(num_arena *arena, const num_poly *f, num_dyadic x); /**< of f(x); what the arena holds stays */

/** f divided by X - x as often as x is a root. */
num_poly num_poly_without(num_arena *arena, const num_poly *f, num_dyadic x);

/** Coefficient j of Bernstein of f, of degree n as f, times n over j: f is within their hull all over 0 .. 1. */
num_ball num_ball_poly_bernstein(const num_ball_poly *f, int j);
/** The sign of f all over 0 .. 1, if the coefficients of Bernstein have one and the same, else NUM_UNSURE. A zero is
 * never sure. */
int num_ball_poly_sign_throughout(const num_ball_poly *f);
/** f(x / 2), or f((x + 1) / 2): over a half of 0 .. 1. */
num_ball_poly num_ball_poly_half(const num_ball_poly *f, bool upper);
/** The signs of all coefficients of Bernstein, and how often they change; NUM_DEGREE + 1: not all are known. The
 * polynomial has no root between 0 and 1 with no change, and one with one (Descartes' rule). */
int num_ball_poly_changes(const num_ball_poly *f, int sign[NUM_DEGREE + 1]);

/** A signed remainder sequence. */
typedef struct num_chain {
    int count;
    num_poly p[NUM_DEGREE + 2];
} num_chain;
/** Of f and f' g, into *out, which is large; g NULL: 1. f not zero, not in *out, of degree <= NUM_DEGREE, as g. */
void num_chain_of(num_arena *arena, const num_poly *f, const num_poly *g, num_chain *out);
int num_chain_variations(num_arena *arena, const num_chain *chain, num_dyadic x); /**< the arena stays */

/** Limbs that suffice for all that is done with polynomials of that degree whose coefficients have up to `limbs` limbs,
 * at arguments of up to `argument` limbs. */
size_t num_poly_arena(int degree, size_t limbs, size_t argument);
#endif
