/* ask.c: batches of questions, whose answers are arrays of froe's own memory. */
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"

static void free_answers(void *block) {
    froe_answers_free(block);
}

/* (starts, ids, values or None) */
static PyObject *answers_object(const froe_answers *answers) {
    PyObject *owner = core_owner(answers, sizeof *answers, free_answers);
    if (!owner) return NULL;
    const size_t count = answers->starts[answers->queries];
    PyObject *starts = core_array(owner, answers->starts, "q", answers->queries + 1, 0, 0);
    PyObject *ids = core_array(owner, answers->ids, "i", count, 0, 0);
    PyObject *values = answers->values ? core_array(owner, answers->values, "d", count, 0, 0) : Py_NewRef(Py_None);
    Py_DECREF(owner);
    if (starts && ids && values) return Py_BuildValue("NNN", starts, ids, values);
    Py_XDECREF(starts), Py_XDECREF(ids), Py_XDECREF(values);
    return NULL;
}

/* args: boxes, threads, progress */
PyObject *core_ask_boxes(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    if (!core_arguments("boxes", count, 3)) return NULL;
    froe_query *query = core_tree_take(self);
    if (!query) return NULL;
    const size_t dim = (size_t)froe_scene_dim(froe_tree_scene(core_tree_of(self)));
    froe_batch_options options = froe_batch_defaults();
    options.threads = (unsigned)PyLong_AsUnsignedLong(args[1]);
    core_input boxes = {0};
    froe_answers answers;
    bool done = !PyErr_Occurred() && core_input_take(&boxes, args[0], "boxes", 'd', 2 * dim, false);
    if (done) {
        core_call call;
        froe_diagnostic diag;
        core_call_begin(&call, args[2]);
        options.progress = core_call_progress, options.user = &call;
        const froe_status status = froe_batch_boxes(query, boxes.data, boxes.count, &options, &answers, &diag);
        done = core_call_end(&call, status, &diag);
    }
    core_input_give(&boxes);
    core_tree_give(self, query);
    return done ? answers_object(&answers) : NULL;
}
