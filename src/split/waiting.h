/* waiting.h: cells whose turn comes later, with fragments of their own, so that any thread can go on with them. */
#ifndef FROE_SPLIT_WAITING_H
#define FROE_SPLIT_WAITING_H
#include "base/apart.h"
#include "split/cell.h"

/** A cell that waits, with its fragments; small ones become subtrees. */
typedef struct grow_task {
    split_cell cell;
    ARRAY(split_fragment) items;
    ARRAY(split_corner) corners;
    ARRAY(unsigned char) room;
    split_choice choice;  /**< of large ones */
    uint32_t crossing[2]; /**< why it was refused */
    tree_draft draft;
    base_apart apart;
} grow_task;

typedef ARRAY(grow_task) grow_tasks;

/** Moves the fragments of the cell at hand, and its room of `room` bytes, to the end of `tasks`. FROE_E_MEMORY. */
froe_status waiting_put_off(size_t room, split_work *work, const split_cell *cell, grow_tasks *tasks);
/** Makes a cell that was put off the only one that is pending, at hand. FROE_E_MEMORY. */
froe_status waiting_take_up(split_work *work, const grow_task *task);
void waiting_free(const froe_allocator *alloc, grow_task *task);
void waiting_free_all(const froe_allocator *alloc, grow_tasks *tasks);
#endif
