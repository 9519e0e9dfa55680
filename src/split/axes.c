/* axes.c: sorted ends, and the walk over them. */
#include "split/axes.h"
#include <math.h>
#include <string.h>

void split_axes_free(const froe_allocator *alloc, split_axes *a) {
    array_free(alloc, &a->low);
    array_free(alloc, &a->high);
    array_free(alloc, &a->flat);
    array_free(alloc, &a->spare);
    array_free(alloc, &a->pairs);
}

void split_extent(const split_set *set, const split_fragment *f, int axis, double *low, double *high) {
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

/** An image with an infinite end counts as unbounded on both sides. */
static void extent(const split_set *set, const split_fragment *f, int axis, double *low, double *high) {
    split_extent(set, f, axis, low, high);
    if (isfinite(*low) && isfinite(*high)) return;
    *low = -INFINITY;
    *high = INFINITY;
}

/** REQUIRES: room for as many doubles in spare, and twice as many pairs. */
static void sort_ends(split_axes *a, double *x, size_t n) {
    base_pair *pairs = a->pairs.data;
    for (size_t i = 0; i < n; i++) pairs[i] = (base_pair){base_double_key(x[i]), (uint32_t)i};
    base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; i < n; i++) a->spare.data[i] = x[pairs[i].value];
    if (n) memcpy(x, a->spare.data, n * sizeof *x);
}

bool split_axes_fill(split_axes *a, const split_set *set, const split_cell *cell, int axis) {
    const froe_allocator *alloc = &set->alloc;
    const size_t n = cell->count;
    a->low.count = a->high.count = a->flat.count = a->spare.count = a->pairs.count = 0;
    a->begun = a->ended = a->flats = 0;
    if (!array_reserve(alloc, &a->low, n) || !array_reserve(alloc, &a->high, n) || !array_reserve(alloc, &a->flat, n) ||
        !array_reserve(alloc, &a->spare, n) || !array_reserve(alloc, &a->pairs, 2 * n))
        return false;
    for (uint32_t i = 0; i < cell->count; i++) {
        double low, high;
        extent(set, set->items.data + cell->first + i, axis, &low, &high);
        a->low.data[a->low.count++] = low;
        a->high.data[a->high.count++] = high;
        if (low == high) a->flat.data[a->flat.count++] = low;
    }
    sort_ends(a, a->low.data, a->low.count);
    sort_ends(a, a->high.data, a->high.count);
    sort_ends(a, a->flat.data, a->flat.count);
    return true;
}

/** Takes all ends at the value. */
static size_t pass_equal_ends(const double *x, size_t at, size_t count, double value) {
    while (at < count && x[at] <= value) at++;
    return at;
}

bool split_axes_next(split_axes *a) {
    size_t n = a->low.count;
    if (a->ended == n) return false; /* no fragment begins behind the last end */
    double low = a->begun < n ? a->low.data[a->begun] : a->high.data[a->ended], high = a->high.data[a->ended];
    size_t flats = a->flats, below = a->begun; /* those that begin below the value */
    a->value = low < high ? low : high;
    a->begun = pass_equal_ends(a->low.data, a->begun, n, a->value);
    a->ended = pass_equal_ends(a->high.data, a->ended, n, a->value);
    a->flats = pass_equal_ends(a->flat.data, flats, a->flat.count, a->value);
    uint32_t on = (uint32_t)(a->flats - flats);
    a->tally = (split_tally){.negative = (uint32_t)a->ended - on, .positive = (uint32_t)(n - below) - on, .on = on};
    a->tally.both = (uint32_t)n - on - a->tally.negative - a->tally.positive;
    return true;
}

bool split_axes_gap(const split_set *set, const split_cell *cell, int axis, double *from, double *to) {
    for (uint32_t i = 0; i < cell->count; i++) {
        double low, high;
        extent(set, set->items.data + cell->first + i, axis, &low, &high);
        if (!i || high < *from) *from = high;
        if (!i || low > *to) *to = low;
    }
    return cell->count && *from <= *to;
}
