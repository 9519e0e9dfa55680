/* directional.c: how many boxes cross the plane of a face near it.
 *
 *              |          |    f           Of box e and its upper face: f crosses the plane of the face within the
 *        ......|==========|..*****....     face widened by some room, so it counts, as long as it keeps out of the
 *              |    e     |  *****         inside of e.
 *              |          |  *****
 *
 * (Tobola and Nechvile, sections 4 and 5.1, with one rectangle in place of the union of two: that is what a cell can be
 * at most when no lemma cut is left.) Counted by search and test. */
#include "base/status.h"
#include "measure/hierarchy.h"
#include "measure/sample.h"
#include <math.h>

typedef struct survey {
    measure_sample sample;
    measure_hierarchy boxes;
    measure_bounds bounds;
    double delta;
} survey;

static const double *lo_of(const survey *s, uint32_t object) {
    return s->bounds.lo + (size_t)object * (size_t)s->boxes.dim;
}
static const double *hi_of(const survey *s, uint32_t object) {
    return s->bounds.hi + (size_t)object * (size_t)s->boxes.dim;
}

/* Do the insides of two boxes overlap? A flat box counts as inside where it lies strictly between. */
static bool overlap(int dim, const double *lo, const double *hi, const double *from, const double *to) {
    bool inside = true;
    for (int k = 0; k < dim && inside; k++) inside = lo[k] < to[k] && hi[k] > from[k];
    return inside;
}

/* Boxes that cross x[axis] = c within the face of `object`, widened on axis k by room[k]. */
static uint32_t crossings(const survey *s, uint32_t object, int axis, double c, const double *room) {
    int dim = s->boxes.dim;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (int k = 0; k < dim; k++) lo[k] = lo_of(s, object)[k] - room[k], hi[k] = hi_of(s, object)[k] + room[k];
    lo[axis] = hi[axis] = c;
    measure_search search = measure_search_begin(&s->boxes, lo, hi, 0);
    uint32_t count = 0;
    for (uint32_t f; (f = measure_search_next(&search)) != FROE_NONE;) {
        if (f == object || !overlap(dim, lo_of(s, f), hi_of(s, f), lo, hi)) continue;
        count += !overlap(dim, lo_of(s, f), hi_of(s, f), lo_of(s, object), hi_of(s, object));
    }
    return count;
}

/* The greater count of the two faces across an axis. */
static uint32_t worse_face(const survey *s, uint32_t object, int axis, const double *room) {
    uint32_t low = crossings(s, object, axis, lo_of(s, object)[axis], room);
    uint32_t high = crossings(s, object, axis, hi_of(s, object)[axis], room);
    return low > high ? low : high;
}

/* Room of a face across `axis`: a share of each side, or of the longest side of the face, or of the box. */
static double simple_room(const survey *s, const double *side, int axis, double *room) {
    double longest = 0;
    for (int k = 0; k < s->boxes.dim; k++) {
        room[k] = s->delta * side[k];
        if (k != axis && side[k] > longest) longest = side[k];
    }
    return longest;
}

static void even_room(const survey *s, double longest, double *room) {
    for (int k = 0; k < s->boxes.dim; k++) room[k] = (1 + 2 * s->delta) * longest;
}

static bool note_box(survey *s, uint32_t object) {
    int dim = s->boxes.dim, longest = 0;
    double side[FROE_MAX_DIM], room[FROE_MAX_DIM];
    for (int k = 0; k < dim; k++) {
        side[k] = hi_of(s, object)[k] - lo_of(s, object)[k];
        if (side[k] > side[longest]) longest = k;
    }
    uint32_t simple = 0, extended = 0, paired = UINT32_MAX, count;
    for (int k = 0; k < dim; k++) {
        double face = simple_room(s, side, k, room);
        if ((count = worse_face(s, object, k, room)) > simple) simple = count;
        even_room(s, face, room);
        if ((count = worse_face(s, object, k, room)) > extended) extended = count;
        even_room(s, side[longest], room);
        if (k != longest && (count = worse_face(s, object, k, room)) < paired) paired = count;
    }
    const uint32_t counts[3] = {simple, extended, paired};
    for (int i = 0; i < 3; i++)
        if (!array_push(&s->sample.alloc, &s->sample.values[i], counts[i])) return false;
    return true;
}

static froe_status find_boxes(survey *s) {
    const froe_scene *scene = s->sample.scene;
    const measure_bounds *b = &s->bounds;
    froe_status status = measure_bounds_new(&s->sample, &s->bounds);
    if (status) return status;
    return measure_hierarchy_new(&s->sample.alloc, scene->dim, scene->object_count, b->lo, b->hi, NULL, &s->boxes);
}

static froe_status look(survey *s, froe_directional *out) {
    for (uint32_t i = 0; i < s->sample.count; i++) {
        if (!measure_sample_go_on(&s->sample, i)) return FROE_E_CANCELLED;
        if (!note_box(s, measure_sample_object(&s->sample, i))) return FROE_E_MEMORY;
    }
    *out = (froe_directional){.delta = s->delta, .count = s->sample.count};
    froe_status status = measure_sample_spread(&s->sample, 0, &out->simple);
    if (!status) status = measure_sample_spread(&s->sample, 1, &out->extended);
    return status ? status : measure_sample_spread(&s->sample, 2, &out->paired);
}

froe_status froe_measure_directional(const froe_scene *scene, double delta, const froe_measure_options *options,
                                     froe_directional *out, froe_diagnostic *diag) {
    survey s = {.delta = delta};
    froe_status status = measure_sample_begin(scene, options, out, &s.sample, diag);
    if (status) return status;
    if (!(delta >= 0) || !isfinite(delta))
        return base_fail(diag, FROE_E_ARG, "delta = %g: a finite number >= 0 is needed", delta);
    status = find_boxes(&s);
    if (!status) status = look(&s, out);
    measure_hierarchy_free(&s.boxes);
    measure_bounds_free(&s.sample, &s.bounds);
    return measure_sample_end(&s.sample, status, diag);
}
