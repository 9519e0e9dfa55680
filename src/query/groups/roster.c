/* roster.c: see roster.h. */
#include "query/groups/roster.h"
#include "support/fail.h"

static void free_roster(const froe_allocator *alloc, query_part *part) {
    query_roster *r = (query_roster *)part;
    support_free(alloc, r->starts, ((size_t)r->group_count + 2) * sizeof *r->starts);
    support_free(alloc, r->objects, r->object_count * sizeof *r->objects);
    support_free(alloc, r, sizeof *r);
}

/* Counting sort: starts are one place behind until the objects are there. */
static froe_status make_roster(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    query_roster *r = support_calloc(&q->alloc, 1, sizeof *r);
    if (!r) return support_fail_memory(diag);
    r->part.free = free_roster;
    *out = &r->part;
    r->group_count = s->group_count;
    r->starts = support_calloc(&q->alloc, (size_t)s->group_count + 2, sizeof *r->starts);
    if (!r->starts) return support_fail_memory(diag);
    for (uint32_t i = 0; s->groups && i < s->object_count; i++)
        if (s->groups[i] != FROE_NONE) r->starts[s->groups[i] + 2]++, r->object_count++;
    if (!r->object_count) return FROE_OK;
    r->objects = support_calloc(&q->alloc, r->object_count, sizeof *r->objects);
    if (!r->objects) return support_fail_memory(diag);
    for (uint32_t g = 0; g < s->group_count; g++) r->starts[g + 2] += r->starts[g + 1];
    for (uint32_t i = 0; i < s->object_count; i++)
        if (s->groups[i] != FROE_NONE) r->objects[r->starts[s->groups[i] + 1]++] = i;
    return FROE_OK;
}

froe_status query_roster_of(froe_query *query, const query_roster **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_ROSTER, make_roster, &part, diag);
    if (status == FROE_OK) *out = (const query_roster *)part;
    return status;
}
