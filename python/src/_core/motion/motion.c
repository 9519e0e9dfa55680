/* motion.c: moving objects and their contacts. */
#include "motion/motion.h"
#include <froe/formats.h>
#include <stddef.h>

static PyTypeObject *motion_type;

bool core_motion_take(core_motion *self) {
    if (self->busy) return core_fail_as("BusyError", "Another call is using the motion.");
    return self->busy = true;
}

void core_motion_give(core_motion *self) {
    self->busy = false;
}

core_motion *core_motion_of(PyObject *object) {
    if (Py_IS_TYPE(object, motion_type)) return (core_motion *)object;
    return (core_motion *)core_fail_as("ArrayError", "This is no motion.");
}

/* -------------------------------------------------------------------- life -- */

PyObject *core_motion_object(froe_motion *motion) {
    core_motion *self = PyObject_New(core_motion, motion_type);
    if (!self) {
        froe_motion_free(motion);
        return NULL;
    }
    self->motion = motion;
    self->dim = froe_motion_window(motion).dim;
    self->busy = false;
    return (PyObject *)self;
}

static void free_motion(PyObject *object) {
    froe_motion_free(((core_motion *)object)->motion);
    core_free_object(object);
}

/* motion(dim, begin, end, tick) */
static PyObject *new_motion(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    froe_motion_options options = froe_motion_defaults();
    uint32_t dim;
    if (!core_arguments("motion", count, 4) || !core_unsigned(args[0], "dim", UINT32_MAX, &dim) ||
        !core_double(args[1], "begin", &options.begin) || !core_double(args[2], "end", &options.end) ||
        !core_double(args[3], "tick", &options.tick))
        return NULL;
    options.dim = dim;
    froe_motion *motion;
    froe_diagnostic diag;
    const froe_status status = froe_motion_new(&options, &core_allocator, &motion, &diag);
    return status ? core_raise(status, &diag) : core_motion_object(motion);
}

/* -------------------------------------------------------------------- batch -- */

enum { TIMES, COORDS, STARTS, CONTROLS, SECOND_CONTROLS, VERTICES, BODIES, BIRTHS, DEATHS, TAGS, GROUPS, INPUTS };

static bool check_starts(const core_input *in) {
    const size_t *starts = in[STARTS].data, last = in[STARTS].count - 1;
    if (!in[STARTS].count || starts[0] || starts[last] != in[TIMES].count)
        return core_fail(FROE_E_INPUT, "starts does not go from 0 to the number of times, %zu.", in[TIMES].count);
    for (size_t i = 0; i < last; i++)
        if (starts[i] > starts[i + 1]) return core_fail(FROE_E_INPUT, "starts falls at vertex %zu.", i);
    return true;
}

/* args: times, coords, starts, controls, second_controls, vertices, bodies, births, deaths, tags, groups */
static bool take_batch(const core_motion *self, core_input *in, PyObject *const *args, froe_moving *b) {
    const size_t each = self->dim; /* segments of the plane have 2 corners, triangles in space 3 */
    if (!core_input_take(&in[TIMES], args[0], "times", 'd', 1, false) ||
        !core_input_take_count(&in[COORDS], args[1], "coords", 'd', self->dim, in[TIMES].count, false) ||
        !core_input_take(&in[STARTS], args[2], "starts", 'Q', 1, false) || !check_starts(in) ||
        !core_input_take_count(&in[CONTROLS], args[3], "controls", 'd', self->dim, in[TIMES].count, true) ||
        !core_input_take_count(&in[SECOND_CONTROLS], args[4], "second_controls", 'd', self->dim, in[TIMES].count,
                               true) ||
        !core_input_take(&in[VERTICES], args[5], "vertices", 'I', each, true))
        return false;
    *b = froe_moving_defaults();
    b->vertex_count = in[STARTS].count - 1;
    b->count = in[VERTICES].data ? in[VERTICES].count : b->vertex_count / each;
    if (!in[VERTICES].data && b->vertex_count % each)
        return core_fail_as("ArrayError", "Each object takes %zu vertices, and their number is %zu.", each,
                            b->vertex_count);
    if (!core_input_take_count(&in[BODIES], args[6], "bodies", 'I', 1, b->vertex_count, true) ||
        !core_input_take_count(&in[BIRTHS], args[7], "births", 'd', 1, b->count, true) ||
        !core_input_take_count(&in[DEATHS], args[8], "deaths", 'd', 1, b->count, true) ||
        !core_input_take_count(&in[TAGS], args[9], "tags", 'Q', 1, b->count, true) ||
        !core_input_take_count(&in[GROUPS], args[10], "groups", 'I', 1, b->count, true))
        return false;
    b->times = in[TIMES].data, b->coords = in[COORDS].data, b->starts = in[STARTS].data;
    b->controls = in[CONTROLS].data, b->second_controls = in[SECOND_CONTROLS].data;
    b->vertices = in[VERTICES].data, b->bodies = in[BODIES].data;
    b->births = in[BIRTHS].data, b->deaths = in[DEATHS].data, b->tags = in[TAGS].data, b->groups = in[GROUPS].data;
    return true;
}

static PyObject *add(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    core_input in[INPUTS] = {0};
    froe_moving batch;
    if (!core_arguments("add", count, 11) || !core_motion_take(self)) return NULL;
    bool done = take_batch(self, in, args, &batch);
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        done = core_call_end(&call, froe_motion_add(self->motion, &batch, &call.diag));
    }
    for (size_t i = 0; i < INPUTS; i++) core_input_give(&in[i]);
    core_motion_give(self);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* args: times, coords, controls, turns */
static bool take_body(const core_motion *self, core_input *in, PyObject *const *args, froe_body *body) {
    enum { AT, PLACES, WAYS, TURNS };
    const size_t dim = self->dim, each = dim == 2 ? 2 : 4;
    if (!core_input_take(&in[AT], args[0], "times", 'd', 1, false) ||
        !core_input_take_count(&in[PLACES], args[1], "coords", 'd', dim, in[AT].count, false) ||
        !core_input_take_count(&in[WAYS], args[2], "controls", 'd', dim, in[AT].count, true) ||
        !core_input_take_count(&in[TURNS], args[3], "turns", 'd', each, in[AT].count, true))
        return false;
    *body = froe_body_defaults();
    body->count = in[AT].count, body->times = in[AT].data, body->coords = in[PLACES].data;
    body->controls = in[WAYS].data, body->turns = in[TURNS].data;
    return true;
}

/* add_body(times, coords, controls, turns): its number */
static PyObject *add_body(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    core_input in[4] = {0};
    froe_body body;
    uint32_t id = 0;
    if (!core_arguments("add_body", count, 4) || !core_motion_take(self)) return NULL;
    bool done = take_body(self, in, args, &body);
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        done = core_call_end(&call, froe_motion_add_body(self->motion, &body, &id, &call.diag));
    }
    for (size_t i = 0; i < 4; i++) core_input_give(&in[i]);
    core_motion_give(self);
    return done ? PyLong_FromUnsignedLong(id) : NULL;
}

/* add_group(name) */
static PyObject *add_group(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    froe_group group = {0};
    uint32_t id;
    if (!core_arguments("add_group", count, 1) || !(group.name = core_text(args[0], "name")) || !core_motion_take(self))
        return NULL;
    const froe_status status = froe_motion_add_group(self->motion, &group, &id);
    core_motion_give(self);
    return status ? core_fail(status, "The motion takes no group.") : PyLong_FromUnsignedLong(id);
}

/* ----------------------------------------------------------------- contacts -- */

static bool take_contact(void *pile, const froe_contact *contact) {
    return core_pile_put(pile, contact, sizeof *contact);
}

/* (a, b, begin, end, instant, since_start, to_stop): views of one array of contacts */
static PyObject *contacts_object(core_pile *pile) {
    const size_t each = sizeof(froe_contact), count = pile->count / each;
    PyObject *owner = core_pile_owner(pile);
    if (!owner) return NULL;
    const char *at = pile->bytes;
    PyObject *parts[] = {core_array(owner, at + offsetof(froe_contact, a), "i", count, 0, each),
                         core_array(owner, at + offsetof(froe_contact, b), "i", count, 0, each),
                         core_array(owner, at + offsetof(froe_contact, begin), "d", count, 2, each),
                         core_array(owner, at + offsetof(froe_contact, end), "d", count, 2, each),
                         core_array(owner, at + offsetof(froe_contact, instant), "B", count, 0, each),
                         core_array(owner, at + offsetof(froe_contact, since_start), "B", count, 0, each),
                         core_array(owner, at + offsetof(froe_contact, to_stop), "B", count, 0, each)};
    Py_DECREF(owner);
    return core_tuple(7, parts);
}

/* contacts(from, to, first, apart, threads, progress): from and to may be NaN */
static PyObject *contacts(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    froe_contact_options options = froe_contact_defaults();
    if (!core_arguments("contacts", count, 6) || !core_flag(args[2], &options.first) ||
        !core_flag(args[3], &options.apart) || !core_unsigned(args[4], "threads", UINT32_MAX, &options.threads) ||
        !core_double(args[0], "begin", &options.from) || !core_double(args[1], "end", &options.to) ||
        !core_motion_take(self))
        return NULL;
    core_pile pile = {0};
    core_call call;
    core_call_begin(&call, args[5]);
    call.pile = &pile;
    options.progress = core_call_progress, options.user = &call;
    const froe_status status = froe_motion_contacts(self->motion, &options, take_contact, &pile, &call.diag);
    const bool done = core_call_end(&call, status);
    core_motion_give(self);
    if (done) return contacts_object(&pile);
    core_pile_free(&pile);
    return NULL;
}

/* --------------------------------------------------------------------- type -- */

/* counts(): (dim, objects, vertices, groups, begin, end) */
static PyObject *counts(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    (void)args;
    if (!core_arguments("counts", count, 0) || !core_motion_take(self)) return NULL;
    const froe_motion *m = self->motion;
    const froe_motion_options window = froe_motion_window(m);
    core_motion_give(self);
    return Py_BuildValue("iKKKdd", (int)self->dim, (unsigned long long)froe_motion_object_count(m),
                         (unsigned long long)froe_motion_vertex_count(m),
                         (unsigned long long)froe_motion_group_count(m), window.begin, window.end);
}

/* positions(time): of every vertex; NaN where its plan does not cover the time */
static PyObject *positions(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    double time;
    if (!core_arguments("positions", count, 1) || !core_double(args[0], "time", &time) || !core_motion_take(self))
        return NULL;
    const size_t vertices = froe_motion_vertex_count(self->motion), dim = self->dim;
    double *at = core_allocate(vertices, dim * sizeof *at);
    for (size_t v = 0; at && v < vertices; v++)
        if (!froe_motion_position(self->motion, (uint32_t)v, time, at + v * dim))
            for (size_t k = 0; k < dim; k++) at[v * dim + k] = Py_NAN;
    core_motion_give(self);
    return at ? core_array_of(at, "d", vertices, dim) : NULL;
}

/* without_bodies(deviation): (a motion, a bound of how far its vertices are off) */
static PyObject *without_bodies(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    froe_motion *made = NULL;
    double deviation, reached = 0;
    core_call call;
    if (!core_arguments("without_bodies", count, 1) || !core_double(args[0], "deviation", &deviation) ||
        !core_motion_take(self))
        return NULL;
    core_call_begin(&call, Py_None);
    const bool done = core_call_end(
        &call, froe_motion_without_bodies(self->motion, deviation, &core_allocator, &made, &reached, &call.diag));
    core_motion_give(self);
    if (!done) return NULL;
    PyObject *parts[] = {core_motion_object(made), PyFloat_FromDouble(reached)};
    return core_tuple(2, parts);
}

/* write(path): MF-JSON */
static PyObject *write_file(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_motion *self = (core_motion *)object;
    PyObject *path;
    if (!core_arguments("write", count, 1) || !PyUnicode_FSConverter(args[0], &path)) return NULL;
    bool done = core_motion_take(self);
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        done = core_call_end(&call, froe_write_motion(self->motion, PyBytes_AsString(path), &call.diag));
        core_motion_give(self);
    }
    Py_DECREF(path);
    return done ? Py_NewRef(Py_None) : NULL;
}

static PyMethodDef methods[] = {
    CORE_METHOD("add", add),
    CORE_METHOD("add_body", add_body),
    CORE_METHOD("add_group", add_group),
    CORE_METHOD("contacts", contacts),
    CORE_METHOD("counts", counts),
    CORE_METHOD("positions", positions),
    CORE_METHOD("without_bodies", without_bodies),
    CORE_METHOD("write", write_file),
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {{Py_tp_dealloc, free_motion}, {Py_tp_methods, methods}, {0, NULL}};
static PyType_Spec spec = {"froe._core.Motion", sizeof(core_motion), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

bool core_add_motion(PyObject *module) {
    static PyMethodDef functions[] = {CORE_METHOD("motion", new_motion), {NULL, NULL, 0, NULL}};
    motion_type = core_add_type(module, &spec);
    return motion_type && PyModule_AddFunctions(module, functions) == 0;
}
