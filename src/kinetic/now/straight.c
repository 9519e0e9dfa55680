/* straight.c: when claims about vertices fail that fly straight, from where these are now and at the end.
 *
 *      b0   b1              Places of vertices are linear in time, so the order of two is, too, and on which side of a
 *     --o----o------        segment a vertex is has degree 2. Its coefficients in Bernstein's form come from the
 *              `o b2        places at both ends of the time: products of the first steps, of both, and of the last.
 *
 * Where these show that it stays positive nothing fails before a plan goes on. This is so for most certificates of
 * tracks that are sampled. Otherwise the tick is guessed, and both sides of it are tested: a polynomial of degree 2 that
 * is positive now and two ticks before it is negative has no other root before. Where a sign is not sure in doubles,
 * failure.c decides. */
#include "kinetic/now/straight.h"

/* What a claim is about, > 0 while it holds: the order of two vertices, or the side of the third of the line from the
 * first to the second. */
typedef struct straight_claim {
    const now_course *course[3];
    double start[3]; /* the present tick, from the beginnings of their pieces */
    double sign;     /* of sides */
    double error;    /* no value from now to the end is further off, nor the mean of two products */
} straight_claim;

typedef double straight_order(const straight_claim *c, double s);

/* Looks up the pieces of some vertices. False: not all fly straight. */
static bool find_courses(now_state *now, const uint32_t *vertex, int count, int64_t *last, straight_claim *out) {
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
static double order_at(const straight_claim *c, double s) {
    const now_course *p = c->course[0], *q = c->course[1];
    return q->x[0] + (c->start[1] + s) * q->x[1] - (p->x[0] + (c->start[0] + s) * p->x[1]);
}

typedef struct straight_steps {
    double d[2], e[2]; /* from the first vertex to the second and third */
} straight_steps;

static straight_steps steps_at(const straight_claim *c, double s) {
    double at[3][2];
    for (int i = 0; i < 3; i++) {
        const now_course *v = c->course[i];
        const double t = c->start[i] + s;
        at[i][0] = v->x[0] + t * v->x[1], at[i][1] = v->y[0] + t * v->y[1];
    }
    return (straight_steps){{at[1][0] - at[0][0], at[1][1] - at[0][1]}, {at[2][0] - at[0][0], at[2][1] - at[0][1]}};
}

static double cross(const double d[2], const double e[2]) {
    return d[0] * e[1] - d[1] * e[0];
}

static double side_at(const straight_claim *c, double s) {
    const straight_steps v = steps_at(c, s);
    return c->sign * cross(v.d, v.e);
}

static double length(const double d[2]) {
    return fabs(d[0]) + fabs(d[1]);
}

/* Steps are longest now or at the end. */
static double error_of_side(const straight_claim *c, const straight_steps *first, const straight_steps *last) {
    const double off[2] = {c->course[0]->error + c->course[1]->error, c->course[0]->error + c->course[2]->error};
    const double d = larger(length(first->d), length(last->d)) * (1 + 0x1p-40) + off[0];
    const double e = larger(length(first->e), length(last->e)) * (1 + 0x1p-40) + off[1];
    return (d * e * 0x1p-49 + d * off[1] + e * off[0]) * (1 + 0x1p-40) + NUM_BALL_TINY;
}

/* -------------------------------------------------------------------- ticks -- */

/* The even number of ticks, near a guess, at which a claim surely fails that surely holds two before. 0: unsure. */
static int64_t confirm(const straight_claim *c, straight_order *value, double guess, int64_t span) {
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

static bool find_order(now_state *now, const uint32_t vertex[2], int64_t *out) {
    int64_t last = now->motion->last_tick | 1;
    straight_claim c;
    if (!find_courses(now, vertex, 2, &last, &c)) return false;
    const int64_t span = last > now->tick ? last - now->tick : 0;
    const double b0 = order_at(&c, 0), b1 = order_at(&c, (double)span);
    c.error = (c.course[0]->error + c.course[1]->error + larger(fabs(b0), fabs(b1)) * 0x1p-52) * NUM_BALL_UP;
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
    const double b0 = c.sign * cross(first.d, first.e), b2 = c.sign * cross(final.d, final.e);
    const double b1 = 0.5 * c.sign * (cross(first.d, final.e) + cross(final.d, first.e));
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

bool straight_first_failure(now_state *now, const now_claim *claim, int64_t *out) {
    if (claim->q.b != NAME_VERTEX || claim->above == NOW_ALONG) return false;
    if (claim->p.b == NAME_SEGMENT) return find_side(now, claim, out);
    return claim->p.b == NAME_VERTEX && find_order(now, (const uint32_t[]){claim->p.a, claim->q.a}, out);
}
