/* tree_file.c: trees as files, and as bytes, which pickles carry. */
#include "call.h"
#include "errors.h"
#include "memory.h"
#include "tree.h"

/* save(path) */
PyObject *core_tree_save(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    PyObject *path;
    if (!core_arguments("save", count, 1) || !PyUnicode_FSConverter(args[0], &path)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    bool done = tree;
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        const froe_status status = froe_tree_save(tree, PyBytes_AsString(path), &call.diag);
        done = core_call_end(&call, status);
    }
    Py_DECREF(path);
    if (tree) core_tree_leave(self);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* check(): all of an opened tree */
PyObject *core_tree_check(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    (void)args;
    if (!core_arguments("check", count, 0)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    core_call call;
    core_call_begin(&call, Py_None);
    const bool done = core_call_end(&call, froe_tree_check(tree, &call.diag));
    core_tree_leave(self);
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
        core_call_begin(&call, Py_None);
        const froe_status status = froe_tree_write(tree, put, &s, &call.diag);
        if (!core_call_end(&call, status)) Py_CLEAR(bytes);
    }
    core_tree_leave(self);
    return bytes;
}

/* open(path) */
static PyObject *open_path(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    PyObject *path;
    if (!core_arguments("open", count, 1) || !PyUnicode_FSConverter(args[0], &path)) return NULL;
    froe_tree *tree;
    core_call call;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_tree_open(PyBytes_AsString(path), &core_allocator, &tree, &call.diag);
    const bool done = core_call_end(&call, status);
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
    core_call_begin(&call, Py_None);
    const froe_status status = froe_tree_open_memory(view.buf, (size_t)view.len, &core_allocator, &tree, &call.diag);
    const bool done = core_call_end(&call, status);
    PyBuffer_Release(&view);
    return done ? core_tree_object(tree) : NULL;
}

bool core_add_tree_files(PyObject *module) {
    static PyMethodDef functions[] = {
        CORE_METHOD("open", open_path), CORE_METHOD("from_bytes", open_bytes), {NULL, NULL, 0, NULL}};
    return PyModule_AddFunctions(module, functions) == 0;
}
