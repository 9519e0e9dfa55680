/* walk.h: polynomials in time, their roots in order, and what holds at and between them.
 *
 *     f0   ---x-----------x-----        an event is a root of one polynomial or of several at once. At an event the
 *     f1   ---x------x----------        sign of a polynomial is 0, or else the same as just before it; between events
 *             ^      ^    ^             signs stay. So each sign at each instant is known from signs at dyadic numbers
 *           event  event event
 *
 * Time runs from 0 to 1 between the instants `from` and `to`. */
#ifndef FROE_KINETIC_WALK_H
#define FROE_KINETIC_WALK_H
#include "kinetic/contact/meet.h"
#include "num/isolate.h"

enum {
    WALK_POLYNOMIALS = 96, /* that may be asked for a sign */
    WALK_LISTED = 81,      /* of these, whose roots are events */
    WALK_EVENTS = WALK_LISTED * NUM_DEGREE
};

typedef struct walk_event {
    num_isolated *at;
    uint64_t vanishing[2]; /**< the bits of the polynomials whose root it is */
} walk_event;

struct walk_room {
    double from, to;
    num_poly f[WALK_POLYNOMIALS];
    signed char sign[WALK_POLYNOMIALS]; /**< all the time; NUM_UNSURE: not known, and then f[i] is needed */
    bool listed[WALK_POLYNOMIALS], has_near[WALK_POLYNOMIALS];
    num_ball_poly near[WALK_POLYNOMIALS]; /**< of f, where it has been needed */
    num_isolation roots[WALK_LISTED];
    walk_event events[WALK_EVENTS];
    int root_count, event_count;
    meet_span spans[WALK_EVENTS + 2];
    int first[WALK_EVENTS + 2], last[WALK_EVENTS + 2]; /**< of each span: its events; -1: from, event_count: to */
    int span_count;
};

/** An instant: a dyadic share of the time, or an event, and then a share just before it, after the event before. */
typedef struct walk_moment {
    num_dyadic share;
    num_ball near;           /**< the share */
    const walk_event *event; /**< NULL: share */
} walk_moment;

/** Do they meet? */
typedef bool walk_fn(void *user, const walk_moment *at);

/** Begins anew: no sign is known, nothing is listed. */
void walk_begin(walk_room *w, double from, double to);
/** Finds the roots of a polynomial as events. False: two are too close to be told apart. */
bool walk_list(num_arena *arena, walk_room *w, int i);
/** The sign of polynomial i. */
int walk_sign(num_arena *arena, walk_room *w, const walk_moment *at, int i);
walk_moment walk_start(void);
walk_moment walk_end(num_arena *arena);
/** The time of a share of the time between two instants, which it narrows. False: too close to another. */
bool walk_time(num_arena *arena, double from, double to, num_isolated *root, meet_time *out);
/** Goes through both ends, all events and the gaps between them, and finds the spans. False: too close. */
bool walk_through(num_arena *arena, walk_room *w, walk_fn *meets, void *user);
#endif
