/* task.h: a long call in progress: cancel, progress, and work on several threads. */
#ifndef FROE_BASE_TASK_H
#define FROE_BASE_TASK_H
#include <froe/froe.h>
#include <stdatomic.h>

#define BASE_THREADS_MAX 256

typedef struct base_task {
    froe_progress_fn *progress; /**< may be NULL; called from the calling thread only */
    void *user;
    unsigned threads;      /**< 1 .. BASE_THREADS_MAX */
    double done, scale;    /**< share reported so far (never falls); factor on the spans of base_run(), 1 at first */
    atomic_bool cancelled; /**< workers poll it with base_cancelled() */
} base_task;

/** threads 0: one per processor. */
void base_task_init(base_task *task, unsigned threads, froe_progress_fn *progress, void *user);
/** Reports the share done; false (for good) once the callback returned false. Calling thread only. */
bool base_progress(base_task *task, double done);
static inline bool base_cancelled(base_task *task) {
    return atomic_load_explicit(&task->cancelled, memory_order_relaxed);
}

/** How many workers base_run() may have for so many jobs: 1 at least. */
static inline unsigned base_workers(const base_task *task, size_t jobs) {
    return jobs < 1 ? 1 : jobs < task->threads ? (unsigned)jobs : task->threads;
}

/** One job of many; `worker` < threads names the worker's private state; 0 is the calling thread. */
typedef froe_status base_job_fn(void *user, unsigned worker, size_t job);
/** Runs jobs 0..count-1, in any order, on task->threads threads (the calling one
 * included), and reports progress from `done` to `done + span * scale`. Returns the status
 * of the lowest-numbered failing job; later jobs may then not have run. FROE_E_CANCELLED when
 * the callback returns false. Falls back to fewer threads when the system gives none: never
 * fails by itself. Not to be called from a job. */
froe_status base_run(base_task *task, double span, size_t count, base_job_fn *fn, void *user);
#endif
