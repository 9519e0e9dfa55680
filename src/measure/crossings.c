/* crossings.c: counting boxes that meet windows by search, and by range trees. */
#include "measure/crossings.h"
#include "base/radix.h"
#include "measure/dominance.h"
#include "measure/hierarchy.h"

enum { STEP = 1024 }; /* windows between two reports of progress */

static bool sample_goes_on(measure_sample *sample, size_t done, size_t all) {
    return done % STEP || base_progress(&sample->task, (double)done / ((double)all + 1));
}

/* -------------------------------------------------------------------- search -- */

froe_status measure_count_by_search(measure_sample *sample, const measure_windows *windows, uint32_t *out) {
    const froe_scene *scene = sample->scene;
    measure_hierarchy boxes;
    froe_status status = measure_hierarchy_new(&sample->alloc, scene->dim, scene->object_count, windows->bounds->lo,
                                               windows->bounds->hi, NULL, &boxes);
    for (size_t i = 0; i < windows->count && !status; i++) {
        double from[FROE_MAX_DIM], to[FROE_MAX_DIM];
        windows->get(windows->user, i, from, to);
        out[i] = 0;
        measure_search search = measure_search_begin(&boxes, from, to, 0);
        for (uint32_t f; (f = measure_search_next(&search)) != FROE_NONE;) {
            const double *lo = windows->bounds->lo + (size_t)f * (size_t)boxes.dim;
            const double *hi = windows->bounds->hi + (size_t)f * (size_t)boxes.dim;
            bool inside = true;
            for (int k = 0; k < boxes.dim && inside; k++) inside = lo[k] < to[k] && hi[k] > from[k];
            out[i] += inside;
        }
        if (!sample_goes_on(sample, i, windows->count)) status = FROE_E_CANCELLED;
    }
    measure_hierarchy_free(&boxes);
    return status;
}

/* --------------------------------------------------------------- ends in order -- */

/* The lower or upper ends of all boxes on an axis, ascending; of equal ones those of flat boxes last. */
typedef struct box_ends {
    double *value;
    bool *flat;
    uint32_t *rank; /* of each box */
} box_ends;

static froe_status ends_new(const measure_sample *sample, const measure_bounds *bounds, int axis, bool upper,
                            box_ends *out) {
    const froe_allocator *alloc = &sample->alloc;
    uint32_t n = sample->scene->object_count, count = 0;
    size_t dim = (size_t)sample->scene->dim;
    base_pair *pairs = support_calloc(alloc, 2 * (size_t)n, sizeof *pairs);
    *out = (box_ends){support_calloc(alloc, n, sizeof *out->value), support_calloc(alloc, n, sizeof *out->flat),
                      support_calloc(alloc, n, sizeof *out->rank)};
    bool ok = pairs && out->value && out->flat && out->rank;
    const double *lo = bounds->lo + axis, *hi = bounds->hi + axis, *x = upper ? hi : lo;
    for (int flat = 0; flat < 2 && ok; flat++)
        for (uint32_t i = 0; i < n; i++)
            if ((lo[i * dim] == hi[i * dim]) == flat) pairs[count++] = (base_pair){base_double_key(x[i * dim]), i};
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (uint32_t r = 0; r < n && ok; r++) {
        uint32_t i = pairs[r].value;
        out->value[r] = x[i * dim];
        out->flat[r] = lo[i * dim] == hi[i * dim];
        out->rank[i] = r;
    }
    support_free(alloc, pairs, 2 * (size_t)n * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Ends before x, and of those at x: none (0), of boxes that are not flat (1), all (2). */
static uint32_t ends_before(const box_ends *e, uint32_t count, double x, int with) {
    uint32_t from = 0, end = count;
    while (from < end) {
        uint32_t i = from + (end - from) / 2;
        if (e->value[i] < x || (e->value[i] == x && e->flat[i] < with))
            from = i + 1;
        else
            end = i;
    }
    return from;
}

/* ---------------------------------------------------------------------- trees -- */

froe_status measure_count_by_trees(measure_sample *sample, const measure_windows *windows, uint32_t *out) {
    const int dim = sample->scene->dim;
    const uint32_t n = sample->scene->object_count;
    const size_t products = (size_t)1 << dim;
    box_ends ends[FROE_MAX_DIM][2] = {{{0}}}; /* lower, upper */
    froe_status status = FROE_OK;
    for (size_t i = 0; i < windows->count; i++) out[i] = 0;
    for (int k = 0; k < 2 * dim && !status; k++)
        status = ends_new(sample, windows->bounds, k / 2, k % 2, &ends[k / 2][k % 2]);
    /* Adds or subtracts the counts of each product of conditions, with upper ends on the axes in `upper`. A box that
     * begins before hi and ends up to lo: all that end there, but if lo = hi, not the flat ones at it, which begin at
     * it. */
    for (unsigned upper = 0; upper < products && !status; upper++) {
        uint32_t *rank[FROE_MAX_DIM], sign = 1;
        measure_dominance tree;
        for (int k = 0; k < dim; k++) {
            rank[k] = ends[k][upper >> k & 1].rank;
            if (upper >> k & 1) sign = 0 - sign;
        }
        status = measure_dominance_new(&sample->alloc, dim, n, rank, &tree);
        for (size_t i = 0; i < windows->count && !status; i++) {
            uint32_t below[FROE_MAX_DIM];
            double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
            windows->get(windows->user, i, lo, hi);
            for (int k = 0; k < dim; k++)
                below[k] = upper >> k & 1 ? ends_before(&ends[k][1], n, lo[k], lo[k] < hi[k] ? 2 : 1)
                                          : ends_before(&ends[k][0], n, hi[k], 0);
            out[i] += sign * measure_dominance_count(&tree, below);
            if (!sample_goes_on(sample, upper * windows->count + i, products * windows->count))
                status = FROE_E_CANCELLED;
        }
        measure_dominance_free(&tree);
    }
    for (int k = 0; k < 2 * dim; k++) {
        support_free(&sample->alloc, ends[k / 2][k % 2].value, n * sizeof(double));
        support_free(&sample->alloc, ends[k / 2][k % 2].flat, n * sizeof(bool));
        support_free(&sample->alloc, ends[k / 2][k % 2].rank, n * sizeof(uint32_t));
    }
    return status;
}
