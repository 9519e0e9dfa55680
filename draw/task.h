/* task.h: a call in progress: it reports progress now and then, and stops if the caller's function returns false. */
#ifndef FROE_DRAW_TASK_H
#define FROE_DRAW_TASK_H
#include "support/array.h"
#include "support/floats.h"

typedef struct draw_task {
    froe_progress_fn *progress; /**< may be NULL */
    void *user;
    double total; /**< ticks expected */
    uint64_t ticks;
    bool cancelled;
} draw_task;

/** One step done; false once the caller's function returned false. */
static inline bool draw_tick(draw_task *task) {
    if (++task->ticks % 16384 || !task->progress || task->cancelled) return !task->cancelled;
    const double share = (double)task->ticks / task->total;
    volatile const double done = share < 1 ? share : 1;
    task->cancelled = !support_callback(task->progress(task->user, done));
    return !task->cancelled;
}
#endif
