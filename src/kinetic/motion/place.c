/* place.c: where a vertex is at a tick: as stack integers, as dyadic numbers, with error bounds, in doubles.
 *
 * Stack integers count coordinates in units of 2^unit of the whole motion, and times in a unit of the piece, in which
 * its ends, the window's and all ticks are whole. */
#include "base/floats.h"
#include "kinetic/motion/motion.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>

#define T num_dyadic
#define TURN
#define CURVE motion_dyadic_curve
#define FORMULA(f) f##_dyadic
#define POINT(x) num_dyadic_from(arena, x)
#define TIME(x) num_dyadic_from(arena, x)
#define ONE num_dyadic_scaled(arena, 1, 1, 0)
#define ADD(a, b) num_dyadic_add(arena, a, b)
#define SUB(a, b) num_dyadic_sub(arena, a, b)
#define MUL(a, b) num_dyadic_mul(arena, a, b)
#include "kinetic/motion/place_body.inc"

#define T num_ball
#define TURN
#define CURVE motion_ball_curve
#define FORMULA(f) f##_ball
#define POINT(x) num_ball_from(x)
#define TIME(x) num_ball_from(x)
#define ONE num_ball_from(1)
#define ADD(a, b) num_ball_add(a, b)
#define SUB(a, b) num_ball_sub(a, b)
#define MUL(a, b) num_ball_mul(a, b)
#include "kinetic/motion/place_body.inc"

/* x / 2^unit, which is whole. */
static num_short whole_of(double x, int unit) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    int power = (int)(bits >> 52 & 0x7ff);
    num_short mantissa = (num_short)(bits & 0xfffffffffffffu);
    if (power)
        mantissa |= (num_short)1 << 52;
    else
        power = 1;
    if (!mantissa) return 0;
    int shift = power - 1075 - unit;
    mantissa = shift >= 0 ? mantissa << shift : mantissa >> -shift;
    return bits >> 63 ? -mantissa : mantissa;
}

#define T num_short
#define CURVE motion_whole_curve
#define FORMULA(f) f##_whole
#define POINT(x) whole_of(x, m->unit)
#define TIME(x) whole_of(x, piece->from->unit)
#define ONE 1
#define ADD(a, b) ((a) + (b))
#define SUB(a, b) ((a) - (b))
#define MUL(a, b) ((a) * (b))
#include "kinetic/motion/place_body.inc"

static num_short whole_ticks(const froe_motion *m, const motion_piece *piece, int64_t ticks) {
    return piece->degree ? (num_short)ticks << (m->power - piece->from->unit) : 0;
}

bool motion_whole(const froe_motion *m, const motion_piece *piece, int64_t tick, num_short *out) {
    enum { MOST = 125 }; /* a sum of products with weights whose sum is W */
    if (m->top - m->unit + piece->degree * piece->from->bits > MOST) return false;
    place_at_whole(NULL, m, piece, whole_ticks(m, piece, tick), out);
    return true;
}

bool motion_curve_whole(const froe_motion *m, const motion_piece *piece, int64_t tick, motion_whole_curve *out) {
    enum { MOST = 122 }; /* a tick is no longer than the piece; twice a sum of four products, three times of four */
    const motion_knot *from = piece->from;
    if (piece->degree && m->power - from->unit > from->bits) return false;
    if (m->top - m->unit + piece->degree * from->bits > MOST) return false;
    curve_whole(NULL, m, piece, whole_ticks(m, piece, tick), whole_ticks(m, piece, 1), out);
    return true;
}

static num_dyadic dyadic_ticks(num_arena *arena, const froe_motion *m, int64_t ticks) {
    return num_dyadic_scaled(arena, 1, (uint64_t)ticks, m->power);
}

static num_ball ball_ticks(const froe_motion *m, int64_t ticks) {
    return num_ball_from(ldexp((double)ticks, m->power));
}

void motion_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick, num_dyadic *out) {
    place_at_dyadic(arena, m, piece, dyadic_ticks(arena, m, tick), out);
}

void motion_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, num_ball *out) {
    place_at_ball(NULL, m, piece, ball_ticks(m, tick), out);
}

void motion_curve_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                         motion_dyadic_curve *out) {
    curve_dyadic(arena, m, piece, dyadic_ticks(arena, m, tick), dyadic_ticks(arena, m, 1), out);
}

/* x 2^power */
static num_ball times_power(num_ball x, int power) {
    return (num_ball){ldexp(x.x, power), ldexp(x.e, power) + NUM_BALL_TINY};
}

/* Times that are very long or short are counted in the length of the piece: their powers might not be doubles. */
void motion_curve_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, motion_ball_curve *out) {
    enum { USUAL = 100 };
    num_ball h = ball_ticks(m, 1);
    weights_ball w = weights_at_ball(NULL, m, piece, ball_ticks(m, tick));
    int top = 0; /* frexp() need not set it for what is infinite */
    frexp(w.a.x + w.b.x, &top);
    if (abs(top) <= USUAL) top = 0;
    if (top) w.a = times_power(w.a, -top), w.b = times_power(w.b, -top), h = times_power(h, -top);
    curve_of_ball(NULL, m, piece, w, h, out);
    out->power = piece->degree * top;
}

void motion_span_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, double from, double to,
                        motion_dyadic_curve *out) {
    num_dyadic a = num_dyadic_from(arena, from), b = num_dyadic_from(arena, to);
    num_dyadic begin = num_dyadic_from(arena, m->begin);
    curve_dyadic(arena, m, piece, num_dyadic_sub(arena, a, begin), num_dyadic_sub(arena, b, a), out);
}

void motion_span_ball(const froe_motion *m, const motion_piece *piece, double from, double to, motion_ball_curve *out) {
    num_ball a = num_ball_from(from), b = num_ball_from(to);
    curve_ball(NULL, m, piece, num_ball_sub(a, num_ball_from(m->begin)), num_ball_sub(b, a), out);
}

int motion_turn_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, double from, double to,
                       num_dyadic c[4][2]) {
    const num_dyadic a = num_dyadic_from(arena, from), b = num_dyadic_from(arena, to);
    const num_dyadic begin = num_dyadic_from(arena, m->begin);
    return turn_curve_dyadic(arena, m, piece, num_dyadic_sub(arena, a, begin), num_dyadic_sub(arena, b, a), c);
}

int motion_tick_turn_dyadic(num_arena *arena, const froe_motion *m, const motion_piece *piece, int64_t tick,
                            num_dyadic c[4][2]) {
    return turn_curve_dyadic(arena, m, piece, dyadic_ticks(arena, m, tick), dyadic_ticks(arena, m, 1), c);
}

void motion_stretch_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, double span,
                         motion_ball_curve *out) {
    curve_ball(NULL, m, piece, ball_ticks(m, tick), num_ball_from(ldexp(span, m->power)), out);
}

int motion_stretch_turn_ball(const froe_motion *m, const motion_piece *piece, int64_t tick, double span,
                             num_ball c[4][2]) {
    return turn_curve_ball(NULL, m, piece, ball_ticks(m, tick), num_ball_from(ldexp(span, m->power)), c);
}

int motion_turn_ball(const froe_motion *m, const motion_piece *piece, double from, double to, num_ball c[4][2]) {
    const num_ball a = num_ball_from(from), b = num_ball_from(to);
    return turn_curve_ball(NULL, m, piece, num_ball_sub(a, num_ball_from(m->begin)), num_ball_sub(b, a), c);
}

/* --------------------------------------------------------------- in doubles -- */

/* a / b, b > 0. */
static num_ball divide_place(num_ball a, num_ball b) {
    double q = a.x / b.x, least = b.x - b.e;
    if (!(least > 0)) return (num_ball){q, (double)INFINITY};
    return (num_ball){q, (((a.e + fabs(q) * b.e) / least + fabs(q) * 0x1p-52) * NUM_BALL_UP) + NUM_BALL_TINY};
}

static num_ball ball_between(double p, double q, num_ball share) {
    num_ball from = num_ball_from(p);
    return num_ball_add(from, num_ball_mul(share, num_ball_sub(num_ball_from(q), from)));
}

static num_ball between_balls(num_ball from, num_ball to, num_ball share) {
    return num_ball_add(from, num_ball_mul(share, num_ball_sub(to, from)));
}

/* De Casteljau with a share for each step; with different ones, the blossom. A piece of degree n takes the first n, and
 * the order of these does not matter. */
static num_ball along(const motion_piece *piece, num_ball s, num_ball t, num_ball u, int k) {
    const double p = piece->from->at[k], q = piece->to->at[k], c = piece->from->control[k];
    if (piece->degree < 2) return ball_between(p, q, s);
    if (piece->degree == 2) return between_balls(ball_between(p, c, s), ball_between(c, q, s), t);
    const double d = piece->second[k];
    const num_ball middle = ball_between(c, d, s);
    const num_ball from = between_balls(ball_between(p, c, s), middle, t);
    return between_balls(from, between_balls(middle, ball_between(d, q, s), t), u);
}

static num_ball along_at(const motion_piece *piece, num_ball s, int k) {
    return along(piece, s, s, s, k);
}

/* How much of the piece has passed. */
static num_ball share_of_piece(const froe_motion *m, const motion_piece *piece, num_ball passed) {
    if (!piece->degree) return num_ball_from(0);
    weights_ball w = weigh_ball(NULL, m, piece, passed);
    return divide_place(w.b, num_ball_add(w.a, w.b));
}

static void extend(num_ball x, double *lo, double *hi) {
    double low = nextafter(x.x - x.e, -DBL_MAX), high = nextafter(x.x + x.e, DBL_MAX);
    if (!(low >= *lo)) *lo = low >= -DBL_MAX ? low : -DBL_MAX;
    if (!(high <= *hi)) *hi = high <= DBL_MAX ? high : DBL_MAX;
}

/* The quaternion at a share of the piece. */
static void quaternion_at(const motion_piece *piece, num_ball share, num_ball q[4]) {
    const motion_turn *to = piece->turn + (piece->from != piece->to);
    for (int i = 0; i < 4; i++) q[i] = ball_between(piece->turn->q[i], to->q[i], share);
}

/* Coordinate k of a place in a body, turned: the bilinear form whose square is |q|^2 times the turned place, divided by
 * p . q. For p = q that is the place; for two instants it is where the tangents of the arc between them meet. */
static num_ball turned(const num_ball p[4], const num_ball q[4], const double *v, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    num_ball dot[4], mixed[4]; /* mixed: twice the means */
    for (int n = 0; n < 4; n++) dot[n] = num_ball_mul(p[n], q[n]);
    const int pairs[4][2] = {{k, i}, {k, j}, {3, i}, {3, j}};
    for (int n = 0; n < 4; n++)
        mixed[n] =
            num_ball_add(num_ball_mul(p[pairs[n][0]], q[pairs[n][1]]), num_ball_mul(p[pairs[n][1]], q[pairs[n][0]]));
    const num_ball own = num_ball_sub(num_ball_add(dot[3], dot[k]), num_ball_add(dot[i], dot[j]));
    const num_ball whole = num_ball_add(num_ball_add(dot[3], dot[k]), num_ball_add(dot[i], dot[j]));
    num_ball sum = num_ball_mul(own, num_ball_from(v[k]));
    sum = num_ball_add(sum, num_ball_mul(num_ball_sub(mixed[0], mixed[3]), num_ball_from(v[i])));
    sum = num_ball_add(sum, num_ball_mul(num_ball_add(mixed[1], mixed[2]), num_ball_from(v[j])));
    return divide_place(sum, whole);
}

double motion_near(const froe_motion *m, const motion_piece *piece, int64_t tick, double *out) {
    num_ball share = share_of_piece(m, piece, ball_ticks(m, tick));
    double error = 0;
    num_ball turn[4];
    if (piece->corner) quaternion_at(piece, share, turn);
    for (int k = 0; k < m->dim; k++) {
        num_ball x = along_at(piece, share, k);
        if (piece->corner) x = num_ball_add(x, turned(turn, turn, piece->corner, k));
        out[k] = x.x;
        if (!(x.e <= error)) error = x.e < (double)INFINITY ? x.e : (double)INFINITY; /* NaN, too */
    }
    return error;
}

/* The arc of a vertex of a body between two shares lies between its ends and where its tangents meet. */
static void extend_by_turn(const motion_piece *piece, num_ball s, num_ball t, int dim, double lo[3], double hi[3]) {
    num_ball from[4], to[4];
    quaternion_at(piece, s, from);
    quaternion_at(piece, t, to);
    for (int k = 0; k < dim; k++) {
        extend(turned(from, from, piece->corner, k), &lo[k], &hi[k]);
        extend(turned(to, to, piece->corner, k), &lo[k], &hi[k]);
        extend(turned(from, to, piece->corner, k), &lo[k], &hi[k]);
    }
}

/* The ends and the control points of the part (blossoms of both shares). */
static void extend_by_flight(const motion_piece *piece, num_ball s, num_ball t, int dim, double *lo, double *hi) {
    for (int k = 0; k < dim; k++) {
        extend(along_at(piece, s, k), &lo[k], &hi[k]);
        extend(along_at(piece, t, k), &lo[k], &hi[k]);
        if (piece->degree > 1) extend(along(piece, s, t, s, k), &lo[k], &hi[k]);
        if (piece->degree == 3) extend(along(piece, s, t, t, k), &lo[k], &hi[k]);
    }
}

/* A sum of bounds, of which a greatest double may stand for more. */
static double bound_sum(double a, double b) {
    return fabs(b) == DBL_MAX ? b : a + b;
}

void motion_extend(const froe_motion *m, const motion_piece *piece, double from, double to, int dim, double *lo,
                   double *hi) {
    num_ball begin = num_ball_from(m->begin);
    num_ball s = share_of_piece(m, piece, num_ball_sub(num_ball_from(from), begin));
    num_ball t = share_of_piece(m, piece, num_ball_sub(num_ball_from(to), begin));
    double arm_lo[3], arm_hi[3], centre_lo[3], centre_hi[3];
    if (!piece->corner) {
        extend_by_flight(piece, s, t, dim, lo, hi);
        return;
    }
    for (int k = 0; k < 3; k++) arm_lo[k] = centre_lo[k] = DBL_MAX, arm_hi[k] = centre_hi[k] = -DBL_MAX;
    extend_by_flight(piece, s, t, dim, centre_lo, centre_hi);
    extend_by_turn(piece, s, t, dim, arm_lo, arm_hi);
    for (int k = 0; k < dim; k++) {
        extend((num_ball){bound_sum(centre_lo[k], arm_lo[k]), 0}, &lo[k], &hi[k]);
        extend((num_ball){bound_sum(centre_hi[k], arm_hi[k]), 0}, &lo[k], &hi[k]);
    }
}

static num_ball product_of(const num_ball p[4], const num_ball q[4]) {
    num_ball sum = num_ball_from(0);
    for (int i = 0; i < 4; i++) sum = num_ball_add(sum, num_ball_mul(p[i], q[i]));
    return sum;
}

void motion_arc_of(const froe_motion *m, const motion_piece *piece, double from, double to, motion_arc *out) {
    const num_ball begin = num_ball_from(m->begin), half = num_ball_from(0.5);
    const num_ball s = share_of_piece(m, piece, num_ball_sub(num_ball_from(from), begin));
    const num_ball t = share_of_piece(m, piece, num_ball_sub(num_ball_from(to), begin));
    num_ball q[2][4];
    quaternion_at(piece, s, q[0]);
    quaternion_at(piece, t, q[1]);
    for (int i = 0; i < 3; i++) {
        const num_ball *a = q[i / 2], *b = q[(i + 1) / 2];
        out->weight[i] = product_of(a, b);
        for (int k = 0; k < 3; k++) {
            out->turned[i][k] = turned(a, b, piece->corner, k);
            out->flight[i][k] = along(piece, i < 2 ? s : t, i ? t : s, t, k); /* not of a cubic */
        }
    }
    for (int k = 0; k < 3 && piece->degree < 2; k++)
        out->flight[1][k] = num_ball_mul(half, num_ball_add(out->flight[0][k], out->flight[2][k]));
}

/* -------------------------------------------------------------------- pieces -- */

/* The plan that a vertex flies by: its own, or that of its body. */
static const motion_plan *plan_of(const froe_motion *m, uint32_t vertex) {
    const motion_plan *plan = m->plans.data + vertex;
    return plan->body == FROE_NONE ? plan : &m->bodies.data[plan->body].plan;
}

motion_piece motion_piece_after(const froe_motion *m, uint32_t vertex, uint32_t knot) {
    const motion_plan *own = m->plans.data + vertex, *plan = plan_of(m, vertex);
    const motion_knot *from = m->knots.data + plan->first + knot;
    const bool alone = plan->count == 1;
    motion_piece piece = {.from = from, .to = alone ? from : from + 1, .last = MOTION_FAR};
    if (!alone) piece.degree = motion_knot_degree(from);
    if (piece.degree == 3) piece.second = m->seconds.data[from->second].at;
    if (knot + 2 < plan->count) piece.last = from[1].tick - 1;
    if (plan != own) {
        piece.corner = m->knots.data[own->first].at;
        piece.turn = m->turns.data + m->bodies.data[own->body].turns + knot;
    }
    return piece;
}

motion_piece motion_piece_at(const froe_motion *m, uint32_t vertex, int64_t tick) {
    const motion_plan *plan = plan_of(m, vertex);
    const motion_knot *knots = m->knots.data + plan->first;
    uint32_t low = 0, high = plan->count > 1 ? plan->count - 1 : 1; /* of the knots that begin pieces */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (knots[middle].tick <= tick)
            low = middle;
        else
            high = middle;
    }
    return motion_piece_after(m, vertex, low);
}

motion_piece motion_piece_at_time(const froe_motion *m, uint32_t vertex, double time) {
    const motion_plan *plan = plan_of(m, vertex);
    const motion_knot *knots = m->knots.data + plan->first;
    uint32_t low = 0, high = plan->count > 1 ? plan->count - 1 : 1;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (knots[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    return motion_piece_after(m, vertex, low);
}

bool froe_motion_position(const froe_motion *m, uint32_t vertex, double time, double *at) {
    BASE_FLOATS_OWN;
    if (!m || vertex >= m->plans.count || !isfinite(time)) return false;
    motion_piece piece = motion_piece_at_time(m, vertex, time);
    if (piece.degree && (time < piece.from->time || time > piece.to->time)) return false;
    num_ball share = num_ball_from(0);
    if (piece.degree) /* halves: ends may be as far apart as doubles go */
        share.x = (0.5 * time - 0.5 * piece.from->time) / (0.5 * piece.to->time - 0.5 * piece.from->time);
    num_ball turn[4];
    if (piece.corner) quaternion_at(&piece, share, turn);
    for (int k = 0; k < m->dim; k++) {
        at[k] = share.x < 1 ? along_at(&piece, share, k).x : piece.to->at[k];
        if (piece.corner) at[k] += turned(turn, turn, piece.corner, k).x;
    }
    return true;
}
