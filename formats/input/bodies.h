/* bodies.h: the polygons of a model as triangles of rigid bodies, or the segments of a plan.
 *
 * Parts of a model move; each is there for one life or for several, one after the other, and is another body in each:
 *
 *     part      0         1                       2
 *     starts    0         1                       4         5
 *     lives     |body 3   |body 4 |body 5 |body 6 |body 0   |
 */
#ifndef FROE_FORMATS_BODIES_H
#define FROE_FORMATS_BODIES_H
#include <froe/kinetic.h>

typedef struct formats_life {
    uint32_t body;
    double birth, death; /**< as in froe_moving */
} formats_life;

typedef struct formats_bodies {
    const size_t *starts; /**< of each part, and one more: its lives */
    const formats_life *lives;
    const uint32_t *parts; /**< of each object of the model */
} formats_bodies;

/** Adds the triangles of all objects, a fan for a polygon, in each life of their part, in the order of the objects.
 * Groups of the motion are those of the model. Each triangle has three corners of its own: triangles of one body never
 * meet. Segments of one body of the plane share the vertices that they have in common. FROE_E_UNSUPPORTED: an object is
 * no polygon, or no segment. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status formats_add_bodies(froe_motion *motion, const froe_scene *model, const formats_bodies *bodies,
                               const froe_allocator *alloc, froe_diagnostic *diag);
#endif
