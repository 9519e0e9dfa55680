/* ray.c: what does a ray meet?
 *
 * Every object in the lists along the ray is tested once, exactly. Of two that are met, the one met first is
 * found by their images, and exactly where these overlap; what the ray can reach only beyond the best
 * so far is not visited. Since rounding keeps the order, all of them are sorted by their rounded parameters, and
 * only where these are equal by the exact ones. */
#include "query/ray/ray.h"
#include "base/floats.h"
#include "query/check.h"
#include "query/context.h"
#include "query/heap.h"
#include "query/packed/space.h"
#include "support/fail.h"
#include <string.h>

void query_ray_free(query_ray *r, const froe_allocator *alloc) {
    array_free(alloc, &r->steps);
    array_free(alloc, &r->met);
    array_free(alloc, &r->order);
    array_free(alloc, &r->hits);
}

froe_status query_ray_check(int dim, const double *origin, const double *direction, double t_max,
                            froe_diagnostic *diag) {
    double none = 0, size = 0; /* what is no finite number makes the first NaN */
    for (int k = 0; k < dim; k++) {
        none += (origin[k] - origin[k]) + (direction[k] - direction[k]);
        size += fabs(direction[k]);
    }
    if (none == 0 && size > 0 && t_max >= 0) return FROE_OK;
    froe_status status = query_check_point(origin, dim, "the origin of a ray", diag);
    if (!status) status = query_check_point(direction, dim, "the direction of a ray", diag);
    if (status) return status;
    if (!(t_max >= 0))
        return support_fail(diag, FROE_E_INPUT, "The end of a ray, t = %g, is not a number >= 0.", t_max);
    return support_fail(diag, FROE_E_INPUT, "The direction of a ray is 0.");
}

void query_ray_set(froe_query *q, const double *origin, const double *direction, double t_max) {
    const int dim = q->tree->scene->dim;
    q->ray.ray = (geom_ray){.dim = dim};
    memcpy(q->ray.ray.o, origin, (size_t)dim * sizeof *origin);
    memcpy(q->ray.ray.d, direction, (size_t)dim * sizeof *direction);
    q->ray.limit = t_max;
}

froe_status query_ray_take(froe_query *q, const double *origin, const double *direction, double t_max,
                           froe_diagnostic *diag) {
    const froe_status status = query_ray_check(q->tree->scene->dim, origin, direction, t_max, diag);
    if (!status) query_ray_set(q, origin, direction, t_max);
    return status;
}

bool query_ray_meets(froe_query *q, const geom_ray *ray, uint32_t object, double t_max, query_met *out) {
    const geom_body body = scene_body(q->tree->scene, object);
    q->stats.tests++;
    out->object = object;
    return geom_ray_meets(&q->numbers, ray, &body, &out->hit) &&
           geom_hit_compare_to(&q->numbers, ray, &out->hit, t_max) <= 0;
}

bool query_ray_nearer(froe_query *q, const geom_ray *ray, const query_met *met, const query_met *best) {
    const int order = geom_hit_compare(&q->numbers, ray, &met->hit, &best->hit);
    return order < 0 || (order == 0 && met->object < best->object);
}

double query_ray_latest(const geom_hit *hit) {
    const double t = (hit->t.x + hit->t.e) * (1 + 0x1p-50);
    return t >= 0 ? t : (double)INFINITY;
}

typedef enum ray_wanted { RAY_FIRST, RAY_ANY, RAY_ALL } ray_wanted;

/* Puts into q->ray.met what the ray meets: the first object, any, or all, each once. */
static inline froe_status gather_met(froe_query *q, double t_max, uint32_t kinds, ray_wanted wanted,
                                     froe_diagnostic *diag) {
    const uint64_t exact = q->numbers.stats.exact;
    tree_objects list;
    query_met met;
    bool more = true;
    query_begin(q);
    q->ray.met.count = 0;
    froe_status status = query_walk_begin(q, diag);
    while (!status && more && !(status = query_walk_next(q, &list)) && list.count) {
        if (!query_expect(q, list.count)) status = FROE_E_MEMORY;
        for (uint32_t i = 0; i < list.count && more && !status; i++) {
            const uint32_t object = tree_object(&list, i);
            const bool asked = kinds == UINT32_MAX || kinds >> scene_kind(q->tree->scene, object) & 1;
            if (!asked || query_seen(q, &list, i, object)) continue;
            if (!query_ray_meets(q, &q->ray.ray, object, t_max, &met)) continue;
            if (!array_reserve(&q->alloc, &q->ray.met, 1)) status = FROE_E_MEMORY;
            if (status) continue;
            if (wanted != RAY_FIRST) {
                q->ray.met.data[q->ray.met.count++] = met;
                more = wanted == RAY_ALL;
            } else if (!q->ray.met.count || query_ray_nearer(q, &q->ray.ray, &met, q->ray.met.data)) {
                q->ray.met.data[0] = met;
                q->ray.met.count = 1;
                const double limit = query_ray_latest(&met.hit);
                if (limit < q->ray.limit) q->ray.limit = limit;
            }
        }
    }
    q->stats.exact += q->numbers.stats.exact - exact;
    return status == FROE_E_MEMORY ? query_failed(q, diag) : status;
}

/* ------------------------------------------------------------------- first -- */

froe_status query_ray_first(froe_query *q, double t_max, uint32_t kinds, froe_diagnostic *diag) {
    return gather_met(q, t_max, kinds, RAY_FIRST, diag);
}

froe_status query_ray_walked(froe_query *q, const double *origin, const double *direction, double t_max, froe_hit *hit,
                             uint32_t *object, froe_diagnostic *diag) {
    froe_status status = query_ray_take(q, origin, direction, t_max, diag);
    if (!status) status = gather_met(q, t_max, UINT32_MAX, hit ? RAY_FIRST : RAY_ANY, diag);
    if (status) return status;
    const query_met *met = q->ray.met.count ? q->ray.met.data : NULL;
    if (object) *object = met ? met->object : FROE_NONE;
    if (hit) *hit = (froe_hit){.object = met ? met->object : FROE_NONE};
    if (hit && met) hit->t = geom_hit_round(&q->numbers, &q->ray.ray, &met->hit);
    return FROE_OK;
}

static froe_status ask_one(froe_query *q, const double *origin, const double *direction, double t_max, froe_hit *hit,
                           uint32_t *object, froe_diagnostic *diag) {
    if (!q->space || !q->tree->packed.wide) return query_ray_walked(q, origin, direction, t_max, hit, object, diag);
    const froe_status status = query_ray_check(3, origin, direction, t_max, diag);
    if (status) return status;
    return object ? space_ray_any(q, origin, direction, t_max, object, diag)
                  : space_rays(q, origin, direction, 1, t_max, hit, object, diag);
}

froe_status froe_query_ray(froe_query *query, const double *origin, const double *direction, double t_max,
                           froe_hit *hit, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !origin || !direction || !hit) return support_fail_null(diag, __func__);
    return ask_one(query, origin, direction, t_max, hit, NULL, diag);
}

froe_status froe_query_ray_any(froe_query *query, const double *origin, const double *direction, double t_max,
                               uint32_t *object, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !origin || !direction || !object) return support_fail_null(diag, __func__);
    return ask_one(query, origin, direction, t_max, NULL, object, diag);
}

/* --------------------------------------------------------------------- all -- */

static bool hit_is_later(void *user, uint32_t a, uint32_t b) {
    froe_query *q = user;
    const froe_hit *s = q->ray.hits.data + a, *t = q->ray.hits.data + b;
    if (s->t != t->t) return s->t > t->t;
    const int order = geom_hit_compare(&q->numbers, &q->ray.ray, &q->ray.met.data[a].hit, &q->ray.met.data[b].hit);
    return order ? order > 0 : s->object > t->object;
}

froe_status froe_query_ray_all(froe_query *query, const double *origin, const double *direction, double t_max,
                               froe_hits *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !origin || !direction || !out) return support_fail_null(diag, __func__);
    froe_status status = query_ray_take(query, origin, direction, t_max, diag);
    if (!status) status = gather_met(query, t_max, UINT32_MAX, RAY_ALL, diag);
    if (status) return status;
    /* The hits in the order met, whose numbers are sorted; the first half of `hits` is scratch. */
    query_ray *r = &query->ray;
    const size_t count = r->met.count;
    r->hits.count = r->order.count = 0;
    if (!array_reserve(&query->alloc, &r->hits, 2 * count) || !array_reserve(&query->alloc, &r->order, count))
        return support_fail_memory(diag);
    for (size_t i = 0; i < count; i++) {
        const double t = geom_hit_round(&query->numbers, &r->ray, &r->met.data[i].hit);
        r->hits.data[i] = (froe_hit){r->met.data[i].object, t};
        r->order.data[i] = (uint32_t)i;
    }
    query_heap_sort(r->order.data, count, hit_is_later, query);
    for (size_t i = 0; i < count; i++) r->hits.data[count + i] = r->hits.data[r->order.data[i]];
    *out = (froe_hits){r->hits.data + count, count};
    return FROE_OK;
}
