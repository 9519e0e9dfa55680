/* polytope.h: the corners of an intersection of halfspaces, exactly.
 *
 *        \      L         on the line where two planes meet, every other halfspace leaves a ray or
 *     ----*-----*----     nothing of what is left; if something is left in the end, its two ends are
 *          \   /          corners
 *
 * Corners are named by three planes and never rounded. The set may be flat, a segment, a point or empty. A box cuts
 * it off, since callers need only what is within that box: so it is bounded. In the plane the lines become vertical
 * planes of space, and the third plane of every corner is z = 0. */
#ifndef FROE_GEOM_POLYTOPE_H
#define FROE_GEOM_POLYTOPE_H
#include "geom/convex.h"
#include "support/array.h"

typedef struct geom_polytope {
    ARRAY(geom_plane) planes;
    ARRAY(int8_t) senses;        /**< 1: the set is where the plane's side is <= 0, -1: where it is >= 0 */
    ARRAY(geom_meeting) corners; /**< none: the set is empty */
    ARRAY(double) images;        /**< dim doubles a corner */
    double error;                /**< of the images; may be infinite */
} geom_polytope;

/** The part of  normals[i] . x <= offsets[i]  (count of them, dim doubles each; dim 2 or 3) within the box. False
 * without memory. O(count^3) at most in space, O(count^2) in the plane. */
bool geom_polytope_make(num_context *context, const froe_allocator *alloc, int dim, const double *normals,
                        const double *offsets, size_t count, const double *lo, const double *hi, geom_polytope *out);
void geom_polytope_free(geom_polytope *polytope, const froe_allocator *alloc);
/** As a set; not when it is empty. */
geom_convex geom_polytope_convex(const geom_polytope *polytope, int dim);
#endif
