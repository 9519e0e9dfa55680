/* errors.h: statuses become exceptions, which froe/errors.py defines. */
#ifndef FROE_CORE_ERRORS_H
#define FROE_CORE_ERRORS_H
#include "core.h"

/** Sets the exception of a failure, with what the diagnostic knows. Returns NULL. */
PyObject *core_raise(froe_status status, const froe_diagnostic *diag);
/** The same with a sentence of the extension's own, in the format of PyUnicode_FromFormat(). */
PyObject *core_fail(froe_status status, const char *format, ...);
/** An exception of another class of froe/errors.py, by its name. */
PyObject *core_fail_as(const char *class_name, const char *format, ...);
/** Are there as many arguments? Otherwise TypeError. */
bool core_arguments(const char *function, Py_ssize_t given, Py_ssize_t wanted);
/** A whole number from 0 to `most`. `name` is what the message calls it. */
bool core_unsigned(PyObject *object, const char *name, uint32_t most, uint32_t *out);
/** A whole number from 0 to 2^64 - 1. */
bool core_long(PyObject *object, const char *name, uint64_t *out);
/** A number that float64 has, NaN and infinity as well. */
bool core_double(PyObject *object, const char *name, double *out);
/** Anything that is true or false. */
bool core_flag(PyObject *object, bool *out);
/** A str in UTF-8 without the character 0, which lives as long as the object; NULL: an exception is set. */
const char *core_text(PyObject *object, const char *name);
#endif
