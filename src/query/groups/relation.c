/* relation.c: what relations to ranges and to groups share. */
#include "query/groups/relation.h"
#include "support/fail.h"

const char *froe_relation_name(froe_relation relation) {
    static const char *const names[FROE_RELATION_COUNT] = {"meets", "within", "covers"};
    return (unsigned)relation < FROE_RELATION_COUNT ? names[relation] : NULL;
}

froe_status query_relating_begin(froe_query *q, froe_relation relation, query_relating *out, froe_diagnostic *diag) {
    if ((unsigned)relation >= FROE_RELATION_COUNT)
        return support_fail(diag, FROE_E_ARG, "There is no relation of number %u.", (unsigned)relation);
    *out = (query_relating){.relation = relation};
    const froe_status status = query_groups_prepare(q, &out->areas, diag);
    return status || relation == FROE_MEETS ? status : query_roster_of(q, &out->roster, diag);
}

froe_status query_relate_point(froe_query *q, const query_relating *r, const double *x, froe_diagnostic *diag) {
    const froe_status status = query_groups_at(q, r->areas, x, diag);
    for (size_t i = 0; !status && i < q->groups.inside.count; i++)
        if (!query_groups_put_once(&q->work, &q->alloc, q->groups.inside.data[i])) return support_fail_memory(diag);
    return status;
}

froe_status query_relate_objects(froe_query *q, const froe_range *range, froe_diagnostic *diag) {
    const froe_status status = query_range_ask(q, range, false, diag);
    for (size_t i = 0; !status && i < q->found.count; i++) {
        const uint32_t group = q->tree->scene->groups[q->found.data[i]];
        if (group != FROE_NONE && !query_groups_put_once(&q->work, &q->alloc, group)) return support_fail_memory(diag);
    }
    return status;
}

froe_status query_relate_candidates(froe_query *q, const query_relating *r, const double *x, froe_diagnostic *diag) {
    const froe_status status = query_groups_at(q, r->areas, x, diag);
    const query_members *at = &q->groups.inside;
    q->work.candidates.count = 0;
    if (!status && !array_append(&q->alloc, &q->work.candidates, at->data, at->count)) return support_fail_memory(diag);
    return status;
}
