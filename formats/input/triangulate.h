/* triangulate.h: the sides and the ears of rings that readers need. */
#ifndef FROE_FORMATS_TRIANGULATE_H
#define FROE_FORMATS_TRIANGULATE_H

#include "support/array.h"

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
