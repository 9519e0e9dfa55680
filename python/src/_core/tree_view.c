/* tree_view.c: what a tree consists of: its report, pieces and cells; and whether it is right. */
#include "call.h"
#include "errors.h"
#include "input.h"
#include "memory.h"
#include "tree.h"
#include <froe/arrays.h>
#include <froe/view.h>

/* ------------------------------------------------------------------- report -- */

/* Adds all numbers; false: an exception is set. */
typedef struct named_number {
    const char *name;
    uint64_t value;
} named_number;

static bool add_numbers(PyObject *dict, const named_number *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        PyObject *value = PyLong_FromUnsignedLongLong(numbers[i].value);
        const int failed = value ? PyDict_SetItemString(dict, numbers[i].name, value) : -1;
        Py_XDECREF(value);
        if (failed) return false;
    }
    return true;
}

/* [(name, promised, measured), ...] */
static PyObject *promises_of(const froe_promise *promises) {
    PyObject *list = PyList_New(0);
    for (; list && promises && promises->name; promises++) {
        PyObject *one = Py_BuildValue("(sdd)", promises->name, promises->promised, promises->measured);
        if (!one || PyList_Append(list, one)) Py_CLEAR(list);
        Py_XDECREF(one);
    }
    return list;
}

static PyObject *report_of(const froe_report *r) {
    const froe_predicate_stats *p = &r->predicates;
    const named_number numbers[] = {
        {"leaf", r->leaf},
        {"seed", r->seed},
        {"objects", r->objects},
        {"nodes", r->nodes},
        {"leaves", r->leaves},
        {"pieces", r->fragments},
        {"in_cut", r->in_cut},
        {"covers", r->covers},
        {"size", r->size},
        {"height", r->height},
        {"max_leaf", r->max_leaf},
        {"inseparable", r->inseparable},
        {"crowded", r->crowded},
        {"bytes", r->bytes},
        {"predicates", p->calls},
        {"predicates_by_id", p->by_id},
        {"predicates_filtered", p->filtered},
        {"predicates_refined", p->refined},
        {"predicates_exact", p->exact},
    };
    PyObject *dict = Py_BuildValue("{s:s,s:s,s:i,s:d,s:N}", "method", r->method, "settings", r->settings, "dim", r->dim,
                                   "mean_depth", r->mean_depth, "promises", promises_of(r->promises));
    if (dict && !add_numbers(dict, numbers, sizeof numbers / sizeof *numbers)) Py_CLEAR(dict);
    return dict;
}

/* report() */
PyObject *core_tree_report(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    (void)args;
    if (!core_arguments("report", count, 0)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    const froe_report report = froe_tree_report(tree);
    PyObject *answer = report_of(&report);
    core_tree_leave(self);
    return answer;
}

/* audit(exact_only, threads, progress) */
PyObject *core_tree_audit(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    froe_audit_options options = froe_audit_defaults();
    if (!core_arguments("audit", count, 3) || !core_flag(args[0], &options.exact_only) ||
        !core_unsigned(args[1], "threads", UINT32_MAX, &options.threads))
        return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    core_call call;
    core_call_begin(&call, args[2]);
    options.progress = core_call_progress, options.user = &call;
    const bool done = core_call_end(&call, froe_tree_audit(tree, &options, &call.diag));
    core_tree_leave(self);
    return done ? Py_NewRef(Py_None) : NULL;
}

/* ------------------------------------------------------------------- arrays -- */

static void free_pieces(void *block) {
    froe_piece_arrays_free(block);
}

/* (objects, nodes, whole, starts, coords, made) */
static PyObject *pieces_object(const froe_piece_arrays *a) {
    PyObject *owner = core_owner(a, sizeof *a, free_pieces);
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, a->objects, "i", a->count, 0, 0),
                         core_array(owner, a->nodes, "i", a->count, 0, 0),
                         core_array(owner, a->whole, "B", a->count, 0, 0),
                         core_array(owner, a->starts, "q", a->count + 1, 0, 0),
                         core_array(owner, a->coords, "d", a->corner_count, (size_t)a->dim, 0),
                         core_array(owner, a->made, "i", a->corner_count, 0, 0)};
    Py_DECREF(owner);
    return core_tuple(6, parts);
}

/* pieces() */
PyObject *core_tree_pieces(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    (void)args;
    if (!core_arguments("pieces", count, 0)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    froe_piece_arrays arrays;
    core_call call;
    core_call_begin(&call, Py_None);
    const froe_status status = froe_arrays_of_pieces(tree, &core_allocator, &arrays, &call.diag);
    const bool done = core_call_end(&call, status);
    core_tree_leave(self);
    return done ? pieces_object(&arrays) : NULL;
}

static void free_cells(void *block) {
    froe_cell_arrays_free(block);
}

/* (nodes, depths, faces, starts, coords) */
static PyObject *cells_object(const froe_cell_arrays *a) {
    PyObject *owner = core_owner(a, sizeof *a, free_cells);
    if (!owner) return NULL;
    PyObject *parts[] = {core_array(owner, a->nodes, "i", a->count, 0, 0),
                         core_array(owner, a->depths, "i", a->count, 0, 0),
                         core_array(owner, a->faces, "q", a->count + 1, 0, 0),
                         core_array(owner, a->starts, "q", a->face_count + 1, 0, 0),
                         core_array(owner, a->coords, "d", a->corner_count, (size_t)a->dim, 0)};
    Py_DECREF(owner);
    return core_tuple(5, parts);
}

/* cells(lo and hi as one array, inner) */
PyObject *core_tree_cells(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    bool inner;
    if (!core_arguments("cells", count, 2) || !core_flag(args[1], &inner)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    const size_t dim = (size_t)froe_scene_dim(froe_tree_scene(tree));
    core_input box = {0};
    froe_cell_arrays arrays;
    bool done = core_input_take_count(&box, args[0], "box", 'd', dim, 2, false);
    if (done) {
        const double *lo = box.data;
        core_call call;
        core_call_begin(&call, Py_None);
        const froe_status status =
            froe_arrays_of_cells(tree, lo, lo + dim, inner, &core_allocator, &arrays, &call.diag);
        done = core_call_end(&call, status);
    }
    core_input_give(&box);
    core_tree_leave(self);
    return done ? cells_object(&arrays) : NULL;
}

/* -------------------------------------------------------------------- order -- */

typedef struct order_list {
    uint32_t *pieces;
    size_t count;
} order_list;

static bool take_piece(void *user, size_t piece) {
    order_list *list = user;
    list->pieces[list->count++] = (uint32_t)piece;
    return true;
}

/* order(eye of dim doubles, parallel): all pieces, back to front */
PyObject *core_tree_order(PyObject *object, PyObject *const *args, Py_ssize_t count) {
    core_tree *self = (core_tree *)object;
    froe_eye from = {.parallel = false};
    if (!core_arguments("order", count, 2) || !core_flag(args[1], &from.parallel)) return NULL;
    const froe_tree *tree = core_tree_use(self);
    if (!tree) return NULL;
    const size_t dim = (size_t)froe_scene_dim(froe_tree_scene(tree)), pieces = froe_tree_piece_count(tree);
    core_input eye = {0};
    order_list list = {core_allocate(pieces, sizeof *list.pieces), 0};
    bool done = list.pieces && core_input_take_count(&eye, args[0], "eye", 'd', dim, 1, false);
    if (done) {
        for (size_t i = 0; i < dim && i < 3; i++) from.at[i] = ((const double *)eye.data)[i];
        core_call call;
        core_call_begin(&call, Py_None);
        const froe_status status = froe_tree_order(tree, &from, NULL, take_piece, &list, &call.diag);
        done = core_call_end(&call, status);
    }
    core_input_give(&eye);
    core_tree_leave(self);
    if (done) return core_array_of(list.pieces, "i", pieces, 0);
    if (list.pieces) core_release(list.pieces, pieces, sizeof *list.pieces);
    return NULL;
}
