/* normals.h: is there a plane between two sets of points? The audit decides it on the set of normals.
 *
 *          \    d1                   A normal n is right when n . d >= 0 for all differences d = b - a of points of B
 *    rays   \  /   cone of           and A. Those that are right for some differences form a cone. As long as that is
 *       \____\*____ normals left     not empty, some normal of it is asked: either it is right, or it tells the worst
 *             \                      pair (a, b), whose difference cuts it off (the cutting planes of Kelley 1960;
 *              \  d2                 the rays are kept by double description, Motzkin et al. 1953).
 *
 * Normals are cross products of differences, whose signs are exact. It shares nothing with geom/between.h, by which
 * builders look for planes, but the same question. */
#ifndef FROE_TREE_AUDIT_NORMALS_H
#define FROE_TREE_AUDIT_NORMALS_H
#include "geom/turn.h"
#include "support/array.h"

/** The normal one x other of two of the vectors; its image to length about 1, or 0 where there is none. */
typedef struct normals_ray {
    uint32_t one, other;
    double image[3];
} normals_ray;

/** What a thread works with; all zero but context and alloc at first. */
typedef struct normals {
    num_context *context;
    froe_allocator alloc;
    int dim;
    ARRAY(const double *) points; /**< first those of A, then those of B */
    uint32_t first;               /**< how many of them are of A */
    ARRAY(geom_vector) vectors;   /**< the axes, then differences */
    ARRAY(normals_ray) rays;      /**< of the cone of normals left */
    ARRAY(double) padded;         /**< 2D: the points with a third coordinate 0 */
} normals;

void normals_free(normals *m);
/** *apart: is there a plane, not through all points, with A on its one closed side and B on the other? False, too,
 * where all points lie in one plane (2D: on one line). 2D and 3D, one point or more each. FROE_E_MEMORY. */
froe_status normals_apart(normals *m, bool *apart);
#endif
