/* failure.c: the first tick after which a claim about moving points is false.
 *
 *         +                              The claim is a polynomial in time that is positive while it holds. In
 *      o     +                           Bernstein's form over an interval of ticks the polynomial lies within
 *     -------------o----- s              the hull of its coefficients: if these are surely positive, the claim
 *                +                       holds throughout; if their signs surely change once, there is one root,
 *                      +                 and only the tick behind it is to be found. Otherwise the
 *                                        interval is halved (de Casteljau), and where doubles do not suffice,
 * Descartes' rule is applied to the exact polynomial. Ticks are tested by predicates, never by polynomials.
 * Source: Lane and Riesenfeld, "Bounds on a polynomial", BIT 1981; Collins and Akritas, SYMSAC 1976. */
#include "kinetic/now/now.h"
#include <math.h>

enum { FAILURE_LEVELS = 56 };

/* Coefficients over low <= s <= low + 2^power, s counted from now. */
typedef struct failure_stretch {
    int64_t low;
    int power;
    num_ball b[POLY_TERMS];
} failure_stretch;

typedef struct failure_search {
    now_state *now;
    const now_claim *claim;
    int axis;
    int64_t start, span; /**< ticks start .. start + span */
    const poly_ball *p;
} failure_search;

/* The sign of the polynomial, where doubles are sure of it: then it is what the predicates would say. */
static int sign_near(const poly_ball *p, double s) {
    double y = 0, size = 0, error = 0;
    for (int i = p->degree; i >= 0; i--) {
        y = y * s + p->c[i].x;
        size = size * s + fabs(p->c[i].x);
        error = error * s + p->c[i].e;
    }
    error += error * 0x1p-40 + size * 0x1p-47 + NUM_BALL_TINY;
    return y > error ? 1 : y < -error ? -1 : 0;
}

/* REQUIRES: within the span. Before lines become parallel their crossing leaves the segments, and the claim is gone.
 * So `lost` is restored. */
static bool fails_at(const failure_search *f, int64_t s) {
    now_state *now = f->now;
    int sign = sign_near(f->p, (double)s);
    if (sign) return sign < 0;
    const bool lost = now->lost;
    now->tick = f->start + s;
    bool fails = now_holds(now, f->claim) < 0;
    now->tick = f->start;
    now->lost = lost;
    return fails;
}

/* The present tick is odd: claims are tested at s = 0, 2, 4, ... */
static int64_t next_even(int64_t s) {
    return s + (s & 1);
}

#define MOST_STEP ((int64_t)1 << 40) /* with larger steps, halving finds the place */

/* The claim holds at `good` and not at `bad`, both even, and changes once: finds that place, from a guess. */
static int64_t bracket(const failure_search *f, int64_t good, int64_t bad, int64_t guess) {
    int64_t step = 2, at = next_even(guess);
    while (bad - good > 2) {
        if (at <= good || at >= bad) at = good + (bad - good) / 4 * 2;
        if (at == good) at += 2;
        if (fails_at(f, at)) {
            bad = at;
            at -= step;
        } else {
            good = at;
            at += step;
        }
        if (step < MOST_STEP) step *= 4;
    }
    return bad;
}

static double value(const poly_ball *p, double s) {
    double y = 0;
    for (int i = p->degree; i >= 0; i--) y = y * s + p->c[i].x;
    return y;
}

/* Roughly where a polynomial that falls through 0 between low and high does so: Illinois' method. */
static double rough_root(const poly_ball *p, double low, double high) {
    double a = value(p, low), b = value(p, high);
    if (!(a > 0)) return low;
    if (!(b < 0)) return high;
    for (int i = 0; i < 60 && high - low > 0.5; i++) {
        double s = high - b * ((high - low) / (b - a));
        if (!(s > low && s < high)) s = 0.5 * (low + high);
        double y = value(p, s);
        if (fabs(s - low) < 0.25 || fabs(high - s) < 0.25) {
            if (y > 0 ? high - s < 0.25 : s - low < 0.25) return s;
        }
        if (y > 0) {
            low = s, a = y;
            b *= 0.5;
        } else {
            high = s, b = y;
            a *= 0.5;
        }
    }
    return 0.5 * (low + high);
}

/* -------------------------------------------------------------- in doubles -- */

static void to_bernstein(const poly_ball *p, int power, failure_stretch *out) {
    int d = p->degree;
    double unit = ldexp(1, power), scale = 1;
    num_ball c[POLY_TERMS];
    for (int i = 0; i <= d; i++, scale *= unit) c[i] = (num_ball){p->c[i].x * scale, p->c[i].e * scale};
    for (int j = 0; j <= d; j++) {
        double ratio = 1, sum = 0, error = 0, size = 0;
        for (int i = 0; i <= j; i++) {
            sum += ratio * c[i].x;
            size += ratio * fabs(c[i].x);
            error += ratio * c[i].e;
            ratio *= (double)(j - i) / (d - i);
        }
        out->b[j] = (num_ball){sum, j ? (error + size * 0x1p-48) * NUM_BALL_UP + NUM_BALL_TINY : c[0].e};
    }
    out->low = 0;
    out->power = power;
}

/* Halves at the middle: *s keeps the left half. */
static void halve(int d, failure_stretch *s, failure_stretch *right) {
    num_ball *b = s->b;
    *right = *s;
    for (int k = 0; k < d; k++) {
        right->b[d - k] = b[d];
        for (int i = d; i > k; i--) {
            double x = 0.5 * (b[i - 1].x + b[i].x), e = 0.5 * (b[i - 1].e + b[i].e) + fabs(x) * 0x1p-52;
            b[i] = (num_ball){x, e * NUM_BALL_UP + NUM_BALL_TINY};
        }
    }
    right->b[0] = b[d];
    s->power = --right->power;
    right->low += (int64_t)1 << s->power;
}

typedef enum verdict { HOLDS, FAILS, ONE_ROOT, HALVE, HOPELESS } verdict;

static verdict judge(int d, const num_ball *b) {
    int changes = 0, last = 0, unsure = 0;
    double size = 0, error = 0;
    for (int i = 0; i <= d; i++) {
        int sign = num_ball_sign(b[i]);
        if (!isfinite(b[i].x) || !isfinite(b[i].e)) return HOPELESS; /* too large for doubles */
        size = fabs(b[i].x) > size ? fabs(b[i].x) : size;
        error = b[i].e > error ? b[i].e : error;
        if (sign == 0 || sign == NUM_UNSURE) {
            unsure++;
            continue;
        }
        changes += last == -sign;
        last = sign;
    }
    if (!(size > 16 * error)) return HOPELESS;
    if (unsure) return HALVE;
    if (!changes) return last > 0 ? HOLDS : FAILS;
    return changes == 1 && last < 0 ? ONE_ROOT : HALVE;
}

/* Where a claim fails that changes once from low to high. -1: behind the span, where other pieces hold. */
static int64_t try_one_root(const failure_search *f, int64_t low, int64_t high) {
    const int64_t good = low & ~(int64_t)1, last = f->span & ~(int64_t)1;
    int64_t bad = next_even(high);
    double root = rough_root(f->p, (double)low, (double)high);
    if (bad > last) {
        if (!fails_at(f, last)) return -1;
        bad = last;
    }
    return bracket(f, good, bad, (int64_t)root);
}

/* Both ends of even ticks in the interval, one by one. -1: the claim holds at all of them. */
static int64_t try_all(const failure_search *f, int64_t low, int64_t high) {
    for (int64_t s = next_even(low > 2 ? low : 2); s <= high && s <= f->span; s += 2)
        if (fails_at(f, s)) return s;
    return -1;
}

/* ----------------------------------------------------------------- exactly -- */

/* The same by Descartes' rule alone. */
static int64_t search_exactly(const failure_search *f, int64_t low, int power) {
    struct {
        int64_t low;
        int power;
    } stack[2 * FAILURE_LEVELS];
    int top = 0;
    stack[top].low = low, stack[top++].power = power;
    poly_wide wide;
    const poly_wide *p = now_claim_wide(f->now, f->claim, f->axis, low + ((int64_t)1 << power), &wide) ? &wide : NULL;
    while (top) {
        low = stack[--top].low, power = stack[top].power;
        if (low > f->span) continue;
        int64_t high = low + ((int64_t)1 << power), at = -1;
        if (power <= 2) {
            at = try_all(f, low, high);
        } else {
            int sign, changes;
            if (p) {
                changes = wide_variations(p, low, power, &sign);
            } else { /* too wide for that: made anew each time */
                poly_exact exact;
                now_claim_exact(f->now, f->claim, f->axis, &exact);
                changes = exact_variations(&f->now->context.arena, &exact, low, power, &sign);
            }
            if (!changes && sign >= 0) {
                at = try_all(f, high - 1, high); /* ends may be roots */
            } else if (!changes) {
                at = try_all(f, low, low + 4);
            } else {
                stack[top].low = low + ((int64_t)1 << (power - 1)), stack[top++].power = power - 1;
                stack[top].low = low, stack[top++].power = power - 1;
            }
        }
        if (at >= 0) return at;
    }
    return -1;
}

/* ------------------------------------------------------------------ search -- */

static int64_t find_first_failure(const failure_search *f) {
    failure_stretch stack[FAILURE_LEVELS + 2];
    int top = 1, power = 0;
    while (((int64_t)1 << power) < f->span) power++;
    to_bernstein(f->p, power, stack);
    while (top) {
        failure_stretch *s = stack + --top;
        const int64_t high = s->low + ((int64_t)1 << s->power);
        if (s->low > f->span) continue;
        const verdict v = judge(f->p->degree, s->b);
        int64_t at = -1;
        if (v == HOLDS) continue;
        if (v == HALVE && s->power > 2) {
            failure_stretch left = *s;
            halve(f->p->degree, &left, s); /* the right half stays below */
            stack[top + 1] = left;
            top += 2;
            continue;
        }
        if (v == FAILS)
            at = try_all(f, s->low, s->low + 4);
        else if (v == HOPELESS)
            at = search_exactly(f, s->low, s->power);
        else
            at = s->power <= 2 ? try_all(f, s->low, high) : try_one_root(f, s->low, high);
        if (at >= 0) return at <= f->span ? f->start + at : NOW_NEVER;
    }
    return NOW_NEVER;
}

static int64_t least_last(now_state *now, uint32_t segment, int64_t last) {
    for (int k = 0; k < 2; k++) {
        int64_t piece = now_course_last(now, now->segments.data[segment].end[k]);
        last = piece < last ? piece : last;
    }
    return last;
}

/* The last tick up to which all vertices behind a name keep their pieces. */
static int64_t named_last(now_state *now, name_point p, int64_t last) {
    if (p.b == NAME_VERTEX) {
        int64_t piece = now_course_last(now, p.a);
        return piece < last ? piece : last;
    }
    last = least_last(now, p.a, last);
    return p.b >= 0 ? least_last(now, (uint32_t)p.b, last) : last;
}

/* The same of any claim that holds, `last` being the last tick to test. */
static int64_t first_change(now_state *now, const now_claim *claim, int64_t last) {
    failure_search f = {now, claim, 0, now->tick, last - now->tick, NULL};
    if (f.span < 2) return NOW_NEVER;
    poly_ball p;
    now_claim_ball(now, claim, 0, &p);
    bool sure = false; /* of a coefficient that is not 0 */
    for (int i = 0; i <= p.degree && !sure; i++) sure = fabs(p.c[i].x) > p.c[i].e;
    if (!sure && now_claim_axis(now, claim)) {
        f.axis = 1;
        now_claim_ball(now, claim, 1, &p);
    }
    while (p.degree && p.c[p.degree].x == 0 && p.c[p.degree].e == 0) p.degree--;
    f.p = &p;
    return find_first_failure(&f);
}

/* When the denominators behind a claim first change their signs, until `last`. */
static int64_t first_pole(now_state *now, const now_claim *claim, int64_t last) {
    const name_point name[2] = {claim->p, claim->q};
    int64_t first = NOW_NEVER;
    for (int i = 0; i < 2; i++) {
        now_claim turn = {name[i], {0, NAME_NONE}, 1};
        if (!name_is_crossing(name[i])) continue;
        if (now_holds(now, &turn) < 0) turn.above = -1;
        const int64_t tick = first_change(now, &turn, first < last ? first : last);
        first = tick < first ? tick : first;
    }
    return first;
}

/* The polynomial has the sign that the predicates give only as long as no denominator changes its own. A crossing gets
 * to where its lines are parallel from outside of its segments, and the claim is gone by then, if ticks are short. If
 * they are not, it may leave its segments, pass infinity and be back within one. So then the claim is tested, too.
 */
int64_t now_first_failure(now_state *now, const now_claim *claim) {
    int holds = now_holds(now, claim);
    if (holds <= 0) return holds ? now->tick : NOW_NEVER;
    const int64_t last = named_last(now, claim->q, named_last(now, claim->p, now->motion->last_tick | 1));
    const int64_t first = first_change(now, claim, last), pole = first_pole(now, claim, first < last ? first : last);
    if (pole == NOW_NEVER) return first;
    const int64_t before = first_change(now, claim, pole - 2);
    return before < pole ? before : pole;
}
