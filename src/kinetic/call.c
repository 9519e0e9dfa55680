/* call.c: how a public call begins, goes on and ends. It may be cancelled, and it may run out of memory. Either leaves
 * the tree incomplete, and the next call makes it anew. */
#include "kinetic/live.h"
#include "support/fail.h"

void froe_kinetic_watch(froe_kinetic *k, froe_progress_fn *progress, void *user) {
    if (!k) return;
    k->options.progress = progress;
    k->options.user = user;
}

bool live_goes_on(froe_kinetic *k) {
    enum { SELDOM = 16 };
    if (++k->polls % SELDOM) return !base_cancelled(&k->task);
    return base_progress(&k->task, k->task.done);
}

froe_status live_fail(froe_kinetic *k, froe_diagnostic *diag) {
    if (!base_cancelled(&k->task)) return support_fail_memory(diag);
    return support_fail_cancelled(diag);
}

/* Forgets the certificates of ends, too, as they may be about pieces of plans that have ended since. */
static void make_anew(froe_kinetic *k) {
    k->short_of_memory = false;
    for (uint32_t s = 0; s < k->segments.count; s++) {
        live_forget_pairs(k, s);
        live_forget_ends(k, s);
        live_unroll(k, s);
        live_schedule(k, s);
        if (live_is_there(k, s)) live_enroll(k, s);
        live_poll(k);
    }
    if (!k->short_of_memory) live_restart(k);
}

froe_status live_settle(froe_kinetic *k, froe_diagnostic *diag) {
    if (k->short_of_memory && !base_cancelled(&k->task)) make_anew(k);
    return k->short_of_memory ? live_fail(k, diag) : FROE_OK;
}

froe_status live_begin(froe_kinetic *k, froe_diagnostic *diag) {
    base_task_init(&k->task, 1, k->options.progress, k->options.user);
    now_catch_up(&k->now);
    return live_settle(k, diag);
}
