#include "input.h"
#include "errors.h"
#include "memory.h"
#include <string.h>

/* Does a format of the struct module name this type, in the byte order and size of this machine? */
static bool is_type(const char *format, Py_ssize_t item, char wanted) {
    if (!format) format = "B";
    if (*format == '@' || *format == '=') format++;
    if (!format[0] || format[1]) return false;
    if (wanted == 'd') return *format == 'd' && item == 8;
    return strchr("ILQNilqn", *format) && item == (wanted == 'I' ? 4 : 8);
}

static const char *type_name(char format) {
    return format == 'd' ? "float64" : format == 'I' ? "uint32" : "uint64";
}

static bool check(const Py_buffer *view, const char *name, char format, size_t width, size_t *count) {
    const size_t item = format == 'I' ? 4 : 8, items = (size_t)view->len / item;
    if (!is_type(view->format, view->itemsize, format))
        return core_fail_as("ArrayError", "%s must be an array of %s, and its format is '%s'.", name, type_name(format),
                            view->format ? view->format : "B");
    if ((uintptr_t)view->buf % item)
        return core_fail_as("ArrayError", "The items of %s do not lie at multiples of %zu bytes.", name, item);
    if (items % width)
        return core_fail_as("ArrayError", "%s has %zu items, which do not make rows of %zu.", name, items, width);
    *count = items / width;
    return true;
}

bool core_input_take(core_input *in, PyObject *object, const char *name, char format, size_t width, bool optional) {
    memset(in, 0, sizeof *in);
    if (optional && object == Py_None) return true;
    if (PyObject_GetBuffer(object, &in->view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT)) {
        PyErr_Clear();
        return core_fail_as("ArrayError", "%s must be a C-contiguous array of %s.", name, type_name(format));
    }
    if (!check(&in->view, name, format, width, &in->count)) {
        PyBuffer_Release(&in->view);
        return false;
    }
    in->data = in->view.buf;
    in->bytes = (size_t)in->view.len;
    if (in->view.readonly) return true;
    in->copy = core_allocate(in->bytes, 1);
    if (in->copy) memcpy(in->copy, in->data, in->bytes);
    PyBuffer_Release(&in->view);
    in->data = in->copy;
    return in->copy;
}

bool core_input_take_count(core_input *in, PyObject *object, const char *name, char format, size_t width, size_t count,
                           bool optional) {
    if (!core_input_take(in, object, name, format, width, optional)) return false;
    if (!in->data || in->count == count) return true;
    core_fail_as("ArrayError", "%s has %zu rows, and must have %zu.", name, in->count, count);
    core_input_give(in);
    return false;
}

void core_input_give(core_input *in) {
    if (in->copy)
        core_release(in->copy, in->bytes, 1);
    else if (in->data)
        PyBuffer_Release(&in->view);
    in->data = in->copy = NULL;
}
