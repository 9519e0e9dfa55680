/* triangle.h: triangles enter and leave a partition in space.
 *
 * A triangle is in the tree by its edges and its surface, all under one number in the order of cuts: its edges cut in
 * the order of its corners, and its surface after them. An edge that several triangles share cuts with the first of
 * them. When that one leaves, or one that comes before it enters, the edge has another place in the order. */
#ifndef FROE_KINETIC_TRIANGLE_H
#define FROE_KINETIC_TRIANGLE_H
#include <froe/kinetic.h>
#include <stdint.h>

/** All triangles that are there take part from the present tick on, and no others, without being in the tree. */
void triangle_enroll_all(froe_kinetic *k);
/** The triangle of a surface, which takes part now. */
void triangle_insert(froe_kinetic *k, uint32_t surface);
/** The inverse. REQUIRES: it takes part. */
void triangle_remove(froe_kinetic *k, uint32_t surface);
#endif
