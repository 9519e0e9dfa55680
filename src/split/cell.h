/* cell.h: cutting one cell: its fragments are classified, divided and dealt to two new cells.
 *
 *     set->items   [ ... | covers | fragments of the cell ]     covers come first, and are listed at the node
 *
 *     +-----------------+   A cover is a box that contains the cell, or the bounds that axis-parallel cuts make of it,
 *     |  +--+  +-----+  |   which are exact. A box that contains all others of a cell can be separated from none of
 *     |  +--+  +-----+  |   them. Where a cell would be a leaf over capacity, cuts along the faces of that box turn it
 *     +-----------------+   into a cover, and what is left may be separable (Tobola and Nechvile's nested boxes).
 *
 * It speaks for cell.c and cover.c (what concerns covers). */
#ifndef FROE_SPLIT_CELL_H
#define FROE_SPLIT_CELL_H
#include "split/grow.h"
#include "split/score/price.h"

/** Ends a cell as a leaf with its list, and takes its fragments off the stack. */
froe_status cell_leaf(split_work *work, const split_cell *cell, uint8_t flags);
/** Turns the first `count` whole objects of the cell into fragments of it. */
froe_status cell_take(split_work *work, const split_lowest_nodes *lowest, split_cell *cell, uint32_t count);
/** How the cut would deal with the cell's fragments, exactly. */
froe_status cell_tally(split_work *work, const split_cell *cell, const froe_cut *cut, split_tally *out);
/** What a cut has to keep: it separates something, and splits no more than a charged cell may. */
typedef struct cell_limits {
    const split_thin_rule *thin;
    bool kept, useless; /**< out; neither: it would split too much */
} cell_limits;

/** Cuts a cell without whole objects. On success its fragments are replaced by those of the children, child 0
 * on top, and both children are pushed, child 0 last. Where the limits are not kept, nothing is done; NULL: the cell is
 * cut all the same. `flags`: TREE_GUARD, TREE_CHARGED. */
froe_status cell_cut(split_work *work, const split_cell *cell, const froe_cut *cut, uint8_t flags, cell_limits *limits);
/** Cuts a cell by its node of the guard tree, whatever that separates. */
froe_status cell_cut_guard(split_work *work, const split_job *job, split_cell *cell);
/** Moves the covers among a cell's fragments, which are on top, before the others; all keep their order. FROE_E_MEMORY.
 * O(fragments) in scenes with boxes. */
froe_status cover_find(split_set *set, split_cell *cell);
/** Begins the list of the cell's node, a leaf or split, with its covers. */
froe_status cover_emit(split_set *set, const split_cell *cell);
/** Takes the covers away from under the fragments of a cell. */
void cover_drop(split_set *set, split_cell *cell);
/** A cut along a face of a box that contains all other fragments of the cell; false: there is none, or the fragments
 * are too few to be worth the cuts. O(fragments). */
bool cover_peel(const split_set *set, const split_cell *cell, froe_cut *cut);
#endif
