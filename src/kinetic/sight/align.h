/* align.h: the instants at which, as an eye sees them, a point passes the line of an edge, or the lines of three edges
 * pass through one point.
 *
 *          a                    with the eye at E/w (w = 0: it is parallel, and E the direction towards it), a point at
 *        --+----- edge          X/W, and the line of an edge  D = X_b W_a - X_a W_b,  M = X_a x X_b  (Pluecker), eye
 *          |                    and edge are in the plane  N . x = K,  N = w M + D x E,  K = M . E:
 *
 *        \ | / three edges      N . X - K W = 0
 *         \|/                   w (M x M') . N'' + N'' . (M x (D' x E) - M' x (D x E)) + K'' [D, D', E] = 0
 *
 * All is taken from the centre of what carries the eye (gaze.h). The first is linear in the eye, and the second the
 * quadric of all lines that meet the three (Pottmann and Wallner, "Computational Line Geometry", 2001): the
 * determinant of the three N is w times that. For the window's edges, of which at most one takes part, and which are
 * carried with the eye, N and K are divided by |q|^2. Degrees in time, where x is that of corners, or of the eye's
 * flight if that is greater, and t that of its turn (0, 2):
 *     seen from a point   3 x + t,  6 x + 2 t        parallel   2 x + t,  4 x + 2 t
 *
 * A root counts where the point may lie between the ends of the edge, and the common point between those of all three,
 * by error bounds: one too many does no harm. Time runs from 0 to 1 between `from` and `to`, in which no point changes
 * its piece. */
#ifndef FROE_KINETIC_ALIGN_H
#define FROE_KINETIC_ALIGN_H
#include "kinetic/contact/walk.h"
#include "kinetic/sight/crossing.h"
#include "kinetic/sight/gaze.h"

typedef struct align_ball_place {
    num_ball_poly x[3], w;
} align_ball_place;
typedef struct align_exact_place {
    num_poly x[3], w;
} align_exact_place;

typedef struct align_ball_line {
    num_ball_poly way[3], moment[3], normal[3], offset; /**< D, M, N, K */
} align_ball_line;
typedef struct align_exact_line {
    num_poly way[3], moment[3], normal[3], offset;
} align_exact_line;

/** A vertex of the motion, a point at rest, where triangles at rest cross, or a place in what carries the eye. */
typedef struct align_point {
    motion_piece piece;        /**< of a vertex */
    const double *rest;        /**< NULL: it is none at rest, and none that is carried */
    const crossing_end *cross; /**< NULL: it is no such point */
    bool carried;              /**< `rest` is that place */
    align_ball_place near;
} align_point;

typedef struct align_edge {
    const align_point *end[2];
    align_ball_line near;
} align_edge;

/** Two edges that cross before the eye: a third with the plane N . x = K passes their crossing where
 * N . at + K spread = 0. */
typedef struct align_ball_pair {
    num_ball_poly at[3], spread;
} align_ball_pair;
typedef struct align_exact_pair {
    num_poly at[3], spread;
} align_exact_pair;

typedef struct align_pair {
    const align_edge *edge[2];
    align_ball_pair near;
} align_pair;

/** What one search needs; large. */
typedef struct align_room {
    const froe_motion *motion;
    gaze gaze;
    gaze_ball near;
    gaze_exact exactly;
    align_exact_place places[2];
    align_exact_line lines[3];
    align_exact_pair pair;
    double from, to;
    num_arena arena;
    num_isolation roots;
    uint64_t exact; /**< not decided by error bounds */
} align_room;

/** Room for a motion and an eye, which is there, with points at rest of these coordinates, and points where triangles
 * cross if `crossings`. FROE_E_MEMORY. */
froe_status align_begin(align_room *room, const froe_motion *motion, const double *rest, size_t count, bool crossings);
void align_end(align_room *room);

/** Goes on to another time, within which no plan changes its piece. */
void align_go(align_room *room, double from, double to);
/** Where a point is with error bounds; an edge, whose ends are known; two edges, none of which is carried. */
void align_place(const align_room *room, align_point *point);
void align_line(const align_room *room, align_edge *edge);
void align_two(const align_room *room, align_pair *pair);
/** The ray from a point to the eye, as what carries the eye has it: that of the page; degree 4 at most. */
void align_ray(const align_room *room, const align_point *point, num_ball_poly ray[3]);

/** When a point passes an edge, or a third edge, which may be carried with the eye, the crossing of two: the instants,
 * ascending, at most NUM_DEGREE + 1. False: two are too close to be told apart. */
bool align_pass(align_room *room, const align_point *point, const align_edge *edge, meet_time *out, int *found);
bool align_meet(align_room *room, const align_pair *pair, const align_edge *third, meet_time *out, int *found);
#endif
