/* straight.c: when claims about vertices fail that fly straight, straight from where these are now and at the end.
 *
 *      b0   b1              Places of vertices are linear in time, so the order of two is, too, and on which side of a
 *     --o----o------        segment a vertex is has degree 2. Its coefficients in Bernstein's form come from the
 *              `o b2        places at both ends of the time: products of the first steps, of both, and of the last.
 *
 * Where all of these are surely positive nothing fails before a plan goes on, which is so for most certificates of
 * tracks that are sampled. Where the sign surely changes once, the tick is guessed and both sides of it are tested.
 * Everything else is left to failure.c. */
#include "kinetic/now/straight.h"

/* Where a vertex is that flies straight, so many ticks from now. */
typedef struct straight_way {
    const now_course *course;
    double start; /* the present tick */
} straight_way;

/* False: it does not fly straight, or is a body's. */
static bool find_way(now_state *now, uint32_t vertex, int64_t *last, straight_way *out) {
    const now_course *c = now_course_of(now, vertex);
    *out = (straight_way){c, (double)(now->tick - c->base)};
    if (c->last < *last) *last = c->last;
    return c->degree <= 1;
}

static void place_at(const straight_way *way, double s, double out[2]) {
    const now_course *c = way->course;
    out[0] = c->x[0] + (way->start + s) * c->x[1], out[1] = c->y[0] + (way->start + s) * c->y[1];
}

/* What a claim is about: > 0 while it holds. The order of two vertices, or the side of a third of the line from the
 * first to the second. */
typedef struct straight_claim {
    straight_way way[3];
    bool side;
    double sign; /* of sides */
} straight_claim;

/* At a tick. The steps to the second and third vertex, of a side. */
typedef struct straight_value {
    double value, step[2][2];
} straight_value;

static double cross(const double d[2], const double e[2]) {
    return d[0] * e[1] - d[1] * e[0];
}

static void evaluate(const straight_claim *c, double s, straight_value *out) {
    double at[3][2];
    if (!c->side) {
        const now_course *p = c->way[0].course, *q = c->way[1].course;
        out->value = q->x[0] + (c->way[1].start + s) * q->x[1] - (p->x[0] + (c->way[0].start + s) * p->x[1]);
        return;
    }
    for (int i = 0; i < 3; i++) place_at(c->way + i, s, at[i]);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) out->step[i][k] = at[i + 1][k] - at[0][k];
    out->value = c->sign * cross(out->step[0], out->step[1]);
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

static double length(const double d[2]) {
    return fabs(d[0]) + fabs(d[1]);
}

/* No value from now to the end is further off, nor the mean of two products. Steps are no longer in between. */
static double error_of(const straight_claim *c, const straight_value *first, const straight_value *last) {
    const double off[2] = {c->way[0].course->error + c->way[1].course->error,
                           c->side ? c->way[0].course->error + c->way[2].course->error : 0};
    if (!c->side) return (off[0] + larger(fabs(first->value), fabs(last->value)) * 0x1p-52) * NUM_BALL_UP;
    const double d = larger(length(first->step[0]), length(last->step[0])) * (1 + 0x1p-40) + off[0];
    const double e = larger(length(first->step[1]), length(last->step[1])) * (1 + 0x1p-40) + off[1];
    return (d * e * 0x1p-49 + d * off[1] + e * off[0]) * (1 + 0x1p-40) + NUM_BALL_TINY;
}

/* From 0 to 1: where a polynomial in Bernstein's form falls through 0. */
static double root_of(double b0, double b1, double b2) {
    const double c = b0 - 2 * b1 + b2, b = 2 * (b1 - b0), root = sqrt(b * b - 4 * b0 * c);
    const double u = b <= 0 ? 2 * b0 / (root - b) : (-b - root) / (2 * c);
    return u > 0 ? u < 1 ? u : 1 : 0; /* NaN, too */
}

/* The first even number of ticks at which it surely fails, from a guess, if it surely holds two before. 0: unsure. */
static int64_t confirm(const straight_claim *c, int64_t guess, int64_t span, double error) {
    enum { TRIES = 4 };
    int64_t at = guess + (guess & 1);
    straight_value v;
    bool holds = false; /* two before */
    for (int i = 0; i < TRIES && at >= 2 && at <= span; i++) {
        evaluate(c, (double)at, &v);
        if (v.value > error) {
            at += 2;
            holds = true;
        } else if (v.value < -error) {
            if (holds || at == 2) return at;
            evaluate(c, (double)(at - 2), &v);
            if (v.value > error) return at;
            at -= 2;
        } else {
            return 0;
        }
    }
    return 0;
}

/* False: not a claim about vertices that fly straight. */
static bool find_claim(now_state *now, const now_claim *claim, int64_t *last, straight_claim *out) {
    const bool side = claim->p.b == NAME_SEGMENT;
    if (claim->q.b != NAME_VERTEX || (!side && claim->p.b != NAME_VERTEX) || claim->above == NOW_ALONG) return false;
    const uint32_t vertex[3] = {side ? now_vertex(now, claim->p.a, 0) : claim->p.a,
                                side ? now_vertex(now, claim->p.a, 1) : claim->q.a, claim->q.a};
    out->side = side, out->sign = claim->above;
    for (int i = 0; i < 2 + side; i++)
        if (!find_way(now, vertex[i], last, out->way + i)) return false;
    return true;
}

bool straight_first_failure(now_state *now, const now_claim *claim, int64_t *out) {
    int64_t last = now->motion->last_tick | 1;
    straight_claim c;
    straight_value first, final;
    if (!find_claim(now, claim, &last, &c)) return false;
    const int64_t span = last - now->tick;
    evaluate(&c, 0, &first), evaluate(&c, span > 0 ? (double)span : 0, &final);
    const double error = error_of(&c, &first, &final), b0 = first.value, b2 = final.value;
    double b1 = 0.5 * (b0 + b2);
    if (!(b0 > error && error < (double)INFINITY)) return false;
    if (c.side) b1 = 0.5 * c.sign * (cross(first.step[0], final.step[1]) + cross(final.step[0], first.step[1]));
    *out = NOW_NEVER;
    if (span < 2 || (b1 > error && b2 > error)) return true;
    if (!(b2 < -error)) return false;
    const int64_t at = confirm(&c, (int64_t)(root_of(b0, b1, b2) * (double)span), span, error);
    *out = now->tick + at;
    return at > 0;
}
