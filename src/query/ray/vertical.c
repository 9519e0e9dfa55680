/* vertical.c: the segment above or below a point of the plane: a vertical ray. */
#include "base/floats.h"
#include "query/check.h"
#include "query/packed/packed.h"
#include "support/fail.h"

froe_status query_vertical_check(const froe_query *query, const double *point, int direction, froe_diagnostic *diag) {
    if (query->tree->scene->dim != 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Above and below are asked in the plane only.");
    if (direction != 1 && direction != -1)
        return support_fail(diag, FROE_E_ARG, "The direction %d is neither 1, up, nor -1, down.", direction);
    return query_check_point(point, 2, "a point", diag);
}

froe_status froe_query_vertical(froe_query *query, const double *point, int direction, uint32_t *object,
                                froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !point || !object) return support_fail_null(diag, __func__);
    froe_status status = query_vertical_check(query, point, direction, diag);
    if (status) return status;
    if (query->packed) return packed_vertical(query, point, 1, direction, object) ? query_failed(query, diag) : FROE_OK;
    query_ray_set(query, point, (const double[]){0, direction}, INFINITY);
    status = query_ray_first(query, INFINITY, 1u << FROE_SEGMENT, diag);
    if (!status) *object = query->ray.met.count ? query->ray.met.data[0].object : FROE_NONE;
    return status;
}
