/* range.c: the public calls: all objects that meet a range, how many, or one of them. */
#include "base/floats.h"
#include "query/packed/packed.h"
#include "query/packed/space.h"
#include "query/range/classes.h"
#include "support/fail.h"

/* Windows on packed trees have a faster walk of their own, unless another walk is asked for. */
static bool is_window(const froe_range *range) {
    return range->size == sizeof *range && range->shape == FROE_SHAPE_BOX && range->eps == 0 &&
           range->walk == FROE_WALK_AUTO;
}
int query_range_window(const froe_query *q, const froe_range *range) {
    return !is_window(range) ? 0 : q->packed ? 2 : q->space && q->tree->packed.wide ? 3 : 0;
}
froe_status query_range_ask(froe_query *q, const froe_range *range, bool any, froe_diagnostic *diag) {
    const int dim = query_range_window(q, range);
    froe_status status = dim ? query_range_check(range, dim, diag) : query_range_take(q, range, diag);
    if (status) return status;
    if (dim == 3) {
        size_t count;
        q->found.count = 0;
        return space_ranges(q, &range->points, 1, any, &count) ? query_failed(q, diag) : FROE_OK;
    }
    query_begin(q);
    if (dim == 2) {
        status = (any ? packed_any : packed_range)(q, range->points, range->points + 2);
        return status ? query_failed(q, diag) : FROE_OK;
    }
    q->range.any = any;
    if (q->range.walk == FROE_WALK_CLASSES) return query_classes_search(q, diag);
    status = query_range_walk(q);
    return status ? query_failed(q, diag) : FROE_OK;
}

froe_status froe_query_range(froe_query *query, const froe_range *range, froe_list *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail_null(diag, __func__);
    const froe_status status = query_range_ask(query, range, false, diag);
    if (!status) *out = query_list(query);
    return status;
}

froe_status froe_query_count(froe_query *query, const froe_range *range, uint64_t *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail_null(diag, __func__);
    if (query_range_window(query, range) != 2) {
        const froe_status status = query_range_ask(query, range, false, diag);
        if (!status) *out = query->found.count;
        return status;
    }
    froe_status status = query_range_check(range, 2, diag);
    if (status) return status;
    query_begin(query);
    status = packed_count_range(query, range->points, range->points + 2, out);
    return status ? query_failed(query, diag) : FROE_OK;
}

froe_status froe_query_any(froe_query *query, const froe_range *range, uint32_t *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail_null(diag, __func__);
    const froe_status status = query_range_ask(query, range, true, diag);
    if (!status) *out = query->found.count ? query->found.data[0] : FROE_NONE;
    return status;
}
