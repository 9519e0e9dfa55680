/* defects.c: the defect report: what is odd about a scene, counted exactly.
 *
 * Objects -> distinct, full-dimensional ones -> pairs that may meet oddly -> how each pair
 * touches. Each worker has counts of its own. They are added, and the least example pair is kept,
 * so the report does not depend on the number of threads. */
#include "base/floats.h"
#include "geom/meet/contact.h"
#include "geom/selftest.h"
#include "measure/odd_pairs.h"
#include "scene/scene.h"
#include "support/fail.h"

typedef enum oddity { APART, CROSSING, T_JUNCTION, OVERLAP, ODDITIES } oddity;

typedef struct tally {
    num_context context;
    bool ready;
    signed char *sides; /* of the corners of two polygons */
    uint64_t counts[ODDITIES];
    uint32_t first[ODDITIES][2];
} tally;

typedef struct survey {
    const froe_scene *scene;
    const froe_allocator *alloc;
    base_task task;
    tally *tallies; /* one for each worker */
    size_t side_count;
    uint32_t *objects; /* candidates: distinct, with length or area */
    uint32_t count;
    double *boxes; /* low corners, then high corners */
} survey;

/* ----------------------------------------------------------------- singles -- */

static bool is_candidate(const froe_scene *s, uint32_t object) {
    return s->forms[object] == (s->dim == 2 ? FROE_SEGMENT : FROE_POLYGON) && s->dim <= 3;
}

/* Counts defects of single objects, and keeps the candidates in place of the originals. */
static void look_at_objects(survey *v, froe_defects *out) {
    const froe_scene *s = v->scene;
    for (uint32_t i = 0; i < s->object_count; i++) {
        bool original = v->objects[i] == i;
        out->duplicates += !original;
        out->zero_length += s->kinds[i] == FROE_SEGMENT && s->forms[i] != FROE_SEGMENT;
        out->zero_area += s->kinds[i] == FROE_POLYGON && s->forms[i] != FROE_POLYGON;
        if (!original || !is_candidate(s, i)) continue;
        v->objects[v->count++] = i;
        if (2 * (size_t)scene_corners(s, i) > v->side_count) v->side_count = 2 * (size_t)scene_corners(s, i);
    }
}

/* ------------------------------------------------------------------- pairs -- */

/* Is the way in which two segments, or two polygons, meet odd? */
static oddity look_closely(tally *t, const froe_scene *s, uint32_t a, uint32_t b) {
    static const oddity by_touch[] = {[GEOM_TOUCH_AT_CORNER] = APART,
                                      [GEOM_TOUCH_ALONG] = APART,
                                      [GEOM_TOUCH_JUNCTION] = T_JUNCTION,
                                      [GEOM_TOUCH_EDGES] = CROSSING};
    geom_body p = scene_body(s, a), q = scene_body(s, b);
    geom_contact m =
        s->dim == 2 ? geom_contact_segments(&t->context, &p, &q) : geom_contact_polygons(&t->context, &p, &q, t->sides);
    switch (m.kind) {
    case GEOM_CROSS:
        return CROSSING;
    case GEOM_OVERLAP:
        return OVERLAP;
    case GEOM_TOUCH:
        return by_touch[m.touch];
    default:
        return APART;
    }
}

static bool look_at_pair(void *user, unsigned worker, uint32_t i, uint32_t j) {
    survey *v = user;
    tally *t = v->tallies + worker;
    uint32_t a = v->objects[i < j ? i : j], b = v->objects[i < j ? j : i];
    oddity contact = look_closely(t, v->scene, a, b);
    uint32_t *first = t->first[contact];
    if (!t->counts[contact]++ || a < first[0] || (a == first[0] && b < first[1])) first[0] = a, first[1] = b;
    return true;
}

static froe_status find_boxes(survey *v) {
    size_t dim = (size_t)v->scene->dim, half = v->count * dim;
    v->boxes = support_calloc(v->alloc, 2 * half, sizeof *v->boxes);
    if (!v->boxes) return FROE_E_MEMORY;
    for (size_t i = 0; i < v->count; i++)
        scene_object_bounds(v->scene, v->objects[i], v->boxes + i * dim, v->boxes + half + i * dim);
    return FROE_OK;
}

static froe_status make_tallies(survey *v) {
    v->tallies = support_calloc(v->alloc, v->task.threads, sizeof *v->tallies);
    if (!v->tallies) return FROE_E_MEMORY;
    for (unsigned i = 0; i < v->task.threads; i++) {
        tally *t = v->tallies + i;
        t->ready = geom_context_new(v->alloc, &t->context) == FROE_OK;
        t->sides = support_calloc(v->alloc, v->side_count, 1);
        if (!t->ready || !t->sides) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status look_at_pairs(survey *v) {
    if (v->count < 2) return base_progress(&v->task, 1) ? FROE_OK : FROE_E_CANCELLED;
    froe_status status = make_tallies(v);
    if (!status) status = find_boxes(v);
    if (status) return status;
    measure_candidates of = {v->scene, v->objects, v->count, v->boxes, v->boxes + v->count * (size_t)v->scene->dim};
    return measure_odd_pairs(&v->task, &v->tallies[0].context, &of, look_at_pair, v);
}

/* ------------------------------------------------------------------ report -- */

static uint64_t sum(const survey *v, oddity contact, uint32_t first[2]) {
    uint64_t count = 0;
    first[0] = first[1] = FROE_NONE;
    for (unsigned i = 0; v->tallies && i < v->task.threads; i++) {
        const tally *t = v->tallies + i;
        const uint32_t *f = t->first[contact];
        count += t->counts[contact];
        if (t->counts[contact] && (f[0] < first[0] || (f[0] == first[0] && f[1] < first[1])))
            first[0] = f[0], first[1] = f[1];
    }
    return count;
}

static void survey_free(survey *v) {
    for (unsigned i = 0; v->tallies && i < v->task.threads; i++) {
        if (v->tallies[i].ready) num_context_free(&v->tallies[i].context);
        support_free(v->alloc, v->tallies[i].sides, v->side_count ? v->side_count : 1);
    }
    support_free(v->alloc, v->tallies, v->task.threads * sizeof *v->tallies);
    support_free(v->alloc, v->boxes, 2 * (size_t)v->count * (size_t)v->scene->dim * sizeof *v->boxes);
    support_free(v->alloc, v->objects, (v->scene->object_count + (size_t)1) * sizeof *v->objects);
}

static froe_status run_survey(survey *v, froe_defects *out) {
    v->objects = support_calloc(v->alloc, v->scene->object_count + (size_t)1, sizeof *v->objects);
    if (!v->objects) return FROE_E_MEMORY;
    froe_status status = scene_originals(v->scene, v->alloc, v->objects);
    if (status) return status;
    look_at_objects(v, out);
    status = look_at_pairs(v);
    out->crossings = sum(v, CROSSING, out->first_crossing);
    out->t_junctions = sum(v, T_JUNCTION, out->first_t_junction);
    out->overlaps = sum(v, OVERLAP, out->first_overlap);
    return status;
}

froe_status froe_scene_defects(const froe_scene *scene, unsigned threads, froe_progress_fn *progress, void *user,
                               froe_defects *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail(diag, FROE_E_ARG, "scene or out is null");
    if (out->size != sizeof *out) return support_fail(diag, FROE_E_OPTIONS, "out->size must be sizeof(froe_defects)");
    survey v = {.scene = scene, .alloc = &scene->alloc};
    froe_defects defects = {.size = sizeof defects};
    base_task_init(&v.task, threads, progress, user);
    froe_status status = run_survey(&v, &defects);
    survey_free(&v);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    if (status) return support_fail_memory(diag);
    *out = defects;
    return FROE_OK;
}
