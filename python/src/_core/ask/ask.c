#include "ask/ask.h"
#include <stdio.h>

bool core_ask_begin(core_ask *ask, PyObject *self, const char *name, PyObject *const *args, Py_ssize_t given,
                    Py_ssize_t wanted) {
    memset(ask, 0, sizeof *ask);
    if (!core_arguments(name, given, wanted)) return false;
    ask->options = froe_batch_defaults();
    if (!core_unsigned(args[wanted - 2], "threads", UINT32_MAX, &ask->options.threads)) return false;
    ask->progress = args[wanted - 1];
    ask->tree = (core_tree *)self;
    ask->query = core_tree_take(ask->tree);
    if (ask->query) ask->dim = (size_t)froe_scene_dim(froe_tree_scene(core_tree_of(ask->tree)));
    return ask->query;
}

void core_ask_end(core_ask *ask) {
    for (size_t i = 0; i < ASK_INPUTS; i++) core_input_give(&ask->in[i]);
    core_tree_give(ask->tree, ask->query);
}

void core_ask_run(core_ask *ask) {
    core_call_begin(&ask->call, ask->progress);
    ask->options.progress = core_call_progress;
    ask->options.user = &ask->call;
}

/* A batch tells which question is to blame by its position, and its message is that of a single question. */
static void name_question(froe_diagnostic *diag) {
    char sentence[sizeof diag->message];
    memcpy(sentence, diag->message, sizeof sentence);
    const int length = snprintf(diag->message, sizeof diag->message, "question %u: ", diag->object);
    snprintf(diag->message + length, sizeof diag->message - (size_t)length, "%s", sentence);
}

bool core_ask_ran(core_ask *ask, froe_status status) {
    if ((status == FROE_E_INPUT || status == FROE_E_ARG) && ask->call.diag.object != FROE_NONE)
        name_question(&ask->call.diag);
    return core_call_end(&ask->call, status);
}

bool core_ask_points(core_ask *ask, PyObject *points) {
    return core_input_take(&ask->in[0], points, "points", 'd', ask->dim, false);
}

static void free_answers(void *block) {
    froe_answers_free(block);
}

PyObject *core_ask_answers(core_ask *ask, froe_status status, const froe_answers *answers) {
    if (!core_ask_ran(ask, status)) return NULL;
    const size_t queries = answers->queries, count = answers->starts[queries];
    PyObject *owner = core_owner(answers, sizeof *answers, free_answers);
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, answers->starts, "q", queries + 1, 0, 0),
                         core_array(owner, answers->ids, "i", count, 0, 0),
                         answers->values ? core_array(owner, answers->values, "d", count, 0, 0) : Py_NewRef(Py_None)};
    Py_DECREF(owner);
    return core_tuple(3, parts);
}

PyObject *core_ask_array(core_ask *ask, froe_status status, void *results, const char *format, size_t count,
                         size_t width) {
    if (core_ask_ran(ask, status)) return core_array_of(results, format, count, width);
    core_release(results, core_array_bytes(format, count, width), 1);
    return NULL;
}

PyObject *core_ask_rows(PyObject *self, const char *name, const char *what, size_t corners, core_rows_fn *batch,
                        PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, name, args, count, 3)) return NULL;
    const core_input *rows = &ask.in[0];
    if (core_input_take(&ask.in[0], args[0], what, 'd', corners * ask.dim, false)) {
        froe_answers answers;
        core_ask_run(&ask);
        const froe_status status = batch(ask.query, rows->data, rows->count, &ask.options, &answers, &ask.call.diag);
        answer = core_ask_answers(&ask, status, &answers);
    }
    core_ask_end(&ask);
    return answer;
}
