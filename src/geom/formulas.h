/* formulas.h: the formulas of predicate_body.inc for balls (*_ball), dyadic numbers (*_dyadic) and
 * dyadic numbers with infinitesimals (*_sheared), and the point that corners are measured from. */
#ifndef FROE_GEOM_FORMULAS_H
#define FROE_GEOM_FORMULAS_H
#include "geom/plane.h"
#include "geom/turn.h"
#include "num/ladder.h"
#include "num/sheared.h"

static inline bool geom_has_points(const geom_plane *plane) {
    return plane->form == GEOM_POINTS || plane->form == GEOM_VERTICAL;
}

/** Is there a double point on it that needs no arithmetic? */
static inline bool geom_has_origin(const geom_plane *plane) {
    return plane->form == GEOM_AXIS || geom_has_points(plane);
}

/** What a ball is beside a plane that cuts its interior; a code of the formulas, apart from NUM_UNSURE. */
enum { GEOM_CUTS = 3 };

/** The side of a ball from the signs of f(centre) and f(centre)^2 - radius^2 |n|^2. A ball that touches a sheared plane
 * has points on both sides of it, or nearly. */
static inline int geom_ball_side(const geom_plane *h, int centre, int reach) {
    if (reach == -1 || (reach == 0 && geom_is_sheared(h))) return GEOM_CUTS;
    return reach == NUM_UNSURE ? NUM_UNSURE : centre;
}

#include "num/ball_terms.inc"

#include "geom/predicate_body.inc"

#include "num/dyadic_terms.inc"

#include "geom/predicate_body.inc"

#include "num/sheared_terms.inc"

#include "geom/predicate_body.inc"

/** Reorders three planes so that z, a point near their corner, lies on the first (unless none has an
 * origin). An axis plane alone takes its other coordinates from `near` (may be NULL). */
static inline void geom_corner_origin(const geom_plane *planes[3], const geom_plane *near, double z[3]) {
    int first = 0;
    for (int i = 2; i >= 0; i--)
        if (planes[i]->form == GEOM_AXIS) first = i;
    for (int i = 2; i >= 0; i--)
        if (geom_has_points(planes[i])) first = i;
    const geom_plane *s = planes[first], *anchor = geom_has_points(s) ? s : near;
    for (int k = 0; k < 3; k++) z[k] = anchor && geom_has_points(anchor) ? anchor->p[0][k] : 0;
    if (s->form == GEOM_AXIS) z[s->axis] = s->c;
    planes[first] = planes[0];
    planes[0] = s;
}
#endif
