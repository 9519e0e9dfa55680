/* enclosing.h: sizes of objects: smallest enclosing balls and diameters, in doubles. */
#ifndef FROE_MEASURE_ENCLOSING_H
#define FROE_MEASURE_ENCLOSING_H
#include "scene/scene.h"

typedef struct measure_ball {
    double centre[FROE_MAX_DIM], radius;
} measure_ball;

/** A power of 2: an object times it is about as large as 1; 1 where it has no extent. Its coordinates times it do not
 * overflow, and their differences are those of the object, times it: for squares and products of lengths. */
double measure_scale(const froe_scene *scene, uint32_t object);
/** The smallest ball around an object, up to rounding. Expected O(corners) and a few rounds more. */
measure_ball measure_enclosing(const froe_scene *scene, uint32_t object);
/** The greatest distance of two points of it. O(corners^2) for polygons and hulls. */
double measure_diameter(const froe_scene *scene, uint32_t object);
#endif
