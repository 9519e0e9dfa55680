/* step.h: one step of the growth of a tree, the cell at hand, and its room, in which a method keeps what it likes.
 *
 *     rooms     [ at hand | pending cell 0 | pending cell 1 | ... ]     method->room bytes each */
#ifndef FROE_SPLIT_STEP_H
#define FROE_SPLIT_STEP_H
#include "split/cell.h"

/** Makes the rooms of the cell at hand and of all pending cells as many as there are. False without memory. */
bool step_fit_rooms(const split_method *method, split_work *work);
/** Empties the rooms of the cells that were pushed from number `first` on without being divided here. FROE_E_MEMORY. */
froe_status step_empty_rooms(const split_method *method, split_work *work, size_t first);
/** Cuts the cell and fills the rooms of its children. As cell_cut(). */
froe_status step_divide(const split_method *method, split_work *work, const split_cell *cell, const froe_cut *cut,
                        uint8_t flags, cell_limits *limits);
#endif
