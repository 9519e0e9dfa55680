/* encounter.h: two moving triangles and the signs that tell whether they meet. It speaks for meet_triangles.c, which
 * has triangles without a common vertex and all polynomials, and neighbours.c, which has those that share vertices. */
#ifndef FROE_KINETIC_ENCOUNTER_H
#define FROE_KINETIC_ENCOUNTER_H
#include "kinetic/contact/walk.h"

enum {
    SIDES = 0,  /**< + 3 of + i: of corner i of the other, of the plane of triangle `of` */
    PASSES = 6, /**< + 3 i + j: of edges i and j */
    IN_SPACE = 15,
    TURNS = 15, /**< + 18 axis + 9 of + 3 edge + corner: of a corner of the other, of an edge of triangle `of` */
    GAPS = 69,  /**< + 9 axis + 3 i + j: of corner j of the second minus corner i of the first */
    ALL_SIGNS = WALK_POLYNOMIALS
};

typedef struct encounter {
    const froe_motion *m;
    num_arena *arena;
    walk_room *w;
    triangles_room *room;
    motion_piece piece[2][3];
    double origin[3];
    bool may_cross[6]; /**< edge i of the first the second; 3 + j: edge j of the second the first */
    bool may_be_flat;  /**< the corners may be in one plane, at some time */
    int shared_count;  /**< vertices that both have */
    int shared[2][3];  /**< their corners in the first and in the second triangle */
} encounter;

/** The corners and passes that tell whether an edge crosses: two sides and three passes. */
void encounter_crossing_signs(int edge, int out[5]);
/** Does an edge cross the other triangle from one side of its plane to another, or end in it? */
bool encounter_edge_crosses(const encounter *g, const walk_moment *at, int edge);
/** Are the corners in one plane at an instant? */
bool encounter_is_flat(const encounter *g, const walk_moment *at);

/** Finds what they share. */
void neighbours_find(const motion_object *p, const motion_object *q, encounter *g);
/** The signs that are 0 for that reason, as signs of the walk; and the edges that may cross. */
void neighbours_signs(const encounter *g, signed char sign[WALK_POLYNOMIALS], bool may_cross[6]);
/** Have they more in common than the hull of what they share? */
bool neighbours_meet(const encounter *g, const walk_moment *at);
#endif
