/* isolate.c: bisection until a root is alone, by Descartes' rule with error bounds or else by Sturm's counts; by signs
 * from then on. */
#include "num/isolate.h"
#include <string.h>

static num_dyadic fraction(const uint64_t *limbs) {
    int low = 0, high = NUM_FRACTION_LIMBS;
    while (high > 0 && !limbs[high - 1]) high--;
    while (low < high && !limbs[low]) low++;
    if (low == high) return (num_dyadic){0};
    return (num_dyadic){1, low - NUM_FRACTION_LIMBS, (uint32_t)(high - low), limbs + low};
}

num_dyadic num_isolated_low(const num_isolated *root) {
    return fraction(root->lo);
}

num_dyadic num_isolated_high(num_arena *arena, const num_isolated *root) {
    num_dyadic low = fraction(root->lo);
    return root->exact ? low : num_dyadic_add(arena, low, num_dyadic_scaled(arena, 1, 1, -root->depth));
}

static num_ball low_ball(const num_isolated *root) {
    const uint64_t top = root->lo[NUM_FRACTION_LIMBS - 1];
    bool cut = (top & 0x7ff) || root->depth > 64;
    return (num_ball){(double)(top >> 11) * 0x1p-53, cut ? 0x1p-53 : 0}; /* what is cut off is less */
}

num_ball num_isolated_ball(const num_isolated *root) {
    const num_ball low = low_ball(root);
    if (root->exact) return low;
    double half = ldexp(0.5, -root->depth); /* low + half may round: one more unit */
    return (num_ball){low.x + half, half * NUM_BALL_UP + 0x1p-53 + low.e};
}

/* Sign of the polynomial at lo. */
static int sign_at_low(num_arena *arena, const num_isolated *at) {
    int sign = num_ball_sign(num_ball_poly_at(&at->of->near, low_ball(at)));
    return sign == NUM_UNSURE ? num_poly_sign(arena, &at->of->chain.p[0], fraction(at->lo)) : sign;
}

/* The upper half of an interval. */
static num_isolated upper_half(const num_isolated *root) {
    num_isolated half = *root;
    const int bit = 64 * NUM_FRACTION_LIMBS - ++half.depth; /* of 2^-depth */
    half.lo[bit / 64] |= (uint64_t)1 << (bit % 64);
    return half;
}

/* ------------------------------------------------------------------ one root -- */

bool num_isolated_refine(num_arena *arena, num_isolated *root) {
    if (root->exact) return true;
    if (root->depth == NUM_MOST_DEPTH) return false;
    num_isolated half = upper_half(root);
    int sign = sign_at_low(arena, &half);
    half.exact = sign == 0;
    const num_chain *chain = &root->of->chain;
    const bool above = !root->even ? sign == root->low_sign
                                   : num_chain_variations(arena, chain, fraction(root->lo)) ==
                                         num_chain_variations(arena, chain, fraction(half.lo));
    if (half.exact || above)
        *root = half;
    else
        root->depth++;
    return true;
}

static double value(const num_ball_poly *p, double s) {
    double y = 0;
    for (int i = p->degree; i >= 0; i--) y = y * s + p->c[i].x;
    return y;
}

/* Roughly where a polynomial changes its sign between low and high: Illinois' method. */
static double rough_root(const num_ball_poly *p, double low, double high, double near) {
    double a = value(p, low), b = value(p, high), s = low;
    for (int i = 0; i < 40 && high - low > near; i++) {
        s = high - b * ((high - low) / (b - a));
        if (!(s > low && s < high)) return 0.5 * (low + high);
        double y = value(p, s);
        if (fabs(y) <= 0x1p-60 * (fabs(a) + fabs(b))) return s;
        if ((y > 0) == (a > 0)) {
            low = s, a = y;
            b *= 0.5;
        } else {
            high = s, b = y;
            a *= 0.5;
        }
    }
    return s;
}

/* Guesses the interval of a depth that a simple root is in, and verifies it. False: the guess was wrong. */
static bool jump(num_arena *arena, num_isolated *root, int depth) {
    const num_ball around = num_isolated_ball(root);
    const double unit = ldexp(1, -depth), half = ldexp(0.5, -root->depth);
    /* the ends of the interval are exact, as it has less than 46 bits, and the guess is between them */
    const double at = floor(rough_root(&root->of->near, around.x - half, around.x + half, unit) / unit);
    const double last = (around.x + half) / unit - 1;
    num_isolated low = {.of = root->of, .depth = depth, .low_sign = root->low_sign}, high = low;
    low.lo[NUM_FRACTION_LIMBS - 1] = (uint64_t)at << (64 - depth);
    high.lo[NUM_FRACTION_LIMBS - 1] = (uint64_t)(at + 1) << (64 - depth); /* 0 where it is 1, the end */
    if (sign_at_low(arena, &low) != root->low_sign || (at < last && sign_at_low(arena, &high) != -root->low_sign))
        return false;
    *root = low;
    return true;
}

bool num_isolated_narrow(num_arena *arena, num_isolated *root, int depth) {
    enum { LEAST = 12, SURE = 46 }; /* bits that are worth a guess, and that doubles tell of a root */
    const int guess = depth < SURE ? depth : SURE;
    if (!root->exact && !root->even && guess - root->depth >= LEAST) jump(arena, root, guess);
    while (!root->exact && root->depth < depth)
        if (!num_isolated_refine(arena, root)) return false;
    return true;
}

/* ----------------------------------------------------------------- isolation -- */

/* Is there one root between lo and its upper end? Neither end is a root. */
static bool is_alone(num_arena *arena, num_isolated *at) {
    const num_chain *chain = &at->of->chain;
    size_t mark = arena->top;
    num_dyadic low = fraction(at->lo), high = num_isolated_high(arena, at);
    bool alone = num_chain_variations(arena, chain, low) - num_chain_variations(arena, chain, high) == 1;
    if (alone) {
        at->low_sign = num_poly_sign(arena, &chain->p[0], low);
        at->even = at->low_sign == num_poly_sign(arena, &chain->p[0], high);
    }
    arena->top = mark;
    return alone;
}

typedef enum outcome { FOUND, HIT, TOO_CLOSE } outcome;

/* Narrows 0 .. 1 to the k-th root, k = 1, 2, ...; `before`: variations at 0. HIT: what is now exact is a root, maybe
 * another one. Sturm's theorem does not speak of points that are multiple roots. */
static outcome find_root(num_arena *arena, int before, int k, num_isolated *at) {
    const num_chain *chain = &at->of->chain;
    while (!is_alone(arena, at)) {
        if (at->depth == NUM_MOST_DEPTH) return TOO_CLOSE;
        num_isolated half = upper_half(at);
        num_dyadic middle = fraction(half.lo);
        half.exact = !num_poly_sign(arena, &chain->p[0], middle);
        if (half.exact || before - num_chain_variations(arena, chain, middle) < k)
            *at = half;
        else
            at->depth++;
        if (half.exact) return HIT;
    }
    return FOUND;
}

/* ------------------------------------------------------------ by error bounds -- */

/* A polynomial over a half of a half ... of 0 .. 1, as one over 0 .. 1. */
typedef struct patch {
    num_ball_poly f;
    int depth;
    uint64_t lo; /* of 2^-64 */
} patch;

static patch half_patch(const patch *p, bool upper) {
    const int depth = p->depth + 1;
    return (patch){num_ball_poly_half(&p->f, upper), depth, p->lo | (upper ? (uint64_t)1 << (64 - depth) : 0)};
}

/* Descartes' rule tells for sure of no root or one where the coefficients of Bernstein have sure signs; else halves are
 * looked at. False: it cannot tell. */
static bool find_by_balls(num_isolation *out) {
    enum { MOST = 24 };
    patch stack[MOST + 1]; /* the upper half of each depth, and the patch at hand */
    int count = 1;
    stack[0] = (patch){out->near, 0, 0};
    out->count = 0;
    while (count) {
        patch p = stack[--count];
        int sign[NUM_DEGREE + 1];
        const int changes = num_ball_poly_changes(&p.f, sign);
        /* the low end is no root: 0 is none, and others were the high end of a patch before */
        if (sign[0] == NUM_UNSURE || sign[p.f.degree] == NUM_UNSURE || !sign[p.f.degree]) return false;
        if (changes == 0) continue;
        if (changes == 1) {
            num_isolated *root = &out->root[out->count++];
            *root = (num_isolated){.of = out, .depth = p.depth, .low_sign = sign[0]};
            root->lo[NUM_FRACTION_LIMBS - 1] = p.lo;
            continue;
        }
        if (p.depth == MOST) return false;
        stack[count++] = half_patch(&p, true);
        stack[count++] = half_patch(&p, false);
    }
    return true;
}

/* --------------------------------------------------------------- by exact counts -- */

/* All roots of the chain's polynomial behind the `exact` ones that are known, until a middle is hit. */
static outcome find_all(num_arena *arena, num_isolation *out, int exact) {
    int before = num_chain_variations(arena, &out->chain, (num_dyadic){0});
    size_t mark = arena->top;
    int count = before - num_chain_variations(arena, &out->chain, num_dyadic_scaled(arena, 1, 1, 0));
    arena->top = mark;
    for (int k = 1; k <= count; k++) {
        num_isolated *at = &out->root[exact + k - 1];
        *at = (num_isolated){.of = out};
        outcome found = find_root(arena, before, k, at);
        if (found == HIT) out->root[exact] = *at;
        if (found != FOUND) return found;
    }
    out->count = exact + count;
    return FOUND;
}

void num_isolate(num_arena *arena, const num_poly *f, num_isolation *out) {
    num_poly inside = num_poly_without(arena, f, (num_dyadic){0});
    inside = num_poly_without(arena, &inside, num_dyadic_scaled(arena, 1, 1, 0));
    out->chain.count = 1;
    out->chain.p[0] = inside;
    out->near = num_poly_balls(arena, &inside);
    out->count = 0;
    if (inside.degree < 1 || find_by_balls(out)) return;
    outcome found = HIT;
    for (int exact = 0; found == HIT; exact++) {
        if (exact) inside = num_poly_without(arena, &inside, fraction(out->root[exact - 1].lo));
        num_chain_of(arena, &inside, NULL, &out->chain);
        out->near = num_poly_balls(arena, &inside);
        found = find_all(arena, out, exact);
    }
    if (found == TOO_CLOSE) out->count = -1;
    /* The exact roots, which come first and in any order, go to their places. Roots of one polynomial are apart. */
    for (int i = 1; i < out->count; i++) {
        num_isolated moved = out->root[i];
        int j = i;
        for (; j > 0 && num_isolated_compare(arena, &moved, &out->root[j - 1]) < 0; j--)
            out->root[j] = out->root[j - 1];
        out->root[j] = moved;
    }
}

/* --------------------------------------------------------------- comparisons -- */

int num_isolated_sign(num_arena *arena, const num_isolated *root, const num_poly *g, const num_ball_poly *near) {
    int sign = num_ball_sign(num_ball_poly_at(near, num_isolated_ball(root)));
    if (sign != NUM_UNSURE) return sign;
    if (root->exact) return num_poly_sign(arena, g, fraction(root->lo));
    /* by Tarski's query: the sum over one root */
    const size_t mark = arena->top;
    num_chain chain;
    num_chain_of(arena, &root->of->chain.p[0], g, &chain);
    const int low = num_chain_variations(arena, &chain, fraction(root->lo));
    sign = low - num_chain_variations(arena, &chain, num_isolated_high(arena, root));
    arena->top = mark;
    return sign;
}

/* -1, 1: apart; 0: one interval holds the other, or they are the same point. */
static int place_of_roots(num_arena *arena, const num_isolated *a, const num_isolated *b) {
    size_t mark = arena->top;
    num_dyadic low_a = fraction(a->lo), low_b = fraction(b->lo);
    num_dyadic high_a = num_isolated_high(arena, a), high_b = num_isolated_high(arena, b);
    int below = num_dyadic_compare(high_a, low_b), above = num_dyadic_compare(high_b, low_a);
    arena->top = mark;
    bool points = a->exact && b->exact;
    return below < 0 || (below == 0 && !points) ? -1 : above < 0 || (above == 0 && !points) ? 1 : 0;
}

int num_isolated_compare(num_arena *arena, num_isolated *a, num_isolated *b) {
    enum { PATIENCE = 24 }; /* halvings before the exact test of equality */
    for (int round = 0;; round++) {
        int order = place_of_roots(arena, a, b);
        if (order) return order;
        if (a->exact && b->exact) return 0;
        /* the outer polynomial has one root in the outer interval, which holds the inner root */
        if (round == PATIENCE) {
            num_isolated *inner = a->exact || (!b->exact && a->depth >= b->depth) ? a : b, *outer = inner == a ? b : a;
            if (!num_isolated_sign(arena, inner, &outer->of->chain.p[0], &outer->of->near)) return 0;
        }
        num_isolated *wider = b->exact || (!a->exact && a->depth <= b->depth) ? a : b;
        if (!num_isolated_refine(arena, wider)) return NUM_UNSURE;
    }
}
