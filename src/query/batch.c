/* batch.c: the same question about many ranges or points, on several threads.
 *
 *     queries   0 .. 255 | 256 .. 511 | ...     chunks, in any order, each with the context of its thread
 *     found     3 1 4 1 5 | 9 2 6 | ...         by one thread, chunk after chunk: of a single thread, the answers
 *     answers   one after the other, in the order of the queries
 */
#include "base/apart.h"
#include "base/floats.h"
#include "query/check.h"
#include "query/groups/relation.h"
#include "query/packed/packed.h"
#include "query/packed/space.h"
#include "query/point/areas.h"
#include "query/workers.h"
#include "support/fail.h"
#include <string.h>

enum { QUERIES_PER_CHUNK = 256 };
enum { EXPECT_FROM = 7, EXPECT_MOST = 1 << 24 }; /* queries; ids for which room is made beforehand */
enum { ID_ROOM = 1, VALUE_ROOM, ROOMS = 2 };     /* behind the starts of answers: how many ids and values have room */

/* What one thread finds. */
typedef struct batch_found {
    query_ids ids;
    ARRAY(double) values;
    size_t queries; /* answered */
    base_apart apart;
} batch_found;

typedef struct batch_chunk {
    const batch_found *found; /* of the thread that answered it, */
    size_t first;             /* from here on */
    froe_diagnostic diag;
} batch_chunk;

typedef struct batch batch;
/** Asks question i. Objects found are left in q->found, unless they go to the caller's array. */
typedef froe_status ask_fn(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag);

/** ... about a point whose leaf is known. */
typedef froe_status ask_in_fn(const batch *b, froe_query *q, size_t i, const query_leaf *leaf, froe_diagnostic *diag);

/** The number beside answer i of the last question. */
typedef double value_fn(const froe_query *q, size_t i);

struct batch {
    froe_query *query;
    query_workers workers;
    ask_fn *ask;
    ask_in_fn *ask_in; /* instead: leaves of many points are found at once */
    const query_areas *areas;
    query_relating relating, questions; /* of a tree and of the one whose groups are questions */
    const froe_query *asking;           /* a context of the latter */
    const froe_range *ranges;           /* or ... */
    const double *boxes;                /* or ... */
    const double *points, *directions;
    double limit; /* t_max; bound */
    size_t k;
    int direction;
    froe_hit *hits;    /* the caller's */
    uint32_t *objects; /* the caller's */
    uint64_t *counts;  /* the caller's */
    value_fn *value;   /* NULL: answers are ids alone */
    size_t count, chunk_count;
    batch_chunk *chunks;
    batch_found *found; /* [thread] */
    batch_found all;    /* gathered */
    size_t *starts;     /* of answers; from 1 on how many each query has, until they are summed up. NULL: none */
};

void froe_answers_free(froe_answers *answers) {
    if (!answers || !answers->starts) return;
    const size_t *end = answers->starts + answers->queries;
    support_free(&answers->alloc, answers->ids, end[ID_ROOM] * sizeof *answers->ids);
    support_free(&answers->alloc, answers->values, end[VALUE_ROOM] * sizeof *answers->values);
    support_free(&answers->alloc, answers->starts, (answers->queries + 1 + ROOMS) * sizeof *answers->starts);
    *answers = (froe_answers){0};
}

/* ----------------------------------------------------------------- asking -- */

static const double *point_of(const batch *b, const double *points, size_t i) {
    return points + i * (size_t)b->query->tree->scene->dim;
}

static froe_range range_of(const batch *b, size_t i) {
    if (b->ranges) return b->ranges[i];
    froe_range box = froe_range_defaults();
    box.points = b->boxes + 2 * i * (size_t)b->query->tree->scene->dim;
    return box;
}

static froe_status ask_range(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    const froe_range range = range_of(b, i);
    return query_range_ask(q, &range, false, diag);
}

static froe_status ask_count(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_count(q, b->ranges + i, b->counts + i, diag);
}

static froe_status ask_any(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_any(q, b->ranges + i, b->objects + i, diag);
}

static froe_status ask_locate(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return query_locate(q, point_of(b, b->points, i), diag);
}

static froe_status ask_locate_in(const batch *b, froe_query *q, size_t i, const query_leaf *leaf,
                                 froe_diagnostic *diag) {
    return query_locate_in(q, point_of(b, b->points, i), leaf, diag);
}

static froe_status ask_vertical(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_vertical(q, point_of(b, b->points, i), b->direction, b->objects + i, diag);
}

static froe_status ask_ray(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_ray(q, point_of(b, b->points, i), point_of(b, b->directions, i), b->limit, b->hits + i, diag);
}

static froe_status ask_ray_any(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    return froe_query_ray_any(q, point_of(b, b->points, i), point_of(b, b->directions, i), b->limit, b->objects + i,
                              diag);
}

/* Empties q->found, and makes room in it for answers that are stored elsewhere. */
static froe_status clear_found(froe_query *q, size_t count, froe_diagnostic *diag) {
    q->found.count = 0;
    return array_reserve(&q->alloc, &q->found, count) ? FROE_OK : support_fail_memory(diag);
}

static froe_status ask_groups_in(const batch *b, froe_query *q, size_t i, const query_leaf *leaf,
                                 froe_diagnostic *diag) {
    froe_status status = query_groups_in(q, b->areas, point_of(b, b->points, i), leaf, diag);
    const query_members *groups = &q->groups.inside;
    if (!status) status = clear_found(q, groups->count, diag);
    for (size_t n = 0; !status && n < groups->count; n++) query_found(q, groups->data[n]);
    return status;
}

/* Without borders no leaf is searched for. */
static froe_status ask_groups(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    const double *x = point_of(b, b->points, i);
    const froe_status status = query_check_point(x, q->tree->scene->dim, "a point", diag);
    return status ? status : ask_groups_in(b, q, i, NULL, diag);
}

/* The groups of a relation become what is found. */
static froe_status take_groups(froe_query *q, froe_status status, froe_diagnostic *diag) {
    const query_members *groups = &q->work.groups;
    if (!status) status = clear_found(q, groups->count, diag);
    for (size_t n = 0; !status && n < groups->count; n++) query_found(q, groups->data[n]);
    return status;
}

static froe_status ask_groups_range(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    const froe_range range = range_of(b, i);
    return take_groups(q, query_relate_range(q, &b->relating, &range, diag), diag);
}

/* The first question of a thread gives it a context of the other tree. */
static froe_status ask_groups_join(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    const froe_status status = q->work.questions ? FROE_OK : froe_query_fork(b->asking, &q->work.questions, diag);
    if (status) return status;
    return take_groups(q, query_relate_group(q, &b->relating, &b->questions, (uint32_t)i, diag), diag);
}

static froe_status ask_ray_all(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    froe_hits met = {0};
    froe_status status =
        froe_query_ray_all(q, point_of(b, b->points, i), point_of(b, b->directions, i), b->limit, &met, diag);
    if (!status) status = clear_found(q, met.count, diag);
    for (size_t n = 0; !status && n < met.count; n++) query_found(q, met.hits[n].object);
    return status;
}

static double parameter_of(const froe_query *q, size_t i) {
    return q->ray.hits.data[q->ray.met.count + i].t;
}

static froe_status ask_near(const batch *b, froe_query *q, size_t i, froe_diagnostic *diag) {
    froe_neighbours near = {0};
    froe_status status = froe_query_near(q, point_of(b, b->points, i), b->k, b->limit, &near, diag);
    if (!status) status = clear_found(q, near.count, diag);
    for (size_t n = 0; !status && n < near.count; n++) query_found(q, near.items[n].object);
    return status;
}

static double distance_of(const froe_query *q, size_t i) {
    return q->near.out.data[i].distance;
}

/* Names the first bad question of a chunk, before any is answered. */
static froe_status check_all(const batch *b, froe_query *q, size_t first, size_t end, froe_diagnostic *diag) {
    const int dim = q->tree->scene->dim;
    for (size_t i = first; i < end; i++) {
        const double *x = point_of(b, b->points, i);
        const froe_status status = b->ask == ask_vertical ? query_vertical_check(q, x, b->direction, diag)
                                   : b->ask == ask_near   ? query_near_check(q, x, b->limit, diag)
                                   : b->directions
                                       ? query_ray_check(dim, x, point_of(b, b->directions, i), b->limit, diag)
                                       : query_check_point(x, dim, "a point", diag);
        if (status) diag->object = (uint32_t)i;
        if (status) return status;
    }
    return FROE_OK;
}

/* Makes room for what the thread will find, if its further queries find as much as those before. An array that grows
 * bit by bit is copied again and again, all of its room each time. Few queries say little of many. */
static void expect_as_much(const batch *b, const froe_query *q, batch_found *found) {
    const size_t share = b->count / b->workers.count, left = share > found->queries ? share - found->queries : 0;
    const double ids = (double)found->ids.count, queries = (double)found->queries;
    if (!found->queries || !b->starts || (found->queries < EXPECT_FROM && left > 2 * EXPECT_FROM)) return;
    const double wanted = 1.125 * ids / queries * (double)left, most = ids > EXPECT_MOST ? ids : EXPECT_MOST;
    const size_t more = (size_t)(wanted < most ? wanted : most);
    (void)array_reserve(&q->alloc, &found->ids, more); /* without memory now, there may be enough later */
    if (b->value) (void)array_reserve(&q->alloc, &found->values, more);
}

/* Are all ranges windows on a packed tree? They are answered all at once, too. The dimension; 0: they are not. */
static int are_windows(const batch *b, const froe_query *q, size_t first, size_t end, const double **windows) {
    const froe_range one = range_of(b, first);
    int dim = query_range_window(q, &one);
    for (size_t i = first; i < end && dim; i++) {
        if (b->ranges) dim = query_range_window(q, b->ranges + i);
        windows[i - first] = b->ranges ? b->ranges[i].points : b->boxes + 2 * i * (size_t)dim;
    }
    return dim;
}

/* Is a box certainly a good range? */
static bool is_plain(const double *box, int dim) {
    bool good = true;
    for (int k = 0; k < dim; k++) good &= box[k] <= box[dim + k] && fabs(box[k]) < INFINITY && box[dim + k] < INFINITY;
    return good;
}

/* What the context finds goes to the thread's answers. */
static froe_status answer_windows(const batch *b, froe_query *q, size_t first, size_t end, const double *const *windows,
                                  int dim, batch_found *found, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    for (size_t i = first; i < end && !status; i++) {
        if (b->boxes && is_plain(windows[i - first], dim)) continue;
        const froe_range range = range_of(b, i);
        status = query_range_check(&range, dim, diag);
        if (status) diag->object = (uint32_t)i;
    }
    for (size_t count; first < end && !status; first += count, windows += count) {
        count = found->queries < end - first ? found->queries + 1 : end - first; /* one, two, four ... */
        expect_as_much(b, q, found);
        const query_ids own = q->found;
        q->found = found->ids;
        size_t *counts = b->starts + first + 1;
        if (dim == 2 ? packed_ranges(q, windows, count, counts) : space_ranges(q, windows, count, false, counts))
            status = query_failed(q, diag);
        found->ids = q->found;
        q->found = own;
        q->found.count = 0;
        found->queries += count;
    }
    return status;
}

/* What is nearest to the points, which have been checked, by blocks. */
static froe_status answer_near(const batch *b, froe_query *q, size_t first, size_t end, batch_found *found,
                               froe_diagnostic *diag) {
    expect_as_much(b, q, found);
    for (size_t at = first, count; at < end; at += count) {
        count = end - at < QUERY_NEAR_FLOCK ? end - at : QUERY_NEAR_FLOCK;
        if (query_near_flock(q, b->points + 2 * at, count, end - at, b->k, b->limit)) return query_failed(q, diag);
        for (size_t i = at; i < at + count; i++) {
            if (query_near_settle(q, b->points + 2 * i, i - at, b->k, b->limit)) return support_fail_memory(diag);
            const size_t near = b->starts[i + 1] = q->near.out.count;
            if (!array_reserve(&q->alloc, &found->ids, near) || !array_reserve(&q->alloc, &found->values, near))
                return support_fail_memory(diag);
            for (size_t n = 0; n < near; n++) {
                found->ids.data[found->ids.count++] = q->near.out.data[n].object;
                found->values.data[found->values.count++] = q->near.out.data[n].distance;
            }
            found->queries++;
        }
    }
    return FROE_OK;
}

static froe_status answer_one_by_one(const batch *b, froe_query *q, size_t first, size_t end, batch_found *found,
                                     froe_diagnostic *diag) {
    query_leaf leaves[QUERIES_PER_CHUNK];
    /* The leaves of all points are found together, so that their cache misses overlap. */
    if (b->ask_in && query_leaf_find_all(q, point_of(b, b->points, first), end - first, leaves))
        return support_fail_memory(diag);
    expect_as_much(b, q, found);
    if (b->ask_in && b->areas) query_areas_ask(b->areas, leaves, end - first);
    for (size_t i = first; i < end; i++) {
        froe_status status = b->ask_in ? b->ask_in(b, q, i, leaves + (i - first), diag) : b->ask(b, q, i, diag);
        const size_t count = q->found.count;
        if (!status && b->starts) {
            if (!array_append(&q->alloc, &found->ids, q->found.data, count) ||
                (b->value && !array_reserve(&q->alloc, &found->values, count)))
                status = support_fail_memory(diag);
            for (size_t k = 0; !status && b->value && k < count; k++)
                found->values.data[found->values.count++] = b->value(q, k);
            b->starts[i + 1] = count;
        }
        if (status) diag->object = (uint32_t)i;
        if (status) return status;
        found->queries++;
    }
    return FROE_OK;
}

static froe_status answer_chunk(void *user, unsigned worker, size_t job) {
    const batch *b = user;
    froe_query *q = b->workers.queries[worker];
    batch_chunk *c = b->chunks + job;
    batch_found *found = b->found + worker;
    const size_t first = job * QUERIES_PER_CHUNK, left = b->count - first;
    const size_t end = first + (left < QUERIES_PER_CHUNK ? left : QUERIES_PER_CHUNK);
    const double *points = b->points ? point_of(b, b->points, first) : NULL, *windows[QUERIES_PER_CHUNK];
    c->found = found;
    c->first = found->ids.count;
    /* On a packed tree rays are answered all at once: one computes while others wait for memory. */
    const bool upright = b->ask == ask_vertical && q->packed;
    const bool in_space = (b->ask == ask_ray || b->ask == ask_ray_any) && q->space && q->tree->packed.wide;
    bool near = false;
    froe_status status = b->ask == ask_near ? query_near_by_blocks(q, b->k, &near, &c->diag) : FROE_OK;
    if (!status) status = upright || near || in_space || b->ask_in ? check_all(b, q, first, end, &c->diag) : FROE_OK;
    if (status) return status;
    if (in_space)
        return space_rays(q, points, point_of(b, b->directions, first), end - first, b->limit,
                          b->hits ? b->hits + first : NULL, b->objects ? b->objects + first : NULL, &c->diag);
    if (upright) status = packed_vertical(q, points, end - first, b->direction, b->objects + first);
    if (upright) return status ? query_failed(q, &c->diag) : FROE_OK;
    const int dim = b->ask == ask_range ? are_windows(b, q, first, end, windows) : 0;
    if (dim) return answer_windows(b, q, first, end, windows, dim, found, &c->diag);
    if (near) return answer_near(b, q, first, end, found, &c->diag);
    return answer_one_by_one(b, q, first, end, found, &c->diag);
}

/* --------------------------------------------------------------- gathering -- */

/* Room for all answers, and for one where there are none. Where a quarter or more is not used, that is given back. Less
 * stays: malloc() hands out the pages of an array again, once they are free, for the next one that is no larger. */
static bool settle_room(const batch *b, batch_found *all, size_t total) {
    const froe_allocator *alloc = &b->query->alloc;
    const size_t room = total ? total : 1;
    if (!all->ids.capacity && !array_reserve(alloc, &all->ids, room)) return false;
    if (b->value && !all->values.capacity && !array_reserve(alloc, &all->values, room)) return false;
    if (all->ids.capacity - total >= all->ids.capacity / 4) array_shrink(alloc, &all->ids);
    if (all->values.capacity - total >= all->values.capacity / 4) array_shrink(alloc, &all->values);
    return true;
}

/* Copies what one chunk has found to where it belongs. */
static froe_status gather_chunk(void *user, unsigned worker, size_t job) {
    const batch *b = user;
    const batch_chunk *c = b->chunks + job;
    const size_t first = job * QUERIES_PER_CHUNK, left = b->count - first, at = b->starts[first];
    const size_t count = b->starts[first + (left < QUERIES_PER_CHUNK ? left : QUERIES_PER_CHUNK)] - at;
    (void)worker;
    if (count) memcpy(b->all.ids.data + at, c->found->ids.data + c->first, count * sizeof(uint32_t));
    if (count && b->value) memcpy(b->all.values.data + at, c->found->values.data + c->first, count * sizeof(double));
    return FROE_OK;
}

static void free_found(batch_found *found, const froe_allocator *alloc) {
    array_free(alloc, &found->ids);
    array_free(alloc, &found->values);
}

/* The thread that found all, or NULL. */
static batch_found *only_finder(const batch *b, size_t total) {
    for (unsigned i = 0; i < b->workers.count; i++)
        if (b->found[i].ids.count == total) return b->found + i;
    return NULL;
}

/* Answers of one thread are handed over with the array that they were found in: a copy would be a tenth of the time of
 * large ones. */
static froe_status gather_answers(batch *b, froe_answers *out) {
    for (size_t i = 0; i < b->count; i++) b->starts[i + 1] += b->starts[i];
    const size_t total = b->starts[b->count];
    batch_found *one = only_finder(b, total), *all = one ? one : &b->all;
    if (!settle_room(b, all, total)) return FROE_E_MEMORY;
    const froe_status status = one ? FROE_OK : base_run(&b->workers.task, 0, b->chunk_count, gather_chunk, b);
    if (status) return status;
    b->starts[b->count + ID_ROOM] = all->ids.capacity;
    b->starts[b->count + VALUE_ROOM] = all->values.capacity;
    *out = (froe_answers){b->starts, all->ids.data, all->values.data, b->count, b->query->alloc};
    *all = (batch_found){0};
    b->starts = NULL;
    return FROE_OK;
}

/* ----------------------------------------------------------------- running -- */

/* The first query that failed says why. */
static void explain_failure(const batch *b, froe_status status, froe_diagnostic *diag) {
    size_t i = 0;
    while (i < b->chunk_count && b->chunks[i].diag.status != status) i++;
    if (i == b->chunk_count)
        status == FROE_E_CANCELLED ? support_fail_cancelled(diag) : support_fail_memory(diag);
    else if (diag)
        *diag = b->chunks[i].diag;
}

static froe_status ask_all(batch *b, const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    const froe_allocator *alloc = &b->query->alloc;
    froe_status status = query_workers_take(b->query, options, b->chunk_count, &b->workers, diag);
    if (status) return status;
    b->found = support_calloc(alloc, b->workers.count, sizeof *b->found);
    b->chunks = support_calloc(alloc, b->chunk_count, sizeof *b->chunks);
    if (out) b->starts = support_calloc(alloc, b->count + 1 + ROOMS, sizeof *b->starts);
    if (!b->found || !b->chunks || (out && !b->starts)) return support_fail_memory(diag);
    status = base_run(&b->workers.task, 1, b->chunk_count, answer_chunk, b);
    if (!status && out) status = gather_answers(b, out);
    if (status) explain_failure(b, status, diag);
    return status;
}

static froe_status run_batch(batch *b, const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    const froe_allocator *alloc = &b->query->alloc;
    /* one way: so many questions take 64 GB */
    if (b->count > UINT32_MAX - 1) return support_fail(diag, FROE_E_LIMIT, "A batch has at most 2^32 - 2 queries.");
    b->chunk_count = (b->count + QUERIES_PER_CHUNK - 1) / QUERIES_PER_CHUNK;
    const froe_status status = ask_all(b, options, out, diag);
    for (unsigned i = 0; b->found && i < b->workers.count; i++) free_found(b->found + i, alloc);
    free_found(&b->all, alloc);
    support_free(alloc, b->found, b->workers.count * sizeof *b->found);
    support_free(alloc, b->chunks, b->chunk_count * sizeof *b->chunks);
    support_free(alloc, b->starts, (b->count + 1 + ROOMS) * sizeof *b->starts);
    for (unsigned i = 0; b->asking && i < b->workers.count; i++) {
        query_groups_work *work = &b->workers.queries[i]->work;
        froe_query_free(work->questions);
        work->questions = NULL;
    }
    query_workers_give(&b->workers);
    return status;
}

froe_status froe_batch_range(froe_query *query, const froe_range *ranges, size_t count,
                             const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out || (count && !ranges)) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_range, .ranges = ranges, .count = count};
    return run_batch(&b, options, out, diag);
}

froe_status froe_batch_boxes(froe_query *query, const double *boxes, size_t count, const froe_batch_options *options,
                             froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out || (count && !boxes)) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_range, .boxes = boxes, .count = count};
    return run_batch(&b, options, out, diag);
}

froe_status froe_batch_count(froe_query *query, const froe_range *ranges, size_t count,
                             const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || (count && (!ranges || !counts))) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_count, .ranges = ranges, .count = count, .counts = counts};
    return run_batch(&b, options, NULL, diag);
}

froe_status froe_batch_any(froe_query *query, const froe_range *ranges, size_t count, const froe_batch_options *options,
                           uint32_t *objects, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || (count && (!ranges || !objects))) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_any, .ranges = ranges, .count = count, .objects = objects};
    return run_batch(&b, options, NULL, diag);
}

froe_status froe_batch_locate(froe_query *query, const double *points, size_t count, const froe_batch_options *options,
                              froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out || (count && !points)) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_locate, .points = points, .count = count};
    if (!tree_is_packed(query->tree)) b.ask_in = ask_locate_in;
    return run_batch(&b, options, out, diag);
}

froe_status froe_batch_groups(froe_query *query, const double *points, size_t count, const froe_batch_options *options,
                              froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out || (count && !points)) return support_fail_null(diag, __func__);
    batch b = {.query = query, .points = points, .count = count};
    const froe_status status = count ? query_groups_prepare(query, &b.areas, diag) : FROE_OK; /* for all threads */
    if (status) return status;
    if (count && b.areas->borders)
        b.ask_in = ask_groups_in;
    else
        b.ask = ask_groups;
    return run_batch(&b, options, out, diag);
}

/* Groups related to ranges or boxes. */
static froe_status run_relation(froe_query *query, batch *b, froe_relation relation, const froe_batch_options *options,
                                froe_answers *out, froe_diagnostic *diag) {
    if (!query || !out || (b->count && !b->ranges && !b->boxes)) return support_fail_null(diag, "a batch of relations");
    b->query = query;
    b->ask = ask_groups_range;
    const froe_status status = b->count ? query_relating_begin(query, relation, &b->relating, diag) : FROE_OK;
    return status ? status : run_batch(b, options, out, diag);
}

froe_status froe_batch_groups_range(froe_query *query, const froe_range *ranges, size_t count, froe_relation relation,
                                    const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    batch b = {.ranges = ranges, .count = count};
    return run_relation(query, &b, relation, options, out, diag);
}

froe_status froe_batch_groups_boxes(froe_query *query, const double *boxes, size_t count, froe_relation relation,
                                    const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    batch b = {.boxes = boxes, .count = count};
    return run_relation(query, &b, relation, options, out, diag);
}

froe_status froe_batch_groups_join(froe_query *query, const froe_query *questions, froe_relation relation,
                                   const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_query *fork = NULL;
    if (!query || !questions || !out) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_groups_join, .asking = questions};
    b.count = questions->tree->scene->group_count;
    froe_status status = query_relating_begin(query, relation, &b.relating, diag);
    /* What is prepared through a fork is there for all contexts of that tree. */
    if (!status) status = froe_query_fork(questions, &fork, diag);
    if (!status) status = query_relating_begin(fork, relation, &b.questions, diag);
    if (!status) status = query_roster_of(fork, &b.questions.roster, diag);
    if (!status) status = run_batch(&b, options, out, diag);
    froe_query_free(fork);
    return status;
}

froe_status froe_batch_vertical(froe_query *query, const double *points, size_t count, int direction,
                                const froe_batch_options *options, uint32_t *objects, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || (count && (!points || !objects))) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_vertical, .points = points, .count = count};
    b.direction = direction;
    b.objects = objects;
    return run_batch(&b, options, NULL, diag);
}

/* The rays of a call; its answers are `hits`, `objects` or `out`. */
static froe_status run_rays(froe_query *query, const double *origins, const double *directions, size_t count,
                            double t_max, batch *b, const froe_batch_options *options, froe_answers *out,
                            froe_diagnostic *diag) {
    if (!query || (count && (!origins || !directions || (!b->hits && !b->objects && !out))))
        return support_fail_null(diag, "a batch of rays");
    b->query = query;
    b->points = origins;
    b->directions = directions;
    b->count = count;
    b->limit = t_max;
    return run_batch(b, options, out, diag);
}

froe_status froe_batch_ray(froe_query *query, const double *origins, const double *directions, size_t count,
                           double t_max, const froe_batch_options *options, froe_hit *hits, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    batch b = {.ask = ask_ray, .hits = hits};
    return run_rays(query, origins, directions, count, t_max, &b, options, NULL, diag);
}

froe_status froe_batch_ray_any(froe_query *query, const double *origins, const double *directions, size_t count,
                               double t_max, const froe_batch_options *options, uint32_t *objects,
                               froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    batch b = {.ask = ask_ray_any, .objects = objects};
    return run_rays(query, origins, directions, count, t_max, &b, options, NULL, diag);
}

froe_status froe_batch_ray_all(froe_query *query, const double *origins, const double *directions, size_t count,
                               double t_max, const froe_batch_options *options, froe_answers *out,
                               froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    batch b = {.ask = ask_ray_all, .value = parameter_of};
    if (!out) return support_fail_null(diag, __func__);
    return run_rays(query, origins, directions, count, t_max, &b, options, out, diag);
}

froe_status froe_batch_near(froe_query *query, const double *points, size_t count, size_t k, double bound,
                            const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out || (count && !points)) return support_fail_null(diag, __func__);
    batch b = {.query = query, .ask = ask_near, .points = points, .count = count, .k = k, .limit = bound};
    b.value = distance_of;
    return run_batch(&b, options, out, diag);
}
