/* range.c: which objects meet boxes, balls, segments and polygons; how many do; whether any does; and how groups
 * lie to them. */
#include "ask/ask.h"

/* ------------------------------------------------------------------- ranges -- */

/* What ranges() is about, in the order of its arguments. */
typedef struct range_batch {
    froe_range like;     /* what all have in common */
    size_t width, count; /* doubles of one range, where all have as many */
    const double *points, *radii;
    const size_t *starts; /* of the points of hulls */
    froe_range *ranges;
    froe_relation relation; /* of groups to the ranges */
} range_batch;

enum { POINTS, STARTS, RADII };

static size_t doubles_of(froe_range_shape shape, size_t dim) {
    switch (shape) {
    case FROE_SHAPE_BOX:
    case FROE_SHAPE_CAPSULE:
    case FROE_SHAPE_SEGMENT:
    case FROE_SHAPE_RAY:
        return 2 * dim;
    case FROE_SHAPE_SIMPLEX:
        return (dim + 1) * dim;
    default: /* balls, and points of hulls */
        return dim;
    }
}

static bool check_starts(const core_ask *ask, size_t *count) {
    const core_input *starts = &ask->in[STARTS];
    const size_t *at = starts->data, last = starts->count - 1;
    if (!starts->count) return core_fail_as("ArrayError", "starts has no items, and needs at least one.");
    for (size_t i = 0; i < last; i++)
        if (at[i] >= at[i + 1])
            return core_fail(FROE_E_INPUT, "Hull %zu has no points: its starts go from %zu to %zu.", i, at[i],
                             at[i + 1]);
    if (at[last] > ask->in[POINTS].count)
        return core_fail(FROE_E_INPUT, "starts ends at %zu, and there are %zu points.", at[last],
                         ask->in[POINTS].count);
    *count = last;
    return true;
}

/* args: shape, points, starts, radii, eps, walk */
static bool take_ranges(core_ask *ask, range_batch *b, PyObject *const *args) {
    uint32_t shape, walk;
    b->like = froe_range_defaults();
    if (!core_double(args[4], "eps", &b->like.eps) || !core_unsigned(args[0], "shape", FROE_SHAPE_COUNT - 1, &shape) ||
        !core_unsigned(args[5], "walk", FROE_WALK_COUNT - 1, &walk))
        return false;
    b->like.shape = (froe_range_shape)shape;
    b->like.walk = (froe_walk)walk;
    if (b->like.shape == FROE_SHAPE_HALFSPACES) return core_fail(FROE_E_ARG, "Halfspaces are not taken here.");
    b->width = doubles_of(b->like.shape, ask->dim);
    if (!core_input_take(&ask->in[POINTS], args[1], "points", 'd', b->width, false) ||
        !core_input_take(&ask->in[STARTS], args[2], "starts", 'Q', 1, b->like.shape != FROE_SHAPE_HULL))
        return false;
    b->count = ask->in[POINTS].count;
    if (ask->in[STARTS].data && !check_starts(ask, &b->count)) return false;
    if (!core_input_take_count(&ask->in[RADII], args[3], "radii", 'd', 1, b->count, true)) return false;
    b->points = ask->in[POINTS].data, b->starts = ask->in[STARTS].data, b->radii = ask->in[RADII].data;
    b->ranges = core_allocate(b->count, sizeof *b->ranges);
    return b->ranges;
}

/* Without the GIL. */
static void fill_ranges(range_batch *b) {
    for (size_t i = 0; i < b->count; i++) {
        froe_range *range = &b->ranges[i];
        *range = b->like;
        range->points = b->points + (b->starts ? b->starts[i] : i) * b->width;
        if (b->starts) range->count = b->starts[i + 1] - b->starts[i];
        if (b->radii) range->radius = b->radii[i];
    }
}

/* -------------------------------------------------------------------- modes -- */

static PyObject *ask_ids(core_ask *ask, range_batch *b) {
    froe_answers answers;
    core_ask_run(ask);
    fill_ranges(b);
    const froe_status status =
        froe_batch_range(ask->query, b->ranges, b->count, &ask->options, &answers, &ask->call.diag);
    return core_ask_answers(ask, status, &answers);
}

static PyObject *ask_counts(core_ask *ask, range_batch *b) {
    uint64_t *counts = core_allocate(b->count, sizeof *counts);
    if (!counts) return NULL;
    core_ask_run(ask);
    fill_ranges(b);
    const froe_status status =
        froe_batch_count(ask->query, b->ranges, b->count, &ask->options, counts, &ask->call.diag);
    return core_ask_array(ask, status, counts, "q", b->count, 0);
}

static PyObject *ask_any(core_ask *ask, range_batch *b) {
    uint32_t *objects = core_allocate(b->count, sizeof *objects);
    if (!objects) return NULL;
    core_ask_run(ask);
    fill_ranges(b);
    const froe_status status = froe_batch_any(ask->query, b->ranges, b->count, &ask->options, objects, &ask->call.diag);
    return core_ask_array(ask, status, objects, "i", b->count, 0);
}

static PyObject *ask_groups(core_ask *ask, range_batch *b) {
    froe_answers answers;
    core_ask_run(ask);
    fill_ranges(b);
    const froe_status status =
        froe_batch_groups_range(ask->query, b->ranges, b->count, b->relation, &ask->options, &answers, &ask->call.diag);
    return core_ask_answers(ask, status, &answers);
}

/* ------------------------------------------------------------------ methods -- */

enum { MODE_GROUPS = 3 };

/* ranges(mode, shape, points, starts, radii, eps, walk, threads, progress): mode 0: ids, 1: counts, 2: any object,
 * 3 + relation: groups */
PyObject *core_ask_ranges(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    static PyObject *(*const modes[])(core_ask *, range_batch *) = {ask_ids, ask_counts, ask_any, ask_groups};
    core_ask ask;
    range_batch b = {0};
    uint32_t mode;
    PyObject *answer = NULL;
    if (!core_ask_begin(&ask, self, "ranges", args, count, 9)) return NULL;
    if (core_unsigned(args[0], "mode", MODE_GROUPS + FROE_RELATION_COUNT - 1, &mode) &&
        take_ranges(&ask, &b, args + 1)) {
        b.relation = mode > MODE_GROUPS ? mode - MODE_GROUPS : FROE_MEETS;
        answer = modes[mode < MODE_GROUPS ? mode : MODE_GROUPS](&ask, &b);
    }
    if (b.ranges) core_release(b.ranges, b.count, sizeof *b.ranges);
    core_ask_end(&ask);
    return answer;
}

/* boxes(boxes, threads, progress): exact windows as plain doubles */
PyObject *core_ask_boxes(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    return core_ask_rows(self, "boxes", "boxes", 2, froe_batch_boxes, args, count);
}

/* One window: the ids are copied, since they belong to the context. */
static PyObject *ask_box(froe_query *query, const double *given, size_t count) {
    double box[2 * FROE_MAX_DIM]; /* a view that is read-only may be of an array that other threads write to */
    froe_range range = froe_range_defaults();
    froe_list found;
    froe_diagnostic diag;
    memcpy(box, given, count * sizeof *box);
    range.points = box;
    PyThreadState *saved = PyEval_SaveThread();
    const froe_status status = froe_query_range(query, &range, &found, &diag);
    PyEval_RestoreThread(saved);
    if (status) return core_raise(status, &diag);
    uint32_t *ids = core_allocate(found.count, sizeof *ids);
    if (!ids) return NULL;
    memcpy(ids, found.ids, found.count * sizeof *ids);
    return core_array_of(ids, "i", found.count, 0);
}

/* box(box): the objects that meet one window, with as little as possible around the search */
PyObject *core_ask_box(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    core_tree *tree = (core_tree *)self;
    core_input box;
    if (!core_arguments("box", count, 1)) return NULL;
    froe_query *query = core_tree_take(tree);
    if (!query) return NULL;
    const size_t dim = (size_t)froe_scene_dim(froe_tree_scene(core_tree_of(tree)));
    PyObject *answer = NULL;
    if (core_input_take(&box, args[0], "box", 'd', 2 * dim, false)) {
        answer = box.count == 1 ? ask_box(query, box.data, 2 * dim)
                                : core_fail_as("ArrayError", "One box has %zu numbers.", 2 * dim);
        core_input_give(&box);
    }
    core_tree_give(tree, query);
    return answer;
}
