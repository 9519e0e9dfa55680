/* task.c: jobs on several threads.
 *
 * Workers claim job numbers from one counter, so whatever fails, every job with a
 * lower number has been claimed before and runs to its end: the lowest failing job
 * does not depend on the number of threads. The calling thread works too, and it alone
 * calls the progress callback. */
#include "base/task.h"
#include "base/floats.h"
#include <pthread.h>
#include <time.h>
#include <unistd.h>

enum { STACK_BYTES = 1 << 20, POLL_NANOSECONDS = 50 * 1000 * 1000 };
static const double STEP = 1.0 / 1024; /* least progress worth a callback */

/* One base_run() in progress. */
typedef struct job_run {
    base_task *task;
    base_job_fn *fn;
    void *user;
    size_t count;
    double start, span;
    atomic_size_t next, finished, failed; /* failed: lowest failing job so far */
    atomic_uint begun;                    /* threads other than the calling one that have their number */
    pthread_mutex_t lock;                 /* guards status, working */
    pthread_cond_t quiet;                 /* `working` reached 0 */
    froe_status status;                   /* of job `failed` */
    unsigned working;                     /* threads other than the calling one */
    base_floats_held caller;
} job_run;

void base_task_init(base_task *task, unsigned threads, froe_progress_fn *progress, void *user) {
    long processors = threads ? (long)threads : sysconf(_SC_NPROCESSORS_ONLN);
    task->progress = progress;
    task->user = user;
    task->threads = processors < 1 ? 1 : processors > BASE_THREADS_MAX ? BASE_THREADS_MAX : (unsigned)processors;
    task->done = 0;
    task->scale = 1;
    atomic_init(&task->cancelled, false);
}

bool base_progress(base_task *task, double done) {
    if (base_cancelled(task)) return false;
    if (done > task->done) task->done = done < 1 ? done : 1;
    if (!task->progress || base_callback(task->progress(task->user, task->done))) return true;
    atomic_store_explicit(&task->cancelled, true, memory_order_relaxed);
    return false;
}

static void note_failure(job_run *c, size_t job, froe_status status) {
    pthread_mutex_lock(&c->lock);
    if (job < atomic_load(&c->failed)) {
        atomic_store(&c->failed, job);
        c->status = status;
    }
    pthread_mutex_unlock(&c->lock);
}

/* Does one more job; false when there is none left to do. */
static bool work_on_jobs(job_run *c, unsigned worker) {
    if (base_cancelled(c->task)) return false;
    size_t job = atomic_fetch_add(&c->next, 1);
    if (job >= c->count || job > atomic_load(&c->failed)) return false;
    froe_status status = c->fn(c->user, worker, job);
    if (status != FROE_OK) note_failure(c, job, status);
    atomic_fetch_add(&c->finished, 1);
    return true;
}

static void report_progress(job_run *c, bool always) {
    double share = (double)atomic_load(&c->finished) / (double)c->count;
    double done = c->start + c->span * share;
    if (always || done >= c->task->done + STEP) base_progress(c->task, done);
}

static void *run_worker(void *argument) {
    job_run *c = argument;
    const unsigned worker = atomic_fetch_add(&c->begun, 1) + 1;
    base_floats_begin_thread(c->caller);
    while (work_on_jobs(c, worker)) {
    }
    pthread_mutex_lock(&c->lock);
    if (--c->working == 0) pthread_cond_signal(&c->quiet);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

/* Starts up to `wanted` threads, fewer if the system refuses. */
static unsigned start_threads(job_run *c, unsigned wanted, pthread_t *threads) {
    pthread_attr_t attr;
    unsigned started = 0;
    if (pthread_attr_init(&attr) != 0) return 0;
    (void)pthread_attr_setstacksize(&attr, STACK_BYTES);
    pthread_mutex_lock(&c->lock);
    for (; started < wanted; started++) {
        if (pthread_create(&threads[started], &attr, run_worker, c) != 0) break;
        c->working++;
    }
    pthread_mutex_unlock(&c->lock);
    pthread_attr_destroy(&attr);
    return started;
}

/* Waits until the other threads are done; reports progress meanwhile, so that the callback can cancel. */
static void wait_for_quiet(job_run *c) {
    pthread_mutex_lock(&c->lock);
    while (c->working) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += POLL_NANOSECONDS;
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        pthread_cond_timedwait(&c->quiet, &c->lock, &until);
        pthread_mutex_unlock(&c->lock);
        report_progress(c, true);
        pthread_mutex_lock(&c->lock);
    }
    pthread_mutex_unlock(&c->lock);
}

static void run_on_threads(job_run *c, unsigned others) {
    pthread_t threads[BASE_THREADS_MAX];
    unsigned started = others ? start_threads(c, others, threads) : 0;
    while (work_on_jobs(c, 0)) report_progress(c, false);
    if (started) wait_for_quiet(c);
    for (unsigned i = 0; i < started; i++) pthread_join(threads[i], NULL);
}

froe_status base_run(base_task *task, double span, size_t count, base_job_fn *fn, void *user) {
    if (base_cancelled(task)) return FROE_E_CANCELLED;
    if (!count) return base_progress(task, task->done + span * task->scale) ? FROE_OK : FROE_E_CANCELLED;
    job_run c = {.task = task,
                 .fn = fn,
                 .user = user,
                 .count = count,
                 .start = task->done,
                 .span = span * task->scale,
                 .caller = base_floats_of_caller()};
    atomic_init(&c.begun, 0);
    atomic_init(&c.next, 0);
    atomic_init(&c.finished, 0);
    atomic_init(&c.failed, SIZE_MAX);
    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.quiet, NULL);
    run_on_threads(&c, count < task->threads ? (unsigned)count - 1 : task->threads - 1);
    pthread_cond_destroy(&c.quiet);
    pthread_mutex_destroy(&c.lock);
    if (base_cancelled(task)) return FROE_E_CANCELLED;
    if (c.status != FROE_OK) return c.status;
    return base_progress(task, c.start + c.span) ? FROE_OK : FROE_E_CANCELLED;
}
