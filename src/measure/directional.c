/* directional.c: how many boxes cross the plane of a face near it.
 *
 *              |          |    f           Of box e and its upper face: f crosses the plane of the face within the
 *        ......|==========|..*****....     face widened by some room. So it counts, unless it meets the inside of e,
 *              |    e     |  *****         that is, unless it crosses the face itself.
 *              |          |  *****
 *
 * (Tobola and Nechvile, definitions 2.2, 3.2 and 4.1, and section 5.1 for one rectangle in place of the union of two.
 * It bounds the cell when no lemma cut is left.) */
#include "base/floats.h"
#include "measure/crossings.h"
#include "support/fail.h"
#include <math.h>

/* Rooms that a face is widened by. From EVEN on: little on axis form - EVEN, much on the others. */
enum { NONE, SIMPLE, EXTENDED, EVEN };

typedef struct directional_survey {
    measure_sample sample;
    measure_bounds bounds;
    double delta;
    uint32_t *counts; /* for each object of the sample, each face, each form */
} directional_survey;

/* ------------------------------------------------------------------- windows -- */

static size_t forms(int dim) {
    return EVEN + (size_t)dim;
}

static size_t windows_each(int dim) {
    return 2 * (size_t)dim * forms(dim);
}

static int longest_side(const directional_survey *s, uint32_t object, double *side) {
    int dim = s->sample.scene->dim, longest = 0;
    size_t at = (size_t)object * (size_t)dim;
    for (int k = 0; k < dim; k++) {
        side[k] = s->bounds.hi[at + (size_t)k] - s->bounds.lo[at + (size_t)k];
        if (side[k] > side[longest]) longest = k;
    }
    return longest;
}

static double much(const directional_survey *s, double side) {
    return side > 0 ? (1 + 2 * s->delta) * side : 0; /* the factor may be infinite */
}

/* What the face across `axis` of a box with these sides is widened by on axis k. */
static double room_of_side(const directional_survey *s, const double *side, int longest, int axis, int form, int k) {
    double face = 0;
    if (form == NONE) return 0;
    if (form == SIMPLE || k == form - EVEN) return s->delta * side[k];
    if (form != EXTENDED) return much(s, side[longest]);
    for (int i = 0; i < s->sample.scene->dim; i++)
        if (i != axis && side[i] > face) face = side[i];
    return much(s, face);
}

/* Faces of an object: lower, then upper, on each axis; forms of each face. */
static void window(const void *user, size_t i, double *lo, double *hi) {
    const directional_survey *s = user;
    int dim = s->sample.scene->dim, form = (int)(i % forms(dim)), face = (int)(i % windows_each(dim) / forms(dim));
    uint32_t object = measure_sample_object(&s->sample, (uint32_t)(i / windows_each(dim)));
    size_t at = (size_t)object * (size_t)dim;
    double side[FROE_MAX_DIM];
    int longest = longest_side(s, object, side), axis = face / 2;
    for (int k = 0; k < dim; k++) {
        double by = room_of_side(s, side, longest, axis, form, k);
        lo[k] = s->bounds.lo[at + (size_t)k] - by;
        hi[k] = s->bounds.hi[at + (size_t)k] + by;
    }
    lo[axis] = hi[axis] = (face % 2 ? s->bounds.hi : s->bounds.lo)[at + (size_t)axis];
}

/* -------------------------------------------------------------------- results -- */

/* The greater count of the two faces across an axis, without the boxes that cross a face itself. */
static uint32_t worse_face(const directional_survey *s, uint32_t i, int axis, size_t form) {
    size_t each = forms(s->sample.scene->dim);
    const uint32_t *low = s->counts + i * windows_each(s->sample.scene->dim) + 2 * (size_t)axis * each;
    const uint32_t *high = low + each;
    uint32_t a = low[form] - low[NONE], b = high[form] - high[NONE];
    return a > b ? a : b;
}

static uint32_t worst_face(const directional_survey *s, uint32_t i, size_t form) {
    uint32_t most = 0;
    for (int k = 0; k < s->sample.scene->dim; k++) {
        uint32_t count = worse_face(s, i, k, form);
        if (count > most) most = count;
    }
    return most;
}

froe_status froe_measure_directional(const froe_scene *scene, double delta, const froe_measure_options *options,
                                     froe_directional *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    directional_survey s = {.delta = delta};
    froe_counting counting = options ? options->counting : FROE_COUNT_SEARCH;
    froe_status status = measure_sample_begin(scene, options, out, &s.sample, diag);
    if (status) return status;
    if (!(delta >= 0) || !isfinite(delta))
        return support_fail(diag, FROE_E_ARG, "option 'delta': '%g' is not a finite number >= 0.", delta);
    measure_windows windows = {&s.bounds, s.sample.count * windows_each(scene->dim), window, &s};
    status = measure_bounds_new(&s.sample, &s.bounds);
    s.counts = support_calloc(&s.sample.alloc, windows.count, sizeof *s.counts);
    if (!status && !s.counts) status = FROE_E_MEMORY;
    if (!status && windows.count)
        status = (counting == FROE_COUNT_TREES ? measure_count_by_trees : measure_count_by_search)(&s.sample, &windows,
                                                                                                   s.counts);
    for (uint32_t i = 0; i < s.sample.count && !status; i++) {
        double side[FROE_MAX_DIM];
        int longest = longest_side(&s, measure_sample_object(&s.sample, i), side);
        uint32_t paired = UINT32_MAX, directed = UINT32_MAX; /* the least of all thin axes but the longest one */
        for (int thin = 0; thin < scene->dim; thin++) {
            if (thin == longest) continue;
            size_t form = EVEN + (size_t)thin;
            uint32_t pair = worse_face(&s, i, thin, form), all = worst_face(&s, i, form);
            if (pair < paired) paired = pair;
            if (all < directed) directed = all;
        }
        const uint32_t counts[4] = {worst_face(&s, i, SIMPLE), worst_face(&s, i, EXTENDED), directed, paired};
        for (int k = 0; k < 4; k++)
            if (!array_push(&s.sample.alloc, &s.sample.values[k], counts[k])) status = FROE_E_MEMORY;
    }
    support_free(&s.sample.alloc, s.counts, (windows.count ? windows.count : 1) * sizeof *s.counts);
    measure_bounds_free(&s.sample, &s.bounds);
    if (!status) *out = (froe_directional){.delta = delta, .count = s.sample.count};
    if (!status) status = measure_sample_spread(&s.sample, 0, &out->simple);
    if (!status) status = measure_sample_spread(&s.sample, 1, &out->extended);
    if (!status) status = measure_sample_spread(&s.sample, 2, &out->two_directional);
    if (!status) status = measure_sample_spread(&s.sample, 3, &out->paired);
    return measure_sample_end(&s.sample, status, diag);
}
