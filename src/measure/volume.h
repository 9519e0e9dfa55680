/* volume.h: volumes of convex hulls. */
#ifndef FROE_MEASURE_VOLUME_H
#define FROE_MEASURE_VOLUME_H
#include "scene/scene.h"

/** Of a hull in the plane (its area) or in space, times `scale` (measure_scale), up to rounding; 0 if it is flat.
 * FROE_E_MEMORY. O(corners facets). */
froe_status measure_hull_volume(num_context *context, const froe_allocator *alloc, const froe_scene *scene,
                                uint32_t object, double scale, double *out);
#endif
