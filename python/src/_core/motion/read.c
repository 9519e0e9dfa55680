/* read.c: motions from files, and made-up ones. */
#include "motion/motion.h"
#include "scene.h"
#include <froe/formats.h>

/* read_motion(path) */
static PyObject *read_motion(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    PyObject *path;
    if (!core_arguments("read_motion", count, 1) || !PyUnicode_FSConverter(args[0], &path)) return NULL;
    froe_motion_read_options options = froe_motion_read_defaults();
    options.alloc = &core_allocator;
    froe_motion *motion;
    core_call call;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_read_motion(PyBytes_AsString(path), &options, &motion, NULL, &call.diag);
    const bool done = core_call_end(&call, status);
    Py_DECREF(path);
    return done ? core_motion_object(motion) : NULL;
}

/* args: path, scene of the model, begin, end: NaN: of the file */
static bool take_poses(PyObject *const *args, core_scene **model, froe_motion_read_options *options, PyObject **path) {
    *options = froe_motion_read_defaults();
    options->alloc = &core_allocator;
    return core_double(args[2], "begin", &options->from) && core_double(args[3], "end", &options->to) &&
           (*model = core_scene_from(args[1])) && PyUnicode_FSConverter(args[0], path);
}

/* read_poses(path, scene of the model, begin, end) */
static PyObject *read_poses(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    core_scene *model;
    froe_motion_read_options options;
    PyObject *path;
    if (!core_arguments("read_poses", count, 4) || !take_poses(args, &model, &options, &path)) return NULL;
    const froe_scene *scene = core_scene_take(model);
    froe_motion *motion = NULL;
    bool done = scene;
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        const froe_status status = froe_read_poses(PyBytes_AsString(path), scene, &options, &motion, NULL, &call.diag);
        done = core_call_end(&call, status);
        core_scene_give(model);
    }
    Py_DECREF(path);
    return done ? core_motion_object(motion) : NULL;
}

/* generate_motion(kind, count, seed) */
static PyObject *generate_motion(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    const char *kind;
    uint32_t n;
    uint64_t seed;
    if (!core_arguments("generate_motion", count, 3) || !(kind = core_text(args[0], "kind")) ||
        !core_unsigned(args[1], "count", INT32_MAX, &n) || !core_long(args[2], "seed", &seed))
        return NULL;
    froe_motion *motion;
    core_call call;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_generate_motion(kind, n, seed, &core_allocator, &motion, &call.diag);
    return core_call_end(&call, status) ? core_motion_object(motion) : NULL;
}

bool core_add_motion_files(PyObject *module) {
    static PyMethodDef functions[] = {CORE_METHOD("read_motion", read_motion),
                                      CORE_METHOD("read_poses", read_poses),
                                      CORE_METHOD("generate_motion", generate_motion),
                                      {NULL, NULL, 0, NULL}};
    return PyModule_AddFunctions(module, functions) == 0;
}
