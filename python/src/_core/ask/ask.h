/* ask.h: what all batches of questions have in common. A method takes its arguments, of which the last two are threads
 * and progress, between ask_begin() and ask_end(), and runs between ask_run() and ask_ran(). */
#ifndef FROE_CORE_ASK_H
#define FROE_CORE_ASK_H
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"

enum { ASK_INPUTS = 4 };

typedef struct core_ask {
    core_tree *tree;
    froe_query *query;
    size_t dim;
    froe_batch_options options;
    PyObject *progress;
    core_call call;
    core_input in[ASK_INPUTS];
} core_ask;

/** Takes a context and the last two of `wanted` arguments. false: an exception is set, and nothing is to be ended. */
bool core_ask_begin(core_ask *ask, PyObject *self, const char *name, PyObject *const *args, Py_ssize_t given,
                    Py_ssize_t wanted);
/** Gives back the context and the inputs. */
void core_ask_end(core_ask *ask);
/** The call begins to run, without the GIL. */
void core_ask_run(core_ask *ask);
/** false: it has failed, and an exception is set. */
bool core_ask_ran(core_ask *ask, froe_status status);
/** The same, and then the answers, which it takes, as the tuple (starts, ids, values or None). */
PyObject *core_ask_answers(core_ask *ask, froe_status status, const froe_answers *answers);
/** The same, and then the results as an array. Takes their memory, from core_allocate(), also on failure. */
PyObject *core_ask_array(core_ask *ask, froe_status status, void *results, const char *format, size_t count,
                         size_t width);
/** The first input's rows of dim doubles are points. */
bool core_ask_points(core_ask *ask, PyObject *points);

/** A batch whose questions are rows of doubles and nothing else. */
typedef froe_status core_rows_fn(froe_query *query, const double *rows, size_t count, const froe_batch_options *options,
                                 froe_answers *out, froe_diagnostic *diag);
/** All of a method with the arguments rows, threads and progress. A row has `corners` times dim doubles. Messages call
 * the rows `what`. */
PyObject *core_ask_rows(PyObject *self, const char *name, const char *what, size_t corners, core_rows_fn *batch,
                        PyObject *const *args, Py_ssize_t count);
#endif
