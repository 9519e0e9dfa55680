/* volume.h: volumes of convex hulls. */
#ifndef FROE_MEASURE_VOLUME_H
#define FROE_MEASURE_VOLUME_H
#include "scene/scene.h"

/** Of a hull in the plane (its area) or in space, above dimension 3 of a simplex, times `scale` (measure_scale), up to
 * rounding; 0 if it is flat. FROE_E_MEMORY. FROE_E_UNSUPPORTED: above dimension 3 it has volume and more corners than a
 * simplex. O(corners facets). */
froe_status measure_hull_volume(num_context *context, const froe_allocator *alloc, const froe_scene *scene,
                                uint32_t object, double scale, double *out);
#endif
