/* polygon.h: from the corners a caller gives to a ring that spans a plane, exactly. */
#ifndef FROE_SCENE_POLYGON_H
#define FROE_SCENE_POLYGON_H
#include "num/context.h"

/** What is wrong with a ring: a clause as in "polygon 7 <reason>", and the vertex where it shows. */
typedef struct scene_fault {
    const char *reason;
    uint32_t vertex;
} scene_fault;

/** Brings a ring of *count >= 1 vertices (3 coordinates each in coords) into the form a
 * scene keeps: no two equal corners in a row, the first three not collinear. Zero area:
 * *form becomes segment or point, and ring the one or two extreme vertices. False: the
 * polygon is not planar, convex and simple; ring is then garbage. O(count), all exact. */
bool scene_polygon_form(num_context *context, const double *coords, uint32_t *ring, uint32_t *count, froe_kind *form,
                        scene_fault *fault);
/** Is it such a ring already? ring NULL: its vertices are 0, 1, ... */
bool scene_polygon_valid(num_context *context, const double *coords, const uint32_t *ring, uint32_t count);
#endif
