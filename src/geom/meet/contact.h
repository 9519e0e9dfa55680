/* contact.h: how do two bodies meet? Exact for every pair of kinds. In contact.c; polygons in contact_polygons.c.
 *
 *     cross     their relative interiors meet, in less than either's own dimension
 *     overlap   their relative interiors meet, in a piece of the lower one's dimension
 *     touch     they meet, but their relative interiors do not
 */
#ifndef FROE_GEOM_MEET_CONTACT_H
#define FROE_GEOM_MEET_CONTACT_H
#include "geom/body.h"

typedef enum geom_contact_kind { GEOM_APART, GEOM_CROSS, GEOM_TOUCH, GEOM_OVERLAP, GEOM_CONTACTS } geom_contact_kind;

/** Where bodies touch. What is said of corners and edges is found for segments in the plane and for
 * polygons; other pairs touch AT_CORNER or SOMEHOW. */
typedef enum geom_touch {
    GEOM_TOUCH_SOMEHOW,
    GEOM_TOUCH_AT_CORNER, /**< in nothing but one corner of both */
    GEOM_TOUCH_ALONG,     /**< in nothing but common corners and edges between them */
    GEOM_TOUCH_JUNCTION,  /**< a corner of one lies in the other and is none of its corners */
    GEOM_TOUCH_EDGES      /**< in edges, elsewhere than in corners */
} geom_touch;

typedef struct geom_contact {
    geom_contact_kind kind;
    geom_touch touch;
} geom_contact;

/** Of two bodies in the same dimension. `sides` has room for the corners of both (polygons only). */
geom_contact geom_contact_of(num_context *context, const geom_body *a, const geom_body *b, signed char *sides);

/** The same for two segments in the plane, for two polygons in space. */
geom_contact geom_contact_segments(num_context *context, const geom_body *a, const geom_body *b);
geom_contact geom_contact_polygons(num_context *context, const geom_body *a, const geom_body *b, signed char *sides);
#endif
