/* sweep.h: all planes of a pencil at once: those through two points, or those across an axis.
 *
 *           \   |   /          seen along the line a-b every corner of the cell lies in one direction; a plane
 *        4   \  |  /   1       that turns about it meets the corners in the order of their directions,
 *             \ | /            and a fragment is split from the first of its corners met to the last
 *     ---------ab---------  0
 *             / | \            so one turn gives the counts for every plane through a, b and another vertex
 *        3   /  |  \   2
 *
 * Directions fall into buckets (bucket.h), so nothing is sorted but the corners of the few buckets that may hold the
 * best plane, by directions rounded to 40 bits; what is then equal counts as met together. That is coarse enough for
 * corners of one plane to be met at once despite the rounding of doubles, and fine enough to keep apart what was
 * rounded to nine digits, or to floats, before it got here. So counts are only nearly right: the winner is to be
 * counted again. O(corners + fragments). */
#ifndef FROE_BUILD_GRAIN_SWEEP_H
#define FROE_BUILD_GRAIN_SWEEP_H
#include "build/grain/bucket.h"

typedef struct split_sweep {
    ARRAY(double) place; /**< per corner: where it is met, see sweep.c */
    ARRAY(double) apart; /**< per corner: about how far from the axle */
    ARRAY(int32_t) spot; /**< per corner: its bucket, with SWEEP_NEGATIVE; 0: it lies in every plane */
    sweep_buckets turn, refined;
    ARRAY(uint64_t) order, spare; /**< of the corners of a bucket: place << 24 | corner, sorted */
} split_sweep;

/** The best of a pencil. */
typedef struct split_sweep_best {
    uint32_t vertex; /**< FROE_NONE: there is none */
    double cost;
    split_tally tally; /**< as far as sweeps tell */
} split_sweep_best;

void split_sweep_free(const froe_allocator *alloc, split_sweep *sweep);
/** Of the planes through the axle, two vertices of the scene (in the plane: lines through one), and another vertex
 * of the part of the view, the one of least price, if that is below `limit`. `prices` are those of the part. False: no
 * memory. */
bool split_sweep_pencil(split_sweep *sweep, const split_set *set, const split_view *view, const split_view_part *part,
                        const split_prices *prices, const uint32_t *axle, double limit, split_sweep_best *best);
/** Of the planes across an axis through a vertex of the cell, the same. Corners that cuts made have no coordinates that
 * a cut could take exactly, and the rounded ones depend on where the scene lies. */
bool split_sweep_axis(split_sweep *sweep, const split_set *set, const split_view *view, const split_prices *prices,
                      int axis, split_sweep_best *best);
#endif
