/* formulas.h: the formulas of predicate_body.inc for balls (*_ball), dyadic numbers (*_dyadic) and
 * dyadic numbers with infinitesimals (*_sheared), and the point that corners are measured from. */
#ifndef FROE_GEOM_FORMULAS_H
#define FROE_GEOM_FORMULAS_H
#include "geom/plane.h"
#include "num/ball.h"
#include "num/sheared.h"

static inline bool geom_has_points(const geom_plane *plane) {
    return plane->form == GEOM_POINTS || plane->form == GEOM_VERTICAL;
}

/** Is there a double point on it that needs no arithmetic? */
static inline bool geom_has_origin(const geom_plane *plane) {
    return plane->form == GEOM_AXIS || geom_has_points(plane);
}

#include "num/ball_terms.inc"
#define SHEAR(a) ((void)(a), num_ball_from(0))
#include "geom/predicate_body.inc"

#include "num/dyadic_terms.inc"
#define SHEAR(a) ((void)(a), (num_dyadic){0})
#include "geom/predicate_body.inc"

#define T num_sheared
#define FORMULA(f) f##_sheared
#define FROM(x) num_sheared_from(arena, x)
#define ADD(a, b) num_sheared_add(arena, a, b)
#define SUB(a, b) num_sheared_sub(arena, a, b)
#define MUL(a, b) num_sheared_mul(arena, a, b)
#define SHEAR(a) num_sheared_shear(a)
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
