/* between.h: a plane between two sets of points, exactly.
 *
 *      A  . .   /  o o           all of A on one closed side, all of B on the other, and not all of both in
 *       .   .  /o    o  B        the plane: there is one if and only if the relative interiors of the two
 *         . . /   o o            convex hulls are disjoint (Rockafellar 1970, theorem 11.3)
 *            .
 *
 * Some such plane runs through dim of the points. It is found as in Seidel's linear programming in few dimensions
 * (1991): points enter one by one, and where one lies on the wrong side of the plane found so far, there is a plane
 * through that very point, or none at all. For a plane that turns steadily from the old one to any right one passes the
 * point. So the search goes on among the planes through it, one dimension less. */
#ifndef FROE_GEOM_BETWEEN_H
#define FROE_GEOM_BETWEEN_H
#include "geom/predicates.h"

/** A point and the set it belongs to. */
typedef struct geom_member {
    const double *x;
    uint32_t id; /**< the caller's */
    int set;     /**< -1 or 1 */
} geom_member;

typedef enum geom_answer {
    GEOM_NO,
    GEOM_YES,
    GEOM_FLAT /**< not asked: all points of both lie in one plane (2D: on one line) */
} geom_answer;

/** Is there a plane between the two sets, of one point or more each? A point may be in both. GEOM_YES: it runs through
 * the first dim members. 2D and 3D. Reorders the members. Expected O(count), as the order is made random first. */
geom_answer geom_between(num_context *context, int dim, geom_member *members, uint32_t count);
#endif
