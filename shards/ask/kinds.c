/* kinds.c: see kinds.h. */
#include "shards/ask/kinds.h"
#include "shards/ask/bounds.h"
#include "support/fail.h"

/* ------------------------------------------------------------------- asking -- */

/* Rows of a table that the questions `which` have, one after the other. NULL: no memory. */
static double *gather_rows(const shards_question *q, const double *table, size_t width, const size_t *which,
                           size_t count) {
    double *rows = support_calloc(&q->alloc, count, width * sizeof *rows);
    for (size_t j = 0; rows && j < count; j++) memcpy(rows + j * width, table + which[j] * width, width * sizeof *rows);
    return rows;
}

static void free_rows(const shards_question *q, double *rows, size_t width, size_t count) {
    if (rows) support_free(&q->alloc, rows, count * width * sizeof *rows);
}

/* Answers of at most one object each. */
static froe_status answers_of_one(const froe_allocator *alloc, const uint32_t *objects, const double *values,
                                  size_t count, shards_answers *out) {
    size_t found = 0;
    for (size_t j = 0; j < count; j++) found += objects[j] != FROE_NONE;
    froe_answers a = {.queries = count, .alloc = *alloc};
    a.starts = support_calloc(alloc, count + 1, sizeof *a.starts);
    a.ids = support_calloc(alloc, found, sizeof *a.ids);
    a.values = values ? support_calloc(alloc, found, sizeof *a.values) : NULL;
    if (!a.starts || !a.ids || (values && !a.values)) {
        if (a.starts) support_free(alloc, a.starts, (count + 1) * sizeof *a.starts);
        if (a.ids) support_free(alloc, a.ids, found * sizeof *a.ids);
        if (a.values) support_free(alloc, a.values, found * sizeof *a.values);
        return FROE_E_MEMORY;
    }
    for (size_t j = 0, at = 0; j < count; j++) {
        if (objects[j] != FROE_NONE) {
            if (values) a.values[at] = values[j];
            a.ids[at++] = objects[j];
        }
        a.starts[j + 1] = at;
    }
    *out = (shards_answers){.all = a, .own = true};
    return FROE_OK;
}

void shards_answers_free(shards_answers *answers) {
    froe_answers *a = &answers->all;
    if (answers->own) {
        const size_t found = a->starts[a->queries];
        support_free(&a->alloc, a->ids, found * sizeof *a->ids);
        if (a->values) support_free(&a->alloc, a->values, found * sizeof *a->values);
        support_free(&a->alloc, a->starts, (a->queries + 1) * sizeof *a->starts);
    } else {
        froe_answers_free(a);
    }
    *answers = (shards_answers){.own = false};
}

static froe_status ask_ranges(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                              const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    froe_range *ranges = support_calloc(&q->alloc, count, sizeof *ranges);
    uint32_t *one = q->any ? support_calloc(&q->alloc, count, sizeof *one) : NULL;
    froe_status status = ranges && (one || !q->any) ? FROE_OK : support_fail_memory(diag);
    for (size_t j = 0; j < count && !status; j++) ranges[j] = q->ranges[which[j]];
    if (!status && !q->any) status = froe_batch_range(query, ranges, count, o, &out->all, diag);
    if (!status && q->any) {
        status = froe_batch_any(query, ranges, count, o, one, diag);
        if (!status && answers_of_one(&q->alloc, one, NULL, count, out)) status = support_fail_memory(diag);
    }
    if (ranges) support_free(&q->alloc, ranges, count * sizeof *ranges);
    if (one) support_free(&q->alloc, one, count * sizeof *one);
    return status;
}

/* Questions that are rows of doubles, and nothing else. */
static froe_status ask_rows(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                            const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    double *rows = gather_rows(q, q->points, q->width, which, count);
    const froe_status status = rows ? q->batch(query, rows, count, o, &out->all, diag) : support_fail_memory(diag);
    free_rows(q, rows, q->width, count);
    return status;
}

static froe_status ask_vertical(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                                const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    double *rows = gather_rows(q, q->points, (size_t)q->dim, which, count);
    uint32_t *objects = support_calloc(&q->alloc, count, sizeof *objects);
    froe_status status =
        rows && objects ? froe_batch_vertical(query, rows, count, q->way, o, objects, diag) : support_fail_memory(diag);
    if (!status && answers_of_one(&q->alloc, objects, NULL, count, out)) status = support_fail_memory(diag);
    if (objects) support_free(&q->alloc, objects, count * sizeof *objects);
    free_rows(q, rows, (size_t)q->dim, count);
    return status;
}

static froe_status ask_related(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                               const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    froe_range *ranges = support_calloc(&q->alloc, count, sizeof *ranges);
    for (size_t j = 0; ranges && j < count; j++) ranges[j] = q->ranges[which[j]];
    const froe_status status = ranges ? froe_batch_groups_range(query, ranges, count, q->relation, o, &out->all, diag)
                                      : support_fail_memory(diag);
    if (ranges) support_free(&q->alloc, ranges, count * sizeof *ranges);
    return status;
}

/* A shard that is asked one group of a tree is asked all of them: they have the same box. */
static froe_status ask_join(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                            const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    (void)which, (void)count;
    return froe_batch_groups_join(query, q->asking, q->relation, o, &out->all, diag);
}

static froe_status ask_near(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                            const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    double *rows = gather_rows(q, q->points, (size_t)q->dim, which, count);
    const froe_status status =
        rows ? froe_batch_near(query, rows, count, q->k, q->most, o, &out->all, diag) : support_fail_memory(diag);
    free_rows(q, rows, (size_t)q->dim, count);
    return status;
}

/* The first hits of rays, or any. */
static froe_status ask_first(const shards_question *q, froe_query *query, const double *origins,
                             const double *directions, size_t count, const froe_batch_options *o, shards_answers *out,
                             froe_diagnostic *diag) {
    froe_hit *hits = support_calloc(&q->alloc, count, sizeof *hits);
    uint32_t *objects = support_calloc(&q->alloc, count, sizeof *objects);
    double *values = support_calloc(&q->alloc, count, sizeof *values);
    froe_status status = hits && objects && values ? FROE_OK : support_fail_memory(diag);
    if (!status && q->any)
        status = froe_batch_ray_any(query, origins, directions, count, q->most, o, objects, diag);
    else if (!status)
        status = froe_batch_ray(query, origins, directions, count, q->most, o, hits, diag);
    for (size_t j = 0; j < count && !status && !q->any; j++) objects[j] = hits[j].object, values[j] = hits[j].t;
    if (!status && answers_of_one(&q->alloc, objects, values, count, out)) status = support_fail_memory(diag);
    if (hits) support_free(&q->alloc, hits, count * sizeof *hits);
    if (objects) support_free(&q->alloc, objects, count * sizeof *objects);
    if (values) support_free(&q->alloc, values, count * sizeof *values);
    return status;
}

static froe_status ask_ray(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                           const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    const size_t dim = (size_t)q->dim;
    double *origins = gather_rows(q, q->points, dim, which, count);
    double *directions = gather_rows(q, q->directions, dim, which, count);
    froe_status status;
    if (!origins || !directions)
        status = support_fail_memory(diag);
    else if (q->k)
        status = ask_first(q, query, origins, directions, count, o, out, diag);
    else
        status = froe_batch_ray_all(query, origins, directions, count, q->most, o, &out->all, diag);
    free_rows(q, origins, dim, count);
    free_rows(q, directions, dim, count);
    return status;
}

/* -------------------------------------------------------------------- kinds -- */

static shards_question question_of(const froe_shards *s, size_t count, shards_ask_fn *ask) {
    return (shards_question){.count = count, .dim = s->dim, .ask = ask, .width = (size_t)s->dim, .alloc = s->alloc};
}

shards_question shards_kind_ranges(const froe_shards *s, const froe_range *ranges, size_t count) {
    shards_question q = question_of(s, count, ask_ranges);
    q.box = shards_box_of_range;
    q.ranges = ranges;
    return q;
}

shards_question shards_kind_related(const froe_shards *s, const froe_range *ranges, size_t count,
                                    froe_relation relation) {
    shards_question q = shards_kind_ranges(s, ranges, count);
    q.ask = ask_related;
    q.relation = relation;
    return q;
}

shards_question shards_kind_boxes(const froe_shards *s, const double *boxes, size_t count) {
    shards_question q = question_of(s, count, ask_rows);
    q.box = shards_box_of_box;
    q.points = boxes;
    q.width = 2 * (size_t)s->dim;
    q.batch = froe_batch_boxes;
    return q;
}

shards_question shards_kind_points(const froe_shards *s, const double *points, size_t count, shards_rows_fn *batch) {
    shards_question q = question_of(s, count, ask_rows);
    q.box = shards_box_of_point;
    q.points = points;
    q.batch = batch;
    return q;
}

shards_question shards_kind_vertical(const froe_shards *s, const double *points, size_t count, int way) {
    shards_question q = question_of(s, count, ask_vertical);
    q.box = shards_box_of_point;
    q.points = points;
    q.way = way;
    return q;
}

shards_question shards_kind_join(const froe_shards *s, const froe_query *asking, const double *bounds, size_t count,
                                 froe_relation relation) {
    shards_question q = question_of(s, count, ask_join);
    q.box = shards_box_of_all;
    q.points = bounds;
    q.asking = asking;
    q.relation = relation;
    return q;
}

shards_question shards_kind_near(const froe_shards *s, const double *points, size_t count, size_t k, double most) {
    shards_question q = question_of(s, count, ask_near);
    q.bound = shards_bound_of_near;
    q.points = points;
    q.k = k;
    q.most = most;
    return q;
}

shards_question shards_kind_rays(const froe_shards *s, const double *origins, const double *directions, size_t count,
                                 size_t k, double most) {
    shards_question q = question_of(s, count, ask_ray);
    q.bound = shards_bound_of_ray;
    q.points = origins;
    q.directions = directions;
    q.k = k;
    q.most = most;
    return q;
}
