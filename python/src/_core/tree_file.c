/* tree_file.c: trees as files, and as bytes, which pickles carry. */
#include "call.h"
#include "errors.h"
#include "memory.h"
#include "tree.h"

/* The path of a str, bytes or os.PathLike, as bytes; NULL: an exception is set. */
static PyObject *path_of(PyObject *object) {
    PyObject *path;
    return PyUnicode_FSConverter(object, &path) ? path : NULL;
}

/* save(path) */
PyObject *core_tree_save(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    if (!core_arguments("save", count, 1)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    PyObject *path = tree ? path_of(args[0]) : NULL;
    bool done = path;
    if (done) {
        core_call call;
        froe_diagnostic diag;
        core_call_begin(&call, Py_None);
        const froe_status status = froe_tree_save(tree, PyBytes_AsString(path), &diag);
        done = core_call_end(&call, status, &diag);
    }
    Py_XDECREF(path);
    if (tree) core_tree_leave(self);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* ------------------------------------------------------------------- bytes -- */

typedef struct sink {
    char *to;
    size_t left;
} sink;

static bool put(void *user, const void *bytes, size_t count) {
    sink *s = user;
    if (count > s->left) return false;
    memcpy(s->to, bytes, count);
    s->to += count;
    s->left -= count;
    return true;
}

/* to_bytes(): the bytes of a saved file */
PyObject *core_tree_to_bytes(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    (void)args;
    if (!core_arguments("to_bytes", count, 0)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    const uint64_t size = froe_tree_saved_size(tree);
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
    if (bytes) {
        sink s = {PyBytes_AsString(bytes), size};
        core_call call;
        froe_diagnostic diag;
        core_call_begin(&call, Py_None);
        const froe_status status = froe_tree_write(tree, put, &s, &diag);
        if (!core_call_end(&call, status, &diag)) Py_CLEAR(bytes);
    }
    core_tree_leave(self);
    return bytes;
}

/* open(path) */
static PyObject *open_path(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    PyObject *path = core_arguments("open", count, 1) ? path_of(args[0]) : NULL;
    if (!path) return NULL;
    froe_tree *tree;
    core_call call;
    froe_diagnostic diag;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_tree_open(PyBytes_AsString(path), &core_allocator, &tree, &diag);
    const bool done = core_call_end(&call, status, &diag);
    Py_DECREF(path);
    return done ? core_tree_object(tree) : NULL;
}

/* from_bytes(bytes): of anything that shows its bytes */
static PyObject *open_bytes(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    Py_buffer view;
    if (!core_arguments("from_bytes", count, 1) || PyObject_GetBuffer(args[0], &view, PyBUF_SIMPLE)) return NULL;
    froe_tree *tree;
    core_call call;
    froe_diagnostic diag;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_tree_open_memory(view.buf, (size_t)view.len, &core_allocator, &tree, &diag);
    const bool done = core_call_end(&call, status, &diag);
    PyBuffer_Release(&view);
    return done ? core_tree_object(tree) : NULL;
}

bool core_add_tree_files(PyObject *module) {
    static PyMethodDef functions[] = {
        CORE_METHOD("open", open_path), CORE_METHOD("from_bytes", open_bytes), {NULL, NULL, 0, NULL}};
    return PyModule_AddFunctions(module, functions) == 0;
}
