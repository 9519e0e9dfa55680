/* point.c: what is at points, nearest to them, above them; and which objects meet one another. */
#include "ask/ask.h"

/* locate(points, threads, progress) */
PyObject *core_ask_locate(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    return core_ask_rows(self, "locate", "points", 1, froe_batch_locate, args, count);
}

/* groups(points, threads, progress) */
PyObject *core_ask_groups(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    return core_ask_rows(self, "groups", "points", 1, froe_batch_groups, args, count);
}

/* near(points, k, bound, threads, progress) */
PyObject *core_ask_near(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    PyObject *answer = NULL;
    uint32_t k;
    double bound;
    if (!core_ask_begin(&ask, self, "near", args, count, 5)) return NULL;
    const core_input *points = &ask.in[0];
    if (core_double(args[2], "max_distance", &bound) && core_unsigned(args[1], "k", UINT32_MAX, &k) &&
        core_ask_points(&ask, args[0])) {
        froe_answers answers;
        core_ask_run(&ask);
        const froe_status status =
            froe_batch_near(ask.query, points->data, points->count, k, bound, &ask.options, &answers, &ask.call.diag);
        answer = core_ask_answers(&ask, status, &answers);
    }
    core_ask_end(&ask);
    return answer;
}

static PyObject *ask_vertical(core_ask *ask, int direction) {
    const core_input *points = &ask->in[0];
    uint32_t *objects = core_allocate(points->count, sizeof *objects);
    if (!objects) return NULL;
    core_ask_run(ask);
    const froe_status status = froe_batch_vertical(ask->query, points->data, points->count, direction, &ask->options,
                                                   objects, &ask->call.diag);
    return core_ask_array(ask, status, objects, "i", points->count, 0);
}

/* vertical(points, below, threads, progress) */
PyObject *core_ask_vertical(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "vertical", args, count, 4)) return NULL;
    bool below;
    if (core_flag(args[1], &below) && core_ask_points(&ask, args[0])) answer = ask_vertical(&ask, below ? -1 : 1);
    core_ask_end(&ask);
    return answer;
}

/* Without the GIL. Points and objects are as many. */
static froe_status find_nearest(core_ask *ask, const core_input *objects, double *nearest) {
    const uint32_t *ids = objects->data;
    const double *points = ask->in[0].data;
    for (size_t i = 0; i < objects->count; i++) {
        if (i % 1024 == 0 && !core_call_progress(&ask->call, (double)i / (double)objects->count))
            return FROE_E_CANCELLED;
        const froe_status status = froe_query_nearest_point(ask->query, ids[i], points + i * ask->dim,
                                                            nearest + i * ask->dim, &ask->call.diag);
        if (status) ask->call.diag.object = (uint32_t)i;
        if (status) return status;
    }
    return FROE_OK;
}

/* nearest_points(objects, points, threads, progress): the point of each object that is nearest to its point */
PyObject *core_ask_nearest_points(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "nearest_points", args, count, 4)) return NULL;
    core_input *objects = &ask.in[1];
    if (core_ask_points(&ask, args[1]) &&
        core_input_take_count(objects, args[0], "objects", 'I', 1, ask.in[0].count, false)) {
        const size_t rows = objects->count;
        double *nearest = core_allocate(rows, ask.dim * sizeof *nearest);
        if (nearest) {
            core_ask_run(&ask);
            answer = core_ask_array(&ask, find_nearest(&ask, objects, nearest), nearest, "d", rows, ask.dim);
        }
    }
    core_ask_end(&ask);
    return answer;
}

static void free_pairs(void *block) {
    froe_pairs_free(block);
}

/* pairs(shared, threads, progress): rows a, b, kind */
PyObject *core_ask_pairs(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    froe_pairs pairs;
    if (!core_ask_begin(&ask, self, "pairs", args, count, 3)) return NULL;
    bool shared, done = core_flag(args[0], &shared);
    if (done) {
        core_ask_run(&ask);
        done = core_ask_ran(&ask, froe_batch_pair_array(ask.query, shared, &ask.options, &pairs, &ask.call.diag));
    }
    core_ask_end(&ask);
    PyObject *owner = done ? core_owner(&pairs, sizeof pairs, free_pairs) : NULL;
    if (!owner) return NULL;
    _Static_assert(sizeof(froe_pair) == 3 * sizeof(int32_t), "a pair is three numbers of 32 bits");
    PyObject *array = core_array(owner, pairs.pairs, "i", pairs.count, 3, 0);
    Py_DECREF(owner);
    return array;
}
