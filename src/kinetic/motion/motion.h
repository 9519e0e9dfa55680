/* motion.h: the internal form of flight plans: knots, pieces between them, and where a vertex is at a tick.
 *
 *     tick u  =  the time  begin + u 2^power,   0 <= u <= last_tick <= 2^52
 *
 *     knots   o------o---------o-----o         times are any doubles, not ticks in general
 *     ticks   | | | | | | | | | | | | |
 *             1 1 1 1 2 2 2 2 2 3 3 3 3        the piece a tick belongs to: the last that begins at or before it
 *
 * Positions are homogeneous, (X/W, Y/W) or (X/W, Y/W, Z/W) with W > 0. A linear piece p0 -> p1 has
 *     X = p0 (t1-t) + p1 (t-t0),   W = t1-t0,
 * a quadratic or cubic one Bezier's form with the squares or cubes; so knots are met exactly from both sides, and
 * nothing is divided.
 *
 * It speaks for motion.c, motion_add.c (plans enter a motion), place.c (where a vertex is) and parabolas.c (a motion
 * without bodies). */
#ifndef FROE_KINETIC_MOTION_H
#define FROE_KINETIC_MOTION_H
#include "num/ball.h"
#include "num/dyadic.h"
#include "num/wide.h"
#include "support/array.h"
#include <froe/kinetic.h>
#include <math.h>

typedef struct motion_knot {
    double time, at[3], control[3]; /**< as many as the motion has dimensions, the others 0; control[0] NaN: the piece
                                         that begins here is linear */
    int64_t tick;                   /**< the first at or after `time`; far away: +- MOTION_FAR */
    int16_t unit, bits; /**< of times while the piece lasts, measured from its ends: whole multiples of 2^unit, below
                             2^bits of them */
    uint32_t second;    /**< of the motion's `seconds`, or FROE_NONE: no cubic begins here */
} motion_knot;

/** The second control point of a cubic, in a table of its own, since few pieces have one. */
typedef struct motion_second {
    double at[3];
} motion_second;

#define MOTION_FAR ((int64_t)1 << 62)

typedef struct motion_plan {
    size_t first;   /**< knot */
    uint32_t count; /**< knots, >= 1 */
    uint32_t body;  /**< FROE_NONE, or it is one knot, whose place is that in the body */
} motion_plan;

typedef struct motion_turn {
    double q[4]; /**< x, y, z, w; its product with the one before is positive */
} motion_turn;

/** The flight of the centre, and as many turns as it has knots. */
typedef struct motion_body {
    motion_plan plan;
    size_t turns; /**< the first */
} motion_body;

typedef struct motion_object {
    uint32_t vertices[3]; /**< as many as the motion has dimensions, the others FROE_NONE */
    uint32_t group;
    double birth, death; /**< clipped to the window */
    int64_t first, last; /**< ticks at which it is there; first > last: none */
    uint64_t tag;
} motion_object;

struct froe_motion {
    froe_allocator alloc;
    int dim; /**< 2: objects are segments, 3: triangles; an object has as many vertices */
    double begin, end;
    int power;               /**< a tick is 2^power, power >= -1074 */
    int64_t last_tick;       /**< the last in the window */
    int unit, top;           /**< all coordinates are multiples of 2^unit, below 2^top in size */
    int time_unit, time_top; /**< all times, alike */
    uint64_t edition;        /**< changes when plans change or knots may move in memory */
    ARRAY(motion_knot) knots;
    ARRAY(motion_second) seconds;
    ARRAY(motion_plan) plans; /**< [vertex] */
    ARRAY(motion_object) objects;
    ARRAY(motion_body) bodies;
    ARRAY(motion_turn) turns;
    froe_scene *names; /**< a scene of groups alone */
};

/** "segment" or "triangle": what the objects of a motion are, for messages. */
const char *motion_noun(const froe_motion *m);

/** The first tick at or after a time / the last at or before it; beyond +-2^62: +-MOTION_FAR. Exact. */
int64_t motion_tick_after(const froe_motion *m, double time);
int64_t motion_tick_before(const froe_motion *m, double time);

/** Gives a vertex another plan; `life` is what it has to cover: two times. What it replaces stays in memory. The
 * same failures as froe_motion_add(), then nothing is changed. */
froe_status motion_replan(froe_motion *m, uint32_t vertex, size_t count, const double *times, const double *coords,
                          const double *controls, const double *second_controls, const double life[2],
                          froe_diagnostic *diag);

/* ------------------------------------------------------------------ pieces -- */

enum { MOTION_DEGREE = 3, MOTION_TERMS = MOTION_DEGREE + 1 };

/** 1, 2 or 3: of the piece that begins at a knot. REQUIRES: it is not the last of its plan. */
static inline int motion_knot_degree(const motion_knot *knot) {
    return isnan(knot->control[0]) ? 1 : knot->second == FROE_NONE ? 2 : MOTION_DEGREE;
}

typedef struct motion_piece {
    const motion_knot *from, *to; /**< equal: it stands still */
    int degree;                   /**< 0 to MOTION_DEGREE */
    const double *second;         /**< the second control point of a cubic, else NULL */
    int64_t last;                 /**< the last tick that belongs to it; MOTION_FAR: it ends with the plan */
    const double *corner;         /**< NULL, or the place in a body whose centre flies as said */
    const motion_turn *turn;      /**< of that body at `from` (and, if to is not from, then at `to`) */
} motion_piece;

/** The piece a tick belongs to. REQUIRES: the plan covers it. O(log knots). */
motion_piece motion_piece_at(const froe_motion *m, uint32_t vertex, int64_t tick);
/** The last piece that begins at or before a time within the plan. */
motion_piece motion_piece_at_time(const froe_motion *m, uint32_t vertex, double time);
/** The piece after knot number `knot` of the vertex's plan. */
motion_piece motion_piece_after(const froe_motion *m, uint32_t vertex, uint32_t knot);

/* Each coordinate of a place, one after the other, and then its W: dim + 1 numbers. */
/** In units of 2^unit (of the motion) as stack integers of less than 2^126. False: too wide. */
bool motion_whole(const froe_motion *m, const motion_piece *piece, int64_t tick, num_short *out);
/** Always there. Takes less than 6000 limbs of the arena, for any finite doubles. */
void motion_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, num_dyadic *out);
/** With error bounds. */
void motion_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, num_ball *out);
/** The coordinates themselves, without W, each no further than the returned error from the truth (infinite if there is
 * no telling). */
double motion_near(const froe_motion *m, const motion_piece *piece, int64_t tick, double *out);

/** Extends lo .. hi, of the first `dim` coordinates, to hold the piece between two times, rounded outwards, to at most
 * +-DBL_MAX. */
void motion_extend(const froe_motion *m, const motion_piece *piece, double from, double to, int dim, double *lo,
                   double *hi);

/** The piece as polynomials in ticks s counted from `tick`:
 *     X = x[0] + x[1] s + x[2] s^2 + x[3] s^3,  Y and Z alike,  W = w (constant)
 * for degree + 1 coefficients; the others are 0, as is Z in the plane. The tick may lie anywhere. Less than
 * 12000 limbs. */
typedef struct motion_dyadic_curve {
    num_dyadic x[MOTION_TERMS], y[MOTION_TERMS], z[MOTION_TERMS], w;
} motion_dyadic_curve;
typedef struct motion_ball_curve {
    num_ball x[MOTION_TERMS], y[MOTION_TERMS], z[MOTION_TERMS], w;
    int power; /**< they are to be multiplied by 2^power, all of them */
} motion_ball_curve;
/** The same in the units of motion_whole(). */
typedef struct motion_whole_curve {
    num_short x[MOTION_TERMS], y[MOTION_TERMS], z[MOTION_TERMS], w;
} motion_whole_curve;
/** Each less than 2^126. False: too wide. */
bool motion_curve_whole(const froe_motion *m, const motion_piece *piece, int64_t tick, motion_whole_curve *out);
void motion_curve_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                         motion_dyadic_curve *out);
void motion_curve_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, motion_ball_curve *out);
/** The same in shares s of the time between two instants: t = from + s (to - from). */
void motion_span_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, double from, double to,
                        motion_dyadic_curve *out);
void motion_span_ball(const froe_motion *m, const motion_piece *piece, double from, double to, motion_ball_curve *out);

/* Bodies. All above is then about the centre, but for motion_near() and motion_extend(). A quaternion x, y, z, w that
 * turns in proportion to q, as polynomials in shares of the time:  q[i] = c[i][0] + c[i][1] s.  Returns the degree, 0
 * or 1. */
int motion_turn_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, double from, double to,
                       num_dyadic c[4][2]);
/** The same in ticks counted from `tick`. */
int motion_tick_turn_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                            num_dyadic c[4][2]);
/** The same in shares of `span` ticks from a tick on; and where the centre, or a vertex of no body, is. */
int motion_stretch_turn_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, double span,
                             num_ball c[4][2]);
void motion_stretch_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, double span,
                         motion_ball_curve *out);
int motion_turn_ball(const froe_motion *m, const motion_piece *piece, double from, double to, num_ball c[4][2]);

/** A vertex of a body between two times. With u from 0 to 1 in proportion to time it is at
 *     F(u) + N(u) / W(u),     W = |q|^2,
 * which are polynomials of degree 2 in Bezier's form: F has the control points flight[0..2], W the coefficients
 * weight[0..2] > 0, and N the control points weight[i] turned[i]. turned[1] is where the tangents of the arc meet. */
typedef struct motion_arc {
    num_ball flight[3][3], turned[3][3], weight[3];
} motion_arc;
void motion_arc_of(const froe_motion *m, const motion_piece *piece, double from, double to, motion_arc *out);
#endif
