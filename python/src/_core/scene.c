/* scene.c: scenes as they are filled. Only one call at a time uses a scene that can still grow: a second one, on
 * another thread or from the progress function of the first, gets a BusyError. */
#include "scene.h"
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"

struct core_scene {
    PyObject_HEAD;
    froe_scene *scene;
    core_tree *keeper; /* the tree that the scene belongs to; NULL: the object's own reference keeps it */
    bool busy;
};

static PyTypeObject *scene_type;

PyObject *core_scene_object(froe_scene *scene) {
    core_scene *self = PyObject_New(core_scene, scene_type);
    if (!self) {
        froe_scene_free(scene);
        return NULL;
    }
    self->scene = scene;
    self->keeper = NULL;
    self->busy = false;
    return (PyObject *)self;
}

core_scene *core_scene_from(PyObject *object) {
    if (Py_IS_TYPE(object, scene_type)) return (core_scene *)object;
    return (core_scene *)core_fail_as("ArrayError", "This is no scene.");
}

PyObject *core_scene_of_tree(core_tree *tree) {
    const froe_tree *used = core_tree_use(tree);
    PyObject *object = used ? core_scene_object(NULL) : NULL;
    if (used && !object) core_tree_leave(tree);
    if (!object) return NULL;
    core_scene *self = (core_scene *)object;
    self->keeper = (core_tree *)Py_NewRef((PyObject *)tree);
    self->scene = (froe_scene *)froe_tree_scene(used); /* see core_scene_take_growing() */
    return object;
}

static void free_scene(PyObject *object) {
    core_scene *self = (core_scene *)object;
    if (self->keeper) {
        core_tree_leave(self->keeper);
        Py_DECREF((PyObject *)self->keeper);
    } else {
        froe_scene_free(self->scene);
    }
    core_free_object(object);
}

froe_scene *core_scene_take(core_scene *self) {
    if (self->busy) return (froe_scene *)core_fail_as("BusyError", "Another call is using the scene.");
    self->busy = true;
    return self->scene;
}

froe_scene *core_scene_take_growing(core_scene *self) {
    if (!self->keeper) return core_scene_take(self);
    return (froe_scene *)core_fail(FROE_E_FROZEN, "A tree holds the scene, which can no longer grow.");
}

void core_scene_give(core_scene *self) {
    self->busy = false;
}

/* scene(dim) */
static PyObject *new_scene(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    if (!core_arguments("scene", count, 1)) return NULL;
    uint32_t dim;
    if (!core_unsigned(args[0], "dim", UINT32_MAX, &dim)) return NULL;
    froe_scene *scene;
    const froe_status status = froe_scene_new(dim > FROE_MAX_DIM ? 0 : (int)dim, &core_allocator, &scene);
    if (status == FROE_E_ARG)
        return core_fail(status, "The dimension is %u, and must be between 2 and %d.", dim, FROE_MAX_DIM);
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
        return core_fail_as("ArrayError", "There are %zu corners, and each object takes %zu.", corners, each);
    *count = corners / each;
    return true;
}

/* args: kind, coords, indices, starts, radii, tags, faces, groups, group, threads, progress */
static bool take_batch(batch *b, const core_scene *self, PyObject *const *args) {
    const size_t dim = (size_t)froe_scene_dim(self->scene);
    froe_objects *o = &b->objects;
    size_t count = 0;
    *o = froe_objects_defaults();
    uint32_t kind = 0;
    if (!core_unsigned(args[0], "kind", FROE_KIND_COUNT - 1, &kind) ||
        (args[8] != Py_None && !core_unsigned(args[8], "group", FROE_NONE - 1, &o->group)) ||
        !core_unsigned(args[9], "threads", UINT32_MAX, &o->threads))
        return false;
    o->kind = (froe_kind)kind;
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
    core_call_begin(&call, b->progress);
    b->objects.progress = core_call_progress, b->objects.user = &call;
    const froe_status status = froe_scene_add(self->scene, &b->objects, &call.diag);
    return core_call_end(&call, status);
}

static PyObject *add(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_scene *self = (core_scene *)object;
    if (!core_arguments("add", count, 11) || !core_scene_take_growing(self)) return NULL;
    batch b = {0};
    const bool done = take_batch(&b, self, args) && run_batch(self, &b);
    give_batch(&b);
    core_scene_give(self);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* -------------------------------------------------------------------- build -- */

/* args: method, purpose, settings, leaf, seed, order, max_pieces, threads, progress */
static bool take_options(froe_build_options *o, core_input *order, PyObject *const *args) {
    *o = froe_build_defaults();
    if (!(o->method = core_text(args[0], "method")) || !(o->purpose = core_text(args[1], "purpose")) ||
        !(o->settings = core_text(args[2], "settings")) ||
        (args[3] != Py_None && !core_unsigned(args[3], "leaf", UINT32_MAX, &o->leaf)) ||
        !core_long(args[4], "seed", &o->seed) || !core_long(args[6], "max_pieces", &o->max_fragments) ||
        !core_unsigned(args[7], "threads", UINT32_MAX, &o->threads) ||
        !core_input_take(order, args[5], "order", 'I', 1, true))
        return false;
    o->order = order->data, o->order_count = order->count;
    return true;
}

static froe_tree *run_build(core_scene *self, froe_build_options *options, PyObject *progress) {
    froe_tree *tree = NULL;
    core_call call;
    core_call_begin(&call, progress);
    options->progress = core_call_progress, options->user = &call;
    const froe_status status = froe_build(self->scene, options, &tree, &call.diag);
    return core_call_end(&call, status) ? tree : NULL;
}

static PyObject *build(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_scene *self = (core_scene *)object;
    froe_build_options options;
    core_input order = {0};
    if (!core_arguments("build", count, 9) || !core_scene_take(self)) return NULL;
    froe_tree *tree = take_options(&options, &order, args) ? run_build(self, &options, args[8]) : NULL;
    core_input_give(&order);
    core_scene_give(self);
    return tree ? core_tree_object(tree) : NULL;
}

/* --------------------------------------------------------------------- type -- */

static PyMethodDef methods[] = {
    CORE_METHOD("add", add),
    CORE_METHOD("build", build),
    CORE_METHOD("add_group", core_scene_add_group),
    CORE_METHOD("group", core_scene_group),
    CORE_METHOD("counts", core_scene_counts),
    CORE_METHOD("bounds", core_scene_bounds),
    CORE_METHOD("arrays", core_scene_arrays),
    CORE_METHOD("crs", core_scene_crs),
    CORE_METHOD("set_crs", core_scene_set_crs),
    CORE_METHOD("across", core_scene_across),
    CORE_METHOD("write", core_scene_write),
    CORE_METHOD("defects", core_measure_defects),
    CORE_METHOD("fatness", core_measure_fatness),
    CORE_METHOD("density", core_measure_density),
    CORE_METHOD("clutter", core_measure_clutter),
    CORE_METHOD("directional", core_measure_directional),
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {{Py_tp_dealloc, free_scene}, {Py_tp_methods, methods}, {0, NULL}};
static PyType_Spec spec = {"froe._core.Scene", sizeof(core_scene), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

bool core_add_scene(PyObject *module) {
    static PyMethodDef functions[] = {CORE_METHOD("scene", new_scene), {NULL, NULL, 0, NULL}};
    scene_type = core_add_type(module, &spec);
    return scene_type && PyModule_AddFunctions(module, functions) == 0;
}
