/* kinetic.h: segments of the plane and triangles in space that move, exactly. Part of the core library.
 *
 *     froe_motion *motion;
 *     froe_motion_options w = froe_motion_defaults();
 *     w.begin = 0;  w.end = 60;
 *     froe_motion_new(&w, NULL, &motion, NULL);
 *     froe_moving b = froe_moving_defaults();
 *     b.vertex_count = 2 * n;  b.count = n;  b.starts = starts;  b.times = times;  b.coords = xy;
 *     froe_motion_add(motion, &b, NULL);
 *     ...  froe_motion_free(motion);
 *
 * Between two instants of its flight plan a vertex moves as a polynomial in time of degree 1, 2 or 3. Times and
 * coordinates are taken exactly, as the doubles given; no position is ever rounded before it decides anything.
 */
#ifndef FROE_KINETIC_H
#define FROE_KINETIC_H

#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ motion -- */

/** Vertices with flight plans, and objects that they are the corners of: in the plane segments, in space triangles. */
typedef struct froe_motion froe_motion;

typedef struct froe_motion_options {
    size_t size;       /**< set by froe_motion_defaults() */
    unsigned dim;      /**< 2 (default): segments of the plane; 3: triangles in space */
    double begin, end; /**< the window: the time that is considered, begin < end. No default */
    double tick;       /**< the grid of time that a kinetic structure walks on: a power of 2, at most 2^52 of them in
                            the window. 0 (default): 2^31 to 2^32 ticks in the window */
} froe_motion_options;
FROE_DEFAULTS(froe_motion_options, froe_motion_defaults);

/** A motion without objects. alloc is copied; NULL: malloc. FROE_E_ARG: options or out is NULL. FROE_E_INPUT: the
 * window is empty, endless or NaN. FROE_E_OPTIONS: there is no such dimension, or the tick is none. FROE_E_MEMORY. */
FROE_API froe_status froe_motion_new(const froe_motion_options *options, const froe_allocator *alloc, froe_motion **out,
                                     froe_diagnostic *diag);
FROE_API void froe_motion_free(froe_motion *motion);

/** A rigid body. In space, at times[i] its centre is at coords[3 i ..], and it is turned by the quaternion
 * turns[4 i ..] = x, y, z, w; in the plane, the centre is at coords[2 i ..], and the turn is turns[2 i ..] = z, w: the
 * sine and the cosine of half of its angle, counterclockwise. Between two times the centre moves as a vertex does
 * (froe_moving), and the turn goes along a rational arc: with u from 0 to 1 in proportion to time, by the quaternion
 *     q(u) = (1 - u) q0 + u q1,   divided by its length.
 * It passes the same orientations as a spherical interpolation ("slerp"), about one axis, and is ahead of it or behind
 * by at most 0.04 degrees where q0 and q1 are 30 degrees apart, 0.3 at 60 and 1 at 90. Of q1 and -q1, which turn alike,
 * that one counts whose product with q0 is positive. Each place of the body stays exactly as far from the centre as it
 * is in the body, whatever the lengths of q0 and q1. */
typedef struct froe_body {
    size_t size;            /**< set by froe_body_defaults() */
    size_t count;           /**< times, at least 1 */
    const double *times;    /**< strictly increasing */
    const double *coords;   /**< of the centre: x, y (and z) for each time */
    const double *controls; /**< as in froe_moving, but never of cubics; NULL: straight */
    const double *turns;    /**< (x, y,) z, w for each time; NULL: it does not turn */
} froe_body;
FROE_DEFAULTS(froe_body, froe_body_defaults);
/** Adds a body, which is nothing but a place for vertices (froe_moving.bodies); *id: 0, 1, ... FROE_E_INPUT: a number
 * is NaN or infinite; times do not increase; the square of a quaternion's length, x x + y y + z z + w w in doubles from
 * left to right, is not within 2^-20 of 1; two turns that follow one another are half a turn apart, which does not tell
 * the way: their product, computed alike, is within 2^-20 of 0. FROE_E_ARG, FROE_E_OPTIONS, FROE_E_LIMIT,
 * FROE_E_MEMORY. */
FROE_API froe_status froe_motion_add_body(froe_motion *motion, const froe_body *body, uint32_t *id,
                                          froe_diagnostic *diag);

/** A batch of moving objects, as arrays the caller keeps. In the plane, vertex v passes the points
 *     coords[2 i], coords[2 i + 1]  at  times[i],   i = starts[v] .. starts[v+1]-1,
 * in between on a straight line at constant speed, or, where controls[2 i], controls[2 i + 1] is not NaN, on the
 * parabola with that control point (Bezier's form):
 *     p(t) = ((t1-t)^2 p0 + 2 (t1-t)(t-t0) c + (t-t0)^2 p1) / (t1-t0)^2
 * so a body that starts at p0 with velocity v has c = p0 + v (t1-t0) / 2. Where second_controls[2 i],
 * second_controls[2 i + 1] is no NaN either, it moves on the cubic with both control points:
 *     p(t) = ((t1-t)^3 p0 + 3 (t1-t)^2 (t-t0) c + 3 (t1-t) (t-t0)^2 d + (t-t0)^3 p1) / (t1-t0)^3
 * so one that starts with velocity v and ends with velocity w has c = p0 + v (t1-t0) / 3, d = p1 - w (t1-t0) / 3. A
 * vertex with one time never moves.
 * Segment j joins the vertices vertices[2 j] and vertices[2 j + 1] of the batch; segments may share vertices.
 * In space there are three numbers for each time, and triangle j has the corners vertices[3 j] to vertices[3 j + 2]. A
 * vertex of a body has one time, which does not matter: its coordinates are those in the body, from the centre, before
 * the turn. The corners of a triangle, and the ends of a segment, are all of one body, or of none. */
typedef struct froe_moving {
    size_t size;                   /**< set by froe_moving_defaults() */
    size_t vertex_count;           /**< flight plans */
    const size_t *starts;          /**< vertex_count + 1 offsets into times */
    const double *times;           /**< strictly increasing in each plan */
    const double *coords;          /**< x, y (and z) for each time */
    const double *controls;        /**< as many for each time but each plan's last (ignored); NULL: all pieces linear */
    const double *second_controls; /**< alike, and NaN where controls are; NULL: no piece is cubic */
    size_t count;                  /**< objects: segments or triangles */
    const uint32_t *vertices;      /**< 2 a segment, 3 a triangle; NULL: each number once, in order */
    const uint32_t *bodies;        /**< of each vertex, or FROE_NONE; NULL: none */
    const double *births;          /**< count times at which objects appear; NULL: with the window, as is -INFINITY */
    const double *deaths;          /**< last times at which they are there; NULL: with the window, as is INFINITY */
    const uint64_t *tags;          /**< the caller's names; NULL: each object's own id */
    const uint32_t *groups;        /**< group of each object; NULL: `group` for all */
    uint32_t group;                /**< FROE_NONE: no group */
} froe_moving;
FROE_DEFAULTS(froe_moving, froe_moving_defaults); /**< none, no groups */

/** Adds a batch: all of it, or on failure none of it. Objects have the ids 0, 1, ... in the order they were added, and
 * so have vertices. FROE_E_INPUT: a coordinate or time is NaN or infinite, times do not increase, a vertex has no plan
 * or one that does not cover the part of the window in which its objects live, an object dies before it appears, two
 * corners of a triangle are one vertex or of two bodies, there is no such body, a vertex of a body has a plan of its
 * own, a piece has a second control point and no first. FROE_E_ARG, FROE_E_OPTIONS, FROE_E_LIMIT, FROE_E_MEMORY.
 * O(times + objects). */
FROE_API froe_status froe_motion_add(froe_motion *motion, const froe_moving *batch, froe_diagnostic *diag);

/** As froe_scene_add_group(). */
FROE_API froe_status froe_motion_add_group(froe_motion *motion, const froe_group *group, uint32_t *id);
/** Strings live as long as no group is added. */
FROE_API froe_group froe_motion_group(const froe_motion *motion, uint32_t group);
FROE_API size_t froe_motion_group_count(const froe_motion *motion);

FROE_API size_t froe_motion_object_count(const froe_motion *motion);
FROE_API size_t froe_motion_vertex_count(const froe_motion *motion);
FROE_API size_t froe_motion_body_count(const froe_motion *motion);
/** The body that a vertex belongs to, or FROE_NONE. */
FROE_API uint32_t froe_motion_vertex_body(const froe_motion *motion, uint32_t vertex);
/** As much of the window, and of the length of a tick, as a caller has room for, who gives the size that the struct has
 * in his program. */
FROE_API void froe_motion_window_into(const froe_motion *motion, froe_motion_options *out, size_t size);
/** The window, and the length of a tick. */
static inline froe_motion_options froe_motion_window(const froe_motion *motion) {
    froe_motion_options window;
    froe_motion_window_into(motion, &window, sizeof window);
    return window;
}

/** One object, by value. */
typedef struct froe_moving_object {
    uint32_t vertices[3]; /**< the third of a segment, and all for an id out of range: FROE_NONE */
    double birth, death;  /**< within the window; birth > death: never there */
    uint32_t group;
    uint64_t tag;
} froe_moving_object;
FROE_API froe_moving_object froe_motion_object(const froe_motion *motion, uint32_t object);

/** One instant of a vertex's plan. */
typedef struct froe_moving_knot {
    double time, at[3]; /**< the third of the plane: 0 */
    double control[3];  /**< of the piece that begins here; NaN: linear, or the last instant */
    double second[3];   /**< its second control point; NaN: it is no cubic */
} froe_moving_knot;
FROE_API size_t froe_motion_knot_count(const froe_motion *motion, uint32_t vertex);
/** Of a vertex of a body, knot 0 is where it is in the body. REQUIRES: vertex and knot in range. O(1). */
FROE_API froe_moving_knot froe_motion_knot(const froe_motion *motion, uint32_t vertex, size_t knot);

/** One instant of a body. */
typedef struct froe_body_knot {
    double time, at[3], control[3]; /**< as of a vertex */
    double turn[4];                 /**< x, y, z, w: as given, or negated; in the plane x and y are 0 */
} froe_body_knot;
FROE_API size_t froe_motion_body_knot_count(const froe_motion *motion, uint32_t body);
/** REQUIRES: body and knot in range. O(1). */
FROE_API froe_body_knot froe_motion_body_knot(const froe_motion *motion, uint32_t body, size_t knot);

/** Where a vertex is at a time, for output: x, y and, in space, z, each within a few units in the last place of the
 * greatest coordinate nearby. False (nothing written): its plan does not cover the time. O(log knots). */
FROE_API bool froe_motion_position(const froe_motion *motion, uint32_t vertex, double time, double *at);

/** A motion with the same groups, vertices and objects, by the same numbers, but without bodies. The vertices of
 * bodies fly along parabolas of their own instead: each is never farther than `deviation` > 0 from where its body
 * has it, and *reached (may be NULL) is a bound that holds and is hardly ever more than three times the truth. At each
 * instant a body is as an affine map has it, up to 2^-20 of the deviation: so parts of a body that keep apart go on
 * doing so. Between two instants of a body there are as many parabolas as that takes: about the cube root of its size
 * divided by the deviation, within the window. Corners that are in one place of one body become one vertex, the first
 * of them. What belongs to no body stays exactly as it is. So partitions in space can follow bodies that turn, which
 * froe_kinetic_new() refuses there.
 * FROE_E_ARG: the deviation is not a number above 0. FROE_E_LIMIT: doubles, or instants, are too far apart for this
 * deviation; the body is named. FROE_E_MEMORY. O(instants of all vertices of the result). */
FROE_API froe_status froe_motion_without_bodies(const froe_motion *motion, double deviation,
                                                const froe_allocator *alloc, froe_motion **out, double *reached,
                                                froe_diagnostic *diag);

/* ---------------------------------------------------------------- contacts -- */

/** Two objects meet, as closed segments or triangles, from one instant to another: a maximal interval. Its ends are
 * certain: between the two doubles given for each, which are equal where the instant is known exactly and neighbours or
 * nearly so otherwise. */
typedef struct froe_contact {
    uint32_t a, b;             /**< objects, a < b */
    double begin[2], end[2];   /**< low <= true time <= high; neither of begin above that of end */
    bool instant;              /**< they meet at one instant alone: they pass or graze one another */
    bool since_start, to_stop; /**< they meet already when the time asked for, or the later of both, begins; they
                                    still meet when it, or the earlier, ends */
} froe_contact;

typedef struct froe_contact_statistics {
    uint64_t boxes;      /**< boxes in the plane or space, and in time, that the objects were put in */
    uint64_t candidates; /**< pairs of them that touch */
    uint64_t exact;      /**< of these, not decided by doubles with error bounds */
    uint64_t reserved[5];
} froe_contact_statistics;

typedef struct froe_contact_options {
    size_t size;     /**< set by froe_contact_defaults() */
    double from, to; /**< the time asked for; NaN (default): as the window */
    bool first;      /**< only what may be the first contact of all: one, or several whose beginnings
                          two doubles cannot tell apart */
    bool apart;      /**< leave out pairs of objects of one group */
    bool neighbours; /**< in space: tell of triangles that share vertices, too, while they have more in common than
                          these vertices and what is between them. Where that begins or ends at an instant at which
                          one of them has no area, the instant counts. false (default): leave them out */
    froe_contact_statistics *statistics; /**< filled in on FROE_OK; may be NULL */
    unsigned threads;                    /**< 0: one per processor */
    froe_progress_fn *progress;          /**< may be NULL */
    void *user;                          /**< for progress */
} froe_contact_options;
FROE_DEFAULTS(froe_contact_options, froe_contact_defaults); /**< all contacts in the window */

/** Receives one contact; false stops, which is no failure. */
typedef bool froe_contact_fn(void *user, const froe_contact *contact);

/** All contacts between moving objects, in the order of their beginnings (low, high, a, b). None is missed, however
 * short, grazing ones included: candidates come from boxes in space and time, times from the roots of exact polynomials
 * (degree up to 4 in the plane, 6 with bodies or cubics, 8 with both; in space 3, with bodies that turn 5, along
 * parabolas 6, of a body and a triangle whose corners fly along parabolas each for itself 8, of corners on cubics 9,
 * and with a body 10). Triangles may lie in one plane, and may have no area, at an instant or always. Objects that
 * share a vertex always meet there, and are left out (but see `neighbours`), as are two of one body. options NULL: the
 * defaults. FROE_E_OPTIONS: from > to, or outside the window. FROE_E_LIMIT: two things happen within 2^-2047 of the
 * time between two knots; or in space a vertex flies along a cubic, and numbers are as wide as coordinates of 400 bits
 * with times of 180. FROE_E_UNSUPPORTED: neighbours in the plane. FROE_E_MEMORY, FROE_E_CANCELLED.
 * O(n log^2 n + candidates). */
FROE_API froe_status froe_motion_contacts(const froe_motion *motion, const froe_contact_options *options,
                                          froe_contact_fn *fn, void *user, froe_diagnostic *diag);

/** Receives an instant between two doubles, which are equal or a few units in the last place of the window apart; false
 * stops. */
typedef bool froe_sight_fn(void *user, double low, double high);

typedef struct froe_sight_options {
    size_t size;           /**< set by froe_sight_defaults() */
    double at[3];          /**< the eye, or, if it is parallel, the direction towards it, not 0. No default */
    bool parallel;         /**< default false: it is a point */
    const double *window;  /**< four points, the corners of the page in order; NULL (default): there is no page */
    const froe_body *body; /**< the eye and the window move as this body has it, whose plan covers the window of the
                                 motion: `at` and `window` are places in the body, or `at` a direction in it. NULL
                                 (default): both rest */
    double from, to;       /**< the time asked for; NaN (default): as the motion's window */
    const uint8_t *seen;   /**< per object: something of it is seen when that time begins; NULL (default): of all */
    const uint32_t *pairs; /**< pairs of objects at rest, pair_count: where they pass through one another there are
                                 edges, too; NULL (default): none */
    size_t pair_count;
} froe_sight_options;
FROE_DEFAULTS(froe_sight_options, froe_sight_defaults);

/** The instants at which what an eye sees of triangles may change, ascending: a corner passes an edge, among them that
 * of its own triangle, which then turns its other side to the eye; or three edges pass through one point, as the eye
 * sees them. Each is a root of an exact polynomial of degree 12 at most. As long as what is seen is what `seen` says,
 * no change is missed where no triangles touch, and of triangles that touch none if they are at rest and among `pairs`;
 * froe_motion_contacts() tells when they do. There may be instants at which nothing changes. Those closer than
 * neighbouring doubles are one. Seen from a point, corners and the eye may fly along parabolas, or straight if the eye
 * turns. A parallel eye may fly along parabolas and turn, and corners may fly along parabolas, or along cubics if the
 * eye does not turn. FROE_E_OPTIONS: not from _defaults(), times that are not in order or not within the window of the
 * motion, an eye that is nowhere. FROE_E_ARG: something is NULL. FROE_E_INPUT: a pair is none at rest; the eye's plan
 * does not cover the window; otherwise as froe_motion_add_body(). FROE_E_UNSUPPORTED: the motion is of the plane, an
 * object is of a body, or an object or the eye flies otherwise. FROE_E_LIMIT: two things happen within 2^-2047 of the
 * time between two knots. FROE_E_MEMORY. O(edges corners + candidates). */
FROE_API froe_status froe_motion_sights(const froe_motion *motion, const froe_sight_options *options, froe_sight_fn *fn,
                                        void *user, froe_diagnostic *diag);

/* --------------------------------------------------------------- partition -- */

/** A cylindrical partition of a motion (Agarwal, Erickson and Guibas, "Kinetic BSPs for intersecting segments and
 * disjoint triangles", SODA 1998) that is kept right while time goes on. At the tick that it has reached, it has
 * exactly the nodes that the builder `cylindrical` would make of the same segments in the same order. */
typedef struct froe_kinetic froe_kinetic;

typedef struct froe_kinetic_options {
    size_t size;           /**< set by froe_kinetic_defaults() */
    uint64_t seed;         /**< of the order in which segments cut; default 1 */
    const uint32_t *order; /**< all objects, the first to cut first; NULL: random. Motion must not depend on it */
    uint64_t epoch; /**< a fresh random order after so many events, against motion that adapts itself to the order;
                         0 (default): never. Not with `order` */
    uint64_t swap;  /**< two random objects change places in the order after each so many events, for the same reason;
                         `order` may be given. 0 (default): never. In the plane */
    froe_progress_fn *progress; /**< may be NULL: see froe_kinetic_watch() */
    void *user;                 /**< for progress */
    bool augmented; /**< a segment that turns upright costs nothing, however many it crosses: walls are named in its
                         direction, not left and right. false (default); not in space */
    bool unchecked; /**< in space: the first contact of triangles is not looked for. Where triangles meet the partition
                         is not what it should be from then on. false (default): it ends before that */
    unsigned threads; /**< of froe_kinetic_advance(), which changes neither the partition nor the events, nor their
                         order, and of the tree of froe_kinetic_snapshot(). 0: one per processor; default: 1. With more
                         than one, events are found `ahead`. Time goes on by one thread in space, with `epoch`, `swap`
                         or `augmented`, with few segments, and as long as segments lie in one line */
    bool ghosts; /**< in space: of two triangles that meet, the one with the greater number is left out from just before
                      that until it meets none any more that is there; what is told is `touch` of both, `disappear` and
                      `appear`. So scenes that meet from the start are followed, too. false (default): the partition
                      ends before the first contact. Not with `unchecked` */
    bool ahead;  /**< events may be found ahead on one thread, too, which is sooner among thousands of segments. Then
                     `visit` asks for nothing but froe_kinetic_time() and froe_kinetic_instant(), and what
                     froe_kinetic_stats tells of the work is more. false (default) */
} froe_kinetic_options;
FROE_DEFAULTS(froe_kinetic_options, froe_kinetic_defaults);

/** The partition at the first odd tick of the window; in space of triangles, as seen from above, along z. They must
 * not meet, and those that share vertices must have nothing else in common: froe_kinetic_advance() ends before the
 * first contact (froe_contact_options.neighbours). In space the partition is made anew where the plans of more than one
 * triangle in eight take other pieces at a tick. Bodies are followed in the plane, exactly; in space they are refused
 * with FROE_E_UNSUPPORTED (froe_motion_without_bodies() replaces them), as are questions but those straight up and
 * down; a snapshot answers the others. The motion must outlive it. Until it is freed, plans are changed and objects
 * added by the functions below only. FROE_E_ARG: motion, options or out is NULL. FROE_E_OPTIONS: the order is not one,
 * or the options are not from froe_kinetic_defaults(). FROE_E_INPUT: two triangles meet at the start; both are named.
 * FROE_E_UNSUPPORTED, FROE_E_MEMORY, FROE_E_CANCELLED. In space, unless `unchecked`, the failures of
 * froe_motion_contacts(), and its time.
 * Expected O(n log^2 n + k log n) for n segments with k crossings. */
FROE_API froe_status froe_kinetic_new(froe_motion *motion, const froe_kinetic_options *options,
                                      const froe_allocator *alloc, froe_kinetic **out, froe_diagnostic *diag);
FROE_API void froe_kinetic_free(froe_kinetic *kinetic);
/** Sets the progress function of all later calls that take this partition, in place of that of the options; NULL: none.
 * They call it now and then, unless they take no more than a moment, with the share of the time that has been gone
 * through (advance) or done (snapshot), or else with 0. If it returns false, they return FROE_E_CANCELLED. A change
 * that was cancelled, or ran out of memory, has been made to the motion; the partition is made anew by the next call,
 * which therefore may take longer and fail in the same way. */
FROE_API void froe_kinetic_watch(froe_kinetic *kinetic, froe_progress_fn *progress, void *user);

/** What happens at an instant. In the plane, wherever two segments begin or cease to meet and something passes, a
 * contact or a batch says so. Where plans go on or lives begin or end at that very instant, these changes may be all
 * that is told. Nothing is told of segments that touch and go back, and of segments in one line behind a third. */
typedef enum froe_event_kind {
    FROE_EVENT_VERTICES = 0,        /**< a vertex passes over or under another; in space all is as seen from above */
    FROE_EVENT_VERTEX_CROSSING = 1, /**< a vertex passes over or under a crossing */
    FROE_EVENT_CROSSINGS = 2,       /**< a crossing passes over or under another */
    FROE_EVENT_CONTACT = 3,         /**< an end of a segment meets another segment, or one in its line */
    FROE_EVENT_TRIPLE = 4,          /**< three segments meet in one point */
    FROE_EVENT_TURN = 5,            /**< the ends of a segment change sides */
    FROE_EVENT_BATCH = 6,           /**< several of these at once, at the same place or one above the other; or points
                                     that pass so closely, within two ticks, that they may meet */
    FROE_EVENT_PLAN = 7,            /**< the flight of a segment takes another piece */
    FROE_EVENT_APPEAR = 8,
    FROE_EVENT_DISAPPEAR = 9,
    FROE_EVENT_FLOP = 10,  /**< in space: a triangle turns over, as seen from above */
    FROE_EVENT_TOUCH = 11, /**< in space: two triangles meet, and the partition ends before that */
    FROE_EVENT_KINDS = 12
} froe_event_kind;
FROE_API const char *froe_event_name(froe_event_kind kind);

typedef struct froe_event {
    froe_event_kind kind;
    uint32_t objects[4];   /**< the segments it is about; of several that share a vertex, one */
    unsigned object_count; /**< may be more than 4 for batches: the others are not in `objects` */
    uint32_t edges[4];     /**< in space, where `objects` are triangles: the edges it is about, as seen from above; each
                                is 3 object + the number of the corner that it goes on from */
    unsigned edge_count;   /**< alike; 0 in the plane, and where it is about triangles as a whole */
    int64_t tick;          /**< at which the partition has changed */
    double early, late;    /**< the times of the tick before and of this one, to the nearest double: it happened in
                                between. froe_kinetic_instant() gives it more closely */
} froe_event;

/** Called for each event, in order of time. false: froe_kinetic_advance returns when the tick is done. */
typedef bool froe_event_fn(void *user, const froe_event *event);

/** Lets time go on to `time`, rounded up to an odd tick, and keeps the partition right; `visit` (may be NULL) is called
 * for each event. FROE_E_ARG: the time is before the present or after the window. FROE_E_MEMORY: call again, or free
 * it; events of the last tick may not have been told. FROE_E_CANCELLED: `visit` returned false, and the partition is
 * that right after the event; or the progress function did, and it is that of some moment before `time`.
 * FROE_E_INPUT: two triangles meet before that; they are named, `visit` is called for them, and the partition is that
 * of the last tick before. Expected polylogarithmic in n for each event, if the motion does not depend on the order. */
FROE_API froe_status froe_kinetic_advance(froe_kinetic *kinetic, double time, froe_event_fn *visit, void *user,
                                          froe_diagnostic *diag);
/** For visitors, while they are called for an event: when it happened, between two doubles that are next to one another
 * or equal. Of a batch, when one of its certificates failed; of changes of plans, appearances and disappearances, no
 * more than the ticks before and after. Certain: out[0] <= true time <= out[1]. FROE_E_ARG: there is no event. Some 30
 * microseconds. */
FROE_API froe_status froe_kinetic_instant(froe_kinetic *kinetic, double out[2], froe_diagnostic *diag);
/** The time of the tick that the partition has reached. */
FROE_API double froe_kinetic_time(const froe_kinetic *kinetic);
/** The time of the tick of the next event at the earliest; INFINITY: nothing happens in the rest of the window. */
FROE_API double froe_kinetic_next(const froe_kinetic *kinetic);

/** Objects added to the motion meanwhile take part from now on. Those whose time has come appear at once. */
FROE_API froe_status froe_kinetic_update(froe_kinetic *kinetic, froe_diagnostic *diag);
/** Gives a vertex another plan from now on, as in froe_moving: `count` times, coordinates, controls (NULL: linear) and
 * second controls (NULL: no cubic). Where it is now may change: then its segments leave here and appear there. The
 * failures of froe_motion_add, and then nothing is changed. FROE_E_UNSUPPORTED: the vertex belongs to a body. */
FROE_API froe_status froe_kinetic_replan(froe_kinetic *kinetic, uint32_t vertex, size_t count, const double *times,
                                         const double *coords, const double *controls, const double *second_controls,
                                         froe_diagnostic *diag);
/** Takes an object out, for good. FROE_E_ARG: there is no such object. */
FROE_API froe_status froe_kinetic_remove(froe_kinetic *kinetic, uint32_t object, froe_diagnostic *diag);

/* Questions about the present. The partition is that just after its tick, and so are the segments in answers:
 * where they are at the tick, and an infinitesimal while later. So what touches at the tick alone, because it is about
 * to part or to cross, is told apart as it is afterwards. The points of a question do not move. Only `on` is about the
 * tick itself. Of segments that lie in one line where they overlap, the first in the order of cuts
 * is the answer. Segments without length are not met; those that die at the tick itself are still there. Questions use
 * memory of the partition's, so they are for one thread at a time. FROE_E_ARG: a coordinate is NaN or infinite.
 * FROE_E_MEMORY. */

/** Where a point is among the segments. */
typedef struct froe_kinetic_place {
    uint32_t on;           /**< a segment that the point lies on at the tick, ends included, or FROE_NONE */
    uint32_t above, below; /**< the next ones straight up and down, just after the tick, or FROE_NONE. The way up is
                                inclined to the left, by less than any number: of what it only touches, it passes an
                                upright segment and a left end, and meets a right end; the way down is inclined to the
                                right, and meets a left end. With a segment in `on`: both that one */
} froe_kinetic_place;
/** Exact. Expected O(log n), and where something coincides at the tick the number of walls through the point's x. */
FROE_API froe_status froe_kinetic_locate(froe_kinetic *kinetic, const double at[2], froe_kinetic_place *out,
                                         froe_diagnostic *diag);
/** The same in space, of triangles, straight up and down in z. `on` contains the point at the tick, borders included.
 * A point above or below a border is taken as moved in y, and by much less back in x, by less than any number: so it
 * meets one of two triangles that share an edge, and no upright one. From far above, `below` is what is seen there.
 * Triangles without area whose corners are straight above one another, or in one place, are not met, not even by `on`.
 * FROE_E_UNSUPPORTED: the partition is one of the plane. Expected O(log^2 n), and where something coincides at the tick
 * the number of walls, and of triangles in one plane, through the point. */
FROE_API froe_status froe_kinetic_locate_in_space(froe_kinetic *kinetic, const double at[3], froe_kinetic_place *out,
                                                  froe_diagnostic *diag);
/** The first segment met, just after the tick, on the way from one point to another, ends included; FROE_NONE: none. Of
 * those met at one point, any. Exact. Expected O(log n + segments and walls passed). */
FROE_API froe_status froe_kinetic_ray(froe_kinetic *kinetic, const double from[2], const double to[2], uint32_t *hit,
                                      froe_diagnostic *diag);

/** A fragment: what lies between two walls of the partition. `ends` are x, y, x, y, at the tick, roughly: within a few
 * units in the last place where the walls are not nearly parallel to it. false stops. */
typedef bool froe_kinetic_order_fn(void *user, uint32_t object, const double ends[4]);
/** All fragments, those behind first: what comes later is never hidden, seen from the eye just after the tick, by what
 * came before. A segment that the eye is on comes after all that is on its two sides. O(nodes). FROE_E_MEMORY. */
FROE_API froe_status froe_kinetic_order(froe_kinetic *kinetic, const double eye[2], froe_kinetic_order_fn *visit,
                                        void *user, froe_diagnostic *diag);

/** A fragment of a triangle: what lies over a trapezoid. Its corners, x, y, x, y and so on, counterclockwise from the
 * lower left, may coincide; they are as rough as the `ends` above. false stops. */
typedef bool froe_kinetic_layers_fn(void *user, uint32_t object, const double corners[8]);
/** In space: all fragments, those below first: what comes later is never hidden, seen from above just after the tick,
 * by what came before. Upright triangles have none. FROE_E_UNSUPPORTED: the partition is one of the plane. O(nodes).
 * FROE_E_MEMORY. */
FROE_API froe_status froe_kinetic_layers(froe_kinetic *kinetic, froe_kinetic_layers_fn *visit, void *user,
                                         froe_diagnostic *diag);

/* Snapshots. Where a vertex is at a tick is a quotient of whole numbers, and a double only where it happens to be one.
 */

/** A whole number: sign * sum limbs[i] 2^(64 i). */
typedef struct froe_whole {
    int sign;              /**< -1, 0, 1 */
    size_t count;          /**< 0 iff sign is 0; the last limb is not 0 */
    const uint64_t *limbs; /**< of the table that it is from */
} froe_whole;
/** In decimal digits, '\0' at the end; no more than `size` bytes. Returns how many digits and signs there are. */
FROE_API size_t froe_whole_text(const froe_whole *number, char *out, size_t size);

/** The point (x / w, y / w), w > 0; x, y and w have no power of 2 in common. */
typedef struct froe_exact_place {
    froe_whole x, y, w;
    bool rounded; /**< x / w or y / w is no double, and in the tree it is the nearest to it */
} froe_exact_place;

/** Where the ends of all objects of a snapshot are, exactly. */
typedef struct froe_places froe_places;
FROE_API void froe_places_free(froe_places *places);          /**< may be NULL */
FROE_API size_t froe_places_count(const froe_places *places); /**< objects */
/** End 0 or 1 of an object of the snapshot's scene. Valid as long as the table. false: there is no such end. */
FROE_API bool froe_places_end(const froe_places *places, uint32_t object, int end, froe_exact_place *out);

typedef struct froe_snapshot_options {
    size_t size; /**< set by froe_snapshot_defaults() */
    bool refuse; /**< rather none than one with rounded places (default: false) */
    bool places; /**< with the table of exact places (default: true) */
    int up;      /**< in space: the axis that points up in pictures of the tree, 0, 1 or 2 (default), as of
                      froe_scene_set_up() */
} froe_snapshot_options;
FROE_DEFAULTS(froe_snapshot_options, froe_snapshot_defaults);

typedef struct froe_snapshot {
    froe_tree *tree;     /**< built by the method `cylindrical`, in the same order of cuts (in space with
                        edges=given), over a scene of its own. Object
                        i of the scene is the i-th of those that are there; tags are the motion's. The caller's */
    froe_places *places; /**< NULL if not asked for, and in space. The caller's */
    size_t rounded;      /**< vertices that are not where the tree has them, but less than a double's last place off */
    bool alike; /**< the tree has, node for node, the cuts of the partition, as if nothing had been rounded, and as if
                   the partition stood at the tick. Not where something coincides at the tick and not just after it, and
                   not if there are segments without length: they are in the tree, and not in the partition. Nor in
                   space, if there are triangles without area: in the tree they are segments */
    uint64_t reserved[4];
} froe_snapshot;

/** The present as an ordinary tree, for all other questions: the segments where they are at the tick itself, not just
 * after it. Its coordinates are doubles, each the nearest to the truth; where that is no double, `rounded` counts it,
 * `alike` tells whether it made a difference to the partition, and `places` keeps the truth. FROE_E_UNSUPPORTED:
 * something would have to be rounded, and that is to be refused; the first object is named. FROE_E_OPTIONS: there is no
 * such axis. FROE_E_MEMORY, and the failures of froe_build(). */
FROE_API froe_status froe_kinetic_snapshot(froe_kinetic *kinetic, const froe_snapshot_options *options,
                                           froe_snapshot *out, froe_diagnostic *diag);

/** Checks all certificates, and each node against a partition made from scratch. FROE_E_INPUT: something is wrong;
 * FROE_E_MEMORY. For tests: as expensive as a new one. */
FROE_API froe_status froe_kinetic_audit(froe_kinetic *kinetic, froe_diagnostic *diag);

typedef struct froe_kinetic_stats {
    uint64_t events[32];    /**< of each kind */
    uint64_t surgeries;     /**< of slabs */
    uint64_t batches;       /**< groups of certificates that failed together */
    uint64_t crowds;        /**< groups with more at one place than the certificates name, or points that coincide */
    uint64_t free_turns;    /**< without any surgery */
    uint64_t restarts;      /**< of the whole tree */
    uint64_t stuck;         /**< ticks that could not be settled: always 0 */
    uint64_t nodes_touched; /**< split, joined or made */
    uint64_t certificates_made; /**< whose time of failure had to be found */
    size_t nodes, certificates; /**< at present */
    uint32_t height;            /**< of the tree in nodes, at present */
    uint64_t reserved[8];
} froe_kinetic_stats;
/** O(nodes). */
FROE_API froe_kinetic_stats froe_kinetic_statistics(const froe_kinetic *kinetic);

#ifdef __cplusplus
}
#endif
#endif
