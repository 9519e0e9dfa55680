/* call.h: long calls: without the GIL, with progress, and ended by Ctrl-C. */
#ifndef FROE_CORE_CALL_H
#define FROE_CORE_CALL_H
#include "memory.h"

typedef struct core_call {
    PyObject *progress; /**< a function of the share done, or None; borrowed */
    PyThreadState *saved;
    double asked;                       /**< when signals were looked at last, in seconds */
    froe_diagnostic diag;               /**< for what is called */
    const core_pile *pile;              /**< that the call fills, or NULL. Where it is full, there is no memory */
    PyObject *type, *value, *traceback; /**< an exception that ended the call */
} core_call;

/** From here on the thread works without the GIL. `progress` (None: none) has to live until core_call_end(). */
void core_call_begin(core_call *call, PyObject *progress);
/** A froe_progress_fn whose `user` is the call: takes the GIL some fifty times a second, looks for signals, and tells
 * the share done to the function, which ends the call where it returns False. */
bool core_call_progress(void *call, double done);
/** Takes the GIL again. false: an exception is set, that of a signal or of the progress function, or that of the
 * failure, which `diag` describes. */
bool core_call_end(core_call *call, froe_status status);
#endif
