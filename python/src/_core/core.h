/* core.h: what the files of the extension froe._core share. It is written by hand on the limited API of CPython 3.11
 * and sees the public headers alone, as any program does. Methods take positional arguments (METH_FASTCALL); names,
 * defaults and documents are the package's (src/froe), which also brings arrays into the form that is taken here. */
#ifndef FROE_CORE_CORE_H
#define FROE_CORE_CORE_H
#define Py_LIMITED_API 0x030b0000
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <froe/froe.h>
#include <string.h>

/** A method of METH_FASTCALL, as PyMethodDef takes it. */
#define CORE_METHOD(name, function)                                                                                    \
    { name, (PyCFunction)(void (*)(void))(function), METH_FASTCALL, NULL }

/** Makes a type of the module, and adds it under the last part of its name. NULL: an exception is set. */
PyTypeObject *core_add_type(PyObject *module, PyType_Spec *spec);
/** Frees an object of a heap type, its memory and its reference to the type, at the end of tp_dealloc. */
void core_free_object(PyObject *object);

/* Each file that has a type or functions adds them. false: an exception is set. */
bool core_errors_begin(void);
bool core_add_memory(PyObject *module);
bool core_add_scene(PyObject *module);
bool core_add_tree(PyObject *module);
bool core_add_read(PyObject *module);
bool core_add_motion(PyObject *module);
bool core_add_motion_files(PyObject *module);
bool core_add_kinetic(PyObject *module);
bool core_add_tree_files(PyObject *module);
#endif
