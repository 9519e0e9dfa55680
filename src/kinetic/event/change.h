/* change.h: segments enter and leave a partition in motion, and with them changes of flight plans.
 *
 * Where a segment comes before the one that cuts a cell, everything in that cell is made anew; with random keys that
 * is O(log^2 n) nodes on average. All nodes of a segment that leaves are made anew without it. Segments in one line
 * with it may come into the tree then. */
#ifndef FROE_KINETIC_CHANGE_H
#define FROE_KINETIC_CHANGE_H
#include <froe/kinetic.h>

/** Lets a segment take part from now on, if it has a length, without putting it into the tree. */
void change_enroll(froe_kinetic *k, uint32_t segment);
/** In space: all triangles that are there take part from the present tick on, and no others, without being in the
 * tree. Edges cut when the first of their triangles does, in the order of its corners, and its surface after them. */
void change_enroll_triangles(froe_kinetic *k);
/** The inverse. */
void change_unroll(froe_kinetic *k, uint32_t segment);
/** Lets a segment take part, and puts it into the tree. */
void change_insert(froe_kinetic *k, uint32_t segment);
void change_remove(froe_kinetic *k, uint32_t segment);
/** (Re)sets when the segment appears or goes, and when the flight of its ends changes; in space of a surface, and of
 * the corners of its triangle. */
void change_schedule(froe_kinetic *k, uint32_t segment);
#endif
