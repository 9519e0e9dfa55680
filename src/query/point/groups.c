/* groups.c: the groups that a point of the plane lies in: those of its leaf, and those on whose borders it is. */
#include "base/floats.h"
#include "query/check.h"
#include "query/point/areas.h"
#include "support/fail.h"

froe_status query_groups_in(froe_query *q, const query_areas *areas, const double *point, const query_leaf *leaf,
                            froe_diagnostic *diag) {
    const uint64_t queries = q->stats.queries + 1, exact = q->numbers.stats.exact;
    froe_status status = FROE_OK;
    q->groups.inside.count = q->groups.touched.count = 0;
    if (query_in_scene(q->tree->scene, point)) {
        if (areas->borders && query_areas_enter(q, areas, leaf, point)) return support_fail_memory(diag);
        if (areas->solids || !areas->borders) { /* groups of the objects that contain the point */
            const uint32_t *groups = q->tree->scene->groups;
            status = query_locate(q, point, diag);
            for (size_t i = 0; !status && groups && i < q->found.count; i++) {
                const uint32_t group = groups[q->found.data[i]];
                if (group != FROE_NONE && !query_members_add(&q->groups.touched, &q->alloc, group))
                    return support_fail_memory(diag);
            }
        }
    }
    /* The groups on whose borders the point is join those that it is inside of. */
    for (size_t i = 0; !status && i < q->groups.touched.count; i++)
        if (!query_members_add(&q->groups.inside, &q->alloc, q->groups.touched.data[i]))
            return support_fail_memory(diag);
    q->stats.queries = queries;
    q->stats.exact += q->numbers.stats.exact - exact;
    return status;
}

froe_status query_groups_prepare(froe_query *query, const query_areas **out, froe_diagnostic *diag) {
    if (query->tree->scene->dim != 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Which groups a point lies in is asked in the plane only.");
    return query_areas_of(query, out, diag);
}

froe_status query_groups_at(froe_query *q, const query_areas *areas, const double *point, froe_diagnostic *diag) {
    query_leaf leaf = {0};
    /* one way: while areas were made leaves were found, and all that this needs is kept */
    if (areas->borders && query_leaf_find(q, point, &leaf)) return support_fail_memory(diag);
    return query_groups_in(q, areas, point, &leaf, diag);
}

froe_status froe_query_groups(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const query_areas *areas;
    if (!query || !point || !out) return support_fail_null(diag, __func__);
    froe_status status = query_groups_prepare(query, &areas, diag);
    if (!status) status = query_check_point(point, 2, "a point", diag);
    if (!status) status = query_groups_at(query, areas, point, diag);
    if (!status) *out = (froe_list){query->groups.inside.data, query->groups.inside.count};
    return status;
}
