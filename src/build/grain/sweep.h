/* sweep.h: all planes of a pencil at once: those through two points, or those across an axis.
 *
 *           \   |   /          seen along the line a-b every corner of the cell lies in one direction; a plane
 *        4   \  |  /   1       that turns about it meets the corners in the order of their directions,
 *             \ | /            and a fragment is split from the first of its corners met to the last
 *     ---------ab---------  0
 *             / | \            so one sort gives the counts for every plane through a, b and another vertex
 *        3   /  |  \   2
 *
 * O(corners) by radix sort, where counting beside each plane takes O(corners^2). Directions are rounded to 40 bits;
 * what is then equal counts as met together. That is coarse enough for corners of one plane to be met at once despite
 * the rounding of doubles, and fine enough to keep apart what was rounded to nine digits, or to floats, before it got
 * here. So counts are only nearly right: the winner is to be counted again. */
#ifndef FROE_BUILD_GRAIN_SWEEP_H
#define FROE_BUILD_GRAIN_SWEEP_H
#include "split/view.h"

typedef struct split_sweep {
    ARRAY(uint64_t) order, spare; /**< direction << 24 | corner, to be sorted */
    ARRAY(uint32_t) met;          /**< per corner: rank of its direction; top bit: on the negative side at first */
    ARRAY(uint32_t) at;           /**< per rank: a corner there, an input vertex if there is one */
    ARRAY(int32_t)
    change[3]; /**< per rank: how the numbers of fragments without negative corners, without positive
                  ones, without either change there */
} split_sweep;

enum { SPLIT_SWEEP_MOST = 1 << 24 }; /* corners in a sweep */

void split_sweep_free(const froe_allocator *alloc, split_sweep *sweep);
/** Of the planes through the axle, two vertices of the scene (in the plane: lines through one), and another vertex
 * shown, the one of least price: that vertex, or FROE_NONE when none separates anything. False: no memory. */
bool split_sweep_pencil(split_sweep *sweep, const split_set *set, const split_view *view, const split_price *price,
                        const split_terms *terms, const uint32_t *axle, uint32_t *best);
/** Of the planes across an axis through a vertex shown, the one of least price: that vertex, or FROE_NONE. Corners that
 * cuts made have no coordinates that a cut could take exactly, and the rounded ones depend on where the scene lies. */
bool split_sweep_axis(split_sweep *sweep, const split_set *set, const split_view *view, const split_price *price,
                      const split_terms *terms, int axis, uint32_t *best);
#endif
