/* gaze.h: an eye that rests, flies or turns, and the polynomials of where it is.
 *
 *        E.             what carries the eye has its centre at C and is turned by q(s) = (1 - s) q0 + s q1:
 *       /  '.           a place p in it is at  C + R p / |q|^2,  R = |q|^2 times the matrix of q, of degree 2 in time,
 *      C     '.         and so are the eye and the corners of the window; the direction towards a parallel eye is R a
 *
 * An eye that no plan moves is its own centre; where it is parallel, the centre is the origin. */
#ifndef FROE_KINETIC_GAZE_H
#define FROE_KINETIC_GAZE_H
#include "kinetic/motion/motion.h"
#include "num/poly.h"

typedef struct gaze {
    bool parallel;
    double at[3];     /**< the eye, or the direction towards it; in the body that carries it, if there is a rig */
    froe_motion *rig; /**< of that body alone, with one vertex; NULL: the eye rests */
} gaze;

/** Takes over where an eye is, and how it moves within the window of a motion. FROE_E_OPTIONS: the direction is 0, or
 * no number. FROE_E_INPUT: the plan does not cover the window. Others as froe_motion_add_body(). */
froe_status gaze_begin(gaze *g, const froe_motion *m, const froe_sight_options *o, froe_diagnostic *diag);
void gaze_end(gaze *g);

/** Degrees in time of where the centre is, and of the turn, at most. */
int gaze_flight(const gaze *g);
int gaze_turn(const gaze *g);

/** The eye between two times: it is at  C/w' + E/w,  or E is the direction towards it, and w is 0. Times as
 * motion_span_dyadic() has them. */
typedef struct gaze_ball {
    num_ball_poly centre[3], turn[3][3], square; /**< C, R, |q|^2 */
    num_ball whole;                              /**< w' */
    num_ball_poly at[3], w;                      /**< E, w */
} gaze_ball;
typedef struct gaze_exact {
    num_poly centre[3], turn[3][3], square;
    num_dyadic whole;
    num_poly at[3], w;
} gaze_exact;
void gaze_near(const gaze *g, double from, double to, gaze_ball *out);
void gaze_exactly(num_arena *arena, const gaze *g, double from, double to, gaze_exact *out);
#endif
