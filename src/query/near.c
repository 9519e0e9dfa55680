/* near.c: the k nearest objects.
 *
 * The k best so far form a heap with the worst on top, compared exactly. When there are k of them, what is further
 * away than the worst is passed over: places by their bounds, objects by those of their bounding boxes, and the
 * rest by comparing distances, whose images decide but for ties. */
#include "query/near.h"
#include "query/check.h"
#include "query/context.h"
#include "query/heap.h"
#include <string.h>

void query_near_free(query_near *n, const froe_allocator *alloc) {
    array_free(alloc, &n->places);
    array_free(alloc, &n->free);
    array_free(alloc, &n->heap);
    array_free(alloc, &n->found);
    array_free(alloc, &n->order);
    array_free(alloc, &n->out);
}

/* Is a further away than b? Never equal. */
static bool further(void *user, uint32_t a, uint32_t b) {
    froe_query *q = user;
    const query_neighbour *x = q->near.found.data + a, *y = q->near.found.data + b;
    const int order = geom_distance_compare(&q->numbers, q->near.point, &x->distance, &y->distance);
    return order ? order > 0 : x->object > y->object;
}

/* The places and objects that the worst neighbour leaves in the race. Its image says little where squares leave the
 * range of doubles. */
static void lower_limit(froe_query *q) {
    const geom_distance *d = &q->near.found.data[q->near.order.data[0]].distance;
    const num_ball image = geom_distance_image(d);
    double most = image.x + image.e;
    if (!(image.e <= 0x1p-20 * image.x))
        most = geom_distance_round(&q->numbers, q->near.point, d) * (1 + 0x1p-51) + 0x1p-1074;
    const double limit = query_near_square(&q->near, most);
    if (limit < q->near.limit) q->near.limit = limit;
}

/* Takes a neighbour among the k best, in place of the worst if there are k. False: no memory. */
static bool take(froe_query *q, const query_neighbour *x, size_t k) {
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
    if (n->order.count == k) lower_limit(q);
    return true;
}

static bool beyond_limit(froe_query *q, uint32_t object) {
    const froe_scene *s = q->tree->scene;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(s, object, lo, hi);
    return query_near_box(&q->near, s->dim, lo, hi) > q->near.limit;
}

static bool look_at(froe_query *q, uint32_t object, size_t k, double bound) {
    const froe_scene *s = q->tree->scene;
    q->stats.tests++;
    if (!q->near.packed && beyond_limit(q, object)) return true; /* packed trees have looked at more than boxes */
    const geom_body body = scene_body(s, object);
    const query_neighbour x = {geom_distance_from(&q->numbers, q->near.point, &body), object};
    if (geom_distance_compare_to(&q->numbers, q->near.point, &x.distance, bound) > 0) return true;
    return take(q, &x, k);
}

static froe_status find(froe_query *q, size_t k, double bound, froe_diagnostic *diag) {
    tree_objects list;
    q->near.one = k == 1;
    froe_status status = query_near_begin(q, diag);
    if (bound < INFINITY) q->near.limit = query_near_square(&q->near, bound);
    while (!status && k && !(status = query_near_next(q, &list)) && list.count) {
        if (!query_expect(q, list.count)) return FROE_E_MEMORY;
        for (uint32_t i = 0; i < list.count; i++) {
            const uint32_t object = tree_object(&list, i);
            if (!query_seen(q, &list, i, object) && !look_at(q, object, k, bound)) return FROE_E_MEMORY;
        }
    }
    return status;
}

/* Nearest first, as doubles. */
static bool deliver(froe_query *q) {
    query_near *n = &q->near;
    query_heap_unwind(n->order.data, n->order.count, further, q);
    n->out.count = 0;
    if (!array_reserve(&q->alloc, &n->out, n->order.count)) return false;
    for (size_t i = 0; i < n->order.count; i++) {
        const query_neighbour *x = n->found.data + n->order.data[i];
        const double distance = geom_distance_round(&q->numbers, n->point, &x->distance);
        n->out.data[n->out.count++] = (froe_neighbour){x->object, distance};
    }
    return true;
}

froe_status froe_query_near(froe_query *query, const double *point, size_t k, double bound, froe_neighbours *out,
                            froe_diagnostic *diag) {
    if (!query || !point || !out) return base_fail(diag, FROE_E_ARG, "froe_query_near: NULL argument.");
    query_near *n = &query->near;
    const int dim = query->tree->scene->dim;
    froe_status status = query_check_point(point, dim, "A point", diag);
    if (status) return status;
    if (!(bound >= 0)) return base_fail(diag, FROE_E_INPUT, "Neighbours are to be within %g.", bound);
    const uint64_t exact = query->numbers.stats.exact;
    query_begin(query);
    n->found.count = n->order.count = 0;
    memset(n->point, 0, sizeof n->point);
    memcpy(n->point, point, (size_t)dim * sizeof *point);
    n->limit = INFINITY;
    status = find(query, k, bound, diag);
    query->stats.exact += query->numbers.stats.exact - exact;
    if (status == FROE_E_MEMORY || (!status && !deliver(query))) return base_fail_memory(diag);
    if (!status) *out = (froe_neighbours){n->out.data, n->out.count};
    return status;
}
