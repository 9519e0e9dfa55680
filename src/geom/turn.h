/* turn.h: which way three points turn, in the plane or seen along an axis of space. */
#ifndef FROE_GEOM_TURN_H
#define FROE_GEOM_TURN_H
#include "num/context.h"

/** The turn at b of three points of the plane: 1 left, -1 right, 0 straight on or back. */
int geom_turn(num_context *context, const double *a, const double *b, const double *c);
/** The same for three points in space, seen along an axis. */
int geom_projected_turn(num_context *context, int axis, const double *a, const double *b, const double *c);
/** An axis along which three points do not look collinear; -1: they are. */
int geom_projection_axis(num_context *context, const double *a, const double *b, const double *c);

/** Are three points of space certainly not collinear? False: they may be all the same. For loops over many, which ask
 * num_rounding_trusted() once. */
bool geom_surely_turns(const double *a, const double *b, const double *c);

/** The vector from one point of space to another. */
typedef struct geom_vector {
    const double *from, *to;
} geom_vector;
/** Sign of (a x b) . c: how three vectors turn. */
int geom_turn_of_vectors(num_context *context, const geom_vector *a, const geom_vector *b, const geom_vector *c);
#endif
