/* bulk.c: the corners of a large batch become vertices, all at once (match.h).
 *
 *     points of the batch   without `indices` its corners; with them all points there are
 *     entries of match.h    lie where the coordinates of new vertices will be, which take more room
 *     number                points that are the first of those equal become vertices, in the order of corners
 *     link                  the other corners get the vertex of their first, and are compared with it: vertices lie
 *                           closer together than the points of the caller
 *
 * Nothing is published before all is known. Where two points differ that have one hash, all is done once more, with
 * care. Where a coordinate is not finite, an index is wrong or very many points collide, the batch goes the way of
 * small ones, which names what is wrong. */
#include "scene/forms.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

typedef struct bulk_chunk {
    uint32_t before; /**< vertices before its own */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} bulk_chunk;

typedef struct bulk_work {
    scene_adding *adding;
    match_work match;
    match_points points;
    bulk_chunk *chunks;
    uint32_t chunk_count;
    uint32_t *first; /**< of points (match.h); NULL: all differ. Without indices it becomes the ids */
    uint32_t *ids;   /**< of corners; NULL: in order */
} bulk_work;

/* ------------------------------------------------------------------- number -- */

/** Copies the points of which `first` tells that they are the first, or all if it is NULL; widens lo and hi. */
static inline __attribute__((always_inline)) void copy_in(const double *x, uint32_t count, int dim, uint32_t *first,
                                                          uint32_t id, double *coords, double *lo, double *hi) {
    double low[FROE_MAX_DIM], high[FROE_MAX_DIM], *to = coords + (size_t)id * (size_t)dim;
    for (int k = 0; k < dim; k++) low[k] = lo[k], high[k] = hi[k];
    for (uint32_t i = 0; i < count; i++, x += dim) {
        if (first && first[i] & MATCH_EQUAL) continue;
        for (int k = 0; k < dim; k++) {
            const double y = x[k] + 0.0; /* no -0 */
            low[k] = y < low[k] ? y : low[k];
            high[k] = y > high[k] ? y : high[k];
            to[k] = y;
        }
        to += dim;
        if (first) first[i] = id++;
    }
    for (int k = 0; k < dim; k++) lo[k] = low[k], hi[k] = high[k];
}

static void copy_points(const double *x, uint32_t count, int dim, uint32_t *first, uint32_t id, double *coords,
                        double *lo, double *hi) {
    if (dim == 2) /* loops of known length */
        copy_in(x, count, 2, first, id, coords, lo, hi);
    else if (dim == 3)
        copy_in(x, count, 3, first, id, coords, lo, hi);
    else
        copy_in(x, count, dim, first, id, coords, lo, hi);
}

static froe_status number_points(void *user, unsigned worker, size_t job) {
    (void)worker;
    bulk_work *w = user;
    const froe_scene *s = w->adding->scene;
    bulk_chunk *chunk = w->chunks + job;
    const uint32_t id = chunk->before;
    uint32_t from, to;
    match_fresh_chunk(&w->match, (uint32_t)job, &from, &to);
    copy_points(w->points.fresh + (size_t)from * (size_t)s->dim, to - from, s->dim, w->first ? w->first + from : NULL,
                id, s->store->coords.data, chunk->lo, chunk->hi);
    for (uint32_t i = from; w->ids && !w->first && i < to; i++) w->ids[i] = id + i - from;
    return FROE_OK;
}

/** False: a corner differs from the vertex it was given. */
static inline __attribute__((always_inline)) bool link_in(const bulk_work *w, uint32_t from, uint32_t to, int dim) {
    const uint32_t known = w->points.known_count;
    const double *coords = w->adding->scene->store->coords.data, *x = w->points.fresh;
    uint32_t *first = w->first;
    bool same = true;
    for (uint32_t i = from; i < to; i++) {
        if (!(first[i] & MATCH_EQUAL)) continue;
        const uint32_t other = first[i] & ~MATCH_EQUAL, id = other < known ? other : first[other - known];
        same &= match_same_point(x + (size_t)i * (size_t)dim, coords + (size_t)id * (size_t)dim, dim);
        first[i] = id;
    }
    return same;
}

/** The other corners: their firsts have their vertices by now, which do not change any more. */
static froe_status link_points(void *user, unsigned worker, size_t job) {
    (void)worker;
    bulk_work *w = user;
    const int dim = w->points.dim;
    uint32_t from, to;
    match_fresh_chunk(&w->match, (uint32_t)job, &from, &to);
    const bool same = dim == 2   ? link_in(w, from, to, 2)
                      : dim == 3 ? link_in(w, from, to, 3)
                                 : link_in(w, from, to, dim);
    if (!same) atomic_store(&w->match.mistaken, true);
    return FROE_OK;
}

/** Corners are points. */
static froe_status take_points(bulk_work *w) {
    scene_adding *a = w->adding;
    uint32_t id = w->points.known_count;
    for (uint32_t c = 0; c < w->chunk_count; c++) {
        bulk_chunk *chunk = w->chunks + c;
        uint32_t from, to;
        match_fresh_chunk(&w->match, c, &from, &to);
        chunk->before = id;
        for (int k = 0; k < FROE_MAX_DIM; k++) chunk->lo[k] = INFINITY, chunk->hi[k] = -INFINITY;
        id += w->first ? match_fresh_firsts(&w->match, c) : to - from;
    }
    a->vertices = id;
    froe_status status = base_run(&a->task, 0.1, w->chunk_count, number_points, w);
    if (!status && w->first) status = base_run(&a->task, 0.05, w->chunk_count, link_points, w);
    for (uint32_t c = 0; c < w->chunk_count; c++)
        for (int k = 0; k < FROE_MAX_DIM; k++) {
            a->lo[k] = fmin(a->lo[k], w->chunks[c].lo[k]);
            a->hi[k] = fmax(a->hi[k], w->chunks[c].hi[k]);
        }
    return status;
}

/* ------------------------------------------------------------------ indices -- */

/** Corners name points, which become vertices in the order of corners. *done false: there is no such point. */
static froe_status take_indices(bulk_work *w, bool *done) {
    scene_adding *a = w->adding;
    const froe_scene *s = a->scene;
    const match_points *p = &w->points;
    const uint32_t *indices = a->batch->indices + a->first, known = p->known_count;
    const size_t bytes = p->fresh_count * sizeof(uint32_t);
    uint32_t *vertex = support_realloc(&s->alloc, NULL, 0, bytes);
    if (!vertex) return FROE_E_MEMORY;
    memset(vertex, 0xff, bytes); /* FROE_NONE */
    a->vertices = known;
    *done = true;
    for (size_t c = 0; c < a->corners; c++) {
        const uint32_t point = indices[c];
        *done = point < p->fresh_count;
        if (!*done) break;
        const uint32_t same = w->first ? w->first[point] & ~MATCH_EQUAL : known + point;
        if (same >= known && vertex[same - known] == FROE_NONE) {
            copy_points(p->fresh + (size_t)point * (size_t)p->dim, 1, p->dim, NULL, a->vertices, s->store->coords.data,
                        a->lo, a->hi);
            vertex[same - known] = a->vertices++;
        }
        w->ids[c] = same < known ? same : vertex[same - known];
    }
    support_free(&s->alloc, vertex, bytes);
    return FROE_OK;
}

/* -------------------------------------------------------------------- whole -- */

/** Vertices that are there are dealt with the points; all these entries have to fit where coordinates will be. */
static bool is_large(const scene_adding *a, size_t points) {
    const struct scene_store *store = a->scene->store;
    return points >= store->plan.least && points <= 2 * a->corners &&
           points <= SCENE_LIMIT - store->vertex_count && /* one way: so many vertices take 32 GB */
           store->vertex_count <= (size_t)(a->scene->dim - 1) * points;
}

/** Do corners and vertices go on having the same numbers? REQUIRES: all points differ. */
static bool is_in_order(const bulk_work *w) {
    const struct scene_store *store = w->adding->scene->store;
    return !w->adding->batch->indices && !store->vertex_of.count; /* then each vertex is its own corner */
}

/** Room for ids and for what is known of points and chunks, once it is known whether any points are equal. */
static bool take_room(bulk_work *w) {
    scene_adding *a = w->adding;
    const froe_allocator *alloc = &a->scene->alloc;
    const bool indices = a->batch->indices;
    a->in_order = !w->match.equals && is_in_order(w);
    if (!a->in_order && !scene_adding_room(a)) return false;
    if (!a->in_order) w->ids = scene_adding_ids(a);
    w->chunk_count = match_fresh_chunks(&w->match);
    w->chunks = support_calloc(alloc, w->chunk_count, sizeof *w->chunks);
    if (!w->match.equals) return w->chunks;
    w->first = indices ? support_realloc(alloc, NULL, 0, w->points.fresh_count * sizeof *w->first) : w->ids;
    return w->chunks && w->first;
}

static void give_room_back(bulk_work *w) {
    const froe_allocator *alloc = &w->adding->scene->alloc;
    if (w->first != w->ids) support_free(alloc, w->first, w->points.fresh_count * sizeof *w->first);
    support_free(alloc, w->chunks, w->chunk_count * sizeof *w->chunks);
}

/** Points with one tag have turned out to differ. */
static void forget_first(bulk_work *w) {
    scene_adding *a = w->adding;
    if (w->first != w->ids) support_free(&a->scene->alloc, w->first, w->points.fresh_count * sizeof *w->first);
    w->first = NULL;
    a->in_order = is_in_order(w);
    if (!a->in_order) return;
    w->ids = NULL;
    array_free(&a->scene->alloc, &a->scene->store->vertex_of);
}

static froe_status take_corners(bulk_work *w, bool careful, bool *done) {
    scene_adding *a = w->adding;
    struct scene_store *store = a->scene->store;
    uint32_t firsts = 0;
    froe_status status = match_begin(&w->match, &w->points, &store->plan, &a->task, &a->scene->alloc,
                                     (uint64_t *)(void *)(store->coords.data + store->coords.count));
    if (!status && !atomic_load(&w->match.lost)) {
        if (!take_room(w)) status = FROE_E_MEMORY;
        if (!status && w->match.equals) status = match_spread(&w->match, careful, w->first, &firsts);
        *done = !atomic_load(&w->match.lost) && !atomic_load(&w->match.mistaken);
        if (w->match.equals && firsts == w->points.fresh_count) forget_first(w);
        if (!status && *done) status = a->batch->indices ? take_indices(w, done) : take_points(w);
        give_room_back(w);
    }
    match_end(&w->match);
    if (atomic_load(&w->match.mistaken)) *done = false;
    return status;
}

froe_status scene_take_corners_at_once(scene_adding *a, bool *done) {
    const froe_objects *b = a->batch;
    froe_scene *s = a->scene;
    struct scene_store *store = s->store;
    const size_t points = b->indices ? b->point_count : a->corners, dim = (size_t)s->dim;
    *done = false;
    if (!is_large(a, points)) return FROE_OK;
    if (!array_reserve(&s->alloc, &store->coords, points * dim)) return support_fail_memory(a->diag);
    bulk_work w = {.adding = a};
    w.points = (match_points){.known = store->coords.data, .known_count = store->vertex_count, .dim = s->dim};
    w.points.fresh = b->indices ? b->coords : b->coords + a->first * dim;
    w.points.fresh_count = (uint32_t)points;
    bool careful = b->indices || points >= store->plan.careful;
    froe_status status = take_corners(&w, careful, done);
    if (!status && !careful && atomic_load(&w.match.mistaken)) status = take_corners(&w, true, done);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(a->diag);
    if (status) return support_fail_memory(a->diag);
    if (!*done) return FROE_OK;
    scene_table_free(&s->alloc, &store->table); /* it does not know the new vertices */
    store->coords.count = a->vertices * dim;
    array_shrink(&s->alloc, &store->coords);
    return FROE_OK;
}
