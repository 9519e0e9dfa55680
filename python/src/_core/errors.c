#include "errors.h"
#include <stdarg.h>

/* The functions froe.errors.of_status and froe.errors.of_name, which make exceptions. */
static PyObject *of_status, *of_name;

bool core_errors_begin(void) {
    PyObject *module = PyImport_ImportModule("froe.errors");
    of_status = module ? PyObject_GetAttrString(module, "of_status") : NULL;
    of_name = module ? PyObject_GetAttrString(module, "of_name") : NULL;
    Py_XDECREF(module);
    return of_status && of_name;
}

/* Sets an exception that a function of froe.errors has made, which it takes. */
static PyObject *set(PyObject *exception) {
    if (exception) PyErr_SetObject((PyObject *)Py_TYPE(exception), exception);
    Py_XDECREF(exception);
    return NULL;
}

/* None for FROE_NONE. */
static PyObject *number(uint32_t value) {
    if (value == FROE_NONE) return Py_NewRef(Py_None);
    return PyLong_FromUnsignedLong(value);
}

PyObject *core_raise(froe_status status, const froe_diagnostic *diag) {
    const char *message = diag->message[0] ? diag->message : froe_status_text(status);
    return set(PyObject_CallFunction(of_status, "isNNN", (int)status, message, number(diag->object),
                                     number(diag->corner), number(diag->axis)));
}

PyObject *core_fail(froe_status status, const char *format, ...) {
    va_list list;
    va_start(list, format);
    PyObject *message = PyUnicode_FromFormatV(format, list);
    va_end(list);
    return message ? set(PyObject_CallFunction(of_status, "iN", (int)status, message)) : NULL;
}

PyObject *core_fail_as(const char *class_name, const char *format, ...) {
    va_list list;
    va_start(list, format);
    PyObject *message = PyUnicode_FromFormatV(format, list);
    va_end(list);
    return message ? set(PyObject_CallFunction(of_name, "sN", class_name, message)) : NULL;
}

bool core_arguments(const char *function, Py_ssize_t given, Py_ssize_t wanted) {
    if (given == wanted) return true;
    PyErr_Format(PyExc_TypeError, "%s() takes %zd arguments, and %zd were given.", function, wanted, given);
    return false;
}

static bool is_whole(PyObject *object, const char *name) {
    return PyIndex_Check(object) || core_fail_as("ArrayError", "%s is %R, and must be a whole number.", name, object);
}

bool core_unsigned(PyObject *object, const char *name, uint32_t most, uint32_t *out) {
    int overflow;
    if (!is_whole(object, name)) return false;
    const long long value = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (value == -1 && !overflow && PyErr_Occurred()) return false;
    if (overflow || value < 0 || value > most)
        return core_fail(FROE_E_ARG, "%s is %S, and must be between 0 and %lu.", name, object, (unsigned long)most);
    *out = (uint32_t)value;
    return true;
}

bool core_long(PyObject *object, const char *name, uint64_t *out) {
    if (!is_whole(object, name)) return false;
    PyObject *number = PyNumber_Index(object);
    if (!number) return false;
    *out = PyLong_AsUnsignedLongLong(number);
    Py_DECREF(number);
    if (*out != UINT64_MAX || !PyErr_Occurred()) return true;
    PyErr_Clear();
    return core_fail(FROE_E_ARG, "%s is %S, and must be between 0 and 2^64 - 1.", name, object);
}

/* Is the number this double, and not only near it? */
static bool is_double(PyObject *object, double value) {
    PyObject *made = PyFloat_FromDouble(value);
    const int same = made ? PyObject_RichCompareBool(object, made, Py_EQ) : -1;
    Py_XDECREF(made);
    return same == 1;
}

bool core_double(PyObject *object, const char *name, double *out) {
    *out = PyFloat_AsDouble(object);
    const bool large = PyErr_Occurred() && PyErr_ExceptionMatches(PyExc_OverflowError);
    if (PyErr_Occurred() && !large) {
        if (!PyErr_ExceptionMatches(PyExc_TypeError)) return false;
        PyErr_Clear();
        return core_fail_as("ArrayError", "%s is %R, and must be a number.", name, object);
    }
    if (!large && (PyFloat_CheckExact(object) || *out != *out || is_double(object, *out))) return true;
    if (PyErr_Occurred() && !large) return false;
    PyErr_Clear();
    return core_fail_as("ArrayError", "%s is %S, which float64 cannot hold.", name, object);
}

const char *core_text(PyObject *object, const char *name) {
    Py_ssize_t length;
    if (!PyUnicode_Check(object)) return (const char *)core_fail_as("ArrayError", "%s must be a str.", name);
    const char *text = PyUnicode_AsUTF8AndSize(object, &length);
    if (text && strlen(text) == (size_t)length) return text;
    PyErr_Clear();
    return (const char *)core_fail(FROE_E_ARG, "%s has a character that is not allowed: %A.", name, object);
}

bool core_flag(PyObject *object, bool *out) {
    const int truth = PyObject_IsTrue(object);
    *out = truth == 1;
    return truth >= 0;
}
