/* work.h: what a context keeps for relations of groups, so that its arrays need not be taken anew for each call. */
#ifndef FROE_QUERY_GROUPS_WORK_H
#define FROE_QUERY_GROUPS_WORK_H
#include "query/members.h"

/** A segment of a group, or an edge of a range. */
typedef struct query_line {
    double u[2], v[2];
    bool border; /**< does the area change sides there? */
} query_line;

/** What changes at one place of an edge that is followed (overlay.c). */
typedef struct query_event {
    double u[2], v[2]; /**< where the edge crosses the line uv, or ... */
    bool vertex;       /**< ... at u */
    uint8_t flips;     /**< which sides of the edge change to the other side of an area */
    int8_t cover;      /**< how many more segments of the outer group lie on the edge from here on */
} query_event;

/** How many objects of a group were counted since the stamp. */
typedef struct query_tally {
    uint32_t stamp, count;
} query_tally;

struct froe_query;
typedef struct query_groups_work {
    ARRAY(query_line) lines[2]; /**< of the inner and the outer group, at the edge that is followed */
    ARRAY(query_event) events;
    ARRAY(uint32_t) order; /**< of events */
    ARRAY(uint32_t) near;  /**< objects of the outer group near the inner one */
    ARRAY(uint32_t) candidates;
    ARRAY(double) points;         /**< of a range, sorted */
    ARRAY(double) corners;        /**< of its hull */
    query_members groups;         /**< the answer: its groups */
    query_tally *tallies;         /**< [group] */
    uint32_t tally_count, stamp;  /**< groups of the tree; of this call */
    struct froe_query *questions; /**< of a batch of groups, a context of this thread; the batch's */
} query_groups_work;

/** Begins an answer. False without memory. */
bool query_groups_begin(query_groups_work *work, const froe_allocator *alloc, uint32_t groups);
void query_groups_work_free(query_groups_work *work, const froe_allocator *alloc);

/** Counts an object of a group: how many there are now. REQUIRES: query_groups_begin(). */
static inline uint32_t query_groups_count(query_groups_work *work, uint32_t group) {
    query_tally *t = work->tallies + group;
    if (t->stamp != work->stamp) *t = (query_tally){work->stamp, 0};
    return ++t->count;
}
/** Puts a group into the answer. False without memory. */
static inline bool query_groups_put(query_groups_work *work, const froe_allocator *alloc, uint32_t group) {
    return array_push(alloc, &work->groups, group);
}
/** Puts it there unless it was counted already. */
static inline bool query_groups_put_once(query_groups_work *work, const froe_allocator *alloc, uint32_t group) {
    return query_groups_count(work, group) > 1 || query_groups_put(work, alloc, group);
}
/** Sorts the answer. */
void query_groups_end(query_groups_work *work);
#endif
