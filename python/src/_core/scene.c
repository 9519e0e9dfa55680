/* scene.c: scenes as they are filled. Only one call at a time uses a scene that can still grow: a second one, on
 * another thread or from the progress function of the first, gets a BusyError. */
#include "scene.h"
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"

typedef struct core_scene {
    PyObject_HEAD;
    froe_scene *scene;
    bool busy;
} core_scene;

static PyTypeObject *scene_type;

PyObject *core_scene_object(froe_scene *scene) {
    core_scene *self = PyObject_New(core_scene, scene_type);
    if (!self) {
        froe_scene_free(scene);
        return NULL;
    }
    self->scene = scene;
    self->busy = false;
    return (PyObject *)self;
}

static void free_scene(PyObject *object) {
    froe_scene_free(((core_scene *)object)->scene);
    core_free_object(object);
}

static bool take(core_scene *self) {
    if (self->busy) return core_fail_as("BusyError", "Another call is using the scene.");
    return self->busy = true;
}

/* scene(dim) */
static PyObject *new_scene(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    if (!core_arguments("scene", count, 1)) return NULL;
    const long dim = PyLong_AsLong(args[0]);
    if (dim == -1 && PyErr_Occurred()) return NULL;
    froe_scene *scene;
    const froe_status status = froe_scene_new(dim < 2 || dim > FROE_MAX_DIM ? 0 : (int)dim, &core_allocator, &scene);
    if (status == FROE_E_ARG)
        return core_fail(status, "The dimension is %ld, and must be between 2 and %d.", dim, FROE_MAX_DIM);
    return status ? core_fail(status, "There is no memory for a scene.") : core_scene_object(scene);
}

/* -------------------------------------------------------------------- batch -- */

/* The arrays of a batch, in the order of the arguments of add(). */
typedef struct batch {
    core_input coords, indices, starts, radii, tags, faces, groups;
    PyObject *progress;
    froe_objects objects;
} batch;

static void give_batch(batch *b) {
    core_input *all[] = {&b->coords, &b->indices, &b->starts, &b->radii, &b->tags, &b->faces, &b->groups};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) core_input_give(all[i]);
}

/* How many objects the arrays hold. */
static bool count_objects(batch *b, froe_kind kind, size_t *count) {
    static const size_t corners_of[FROE_KIND_COUNT] = {1, 2, 3, 2, 1, 0};
    const size_t corners = b->indices.data ? b->indices.count : b->coords.count;
    if (b->starts.data) {
        const size_t *starts = b->starts.data, last = b->starts.count ? b->starts.count - 1 : 0;
        if (!b->starts.count) return core_fail_as("ArrayError", "starts has no items, and needs at least one.");
        if (starts[last] > corners)
            return core_fail(FROE_E_INPUT, "starts ends at %zu, and there are %zu corners.", starts[last], corners);
        for (size_t i = 0; i < last; i++)
            if (starts[i] > starts[i + 1])
                return core_fail(FROE_E_INPUT, "starts falls from %zu to %zu at object %zu.", starts[i], starts[i + 1],
                                 i);
        *count = last;
        return true;
    }
    const size_t each = corners_of[kind];
    if (!each) return core_fail_as("ArrayError", "Hulls need starts.");
    if (corners % each)
        return core_fail_as("ArrayError", "There are %zu corners, which is no multiple of %zu.", corners, each);
    *count = corners / each;
    return true;
}

/* args: kind, coords, indices, starts, radii, tags, faces, groups, group, threads, progress */
static bool take_batch(batch *b, const core_scene *self, PyObject *const *args) {
    const size_t dim = (size_t)froe_scene_dim(self->scene);
    froe_objects *o = &b->objects;
    size_t count = 0;
    *o = froe_objects_defaults();
    o->kind = (froe_kind)PyLong_AsLong(args[0]);
    o->group = args[8] == Py_None ? FROE_NONE : (uint32_t)PyLong_AsUnsignedLong(args[8]);
    o->threads = (unsigned)PyLong_AsUnsignedLong(args[9]);
    if (PyErr_Occurred()) return false;
    if ((unsigned)o->kind >= FROE_KIND_COUNT) return core_fail(FROE_E_ARG, "There is no kind %d.", (int)o->kind);
    if (!core_input_take(&b->coords, args[1], "coords", 'd', dim, false) ||
        !core_input_take(&b->indices, args[2], "indices", 'I', 1, true) ||
        !core_input_take(&b->starts, args[3], "starts", 'Q', 1, true) || !count_objects(b, o->kind, &count) ||
        !core_input_take_count(&b->radii, args[4], "radii", 'd', 1, count, true) ||
        !core_input_take_count(&b->tags, args[5], "tags", 'Q', 1, count, true) ||
        !core_input_take_count(&b->faces, args[6], "faces", 'I', 1, count, true) ||
        !core_input_take_count(&b->groups, args[7], "groups", 'I', 1, count, true))
        return false;
    o->count = count;
    o->coords = b->coords.data, o->point_count = b->coords.count, o->indices = b->indices.data;
    o->starts = b->starts.data, o->radii = b->radii.data, o->tags = b->tags.data, o->faces = b->faces.data;
    o->groups = b->groups.data;
    b->progress = args[10];
    return true;
}

static bool run_batch(core_scene *self, batch *b) {
    core_call call;
    froe_diagnostic diag;
    core_call_begin(&call, b->progress);
    b->objects.progress = core_call_progress, b->objects.user = &call;
    const froe_status status = froe_scene_add(self->scene, &b->objects, &diag);
    return core_call_end(&call, status, &diag);
}

static PyObject *add(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_scene *self = (core_scene *)object;
    if (!core_arguments("add", count, 11) || !take(self)) return NULL;
    batch b = {0};
    const bool done = take_batch(&b, self, args) && run_batch(self, &b);
    give_batch(&b);
    self->busy = false;
    return done ? Py_NewRef(Py_None) : NULL;
}

/* -------------------------------------------------------------------- build -- */

/* args: method, purpose, settings, leaf, seed, order, max_pieces, threads, progress */
static bool take_options(froe_build_options *o, core_input *order, PyObject *const *args) {
    *o = froe_build_defaults();
    o->method = PyUnicode_AsUTF8AndSize(args[0], NULL);
    o->purpose = PyUnicode_AsUTF8AndSize(args[1], NULL);
    o->settings = PyUnicode_AsUTF8AndSize(args[2], NULL);
    if (args[3] != Py_None) o->leaf = (uint32_t)PyLong_AsUnsignedLong(args[3]);
    o->seed = PyLong_AsUnsignedLongLong(args[4]);
    o->max_fragments = PyLong_AsUnsignedLongLong(args[6]);
    o->threads = (unsigned)PyLong_AsUnsignedLong(args[7]);
    if (PyErr_Occurred() || !core_input_take(order, args[5], "order", 'I', 1, true)) return false;
    o->order = order->data, o->order_count = order->count;
    return true;
}

static froe_tree *run_build(core_scene *self, froe_build_options *options, PyObject *progress) {
    froe_tree *tree = NULL;
    core_call call;
    froe_diagnostic diag;
    core_call_begin(&call, progress);
    options->progress = core_call_progress, options->user = &call;
    const froe_status status = froe_build(self->scene, options, &tree, &diag);
    return core_call_end(&call, status, &diag) ? tree : NULL;
}

static PyObject *build(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_scene *self = (core_scene *)object;
    froe_build_options options;
    core_input order = {0};
    if (!core_arguments("build", count, 9) || !take(self)) return NULL;
    froe_tree *tree = take_options(&options, &order, args) ? run_build(self, &options, args[8]) : NULL;
    core_input_give(&order);
    self->busy = false;
    return tree ? core_tree_object(tree) : NULL;
}

static PyObject *add_group(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_scene *self = (core_scene *)object;
    if (!core_arguments("add_group", count, 1) || !take(self)) return NULL;
    froe_group group = {.name = PyUnicode_AsUTF8AndSize(args[0], NULL)};
    uint32_t id = 0;
    const froe_status status = group.name ? froe_scene_add_group(self->scene, &group, &id) : FROE_OK;
    self->busy = false;
    if (!group.name) return NULL;
    return status ? core_fail(status, "The scene takes no group.") : PyLong_FromUnsignedLong(id);
}

/* --------------------------------------------------------------------- type -- */

static PyObject *counts(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    const core_scene *self = (core_scene *)object;
    (void)args;
    if (!core_arguments("counts", count, 0)) return NULL;
    const froe_scene *s = self->scene;
    return Py_BuildValue("iKKK", froe_scene_dim(s), (unsigned long long)froe_scene_object_count(s),
                         (unsigned long long)froe_scene_vertex_count(s), (unsigned long long)froe_scene_group_count(s));
}

static PyMethodDef methods[] = {CORE_METHOD("add", add),
                                CORE_METHOD("add_group", add_group),
                                CORE_METHOD("build", build),
                                CORE_METHOD("counts", counts),
                                {NULL, NULL, 0, NULL}};
static PyType_Slot slots[] = {{Py_tp_dealloc, free_scene}, {Py_tp_methods, methods}, {0, NULL}};
static PyType_Spec spec = {"froe._core.Scene", sizeof(core_scene), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

bool core_add_scene(PyObject *module) {
    static PyMethodDef functions[] = {CORE_METHOD("scene", new_scene), {NULL, NULL, 0, NULL}};
    scene_type = core_add_type(module, &spec);
    return scene_type && PyModule_AddFunctions(module, functions) == 0;
}
