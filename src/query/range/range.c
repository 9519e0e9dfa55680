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
static bool is_packed_window(const froe_query *q, const froe_range *range) {
    return q->packed && is_window(range);
}
static bool is_space_window(const froe_query *q, const froe_range *range) {
    return q->space && q->tree->packed.wide && is_window(range);
}

static froe_status ask_space(froe_query *q, const froe_range *range, bool any, froe_diagnostic *diag) {
    froe_status status = query_range_check(range, 3, diag);
    if (status) return status;
    query_begin(q);
    query_range_of_box(q, range);
    status = space_range(q, range->points, range->points + 3, any);
    return status ? support_fail_memory(diag) : FROE_OK;
}

static froe_status ask_packed(froe_query *q, const froe_range *range, bool any, froe_diagnostic *diag) {
    froe_status status = query_range_check(range, 2, diag);
    if (status) return status;
    query_begin(q);
    status = any ? packed_any(q, range->points, range->points + 2) : packed_range(q, range->points, range->points + 2);
    return status ? support_fail_memory(diag) : FROE_OK;
}

froe_status query_range_ask(froe_query *q, const froe_range *range, bool any, froe_diagnostic *diag) {
    if (is_packed_window(q, range)) return ask_packed(q, range, any, diag);
    if (is_space_window(q, range)) return ask_space(q, range, any, diag);
    froe_status status = query_range_take(q, range, diag);
    if (status) return status;
    query_begin(q);
    q->range.any = any;
    if (q->range.walk == FROE_WALK_CLASSES) return query_classes_search(q, diag);
    status = query_range_walk(q);
    return status ? support_fail_memory(diag) : FROE_OK;
}

froe_status froe_query_range(froe_query *query, const froe_range *range, froe_list *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail(diag, FROE_E_ARG, "froe_query_range: NULL argument.");
    const froe_status status = query_range_ask(query, range, false, diag);
    if (!status) *out = query_list(query);
    return status;
}

static froe_status count_packed(froe_query *q, const froe_range *range, uint64_t *out, froe_diagnostic *diag) {
    froe_status status = query_range_check(range, 2, diag);
    if (status) return status;
    query_begin(q);
    status = packed_count_range(q, range->points, range->points + 2, out);
    return status ? support_fail_memory(diag) : FROE_OK;
}

froe_status froe_query_count(froe_query *query, const froe_range *range, uint64_t *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail(diag, FROE_E_ARG, "froe_query_count: NULL argument.");
    if (is_packed_window(query, range)) return count_packed(query, range, out, diag);
    const froe_status status = query_range_ask(query, range, false, diag);
    if (!status) *out = query->found.count;
    return status;
}

froe_status froe_query_any(froe_query *query, const froe_range *range, uint32_t *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !range || !out) return support_fail(diag, FROE_E_ARG, "froe_query_any: NULL argument.");
    const froe_status status = query_range_ask(query, range, true, diag);
    if (!status) *out = query->found.count ? query->found.data[0] : FROE_NONE;
    return status;
}
