/* batch.c: the same question about many ranges or points, on several threads.
 *
 *     queries   0 .. 255 | 256 .. 511 | ...     chunks, in any order, each with the context of its thread
 *     answers   one after the other, in the order of the queries
 */
#include "base/status.h"
#include "base/task.h"
#include "query/areas.h"
#include "query/packed.h"
#include <string.h>

enum { CHUNK = 256 };

typedef struct chunk {
    ARRAY(uint32_t) ids;
    ARRAY(double) values;
    uint32_t counts[CHUNK];
    froe_diagnostic diag;
} chunk;

typedef struct batch batch;
/** Asks question i. Objects found are left in q->found, unless they go to the caller's array. */
typedef froe_status ask_fn(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag);

struct batch {
    froe_query *query, **workers;
    ask_fn *ask;
    const froe_range *ranges; /* or ... */
    const double *points, *directions;
    double limit; /* t_max; bound */
    size_t k;
    int direction;
    froe_hit *hits;    /* the caller's */
    uint32_t *objects; /* the caller's */
    bool valued;       /* distances beside the ids? */
    size_t count, chunk_count;
    unsigned threads;
    chunk *chunks;
};

froe_batch_options froe_batch_defaults(void) {
    return (froe_batch_options){.size = sizeof(froe_batch_options)};
}

void froe_answers_free(froe_answers *answers) {
    if (!answers || !answers->starts) return;
    const size_t ids = answers->starts[answers->queries];
    base_free(&answers->alloc, answers->ids, (ids ? ids : 1) * sizeof *answers->ids);
    base_free(&answers->alloc, answers->values, (ids ? ids : 1) * sizeof *answers->values);
    base_free(&answers->alloc, answers->starts, (answers->queries + 1) * sizeof *answers->starts);
    *answers = (froe_answers){0};
}

/* ----------------------------------------------------------------- asking -- */

static const double *point_of(const batch *b, const double *points, size_t i) {
    return points + i * (size_t)b->query->tree->scene->dim;
}

static froe_status ask_range(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return query_range_ask(q, b->ranges + i, false, diag);
}

static froe_status ask_locate(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return query_locate(q, point_of(b, b->points, i), diag);
}

/* Has answers that lie elsewhere in the context where those of ranges do. */
static froe_status ask_groups(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    froe_list groups;
    const froe_status status = froe_query_groups(q, point_of(b, b->points, i), &groups, diag);
    q->found.count = 0;
    if (status) return status;
    if (!array_reserve(&q->alloc, &q->found, groups.count)) return base_fail_memory(diag);
    if (groups.count) memcpy(q->found.data, groups.ids, groups.count * sizeof *groups.ids);
    q->found.count = groups.count;
    return FROE_OK;
}

static froe_status ask_vertical(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_vertical(q, point_of(b, b->points, i), b->direction, b->objects + i, diag);
}

static froe_status ask_ray(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_ray(q, point_of(b, b->points, i), point_of(b, b->directions, i), b->limit, b->hits + i, diag);
}

static froe_status ask_near(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    froe_neighbours near;
    const froe_status status = froe_query_near(q, point_of(b, b->points, i), b->k, b->limit, &near, diag);
    q->found.count = 0;
    if (status) return status;
    if (!array_reserve(&q->alloc, &q->found, near.count)) return base_fail_memory(diag);
    for (size_t n = 0; n < near.count; n++) q->found.data[q->found.count++] = near.items[n].object;
    return FROE_OK;
}

/* Appends what a query found to its chunk. */
static bool append(const batch *b, const froe_query *q, chunk *c) {
    const size_t count = q->found.count;
    if (!array_reserve(&q->alloc, &c->ids, count)) return false;
    if (b->valued && !array_reserve(&q->alloc, &c->values, count)) return false;
    if (count) memcpy(c->ids.data + c->ids.count, q->found.data, count * sizeof *q->found.data);
    c->ids.count += count;
    for (size_t i = 0; b->valued && i < count; i++) c->values.data[c->values.count++] = q->near.out.data[i].distance;
    return true;
}

/* Rays of a chunk all at once, on a packed tree: one computes while others wait for memory. */
static froe_status answer_flock(const batch *b, froe_query *q, size_t first, size_t end, froe_diagnostic *diag) {
    for (size_t i = first; i < end; i++) {
        const froe_status status = query_vertical_check(q, point_of(b, b->points, i), b->direction, diag);
        if (status) diag->object = (uint32_t)i;
        if (status) return status;
    }
    const double *points = point_of(b, b->points, first);
    return packed_vertical(q, points, end - first, b->direction, b->objects + first) ? base_fail_memory(diag) : FROE_OK;
}

static froe_status answer_chunk(void *user, unsigned worker, size_t job) {
    const batch *b = user;
    froe_query *q = b->workers[worker];
    chunk *c = b->chunks + job;
    const size_t first = job * CHUNK, end = first + CHUNK < b->count ? first + CHUNK : b->count;
    if (b->ask == ask_vertical && q->packed) return answer_flock(b, q, first, end, &c->diag);
    for (size_t i = first; i < end; i++) {
        froe_status status = b->ask(b, q, i, &c->diag);
        if (!status && !append(b, q, c)) status = base_fail_memory(&c->diag);
        if (status) {
            c->diag.object = (uint32_t)i;
            return status;
        }
        c->counts[i - first] = (uint32_t)q->found.count;
    }
    return FROE_OK;
}

/* --------------------------------------------------------------- gathering -- */

static froe_status gather(const batch *b, froe_answers *out) {
    const froe_allocator *alloc = &b->query->alloc;
    froe_answers answers = {.queries = b->count, .alloc = *alloc};
    size_t total = 0;
    for (size_t i = 0; i < b->chunk_count; i++) total += b->chunks[i].ids.count;
    answers.starts = base_calloc(alloc, b->count + 1, sizeof *answers.starts);
    if (!answers.starts) return FROE_E_MEMORY;
    answers.ids = base_calloc(alloc, total ? total : 1, sizeof *answers.ids);
    if (b->valued) answers.values = base_calloc(alloc, total ? total : 1, sizeof *answers.values);
    if (!answers.ids || (b->valued && !answers.values)) {
        base_free(alloc, answers.starts, (b->count + 1) * sizeof *answers.starts);
        base_free(alloc, answers.ids, (total ? total : 1) * sizeof *answers.ids);
        base_free(alloc, answers.values, (total ? total : 1) * sizeof *answers.values);
        return FROE_E_MEMORY;
    }
    for (size_t i = 0, at = 0; i < b->chunk_count; i++) {
        const chunk *c = b->chunks + i;
        if (c->ids.count) memcpy(answers.ids + at, c->ids.data, c->ids.count * sizeof *answers.ids);
        if (c->values.count) memcpy(answers.values + at, c->values.data, c->values.count * sizeof *answers.values);
        at += c->ids.count;
    }
    for (size_t i = 0; i < b->count; i++)
        answers.starts[i + 1] = answers.starts[i] + b->chunks[i / CHUNK].counts[i % CHUNK];
    *out = answers;
    return FROE_OK;
}

/* ----------------------------------------------------------------- workers -- */

/* The first is the caller's own context. */
static froe_status take_workers(batch *b) {
    const froe_allocator *alloc = &b->query->alloc;
    b->workers = base_calloc(alloc, b->threads, sizeof(froe_query *));
    b->chunks = base_calloc(alloc, b->chunk_count, sizeof *b->chunks);
    if (!b->workers || !b->chunks) return FROE_E_MEMORY;
    b->workers[0] = b->query;
    for (unsigned i = 1; i < b->threads; i++) {
        const froe_status status = froe_query_fork(b->query, &b->workers[i], NULL);
        if (status) return status;
    }
    return FROE_OK;
}

static void add_statistics(froe_query_stats *sum, const froe_query_stats *more) {
    sum->queries += more->queries;
    sum->nodes += more->nodes;
    sum->leaves += more->leaves;
    sum->tests += more->tests;
    sum->exact += more->exact;
    sum->slices += more->slices;
}

static void give_workers(batch *b) {
    const froe_allocator *alloc = &b->query->alloc;
    for (unsigned i = 1; b->workers && i < b->threads; i++) {
        if (b->workers[i]) add_statistics(&b->query->stats, &b->workers[i]->stats);
        froe_query_free(b->workers[i]);
    }
    for (size_t i = 0; b->chunks && i < b->chunk_count; i++) {
        array_free(alloc, &b->chunks[i].ids);
        array_free(alloc, &b->chunks[i].values);
    }
    if (b->workers) base_free(alloc, b->workers, b->threads * sizeof(froe_query *));
    if (b->chunks) base_free(alloc, b->chunks, b->chunk_count * sizeof *b->chunks);
}

/* What the first bad query said. */
static froe_status explain(const batch *b, froe_status status, froe_diagnostic *diag) {
    for (size_t i = 0; i < b->chunk_count; i++)
        if (b->chunks[i].diag.status == status) {
            if (diag) *diag = b->chunks[i].diag;
            return status;
        }
    if (status == FROE_E_CANCELLED) return base_fail(diag, status, "cancelled");
    return base_fail_memory(diag);
}

static froe_status run(batch *b, const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    base_task task;
    if (options && options->size != sizeof *options)
        return base_fail(diag, FROE_E_OPTIONS, "Batch options must come from froe_batch_defaults().");
    if (b->count > UINT32_MAX - 1) return base_fail(diag, FROE_E_LIMIT, "A batch has at most 2^32 - 2 queries.");
    base_task_init(&task, options ? options->threads : 0, options ? options->progress : NULL,
                   options ? options->user : NULL);
    b->chunk_count = (b->count + CHUNK - 1) / CHUNK;
    if (!b->chunk_count) return out && gather(b, out) ? base_fail_memory(diag) : FROE_OK;
    if (task.threads > b->chunk_count) task.threads = (unsigned)b->chunk_count;
    b->threads = task.threads;
    froe_status status = take_workers(b);
    if (status)
        base_fail_memory(diag);
    else if ((status = base_run(&task, 1, b->chunk_count, answer_chunk, b)))
        explain(b, status, diag);
    else if (out && (status = gather(b, out)))
        base_fail_memory(diag);
    give_workers(b);
    return status;
}

froe_status froe_batch_range(froe_query *query, const froe_range *ranges, size_t count,
                             const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    if (!query || !out || (count && !ranges)) return base_fail(diag, FROE_E_ARG, "froe_batch_range: NULL argument.");
    batch b = {.query = query, .ask = ask_range, .ranges = ranges, .count = count};
    return run(&b, options, out, diag);
}

froe_status froe_batch_locate(froe_query *query, const double *points, size_t count, const froe_batch_options *options,
                              froe_answers *out, froe_diagnostic *diag) {
    if (!query || !out || (count && !points)) return base_fail(diag, FROE_E_ARG, "froe_batch_locate: NULL argument.");
    batch b = {.query = query, .ask = ask_locate, .points = points, .count = count};
    return run(&b, options, out, diag);
}

froe_status froe_batch_groups(froe_query *query, const double *points, size_t count, const froe_batch_options *options,
                              froe_answers *out, froe_diagnostic *diag) {
    if (!query || !out || (count && !points)) return base_fail(diag, FROE_E_ARG, "froe_batch_groups: NULL argument.");
    batch b = {.query = query, .ask = ask_groups, .points = points, .count = count};
    const query_areas *areas;
    const froe_status status = query_groups_prepare(query, &areas, diag); /* once for all threads */
    if (status) return status;
    return run(&b, options, out, diag);
}

froe_status froe_batch_vertical(froe_query *query, const double *points, size_t count, int direction,
                                const froe_batch_options *options, uint32_t *objects, froe_diagnostic *diag) {
    if (!query || (count && (!points || !objects)))
        return base_fail(diag, FROE_E_ARG, "froe_batch_vertical: NULL argument.");
    batch b = {.query = query, .ask = ask_vertical, .points = points, .count = count};
    b.direction = direction;
    b.objects = objects;
    return run(&b, options, NULL, diag);
}

froe_status froe_batch_ray(froe_query *query, const double *origins, const double *directions, size_t count,
                           double t_max, const froe_batch_options *options, froe_hit *hits, froe_diagnostic *diag) {
    if (!query || (count && (!origins || !directions || !hits)))
        return base_fail(diag, FROE_E_ARG, "froe_batch_ray: NULL argument.");
    batch b = {.query = query, .ask = ask_ray, .points = origins, .directions = directions, .count = count};
    b.limit = t_max;
    b.hits = hits;
    return run(&b, options, NULL, diag);
}

froe_status froe_batch_near(froe_query *query, const double *points, size_t count, size_t k, double bound,
                            const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    if (!query || !out || (count && !points)) return base_fail(diag, FROE_E_ARG, "froe_batch_near: NULL argument.");
    batch b = {.query = query, .ask = ask_near, .points = points, .count = count, .k = k, .limit = bound};
    b.valued = true;
    return run(&b, options, out, diag);
}
