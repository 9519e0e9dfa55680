/* scene_crs.c: the coordinate system of a scene, and what crosses the antimeridian there. */
#include "errors.h"
#include "scene.h"

/* crs(): (kind, wkt, name, code, unit); kind 0: unknown */
PyObject *core_scene_crs(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    const froe_scene *s = core_arguments("crs", count, 0) ? core_scene_take((core_scene *)self) : NULL;
    if (!s) return NULL;
    const froe_crs crs = froe_scene_crs(s);
    PyObject *found = Py_BuildValue("issss", (int)crs.kind, crs.wkt, crs.name, crs.code, crs.unit);
    core_scene_give((core_scene *)self);
    return found;
}

/* set_crs(kind, wkt, name, code, unit) */
PyObject *core_scene_set_crs(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    froe_crs crs;
    uint32_t kind;
    if (!core_arguments("set_crs", count, 5) || !core_unsigned(args[0], "kind", FROE_CRS_KIND_COUNT - 1, &kind) ||
        !(crs.wkt = core_text(args[1], "wkt")) || !(crs.name = core_text(args[2], "name")) ||
        !(crs.code = core_text(args[3], "code")) || !(crs.unit = core_text(args[4], "unit")))
        return NULL;
    crs.kind = (froe_crs_kind)kind;
    froe_scene *scene = core_scene_take_growing((core_scene *)self);
    if (!scene) return NULL;
    const froe_status status = froe_scene_set_crs(scene, &crs);
    core_scene_give((core_scene *)self);
    if (!status) return Py_NewRef(Py_None);
    return core_fail(status, "The scene takes no coordinate system: %s.", froe_status_text(status));
}

/* across(): how many features seem to cross the antimeridian */
PyObject *core_scene_across(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    const froe_scene *s = core_arguments("across", count, 0) ? core_scene_take((core_scene *)self) : NULL;
    if (!s) return NULL;
    const size_t features = froe_scene_across(s, NULL);
    core_scene_give((core_scene *)self);
    return PyLong_FromSize_t(features);
}
