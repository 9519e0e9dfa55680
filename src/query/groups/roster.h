/* roster.h: the objects of every group.
 *
 *     objects    3 7 8 | 0 | 1 2 4 5 | ...      group g: objects[starts[g] .. starts[g + 1]), ascending
 */
#ifndef FROE_QUERY_GROUPS_ROSTER_H
#define FROE_QUERY_GROUPS_ROSTER_H
#include "query/context.h"

typedef struct query_roster {
    query_part part;
    uint32_t group_count, object_count; /**< of objects in groups */
    uint32_t *starts, *objects;
} query_roster;

/** Prepares it. FROE_E_MEMORY. O(objects), once for all forks. */
froe_status query_roster_of(froe_query *query, const query_roster **out, froe_diagnostic *diag);

static inline uint32_t query_roster_size(const query_roster *r, uint32_t group) {
    return r->starts[group + 1] - r->starts[group];
}
/** The i-th object of a group. */
static inline uint32_t query_roster_object(const query_roster *r, uint32_t group, uint32_t i) {
    return r->objects[r->starts[group] + i];
}
#endif
