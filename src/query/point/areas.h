/* areas.h: which groups bound areas, and where a point of the plane lies in them.
 *
 *     +----------------+      Every leaf has a reference point r within its cell and the set of groups that r lies
 *     |   \     r.     |      in. A point q of the same cell lies in the same ones but for those whose borders the
 *     |    \   /   .   |      segment rq crosses an odd number of times; all that it crosses is in the leaf's list.
 *     |     \ /     q  |
 *     +------x---------+      Jordan's theorem, by parity as Shimrat has it (Algorithm 112: position of point relative
 *                             to polygon, 1962), with a ray no longer than a cell.
 *
 * Borders may pass through r's and q's line anywhere: it counts as shifted to its right by an infinitesimal amount, so
 * no corner lies on it. References are on no border; each finds its set by the way from the one before, which lies
 * near. Where a cell has no double within it, or its point is in doubt, a reference elsewhere serves, and borders
 * on the way from there are found by a range query.
 *
 * What a point needs of its leaf lies in one place, each border with its ends, and borders of two areas once. Where the
 * list has none, only the number of the set is stored.
 *
 * It speaks for areas.c (references), areas_assign.c (which segments bound areas), areas_pass.c (the way from a
 * reference to a point) and groups.c (the public call). */
#ifndef FROE_QUERY_POINT_AREAS_H
#define FROE_QUERY_POINT_AREAS_H
#include "query/context.h"
#include "query/point/leaf.h"

/** The role of an object in its group. */
enum {
    AREA_NOTHING, /**< it has no group */
    AREA_MEMBER,  /**< a point or segment: the group has its points */
    AREA_BORDER,  /**< a segment, and the group lies on one side of it */
    AREA_SOLID    /**< any other kind: the group has its points */
};

typedef struct query_reference {
    double at[2];
    uint32_t set; /**< of groups */
} query_reference;

/** A point or segment of one or two groups, the other FROE_NONE. A border has the reference on its left. */
typedef struct query_border {
    double u[2], v[2];
    uint32_t groups[2];
} query_border;

/** Begins what a leaf has: borders, then others, whose points belong to their groups and that bound nothing here. */
typedef struct query_area_leaf {
    query_reference from;
    uint32_t borders, others;
} query_area_leaf;

#define AREA_FAR 0x80000000u /**< of a slot: a reference that is not in the cell */
#define AREA_SET 0x40000000u /**< of a slot: the list has nothing of any group, all of the cell lies in this set */
#define AREA_NUMBER 0x3fffffffu

typedef struct query_areas {
    query_part part;
    uint32_t object_count, place_count;
    uint8_t *roles; /**< [object] */
    bool borders;   /**< is there any? Otherwise nothing below is made */
    bool solids;
    uint32_t *slots;   /**< [place of a leaf]: AREA_FAR, AREA_SET, or where it begins in `leaves` */
    double outside[2]; /**< the first reference, in no group */
    ARRAY(query_reference) references;
    ARRAY(uint64_t) leaves; /**< a query_area_leaf, its borders and others; the next one ... */
    query_sets sets;
} query_areas;

/** Finds the role of every object in its group.
 *
 * The borders of a group are its segments that share a face with another one: the rings of a polygon, as readers number
 * them. Where no two do, they are all its segments if these close, so that an even number of them ends everywhere;
 * otherwise it consists of lines. FROE_E_UNSUPPORTED: rings that do not close; FROE_E_MEMORY. O(objects). */
froe_status query_areas_assign(froe_query *query, query_areas *areas, froe_diagnostic *diag);
/** Turns slots that are numbers of references, AREA_FAR or not, into what a query reads. False without memory. */
bool query_areas_settle(froe_query *query, query_areas *areas);

/** Prepares them. Uses the context as a query does. O(n log n) on trees of n leaves, as a rule. */
froe_status query_areas_of(froe_query *query, const query_areas **out, froe_diagnostic *diag);
/** ... unless the tree is not of the plane: FROE_E_UNSUPPORTED. */
froe_status query_groups_prepare(froe_query *query, const query_areas **out, froe_diagnostic *diag);

/** Flips in query->groups.inside the groups whose borders the way between two points crosses an odd number of times,
 * and adds to query->groups.touched those of which `to` is a point or on the border. `from` is on no border. */
froe_status query_areas_travel(froe_query *query, const query_areas *areas, const double *from, const double *to,
                               froe_diagnostic *diag);
/** Fills query->groups for a point in the closed cell of a leaf. FROE_E_MEMORY. */
froe_status query_areas_enter(froe_query *query, const query_areas *areas, const query_leaf *leaf, const double *point);
/** Prefetches what points in these leaves will read. REQUIRES: there are borders. */
void query_areas_ask(const query_areas *areas, const query_leaf *leaves, size_t count);
/** The groups of a point whose leaf is known, unless it is outside of the scene: query->groups.inside. */
froe_status query_groups_in(froe_query *query, const query_areas *areas, const double *point, const query_leaf *leaf,
                            froe_diagnostic *diag);
/** ... of any point. */
froe_status query_groups_at(froe_query *query, const query_areas *areas, const double *point, froe_diagnostic *diag);
#endif
