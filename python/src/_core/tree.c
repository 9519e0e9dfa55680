/* tree.c: trees.
 *
 * A query context serves one thread at a time, and any number of Python's threads may ask one tree. So a tree keeps
 * idle contexts: a call takes one, or forks the first, and gives it back. The pool has a lock of its own, which is held
 * for a few instructions and never while the interpreter's lock is waited for.
 *
 * close() frees the tree once the calls that are using it have returned. */
#include "tree.h"
#include "errors.h"
#include "scene.h"

static PyTypeObject *tree_type;

/* --------------------------------------------------------------------- pool -- */

enum { IDLE_MOST = 64 };

struct core_tree {
    PyObject_HEAD;
    froe_tree *tree;
    PyThread_type_lock lock; /* of what follows */
    froe_query *first;       /* others are its forks; never asked itself */
    froe_query *idle[IDLE_MOST];
    unsigned idle_count;
    size_t users;
    int dim;
    bool closed;
};

/* REQUIRES: no call is using the tree. */
static void free_all(core_tree *self) {
    while (self->idle_count) froe_query_free(self->idle[--self->idle_count]);
    froe_query_free(self->first);
    froe_tree_free(self->tree);
    self->first = NULL;
    self->tree = NULL;
}

const froe_tree *core_tree_use(core_tree *self) {
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    const bool open = !self->closed;
    self->users += open;
    PyThread_release_lock(self->lock);
    return open ? self->tree : (const froe_tree *)core_fail_as("ClosedError", "The tree has been closed.");
}

void core_tree_leave(core_tree *self) {
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    if (--self->users == 0 && self->closed) free_all(self);
    PyThread_release_lock(self->lock);
}

const froe_tree *core_tree_of(const core_tree *self) {
    return self->tree;
}

froe_query *core_tree_take(core_tree *self) {
    if (!core_tree_use(self)) return NULL;
    froe_query *query = NULL;
    froe_diagnostic diag = {0};
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    froe_status status = self->first ? FROE_OK : froe_query_new(self->tree, &self->first, &diag);
    if (!status && self->idle_count)
        query = self->idle[--self->idle_count];
    else if (!status)
        status = froe_query_fork(self->first, &query, &diag);
    PyThread_release_lock(self->lock);
    if (!status) return query;
    core_tree_leave(self);
    return (froe_query *)core_raise(status, &diag);
}

void core_tree_give(core_tree *self, froe_query *query) {
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    const bool kept = self->idle_count < IDLE_MOST;
    if (kept) self->idle[self->idle_count++] = query;
    PyThread_release_lock(self->lock);
    if (!kept) froe_query_free(query);
    core_tree_leave(self);
}

/* --------------------------------------------------------------------- life -- */

PyObject *core_tree_object(froe_tree *tree) {
    core_tree *self = PyObject_New(core_tree, tree_type);
    PyThread_type_lock lock = self ? PyThread_allocate_lock() : NULL;
    if (!self || !lock) {
        froe_tree_free(tree);
        if (self) core_free_object((PyObject *)self);
        return PyErr_NoMemory();
    }
    self->tree = tree;
    self->dim = froe_scene_dim(froe_tree_scene(tree));
    self->lock = lock;
    self->first = NULL;
    self->idle_count = 0;
    self->users = 0;
    self->closed = false;
    return (PyObject *)self;
}

core_tree *core_tree_from(PyObject *object) {
    if (Py_IS_TYPE(object, tree_type)) return (core_tree *)object;
    return (core_tree *)core_fail_as("ArrayError", "This is no tree.");
}

static void free_tree(PyObject *object) {
    core_tree *self = (core_tree *)object;
    free_all(self);
    PyThread_free_lock(self->lock);
    core_free_object(object);
}

static PyObject *close_tree(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    (void)args;
    if (!core_arguments("close", count, 0)) return NULL;
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    if (!self->closed && !self->users) free_all(self);
    self->closed = true;
    PyThread_release_lock(self->lock);
    Py_RETURN_NONE;
}

/* --------------------------------------------------------------------- type -- */

static PyObject *dim(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    return core_arguments("dim", count, 0) ? PyLong_FromLong(((core_tree *)object)->dim) : NULL;
}

static PyObject *scene(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    return core_arguments("scene", count, 0) ? core_scene_of_tree((core_tree *)object) : NULL;
}

static PyMethodDef methods[] = {
    CORE_METHOD("close", close_tree),
    CORE_METHOD("save", core_tree_save),
    CORE_METHOD("check", core_tree_check),
    CORE_METHOD("to_bytes", core_tree_to_bytes),
    CORE_METHOD("dim", dim),
    CORE_METHOD("scene", scene),
    CORE_METHOD("report", core_tree_report),
    CORE_METHOD("render", core_tree_render),
    CORE_METHOD("export", core_tree_export),
    CORE_METHOD("audit", core_tree_audit),
    CORE_METHOD("pieces", core_tree_pieces),
    CORE_METHOD("cells", core_tree_cells),
    CORE_METHOD("order", core_tree_order),
    CORE_METHOD("ranges", core_ask_ranges),
    CORE_METHOD("boxes", core_ask_boxes),
    CORE_METHOD("box", core_ask_box),
    CORE_METHOD("locate", core_ask_locate),
    CORE_METHOD("groups", core_ask_groups),
    CORE_METHOD("group_boxes", core_ask_group_boxes),
    CORE_METHOD("group_join", core_ask_group_join),
    CORE_METHOD("near", core_ask_near),
    CORE_METHOD("vertical", core_ask_vertical),
    CORE_METHOD("nearest_points", core_ask_nearest_points),
    CORE_METHOD("pairs", core_ask_pairs),
    CORE_METHOD("rays", core_ask_rays),
    CORE_METHOD("hit_places", core_ask_hit_places),
    {NULL, NULL, 0, NULL},
};
static PyType_Slot slots[] = {{Py_tp_dealloc, free_tree}, {Py_tp_methods, methods}, {0, NULL}};
static PyType_Spec spec = {"froe._core.Tree", sizeof(core_tree), 0,
                           Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

bool core_add_tree(PyObject *module) {
    tree_type = core_add_type(module, &spec);
    return tree_type;
}
