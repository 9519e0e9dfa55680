/* poly.c: see poly.h. */
#include "num/poly.h"

void num_poly_trim(num_poly *f, int most) {
    f->degree = most;
    while (f->degree >= 0 && !f->c[f->degree].sign) f->degree--;
}

/* The nearest double; beyond the range of doubles it is infinite, and nothing is known. */
static num_ball ball_of(num_arena *arena, num_dyadic a) {
    double x = num_dyadic_quotient(arena, a, num_dyadic_scaled(arena, 1, 1, 0));
    bool exact = a.count <= 1 && fabs(x) < 0x1p53 && a.exponent == 0;
    return (num_ball){x, exact || !a.sign ? 0 : fabs(x) * 0x1p-53 + 0x1p-1074};
}

num_ball_poly num_poly_balls(num_arena *arena, const num_poly *f) {
    num_ball_poly out = {.degree = f->degree};
    size_t mark = arena->top;
    for (int i = 0; i <= f->degree; i++) {
        out.c[i] = ball_of(arena, f->c[i]);
        arena->top = mark;
    }
    return out;
}

num_ball num_ball_poly_at(const num_ball_poly *f, num_ball x) {
    num_ball sum = num_ball_from(0);
    for (int i = f->degree; i >= 0; i--) sum = num_ball_add(num_ball_mul(sum, x), f->c[i]);
    return sum;
}

int num_poly_sign(num_arena *arena, const num_poly *f, num_dyadic x) {
    size_t mark = arena->top;
    num_dyadic sum = {0};
    for (int i = f->degree; i >= 0; i--) sum = num_dyadic_add(arena, num_dyadic_mul(arena, sum, x), f->c[i]);
    arena->top = mark;
    return sum.sign;
}

static num_poly derivative(num_arena *arena, const num_poly *f) {
    num_poly d = {.degree = f->degree - 1};
    for (int i = 1; i <= f->degree; i++)
        d.c[i - 1] = num_dyadic_mul(arena, f->c[i], num_dyadic_scaled(arena, 1, (uint64_t)i, 0));
    return d;
}

static num_poly product(num_arena *arena, const num_poly *f, const num_poly *g) {
    num_poly fg = {.degree = f->degree < 0 || g->degree < 0 ? -1 : f->degree + g->degree};
    for (int i = 0; i <= f->degree; i++)
        for (int j = 0; j <= g->degree; j++)
            fg.c[i + j] = num_dyadic_add(arena, fg.c[i + j], num_dyadic_mul(arena, f->c[i], g->c[j]));
    return fg;
}

/* A positive multiple of the remainder of a by b, not zero. Each step of pseudo-division takes |lead b| a, less the
 * multiple of b that takes a's leading term away. */
static num_poly remainder_of(num_arena *arena, num_poly a, const num_poly *b) {
    while (a.degree >= b->degree) {
        num_dyadic lead = b->c[b->degree], top = a.c[a.degree];
        if (lead.sign < 0) lead.sign = 1, top.sign = -top.sign;
        const int shift = a.degree - b->degree;
        for (int i = 0; i < a.degree; i++) a.c[i] = num_dyadic_mul(arena, a.c[i], lead);
        for (int i = 0; i < b->degree; i++)
            a.c[i + shift] = num_dyadic_sub(arena, a.c[i + shift], num_dyadic_mul(arena, top, b->c[i]));
        num_poly_trim(&a, a.degree - 1);
    }
    return a;
}

num_chain num_chain_of(num_arena *arena, const num_poly *f, const num_poly *g) {
    num_chain chain = {1, {*f}};
    num_poly next = derivative(arena, f);
    if (g) {
        next = product(arena, &next, g);
        next = remainder_of(arena, next, f); /* which changes no sign at a root of f */
    }
    while (next.degree >= 0) {
        const num_poly *last = &chain.p[chain.count - 1];
        chain.p[chain.count++] = next;
        next = remainder_of(arena, *last, &chain.p[chain.count - 1]);
        for (int i = 0; i <= next.degree; i++) next.c[i].sign = -next.c[i].sign;
    }
    return chain;
}

int num_chain_variations(num_arena *arena, const num_chain *chain, num_dyadic x) {
    int variations = 0, last = 0;
    for (int i = 0; i < chain->count; i++) {
        int sign = num_poly_sign(arena, &chain->p[i], x);
        variations += sign * last < 0;
        if (sign) last = sign;
    }
    return variations;
}

/* Horner's scheme evaluates f, and its partial sums are the quotient (Ruffini). */
num_poly num_poly_without(num_arena *arena, const num_poly *f, num_dyadic x) {
    num_poly g = *f;
    while (g.degree > 0) {
        num_poly quotient = {.degree = g.degree - 1};
        num_dyadic sum = g.c[g.degree];
        for (int i = g.degree - 1; i >= 0; i--) {
            quotient.c[i] = sum;
            sum = num_dyadic_add(arena, num_dyadic_mul(arena, sum, x), g.c[i]);
        }
        if (sum.sign) break;
        g = quotient;
    }
    return g;
}

/* A step of pseudo-division by b turns a into |a| + |b| limbs. From degree 4 and coefficients of 1 limb each that gives
 * 1 1 3 7 17 in a chain; f' g, of 2 limbs and degree 7, modulo f makes it 1 6 13 32 77. No polynomial has more than 8
 * coefficients, and the longest are few: all together hold less than 64 times the longest. */
size_t num_poly_arena(size_t limbs, size_t argument) {
    enum { GROWTH = 77, NUMBERS = 64, DEGREE = 8 };
    return (size_t)NUMBERS * ((limbs + 2) * GROWTH + DEGREE * (argument + 2));
}
