/* change.h: segments enter and leave a partition in motion, and with them changes of flight plans.
 *
 * Where a segment comes before the one that cuts a cell, everything in that cell is made anew; with random keys that
 * is O(log^2 n) nodes on average. All nodes of a segment that leaves are made anew without it. Segments in one line
 * with it may come into the tree then. */
#ifndef FROE_KINETIC_CHANGE_H
#define FROE_KINETIC_CHANGE_H
#include <froe/kinetic.h>

/** Lets a segment take part from now on, if it has a length, without putting it into the tree. Not of surfaces. */
void change_enroll(froe_kinetic *k, uint32_t segment);
/** The inverse. Of a surface without its edges. */
void change_unroll(froe_kinetic *k, uint32_t segment);
/** Puts it into the tree, wherever it is not in it. */
void change_put_in(froe_kinetic *k, uint32_t segment);
/** Makes a subtree anew from its segments, but for one or FROE_NONE. */
void change_make_anew(froe_kinetic *k, uint32_t node, uint32_t without);
/** Lets a segment take part, or the triangle of a surface, and puts it into the tree. */
void change_insert(froe_kinetic *k, uint32_t segment);
void change_remove(froe_kinetic *k, uint32_t segment);
/** (Re)sets when the segment appears or goes, and when the flight of its ends changes; in space of a surface, and of
 * the corners of its triangle. */
void change_schedule(froe_kinetic *k, uint32_t segment);
#endif
