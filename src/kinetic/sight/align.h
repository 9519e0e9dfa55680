/* align.h: the instants at which, as an eye sees them, a point passes the line of an edge, or the lines of three edges
 * pass through one point.
 *
 *        a                        a . r(b) x r(c) = 0: all three are seen in one line (degree 3; parallel 2; parabolas
 *      --+----- edge b c          parallel 4)
 *        |
 *      \ | / three edges          det(n, n', n'') = 0 with n = r(b) x r(c) for each of them (degree 6; parallel 4;
 *       \|/                       parabolas parallel 8)
 *
 * r(x) is the ray of x, as in geom/eye.h, times the denominator of x: a point at e sees  e W - X,  a parallel eye
 * towards d  (X_i d_k - X_k d_i, X_j d_k - X_k d_j, d_k W),  d_k the largest of d. A root counts where the point may
 * lie between the ends of the edge, and the common point between those of all three, by error bounds: one too many does
 * no harm. Time runs from 0 to 1 between `from` and `to`, in which no point changes its piece. */
#ifndef FROE_KINETIC_ALIGN_H
#define FROE_KINETIC_ALIGN_H
#include "kinetic/contact/walk.h"

typedef struct align_eye {
    bool parallel;
    int axis; /**< k: where |at| is largest; parallel only */
    double at[3];
} align_eye;

/** A vertex of the motion, or a point at rest. */
typedef struct align_point {
    motion_piece piece; /**< of a vertex */
    const double *rest; /**< NULL: it is a vertex */
    num_ball_poly ray[3];
} align_point;

/** What one search needs; large. */
typedef struct align_room {
    const froe_motion *motion;
    align_eye eye;
    double from, to;
    num_arena arena;
    num_isolation roots;
    uint64_t exact; /**< not decided by error bounds */
} align_room;

/** FROE_E_MEMORY. */
froe_status align_begin(align_room *room, const froe_motion *motion, const align_eye *eye);
void align_end(align_room *room);

/** Where the ray is with error bounds, for the time of the room. */
void align_ray(const align_room *room, align_point *point);
/** Of a point (count 3: point, edge) or of three edges (count 6): the instants, ascending, at most NUM_DEGREE + 1.
 * False: two are too close to be told apart. */
bool align_find(align_room *room, const align_point *const points[], int count, meet_time *out, int *found);
#endif
