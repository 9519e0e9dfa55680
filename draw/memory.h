/* memory.h: growable arrays from the caller's allocator, and how a failure gets its sentence. */
#ifndef FROE_DRAW_MEMORY_H
#define FROE_DRAW_MEMORY_H
#include "support/floats.h"
#include <froe/draw.h>

#define DRAW_ARRAY(T)                                                                                                  \
    struct {                                                                                                           \
        T *data;                                                                                                       \
        size_t count, capacity;                                                                                        \
    }
/** Room for `extra` more items; false without memory, the array as it was. */
#define draw_reserve(alloc, a, extra)                                                                                  \
    ((a)->capacity - (a)->count >= (size_t)(extra) ||                                                                  \
     draw_grow((alloc), (void **)&(a)->data, &(a)->capacity, (a)->count, (size_t)(extra), sizeof *(a)->data))
/** Appends a copy of an item. */
#define draw_push(alloc, a, ...) (draw_reserve((alloc), (a), 1) && ((a)->data[(a)->count++] = __VA_ARGS__, true))
#define draw_release(alloc, a)                                                                                         \
    (draw_free((alloc), (a)->data, (a)->capacity * sizeof *(a)->data), (a)->data = NULL, (a)->count = (a)->capacity = 0)

/** The caller's allocator, or malloc. */
froe_allocator draw_allocator(const froe_allocator *alloc);
/** Zeroed; NULL without memory. */
void *draw_calloc(const froe_allocator *alloc, size_t count, size_t item);
void draw_free(const froe_allocator *alloc, void *ptr, size_t size);
bool draw_grow(const froe_allocator *alloc, void **data, size_t *capacity, size_t count, size_t extra, size_t item);

/** A call in progress: it reports its progress now and then, and stops if the caller's function returns false. */
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

/** Fills `diag` (unless NULL) with a sentence and returns `status`. */
froe_status draw_fail(froe_diagnostic *diag, froe_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
froe_status draw_fail_memory(froe_diagnostic *diag);
#endif
