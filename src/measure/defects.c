/* defects.c: the defect report: what is odd about a scene, counted exactly.
 *
 * Objects -> distinct, full-dimensional ones -> pairs that may meet oddly -> how each pair touches (survey.h). */
#include "base/apart.h"
#include "base/floats.h"
#include "measure/survey.h"
#include "support/fail.h"

typedef enum oddity { APART, CROSSING, T_JUNCTION, OVERLAP, ODDITIES } oddity;

typedef struct tally {
    uint64_t counts[ODDITIES];
    uint32_t first[ODDITIES][2];
    base_apart apart;
} tally;

typedef struct defect_survey {
    measure_survey of;
    tally *tallies; /* one for each worker */
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
    const uint32_t a = v->of.objects[i < j ? i : j], b = v->of.objects[i < j ? j : i];
    if (measure_survey_are_aside(&v->of, a, b)) return true;
    const geom_contact m = measure_survey_meet(&v->of, worker, a, b);
    const oddity contact = m.kind == GEOM_CROSS     ? CROSSING
                           : m.kind == GEOM_OVERLAP ? OVERLAP
                           : m.kind == GEOM_TOUCH   ? by_touch[m.touch]
                                                    : APART;
    measure_note_pair(&t->counts[contact], t->first[contact], a, b);
    return true;
}

static froe_status look_at_pairs(defect_survey *v) {
    if (v->of.count < 2) return base_progress(&v->of.task, 1) ? FROE_OK : FROE_E_CANCELLED;
    v->tallies = support_calloc(&v->of.scene->alloc, v->of.task.threads, sizeof *v->tallies);
    if (!v->tallies) return FROE_E_MEMORY;
    const measure_candidates of = measure_survey_candidates(&v->of);
    return measure_odd_pairs(&v->of.task, &v->of.workers[0].context, &of, look_at_pair, v);
}

/* ------------------------------------------------------------------ report -- */

static uint64_t sum(const defect_survey *v, oddity contact, uint32_t first[2]) {
    uint64_t count = 0;
    first[0] = first[1] = FROE_NONE;
    for (unsigned i = 0; v->tallies && i < v->of.task.threads; i++)
        measure_add_pairs(&count, first, v->tallies[i].counts[contact], v->tallies[i].first[contact]);
    return count;
}

froe_status froe_scene_defects(const froe_scene *scene, unsigned threads, froe_progress_fn *progress, void *user,
                               froe_defects *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    if (out->size != sizeof *out)
        return support_fail(diag, FROE_E_OPTIONS, "The size of the report is not sizeof(froe_defects).");
    const froe_status settled = scene_settle(scene, diag);
    if (settled) return settled;
    defect_survey v = {.tallies = NULL};
    froe_defects defects = {.size = sizeof defects};
    froe_status status = measure_survey_begin(scene, threads, progress, user, &v.of);
    defects.duplicates = v.of.duplicates;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        defects.zero_length += scene_kind(scene, i) == FROE_SEGMENT && scene_form(scene, i) == FROE_POINT;
        defects.zero_area += scene_kind(scene, i) == FROE_POLYGON && scene_form(scene, i) != FROE_POLYGON;
    }
    if (!status) status = look_at_pairs(&v);
    defects.crossings = sum(&v, CROSSING, defects.first_crossing);
    defects.t_junctions = sum(&v, T_JUNCTION, defects.first_t_junction);
    defects.overlaps = sum(&v, OVERLAP, defects.first_overlap);
    support_free(&scene->alloc, v.tallies, v.of.task.threads * sizeof *v.tallies);
    measure_survey_end(&v.of);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    if (status) return support_fail_memory(diag);
    *out = defects;
    return FROE_OK;
}
