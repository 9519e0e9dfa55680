/* high.h: bodies of R^4 .. R^8: what geom/meet/ and geom/ray/ say of them. Those call this above dimension 3.
 *
 *     meet.c       do two convex sets meet, how far is a point from one, and where?   nearest.h
 *     contact.c    how do two polytopes meet?                                     nearest.h, program.h
 *     ray.c        where does a ray meet a polytope first?                        program.h
 *
 * One way for all polytopes: they differ in their corners alone. Guesses in doubles decide what they are sure of, exact
 * numbers the rest. */
#ifndef FROE_GEOM_HIGH_HIGH_H
#define FROE_GEOM_HIGH_HIGH_H
#include "geom/convex.h"
#include "geom/meet/contact.h"
#include "geom/ray/ray.h"
#include "num/root.h"

/** As geom_meet() and geom_meet_surely(), for lists and boxes. */
bool geom_high_meet(num_context *context, const geom_convex *a, const geom_convex *b);
bool geom_high_meet_surely(num_context *context, const geom_convex *a, const geom_convex *b);

/** The squared distance of a point from a polytope: an image, and the number, behind what the arena holds, up to half
 * of num_arena_bound. */
num_ball geom_high_square_image(num_context *context, const double *point, const geom_body *body);
num_ratio geom_high_square(num_context *context, const double *point, const geom_body *body);
/** As geom_foot(), for polytopes. */
void geom_high_foot(num_context *context, const double *point, const geom_body *body, double *out);

/** As geom_contact_of(), for two polytopes. */
geom_contact geom_high_contact(num_context *context, const geom_body *a, const geom_body *b);
/** As geom_body_rank(), for lists of corners. */
int geom_high_rank(num_context *context, const geom_body *body);

/** As geom_ray_meets(), for segments and hulls. The hit is a GEOM_BASIS. */
bool geom_high_ray(num_context *context, const geom_ray *ray, const geom_body *body, geom_hit *first);
/** The parameter of a GEOM_BASIS, behind what the arena holds; bottom > 0. */
num_ratio geom_high_parameter(num_arena *arena, const geom_ray *ray, const geom_hit *hit);
#endif
