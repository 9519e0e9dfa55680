/* picture.c: pictures of trees in space with hidden surfaces removed. Options come as a dictionary, whose keys are the
 * fields of froe_render_options and of its camera; src/froe/pictures.py turns names into their numbers. */
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"
#include <froe/render.h>
#include <stddef.h>

/* ------------------------------------------------------------------ options -- */

typedef enum field_kind { FLAG, REAL, POINT, WHOLE, TEXT } field_kind;

typedef struct field {
    const char *name;
    field_kind kind;
    size_t offset;
} field;

#define OPTION(kind, name)                                                                                             \
    { #name, kind, offsetof(froe_render_options, name) }
#define CAMERA(kind, name)                                                                                             \
    { #name, kind, offsetof(froe_render_options, camera) + offsetof(froe_camera, name) }

static const field fields[] = {
    CAMERA(FLAG, parallel),    CAMERA(FLAG, fit),         CAMERA(POINT, eye),        CAMERA(POINT, target),
    CAMERA(POINT, up),         CAMERA(REAL, fov),         CAMERA(REAL, scale),       CAMERA(REAL, width),
    CAMERA(REAL, height),      CAMERA(REAL, margin),      OPTION(FLAG, millimetres), OPTION(WHOLE, shading),
    OPTION(WHOLE, cel_levels), OPTION(WHOLE, paint),      OPTION(WHOLE, seams),      OPTION(REAL, seam_width),
    OPTION(WHOLE, lines),      OPTION(REAL, crease),      OPTION(REAL, line_width),  OPTION(REAL, point_width),
    OPTION(FLAG, interleaved), OPTION(FLAG, hidden),      OPTION(REAL, halo),        OPTION(FLAG, own_colours),
    OPTION(FLAG, cull_back),   OPTION(WHOLE, background), OPTION(WHOLE, decimals),   OPTION(WHOLE, ids),
    OPTION(WHOLE, layers),     OPTION(REAL, min_area),    OPTION(TEXT, title),       OPTION(TEXT, description),
};

_Static_assert(sizeof(froe_shading) == 4 && sizeof(int) == 4, "whole numbers of options have 32 bits");

static bool set_point(PyObject *value, const char *name, double *out) {
    core_input in;
    if (!core_input_take_count(&in, value, name, 'd', 3, 1, false)) return false;
    memcpy(out, in.data, 3 * sizeof *out);
    core_input_give(&in);
    return true;
}

static bool set_field(froe_render_options *options, const field *f, PyObject *value) {
    void *at = (char *)options + f->offset;
    switch (f->kind) {
    case FLAG:
        return core_flag(value, at);
    case REAL:
        *(double *)at = PyFloat_AsDouble(value);
        return !PyErr_Occurred();
    case POINT:
        return set_point(value, f->name, at);
    case WHOLE:
        return core_unsigned(value, f->name, UINT32_MAX, at);
    default:
        return (*(const char **)at = core_text(value, f->name));
    }
}

static const field *field_of(const char *name) {
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (!strcmp(fields[i].name, name)) return &fields[i];
    return NULL;
}

static bool set_options(froe_render_options *options, PyObject *dict) {
    *options = froe_render_defaults();
    options->alloc = &core_allocator;
    if (!PyDict_Check(dict)) return core_fail_as("ArrayError", "Options must be a dict.");
    PyObject *name, *value;
    Py_ssize_t at = 0;
    while (PyDict_Next(dict, &at, &name, &value)) {
        const char *text = core_text(name, "The name of an option");
        const field *found = text ? field_of(text) : NULL;
        if (text && !found) return core_fail(FROE_E_OPTIONS, "There is no option %R of pictures.", name);
        if (!found || !set_field(options, found, value)) return false;
    }
    return true;
}

/* --------------------------------------------------------------- to memory -- */

static PyObject *report_of(const froe_render_report *r) {
    const froe_visibility_report *v = &r->picture.visibility;
    return Py_BuildValue("{s:s,s:K,s:K,s:K,s:K,s:K,s:K,s:K,s:K,s:K}", "paint", froe_paint_name(r->picture.paint),
                         "pieces", (unsigned long long)v->pieces, "visible_pieces",
                         (unsigned long long)v->visible_pieces, "visible_faces", (unsigned long long)v->visible_patches,
                         "hidden_faces", (unsigned long long)v->hidden, "shapes", (unsigned long long)r->shapes,
                         "lines", (unsigned long long)(r->strokes - r->dots), "points", (unsigned long long)r->dots,
                         "paths", (unsigned long long)r->paths, "bytes", (unsigned long long)r->bytes);
}

/* Into memory where path is NULL. */
static bool run(const froe_tree *tree, froe_render_options *options, const char *path, froe_render_format format,
                PyObject *progress, core_pile *to, froe_render_report *report) {
    core_call call;
    core_call_begin(&call, progress);
    call.pile = to;
    options->progress = core_call_progress, options->user = &call;
    const froe_status status = path ? froe_render(tree, path, options, report, &call.diag)
                                    : froe_render_write(tree, format, core_pile_put, to, options, report, &call.diag);
    return core_call_end(&call, status);
}

/* render(path or None, format, options, progress): (bytes, report) */
PyObject *core_tree_render(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    froe_render_options options;
    froe_render_report report;
    uint32_t format;
    PyObject *path = NULL;
    core_pile to = {0};
    if (!core_arguments("render", count, 4) ||
        !core_unsigned(args[1], "format", FROE_RENDER_FORMAT_COUNT - 1, &format) || !set_options(&options, args[2]) ||
        (args[0] != Py_None && !PyUnicode_FSConverter(args[0], &path)))
        return NULL;
    const froe_tree *tree = core_tree_use(self);
    const bool done = tree && run(tree, &options, path ? PyBytes_AsString(path) : NULL, (froe_render_format)format,
                                  args[3], &to, &report);
    if (tree) core_tree_leave(self);
    Py_XDECREF(path);
    PyObject *parts[] = {done ? PyBytes_FromStringAndSize(to.bytes, (Py_ssize_t)to.count) : NULL,
                         done ? report_of(&report) : NULL};
    core_pile_free(&to);
    return core_tuple(2, parts);
}
