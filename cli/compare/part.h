/* part.h: parts of a scene, to see how trees grow with it: the objects nearest its middle. */
#ifndef FROE_CLI_COMPARE_PART_H
#define FROE_CLI_COMPARE_PART_H
#include <froe/froe.h>

/** Every object once, from the middle of the scene outwards; to be freed. NULL without memory. O(n log n). */
uint32_t *part_order(const froe_scene *scene);
/** The first `count` objects of an order as a scene of their own, shapes only. As froe_scene_add(). */
froe_status part_new(const froe_scene *scene, const uint32_t *order, size_t count, froe_scene **out,
                     froe_diagnostic *diag);
/** A point of the object: the corner of that number, counted round and round. */
const double *part_corner(const froe_scene *scene, uint32_t object, uint32_t corner);
#endif
