/* dyadic.c: schoolbook arithmetic on 64-bit limbs whose exponent is a multiple of
 * 64, so that nothing is ever shifted. At predicate sizes (2 to 300 limbs) this
 * runs as fast as GMP; see docs/explanation/numerics.md. */
#include "num/dyadic.h"
#include <assert.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

/* A double reaches from 2^-1074 to below 2^1024: limbs -17 .. 15, 33 of them; so a
 * number of degree k has at most 33 k limbs, and one for carries. A sum allocates one
 * limb more than it may need, a product no more than it may have: a step of degree k
 * takes at most 33 k + 2 limbs (k >= 1).
 *
 * The deepest predicate today, the corner of three planes through input points
 * against a fourth, takes (steps of each degree; see predicate_body.inc)
 *     degree 1    45 doubles (2 limbs), 24 + 12 differences          1 350
 *     degree 2    normals: 4 x (6 products + 3 differences)          2 448
 *     degree 3    3 plane values x (3 products + 3 sums)             1 818
 *     degree 4    3 cross products x 9                               3 618
 *     degree 6    4 triple products x 5                              4 000
 *     degree 9    4 products, 3 sums                                 2 093
 * about 16 000 limbs. Sheared planes (num/sheared.h) have simpler normals, but numbers of up to three terms: at
 * most six times the steps from degree 6 on, 50 000 limbs. Planes through an eye and a cut edge (normals of degree 5)
 * take at most 60 steps of degree 5 a plane (4 x 60 x 167), 27 of degree 10 (332), 20 of degree 15 (497) and 7 of
 * degree 21 (695): 63 800.
 *
 * Above dimension 3 tables are solved (num/solve.h). The largest has the 8 x 9 products of edges of a simplex, degree
 * 2, and numbers of degree 16 in the end: 38 000 limbs, as many for the step before, and 10 000 for points and one
 * step; a distance keeps those of the last step, and two are compared: 140 000. Linear programs have 10 x 12 numbers of
 * degree 1, of degree 10 in the end: 40 000 limbs, and as many before. */
const size_t num_arena_bound = 1 << 18;

froe_status num_arena_new(const froe_allocator *alloc, num_arena *out) {
    uint64_t *limbs = support_realloc(alloc, NULL, 0, num_arena_bound * sizeof *limbs);
    if (!limbs) return FROE_E_MEMORY;
    *out = (num_arena){limbs, 0, num_arena_bound, 0};
    return FROE_OK;
}

froe_status num_arena_reserve(const froe_allocator *alloc, num_arena *arena, size_t limbs) {
    if (arena->capacity >= limbs) return FROE_OK;
    uint64_t *more = support_realloc(alloc, NULL, 0, limbs * sizeof *more);
    if (!more) return FROE_E_MEMORY;
    support_free(alloc, arena->limbs, arena->capacity * sizeof *arena->limbs);
    *arena = (num_arena){more, 0, limbs, arena->high};
    return FROE_OK;
}

void num_arena_free(const froe_allocator *alloc, num_arena *arena) {
    support_free(alloc, arena->limbs, arena->capacity * sizeof *arena->limbs);
    *arena = (num_arena){0};
}

static uint64_t *take_limbs(num_arena *arena, uint32_t count) {
    uint64_t *limbs = arena->limbs + arena->top;
    arena->top += count;
    assert(arena->top <= arena->capacity);
    if (arena->top > arena->high) arena->high = arena->top;
    return limbs;
}

/* Strips zero limbs from both ends. */
static num_dyadic trim_limbs(int sign, int exponent, uint32_t count, const uint64_t *limbs) {
    while (count && limbs[count - 1] == 0) count--;
    while (count && limbs[0] == 0) limbs++, exponent++, count--;
    if (!count) return (num_dyadic){0};
    return (num_dyadic){sign, exponent, count, limbs};
}

num_dyadic num_dyadic_scaled(num_arena *arena, int sign, uint64_t whole, int power) {
    int exponent = power >= 0 ? power / 64 : -((63 - power) / 64), shift = power - 64 * exponent;
    uint64_t *limbs = take_limbs(arena, 2);
    limbs[0] = whole << shift;
    limbs[1] = shift ? whole >> (64 - shift) : 0;
    return trim_limbs(sign, exponent, 2, limbs);
}

num_dyadic num_dyadic_from(num_arena *arena, double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    uint64_t mantissa = bits & 0xfffffffffffffu;
    int power = (int)(bits >> 52 & 0x7ff);
    if (power)
        mantissa |= (uint64_t)1 << 52;
    else
        power = 1; /* denormals are ordinary here */
    if (!mantissa) return (num_dyadic){0};
    return num_dyadic_scaled(arena, bits >> 63 ? -1 : 1, mantissa, power - 1075);
}

static int top_of(num_dyadic a) {
    return a.exponent + (int)a.count;
}

/* Below its top. */
static uint64_t limb_at(num_dyadic a, int place) {
    return place >= a.exponent ? a.limbs[place - a.exponent] : 0;
}

static int compare_magnitudes(num_dyadic a, num_dyadic b) {
    if (top_of(a) != top_of(b)) return top_of(a) > top_of(b) ? 1 : -1;
    int low = a.exponent < b.exponent ? a.exponent : b.exponent;
    for (int place = top_of(a) - 1; place >= low; place--) {
        uint64_t x = limb_at(a, place), y = limb_at(b, place);
        if (x != y) return x > y ? 1 : -1;
    }
    return 0;
}

int num_dyadic_compare(num_dyadic a, num_dyadic b) {
    if (a.sign != b.sign) return a.sign > b.sign ? 1 : -1;
    return a.sign ? a.sign * compare_magnitudes(a, b) : 0;
}

/* The limbs of a from place `low` on, `count` of them, zeros around. Loops, not memcpy: a is short. */
static uint64_t *spread_limbs(num_arena *arena, num_dyadic a, int low, uint32_t count) {
    uint64_t *limbs = take_limbs(arena, count), *at = limbs, *end = limbs + count;
    for (int gap = a.exponent - low; gap > 0; gap--) *at++ = 0;
    for (uint32_t i = 0; i < a.count; i++) *at++ = a.limbs[i];
    while (at < end) *at++ = 0;
    return limbs;
}

/* |a| + |b|, both not 0. */
static num_dyadic add_magnitudes(num_arena *arena, int sign, num_dyadic a, num_dyadic b) {
    int low = a.exponent < b.exponent ? a.exponent : b.exponent;
    int high = top_of(a) > top_of(b) ? top_of(a) : top_of(b);
    uint32_t count = (uint32_t)(high - low) + 1;
    uint64_t *sum = spread_limbs(arena, a, low, count);
    uint64_t carry = 0, *at = sum + (b.exponent - low);
    for (uint32_t i = 0; i < b.count; i++) {
        wide t = (wide)at[i] + b.limbs[i] + carry;
        at[i] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    for (uint64_t *rest = at + b.count; carry; rest++) carry = ++*rest == 0;
    return trim_limbs(sign, low, count, sum);
}

/* |a| - |b| for |a| > |b| > 0. */
static num_dyadic sub_magnitudes(num_arena *arena, int sign, num_dyadic a, num_dyadic b) {
    int low = a.exponent < b.exponent ? a.exponent : b.exponent;
    uint32_t count = (uint32_t)(top_of(a) - low);
    uint64_t *difference = spread_limbs(arena, a, low, count);
    uint64_t borrow = 0, *at = difference + (b.exponent - low);
    for (uint32_t i = 0; i < b.count; i++) {
        wide t = (wide)at[i] - b.limbs[i] - borrow;
        at[i] = (uint64_t)t;
        borrow = (uint64_t)(t >> 64) & 1;
    }
    for (uint64_t *rest = at + b.count; borrow; rest++) borrow = (*rest)-- == 0;
    return trim_limbs(sign, low, count, difference);
}

num_dyadic num_dyadic_add(num_arena *arena, num_dyadic a, num_dyadic b) {
    if (!a.sign) return b;
    if (!b.sign) return a;
    if (a.sign == b.sign) return add_magnitudes(arena, a.sign, a, b);
    int order = compare_magnitudes(a, b);
    if (!order) return (num_dyadic){0};
    return order > 0 ? sub_magnitudes(arena, a.sign, a, b) : sub_magnitudes(arena, b.sign, b, a);
}

num_dyadic num_dyadic_sub(num_arena *arena, num_dyadic a, num_dyadic b) {
    return num_dyadic_add(arena, a, num_dyadic_neg(b));
}

/* row[0 .. b.count) = factor * b, or += so much; the carry becomes row[b.count]. */
static void first_row(uint64_t *row, uint64_t factor, num_dyadic b) {
    uint64_t carry = 0;
    for (uint32_t j = 0; j < b.count; j++) {
        wide t = (wide)factor * b.limbs[j] + carry;
        row[j] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    row[b.count] = carry;
}

static void next_row(uint64_t *row, uint64_t factor, num_dyadic b) {
    uint64_t carry = 0;
    for (uint32_t j = 0; j < b.count && factor; j++) { /* numbers of great span are mostly zeros */
        wide t = (wide)factor * b.limbs[j] + row[j] + carry;
        row[j] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    row[b.count] = carry;
}

num_dyadic num_dyadic_mul(num_arena *arena, num_dyadic a, num_dyadic b) {
    if (!a.sign || !b.sign) return (num_dyadic){0};
    uint32_t count = a.count + b.count;
    uint64_t *product = take_limbs(arena, count);
    first_row(product, a.limbs[0], b);
    for (uint32_t i = 1; i < a.count; i++) next_row(product + i, a.limbs[i], b);
    return trim_limbs(a.sign * b.sign, a.exponent + b.exponent, count, product);
}

/* 1 / x modulo 2^64, x odd: each step of Newton's doubles the right bits, of which x has three. */
static uint64_t inverse_of(uint64_t x) {
    uint64_t y = x;
    for (int i = 0; i < 5; i++) y *= 2 - x * y;
    return y;
}

/* From the lowest limb on, as the quotient is known to end (Jebelean: An algorithm for exact division, 1993). The
 * divisor loses its lowest zero bits first, the quotient then. */
num_dyadic num_dyadic_divide(num_arena *arena, num_dyadic a, num_dyadic b) {
    if (!a.sign) return a;
    const int shift = __builtin_ctzll(b.limbs[0]);
    if (shift) b = num_dyadic_mul(arena, b, num_dyadic_scaled(arena, 1, 1, 64 - shift)); /* 2^(64 - shift) / 2^64 */
    const uint64_t inverse = inverse_of(b.limbs[0]);
    const uint32_t count = a.count - b.count + 1; /* lowest limbs are not 0: no product has fewer limbs than a factor */
    uint64_t *rest = spread_limbs(arena, a, a.exponent, a.count), *quotient = take_limbs(arena, count);
    for (uint32_t i = 0; i < count; i++) {
        quotient[i] = rest[i] * inverse;
        uint64_t carry = 0;
        for (uint32_t j = 0; j < b.count && quotient[i]; j++) { /* i + j < a.count */
            const wide product = (wide)quotient[i] * b.limbs[j] + carry;
            const uint64_t low = (uint64_t)product;
            carry = (uint64_t)(product >> 64) + (rest[i + j] < low);
            rest[i + j] -= low;
        }
        for (uint32_t j = i + b.count; j < a.count && carry; j++) {
            const uint64_t before = rest[j];
            rest[j] -= carry;
            carry = before < carry;
        }
    }
    const num_dyadic out = trim_limbs(a.sign * b.sign, a.exponent - b.exponent, count, quotient);
    return shift ? num_dyadic_mul(arena, out, num_dyadic_scaled(arena, 1, 1, 64 - shift)) : out;
}

num_dyadic num_dyadic_keep(num_arena *arena, size_t mark, num_dyadic a) {
    uint64_t *at = arena->limbs + mark;
    arena->top = mark;
    if (!a.count || a.limbs < at) return a; /* it lies before the mark, whole */
    memmove(at, a.limbs, a.count * sizeof *at);
    a.limbs = at;
    arena->top += a.count;
    return a;
}
