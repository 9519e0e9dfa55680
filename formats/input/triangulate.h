/* triangulate.h: the signs and the ears that readers need. */
#ifndef FROE_FORMATS_TRIANGULATE_H
#define FROE_FORMATS_TRIANGULATE_H

#include "support/array.h"

#define FORMATS_ORIENT_BOUND 4e-16 /**< Shewchuk's bound on the error of the ccw filter, rounded up */

/** The side of c seen along the line from a to b: 1 left, -1 right, 0 on it. Exact unless a product
 * overflows or underflows. */
int formats_orient(const double *a, const double *b, const double *c);

/** 1: the ring of points xy turns left (its interior is on its left), -1: right, 0: it cannot be told,
 * as of a ring without area. `count` points, the last not repeating the first. O(count). */
int formats_ring_side(const double *xy, size_t count);

typedef ARRAY(uint32_t) formats_indices;
/** Splits a polygon in space, given by its corners (3 doubles each, count >= 3), into count - 2
 * triangles with the corners of the polygon, and appends 3 indices for each to `triangles`.
 * A polygon whose shadow on its main coordinate plane is simple is covered without overlap. Any other
 * is split all the same: nothing is dropped. About O(count^1.5), O(count log count) on outlines of maps.
 * False: no memory. */
bool formats_triangulate(const froe_allocator *alloc, const double *corners, size_t count, formats_indices *triangles);

#endif
