/* cell.h: cutting one cell: its fragments are classified, divided and dealt to two new cells. */
#ifndef FROE_SPLIT_CELL_H
#define FROE_SPLIT_CELL_H
#include "split/grow.h"

/** Ends a cell as a leaf with its list, and takes its fragments off the stack. */
froe_status cell_leaf(split_work *work, const split_cell *cell, uint8_t flags);
/** Cuts a cell. On success its fragments are replaced by those of the children, child 0 on
 * top, and both children are pushed. *useless: nothing was done, since every fragment
 * would have stayed on one side (never for SPLIT_GUARD cuts). */
froe_status cell_cut(split_work *work, const split_method *method, const split_cell *cell, const froe_cut *cut,
                     bool guard, bool *useless);
#endif
