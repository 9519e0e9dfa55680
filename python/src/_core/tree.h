/* tree.h: trees, and their contexts for queries. */
#ifndef FROE_CORE_TREE_H
#define FROE_CORE_TREE_H
#include "core.h"
#include <froe/query.h>

typedef struct core_tree core_tree;

/** A tree that has just been made, which the object takes. NULL: an exception is set, and the tree is freed. */
PyObject *core_tree_object(froe_tree *tree);

/** The object as a tree; NULL: it is none, and an exception is set. */
core_tree *core_tree_from(PyObject *object);

/** The tree, which lasts until core_tree_leave(), even if it is closed meanwhile. NULL: it is closed, and an exception
 * is set. */
const froe_tree *core_tree_use(core_tree *self);
void core_tree_leave(core_tree *self);
/** A context of the tree's, and the same as core_tree_use(); core_tree_give() gives both back. */
froe_query *core_tree_take(core_tree *self);
void core_tree_give(core_tree *self, froe_query *query);

/** REQUIRES: in use. */
const froe_tree *core_tree_of(const core_tree *self);

/* Methods of the type. */
PyObject *core_ask_ranges(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_boxes(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_box(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_locate(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_groups(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_group_boxes(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_group_join(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_near(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_vertical(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_nearest_points(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_pairs(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_rays(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_ask_hit_places(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_save(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_check(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_to_bytes(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_report(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_audit(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_pieces(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_cells(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_order(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_render(PyObject *self, PyObject *const *args, Py_ssize_t count);
PyObject *core_tree_export(PyObject *self, PyObject *const *args, Py_ssize_t count);
#endif
