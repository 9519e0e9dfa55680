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

typedef struct defect_survey {
    const froe_scene *scene;
    const froe_allocator *alloc;
    base_task task;
    tally *tallies; /* one for each worker */
    size_t side_count;
    uint32_t *objects; /* candidates: distinct, with length or area */
    uint32_t count;
    double *boxes; /* low corners, then high corners */
} defect_survey;

/* ------------------------------------------------------------------- pairs -- */

/* Is the way in which two segments, or two polygons, meet odd? */
static bool look_at_pair(void *user, unsigned worker, uint32_t i, uint32_t j) {
    static const oddity by_touch[] = {[GEOM_TOUCH_AT_CORNER] = APART,
                                      [GEOM_TOUCH_ALONG] = APART,
                                      [GEOM_TOUCH_JUNCTION] = T_JUNCTION,
                                      [GEOM_TOUCH_EDGES] = CROSSING};
    defect_survey *v = user;
    tally *t = v->tallies + worker;
    const uint32_t a = v->objects[i < j ? i : j], b = v->objects[i < j ? j : i];
    const geom_body p = scene_body(v->scene, a), q = scene_body(v->scene, b);
    const geom_contact m = v->scene->dim == 2 ? geom_contact_segments(&t->context, &p, &q)
                                              : geom_contact_polygons(&t->context, &p, &q, t->sides);
    const oddity contact = m.kind == GEOM_CROSS     ? CROSSING
                           : m.kind == GEOM_OVERLAP ? OVERLAP
                           : m.kind == GEOM_TOUCH   ? by_touch[m.touch]
                                                    : APART;
    uint32_t *first = t->first[contact];
    if (!t->counts[contact]++ || a < first[0] || (a == first[0] && b < first[1])) first[0] = a, first[1] = b;
    return true;
}

static froe_status look_at_pairs(defect_survey *v) {
    const size_t dim = (size_t)v->scene->dim, half = v->count * dim;
    if (v->count < 2) return base_progress(&v->task, 1) ? FROE_OK : FROE_E_CANCELLED;
    v->tallies = support_calloc(v->alloc, v->task.threads, sizeof *v->tallies);
    if (!v->tallies) return FROE_E_MEMORY;
    for (unsigned i = 0; i < v->task.threads; i++) {
        tally *t = v->tallies + i;
        t->ready = geom_context_new(v->alloc, &t->context) == FROE_OK;
        t->sides = support_calloc(v->alloc, v->side_count, 1);
        if (!t->ready || !t->sides) return FROE_E_MEMORY;
    }
    v->boxes = support_calloc(v->alloc, 2 * half, sizeof *v->boxes);
    if (!v->boxes) return FROE_E_MEMORY;
    for (size_t i = 0; i < v->count; i++)
        scene_object_bounds(v->scene, v->objects[i], v->boxes + i * dim, v->boxes + half + i * dim);
    measure_candidates of = {v->scene, v->objects, v->count, v->boxes, v->boxes + half};
    return measure_odd_pairs(&v->task, &v->tallies[0].context, &of, look_at_pair, v);
}

/* ------------------------------------------------------------------ report -- */

static uint64_t sum(const defect_survey *v, oddity contact, uint32_t first[2]) {
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

froe_status froe_scene_defects(const froe_scene *scene, unsigned threads, froe_progress_fn *progress, void *user,
                               froe_defects *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    if (out->size != sizeof *out)
        return support_fail(diag, FROE_E_OPTIONS, "The size of the report is not sizeof(froe_defects).");
    defect_survey v = {.scene = scene, .alloc = &scene->alloc};
    froe_defects defects = {.size = sizeof defects};
    base_task_init(&v.task, threads, progress, user);
    v.objects = support_calloc(v.alloc, scene->object_count + (size_t)1, sizeof *v.objects);
    froe_status status = v.objects ? scene_originals(scene, v.alloc, v.objects) : FROE_E_MEMORY;
    const froe_kind form = scene->dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    for (uint32_t i = 0; i < scene->object_count && !status; i++) { /* candidates take the place of originals */
        const bool original = v.objects[i] == i;
        defects.duplicates += !original;
        defects.zero_length += scene->kinds[i] == FROE_SEGMENT && scene->forms[i] == FROE_POINT;
        defects.zero_area += scene->kinds[i] == FROE_POLYGON && scene->forms[i] != FROE_POLYGON;
        if (!original || scene->forms[i] != form || scene->dim > 3) continue;
        v.objects[v.count++] = i;
        if (2 * (size_t)scene_corners(scene, i) > v.side_count) v.side_count = 2 * (size_t)scene_corners(scene, i);
    }
    if (!status) {
        status = look_at_pairs(&v);
        defects.crossings = sum(&v, CROSSING, defects.first_crossing);
        defects.t_junctions = sum(&v, T_JUNCTION, defects.first_t_junction);
        defects.overlaps = sum(&v, OVERLAP, defects.first_overlap);
    }
    for (unsigned i = 0; v.tallies && i < v.task.threads; i++) {
        if (v.tallies[i].ready) num_context_free(&v.tallies[i].context);
        support_free(v.alloc, v.tallies[i].sides, v.side_count ? v.side_count : 1);
    }
    support_free(v.alloc, v.tallies, v.task.threads * sizeof *v.tallies);
    support_free(v.alloc, v.boxes, 2 * (size_t)v.count * (size_t)scene->dim * sizeof *v.boxes);
    support_free(v.alloc, v.objects, (scene->object_count + (size_t)1) * sizeof *v.objects);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    if (status) return support_fail_memory(diag);
    *out = defects;
    return FROE_OK;
}
