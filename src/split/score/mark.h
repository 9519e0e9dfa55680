/* mark.h: walls that are flat only up to a rounding.
 *
 *      ____________      The corners of a wall were turned, and rounded: they lie in no plane. A plane through three
 *     /\    /\    /\     of them seems to hold all triangles of the wall, for doubles cannot tell, and in truth splits
 *    /__\__/__\__/__\    most of them. No cut along the wall is cheap; cuts across it are, through its edges.
 *
 * Where exact numbers refute such a plane, the fragments that they do not find in it are marked for the rest of the
 * contest. Counts and sweeps then take a marked fragment for split wherever all of its corners seem to lie in the
 * plane. So one refutation makes the false plane dear wherever it is met again, with other vertices or in other
 * pencils. Fragments that are tiny beside the cell are never marked. */
#ifndef FROE_SPLIT_SCORE_MARK_H
#define FROE_SPLIT_SCORE_MARK_H
#include "split/score/view.h"

/** How much of the cell a wall is wide at least: planes that are meant to be one differ by 2^-48 of it. */
#define SPLIT_WIDE 0x1p-14

/** Marks the fragments shown that doubles put in the plane of the cut and exact numbers do not. With the first mark,
 * a view for sweeps shows the outermost vertices of the scene, too: a cell that holds nothing but one wall has no other
 * vertex off the wall to lay a plane across it. `classes`: exact, of all fragments of the cell; NULL: they are found
 * here, of those that matter. False: no memory. */
bool split_mark(split_view *view, split_work *work, const split_cell *cell, const froe_cut *cut,
                const split_view_plane *plane, const uint8_t *classes);
/** split_view_count() of a supporting plane: in that of its own object no fragment is split, marked or not. */
split_tally split_mark_count_support(split_view *view, const split_set *set, const split_cell *cell, uint32_t object,
                                     const split_view_plane *plane);
#endif
