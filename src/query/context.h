/* context.h: a query context from inside: the data of one thread, and what all threads share.
 *
 *     froe_query ----.          marks, numbers, answers, stacks: its own
 *     froe_query -----+--->  query_shared: tree, and parts prepared at first need
 *     froe_query ----'          (planes of cuts, centroids, borders of groups, ...)
 *
 * A part is made by the first thread that needs it. If two threads make it at once, one of the two is thrown
 * away. No thread waits, and a part never changes once it is there.
 *
 * Answers are gathered without duplicates: query_expect() makes room, query_found() reports. */
#ifndef FROE_QUERY_CONTEXT_H
#define FROE_QUERY_CONTEXT_H
#include "query/groups/work.h"
#include "query/marks.h"
#include "query/members.h"
#include "query/near/near.h"
#include "query/range/range.h"
#include "query/ray/ray.h"
#include "tree/gate.h"
#include "tree/list.h"
#include <froe/query.h>

/** Data prepared once for all contexts of a tree: the first member of its struct. */
typedef struct query_part {
    void (*free)(const froe_allocator *alloc, struct query_part *part);
} query_part;
/** A new part is one more number here. */
typedef enum query_part_id {
    QUERY_PLANES,
    QUERY_CENTROIDS,
    QUERY_DESCENT,
    QUERY_ANCESTORS,
    QUERY_AREAS,
    QUERY_CONTENTS,
    QUERY_PIECES,
    QUERY_CLASSES,
    QUERY_COVERS,
    QUERY_ROSTER,
    QUERY_PARTS
} query_part_id;

typedef struct query_shared {
    atomic_uint holds;
    _Atomic(query_part *) parts[QUERY_PARTS];
} query_shared;

typedef ARRAY(uint32_t) query_ids;

struct froe_query {
    const froe_tree *tree;
    froe_allocator alloc;
    query_shared *shared;
    num_context numbers;
    froe_query_stats stats;
    query_marks marks;
    query_ray ray;
    query_near near;
    query_range range;
    const tree_ready *ready; /**< of an opened tree: its leaves are checked when they are first visited; or NULL */
    struct {
        bool found, owners; /**< owners: what is wrong is a slice of them */
        uint32_t block, end;
    } bad;                      /**< what of an opened tree is not right, of what the query in progress has met */
    struct packed_work *packed; /**< packed trees of the plane only (query/packed/packed.h) */
    struct space_work *space;   /**< packed trees of space only (query/packed/space.h) */
    struct {
        query_members inside, touched;
        const double *from; /**< the reference whose way to the point was followed; NULL: none was needed */
    } groups;               /**< of a point, while it is looked for (query/point/areas.h) */
    query_groups_work work; /**< of relations (query/groups/region.h) */
    query_ids found;        /**< objects reported by the query in progress, or by the last one */
};

/** Makes one; *out has what was taken also on failure, for query_part's free (which must bear that). */
typedef froe_status query_make_fn(froe_query *query, query_part **out, froe_diagnostic *diag);
/** The part, made by `make` unless it is there. */
froe_status query_prepare(froe_query *query, query_part_id id, query_make_fn *make, const query_part **out,
                          froe_diagnostic *diag);

/** Is the leaf with this block right, with the objects in it? False: the query has to end by query_failed(). */
bool query_check_leaf(froe_query *query, uint32_t block);
static inline bool query_leaf_is_good(froe_query *q, uint32_t block) {
    return !q->ready || tree_bit_is_set(q->ready->leaves, block) || query_check_leaf(q, block);
}
/** Do the owners exist that the leaves from one block to another begin? */
bool query_owners_are_good(froe_query *query, uint32_t block, uint32_t end);
/** The status and the sentence of a query that had no memory, or met something of an opened tree that is not right. */
froe_status query_failed(froe_query *query, froe_diagnostic *diag);

/** Begins a query: forgets what the last one found. */
static inline void query_begin(froe_query *q) {
    query_marks_clear(&q->marks);
    q->found.count = 0;
    q->stats.queries++;
}
/** Room for `count` more objects in marks and answers. */
static inline bool query_expect(froe_query *q, size_t count) {
    return array_reserve(&q->alloc, &q->found, count) &&
           query_marks_reserve(&q->marks, &q->alloc, q->tree->scene->object_count, count);
}

/** May object i of a list lie in other lists, too? A piece that is all of an object that can be cut lies in one
 * list only: if it reached into another cell or cut, a cut would have divided it. */
static inline bool query_repeats(const froe_query *q, const tree_objects *list, uint32_t i, uint32_t object) {
    bool pieces = list->stride == sizeof(tree_piece) / sizeof(uint32_t);
    bool divided = !pieces || ((const tree_piece *)(const void *)list->at)[i].ring;
    return divided || scene_form(q->tree->scene, object) >= FROE_BOX;
}
/** Has object i of a list been looked at by this query? Marks it. REQUIRES: query_expect(). */
static inline bool query_seen(froe_query *q, const tree_objects *list, uint32_t i, uint32_t object) {
    return query_repeats(q, list, i, object) && !query_mark(&q->marks, object);
}
/** Reports an object. REQUIRES: query_expect(). */
static inline void query_found(froe_query *q, uint32_t object) {
    q->found.data[q->found.count++] = object;
}
static inline froe_list query_list(const froe_query *q) {
    return (froe_list){q->found.data, q->found.count};
}
#endif
