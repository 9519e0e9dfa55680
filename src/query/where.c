/* where.c: where on an object: its point nearest to a query, and what lies where a ray meets it. Both are said of one
 * object, of those that the other questions found. */
#include "base/floats.h"
#include "geom/meet/foot.h"
#include "query/check.h"
#include "query/context.h"
#include "support/fail.h"

/* Objects that a query has found were checked with their leaf; this one may be any. */
static froe_status check_found(froe_query *q, uint32_t object, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    return scene_is_checked(s) ? FROE_OK : scene_check_object(s, object, &q->numbers, diag);
}

static froe_status check_object(froe_query *q, uint32_t object, froe_diagnostic *diag) {
    if (object < q->tree->scene->object_count) return check_found(q, object, diag);
    return support_fail(diag, FROE_E_ARG, "There is no object %u in a scene of %zu.", object,
                        (size_t)q->tree->scene->object_count);
}

froe_status froe_query_nearest_point(froe_query *query, uint32_t object, const double *point, double *nearest,
                                     froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !point || !nearest) return support_fail_null(diag, __func__);
    froe_status status = check_object(query, object, diag);
    if (!status) status = query_check_point(point, query->tree->scene->dim, "a point", diag);
    if (status) return status;
    const geom_body body = scene_body(query->tree->scene, object);
    geom_foot(&query->numbers, point, &body, nearest);
    return FROE_OK;
}

froe_status froe_query_hit_place(froe_query *query, uint32_t object, const double *origin, const double *direction,
                                 froe_hit_place *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !origin || !direction || !out) return support_fail_null(diag, __func__);
    froe_status status = check_object(query, object, diag);
    if (!status) status = query_ray_take(query, origin, direction, INFINITY, diag);
    if (status) return status;
    const geom_body body = scene_body(query->tree->scene, object);
    const geom_ray *ray = &query->ray.ray;
    geom_hit hit;
    if (!geom_ray_meets(&query->numbers, ray, &body, &hit))
        return support_fail(diag, FROE_E_INPUT, "The ray does not meet object %u.", object);
    *out = (froe_hit_place){.distance = geom_hit_distance(&query->numbers, ray, &hit)};
    geom_hit_point(&query->numbers, ray, &hit, out->point);
    geom_hit_normal(&query->numbers, ray, &body, &hit, out->normal);
    return FROE_OK;
}
