/* exact.h: exact counts beside a plane, of cells that a view shows whole.
 *
 * In a mesh six triangles have a vertex in common. A view knows every vertex once, so it is compared with the plane
 * once, and near planes that is dear: walls that are flat only up to a rounding are full of vertices which only exact
 * numbers tell from the plane. */
#ifndef FROE_SPLIT_SCORE_EXACT_H
#define FROE_SPLIT_SCORE_EXACT_H
#include "split/score/view.h"

/** cell_tally() of a cell without boxes and balls, all of which a view for sweeps shows; the exact classes are left in
 * the set, too. False: no memory. */
bool split_exact_tally(split_view *view, split_work *work, const split_cell *cell, const froe_cut *cut,
                       split_tally *out);
#endif
