/* waiting.c: cells are put off and taken up. */
#include "split/waiting.h"

void waiting_free(const froe_allocator *alloc, grow_task *task) {
    array_free(alloc, &task->items);
    array_free(alloc, &task->corners);
    array_free(alloc, &task->room);
    draft_free(&task->draft);
}

void waiting_free_all(const froe_allocator *alloc, grow_tasks *tasks) {
    for (size_t i = 0; i < tasks->count; i++) waiting_free(alloc, tasks->data + i);
    array_free(alloc, tasks);
}

froe_status waiting_put_off(size_t room, split_work *work, const split_cell *cell, grow_tasks *tasks) {
    const split_set *set = &work->set;
    const froe_allocator *alloc = &set->alloc;
    if (!array_push(alloc, tasks, (grow_task){.cell = *cell, .crossing = {FROE_NONE}})) return FROE_E_MEMORY;
    grow_task *task = tasks->data + tasks->count - 1;
    if (!array_append(alloc, &task->room, work->rooms.data, room)) return FROE_E_MEMORY;
    if (!array_reserve(alloc, &task->items, cell->count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < cell->count; i++) {
        split_fragment f = set->items.data[cell->first + i];
        const uint32_t first = f.first;
        f.first = f.count ? (uint32_t)task->corners.count : 0;
        if (f.count && !array_append(alloc, &task->corners, set->corners.data + first, f.count)) return FROE_E_MEMORY;
        task->items.data[task->items.count++] = f;
    }
    task->cell.first = 0;
    task->cell.corner_top = (uint32_t)task->corners.count;
    work->set.items.count = cell->first;
    return FROE_OK;
}

froe_status waiting_take_up(split_work *work, const grow_task *task) {
    split_set *set = &work->set;
    set->items.count = set->corners.count = work->cells.count = work->rooms.count = 0;
    return array_append(&set->alloc, &set->items, task->items.data, task->items.count) &&
                   array_append(&set->alloc, &set->corners, task->corners.data, task->corners.count) &&
                   array_append(&set->alloc, &work->rooms, task->room.data, task->room.count)
               ? FROE_OK
               : FROE_E_MEMORY;
}
