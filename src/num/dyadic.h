/* dyadic.h: exact numbers  sign * sum d[i] * 2^(64 (exponent + i)),  closed under + - *.
 *
 * Every predicate on doubles is a ring expression, so nothing else is needed: no
 * gcd, no division (but where it leaves no remainder, for num/solve.h), no rounding, no overflow
 * (the whole double range, denormals included, spans 33 limbs). Limbs come from an arena that a predicate resets when
 * it starts; its size bounds the worst case of the deepest predicate, so that a
 * predicate cannot fail (num_arena_new is where memory may run out). */
#ifndef FROE_NUM_DYADIC_H
#define FROE_NUM_DYADIC_H
#include "support/alloc.h"

typedef struct num_arena {
    uint64_t *limbs;
    size_t top, capacity, high; /**< high: most limbs ever used, for the tests of the bound */
} num_arena;

/** Limbs that suffice for any predicate on any finite doubles. */
extern const size_t num_arena_bound;
froe_status num_arena_new(const froe_allocator *alloc, num_arena *out);
/** Room for so many limbs; what it held is lost. FROE_E_MEMORY. */
froe_status num_arena_reserve(const froe_allocator *alloc, num_arena *arena, size_t limbs);
void num_arena_free(const froe_allocator *alloc, num_arena *arena);

typedef struct num_dyadic {
    int sign, exponent; /**< -1, 0, 1; of limb 0, in limbs */
    uint32_t count;     /**< limbs; 0 iff sign is 0; first and last limb are not 0 */
    const uint64_t *limbs;
} num_dyadic;

num_dyadic num_dyadic_from(num_arena *arena, double x); /**< x finite */
/** sign * whole * 2^power. */
num_dyadic num_dyadic_scaled(num_arena *arena, int sign, uint64_t whole, int power);
static inline num_dyadic num_dyadic_neg(num_dyadic a) {
    a.sign = -a.sign;
    return a;
}
num_dyadic num_dyadic_add(num_arena *arena, num_dyadic a, num_dyadic b);
num_dyadic num_dyadic_sub(num_arena *arena, num_dyadic a, num_dyadic b);
num_dyadic num_dyadic_mul(num_arena *arena, num_dyadic a, num_dyadic b);
int num_dyadic_compare(num_dyadic a, num_dyadic b); /**< sign of a - b */
/** a / b where that is a dyadic number, b != 0: what elimination without fractions divides. */
num_dyadic num_dyadic_divide(num_arena *arena, num_dyadic a, num_dyadic b);
/** The number itself, at the mark: all that was made behind the mark and is no part of it is given back. */
num_dyadic num_dyadic_keep(num_arena *arena, size_t mark, num_dyadic a);
/** In quotient.c. The double nearest to a / b, ties to even, b != 0; infinity when out of range; never -0. */
double num_dyadic_quotient(num_arena *arena, num_dyadic a, num_dyadic b);
#endif
