/* module.c: the module froe._core. */
#include "core.h"
#include "errors.h"

PyTypeObject *core_add_type(PyObject *module, PyType_Spec *spec) {
    PyTypeObject *type = (PyTypeObject *)PyType_FromSpec(spec);
    if (!type) return NULL;
    if (PyModule_AddType(module, type) == 0) return type;
    Py_DECREF(type);
    return NULL;
}

void core_free_object(PyObject *object) {
    PyTypeObject *type = Py_TYPE(object);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, "froe._core", NULL, -1, NULL, NULL, NULL, NULL, NULL};

PyMODINIT_FUNC PyInit__core(void) {
    PyObject *module = PyModule_Create(&definition);
    if (module && core_errors_begin() && core_add_memory(module) && core_add_scene(module) && core_add_tree(module) &&
        core_add_tree_files(module) && core_add_read(module) && core_add_motion(module) &&
        core_add_motion_files(module) && core_add_kinetic(module) &&
        PyModule_AddStringConstant(module, "version", froe_version()) == 0)
        return module;
    Py_XDECREF(module);
    return NULL;
}
