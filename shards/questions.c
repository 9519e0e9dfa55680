/* questions.c: the public questions, each with its box or bound, and the batch call of froe/query.h that answers it. */
#include "share.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>

/* ------------------------------------------------------------------ asking -- */

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

/* -------------------------------------------------------- boxes and bounds -- */

/* The box of a range. It need not be the least. */
static void box_of_range(const shards_question *q, size_t i, double *lo, double *hi) {
    const froe_range *r = &q->ranges[i];
    const size_t dim = (size_t)q->dim;
    const size_t corners[FROE_SHAPE_COUNT] = {
        [FROE_SHAPE_BOX] = 2,     [FROE_SHAPE_BALL] = 1,        [FROE_SHAPE_SIMPLEX] = dim + 1,
        [FROE_SHAPE_CAPSULE] = 2, [FROE_SHAPE_HULL] = r->count, [FROE_SHAPE_SEGMENT] = 2};
    const size_t count = (unsigned)r->shape < FROE_SHAPE_COUNT && r->points ? corners[r->shape] : 0;
    const bool round = r->shape == FROE_SHAPE_BALL || r->shape == FROE_SHAPE_CAPSULE;
    for (size_t a = 0; a < dim; a++) {
        lo[a] = count ? INFINITY : -INFINITY;
        hi[a] = count ? -INFINITY : INFINITY;
        for (size_t c = 0; c < count; c++) {
            const double x = r->points[c * dim + a];
            if (!(x >= lo[a])) lo[a] = x;
            if (!(x <= hi[a])) hi[a] = x;
        }
        if (round) lo[a] = nextafter(lo[a] - r->radius, -INFINITY), hi[a] = nextafter(hi[a] + r->radius, INFINITY);
        if (r->shape != FROE_SHAPE_RAY || !r->points) continue;
        if (r->points[dim + a] >= 0) lo[a] = r->points[a];
        if (r->points[dim + a] <= 0) hi[a] = r->points[a];
    }
}

static void box_of_box(const shards_question *q, size_t i, double *lo, double *hi) {
    const size_t dim = (size_t)q->dim;
    memcpy(lo, q->points + 2 * i * dim, dim * sizeof *lo);
    memcpy(hi, q->points + (2 * i + 1) * dim, dim * sizeof *hi);
}

/* The same for all questions. */
static void box_of_all(const shards_question *q, size_t i, double *lo, double *hi) {
    (void)i;
    box_of_box(q, 0, lo, hi);
}

static void box_of_point(const shards_question *q, size_t i, double *lo, double *hi) {
    for (int a = 0; a < q->dim; a++) lo[a] = hi[a] = q->points[i * (size_t)q->dim + (size_t)a];
    if (q->way > 0) hi[1] = INFINITY;
    if (q->way < 0) lo[1] = -INFINITY;
}

/* The largest distance along an axis. A rounded difference is at most the rounded distance, because rounding keeps the
 * order of the exact ones. */
static double bound_of_near(const shards_question *q, size_t i, const double *lo, const double *hi) {
    double most = 0;
    for (int a = 0; a < q->dim; a++) {
        const double x = q->points[i * (size_t)q->dim + (size_t)a];
        const double off = x < lo[a] ? lo[a] - x : x > hi[a] ? x - hi[a] : 0;
        if (off > most) most = off;
    }
    return most < INFINITY ? most : 0x1.fffffffffffffp1023;
}

/* (to - from) / by, rounded away from the exact number: downwards, or upwards. */
static double parameter(double from, double to, double by, bool up) {
    const double wide = nextafter(to - from, (by > 0) == up ? INFINITY : -INFINITY);
    return nextafter(wide / by, up ? INFINITY : -INFINITY);
}

/* The parameter at which a ray enters a box, from below; slabs (Kay and Kajiya 1986), rounded outwards. */
static double bound_of_ray(const shards_question *q, size_t i, const double *lo, const double *hi) {
    const double *from = q->points + i * (size_t)q->dim, *by = q->directions + i * (size_t)q->dim;
    double enter = 0, leave = q->most;
    for (int a = 0; a < q->dim; a++) {
        if (by[a] == 0) {
            if (from[a] < lo[a] || from[a] > hi[a]) return INFINITY;
            continue;
        }
        const double in = parameter(from[a], by[a] > 0 ? lo[a] : hi[a], by[a], false);
        const double out = parameter(from[a], by[a] > 0 ? hi[a] : lo[a], by[a], true);
        if (in > enter) enter = in;
        if (out < leave) leave = out;
    }
    return enter > leave ? INFINITY : enter < INFINITY ? enter : 0x1.fffffffffffffp1023;
}

/* ------------------------------------------------------------------- frames -- */

static froe_status refuse_null(const void *shards, const void *input, size_t count, const void *out,
                               const char *function, froe_diagnostic *diag) {
    return shards && (input || !count) && out ? FROE_OK : support_fail_null(diag, function);
}

static shards_question question_of(const froe_shards *s, size_t count, shards_ask_fn *ask) {
    return (shards_question){.count = count, .dim = s->dim, .ask = ask, .width = (size_t)s->dim, .alloc = s->alloc};
}

/* Questions that are points. */
static shards_question points_of(const froe_shards *s, const double *points, size_t count, shards_rows_fn *batch) {
    shards_question q = question_of(s, count, ask_rows);
    q.box = box_of_point;
    q.points = points;
    q.batch = batch;
    return q;
}

/* All that questions reach. */
static froe_status find_all(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                            froe_finds *out, froe_diagnostic *diag) {
    shards_gather found = {.values = q->bound != NULL, .alloc = s->alloc};
    froe_status status = shards_reach(s, q, options, shards_gather_take, &found, diag);
    if (!status && shards_gather_finds(&found, q->count, out)) status = support_fail_memory(diag);
    array_free(&found.alloc, &found.list);
    return status;
}

/* Puts the first of each question's answers, or none, where the caller has room for it. */
static void take_firsts(froe_finds *f, froe_find *finds) {
    for (size_t i = 0; i < f->questions; i++)
        finds[i] = f->starts[i] < f->starts[i + 1] ? f->items[f->starts[i]]
                                                   : (froe_find){.shard = FROE_NONE, .object = FROE_NONE};
    froe_finds_free(f);
}

/* Answers by bounds; k of each at most, or with k 0 all. */
static froe_status find_ordered(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                                froe_finds *out, froe_diagnostic *diag) {
    froe_finds f = {0};
    froe_status status = q->k ? shards_rounds(s, q, options, &f, diag) : find_all(s, q, options, &f, diag);
    if (!q->any) status = shards_decide(s, q, &f, q->k ? q->k : SIZE_MAX, status, diag);
    if (status)
        froe_finds_free(&f);
    else
        *out = f;
    return status;
}

void froe_finds_free(froe_finds *f) {
    if (!f || !f->starts) return;
    const size_t items = f->starts[f->questions + 1] + 1; /* see shards_gather_finds() */
    if (f->items) support_free(&f->alloc, f->items, items * sizeof *f->items);
    support_free(&f->alloc, f->starts, (f->questions + 2) * sizeof *f->starts);
    *f = (froe_finds){.alloc = f->alloc};
}

/* ---------------------------------------------------------------- questions -- */

froe_status froe_shards_range(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                              froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, ranges, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_ranges);
    q.box = box_of_range;
    q.ranges = ranges;
    return find_all(s, &q, options, out, diag);
}

froe_status froe_shards_boxes(froe_shards *s, const double *boxes, size_t count, const froe_batch_options *options,
                              froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, boxes, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_rows);
    q.box = box_of_box;
    q.points = boxes;
    q.width = 2 * (size_t)s->dim;
    q.batch = froe_batch_boxes;
    return find_all(s, &q, options, out, diag);
}

static bool count_finds(void *counts, size_t i, const froe_find *find) {
    ((uint64_t *)counts)[i] += find->tag;
    return true;
}

froe_status froe_shards_count(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                              uint64_t *counts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, ranges, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_ranges);
    q.box = box_of_range;
    q.ranges = ranges;
    q.counted = true;
    memset(counts, 0, count * sizeof *counts);
    return shards_reach(s, &q, options, count_finds, counts, diag);
}

/* Any answer does: the shards that a range may meet have bound 0. */
static double bound_of_any(const shards_question *q, size_t i, const double *lo, const double *hi) {
    double box_lo[FROE_MAX_DIM], box_hi[FROE_MAX_DIM];
    box_of_range(q, i, box_lo, box_hi);
    for (int a = 0; a < q->dim; a++)
        if (lo[a] > box_hi[a] || hi[a] < box_lo[a]) return INFINITY;
    return 0;
}

froe_status froe_shards_any(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                            froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, ranges, count, finds, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_ranges);
    froe_finds f;
    q.bound = bound_of_any;
    q.ranges = ranges;
    q.any = true;
    q.k = 1;
    const froe_status status = find_ordered(s, &q, options, &f, diag);
    if (!status) take_firsts(&f, finds);
    return status;
}

froe_status froe_shards_locate(froe_shards *s, const double *points, size_t count, const froe_batch_options *options,
                               froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = points_of(s, points, count, froe_batch_locate);
    return find_all(s, &q, options, out, diag);
}

/* A group is whole in every shard that has a part of it, so that each knows all about it. */
static froe_status find_groups(froe_shards *s, shards_question *q, const froe_batch_options *options, froe_finds *out,
                               froe_diagnostic *diag) {
    froe_finds f;
    if (s->dim != 2) return support_fail(diag, FROE_E_UNSUPPORTED, "Groups are areas in the plane only.");
    q->groups = true;
    froe_status status = find_all(s, q, options, &f, diag);
    if (status) return status;
    size_t kept = 0;
    for (size_t i = 0, first = 0, end; i < f.questions; i++, first = end) {
        end = f.starts[i + 1];
        for (size_t j = first; j < end; j++)
            if (j == first || f.items[j].tag != f.items[j - 1].tag) f.items[kept++] = f.items[j];
        f.starts[i + 1] = kept;
    }
    *out = f;
    return FROE_OK;
}

froe_status froe_shards_groups(froe_shards *s, const double *points, size_t count, const froe_batch_options *options,
                               froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = points_of(s, points, count, froe_batch_groups);
    return find_groups(s, &q, options, out, diag);
}

froe_status froe_shards_groups_range(froe_shards *s, const froe_range *ranges, size_t count, froe_relation relation,
                                     const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, ranges, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_related);
    q.box = box_of_range;
    q.ranges = ranges;
    q.relation = relation;
    return find_groups(s, &q, options, out, diag);
}

froe_status froe_shards_groups_join(froe_shards *s, const froe_tree *questions, froe_relation relation,
                                    const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, questions, 1, out, __func__, diag)) return FROE_E_ARG;
    const froe_scene *scene = froe_tree_scene(questions);
    double bounds[2 * FROE_MAX_DIM] = {0};
    froe_query *asking;
    if (froe_scene_dim(scene) != 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Groups are areas in the plane only.");
    if (s->share) return support_fail(diag, FROE_E_UNSUPPORTED, "A tree of questions is not sent to other processes.");
    (void)froe_scene_bounds(scene, bounds, bounds + 2); /* of no objects: any place does */
    froe_status status = froe_query_new(questions, &asking, diag);
    if (status) return status;
    shards_question q = question_of(s, froe_scene_group_count(scene), ask_join);
    q.box = box_of_all;
    q.points = bounds;
    q.asking = asking;
    q.relation = relation;
    status = find_groups(s, &q, options, out, diag);
    froe_query_free(asking);
    return status;
}

froe_status froe_shards_vertical(froe_shards *s, const double *points, size_t count, int direction,
                                 const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, points, count, finds, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_vertical);
    froe_finds f = {0};
    q.box = box_of_point;
    q.points = points;
    q.way = direction;
    froe_status status = find_all(s, &q, options, &f, diag);
    status = shards_decide(s, &q, &f, 1, status, diag); /* of all shards: they have no values to compare */
    if (status)
        froe_finds_free(&f);
    else
        take_firsts(&f, finds);
    return status;
}

/* Rays: what they meet first (k 1), anything (any), or all (k 0). */
static froe_status find_hits(froe_shards *s, const double *origins, const double *directions, size_t count,
                             double t_max, size_t k, bool any, const froe_batch_options *options, froe_finds *out,
                             froe_diagnostic *diag) {
    shards_question q = question_of(s, count, ask_ray);
    q.bound = bound_of_ray;
    q.points = origins;
    q.directions = directions;
    q.most = t_max;
    q.k = k;
    q.any = any;
    return find_ordered(s, &q, options, out, diag);
}

froe_status froe_shards_ray(froe_shards *s, const double *origins, const double *directions, size_t count, double t_max,
                            const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_finds f;
    if (refuse_null(s, origins && directions ? origins : NULL, count, finds, __func__, diag)) return FROE_E_ARG;
    const froe_status status = find_hits(s, origins, directions, count, t_max, 1, false, options, &f, diag);
    if (!status) take_firsts(&f, finds);
    return status;
}

froe_status froe_shards_ray_any(froe_shards *s, const double *origins, const double *directions, size_t count,
                                double t_max, const froe_batch_options *options, froe_find *finds,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_finds f;
    if (refuse_null(s, origins && directions ? origins : NULL, count, finds, __func__, diag)) return FROE_E_ARG;
    const froe_status status = find_hits(s, origins, directions, count, t_max, 1, true, options, &f, diag);
    if (!status) take_firsts(&f, finds);
    return status;
}

froe_status froe_shards_ray_all(froe_shards *s, const double *origins, const double *directions, size_t count,
                                double t_max, const froe_batch_options *options, froe_finds *out,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, origins && directions ? origins : NULL, count, out, __func__, diag)) return FROE_E_ARG;
    return find_hits(s, origins, directions, count, t_max, 0, false, options, out, diag);
}

froe_status froe_shards_near(froe_shards *s, const double *points, size_t count, size_t k, double bound,
                             const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = question_of(s, count, ask_near);
    q.bound = bound_of_near;
    q.points = points;
    q.k = k;
    q.most = bound;
    return find_ordered(s, &q, options, out, diag);
}

/* -------------------------------------------------------------------- pairs -- */

/* Pairs of one shard on their way to the caller. */
typedef struct shard_pairs {
    const froe_shards *shards;
    uint32_t shard;
    bool stopped;
    froe_found_pair_fn *fn;
    void *user;
} shard_pairs;

static froe_find find_in(const froe_scene *scene, uint32_t shard, uint32_t object) {
    return (froe_find){.tag = froe_scene_object(scene, object).tag, .shard = shard, .object = object};
}

/* A pair is told by the first cell that what the boxes of both have in common meets. */
static bool tell_pair(void *user, const froe_pair *pair) {
    SUPPORT_FLOATS_OWN;
    shard_pairs *p = user;
    const froe_scene *scene = froe_tree_scene(p->shards->slots[p->shard].tree);
    double lo[FROE_MAX_DIM], other[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    shards_scene_box(scene, pair->a, lo, hi);
    shards_scene_box(scene, pair->b, other, hi);
    for (int a = 0; a < p->shards->dim; a++) lo[a] = other[a] > lo[a] ? other[a] : lo[a];
    if (shards_plan_first(p->shards->manifest.plan, lo) != p->shard) return true;
    const froe_found_pair found = {
        .a = find_in(scene, p->shard, pair->a), .b = find_in(scene, p->shard, pair->b), .kind = pair->kind};
    p->stopped = !support_callback(p->fn(p->user, &found));
    return !p->stopped;
}

froe_status froe_shards_pairs(froe_shards *s, bool shared, const froe_batch_options *options, froe_found_pair_fn *fn,
                              void *user, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !fn) return support_fail_null(diag, __func__);
    const shards_question none = {0};
    shards_call call;
    shard_pairs p = {.shards = s, .fn = fn, .user = user};
    froe_status status = shards_call_begin(s, &none, options, &call, diag);
    for (uint32_t i = 0; i < s->count && !status && !p.stopped; i++) {
        froe_query *query;
        p.shard = i;
        if (!shards_entry(s, i)->objects || !shards_share_owns(s, i)) continue;
        status = shards_query(s, i, &query, diag);
        if (status) break;
        status = froe_batch_pairs(query, shared, &call.options, tell_pair, &p, diag);
        if (status) return shards_name_file(s, i, status, diag);
        status = shards_call_progress(&call, (double)(i + 1) / s->count, diag);
    }
    return status;
}
