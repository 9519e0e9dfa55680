/* root.c: signs by squaring; the nearest double by bisection among bit patterns.
 *
 * The patterns of doubles >= 0, read as whole numbers, ascend with their values, and the pattern after that of the
 * greatest finite one is infinity's: so rounding is a search among whole numbers. */
#include "num/root.h"
#include <string.h>

int num_root_sign(num_arena *arena, num_dyadic a, num_dyadic b, num_dyadic c) {
    if (!b.sign || !c.sign || a.sign == b.sign) return a.sign;
    if (!a.sign) return b.sign;
    num_dyadic bb = num_dyadic_mul(arena, num_dyadic_mul(arena, b, b), c);
    return a.sign * num_dyadic_compare(num_dyadic_mul(arena, a, a), bb);
}

int num_ratio_compare(num_arena *arena, num_ratio a, num_ratio b) {
    return num_dyadic_compare(num_dyadic_mul(arena, a.top, b.bottom), num_dyadic_mul(arena, b.top, a.bottom));
}

/* sqrt(a) - (sqrt(b) + e), e > 0: both sides are >= 0 and may be squared. With a = A/C and b = B/D that is the sign of
 * AD - BC - e^2 CD  -  2 e C sqrt(BD). */
static int compare_raised(num_arena *arena, num_ratio a, num_ratio b, num_dyadic e) {
    num_dyadic left = num_dyadic_mul(arena, a.top, b.bottom), right = num_dyadic_mul(arena, b.top, a.bottom);
    num_dyadic ec = num_dyadic_mul(arena, e, a.bottom);
    num_dyadic whole = num_dyadic_sub(arena, num_dyadic_sub(arena, left, right),
                                      num_dyadic_mul(arena, num_dyadic_mul(arena, ec, e), b.bottom));
    num_dyadic factor = num_dyadic_mul(arena, num_dyadic_scaled(arena, -1, 2, 0), ec);
    return num_root_sign(arena, whole, factor, num_dyadic_mul(arena, b.top, b.bottom));
}

int num_roots_compare(num_arena *arena, num_ratio a, num_ratio b, num_dyadic e) {
    if (!e.sign) return num_ratio_compare(arena, a, b);
    if (e.sign > 0) return compare_raised(arena, a, b, e);
    e.sign = 1;
    return -compare_raised(arena, b, a, e);
}

/* ---------------------------------------------------------------- rounding -- */

static const uint64_t GREATEST = 0x7fefffffffffffff, FRACTION = 0xfffffffffffff;

typedef struct double_search {
    num_arena *arena;
    size_t mark;
    num_compare_fn *compare;
    void *user;
} double_search;

static double double_of(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Is the value at least the double with these bits? */
static bool reaches(const double_search *s, uint64_t bits) {
    s->arena->top = s->mark;
    return s->compare(s->user, s->arena, num_dyadic_from(s->arena, double_of(bits))) >= 0;
}

/* The value against half way from this double to the next. */
static int beyond_half(const double_search *s, uint64_t bits) {
    uint64_t exponent = bits >> 52, whole = bits & FRACTION;
    if (exponent)
        whole |= FRACTION + 1;
    else
        exponent = 1;
    s->arena->top = s->mark;
    return s->compare(s->user, s->arena, num_dyadic_scaled(s->arena, 1, 2 * whole + 1, (int)exponent - 1076));
}

/* The greatest finite double that the value reaches; steps double from the guess, then halve. */
static uint64_t greatest_reached(const double_search *s, uint64_t guess) {
    uint64_t low = 0, high = GREATEST + 1, step = 1; /* reached; not reached */
    if (reaches(s, guess)) {
        for (low = guess; GREATEST - low >= step && reaches(s, low + step); step *= 2) low += step;
        if (GREATEST - low >= step) high = low + step;
    } else {
        for (high = guess; high > step && !reaches(s, high - step); step *= 2) high -= step;
        if (high > step) low = high - step;
    }
    while (high - low > 1) {
        uint64_t middle = low + (high - low) / 2;
        if (reaches(s, middle))
            low = middle;
        else
            high = middle;
    }
    return low;
}

double num_nearest(num_arena *arena, num_compare_fn *compare, void *user, double guess) {
    double_search s = {arena, arena->top, compare, user};
    uint64_t bits = 0;
    if (guess > 0) memcpy(&bits, &guess, sizeof bits);
    uint64_t low = greatest_reached(&s, bits < GREATEST ? bits : GREATEST);
    int beyond = beyond_half(&s, low);
    return double_of(beyond > 0 || (beyond == 0 && (low & 1)) ? low + 1 : low);
}

/* Sign of a surd >= 0 minus x. */
static int surd_against(void *user, num_arena *arena, num_dyadic x) {
    const num_surd *a = user;
    return num_root_sign(arena, num_dyadic_sub(arena, a->p, num_dyadic_mul(arena, a->s, x)), a->q, a->r);
}

double num_surd_round(num_arena *arena, num_surd a) {
    if (!a.q.sign || !a.r.sign) return num_dyadic_quotient(arena, a.p, a.s);
    const num_dyadic one = num_dyadic_scaled(arena, 1, 1, 0);
    const int sign = num_root_sign(arena, a.p, a.q, a.r);
    if (!sign) return 0;
    a.p.sign *= sign;
    a.q.sign *= sign;
    const double guess = num_dyadic_quotient(arena, a.p, a.s) +
                         num_dyadic_quotient(arena, a.q, a.s) * sqrt(num_dyadic_quotient(arena, a.r, one));
    const double x = num_nearest(arena, surd_against, &a, guess);
    return x > 0 ? sign * x : 0;
}
