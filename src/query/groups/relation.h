/* relation.h: the relations of groups to ranges and to other groups, for calls with one question and with many. */
#ifndef FROE_QUERY_GROUPS_RELATION_H
#define FROE_QUERY_GROUPS_RELATION_H
#include "query/groups/region.h"

/** What both need of a tree, prepared. */
typedef struct query_relating {
    froe_relation relation;
    const query_areas *areas;
    const query_roster *roster;
} query_relating;

/** Prepares it for a tree. FROE_E_ARG: no such relation; FROE_E_UNSUPPORTED, FROE_E_MEMORY. */
froe_status query_relating_begin(froe_query *query, froe_relation relation, query_relating *out, froe_diagnostic *diag);
/** Puts the groups that have a point; those whose objects meet a range. FROE_E_MEMORY. */
froe_status query_relate_point(froe_query *query, const query_relating *r, const double *x, froe_diagnostic *diag);
froe_status query_relate_objects(froe_query *query, const froe_range *range, froe_diagnostic *diag);
/** Makes the groups that have a point the candidates. FROE_E_MEMORY. */
froe_status query_relate_candidates(froe_query *query, const query_relating *r, const double *x, froe_diagnostic *diag);

/** The groups that have the relation to a range: query->work.groups. */
froe_status query_relate_range(froe_query *query, const query_relating *r, const froe_range *range,
                               froe_diagnostic *diag);
/** ... to a group of another tree, whose context is query->work.questions. */
froe_status query_relate_group(froe_query *query, const query_relating *r, const query_relating *questions,
                               uint32_t group, froe_diagnostic *diag);
#endif
