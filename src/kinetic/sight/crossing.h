/* crossing.h: where triangles at rest pass through one another: the ends of the segments in which they cross.
 *
 *          b
 *      .---/---.        an end is where an edge a b of one passes the other:  X/W = (a V_b - b V_a) / (V_b - V_a),
 *     /   x   /         V the volume over the triangle, V_a <= 0 <= V_b; it is kept as a quotient, because no double is
 *    '---/---'          near enough
 *       a */
#ifndef FROE_KINETIC_CROSSING_H
#define FROE_KINETIC_CROSSING_H
#include "kinetic/motion/motion.h"
#include "kinetic/motion/products.h"

/** The end of a crossing: an edge, and the triangle that it passes from below. */
typedef struct crossing_end {
    const double *edge[2], *face[3];
} crossing_end;

/** The two ends of the segment that two triangles at rest have in common. False: they have none, at most a point, or
 * are in one plane. `arena` has room for crossing_arena() limbs. */
bool crossing_find(num_arena *arena, const double *const a[3], const double *const b[3], crossing_end out[2]);
/** Limbs for coordinates that are multiples of 2^unit below 2^top. */
size_t crossing_arena(int unit, int top);

#include "num/ball_terms.inc"
#define CURVE motion_ball_curve
#include "kinetic/sight/crossing_body.inc"

#include "num/dyadic_terms.inc"
#define CURVE motion_dyadic_curve
#include "kinetic/sight/crossing_body.inc"
#endif
