/* ray.c: what rays meet, and where. */
#include "ask/ask.h"

enum { ORIGINS, DIRECTIONS, OBJECTS };

static bool take_rays(core_ask *ask, PyObject *origins, PyObject *directions) {
    return core_input_take(&ask->in[ORIGINS], origins, "origins", 'd', ask->dim, false) &&
           core_input_take_count(&ask->in[DIRECTIONS], directions, "directions", 'd', ask->dim, ask->in[ORIGINS].count,
                                 false);
}

/* -------------------------------------------------------------------- modes -- */

/* (ids, parameters): two views of one array of hits */
static PyObject *ask_first(core_ask *ask, double t_max) {
    const size_t count = ask->in[ORIGINS].count;
    froe_hit *hits = core_allocate(count, sizeof *hits);
    if (!hits) return NULL;
    core_ask_run(ask);
    const froe_status status = froe_batch_ray(ask->query, ask->in[ORIGINS].data, ask->in[DIRECTIONS].data, count, t_max,
                                              &ask->options, hits, &ask->call.diag);
    for (size_t i = 0; !status && i < count; i++)
        if (hits[i].object == FROE_NONE) hits[i].t = Py_HUGE_VAL;
    if (!core_ask_ran(ask, status)) {
        core_release(hits, count, sizeof *hits);
        return NULL;
    }
    PyObject *owner = core_block(hits, count * sizeof *hits);
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, &hits->object, "i", count, 0, sizeof *hits),
                         core_array(owner, &hits->t, "d", count, 0, sizeof *hits)};
    Py_DECREF(owner);
    return core_tuple(2, parts);
}

static PyObject *ask_all(core_ask *ask, double t_max) {
    froe_answers answers;
    core_ask_run(ask);
    const froe_status status =
        froe_batch_ray_all(ask->query, ask->in[ORIGINS].data, ask->in[DIRECTIONS].data, ask->in[ORIGINS].count, t_max,
                           &ask->options, &answers, &ask->call.diag);
    return core_ask_answers(ask, status, &answers);
}

static PyObject *ask_any(core_ask *ask, double t_max) {
    const size_t count = ask->in[ORIGINS].count;
    uint32_t *objects = core_allocate(count, sizeof *objects);
    if (!objects) return NULL;
    core_ask_run(ask);
    const froe_status status = froe_batch_ray_any(ask->query, ask->in[ORIGINS].data, ask->in[DIRECTIONS].data, count,
                                                  t_max, &ask->options, objects, &ask->call.diag);
    return core_ask_array(ask, status, objects, "i", count, 0);
}

/* rays(mode, origins, directions, t_max, threads, progress): mode 0: first hits, 1: all, 2: any */
PyObject *core_ask_rays(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    static PyObject *(*const modes[])(core_ask *, double) = {ask_first, ask_all, ask_any};
    core_ask ask;
    uint32_t mode;
    double t_max;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "rays", args, count, 6)) return NULL;
    if (core_double(args[3], "t_max", &t_max) && core_unsigned(args[0], "mode", 2, &mode) &&
        take_rays(&ask, args[1], args[2]))
        answer = modes[mode](&ask, t_max);
    core_ask_end(&ask);
    return answer;
}

/* -------------------------------------------------------------------- where -- */

/* Places in rows of dim doubles. */
typedef struct place_rows {
    double *points, *normals, *distances;
} place_rows;

/* Without the GIL. */
static froe_status find_places(core_ask *ask, place_rows *to) {
    const size_t dim = ask->dim, count = ask->in[ORIGINS].count;
    const uint32_t *objects = ask->in[OBJECTS].data;
    const double *origins = ask->in[ORIGINS].data, *directions = ask->in[DIRECTIONS].data;
    for (size_t i = 0; i < count; i++) {
        froe_hit_place place;
        if (i % 1024 == 0 && !core_call_progress(&ask->call, (double)i / (double)count)) return FROE_E_CANCELLED;
        const froe_status status = froe_query_hit_place(ask->query, objects[i], origins + i * dim, directions + i * dim,
                                                        &place, &ask->call.diag);
        if (status) ask->call.diag.object = (uint32_t)i;
        if (status) return status;
        memcpy(to->points + i * dim, place.point, dim * sizeof *to->points);
        memcpy(to->normals + i * dim, place.normal, dim * sizeof *to->normals);
        to->distances[i] = place.distance;
    }
    return FROE_OK;
}

static PyObject *ask_places(core_ask *ask) {
    const size_t dim = ask->dim, count = ask->in[ORIGINS].count, width = 2 * dim + 1;
    double *all = core_allocate(count, width * sizeof *all);
    if (!all) return NULL;
    place_rows rows = {all, all + count * dim, all + 2 * count * dim};
    core_ask_run(ask);
    if (!core_ask_ran(ask, find_places(ask, &rows))) {
        core_release(all, count, width * sizeof *all);
        return NULL;
    }
    PyObject *owner = core_block(all, count * width * sizeof *all);
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, rows.points, "d", count, dim, 0),
                         core_array(owner, rows.normals, "d", count, dim, 0),
                         core_array(owner, rows.distances, "d", count, 0, 0)};
    Py_DECREF(owner);
    return core_tuple(3, parts);
}

/* hit_places(objects, origins, directions, threads, progress): (points, normals, distances) */
PyObject *core_ask_hit_places(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_ask ask;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "hit_places", args, count, 5)) return NULL;
    if (take_rays(&ask, args[1], args[2]) &&
        core_input_take_count(&ask.in[OBJECTS], args[0], "objects", 'I', 1, ask.in[ORIGINS].count, false))
        answer = ask_places(&ask);
    core_ask_end(&ask);
    return answer;
}
