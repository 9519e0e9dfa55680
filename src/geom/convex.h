/* convex.h: closed convex sets, as all objects and ranges are: a core, given by corners,
 * and all points within a radius of it.
 *
 *     core     corners                                      radius 0                 radius > 0
 *     LIST     points by number                             point, segment, polygon, ball, capsule
 *                                                           simplex, hull
 *     BOX      the 2^dim corners between two points         box
 *     RAY      an origin, and origin + 2^power direction    ray, as far as matters
 *     PLANES   where planes of a list meet by threes        intersection of halfspaces, as far as matters
 *
 * Corners of PLANES have no exact doubles: `coords` are images, each within `error` of the true coordinate. */
#ifndef FROE_GEOM_CONVEX_H
#define FROE_GEOM_CONVEX_H
#include "geom/body.h"
#include "geom/plane.h"

typedef enum geom_core { GEOM_CORE_LIST, GEOM_CORE_BOX, GEOM_CORE_RAY, GEOM_CORE_PLANES } geom_core;

/** A corner of an intersection of halfspaces: three planes of its list with independent normals. */
typedef struct geom_meeting {
    uint32_t planes[3];
} geom_meeting;

typedef struct geom_convex {
    geom_core core;
    int dim;              /**< RAY, PLANES: 2 or 3 */
    uint32_t count;       /**< of corners; at least 1 */
    const double *coords; /**< dim doubles a point: the corners; lo and hi; origin and direction */
    const uint32_t *ids;  /**< numbers of points in coords; NULL: 0, 1, ... */
    double radius;
    int power;                    /**< RAY */
    double error;                 /**< PLANES */
    const geom_plane *planes;     /**< PLANES: of dim 3; in the plane they are vertical, and one is z = 0 */
    const geom_meeting *meetings; /**< PLANES: the corners */
} geom_convex;

/** Point i of those given, for cores of points. */
static inline const double *geom_convex_point(const geom_convex *c, uint32_t i) {
    return c->coords + (size_t)(c->ids ? c->ids[i] : i) * (size_t)c->dim;
}
/** Coordinate k of corner i; for lists and boxes. */
static inline double geom_convex_coordinate(const geom_convex *c, uint32_t i, int k) {
    return geom_convex_point(c, c->core == GEOM_CORE_BOX ? i >> k & 1 : i)[k];
}
/** A body. Its coordinates stay the body's. */
static inline geom_convex geom_convex_of(const geom_body *body) {
    return (geom_convex){.core = body->form == FROE_BOX ? GEOM_CORE_BOX : GEOM_CORE_LIST,
                         .dim = body->dim,
                         .count = geom_body_corners(body),
                         .coords = body->coords,
                         .ids = body->corners,
                         .radius = body->form == FROE_BALL ? body->radius : 0};
}
#endif
