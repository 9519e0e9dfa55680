/* pass.h: a point passes a wall that belongs to another point, and nothing else happens.
 *
 *     _________________             Only two cells change, those on both sides of the wall at the height of the
 *        :   |     :                point: near, where the certificate was, and far. In one of them the segment s of
 *        :far|near :                the point comes to be, or ends, a little earlier, in the other a little later.
 *        :   | o---:-- s            Other segments that cross the wall there do so before and after.
 *        :   |     :                A walk down along the wall lists them from below. Since that part of the cell is
 *     ___:__(q)____:___             thin, their order and heights alone determine its new tree (a treap).
 *
 * If there is another wall in a thin part, as of a vertex that has the same x for ever, it passes, too, and this case
 * is refused. The far cell is found by walking down on the other side of the wall, past all segments before s in
 * order. Each of these is on the way to the near cell, too, or ends before the wall. Segments after s are in the far
 * cell. Source: the paper shaves transient cells off (its section 3.1.2 and figure 3); that a thin part is a treap is
 * not in the paper. */
#ifndef FROE_KINETIC_PASS_H
#define FROE_KINETIC_PASS_H
#include "kinetic/event/slab.h"

typedef enum pass_outcome {
    PASS_DONE,
    PASS_NEIGHBOURS, /**< neighbours were added to the participants; the tree is as it was */
    PASS_REFUSED     /**< nothing was done */
} pass_outcome;
/** The point of a node passes a wall of its cell, away from the point that the wall belongs to. */
pass_outcome pass_wall(froe_kinetic *k, const slab_item *item);
#endif
