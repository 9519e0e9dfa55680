/* read.c: scenes from files, made-up scenes, and parts of trees as files. */
#include "call.h"
#include "errors.h"
#include "memory.h"
#include "scene.h"
#include <froe/formats.h>

static PyObject *report_of(const froe_read_report *r) {
    return Py_BuildValue("{s:s,s:s,s:K,s:K,s:K,s:K,s:K,s:K,s:K,s:s,s:O}", "format", r->format, "precision",
                         r->precision, "features", (unsigned long long)r->features, "groups",
                         (unsigned long long)r->groups, "triangulated", (unsigned long long)r->triangulated, "closed",
                         (unsigned long long)r->closed, "skipped", (unsigned long long)r->skipped, "no_geometry",
                         (unsigned long long)r->no_geometry, "wrapped", (unsigned long long)r->wrapped,
                         "unread_library", r->unread_library, "no_degrees", r->no_degrees ? Py_True : Py_False);
}

/* read(path, polygons stay whole, boxes, wrap, progress): (scene, report) */
static PyObject *read_scene(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    PyObject *path;
    bool polygons;
    froe_read_options options = froe_read_defaults();
    if (!core_arguments("read", count, 5) || !core_flag(args[1], &polygons) || !core_flag(args[2], &options.boxes) ||
        !core_flag(args[3], &options.wrap) || !PyUnicode_FSConverter(args[0], &path))
        return NULL;
    options.faces = polygons ? FROE_FACES_POLYGONS : FROE_FACES_TRIANGLES;
    options.alloc = &core_allocator;
    froe_scene *scene;
    froe_read_report report;
    core_call call;
    core_call_begin(&call, args[4]);
    options.progress = core_call_progress, options.user = &call;
    const froe_status status = froe_read_own(PyBytes_AsString(path), &options, &scene, &report, &call.diag);
    const bool done = core_call_end(&call, status);
    Py_DECREF(path);
    PyObject *parts[] = {done ? core_scene_object(scene) : NULL, done ? report_of(&report) : NULL};
    return core_tuple(2, parts);
}

/* generate(kind, count, seed) */
static PyObject *generate(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    const char *kind;
    uint32_t n;
    uint64_t seed;
    if (!core_arguments("generate", count, 3) || !(kind = core_text(args[0], "kind")) ||
        !core_unsigned(args[1], "count", INT32_MAX, &n) || !core_long(args[2], "seed", &seed))
        return NULL;
    froe_scene *scene;
    core_call call;
    core_call_begin(&call, Py_None);
    if (!core_call_end(&call, froe_generate(kind, n, seed, &core_allocator, &scene, &call.diag))) return NULL;
    return core_scene_object(scene);
}

/* export(path, what, progress): what 0: fragments, 1: cells, 2: cuts */
PyObject *core_tree_export(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    uint32_t what;
    PyObject *path;
    if (!core_arguments("export", count, 3) || !core_unsigned(args[1], "what", FROE_EXPORT_CUTS, &what) ||
        !PyUnicode_FSConverter(args[0], &path))
        return NULL;
    const froe_tree *tree = core_tree_use(self);
    bool done = tree;
    if (done) {
        froe_export_options options = froe_export_defaults();
        core_call call;
        core_call_begin(&call, args[2]);
        options.progress = core_call_progress, options.user = &call;
        const froe_status status =
            froe_export(tree, PyBytes_AsString(path), (froe_export_what)what, &options, &call.diag);
        done = core_call_end(&call, status);
        core_tree_leave(self);
    }
    Py_DECREF(path);
    return done ? Py_NewRef(Py_None) : NULL;
}

bool core_add_read(PyObject *module) {
    static PyMethodDef functions[] = {
        CORE_METHOD("read", read_scene), CORE_METHOD("generate", generate), {NULL, NULL, 0, NULL}};
    return PyModule_AddFunctions(module, functions) == 0;
}
