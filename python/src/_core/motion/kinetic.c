/* kinetic.c: the partition of a motion, kept right while time goes on. It and its motion serve one call at a time: the
 * partition uses memory of its own for questions, too. */
#include "motion/motion.h"
#include "tree.h"
#include <stddef.h>

typedef struct core_kinetic {
    PyObject_HEAD;
    froe_kinetic *kinetic;
    core_motion *motion;
} core_kinetic;

static PyTypeObject *kinetic_type;

/* -------------------------------------------------------------------- calls -- */

/* A call that uses the partition and its motion alone. */
static bool begin(core_kinetic *self, core_call *call, PyObject *progress) {
    if (!core_motion_take(self->motion)) return false;
    froe_kinetic_watch(self->kinetic, core_call_progress, call);
    core_call_begin(call, progress);
    return true;
}

static bool end(core_kinetic *self, core_call *call, froe_status status) {
    const bool done = core_call_end(call, status);
    froe_kinetic_watch(self->kinetic, NULL, NULL);
    core_motion_give(self->motion);
    return done;
}

/* kinetic(motion, seed, augmented, threads, ghosts, progress) */
static PyObject *new_kinetic(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    froe_kinetic_options options = froe_kinetic_defaults();
    core_motion *motion = core_arguments("kinetic", count, 6) ? core_motion_of(args[0]) : NULL;
    if (!motion || !core_long(args[1], "seed", &options.seed) || !core_flag(args[2], &options.augmented) ||
        !core_unsigned(args[3], "threads", UINT32_MAX, &options.threads) || !core_flag(args[4], &options.ghosts) ||
        !core_motion_take(motion))
        return NULL;
    froe_kinetic *kinetic = NULL;
    core_call call;
    core_call_begin(&call, args[5]);
    options.progress = core_call_progress, options.user = &call, options.ahead = true;
    const froe_status status = froe_kinetic_new(motion->motion, &options, &core_allocator, &kinetic, &call.diag);
    const bool done = core_call_end(&call, status);
    core_motion_give(motion);
    if (!done) return NULL;
    froe_kinetic_watch(kinetic, NULL, NULL);
    core_kinetic *self = PyObject_New(core_kinetic, kinetic_type);
    if (!self) {
        froe_kinetic_free(kinetic);
        return NULL;
    }
    self->kinetic = kinetic;
    self->motion = (core_motion *)Py_NewRef(args[0]);
    return (PyObject *)self;
}

static void free_kinetic(PyObject *object) {
    core_kinetic *self = (core_kinetic *)object;
    froe_kinetic_free(self->kinetic);
    Py_DECREF((PyObject *)self->motion);
    core_free_object(object);
}

/* --------------------------------------------------------------------- time -- */

static bool take_event(void *pile, const froe_event *event) {
    froe_event known = *event;
    for (unsigned i = event->object_count; i < 4; i++) known.objects[i] = FROE_NONE;
    for (unsigned i = event->edge_count; i < 4; i++) known.edges[i] = FROE_NONE;
    return core_pile_put(pile, &known, sizeof known);
}

/* (kinds, objects, counts, edges, edge counts, ticks, early, late): views of one array of events */
static PyObject *events_object(core_pile *pile) {
    const size_t each = sizeof(froe_event), count = pile->count / each;
    PyObject *owner = core_pile_owner(pile);
    if (!owner) return NULL;
    const char *at = pile->bytes;
    PyObject *parts[] = {core_array(owner, at + offsetof(froe_event, kind), "i", count, 0, each),
                         core_array(owner, at + offsetof(froe_event, objects), "i", count, 4, each),
                         core_array(owner, at + offsetof(froe_event, object_count), "i", count, 0, each),
                         core_array(owner, at + offsetof(froe_event, edges), "i", count, 4, each),
                         core_array(owner, at + offsetof(froe_event, edge_count), "i", count, 0, each),
                         core_array(owner, at + offsetof(froe_event, tick), "q", count, 0, each),
                         core_array(owner, at + offsetof(froe_event, early), "d", count, 0, each),
                         core_array(owner, at + offsetof(froe_event, late), "d", count, 0, each)};
    Py_DECREF(owner);
    return core_tuple(8, parts);
}

/* advance(time, progress): events */
static PyObject *advance(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    double time;
    core_pile pile = {0};
    core_call call;
    if (!core_arguments("advance", count, 2) || !core_double(args[0], "time", &time) || !begin(self, &call, args[1]))
        return NULL;
    call.pile = &pile;
    const froe_status status = froe_kinetic_advance(self->kinetic, time, take_event, &pile, &call.diag);
    if (end(self, &call, status)) return events_object(&pile);
    core_pile_free(&pile);
    return NULL;
}

/* now(): (time, time of the next event) */
static PyObject *now(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    (void)args;
    if (!core_arguments("now", count, 0) || !core_motion_take(self->motion)) return NULL;
    const double time = froe_kinetic_time(self->kinetic), next = froe_kinetic_next(self->kinetic);
    core_motion_give(self->motion);
    return Py_BuildValue("dd", time, next);
}

/* change(what, object): what 0: objects that were added take part, 1: an object is taken out, 2: audit */
static PyObject *change(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    uint32_t what, which;
    core_call call;
    if (!core_arguments("change", count, 2) || !core_unsigned(args[0], "what", 2, &what) ||
        !core_unsigned(args[1], "object", FROE_NONE, &which) || !begin(self, &call, Py_None))
        return NULL;
    const froe_status status = what == 0   ? froe_kinetic_update(self->kinetic, &call.diag)
                               : what == 1 ? froe_kinetic_remove(self->kinetic, which, &call.diag)
                                           : froe_kinetic_audit(self->kinetic, &call.diag);
    return end(self, &call, status) ? Py_NewRef(Py_None) : NULL;
}

/* replan(vertex, times, coords, controls, second_controls) */
static PyObject *replan(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    core_input times = {0}, coords = {0}, controls = {0}, second_controls = {0};
    const size_t dim = self->motion->dim;
    uint32_t vertex;
    core_call call;
    if (!core_arguments("replan", count, 5) || !core_unsigned(args[0], "vertex", FROE_NONE, &vertex)) return NULL;
    bool done = core_input_take(&times, args[1], "times", 'd', 1, false) &&
                core_input_take_count(&coords, args[2], "coords", 'd', dim, times.count, false) &&
                core_input_take_count(&controls, args[3], "controls", 'd', dim, times.count, true) &&
                core_input_take_count(&second_controls, args[4], "second_controls", 'd', dim, times.count, true) &&
                begin(self, &call, Py_None);
    if (done)
        done = end(self, &call,
                   froe_kinetic_replan(self->kinetic, vertex, times.count, times.data, coords.data, controls.data,
                                       second_controls.data, &call.diag));
    core_input_give(&times);
    core_input_give(&coords);
    core_input_give(&controls);
    core_input_give(&second_controls);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* ---------------------------------------------------------------- questions -- */

static froe_status locate_all(core_kinetic *self, const core_input *points, uint32_t *out, froe_diagnostic *diag) {
    for (size_t i = 0; i < points->count; i++) {
        froe_kinetic_place place;
        const froe_status status =
            froe_kinetic_locate(self->kinetic, (const double *)points->data + 2 * i, &place, diag);
        if (status) diag->object = (uint32_t)i;
        if (status) return status;
        out[3 * i] = place.on, out[3 * i + 1] = place.above, out[3 * i + 2] = place.below;
    }
    return FROE_OK;
}

static froe_status shoot_all(core_kinetic *self, const core_input *ways, uint32_t *out, froe_diagnostic *diag) {
    for (size_t i = 0; i < ways->count; i++) {
        const double *from = (const double *)ways->data + 4 * i;
        const froe_status status = froe_kinetic_ray(self->kinetic, from, from + 2, &out[i], diag);
        if (status) diag->object = (uint32_t)i;
        if (status) return status;
    }
    return FROE_OK;
}

typedef froe_status ask_fn(core_kinetic *self, const core_input *in, uint32_t *out, froe_diagnostic *diag);

/* Rows of `given` numbers have rows of `found` ids as answers, or one id each where that is 0. */
static PyObject *ask(core_kinetic *self, PyObject *rows, const char *name, size_t given, size_t found, ask_fn *fn) {
    core_input in;
    const size_t width = found ? found : 1;
    if (self->motion->dim != 2) return core_fail(FROE_E_UNSUPPORTED, "Motions of the plane alone can be asked.");
    if (!core_input_take(&in, rows, name, 'd', given, false)) return NULL;
    uint32_t *ids = core_allocate(in.count, width * sizeof *ids);
    const size_t count = in.count;
    core_call call;
    bool done = ids && begin(self, &call, Py_None);
    if (done) done = end(self, &call, fn(self, &in, ids, &call.diag));
    core_input_give(&in);
    if (done) return core_array_of(ids, "i", count, found);
    if (ids) core_release(ids, count, width * sizeof *ids);
    return NULL;
}

/* locate(points): rows on, above, below */
static PyObject *locate(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    if (!core_arguments("locate", count, 1)) return NULL;
    return ask((core_kinetic *)object, args[0], "points", 2, 3, locate_all);
}

/* ray(ways from one point to another) */
static PyObject *ray(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    if (!core_arguments("ray", count, 1)) return NULL;
    return ask((core_kinetic *)object, args[0], "ways", 4, 0, shoot_all);
}

/* What order() finds. */
typedef struct seen_piece {
    double ends[4];
    uint32_t object, filler;
} seen_piece;

static bool take_piece(void *pile, uint32_t object, const double ends[4]) {
    const seen_piece piece = {{ends[0], ends[1], ends[2], ends[3]}, object, 0};
    return core_pile_put(pile, &piece, sizeof piece);
}

/* order(eye): (objects, ends) of all pieces, those behind first */
static PyObject *order(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    core_input eye;
    core_call call;
    core_pile pile = {0};
    if (!core_arguments("order", count, 1) || !core_input_take_count(&eye, args[0], "eye", 'd', 2, 1, false))
        return NULL;
    bool done = begin(self, &call, Py_None);
    if (done) {
        call.pile = &pile;
        done = end(self, &call, froe_kinetic_order(self->kinetic, eye.data, take_piece, &pile, &call.diag));
    }
    core_input_give(&eye);
    if (!done) {
        core_pile_free(&pile);
        return NULL;
    }
    const size_t pieces = pile.count / sizeof(seen_piece);
    PyObject *owner = core_pile_owner(&pile);
    if (!owner) return NULL;
    const seen_piece *seen = (const seen_piece *)pile.bytes;
    PyObject *parts[] = {core_array(owner, &seen->object, "i", pieces, 0, sizeof *seen),
                         core_array(owner, seen->ends, "d", pieces, 4, sizeof *seen)};
    Py_DECREF(owner);
    return core_tuple(2, parts);
}

/* snapshot(refuse what has to be rounded, progress): (tree, rounded vertices, alike) */
static PyObject *snapshot(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_kinetic *self = (core_kinetic *)object;
    froe_snapshot_options options = froe_snapshot_defaults();
    options.places = false;
    froe_snapshot found;
    core_call call;
    if (!core_arguments("snapshot", count, 2) || !core_flag(args[0], &options.refuse) || !begin(self, &call, args[1]))
        return NULL;
    const froe_status status = froe_kinetic_snapshot(self->kinetic, &options, &found, &call.diag);
    if (!end(self, &call, status)) return NULL;
    PyObject *parts[] = {core_tree_object(found.tree), PyLong_FromSize_t(found.rounded), PyBool_FromLong(found.alike)};
    return core_tuple(3, parts);
}

/* --------------------------------------------------------------------- type -- */

static PyMethodDef methods[] = {
    CORE_METHOD("advance", advance), CORE_METHOD("now", now),           CORE_METHOD("change", change),
    CORE_METHOD("replan", replan),   CORE_METHOD("locate", locate),     CORE_METHOD("ray", ray),
    CORE_METHOD("order", order),     CORE_METHOD("snapshot", snapshot), {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {{Py_tp_dealloc, free_kinetic}, {Py_tp_methods, methods}, {0, NULL}};
static PyType_Spec spec = {"froe._core.Kinetic", sizeof(core_kinetic), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

/* event_names(): of all kinds of events, in the order of their numbers */
static PyObject *event_names(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module, (void)args;
    if (!core_arguments("event_names", count, 0)) return NULL;
    PyObject *names[FROE_EVENT_KINDS];
    for (size_t i = 0; i < FROE_EVENT_KINDS; i++) names[i] = PyUnicode_FromString(froe_event_name((froe_event_kind)i));
    return core_tuple(FROE_EVENT_KINDS, names);
}

bool core_add_kinetic(PyObject *module) {
    static PyMethodDef functions[] = {
        CORE_METHOD("kinetic", new_kinetic), CORE_METHOD("event_names", event_names), {NULL, NULL, 0, NULL}};
    kinetic_type = core_add_type(module, &spec);
    return kinetic_type && PyModule_AddFunctions(module, functions) == 0;
}
