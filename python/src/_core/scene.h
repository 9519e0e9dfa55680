/* scene.h: scenes. */
#ifndef FROE_CORE_SCENE_H
#define FROE_CORE_SCENE_H
#include "tree.h"

typedef struct core_scene core_scene;

/** A scene that has just been made, which the object takes. NULL: an exception is set, and the scene is freed. */
PyObject *core_scene_object(froe_scene *scene);
/** The object as a scene; NULL: it is none, and an exception is set. */
core_scene *core_scene_from(PyObject *object);
/** The scene of a tree, which the object keeps, even if it is closed. NULL: an exception is set. */
PyObject *core_scene_of_tree(core_tree *tree);
/** The scene, for this call alone until core_scene_give(). NULL: it is in use, and an exception is set. */
froe_scene *core_scene_take(core_scene *self);
/** The same for calls that change it: a scene of a tree is frozen. */
froe_scene *core_scene_take_growing(core_scene *self);
void core_scene_give(core_scene *self);

/* Methods of the type: scene_view.c, scene_crs.c, measure.c. */
PyObject *core_scene_add_group(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_group(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_counts(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_bounds(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_arrays(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_crs(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_set_crs(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_across(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_scene_write(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_measure_defects(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_measure_fatness(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_measure_density(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_measure_clutter(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_measure_directional(PyObject *self, PyObject *const *args, Py_ssize_t count);
#endif
