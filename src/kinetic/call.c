/* call.c: a public call while it is under way. */
#include "kinetic/call.h"
#include "support/fail.h"

bool call_goes_on(kinetic_call *call) {
    enum { SELDOM = 16 };
    if (++call->polls % SELDOM) return !base_cancelled(&call->task);
    return base_progress(&call->task, call->task.done);
}

froe_status call_fail(kinetic_call *call, froe_diagnostic *diag) {
    return base_cancelled(&call->task) ? support_fail_cancelled(diag) : support_fail_memory(diag);
}
