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
#include "kinetic/now/near.h"
#include "kinetic/now/straight.h"
#include <math.h>

enum { FAILURE_LEVELS = 56 };

/* Coefficients in Bernstein's form over low <= u <= low + width; none is further off than `error`. */
typedef struct failure_stretch {
    double low, width, error, b[POLY_TERMS];
} failure_stretch;

typedef struct failure_search {
    now_state *now;
    const now_claim *claim;
    int axis;
    int64_t start, span; /**< ticks start .. start + span */
    double unit;         /**< a tick, where the span is 1 */
    const near_poly *p;
} failure_search;

/* REQUIRES: within the span. Where doubles are sure of the sign, it is what the predicates would say. Before lines
 * become parallel their crossing leaves the segments, and the claim is gone. So `lost` is restored. */
static bool fails_at(const failure_search *f, int64_t s) {
    now_state *now = f->now;
    int sign = near_sign_at(f->p, (double)s * f->unit);
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

static double value(const near_poly *p, double u) {
    double y = 0;
    for (int i = p->degree; i >= 0; i--) y = y * u + p->c[i];
    return y;
}

/* Roughly where a polynomial that falls through 0 between low and high does so: Illinois' method. */
static double falling_root(const near_poly *p, double low, double high, double close) {
    double a = value(p, low), b = value(p, high);
    if (!(a > 0)) return low;
    if (!(b < 0)) return high;
    for (int i = 0; i < 60 && high - low > close; i++) {
        double u = high - b * ((high - low) / (b - a));
        if (!(u > low && u < high)) u = 0.5 * (low + high);
        double y = value(p, u);
        if (y > 0 ? high - u < 0.5 * close : u - low < 0.5 * close) return u;
        if (y > 0) {
            low = u, a = y;
            b *= 0.5;
        } else {
            high = u, b = y;
            a *= 0.5;
        }
    }
    return 0.5 * (low + high);
}

/* The same; lines have one root, and parabolas one at which they fall. */
static double rough_root(const near_poly *p, double low, double high, double close) {
    if (p->degree > 2) return falling_root(p, low, high, close);
    const double c = p->degree == 2 ? p->c[2] : 0, b = p->c[1], a = p->c[0], root = sqrt(b * b - 4 * a * c);
    const double u = b <= 0 ? 2 * a / (root - b) : (-b - root) / (2 * c);
    return u > low ? u < high ? u : high : low; /* NaN, too */
}

/* -------------------------------------------------------------- in doubles -- */

/* With binomials C:  b[j] = sum of C(j, i) / C(d, i) c[i],  as sums of neighbours, d times. All numbers on the way are
 * at most `size`, so that each of these rounds d times no more than a last place of it. */
static void to_bernstein(const near_poly *p, failure_stretch *out) {
    const int d = p->degree;
    double binomial = 1;
    for (int i = 0; i <= d; i++) {
        out->b[i] = i && i < d ? p->c[i] / binomial : p->c[i];
        binomial = binomial * (d - i) / (i + 1);
    }
    for (int k = 1; k <= d; k++)
        for (int i = d; i >= k; i--) out->b[i] += out->b[i - 1];
    out->low = 0, out->width = 1;
    out->error = p->error + p->size * 0x1p-48;
}

/* Halves at the middle: *s keeps the left half. */
static void halve(const near_poly *p, failure_stretch *s, failure_stretch *right) {
    const int d = p->degree;
    double *b = s->b;
    s->width *= 0.5;
    s->error += p->size * 0x1p-48; /* d roundings */
    right->low = s->low + s->width, right->width = s->width, right->error = s->error;
    for (int k = 0; k < d; k++) {
        right->b[d - k] = b[d];
        for (int i = d; i > k; i--) b[i] = 0.5 * (b[i - 1] + b[i]);
    }
    right->b[0] = b[d];
}

typedef enum verdict { HOLDS, FAILS, ONE_ROOT, HALVE, HOPELESS } verdict;

static verdict judge(const near_poly *p, const failure_stretch *s) {
    int changes = 0, last = 0, unsure = 0;
    double size = 0;
    for (int i = 0; i <= p->degree; i++) {
        const int sign = s->b[i] > s->error ? 1 : s->b[i] < -s->error ? -1 : 0;
        size = fabs(s->b[i]) > size ? fabs(s->b[i]) : size;
        unsure += !sign;
        changes += last * sign < 0;
        last = sign ? sign : last;
    }
    if (!(size > 16 * s->error && p->size < (double)INFINITY)) return HOPELESS; /* NaN, too */
    if (unsure) return HALVE;
    if (!changes) return last > 0 ? HOLDS : FAILS;
    return changes == 1 && last < 0 ? ONE_ROOT : HALVE;
}

/* Where a claim fails that changes once from low to high. -1: behind the last even tick there. */
static int64_t try_one_root(const failure_search *f, const failure_stretch *s) {
    const double span = (double)f->span, high = s->low + s->width;
    const int64_t good = (int64_t)(s->low * span) & ~(int64_t)1, bad = (int64_t)(high * span) & ~(int64_t)1;
    if (bad <= good || !fails_at(f, bad)) return -1;
    return bracket(f, good, bad, (int64_t)(rough_root(f->p, s->low, high, 0.5 * f->unit) * span));
}

/* Even ticks in the interval, one by one. -1: the claim holds at all of them. */
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
    int top = 1;
    to_bernstein(f->p, stack);
    while (top) {
        failure_stretch *s = stack + --top;
        const int64_t low = (int64_t)(s->low * (double)f->span);
        const int64_t high = (int64_t)ceil((s->low + s->width) * (double)f->span);
        const verdict v = judge(f->p, s);
        int64_t at = -1;
        if (v == HOLDS) continue;
        if (v == HALVE && high - low > 4) {
            failure_stretch *left = s + 1;
            left->low = s->low, left->width = s->width, left->error = s->error;
            for (int i = 0; i <= f->p->degree; i++) left->b[i] = s->b[i];
            halve(f->p, left, s); /* the right half stays below */
            top += 2;
            continue;
        }
        if (v == FAILS)
            at = try_all(f, low, low + 4);
        else if (high - low <= 4)
            at = try_all(f, low, high);
        else
            at = v == HOPELESS ? search_exactly(f, low, 64 - __builtin_clzll((uint64_t)(high - low)))
                               : try_one_root(f, s);
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
    if (p.b == NAME_NONE) return last;
    last = least_last(now, p.a, last);
    return p.b >= 0 ? least_last(now, (uint32_t)p.b, last) : last;
}

/* When a claim that holds changes, `last` being the last tick to test; `near` is about all of this time. */
static int64_t first_change(now_state *now, const now_claim *claim, int64_t last, near_claim *near) {
    failure_search f = {now, claim, 0, now->tick, last - now->tick, 1 / (double)(last - now->tick), &near->value};
    const bool sure = near_sign_at(&near->value, 0) || near_sign_at(&near->value, 1); /* it is not always 0 */
    if (!sure && now_claim_axis(now, claim)) {
        f.axis = 1;
        near_find(now, claim, 1, (double)f.span, near);
    }
    return find_first_failure(&f);
}

static int64_t first_change_until(now_state *now, const now_claim *claim, int64_t last) {
    near_claim near;
    if (last - now->tick < 2) return NOW_NEVER;
    near_find(now, claim, 0, (double)(last - now->tick), &near);
    return first_change(now, claim, last, &near);
}

/* Does a polynomial surely keep its sign in this share of its range? */
static bool keeps_sign(const near_poly *p, double share) {
    failure_stretch s;
    near_poly part = {.degree = p->degree, .size = p->size, .error = p->error};
    double power = 1;
    for (int i = 0; i <= p->degree; i++, power *= share) part.c[i] = p->c[i] * power;
    to_bernstein(&part, &s);
    const verdict v = judge(&part, &s);
    return v == HOLDS || v == FAILS;
}

/* When the denominators behind a claim first change their signs, until `last`, in so many ticks from now of those that
 * `near` is about. */
static int64_t first_pole(now_state *now, const now_claim *claim, int64_t last, const near_claim *near, int64_t span) {
    const name_point name[2] = {claim->p, claim->q};
    const double share = (double)(last - now->tick) / (double)span * (1 + 0x1p-50);
    int64_t first = NOW_NEVER;
    for (int i = 0; i < 2; i++) {
        now_claim turn = {name[i], {0, NAME_NONE}, 1};
        if (!name_is_crossing(name[i]) || (near->has_turn[i] && keeps_sign(near->turn + i, share))) continue;
        if (now_holds(now, &turn) < 0) turn.above = -1;
        const int64_t tick = first_change_until(now, &turn, first < last ? first : last);
        first = tick < first ? tick : first;
    }
    return first;
}

/* The polynomial has the sign that the predicates give only as long as no denominator changes its own. A crossing gets
 * to where its lines are parallel from outside of its segments, and the claim is gone by then, if ticks are short. If
 * they are not, it may leave its segments, pass infinity and be back within one. So then the claim is tested, too.
 */
static int64_t any_first_failure(now_state *now, const now_claim *claim) {
    const int64_t last = named_last(now, claim->q, named_last(now, claim->p, now->motion->last_tick | 1));
    const bool along = claim->above == NOW_ALONG, some = last - now->tick >= 2;
    near_claim near;
    int holds = 0;
    if (some && !along) {
        near_find(now, claim, 0, (double)(last - now->tick), &near);
        holds = near_sign_at(&near.value, 0);
    }
    if (!holds) holds = now_holds(now, claim);
    if (holds <= 0) return holds ? now->tick : NOW_NEVER;
    if (!some) return NOW_NEVER;
    if (along) near_find(now, claim, 0, (double)(last - now->tick), &near);
    const int64_t first = first_change(now, claim, last, &near);
    const int64_t pole = first_pole(now, claim, first < last ? first : last, &near, last - now->tick);
    if (pole == NOW_NEVER) return first;
    const int64_t before = first_change_until(now, claim, pole - 2);
    return before < pole ? before : pole;
}

int64_t now_first_failure(now_state *now, const now_claim *claim) {
    int64_t straight;
    return straight_first_failure(now, claim, &straight) ? straight : any_first_failure(now, claim);
}
