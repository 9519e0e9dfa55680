/* groups.c: the groups that a point of the plane lies in: those of its leaf's reference, but for the borders between.
 */
#include "base/status.h"
#include "query/areas.h"
#include "query/check.h"

static bool in_scene(const froe_scene *s, const double *x) {
    return s->object_count && x[0] >= s->lo[0] && x[0] <= s->hi[0] && x[1] >= s->lo[1] && x[1] <= s->hi[1];
}

/* From the reference to the point. */
static froe_status come_from_reference(froe_query *q, const query_areas *areas, const double *point,
                                       froe_diagnostic *diag) {
    const uint64_t exact = q->numbers.stats.exact;
    query_leaf leaf;
    froe_status status = query_leaf_find(q, point, &leaf);
    if (status) return base_fail_memory(diag);
    const uint32_t slot = areas->slots[leaf.place];
    const query_reference *r = areas->references.data + (slot & ~AREA_FAR);
    if (!query_sets_copy(&areas->sets, &q->alloc, r->set, &q->groups.inside)) return base_fail_memory(diag);
    if (slot & AREA_FAR || leaf.on_cut) return query_areas_travel(q, areas, r->at, point, diag);
    if (!query_areas_pass(q, areas, &leaf, r->at, point)) return base_fail_memory(diag);
    q->stats.exact += q->numbers.stats.exact - exact;
    return FROE_OK;
}

/* Groups of the objects that contain the point. */
static froe_status add_holders(froe_query *q, const double *point, froe_diagnostic *diag) {
    const uint32_t *groups = q->tree->scene->groups;
    const froe_status status = query_locate(q, point, diag);
    for (size_t i = 0; !status && i < q->found.count; i++) {
        const uint32_t group = groups ? groups[q->found.data[i]] : FROE_NONE;
        if (group != FROE_NONE && !query_members_add(&q->groups.touched, &q->alloc, group))
            return base_fail_memory(diag);
    }
    return status;
}

static froe_status ask(froe_query *q, const query_areas *areas, const double *point, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    q->groups.inside.count = q->groups.touched.count = 0;
    if (!in_scene(q->tree->scene, point)) return FROE_OK;
    if (areas->borders) status = come_from_reference(q, areas, point, diag);
    if (!status && (areas->solids || !areas->borders)) status = add_holders(q, point, diag);
    for (size_t i = 0; !status && i < q->groups.touched.count; i++)
        if (!query_members_add(&q->groups.inside, &q->alloc, q->groups.touched.data[i])) return base_fail_memory(diag);
    return status;
}

froe_status query_groups_prepare(froe_query *query, const query_areas **out, froe_diagnostic *diag) {
    if (query->tree->scene->dim != 2)
        return base_fail(diag, FROE_E_UNSUPPORTED, "Which groups a point lies in is asked in the plane only.");
    return query_areas_of(query, out, diag);
}

froe_status froe_query_groups(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag) {
    const query_areas *areas;
    if (!query || !point || !out) return base_fail(diag, FROE_E_ARG, "froe_query_groups: NULL argument.");
    froe_status status = query_groups_prepare(query, &areas, diag);
    if (!status) status = query_check_point(point, 2, "A point", diag);
    if (status) return status;
    const uint64_t queries = query->stats.queries + 1;
    status = ask(query, areas, point, diag);
    query->stats.queries = queries;
    if (!status) *out = (froe_list){query->groups.inside.data, query->groups.inside.count};
    return status;
}
