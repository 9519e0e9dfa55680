/* scene_view.c: what a scene consists of: counts, bounds, groups, whole arrays; and as a file. */
#include "call.h"
#include "errors.h"
#include "memory.h"
#include "scene.h"
#include <froe/arrays.h>
#include <froe/formats.h>

/* counts(): (dim, objects, vertices, groups) */
PyObject *core_scene_counts(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    const froe_scene *s = core_arguments("counts", count, 0) ? core_scene_take((core_scene *)self) : NULL;
    if (!s) return NULL;
    core_scene_give((core_scene *)self);
    return Py_BuildValue("iKKK", froe_scene_dim(s), (unsigned long long)froe_scene_object_count(s),
                         (unsigned long long)froe_scene_vertex_count(s), (unsigned long long)froe_scene_group_count(s));
}

/* bounds(): two rows of dim numbers, or None for an empty scene */
PyObject *core_scene_bounds(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    const froe_scene *s = core_arguments("bounds", count, 0) ? core_scene_take((core_scene *)self) : NULL;
    if (!s) return NULL;
    core_scene_give((core_scene *)self);
    const size_t dim = (size_t)froe_scene_dim(s);
    double *box = core_allocate(2 * dim, sizeof *box);
    if (!box) return NULL;
    if (froe_scene_bounds(s, box, box + dim)) return core_array_of(box, "d", 2, dim);
    core_release(box, 2 * dim, sizeof *box);
    Py_RETURN_NONE;
}

/* ------------------------------------------------------------------- groups -- */

/* add_group(name, material, left, right, colour) */
PyObject *core_scene_add_group(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    froe_group group;
    uint32_t id = 0;
    if (!core_arguments("add_group", count, 5) || !(group.name = core_text(args[0], "name")) ||
        !(group.material = core_text(args[1], "material")) || !(group.left = core_text(args[2], "left")) ||
        !(group.right = core_text(args[3], "right")) || !core_unsigned(args[4], "colour", UINT32_MAX, &group.colour))
        return NULL;
    froe_scene *scene = core_scene_take_growing((core_scene *)self);
    if (!scene) return NULL;
    const froe_status status = froe_scene_add_group(scene, &group, &id);
    core_scene_give((core_scene *)self);
    if (!status) return PyLong_FromUnsignedLong(id);
    return core_fail(status, "The scene takes no further group: %s.", froe_status_text(status));
}

/* group(id): (name, material, left, right, colour) */
PyObject *core_scene_group(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    uint32_t id;
    if (!core_arguments("group", count, 1) || !core_unsigned(args[0], "group", FROE_NONE - 1, &id)) return NULL;
    const froe_scene *scene = core_scene_take((core_scene *)self);
    if (!scene) return NULL;
    core_scene_give((core_scene *)self);
    if (id >= froe_scene_group_count(scene)) return core_fail(FROE_E_ARG, "There is no group %u.", id);
    const froe_group group = froe_scene_group(scene, id);
    return Py_BuildValue("ssssI", group.name, group.material, group.left, group.right, (unsigned)group.colour);
}

/* ------------------------------------------------------------------- arrays -- */

static void free_arrays(void *block) {
    froe_scene_arrays_free(block);
}

/* (coords, kinds, forms, starts, corners, radii, tags, faces, groups) */
static PyObject *arrays_object(const froe_scene_arrays *a) {
    PyObject *owner = core_owner(a, sizeof *a, free_arrays);
    const size_t n = a->object_count;
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, a->coords, "d", a->vertex_count, (size_t)a->dim, 0),
                         core_array(owner, a->kinds, "B", n, 0, 0),
                         core_array(owner, a->forms, "B", n, 0, 0),
                         core_array(owner, a->starts, "q", n + 1, 0, 0),
                         core_array(owner, a->corners, "i", a->corner_count, 0, 0),
                         core_array(owner, a->radii, "d", n, 0, 0),
                         core_array(owner, a->tags, "Q", n, 0, 0),
                         core_array(owner, a->faces, "i", n, 0, 0),
                         core_array(owner, a->groups, "i", n, 0, 0)};
    Py_DECREF(owner);
    return core_tuple(9, parts);
}

/* arrays() */
PyObject *core_scene_arrays(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    (void)args;
    const froe_scene *scene = core_arguments("arrays", count, 0) ? core_scene_take((core_scene *)self) : NULL;
    if (!scene) return NULL;
    froe_scene_arrays arrays;
    core_call call;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_arrays_of_scene(scene, &core_allocator, &arrays, &call.diag);
    const bool done = core_call_end(&call, status);
    core_scene_give((core_scene *)self);
    return done ? arrays_object(&arrays) : NULL;
}

/* write(path) */
PyObject *core_scene_write(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    PyObject *path;
    if (!core_arguments("write", count, 1) || !PyUnicode_FSConverter(args[0], &path)) return NULL;
    const froe_scene *scene = core_scene_take((core_scene *)self);
    bool done = scene;
    if (done) {
        core_call call;
        core_call_begin(&call, Py_None);
        done = core_call_end(&call, froe_write_scene(scene, PyBytes_AsString(path), &call.diag));
        core_scene_give((core_scene *)self);
    }
    Py_DECREF(path);
    return done ? Py_NewRef(Py_None) : NULL;
}
