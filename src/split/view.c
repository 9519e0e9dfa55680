/* view.c: counting candidates, fast and only nearly right. */
#include "split/view.h"
#include "base/log2.h"
#include "base/random.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void split_view_free(const froe_allocator *alloc, split_view *view) {
    for (int k = 0; k < 3; k++) array_free(alloc, &view->x[k]);
    array_free(alloc, &view->start);
    array_free(alloc, &view->side);
    array_free(alloc, &view->values);
    array_free(alloc, &view->low);
    array_free(alloc, &view->high);
}

/** Appends one corner. The caller has made room. */
static void add_corner(split_view *view, const double *x, int dim) {
    for (int k = 0; k < dim; k++) {
        view->x[k].data[view->x[k].count++] = x[k];
        if (fabs(x[k]) > view->reach[k]) view->reach[k] = fabs(x[k]);
    }
}

/** Boxes and balls are shown by the corners of their bounding boxes. */
static void add_box(split_view *view, const split_set *set, uint32_t object, int dim) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], x[3];
    scene_object_bounds(set->scene, object, lo, hi);
    for (unsigned corner = 0; corner < 1u << dim; corner++) {
        for (int k = 0; k < dim; k++) x[k] = corner >> k & 1 ? hi[k] : lo[k];
        add_corner(view, x, dim);
    }
}

static bool add_fragment(split_view *view, const split_set *set, const split_fragment *f) {
    int dim = set->scene->dim < 3 ? set->scene->dim : 3; /* beyond R^3 axis planes are the only candidates */
    froe_kind form = scene_form(set->scene, f->object);
    bool boxed = form == FROE_BOX || form == FROE_BALL;
    uint32_t n = boxed ? 1u << dim : split_corner_count(set, f);
    for (int k = 0; k < dim; k++)
        if (!array_reserve(&set->alloc, &view->x[k], n)) return false;
    if (boxed)
        add_box(view, set, f->object, dim);
    else
        for (uint32_t i = 0; i < n; i++) add_corner(view, split_image(set, f, i), dim);
    return array_push(&set->alloc, &view->start, (uint32_t)view->x[0].count);
}

/** The i-th fragment shown of a cell. */
static const split_fragment *shown(const split_set *set, const split_cell *cell, uint32_t i, uint32_t count,
                                   uint64_t seed) {
    uint32_t pick = count == cell->count ? i : base_below(base_hash(seed, cell->path, 1000 + i), cell->count);
    return set->items.data + cell->first + pick;
}

bool split_view_fill(split_view *view, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed) {
    view->count = cell->count > sample ? sample : cell->count;
    view->weight = (double)cell->count / view->count;
    view->start.count = 0;
    if (!array_push(&set->alloc, &view->start, 0)) return false;
    for (int k = 0; k < 3; k++) view->x[k].count = 0, view->reach[k] = 0;
    for (uint32_t i = 0; i < view->count; i++)
        if (!add_fragment(view, set, shown(set, cell, i, view->count, seed))) return false;
    view->side.count = 0;
    return array_reserve(&set->alloc, &view->side, view->x[0].count);
}

/** Sides of all corners; values that rounding could have moved across count as on the plane. */
static void find_sides(split_view *view, const geom_plane *plane) {
    size_t n = view->x[0].count;
    bool flat = plane->dim == 2;
    const double *x = view->x[0].data, *y = view->x[1].data, *z = flat ? y : view->x[2].data;
    double a = plane->n[0], b = plane->n[1], c = flat ? 0 : plane->n[2], d = plane->c, reach = fabs(plane->c);
    if (plane->form == GEOM_POINTS || plane->form == GEOM_VERTICAL)
        d = a * plane->p[0][0] + b * plane->p[0][1] + (flat ? 0 : c * plane->p[0][2]);
    for (int k = 0; k < plane->dim; k++) reach += fabs(plane->n[k]) * view->reach[k];
    double slack = (reach + fabs(d)) * 0x1p-49;
    uint8_t *side = view->side.data;
    for (size_t i = 0; i < n; i++) {
        double value = a * x[i] + b * y[i] + c * z[i] - d;
        side[i] = (uint8_t)((value < -slack) | (value > slack) << 1);
    }
}

split_tally split_view_count(split_view *view, const geom_plane *plane) {
    uint32_t of[4] = {0}; /* on, negative, positive, both */
    const uint32_t *start = view->start.data;
    const uint8_t *side = view->side.data;
    find_sides(view, plane);
    for (uint32_t i = 0; i < view->count; i++) {
        unsigned seen = 0;
        for (uint32_t j = start[i]; j < start[i + 1]; j++) seen |= side[j];
        of[seen]++;
    }
    return (split_tally){of[1], of[2], of[0], of[3]};
}

/* ------------------------------------------------------------ axis extents -- */

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void extent(const split_set *set, const split_fragment *f, int axis, double *low, double *high) {
    froe_kind form = scene_form(set->scene, f->object);
    if (form >= FROE_BOX) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(set->scene, f->object, lo, hi);
        *low = lo[axis];
        *high = hi[axis];
        return;
    }
    uint32_t n = split_corner_count(set, f);
    *low = *high = split_image(set, f, 0)[axis];
    for (uint32_t i = 1; i < n; i++) {
        double x = split_image(set, f, i)[axis];
        if (x < *low) *low = x;
        if (x > *high) *high = x;
    }
}

bool split_view_extents(split_view *view, const split_set *set, const split_cell *cell, int axis) {
    const froe_allocator *alloc = &set->alloc;
    uint32_t step = view->count < cell->count ? cell->count / view->count : 1;
    view->low.count = view->high.count = view->values.count = 0;
    if (!array_reserve(alloc, &view->low, view->count) || !array_reserve(alloc, &view->high, view->count) ||
        !array_reserve(alloc, &view->values, 2 * (size_t)view->count))
        return false;
    for (uint32_t i = 0; i < view->count; i++) {
        double low, high;
        extent(set, set->items.data + cell->first + (size_t)i * step, axis, &low, &high);
        view->low.data[view->low.count++] = low;
        view->high.data[view->high.count++] = high;
        view->values.data[view->values.count++] = low;
        view->values.data[view->values.count++] = high;
    }
    qsort(view->values.data, view->values.count, sizeof(double), ascending);
    return true;
}

split_tally split_view_count_axis(const split_view *view, double value) {
    split_tally t = {0};
    for (uint32_t i = 0; i < view->count; i++) {
        bool negative = view->low.data[i]<value, positive = view->high.data[i]> value;
        t.negative += negative & !positive;
        t.positive += positive & !negative;
        t.both += positive & negative;
        t.on += !positive & !negative;
    }
    return t;
}

/* ------------------------------------------------------------------ scores -- */

static double xlog2(double k) {
    return k > 1 ? k * base_log2(k) : 0;
}

double split_cost(split_tally t, double weight, double w, bool strict) {
    double m = (t.negative + t.positive + t.on + t.both) * weight, splits = t.both * weight;
    double a = (t.negative + t.both) * weight, b = (t.positive + t.both) * weight, larger = a > b ? a : b;
    double gain = xlog2(m) - xlog2(a) - xlog2(b) + splits * (m > 1 ? base_log2(m) : 0);
    double penalty = strict && m > 4 && larger > 0.75 * m ? 0x1p20 * (larger / m - 0.75) : 0;
    return splits - w * gain + penalty;
}
