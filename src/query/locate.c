/* locate.c: the objects that contain a point: a range of one point. On every cut that the point is not on it goes one
 * way; on a cut it visits the list there and both sides. */
#include "base/status.h"
#include "query/context.h"

froe_status query_locate(froe_query *q, const double *point, froe_diagnostic *diag) {
    const size_t dim = (size_t)q->tree->scene->dim;
    double ends[2 * FROE_MAX_DIM];
    froe_range range = froe_range_defaults();
    for (size_t k = 0; k < dim; k++) {
        if (!isfinite(point[k])) return base_fail(diag, FROE_E_INPUT, "A point has %g as a coordinate.", point[k]);
        ends[k] = ends[dim + k] = point[k];
    }
    range.points = ends;
    return query_range_ask(q, &range, false, diag);
}

froe_status froe_query_locate(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag) {
    if (!query || !point || !out) return base_fail(diag, FROE_E_ARG, "froe_query_locate: NULL argument.");
    const froe_status status = query_locate(query, point, diag);
    if (!status) *out = query_list(query);
    return status;
}
