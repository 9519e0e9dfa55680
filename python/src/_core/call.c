#include "call.h"
#include "errors.h"
#include <time.h>

/* Seconds between two looks at signals. The other threads of the program wait for the GIL meanwhile. */
static const double LOOK_EVERY = 0.02;

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void core_call_begin(core_call *call, PyObject *progress) {
    *call = (core_call){.progress = progress, .asked = now()};
    call->saved = PyEval_SaveThread();
}

/* Looks for signals and tells the share; false: an exception is set, or the function returned False, which may be that
 * of numpy: comparisons with its numbers give it. */
static bool look(const core_call *call, double done) {
    if (PyErr_CheckSignals()) return false;
    if (call->progress == Py_None) return true;
    PyObject *answer = PyObject_CallFunction(call->progress, "d", done);
    const bool goes_on = answer && PyObject_RichCompareBool(answer, Py_False, Py_EQ) == 0;
    Py_XDECREF(answer);
    return goes_on;
}

bool core_call_progress(void *user, double done) {
    core_call *call = user;
    const double time = now();
    if (call->type) return false;
    if (time - call->asked < LOOK_EVERY && done < 1) return true;
    PyGILState_STATE state = PyGILState_Ensure();
    const bool goes_on = look(call, done);
    if (!goes_on) PyErr_Fetch(&call->type, &call->value, &call->traceback);
    PyGILState_Release(state);
    call->asked = now();
    return goes_on;
}

bool core_call_end(core_call *call, froe_status status) {
    const bool full = call->pile && call->pile->full;
    PyEval_RestoreThread(call->saved);
    if (call->type)
        PyErr_Restore(call->type, call->value, call->traceback);
    else if (full)
        core_fail(FROE_E_MEMORY, "There is no memory for what the call has found.");
    else if (status)
        core_raise(status, &call->diag);
    return !call->type && !full && !status;
}
