/* survey.c: see survey.h. */
#include "measure/survey.h"
#include "geom/eye.h"
#include "geom/selftest.h"

static froe_status list_objects(measure_survey *v) {
    const froe_scene *s = v->scene;
    const froe_kind form = s->dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    v->room = (s->object_count + (size_t)1) * sizeof *v->objects;
    v->objects = support_calloc(&s->alloc, s->object_count + (size_t)1, sizeof *v->objects);
    const froe_status status = v->objects ? scene_originals(s, &s->alloc, v->objects) : FROE_E_MEMORY;
    for (uint32_t i = 0; i < s->object_count && !status; i++) { /* candidates take the place of originals */
        const bool original = v->objects[i] == i;
        v->duplicates += !original;
        if (!original || scene_form(s, i) != form || s->dim > 3) continue;
        v->objects[v->count++] = i;
        if (2 * (size_t)scene_corners(s, i) > v->side_count) v->side_count = 2 * (size_t)scene_corners(s, i);
    }
    return status;
}

static size_t numbers_of_boxes(const measure_survey *v) {
    return 2 * (size_t)v->count * (size_t)v->scene->dim;
}

froe_status measure_survey_begin(const froe_scene *scene, unsigned threads, froe_progress_fn *progress, void *user,
                                 measure_survey *out) {
    *out = (measure_survey){.scene = scene, .side_count = 1};
    base_task_init(&out->task, threads, progress, user);
    const froe_status status = list_objects(out);
    if (status || out->count < 2) return status;
    const froe_allocator *alloc = &scene->alloc;
    out->workers = support_calloc(alloc, out->task.threads, sizeof *out->workers);
    if (!out->workers) return FROE_E_MEMORY;
    for (unsigned i = 0; i < out->task.threads; i++) {
        measure_worker *w = out->workers + i;
        w->ready = geom_context_new(alloc, &w->context) == FROE_OK;
        w->sides = support_calloc(alloc, out->side_count, 1);
        if (!w->ready || !w->sides) return FROE_E_MEMORY;
    }
    out->boxes = support_calloc(alloc, numbers_of_boxes(out), sizeof *out->boxes);
    if (!out->boxes) return FROE_E_MEMORY;
    const size_t dim = (size_t)scene->dim, half = out->count * dim;
    for (size_t i = 0; i < out->count; i++)
        scene_object_bounds(scene, out->objects[i], out->boxes + i * dim, out->boxes + half + i * dim);
    return FROE_OK;
}

void measure_survey_end(measure_survey *v) {
    const froe_allocator *alloc = &v->scene->alloc;
    for (unsigned i = 0; v->workers && i < v->task.threads; i++) {
        if (v->workers[i].ready) num_context_free(&v->workers[i].context);
        support_free(alloc, v->workers[i].sides, v->side_count);
    }
    support_free(alloc, v->workers, v->task.threads * sizeof *v->workers);
    support_free(alloc, v->boxes, numbers_of_boxes(v) * sizeof *v->boxes);
    support_free(alloc, v->objects, v->room);
}

measure_candidates measure_survey_candidates(const measure_survey *v) {
    const double *hi = v->boxes + v->count * (size_t)v->scene->dim;
    return (measure_candidates){v->scene, v->objects, v->count, v->boxes, hi};
}

/* Are the corners of b that are none of a all on one side of the plane of a, strictly? Then b has only the others in
 * it, and the edge between two of them. */
static bool is_beside(const froe_scene *s, uint32_t a, uint32_t b) {
    const uint32_t corners = scene_corners(s, a);
    uint32_t common = 0;
    int side = 0;
    for (uint32_t i = 0; i < scene_corners(s, b); i++) {
        const uint32_t vertex = scene_corner(s, b, i);
        uint32_t k = 0;
        while (k < corners && scene_corner(s, a, k) != vertex) k++;
        if (k < corners) {
            if (common++ && corners > 3) return false; /* that may be a diagonal of a */
            continue;
        }
        const double *x = scene_vertex(s, vertex);
        const int here = geom_side_of_eye_filter(scene_point(s, a, 0), scene_point(s, a, 1), scene_point(s, a, 2),
                                                 &(geom_eye){.at = {x[0], x[1], x[2]}});
        if (here == NUM_UNSURE || (side && here != side)) return false;
        side = here;
    }
    return side != 0;
}

bool measure_survey_are_aside(const measure_survey *v, uint32_t a, uint32_t b) {
    const froe_scene *s = v->scene;
    return s->dim == 3 && v->workers[0].context.first == NUM_FILTER && (is_beside(s, a, b) || is_beside(s, b, a));
}

geom_contact measure_survey_meet(const measure_survey *v, unsigned worker, uint32_t a, uint32_t b) {
    measure_worker *w = v->workers + worker;
    const geom_body p = scene_body(v->scene, a), q = scene_body(v->scene, b);
    return v->scene->dim == 2 ? geom_contact_segments(&w->context, &p, &q)
                              : geom_contact_polygons(&w->context, &p, &q, w->sides);
}

static bool is_less(const uint32_t a[2], const uint32_t b[2]) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

void measure_note_pair(uint64_t *count, uint32_t first[2], uint32_t a, uint32_t b) {
    measure_add_pairs(count, first, 1, (const uint32_t[2]){a, b});
}

void measure_add_pairs(uint64_t *count, uint32_t first[2], uint64_t more, const uint32_t least[2]) {
    if (more && (!*count || is_less(least, first))) first[0] = least[0], first[1] = least[1];
    *count += more;
}
