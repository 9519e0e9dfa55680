/* near.c: the k nearest objects.
 *
 * The k best so far form a heap with the worst on top, compared exactly. When there are k of them, what is further
 * away than the worst is passed over: places by their bounds, objects by those of their bounding boxes, and the
 * rest by comparing distances, whose images decide but for ties. Of points, and on packed trees of the plane, there are
 * candidates, few more than k, which are sorted. */
#include "query/near/near.h"
#include "base/floats.h"
#include "query/check.h"
#include "query/context.h"
#include "query/heap.h"
#include "query/pieces.h"
#include <string.h>

void query_near_free(query_near *n, const froe_allocator *alloc) {
    array_free(alloc, &n->places);
    array_free(alloc, &n->free);
    array_free(alloc, &n->heap);
    array_free(alloc, &n->best);
    array_free(alloc, &n->candidates);
    array_free(alloc, &n->flock);
    array_free(alloc, &n->found);
    array_free(alloc, &n->order);
    array_free(alloc, &n->out);
}

/* Is a further away than b? Never equal. */
static bool further(void *user, uint32_t a, uint32_t b) {
    froe_query *q = user;
    const query_neighbour *x = q->near.found.data + a, *y = q->near.found.data + b;
    if (x->square > query_near_reach(y->square)) return true;
    if (y->square > query_near_reach(x->square)) return false;
    const int order = geom_distance_compare(&q->numbers, q->near.point, &x->distance, &y->distance);
    return order ? order > 0 : x->object > y->object;
}

/* Takes a neighbour among the k best, in place of the worst if there are k. False: no memory. */
static bool take_neighbour(froe_query *q, const query_neighbour *x, size_t k) {
    query_near *n = &q->near;
    if (n->order.count < k) {
        if (!array_reserve(&q->alloc, &n->found, 2) || !array_reserve(&q->alloc, &n->order, 1)) return false;
        n->found.data[n->found.count] = *x;
        n->order.data[n->order.count++] = (uint32_t)n->found.count++;
        query_heap_rise(n->order.data, n->order.count - 1, further, q);
    } else {
        n->found.data[n->found.count] = *x; /* room was made for one more */
        if (!further(q, n->order.data[0], (uint32_t)n->found.count)) return true;
        n->found.data[n->order.data[0]] = *x;
        query_heap_sink(n->order.data, n->order.count, 0, further, q);
    }
    if (n->order.count < k) return true;
    /* Lowers the limit to the distance of the worst neighbour. Its image says little where squares leave the range of
     * doubles. */
    const geom_distance *d = &n->found.data[n->order.data[0]].distance;
    const num_ball image = geom_distance_image(d);
    double most = image.x + image.e;
    if (!(image.e <= 0x1p-20 * image.x))
        most = geom_distance_round(&q->numbers, n->point, d) * (1 + 0x1p-51) + 0x1p-1074;
    const double limit = query_near_square(n, most);
    if (limit < n->limit) n->limit = limit;
    return true;
}

/* False: it is beyond the bound. */
static bool measure_neighbour(froe_query *q, const geom_body *body, double bound, query_neighbour *out) {
    out->distance = geom_distance_from(&q->numbers, q->near.point, body);
    return geom_distance_compare_to(&q->numbers, q->near.point, &out->distance, bound) <= 0;
}

static froe_status find_neighbours(froe_query *q, size_t k, double bound, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    tree_objects list;
    froe_status status = query_near_begin(q, diag);
    if (bound < INFINITY) q->near.limit = query_near_square(&q->near, bound);
    while (!status && k && !(status = query_near_next(q, &list)) && list.count) {
        if (!query_expect(q, list.count)) return FROE_E_MEMORY;
        for (uint32_t i = 0; i < list.count; i++) {
            const uint32_t object = tree_object(&list, i);
            if (query_seen(q, &list, i, object)) continue;
            q->stats.tests++;
            if (!q->near.packed) { /* packed trees have compared better bounds */
                double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
                scene_object_bounds(s, object, lo, hi);
                if (query_near_box(&q->near, s->dim, lo, hi) > q->near.limit) continue;
            }
            const geom_body body = scene_body(s, object);
            query_neighbour x;
            x.square = NAN, x.object = object;
            if (measure_neighbour(q, &body, bound, &x) && !take_neighbour(q, &x, k)) return FROE_E_MEMORY;
        }
    }
    query_heap_unwind(q->near.order.data, q->near.order.count, further, q);
    return status;
}

/* The nearest of the candidates, sorted. */
static froe_status sort_candidates(froe_query *q, size_t k, double bound) {
    query_near *n = &q->near;
    const froe_scene *s = q->tree->scene;
    n->found.count = n->order.count = 0;
    if (!array_reserve(&q->alloc, &n->found, n->candidates.count) ||
        !array_reserve(&q->alloc, &n->order, n->candidates.count))
        return FROE_E_MEMORY;
    query_near_order(n); /* nearly their final order, which saves comparisons of distances */
    for (size_t i = 0; i < n->candidates.count; i++) {
        const query_candidate *c = n->candidates.data + i;
        const geom_body body = c->at ? geom_body_at(s->dim, c->at) : scene_body(s, c->object);
        query_neighbour *x = n->found.data + n->found.count;
        x->square = c->at ? c->square : (double)NAN;
        x->object = c->object;
        if (!measure_neighbour(q, &body, bound, x)) continue;
        n->order.data[n->order.count++] = (uint32_t)n->found.count++;
    }
    query_heap_sort(n->order.data, n->order.count, further, q);
    if (n->order.count > k) n->order.count = k;
    return FROE_OK;
}

froe_status query_near_by_blocks(froe_query *q, size_t k, bool *out, froe_diagnostic *diag) {
    const query_pieces *pieces;
    const froe_scene *s = q->tree->scene;
    *out = q->packed && (k == 1 || (k && q->ready && s->object_count && scene_form(s, 0) != FROE_POINT));
    if (*out || !q->packed || !k) return FROE_OK;
    const froe_status status = query_pieces_of(q, &pieces, diag);
    *out = !status && !pieces->points;
    return status;
}

/* Where there is a quick way to have candidates. */
static froe_status find_candidates(froe_query *q, size_t k, double bound, bool *done, froe_diagnostic *diag) {
    froe_status status = query_near_by_blocks(q, k, done, diag);
    if (!status) status = *done ? query_near_packed(q, k, bound) : query_near_points(q, k, bound, done, diag);
    return status || !*done ? status : sort_candidates(q, k, bound);
}

/* Distances of what was found and sorted, rounded. */
static froe_status round_distances(froe_query *q) {
    query_near *n = &q->near;
    n->out.count = 0;
    if (!array_reserve(&q->alloc, &n->out, n->order.count)) return FROE_E_MEMORY;
    for (size_t i = 0; i < n->order.count; i++) {
        const query_neighbour *x = n->found.data + n->order.data[i];
        const double distance = geom_distance_round(&q->numbers, n->point, &x->distance);
        n->out.data[n->out.count++] = (froe_neighbour){x->object, distance};
    }
    return FROE_OK;
}

froe_status query_near_check(const froe_query *query, const double *point, double bound, froe_diagnostic *diag) {
    const froe_status status = query_check_point(point, query->tree->scene->dim, "a point", diag);
    if (status) return status;
    if (!(bound >= 0))
        return support_fail(diag, FROE_E_INPUT, "The distance of neighbours, %g, is not a number >= 0.", bound);
    return FROE_OK;
}

froe_status query_near_settle(froe_query *q, const double *point, size_t i, size_t k, double bound) {
    query_near *n = &q->near;
    const size_t first = i ? n->flock_ends[i - 1] : 0;
    const uint64_t exact = q->numbers.stats.exact;
    memcpy(n->point, point, (size_t)q->tree->scene->dim * sizeof *point);
    n->candidates.count = 0;
    if (!array_append(&q->alloc, &n->candidates, n->flock.data + first, n->flock_ends[i] - first)) return FROE_E_MEMORY;
    froe_status status = sort_candidates(q, k, bound);
    if (!status) status = round_distances(q);
    q->stats.exact += q->numbers.stats.exact - exact;
    return status;
}

froe_status froe_query_near(froe_query *query, const double *point, size_t k, double bound, froe_neighbours *out,
                            froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !point || !out) return support_fail_null(diag, __func__);
    query_near *n = &query->near;
    froe_status status = query_near_check(query, point, bound, diag);
    if (status) return status;
    const uint64_t exact = query->numbers.stats.exact;
    query_begin(query);
    n->found.count = n->order.count = 0;
    memset(n->point, 0, sizeof n->point);
    memcpy(n->point, point, (size_t)query->tree->scene->dim * sizeof *point);
    n->limit = INFINITY;
    bool done = false;
    if (k) status = find_candidates(query, k, bound, &done, diag);
    if (k == 1 && !status && !done) status = query_near_in_space(query, bound, &done);
    if (!status && !done) status = find_neighbours(query, k, bound, diag);
    if (!status) status = round_distances(query);
    query->stats.exact += query->numbers.stats.exact - exact;
    if (status) return status == FROE_E_MEMORY ? query_failed(query, diag) : status;
    *out = (froe_neighbours){n->out.data, n->out.count};
    return FROE_OK;
}
