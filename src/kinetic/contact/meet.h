/* meet.h: the times at which two moving objects meet, while no vertex changes its piece.
 *
 *     time    a |----====-----=---| b          = they meet: closed intervals, maybe single instants
 *
 * Whether two closed segments of the plane, or two closed triangles in space, meet is told by the signs of polynomials
 * in time. So all that happens, happens at roots of these; between two of them signs stay. Which polynomials, and what
 * their signs tell, is in meet_segments.c and meet_triangles.c; the roots in their order are the matter of walk.h. */
#ifndef FROE_KINETIC_MEET_H
#define FROE_KINETIC_MEET_H
#include "kinetic/motion/motion.h"

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

typedef struct walk_room walk_room;
typedef struct triangles_room triangles_room;

/** What one thread needs. */
typedef struct meet_worker {
    num_arena arena;
    meet_stats stats;
    walk_room *room;        /**< for polynomials and their roots */
    triangles_room *shapes; /**< in space: for what these are made of; NULL in the plane */
    const meet_span *spans; /**< what was found */
    int span_count;
} meet_worker;
/** Are the numbers of triangles along cubics so wide that chains of degree 9 or 10 would take minutes a pair? */
bool meet_is_too_wide(const froe_motion *m);
/** FROE_E_MEMORY. */
froe_status meet_worker_new(const froe_motion *m, meet_worker *out);
void meet_worker_free(const froe_motion *m, meet_worker *worker);

/** Finds all spans between the times a <= b, ascending. REQUIRES: both objects live and no knot of theirs lies between.
 * FROE_E_LIMIT: two events are too close to be told apart (2^-2047 of the time between a and b). */
froe_status meet_find(const froe_motion *m, meet_worker *worker, uint32_t p, uint32_t q, double a, double b);

/** The two kinds of objects, for meet.c. False: too close. */
bool meet_segments(const froe_motion *m, meet_worker *worker, const motion_object *p, const motion_object *q);
bool meet_triangles(const froe_motion *m, meet_worker *worker, const motion_object *p, const motion_object *q);
/** Bytes of a triangles_room. */
size_t meet_triangles_bytes(void);
#endif
