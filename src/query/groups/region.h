/* region.h: groups and convex ranges as closed sets of the plane, and whether one lies in the other.
 *
 *     region.c     objects near a region, and points of it; which segments bound it near an edge, and on which sides
 *                  of the edge it lies
 *     overlay.c    query_region_inside: an edge is followed from end to end, and both regions with it
 *     relation.c   what the next two share
 *     range.c      groups and a convex range
 *     join.c       groups and the groups of another tree
 *
 * Sides of a point on a border are told by turning round it: a germ is the set of points infinitesimally near to a
 * point p, in a direction from it, infinitesimally to the left or right of that direction.
 *
 *            \  |           The way from a reference ends in a germ at p, beside the reference's direction. From there
 *      germ . \ | /         to any other germ at p, the side changes with every border that leaves p in between.
 *    r - - - - -p-----> q   (query/point/areas.h)
 */
#ifndef FROE_QUERY_GROUPS_REGION_H
#define FROE_QUERY_GROUPS_REGION_H
#include "query/groups/roster.h"
#include "query/point/areas.h"

/** A group of a tree, or, if there is no query, a convex polygon of `count` corners, counter-clockwise and no three on
 * one line; of two corners a segment. */
typedef struct query_region {
    froe_query *query;
    const query_areas *areas;
    const query_roster *roster;
    uint32_t group;
    const double *corners;
    uint32_t count;
} query_region;

/** Finds the objects of a tree that meet the bounds of a region, of this tree or another: other->found.
 * FROE_E_MEMORY. */
froe_status query_region_near(const query_region *region, froe_query *other, froe_diagnostic *diag);
/** Is a point in the region, a group? FROE_E_MEMORY. */
froe_status query_region_has(const query_region *region, const double *x, bool *out, froe_diagnostic *diag);

/** Which side of an edge, as places in an array of two. */
enum { REGION_LEFT, REGION_RIGHT };

/** Appends to work->lines[which] the segments of the region that meet the edge from p to q. FROE_E_MEMORY. */
froe_status query_region_lines(const query_region *region, query_groups_work *work, const froe_allocator *alloc,
                               num_context *numbers, int which, const double *p, const double *q);
/** Is the area of the region left and right of the edge, next to p? REQUIRES: lines, those of the edge. FROE_E_MEMORY.
 */
froe_status query_region_sides(const query_region *region, num_context *numbers, const query_line *lines, size_t count,
                               const double *p, const double *q, bool sides[2]);

/** Does all of the inner region lie in the outer one, a group? The two have contexts of their own. FROE_E_MEMORY;
 * FROE_E_UNSUPPORTED: boxes, balls or hulls are among what decides. */
froe_status query_region_inside(const query_region *inner, const query_region *outer, bool *out, froe_diagnostic *diag);
#endif
