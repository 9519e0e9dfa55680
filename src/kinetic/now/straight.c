/* straight.c: when claims about vertices fail that fly straight, from where these are now and at the end.
 *
 *      b0   b1              Places of vertices are linear in time, so the order of two is, too, and on which side of a
 *     --o----o------        segment a vertex is has degree 2. Its coefficients in Bernstein's form come from the
 *              `o b2        places at both ends of the time: products of the first steps, of both, and of the last.
 *                           The order of a vertex and a crossing has degree 3, times the turn from one of its lines to
 *                           the other.
 *
 * Where these show that it stays positive nothing fails before a plan goes on. This is so for most certificates of
 * tracks that are sampled. Otherwise the tick is guessed, and both sides of it are tested: a polynomial of degree 2
 * that is positive now and two ticks before it is negative has no other root before. A crossing is looked at for
 * shorter times, until its sign surely changes once at most. Where a sign is not sure in doubles, failure.c decides. */
#include "kinetic/now/straight.h"

/* What a claim is about, > 0 while it holds: the order of two vertices; the side of the third of the line from the
 * first to the second; or the order of where that line crosses the one from the third to the fourth, and the fifth. */
typedef struct straight_claim {
    const now_course *course[5];
    double start[5]; /* the present tick, from the beginnings of their pieces */
    double sign;     /* of sides, and of orders with a crossing */
    double turn;     /* the sign of the turn from the first line to the second */
    double error;    /* no value from now to the end is further off, nor the mean of products */
} straight_claim;

typedef double straight_value(const straight_claim *c, double s);

/* Looks up the pieces of some vertices. False: not all fly straight. */
static inline bool find_courses(now_state *now, const uint32_t *vertex, int count, int64_t *last, straight_claim *out) {
    for (int i = 0; i < count; i++) {
        const now_course *c = now_course_of(now, vertex[i]);
        if (c->degree > 1) return false;
        if (c->last < *last) *last = c->last;
        out->course[i] = c, out->start[i] = (double)(now->tick - c->base);
    }
    return true;
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

/* ------------------------------------------------------------------- values -- */

/* So many ticks from now. */
static inline double order_at(const straight_claim *c, double s) {
    const now_course *p = c->course[0], *q = c->course[1];
    return q->x[0] + (c->start[1] + s) * q->x[1] - (p->x[0] + (c->start[0] + s) * p->x[1]);
}

/* Where the first `count` vertices are then. */
static inline void places_at(const straight_claim *c, int count, double s, double at[][2]) {
    for (int i = 0; i < count; i++) {
        const now_course *v = c->course[i];
        const double t = c->start[i] + s;
        at[i][0] = v->x[0] + t * v->x[1], at[i][1] = v->y[0] + t * v->y[1];
    }
}

typedef struct straight_steps {
    double d[2], e[2]; /* from the first vertex to the second and third */
} straight_steps;

static straight_steps steps_at(const straight_claim *c, double s) {
    double at[3][2];
    places_at(c, 3, s, at);
    return (straight_steps){{at[1][0] - at[0][0], at[1][1] - at[0][1]}, {at[2][0] - at[0][0], at[2][1] - at[0][1]}};
}

static double steps_cross(const double d[2], const double e[2]) {
    return d[0] * e[1] - d[1] * e[0];
}

static double side_at(const straight_claim *c, double s) {
    const straight_steps v = steps_at(c, s);
    return c->sign * steps_cross(v.d, v.e);
}

static double size_of(const double d[2]) {
    return fabs(d[0]) + fabs(d[1]);
}

/* Steps are longest now or at the end. */
static double error_of_side(const straight_claim *c, const straight_steps *first, const straight_steps *last) {
    const double off[2] = {c->course[0]->error + c->course[1]->error, c->course[0]->error + c->course[2]->error};
    const double d = larger(size_of(first->d), size_of(last->d)) * (1 + 0x1p-40) + off[0];
    const double e = larger(size_of(first->e), size_of(last->e)) * (1 + 0x1p-40) + off[1];
    return (d * e * 0x1p-49 + d * off[1] + e * off[0]) * (1 + 0x1p-40) + NUM_BALL_TINY;
}

/* -------------------------------------------------------------------- ticks -- */

/* The even number of ticks, near a guess, at which a claim surely fails that surely holds two before. 0: unsure. */
static int64_t confirm(const straight_claim *c, straight_value *value, double guess, int64_t span) {
    enum { TRIES = 4 };
    int64_t at = (int64_t)guess;
    bool holds = false; /* two before */
    at += at & 1;
    for (int i = 0; i < TRIES && at >= 2 && at <= span; i++) {
        double v = value(c, (double)at);
        if (v > c->error) {
            at += 2;
            holds = true;
        } else if (v < -c->error) {
            if (holds || at == 2) return at;
            v = value(c, (double)(at - 2));
            if (v > c->error) return at;
            at -= 2;
        } else {
            return 0;
        }
    }
    return 0;
}

static inline bool find_order(now_state *now, const uint32_t vertex[2], int64_t *out) {
    const now_course *p = now_course_of(now, vertex[0]), *q = now_course_of(now, vertex[1]);
    const int64_t first = p->last < q->last ? p->last : q->last, end = now->motion->last_tick | 1;
    const int64_t last = first < end ? first : end, span = last > now->tick ? last - now->tick : 0;
    straight_claim c;
    if ((p->degree | q->degree) > 1) return false;
    c.course[0] = p, c.start[0] = (double)(now->tick - p->base);
    c.course[1] = q, c.start[1] = (double)(now->tick - q->base);
    const double b0 = order_at(&c, 0), b1 = order_at(&c, (double)span);
    c.error = (p->error + q->error + larger(fabs(b0), fabs(b1)) * 0x1p-52) * NUM_BALL_UP;
    if (!(b0 > c.error)) return false;
    *out = NOW_NEVER;
    if (span < 2 || b1 > c.error) return true;
    if (!(b1 < -c.error)) return false;
    const int64_t at = confirm(&c, order_at, b0 / (b0 - b1) * (double)span, span);
    *out = now->tick + at;
    return at > 0;
}

/* From 0 to 1: where a polynomial in Bernstein's form first falls through 0. */
static double root_of(double b0, double b1, double b2) {
    const double c = b0 - 2 * b1 + b2, b = 2 * (b1 - b0), root = sqrt(b * b - 4 * b0 * c);
    const double u = b <= 0 ? 2 * b0 / (root - b) : (-b - root) / (2 * c);
    return u > 0 ? u < 1 ? u : 1 : 0; /* NaN, too */
}

static bool find_side(now_state *now, const now_claim *claim, int64_t *out) {
    const uint32_t vertex[3] = {now_vertex(now, claim->p.a, 0), now_vertex(now, claim->p.a, 1), claim->q.a};
    int64_t last = now->motion->last_tick | 1;
    straight_claim c = {.sign = claim->above};
    if (!find_courses(now, vertex, 3, &last, &c)) return false;
    const int64_t span = last > now->tick ? last - now->tick : 0;
    const straight_steps first = steps_at(&c, 0), final = steps_at(&c, (double)span);
    const double error = c.error = error_of_side(&c, &first, &final);
    const double b0 = c.sign * steps_cross(first.d, first.e), b2 = c.sign * steps_cross(final.d, final.e);
    const double b1 = 0.5 * c.sign * (steps_cross(first.d, final.e) + steps_cross(final.d, first.e));
    if (!(b0 > error)) return false;
    *out = NOW_NEVER;
    if (span < 2) return true;
    if (b2 > error) { /* has it two roots, or none: b1^2 > b0 b2 and b1 < 0? */
        const double least = error - b1, most = (b0 - error) * (b2 - error);
        if (b1 > error || least * least < most * (1 - 0x1p-40)) return true;
    } else if (!(b2 < -error)) {
        return false;
    }
    const int64_t at = confirm(&c, side_at, root_of(b0, b1, b2) * (double)span, span);
    *out = now->tick + at;
    return at > 0;
}

/* ---------------------------------------------------------------- crossings -- */

/* So many ticks from now: the steps d and e along both lines, from the first to the third vertex, and to the fifth. */
typedef struct straight_lines {
    double d[2], e[2], between[2], x;
} straight_lines;

static straight_lines lines_at(const straight_claim *c, double s) {
    double at[5][2];
    places_at(c, 5, s, at);
    return (straight_lines){{at[1][0] - at[0][0], at[1][1] - at[0][1]},
                            {at[3][0] - at[2][0], at[3][1] - at[2][1]},
                            {at[2][0] - at[0][0], at[2][1] - at[0][1]},
                            at[4][0] - at[0][0]};
}

/* x turn - d_x shift, with turn = d x e and shift = between x e: the order times the turn. */
static double crossing_at(const straight_claim *c, double s) {
    const straight_lines v = lines_at(c, s);
    return c->sign * (v.x * steps_cross(v.d, v.e) - v.d[0] * steps_cross(v.between, v.e));
}

/* Sets the error of values, and returns that of turns. */
static double errors_of_crossing(straight_claim *c, const straight_lines *first, const straight_lines *last) {
    const double off[4] = {c->course[0]->error + c->course[1]->error, c->course[2]->error + c->course[3]->error,
                           c->course[0]->error + c->course[2]->error, c->course[0]->error + c->course[4]->error};
    const double d = larger(size_of(first->d), size_of(last->d)) * (1 + 0x1p-40) + off[0];
    const double e = larger(size_of(first->e), size_of(last->e)) * (1 + 0x1p-40) + off[1];
    const double between = larger(size_of(first->between), size_of(last->between)) * (1 + 0x1p-40) + off[2];
    const double x = larger(fabs(first->x), fabs(last->x)) * (1 + 0x1p-40) + off[3];
    const double turn = d * e * 0x1p-49 + d * off[1] + e * off[0];
    const double shift = between * e * 0x1p-49 + between * off[1] + e * off[2];
    c->error = (x * turn + d * shift + off[3] * d * e + off[0] * between * e + (x + between) * d * e * 0x1p-48) *
                   (1 + 0x1p-40) +
               NUM_BALL_TINY;
    return turn * (1 + 0x1p-40) + NUM_BALL_TINY;
}

/* In Bernstein's form: the cross product of two steps. */
static void cross_lines(const double d0[2], const double d1[2], const double e0[2], const double e1[2], double out[3]) {
    out[0] = steps_cross(d0, e0), out[1] = 0.5 * (steps_cross(d0, e1) + steps_cross(d1, e0)),
    out[2] = steps_cross(d1, e1);
}

typedef enum straight_verdict { STRAIGHT_HOLDS, STRAIGHT_FALLS, STRAIGHT_UNSURE } straight_verdict;

/* Between two times, at the first of which it holds: does it throughout, or up to a single root? Unsure, too, if the
 * lines may be parallel in between. Sets its coefficients in Bernstein's form. */
static straight_verdict judge_crossing(straight_claim *c, const straight_lines *first, const straight_lines *last,
                                       double b[4]) {
    double turn[3], shift[3];
    const double off = errors_of_crossing(c, first, last);
    const double x0 = c->sign * first->x, x1 = c->sign * last->x, d0 = c->sign * first->d[0], d1 = c->sign * last->d[0];
    cross_lines(first->d, last->d, first->e, last->e, turn);
    cross_lines(first->between, last->between, first->e, last->e, shift);
    b[0] = x0 * turn[0] - d0 * shift[0], b[3] = x1 * turn[2] - d1 * shift[2];
    b[1] = (x1 * turn[0] + 2 * x0 * turn[1] - d1 * shift[0] - 2 * d0 * shift[1]) / 3;
    b[2] = (2 * x1 * turn[1] + x0 * turn[2] - 2 * d1 * shift[1] - d0 * shift[2]) / 3;
    for (int i = 0; i < 3; i++)
        if (!(c->turn * turn[i] > off)) return STRAIGHT_UNSURE;
    bool falls = false;
    for (int i = 0; i < 4; i++) {
        if (!(fabs(b[i]) > c->error) || (falls && b[i] > 0)) return STRAIGHT_UNSURE;
        falls = b[i] < 0;
    }
    return b[0] < 0 ? STRAIGHT_UNSURE : falls ? STRAIGHT_FALLS : STRAIGHT_HOLDS;
}

/* From 0 to 1: where a polynomial of degree 3 in Bernstein's form falls through 0 (Newton's method, and halving). */
static double falling_root(const double b[4], double close) {
    const double c[4] = {b[0], 3 * (b[1] - b[0]), 3 * (b[2] - 2 * b[1] + b[0]), b[3] - 3 * (b[2] - b[1]) - b[0]};
    double low = 0, high = 1, u = b[0] / (b[0] - b[3]);
    for (int i = 0; i < 60; i++) {
        const double y = c[0] + u * (c[1] + u * (c[2] + u * c[3])), slope = c[1] + u * (2 * c[2] + 3 * u * c[3]);
        *(y > 0 ? &low : &high) = u;
        double next = u - y / slope;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (fabs(next - u) < close) return next;
        u = next;
    }
    return u;
}

/* A shorter time in which a crossing is looked at: twice what it takes to fall to 0 if it goes on as it begins. */
static int64_t shorter(const double b[4], int64_t length) {
    const double u = b[1] < b[0] ? b[0] / (1.5 * (b[0] - b[1])) : 1;
    return (int64_t)((u > 0.01 ? u < 0.5 ? u : 0.5 : 0.01) * (double)length) & ~(int64_t)1;
}

static bool find_crossing(now_state *now, const now_claim *claim, int64_t *out) {
    enum { TRIES = 12 };
    const bool before = name_is_crossing(claim->p); /* the crossing comes first */
    const name_point crossing = before ? claim->p : claim->q;
    const uint32_t *s = now->segments.data[crossing.a].end, *t = now->segments.data[crossing.b].end;
    int64_t last = now->motion->last_tick | 1, from = 0;
    straight_claim c;
    double b[4];
    if (!find_courses(now, (const uint32_t[]){s[0], s[1], t[0], t[1], before ? claim->q.a : claim->p.a}, 5, &last, &c))
        return false;
    const int64_t span = last - now->tick;
    if (span < 2) return false;
    straight_lines first = lines_at(&c, 0);
    c.turn = steps_cross(first.d, first.e) > 0 ? 1 : -1;
    c.sign = before ? c.turn : -c.turn;
    int64_t length = span;
    for (int i = 0; i < TRIES; i++) {
        const straight_lines final = lines_at(&c, (double)(from + length));
        const straight_verdict verdict = judge_crossing(&c, &first, &final, b);
        if (verdict == STRAIGHT_FALLS) {
            const double root = falling_root(b, 0.5 / (double)length);
            const int64_t at = confirm(&c, crossing_at, (double)from + root * (double)length, from + length);
            *out = now->tick + at;
            return at > from;
        }
        if (verdict == STRAIGHT_HOLDS) {
            from += length, first = final, length *= 4;
            *out = NOW_NEVER;
            if (from == span) return true;
            if (length > span - from) length = span - from;
        } else {
            length = shorter(b, length);
            if (length < 4) return false;
        }
    }
    return false;
}

bool straight_first_failure(now_state *now, const now_claim *claim, int64_t *out) {
    const name_point p = claim->p, q = claim->q;
    if (name_is_vertex(p) && name_is_vertex(q))
        return claim->above != NOW_ALONG && find_order(now, (const uint32_t[]){p.a, q.a}, out);
    if (p.b == NAME_SEGMENT) return find_side(now, claim, out);
    if (claim->above == NOW_ALONG) return false;
    if ((name_is_crossing(p) && name_is_vertex(q)) || (name_is_vertex(p) && name_is_crossing(q)))
        return find_crossing(now, claim, out);
    return false;
}
