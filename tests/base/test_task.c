/* test_task.c: every job runs once, failures and cancelling do not depend on luck, and
 * progress is the calling thread's alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>
#include <pthread.h>
#include <time.h>

#include "base/task.h"

enum { JOBS = 2000, WORKERS = 7 };

typedef struct log {
    base_task task;
    atomic_uint ran[JOBS];
    atomic_uint busy[WORKERS]; /* no worker does two jobs at once */
    size_t fails[2];           /* jobs that fail, SIZE_MAX: none */
    pthread_t caller;
    double last;
    unsigned reports, stop_after;
} log;

static bool on_progress(void *user, double done) {
    log *l = user;
    if (!pthread_equal(pthread_self(), l->caller) || done < l->last || done > 1) abort();
    l->last = done;
    l->reports++;
    return !l->stop_after || l->reports < l->stop_after;
}

static void begin(log *l, unsigned threads, bool with_progress) {
    *l = (log){.fails = {SIZE_MAX, SIZE_MAX}, .caller = pthread_self()};
    base_task_init(&l->task, threads, with_progress ? on_progress : NULL, l);
}

static froe_status job(void *user, unsigned worker, size_t number) {
    log *l = user;
    if (worker >= l->task.threads || atomic_fetch_add(&l->busy[worker], 1) != 0) abort();
    atomic_fetch_add(&l->ran[number], 1);
    if (number % 64 == 0) nanosleep(&(struct timespec){0, 20000}, NULL);
    atomic_fetch_sub(&l->busy[worker], 1);
    return number == l->fails[0] ? FROE_E_LIMIT : number == l->fails[1] ? FROE_E_INPUT : FROE_OK;
}

static void every_job_runs_exactly_once(void **state) {
    (void)state;
    static log l;
    for (unsigned threads = 1; threads <= WORKERS; threads += 2) {
        begin(&l, threads, true);
        assert_int_equal(base_run(&l.task, 0.25, JOBS, job, &l), FROE_OK);
        for (size_t i = 0; i < JOBS; i++) assert_int_equal(l.ran[i], 1);
        assert_true(l.last == 0.25 && l.task.done == 0.25);
        assert_int_equal(base_run(&l.task, 0.75, 3, job, &l), FROE_OK);
        assert_true(l.last == 1);
        assert_int_equal(l.ran[2], 2);
        assert_int_equal(l.ran[3], 1);
    }
}

static void the_lowest_failing_job_gives_the_status(void **state) {
    (void)state;
    static log l;
    for (int round = 0; round < 40; round++) {
        begin(&l, 1 + (unsigned)round % WORKERS, round % 2);
        l.fails[0] = 700 + (size_t)round % 3; /* FROE_E_LIMIT */
        l.fails[1] = round % 4 < 2 ? 699 : 706;
        froe_status status = base_run(&l.task, 1, JOBS, job, &l);
        assert_int_equal(status, round % 4 < 2 ? FROE_E_INPUT : FROE_E_LIMIT);
        size_t lowest = l.fails[0] < l.fails[1] ? l.fails[0] : l.fails[1];
        for (size_t i = 0; i <= lowest; i++) assert_int_equal(l.ran[i], 1);
        for (size_t i = lowest + 1; i < JOBS; i++) assert_true(l.ran[i] <= 1);
    }
}

static void the_callback_cancels_for_good(void **state) {
    (void)state;
    static log l;
    for (unsigned threads = 1; threads <= WORKERS; threads += 3) {
        begin(&l, threads, true);
        l.stop_after = threads == 1 ? 3 : 1; /* with more threads, one report is all that is certain */
        assert_int_equal(base_run(&l.task, 1, JOBS, job, &l), FROE_E_CANCELLED);
        assert_true(base_cancelled(&l.task));
        assert_int_equal(l.reports, l.stop_after);
        assert_false(base_progress(&l.task, 1));
        assert_int_equal(base_run(&l.task, 1, JOBS, job, &l), FROE_E_CANCELLED);
        assert_int_equal(base_run(&l.task, 1, 0, job, &l), FROE_E_CANCELLED);
        assert_int_equal(l.reports, l.stop_after);
        for (size_t i = 0; i < JOBS; i++) assert_true(l.ran[i] <= 1);
    }
}

static void nap(void) {
    nanosleep(&(struct timespec){0, 1000000}, NULL);
}

/* The calling thread's job ends once the other thread has begun; that one's when cancelled. */
static froe_status endless_elsewhere(void *user, unsigned worker, size_t number) {
    log *l = user;
    (void)number;
    atomic_fetch_add(&l->ran[worker], 1);
    if (worker == 0)
        while (!l->ran[1]) nap();
    else
        while (!base_cancelled(&l->task)) nap();
    return FROE_OK;
}

static bool stop_once_both_work(void *user, double done) {
    log *l = user;
    (void)done;
    return !(l->ran[0] && l->ran[1]);
}

static void cancelling_works_while_only_another_thread_is_busy(void **state) {
    (void)state;
    static log l;
    begin(&l, 2, false);
    base_task_init(&l.task, 2, stop_once_both_work, &l);
    assert_int_equal(base_run(&l.task, 1, 2, endless_elsewhere, &l), FROE_E_CANCELLED);
    assert_int_equal(l.ran[0] + l.ran[1], 2);
}

static bool only_reports(void *user, double done) {
    double *last = user;
    assert_true(done >= *last);
    *last = done;
    return true;
}

static void progress_never_falls_and_stays_within_one(void **state) {
    (void)state;
    base_task task;
    double last = 0;
    base_task_init(&task, 1, only_reports, &last);
    assert_true(base_progress(&task, 0.5));
    assert_true(base_progress(&task, 0.25));
    assert_true(last == 0.5);
    assert_true(base_progress(&task, 7));
    assert_true(last == 1);
}

static void zero_threads_means_one_per_processor(void **state) {
    (void)state;
    base_task task;
    base_task_init(&task, 0, NULL, NULL);
    assert_in_range(task.threads, 1, BASE_THREADS_MAX);
    base_task_init(&task, 1000000, NULL, NULL);
    assert_int_equal(task.threads, BASE_THREADS_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_job_runs_exactly_once),
        cmocka_unit_test(the_lowest_failing_job_gives_the_status),
        cmocka_unit_test(the_callback_cancels_for_good),
        cmocka_unit_test(cancelling_works_while_only_another_thread_is_busy),
        cmocka_unit_test(progress_never_falls_and_stays_within_one),
        cmocka_unit_test(zero_threads_means_one_per_processor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
