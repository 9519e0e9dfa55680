/* gap.h: how far apart are two polytopes, and where?
 *
 * The distance of A and B is that of 0 from the hull of all differences a - b of corners. Its point
 * nearest to 0 lies in a simplex of at most dim + 1 of them, which is what is found (Gilbert, Johnson, Keerthi:
 * A fast procedure for computing the distance between complex objects, 1988). A search in plain
 * doubles guesses the simplex; the search in certified numbers starts there and usually just confirms
 * the guess; where it cannot tell, exact numbers go on from the same place. Every exact step comes strictly nearer,
 * so the search ends, however degenerate the corners.
 *
 * The same search answers two more questions (see contact.c): is 0 in the hull of some of the
 * differences, and is it modulo a direction? */
#ifndef FROE_GEOM_MEET_GAP_H
#define FROE_GEOM_MEET_GAP_H
#include "geom/body.h"

/** Which differences a_i - b_j count, in dimension 2 or 3. Zero-initialise for all of them. */
typedef struct geom_differences {
    const geom_body *a, *b;
    bool star;               /**< only those with one of the corners star_a, star_b, not with both; nonzero, too: */
    uint32_t star_a, star_b; /*     a cone's generators, when these two are one point */
    bool along;              /**< modulo the direction from[k] - to[k] */
    bool nonzero;            /**< leave out those that vanish (modulo that direction) */
    double from[3], to[3];
} geom_differences;

typedef struct geom_gap {
    bool zero;           /**< 0 is in the hull */
    int count;           /**< least number of differences whose hull holds the point nearest to 0: 1 .. 4 */
    uint32_t a[4], b[4]; /**< corners of these differences; affinely independent */
} geom_gap;

/** False: there is no difference. */
bool geom_gap_among(num_context *context, const geom_differences *set, geom_gap *out);

/** Of two polytopes (no balls) in the same dimension, 2 or 3. */
static inline geom_gap geom_gap_between(num_context *context, const geom_body *a, const geom_body *b) {
    geom_differences all = {.a = a, .b = b};
    geom_gap gap;
    geom_gap_among(context, &all, &gap);
    return gap;
}

/** The direction from the point of a that is nearest to b to that of b in plain doubles, with a longest coordinate of
 * 1. REQUIRES: gap of these two by geom_gap_between(), not zero. False: doubles over- or underflow. */
bool geom_gap_guess(const geom_body *a, const geom_body *b, const geom_gap *gap, double direction[3]);
#endif
