/* pairs.c: which objects meet, and how?
 *
 * Objects that touch across a cut need not share a list, so each object in turn is a closed range of a search,
 * which misses nothing (range_walk.c); of two that meet, the search of the lower id finds the other. How they meet is
 * then decided exactly (geom/meet/contact.h).
 *
 *     objects    0 .. 63 | 64 .. 127 | ...    jobs, a wave of them at a time, reported in order once all are done */
#include "base/apart.h"
#include "base/floats.h"
#include "geom/meet/contact.h"
#include "query/heap.h"
#include "query/packed/packed.h"
#include "query/workers.h"
#include "support/array.h"
#include "support/fail.h"
#include <string.h>

enum { OBJECTS_PER_JOB = 64, JOBS_PER_WAVE = 32 };

/* What a thread needs beside its context. */
typedef struct pair_worker {
    froe_query *q;
    ARRAY(double) points;     /* of the object as a range */
    ARRAY(signed char) sides; /* for geom_contact_of() */
    base_apart apart;
} pair_worker;

typedef ARRAY(froe_pair) object_pairs;

typedef struct pair_search {
    query_workers *workers;
    bool shared;
    pair_worker *of_worker; /* [thread] */
    object_pairs *chunks;   /* of a wave */
    uint32_t first;         /* object of the wave */
} pair_search;

/* An object as a range; above dimension 3 a polytope as its bounding box. False without memory. */
static bool take_object(pair_worker *d, uint32_t object, const geom_body *b, froe_range *range) {
    const size_t dim = (size_t)b->dim, count = b->form == FROE_POINT || b->count < 2 ? 2 : b->count;
    d->points.count = 0;
    if (!array_reserve(&d->q->alloc, &d->points, count * dim)) return false;
    *range = froe_range_defaults();
    range->points = d->points.data;
    range->count = b->count;
    range->radius = b->radius;
    range->shape = b->form == FROE_BALL                              ? FROE_SHAPE_BALL
                   : b->form == FROE_SEGMENT                         ? FROE_SHAPE_SEGMENT
                   : b->form == FROE_HULL || b->form == FROE_POLYGON ? FROE_SHAPE_HULL
                                                                     : FROE_SHAPE_BOX;
    if (b->form == FROE_HULL && dim > 3) {
        range->shape = FROE_SHAPE_BOX;
        scene_object_bounds(d->q->tree->scene, object, d->points.data, d->points.data + dim);
        return true;
    }
    for (uint32_t i = 0; i < (b->form == FROE_POINT ? 2 : b->count); i++)
        memcpy(d->points.data + i * dim, geom_body_point(b, b->form == FROE_POINT ? 0 : i), dim * sizeof(double));
    return true;
}

static bool greater(void *user, uint32_t a, uint32_t b) {
    (void)user;
    return a > b;
}

/* Finds the pairs of some objects with later ones. */
static froe_status find_partners(void *user, unsigned worker, size_t job) {
    static const froe_meeting kinds[GEOM_CONTACTS] = {
        [GEOM_CROSS] = FROE_MEET_CROSS, [GEOM_TOUCH] = FROE_MEET_TOUCH, [GEOM_OVERLAP] = FROE_MEET_OVERLAP};
    pair_search *s = user;
    pair_worker *d = s->of_worker + worker;
    object_pairs *out = s->chunks + job;
    froe_query *q = d->q;
    const froe_scene *scene = q->tree->scene;
    const uint32_t first = s->first + (uint32_t)job * OBJECTS_PER_JOB, left = scene->object_count - first;
    out->count = 0;
    for (uint32_t i = first; i < first + (left < OBJECTS_PER_JOB ? left : OBJECTS_PER_JOB); i++) {
        const geom_body body = scene_body(scene, i);
        froe_range range;
        if (!take_object(d, i, &body, &range)) return FROE_E_MEMORY;
        const froe_status status = query_range_ask(q, &range, false, NULL);
        if (status) return status;
        /* Keeps what was found with an id above that of the object, in order. */
        size_t kept = 0;
        for (size_t n = 0; n < q->found.count; n++)
            if (q->found.data[n] > i) q->found.data[kept++] = q->found.data[n];
        q->found.count = kept;
        query_heap_sort(q->found.data, kept, greater, NULL);
        for (size_t n = 0; n < kept; n++) {
            const geom_body other = scene_body(scene, q->found.data[n]);
            d->sides.count = 0;
            if (!array_reserve(&q->alloc, &d->sides, (size_t)body.count + other.count)) return FROE_E_MEMORY;
            const geom_contact c = geom_contact_of(&q->numbers, &body, &other, d->sides.data);
            if (c.kind == GEOM_APART) continue; /* its box is met, and no more */
            if (!s->shared && c.kind == GEOM_TOUCH && c.touch == GEOM_TOUCH_AT_CORNER) continue;
            if (!array_push(&q->alloc, out, (froe_pair){i, q->found.data[n], kinds[c.kind]})) return FROE_E_MEMORY;
        }
    }
    return FROE_OK;
}

/* Searches object by object. All threads search a wave; then its pairs are reported in order, and the next wave
 * begins. */
static froe_status search_objects(query_workers *workers, bool shared, froe_pair_fn *fn, void *user) {
    const froe_query *query = workers->queries[0];
    const froe_allocator *alloc = &query->alloc;
    const unsigned threads = workers->count;
    const uint64_t objects = query->tree->scene->object_count, jobs = (objects + OBJECTS_PER_JOB - 1) / OBJECTS_PER_JOB;
    pair_search s = {.workers = workers, .shared = shared};
    const size_t wave = threads > 1 ? (size_t)threads * JOBS_PER_WAVE : 1;
    bool more = true;
    s.of_worker = support_calloc(alloc, threads, sizeof *s.of_worker);
    s.chunks = support_calloc(alloc, wave, sizeof *s.chunks);
    froe_status status = s.of_worker && s.chunks ? FROE_OK : FROE_E_MEMORY;
    for (unsigned i = 0; s.of_worker && i < threads; i++) s.of_worker[i].q = workers->queries[i];
    for (uint64_t done = 0; !status && more && done < jobs; done += wave) {
        const size_t count = jobs - done < wave ? (size_t)(jobs - done) : wave;
        s.first = (uint32_t)done * OBJECTS_PER_JOB;
        status = base_run(&workers->task, (double)count / (double)jobs, count, find_partners, &s);
        for (size_t i = 0; !status && i < count; i++)
            for (size_t n = 0; more && n < s.chunks[i].count; n++) more = base_callback(fn(user, s.chunks[i].data + n));
    }
    for (unsigned i = 0; s.of_worker && i < threads; i++) {
        array_free(alloc, &s.of_worker[i].points);
        array_free(alloc, &s.of_worker[i].sides);
    }
    for (size_t i = 0; s.chunks && i < wave; i++) array_free(alloc, &s.chunks[i]);
    support_free(alloc, s.of_worker, threads * sizeof *s.of_worker);
    support_free(alloc, s.chunks, wave * sizeof *s.chunks);
    return status;
}

froe_status froe_batch_pairs(froe_query *query, bool shared, const froe_batch_options *options, froe_pair_fn *fn,
                             void *fn_user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !fn) return support_fail_null(diag, __func__);
    const size_t jobs = ((size_t)query->tree->scene->object_count + OBJECTS_PER_JOB - 1) / OBJECTS_PER_JOB;
    const uint64_t queries = query->stats.queries;
    query_workers workers = {0};
    froe_status status = tree_settle(query->tree, diag);
    if (!status) status = query_workers_take(query, options, jobs, &workers, diag);
    if (!status) {
        status = query->packed ? packed_pairs(&workers, shared, fn, fn_user) : FROE_E_LIMIT;
        if (status == FROE_E_LIMIT) status = search_objects(&workers, shared, fn, fn_user);
        if (status == FROE_E_CANCELLED) support_fail_cancelled(diag);
        if (status == FROE_E_MEMORY) support_fail_memory(diag);
    }
    query_workers_give(&workers);
    query->stats.queries = queries + 1; /* not one for each object */
    return status;
}

typedef struct pair_array {
    const froe_allocator *alloc;
    ARRAY(froe_pair) pairs;
    bool full; /* there was no memory for more */
} pair_array;

static bool keep_pair(void *user, const froe_pair *pair) {
    BASE_FLOATS_OWN;
    pair_array *a = user;
    a->full = !array_push(a->alloc, &a->pairs, *pair);
    return !a->full;
}

/* Bytes of an array of so many, or one: it is never NULL. */
static size_t room_for(size_t pairs) {
    return (pairs ? pairs : 1) * sizeof(froe_pair);
}

void froe_pairs_free(froe_pairs *pairs) {
    if (!pairs) return;
    support_free(&pairs->alloc, pairs->pairs, pairs->pairs ? room_for(pairs->count) : 0);
    *pairs = (froe_pairs){0};
}

froe_status froe_batch_pair_array(froe_query *query, bool shared, const froe_batch_options *options, froe_pairs *out,
                                  froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out) return support_fail_null(diag, __func__);
    pair_array found = {.alloc = &query->alloc};
    froe_status status = froe_batch_pairs(query, shared, options, keep_pair, &found, diag);
    const size_t room = room_for(found.pairs.count), taken = found.pairs.capacity * sizeof(froe_pair);
    froe_pair *fitted = status || found.full ? NULL : support_realloc(&query->alloc, found.pairs.data, taken, room);
    if (fitted)
        *out = (froe_pairs){fitted, found.pairs.count, query->alloc};
    else
        array_free(&query->alloc, &found.pairs);
    return status || fitted ? status : support_fail_memory(diag);
}

froe_status froe_query_pairs(froe_query *query, bool shared, froe_pair_fn *fn, void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !fn) return support_fail_null(diag, __func__);
    froe_batch_options alone = froe_batch_defaults();
    alone.threads = 1;
    return froe_batch_pairs(query, shared, &alone, fn, user, diag);
}
