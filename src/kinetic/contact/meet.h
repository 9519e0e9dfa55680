/* meet.h: the times at which two moving segments meet, while no vertex changes its piece.
 *
 *     time    a |----====-----=---| b          = they meet: closed intervals, maybe single instants
 *
 * Two closed segments p0p1 and q0q1 meet iff the signs of twelve polynomials in time allow it: of the four turns
 *     o0 = [p0 p1 q0], o1 = [p0 p1 q1], o2 = [q0 q1 p0], o3 = [q0 q1 p1]     (degree up to 4)
 * o0 o1 <= 0 and o2 o3 <= 0, and where all four are 0 also their bounding boxes overlap, which is up to the differences
 * of coordinates (degree up to 2). So all that happens, happens at roots of these; between two of them signs stay. */
#ifndef FROE_KINETIC_MEET_H
#define FROE_KINETIC_MEET_H
#include "kinetic/motion/motion.h"
#include "num/isolate.h"

enum { MEET_TURNS = 4, MEET_GAPS = 8, MEET_EVENTS = 4 * NUM_DEGREE };

/** An instant between two doubles, which are neighbours or nearly so, or known exactly (then they are equal). */
typedef struct meet_time {
    double low, high;
} meet_time;

/** They meet from `begin` to `end`, both included. */
typedef struct meet_span {
    meet_time begin, end;
    bool instant;            /**< they meet at one instant alone */
    bool from_start, to_end; /**< begin is the very first, end the very last instant asked for */
} meet_span;

typedef struct meet_stats {
    uint64_t pairs, exact; /**< asked for; not decided by error bounds */
} meet_stats;

/** What one thread needs. */
typedef struct meet_worker {
    num_arena arena;
    meet_stats stats;
    num_poly turn[MEET_TURNS], gap[MEET_GAPS];
    num_ball_poly near_gap[MEET_GAPS];
    num_isolation roots[MEET_GAPS];
    meet_span spans[MEET_EVENTS + 2]; /**< what was found */
    int span_count;
} meet_worker;
/** FROE_E_MEMORY. */
froe_status meet_worker_new(const froe_motion *m, meet_worker *out);
void meet_worker_free(const froe_motion *m, meet_worker *worker);

/** Finds all spans between the times a <= b, ascending. REQUIRES: both objects live and no knot of theirs lies between.
 * FROE_E_LIMIT: two events are too close to be told apart (2^-2047 of the time between a and b). */
froe_status meet_find(const froe_motion *m, meet_worker *worker, uint32_t p, uint32_t q, double a, double b);
#endif
