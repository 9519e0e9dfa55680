/* now.h: where everything is at the tick that a kinetic structure has come to, and just after it.
 *
 *     tick  ----+----+----+----          The structure is right just after each tick that it stands at: what is
 *               u \                      equal at u is ordered by where it is at u + an infinitesimal. If it
 *                  u+                    is still equal then, it stays so until a flight plan takes another piece.
 *
 * Points go by name: a vertex, where the lines of two segments cross, or a line x = c that does not move. They are
 * ordered by x and then y, as if all vertical lines were slightly inclined (see num/sheared.h): x + eps y.
 *
 * It speaks for now.c (places, order, sides, claims), course.c (pieces of plans in doubles), judge.c (order and sides
 * exactly), turning.c (where bodies turn), along.c (order along a segment), failure.c (when a claim fails) and limit.c
 * (places for output). */
#ifndef FROE_KINETIC_NOW_H
#define FROE_KINETIC_NOW_H
#include "kinetic/motion/poly.h"
#include "kinetic/now/name.h"
#include "num/context.h"
#include <math.h>

/** A vertex on its way: a piece of its plan in doubles, x[0] + x[1] s and what bends it, with s = tick - base.
 * Coefficients of s^2 and s^3 are kept elsewhere, so that this is a cache line. */
typedef struct now_course {
    int64_t base, last; /**< ticks of the piece for which it holds; base > last: not looked up yet */
    double x[2], y[2];
    double error;    /**< no coordinate is further off while it holds */
    uint32_t degree; /**< 0 to 3, or NOW_TURNING: it is of a body in the plane, and the rest is 0 */
} now_course;
enum { NOW_TURNING = MOTION_DEGREE + 1 };

/** Roughly where a point is: no coordinate is further off than `error`. */
typedef struct now_spot {
    double x, y, error;
} now_spot;

/** What is needed less often: the place of the piece, and the coefficients of s^2 and s^3. */
typedef struct now_bend {
    double x[2], y[2];
    double z[MOTION_TERMS], error; /**< in space: the height as a polynomial, and how far off it is at most */
    motion_piece piece;
    int64_t tick; /**< of a body in the plane: the last at which its place was asked for, which is `spot` */
    now_spot spot;
} now_bend;

enum { NOW_TOP = 190 }; /* products of five differences stay below 2^1000, wherever the motion is */

typedef struct now_memory {
    name_point name;
    int64_t tick;
    now_spot spot;
} now_memory;
enum { NOW_MEMORY_BITS = 10, NOW_MEMORIES = 1 << NOW_MEMORY_BITS };

typedef struct now_segment {
    uint32_t end[2]; /**< vertices */
    uint32_t origin; /**< the object; of an edge in space 3 object + its number, in the first triangle that has it */
    bool turned;     /**< end[1] is on the left */
    bool surface;    /**< of a triangle in space: no segment */
} now_segment;

/** In space: a triangle as the partition takes it, as three edges, which are segments as seen from above, and a
 * surface. Edges that triangles share are one segment, and the numbers of segments are in the order of triangles. */
typedef struct now_face {
    uint32_t vertex[3];
    uint32_t edge[3]; /**< segments; edge i from corner i on */
    uint32_t next[3]; /**< 3 object + i: the next triangle with this edge, or FROE_NONE */
    uint32_t surface; /**< segment */
    bool ghost;       /**< it is left out, as it meets another one (ghost.h) */
    bool leaves;      /**< while it is found out which are to be left out: this one */
} now_face;

/** The numbers that decide where doubles do not: integers of 128 bits, of 320, or dyadic numbers (judge.c). */
typedef enum now_stage { NOW_SHORT, NOW_WIDE, NOW_DYADIC, NOW_STAGES } now_stage;

enum { NOW_POINTS = 8 };
/** The vertices of a question, in one kind of number; large. */
typedef union now_points {
    short_point narrow[NOW_POINTS];
    wide_point wide[NOW_POINTS];
    exact_point exact[NOW_POINTS];
} now_points;

typedef struct now_state {
    froe_motion *motion;
    uint64_t edition; /**< of the motion when courses, bends and memories were computed */
    int lift;         /**< all places in doubles, those of `line` too, are times 2^lift, and less than 2^NOW_TOP so;
                           exact numbers are as they are */
    double lifts[2];  /**< powers of two whose product is 2^lift, which may be beyond all doubles; the second is not
                           less than 1 */
    double duration;  /**< of a tick, a power of two */
    int64_t tick;
    double line[2];
    ARRAY(now_course) courses;   /**< [vertex]; the last two are ends of a question */
    ARRAY(now_bend) bends;       /**< [vertex] */
    ARRAY(now_segment) segments; /**< in the plane [object]; the last joins these two */
    ARRAY(now_face) faces;       /**< in space [object] */
    motion_knot asked[2];        /**< where they are */
    now_memory *memories;        /**< of crossings, by a hash of their names */
    num_context context;
    now_stage least;             /**< where judging begins; tests begin with each */
    now_points *points;          /**< of the question that is judged */
    uint64_t judged[NOW_STAGES]; /**< questions that doubles left open, by the stage that decided them */
    bool lost;                   /**< the crossing of parallel lines was asked for */
    bool tied;                   /**< a comparison was equal at the tick, and perhaps not just after it */
} now_state;

froe_status now_new(froe_motion *motion, const froe_allocator *alloc, now_state *out);
void now_free(now_state *now);
/** Room for all that the motion has by now. */
froe_status now_grow(now_state *now);
/** Forgets what it has stored about plans, if the motion has got others since. Every public function calls this
 * first. */
void now_catch_up(now_state *now);
/** The segment of a question: from one point to another, of the motion's dimension, which do not move. It is not in the
 * tree. The points are the vertices `end` of the segment that is returned. */
uint32_t now_ask(now_state *now, const double *from, const double *to);
static inline bool now_is_question(const now_state *now, uint32_t segment) {
    return segment + 1 == now->segments.count;
}

/** Which end of a segment is on the left (side 0) or right (1): 0 or 1. */
static inline int now_end(const now_state *now, uint32_t segment, int side) {
    return side ^ (int)now->segments.data[segment].turned;
}
static inline uint32_t now_vertex(const now_state *now, uint32_t segment, int side) {
    return now->segments.data[segment].end[now_end(now, segment, side)];
}
static inline bool now_is_surface(const now_state *now, uint32_t segment) {
    return now->segments.data[segment].surface;
}
static inline bool now_is_in_space(const now_state *now) {
    return now->motion->dim == 3;
}
/** The segment that stands for an object: in space its surface. */
static inline uint32_t now_segment_of(const now_state *now, uint32_t object) {
    return now_is_in_space(now) ? now->faces.data[object].surface : object;
}
/** The object that a segment stands for; of an edge in space the first triangle that has it. */
static inline uint32_t now_object_of(const now_state *now, uint32_t segment) {
    const now_segment *s = now->segments.data + segment;
    return now_is_in_space(now) && !s->surface ? s->origin / 3 : s->origin;
}
/** In space: the triangle of a surface. */
static inline const now_face *now_face_of(const now_state *now, uint32_t surface) {
    return now->faces.data + now->segments.data[surface].origin;
}
/** In space: the triangle after one that has the same edge, by corners: 3 object + number of the edge. An edge's
 * `origin` is its first. FROE_NONE: there is none. */
static inline uint32_t now_next_corner(const now_state *now, uint32_t corner) {
    return now->faces.data[corner / 3].next[corner % 3];
}
static inline bool now_has_end(const now_state *now, uint32_t segment, uint32_t vertex) {
    const uint32_t *end = now->segments.data[segment].end;
    return end[0] == vertex || end[1] == vertex;
}
/** Is a triangle left out, as it meets another one? */
static inline bool now_is_ghost(const now_state *now, uint32_t object) {
    return now_is_in_space(now) && now->faces.data[object].ghost;
}
/** Does an object's life hold the present tick, and is it not left out? */
static inline bool now_is_alive(const now_state *now, uint32_t object) {
    const motion_object *o = now->motion->objects.data + object;
    return o->first <= now->tick && now->tick <= o->last && !now_is_ghost(now, object);
}
/** The last odd tick of the window. */
static inline int64_t now_last_tick(const now_state *now) {
    return (now->motion->last_tick - 1) | 1;
}
/** a / b, b > 0. */
static inline num_ball now_divide(num_ball a, num_ball b) {
    double q = a.x / b.x, least = b.x - b.e;
    if (!(least > 0)) return (num_ball){q, (double)INFINITY};
    return (num_ball){q, ((a.e + fabs(q) * b.e) / least + fabs(q) * 0x1p-52) * NUM_BALL_UP + NUM_BALL_TINY};
}
/** A tick as a time. */
static inline double now_time_of(const now_state *now, int64_t tick) {
    return now->motion->begin + (double)tick * now->duration;
}

/* face.c */
/** Numbers the edges and surfaces of the motion's triangles that have no numbers yet. FROE_E_MEMORY. */
froe_status now_grow_faces(now_state *now);
/** 1, 0, -1: just after the tick a triangle turns left, is upright for as long as its pieces last, turns right, as seen
 * from above. */
int now_area(now_state *now, uint32_t object);
/** 1, -1: triangle s is above or below t just after the tick. 0: they lie in one plane, or touch, for as long as the
 * pieces last. REQUIRES: they do not cross, and overlap as seen from above. */
int now_above(now_state *now, uint32_t s, uint32_t t);
/** 1, -1: a vertex is above or below the plane of a triangle just after the tick. 0: in it, or the triangle is upright,
 * for as long as the pieces last. */
int now_over(now_state *now, uint32_t object, uint32_t vertex);

/* turning.c */
/** As now_vertex_spot() and now_speed(), of a vertex whose piece of its body has been looked up. */
now_spot now_turning_spot(now_state *now, uint32_t vertex);
double now_turning_speed(now_state *now, uint32_t vertex);

/* course.c */
/** As now_vertex_spot() and now_speed(), of a vertex that does not fly straight and has been looked up. */
now_spot now_bent_spot(now_state *now, uint32_t vertex);
double now_bent_speed(now_state *now, uint32_t vertex);
/** Looks up the piece that the present tick belongs to. */
void now_look_up(now_state *now, uint32_t vertex);
/** Trials of later ticks do not leave the piece. */
static inline const now_course *now_course_of(now_state *now, uint32_t vertex) {
    const now_course *c = now->courses.data + vertex;
    if (now->tick > c->last || now->tick < c->base) now_look_up(now, vertex);
    return c;
}
/** Of a course that is straight. */
static inline now_spot now_straight_spot(const now_state *now, const now_course *c) {
    const double s = (double)(now->tick - c->base);
    return (now_spot){c->x[0] + s * c->x[1], c->y[0] + s * c->y[1], c->error};
}
static inline double now_straight_speed(const now_course *c) {
    const double x = fabs(c->x[1]), y = fabs(c->y[1]);
    return (x > y ? x : y) * (1 + 0x1p-20);
}
static inline now_spot now_vertex_spot(now_state *now, uint32_t vertex) {
    const now_course *c = now_course_of(now, vertex);
    return c->degree > 1 ? now_bent_spot(now, vertex) : now_straight_spot(now, c);
}
/** Where a vertex is, and now_speed(). */
static inline now_spot now_vertex_flight(now_state *now, uint32_t vertex, double *speed) {
    const now_course *c = now_course_of(now, vertex);
    *speed = c->degree > 1 ? now_bent_speed(now, vertex) : now_straight_speed(c);
    return c->degree > 1 ? now_bent_spot(now, vertex) : now_straight_spot(now, c);
}
/** Up to and including which tick the flight of a vertex is one polynomial. */
int64_t now_course_last(now_state *now, uint32_t vertex);
/** No coordinate of the vertex changes by more in a tick, as long as its piece lasts. */
static inline double now_speed(now_state *now, uint32_t vertex) {
    const now_course *c = now_course_of(now, vertex);
    return c->degree > 1 ? now_bent_speed(now, vertex) : now_straight_speed(c);
}
/** A coordinate times 2^lift; of little ones what is lost is less than NUM_BALL_TINY. */
static inline double now_lifted(const now_state *now, double x) {
    return x * now->lifts[0] * now->lifts[1];
}
/** A coordinate from one times 2^lift. */
static inline double now_lowered(const now_state *now, double x) {
    return ldexp(x, -now->lift);
}
/** The doubles next to where a vertex is at the tick. True: that is where it is. */
bool now_round(now_state *now, uint32_t vertex, double *out);
/** Where it is at the tick, and as polynomials from it on. */
void now_exact_at(now_state *now, uint32_t vertex, exact_point *out);
void now_exact_along(now_state *now, uint32_t vertex, exact_point *out);

/** The same of a vertex or a crossing. Resets the arena. */
void now_exact_named(now_state *now, name_point p, bool along, exact_point *out);

/* judge.c */
/** -1, 0, 1 as p is before, at or behind q, or POLY_PARALLEL; at the tick, or just after it. By y where x are equal, if
 * `both`. */
int now_judge_order(now_state *now, name_point p, name_point q, bool along, bool both);
int now_judge_side(now_state *now, uint32_t segment, uint32_t vertex, bool along);
/** Of the third vertex and the line through two; and, in space, of the fourth and the plane through three. */
int now_judge_turn(now_state *now, const uint32_t vertex[3], bool along);
int now_judge_volume(now_state *now, const uint32_t vertex[4], bool along);
/** Whether the second line of a crossing goes on to the left (1) or right (-1) of where the first goes; 0: parallel. */
int now_judge_lines(now_state *now, name_point crossing, bool along);

/* now.c */
/** The sign of ab x aq, from the coordinates as they are; NUM_UNSURE where rounding or their errors may matter. */
static inline int now_side_of_spots(now_spot a, now_spot b, now_spot q) {
    double ux = b.x - a.x, uy = b.y - a.y, vx = q.x - a.x, vy = q.y - a.y;
    double p = ux * vy, r = uy * vx, d = p - r, e = a.error + b.error, f = a.error + q.error;
    double sum_u = fabs(ux) + fabs(uy), sum_v = fabs(vx) + fabs(vy);
    double bound = (fabs(p) + fabs(r)) * 0x1p-50 + (sum_u * f + sum_v * e + 2 * e * f) * (1 + 0x1p-40) + NUM_BALL_TINY;
    return d > bound ? 1 : d < -bound ? -1 : NUM_UNSURE;
}
/** -1 or 1 as a is left or right of b; NUM_UNSURE where rounding or their errors may matter. */
static inline int now_order_of_spots(now_spot a, now_spot b) {
    const double d = a.x - b.x, error = (a.error + b.error + fabs(d) * 0x1p-52) * NUM_BALL_UP;
    return fabs(d) > error ? d < 0 ? -1 : 1 : NUM_UNSURE;
}
now_spot now_crossing_spot(now_state *now, name_point p);
/** REQUIRES: a vertex or a crossing. */
static inline now_spot now_spot_of(now_state *now, name_point p) {
    return p.b == NAME_VERTEX ? now_vertex_spot(now, p.a) : now_crossing_spot(now, p);
}
/** -1, 0, 1 as p is before, at or behind q just after now. 0: for as long as the pieces last. */
int now_compare(now_state *now, name_point p, name_point q);
/** 1, 0, -1: the vertex is above, on or below the line of a segment just after now. */
int now_side(now_state *now, uint32_t segment, uint32_t vertex);

/** What a certificate claims: p is before q; or the segment p.a (of b NAME_SEGMENT) has vertex q.a above or below it;
 * or p and q lie on one segment, and p is nearer to its end 0; or (q of b NAME_NONE) the second line of the crossing p
 * goes on to the left (above = 1) or right (-1) of where the first goes. */
typedef struct now_claim {
    name_point p, q;
    int above; /**< 1 or -1 for segments, NOW_ALONG for points of one segment */
} now_claim;
enum { NOW_ALONG = 2 };

static inline bool claim_is(const now_claim *c, const now_claim *d) {
    return name_is(c->p, d->p) && name_is(c->q, d->q) && c->above == d->above;
}

#define NOW_NEVER INT64_MAX
/** 1: the claim holds just after now; -1: it does not; 0 (segments): the vertex rides on the line, or lines are
 * parallel. */
int now_holds(now_state *now, const now_claim *claim);
/** The first odd tick after which the claim does not hold, or the present one, or after which the lines of a crossing
 * that it is about do not turn as they do now, as they were parallel in between; NOW_NEVER if none comes before the
 * flight of one of its vertices takes another piece. A function of the claim and of the plans: asked again
 * before that tick, it is the same. */
int64_t now_first_failure(now_state *now, const now_claim *claim);

/** The sign of both denominators just after now. REQUIRES: a claim about points. */
int now_judge_denominators(now_state *now, const now_claim *claim);
/** The polynomial behind a claim about time from now on: > 0 while it holds. In coordinate `axis` for points. */
void now_claim_exact(now_state *now, const now_claim *claim, int axis, poly_exact *out);
/** The same in integers that are wide enough for wide_variations() in so many ticks from now. False: there are none. */
bool now_claim_wide(now_state *now, const now_claim *claim, int axis, int64_t span, poly_wide *out);
/** Does it depend on the order of y, because x are the same for ever? Resets the arena. */
int now_claim_axis(now_state *now, const now_claim *claim);

/* limit.c */
/** Roughly where a point is. A point without a place at the tick is where it is just after it. */
void now_place_near(now_state *now, name_point p, double out[2]);
/** Roughly y of a segment where it has the x of a point, which is between its ends. */
double now_height_near(now_state *now, uint32_t segment, name_point p);

/* along.c */
/** The segment that two points lie on by their names: crossings with it, and ends of it; FROE_NONE: there is none, or
 * both are ends. */
uint32_t now_shared(const now_state *now, name_point p, name_point q);
/** A vertex, and a crossing of a segment that ends at it with another: which one? FROE_NONE: it is not so. */
uint32_t now_met_segment(const now_state *now, name_point p, name_point q);
/** As now_holds() and now_claim_exact(), of claims NOW_ALONG that hold. */
int now_along_holds(now_state *now, const now_claim *claim);
/** The sign just after now of what along.c calls the numerator; 0: it is 0 for as long as the pieces last. */
int now_along_sign(now_state *now, const now_claim *claim);
void now_along_exact(now_state *now, const now_claim *claim, poly_exact *out);
#endif
