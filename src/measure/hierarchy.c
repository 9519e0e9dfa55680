/* hierarchy.c: packing boxes along a curve, and searching. */
#include "measure/hierarchy.h"
#include "base/curve.h"
#include "base/radix.h"
#include <string.h>

/* ------------------------------------------------------------------ packing -- */

static froe_status order(measure_hierarchy *h, const double *lo, const double *hi) {
    double from[FROE_MAX_DIM], to[FROE_MAX_DIM];
    base_pair *pairs = support_calloc(&h->alloc, 2 * (size_t)h->count, sizeof *pairs);
    if (!pairs) return FROE_E_MEMORY;
    for (int k = 0; k < h->dim; k++) from[k] = lo[k], to[k] = hi[k];
    for (size_t i = 1; i < h->count; i++)
        for (int k = 0; k < h->dim; k++) {
            size_t at = i * (size_t)h->dim + (size_t)k;
            if (lo[at] < from[k]) from[k] = lo[at];
            if (hi[at] > to[k]) to[k] = hi[at];
        }
    for (uint32_t i = 0; i < h->count; i++) {
        size_t at = (size_t)i * (size_t)h->dim;
        pairs[i] = (base_pair){base_curve_place(h->dim, lo + at, hi + at, from, to), i};
    }
    base_radix_sort(pairs, pairs + h->count, h->count);
    for (uint32_t i = 0; i < h->count; i++) h->ids[i] = pairs[i].value;
    support_free(&h->alloc, pairs, 2 * (size_t)h->count * sizeof *pairs);
    return FROE_OK;
}

static void copy_entry(measure_hierarchy *h, uint32_t to, const double *lo, const double *hi, double size) {
    size_t bytes = (size_t)h->dim * sizeof(double), at = (size_t)to * (size_t)h->dim;
    memcpy(h->lo + at, lo, bytes);
    memcpy(h->hi + at, hi, bytes);
    h->size[to] = size;
}

froe_status measure_hierarchy_new(const froe_allocator *alloc, int dim, uint32_t count, const double *lo,
                                  const double *hi, const double *size, measure_hierarchy *out) {
    *out = (measure_hierarchy){.alloc = *alloc, .dim = dim, .count = count};
    for (uint32_t width = count; width; width = width > 1 ? (width + MEASURE_FAN - 1) / MEASURE_FAN : 0) {
        out->first[out->levels + 1] = out->first[out->levels] + width;
        out->levels++;
    }
    out->entries = out->first[out->levels];
    size_t numbers = (size_t)out->entries * (size_t)dim;
    out->ids = support_calloc(alloc, count, sizeof *out->ids);
    out->lo = support_calloc(alloc, numbers, sizeof *out->lo);
    out->hi = support_calloc(alloc, numbers, sizeof *out->hi);
    out->size = support_calloc(alloc, out->entries, sizeof *out->size);
    froe_status status = out->ids && out->lo && out->hi && out->size ? FROE_OK : FROE_E_MEMORY;
    if (!status && count) status = order(out, lo, hi);
    if (status) {
        measure_hierarchy_free(out);
        return status;
    }
    for (uint32_t i = 0; i < count; i++) {
        size_t at = (size_t)out->ids[i] * (size_t)dim;
        copy_entry(out, i, lo + at, hi + at, size ? size[out->ids[i]] : 0);
    }
    for (uint32_t level = 1, child = 0; level < out->levels; level++)
        for (uint32_t below = child, end = out->first[level]; child < end; child++) {
            const uint32_t node = end + (child - below) / MEASURE_FAN;
            size_t a = (size_t)node * (size_t)dim, b = (size_t)child * (size_t)dim;
            if ((child - below) % MEASURE_FAN == 0) {
                copy_entry(out, node, out->lo + b, out->hi + b, out->size[child]);
                continue;
            }
            for (int k = 0; k < dim; k++, a++, b++) {
                if (out->lo[b] < out->lo[a]) out->lo[a] = out->lo[b];
                if (out->hi[b] > out->hi[a]) out->hi[a] = out->hi[b];
            }
            if (out->size[child] > out->size[node]) out->size[node] = out->size[child];
        }
    return FROE_OK;
}

void measure_hierarchy_free(measure_hierarchy *h) {
    size_t numbers = (size_t)h->entries * (size_t)h->dim;
    support_free(&h->alloc, h->ids, h->count ? h->count * sizeof *h->ids : 1);
    support_free(&h->alloc, h->lo, numbers ? numbers * sizeof *h->lo : 1);
    support_free(&h->alloc, h->hi, numbers ? numbers * sizeof *h->hi : 1);
    support_free(&h->alloc, h->size, h->entries ? h->entries * sizeof *h->size : 1);
    *h = (measure_hierarchy){.alloc = h->alloc};
}

/* ---------------------------------------------------------------- searching -- */

measure_search measure_search_begin(const measure_hierarchy *h, const double *lo, const double *hi, double least) {
    measure_search s = {.in = h, .lo = lo, .hi = hi, .least = least};
    if (h->count) s.stack[s.top++] = h->entries - 1;
    return s;
}

uint32_t measure_search_next(measure_search *s) {
    const measure_hierarchy *h = s->in;
    while (s->top) {
        const uint32_t entry = s->stack[--s->top];
        const double *lo = h->lo + (size_t)entry * (size_t)h->dim, *hi = h->hi + (size_t)entry * (size_t)h->dim;
        bool meets = h->size[entry] >= s->least;
        for (int k = 0; k < h->dim && meets; k++) meets = lo[k] <= s->hi[k] && hi[k] >= s->lo[k];
        if (!meets) continue;
        if (entry < h->count) return h->ids[entry];
        uint32_t level = 1;
        while (entry >= h->first[level + 1]) level++;
        uint32_t child = h->first[level - 1] + (entry - h->first[level]) * MEASURE_FAN, end = child + MEASURE_FAN;
        if (end > h->first[level]) end = h->first[level];
        while (end > child) s->stack[s->top++] = --end;
    }
    return FROE_NONE;
}
