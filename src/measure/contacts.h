/* contacts.h: how two objects touch, exactly. */
#ifndef FROE_MEASURE_CONTACTS_H
#define FROE_MEASURE_CONTACTS_H
#include "scene/scene.h"

typedef enum measure_contact {
    MEASURE_APART,      /**< disjoint, or in a way that is no defect: common corners and edges */
    MEASURE_CROSSING,   /**< relative interiors meet, in less than the objects' own dimension; or edges touch, see below
                         */
    MEASURE_T_JUNCTION, /**< interiors do not meet, but a corner of one lies in the other and is none of its corners */
    MEASURE_OVERLAP,    /**< they share a piece of their own dimension */
    MEASURE_CONTACTS
} measure_contact;

/** Two different segments of a scene in R^2 (form segment). */
measure_contact measure_segments(num_context *context, const froe_scene *s, uint32_t a, uint32_t b);
/** Two different polygons of a scene in R^3 (form polygon). They cross when they pierce each
 * other, and when they meet in less: an edge of one touches the other where neither has a corner,
 * and no corner of one lies in the other but common ones. `sides` has room for the corners of both. */
measure_contact measure_polygons(num_context *context, const froe_scene *s, uint32_t a, uint32_t b, signed char *sides);
#endif
