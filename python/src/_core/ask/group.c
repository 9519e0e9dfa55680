/* group.c: how the groups of a tree lie to boxes, and to the groups of another tree. (To other ranges: range.c.) */
#include "ask/ask.h"

/* group_boxes(relation, boxes, threads, progress): exact windows as plain doubles */
PyObject *core_ask_group_boxes(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    uint32_t relation;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "group_boxes", args, count, 4)) return NULL;
    const core_input *boxes = &ask.in[0];
    if (core_unsigned(args[0], "relation", FROE_RELATION_COUNT - 1, &relation) &&
        core_input_take(&ask.in[0], args[1], "boxes", 'd', 2 * ask.dim, false)) {
        froe_answers answers;
        core_ask_run(&ask);
        const froe_status status = froe_batch_groups_boxes(ask.query, boxes->data, boxes->count, relation, &ask.options,
                                                           &answers, &ask.call.diag);
        answer = core_ask_answers(&ask, status, &answers);
    }
    core_ask_end(&ask);
    return answer;
}

static PyObject *ask_join(core_ask *ask, core_tree *other, froe_relation relation) {
    froe_query *questions = core_tree_take(other);
    if (!questions) return NULL;
    froe_answers answers;
    core_ask_run(ask);
    const froe_status status =
        froe_batch_groups_join(ask->query, questions, relation, &ask->options, &answers, &ask->call.diag);
    PyObject *answer = core_ask_answers(ask, status, &answers);
    core_tree_give(other, questions);
    return answer;
}

/* group_join(relation, tree of the groups asked about, threads, progress) */
PyObject *core_ask_group_join(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    uint32_t relation;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "group_join", args, count, 4)) return NULL;
    core_tree *other = core_tree_from(args[1]);
    if (other && core_unsigned(args[0], "relation", FROE_RELATION_COUNT - 1, &relation))
        answer = ask_join(&ask, other, relation);
    core_ask_end(&ask);
    return answer;
}
