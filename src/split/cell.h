/* cell.h: cutting one cell: its fragments are classified, divided and dealt to two new cells. */
#ifndef FROE_SPLIT_CELL_H
#define FROE_SPLIT_CELL_H
#include "split/grow.h"
#include "split/price.h"

/** Ends a cell as a leaf with its list, and takes its fragments off the stack. */
froe_status cell_leaf(split_work *work, const split_cell *cell, uint8_t flags);
/** Turns the first `count` whole objects of the cell into fragments of it. */
froe_status cell_take(split_work *work, const split_lowest_nodes *lowest, split_cell *cell, uint32_t count);
/** How the cut would deal with the cell's fragments, exactly. */
froe_status cell_tally(split_work *work, const split_cell *cell, const froe_cut *cut, split_tally *out);
/** Cuts a cell without whole objects. On success its fragments are replaced by those of the children, child 0
 * on top, and both children are pushed, child 0 last. *useless: nothing was done, since every fragment would have
 * stayed on one side; NULL: the cell is cut all the same. `flags`: TREE_GUARD. */
froe_status cell_cut(split_work *work, const split_cell *cell, const froe_cut *cut, uint8_t flags, bool *useless);
/** Cuts a cell by its node of the guard tree, whatever that separates. */
froe_status cell_cut_guard(split_work *work, const split_job *job, split_cell *cell);
#endif
