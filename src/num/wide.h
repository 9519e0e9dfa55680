/* wide.h: integers of 320 bits on the stack, in two's complement: + - * are modulo 2^320, so that the caller has to
 * know that no result is as large as 2^319. No loop depends on a number. */
#ifndef FROE_NUM_WIDE_H
#define FROE_NUM_WIDE_H
#include <stdint.h>

enum { NUM_WIDE_LIMBS = 5, NUM_WIDE_BITS = 64 * NUM_WIDE_LIMBS - 1 };

__extension__ typedef __int128 num_short;
__extension__ typedef unsigned __int128 num_limbs2;

typedef struct num_wide {
    uint64_t d[NUM_WIDE_LIMBS]; /**< the least first */
} num_wide;

static inline num_wide num_wide_from(num_short x) {
    const uint64_t rest = x < 0 ? UINT64_MAX : 0;
    num_wide out = {{(uint64_t)x, (uint64_t)((num_limbs2)x >> 64)}};
    for (int i = 2; i < NUM_WIDE_LIMBS; i++) out.d[i] = rest;
    return out;
}

/** 2^power, 0 <= power < NUM_WIDE_BITS. */
static inline num_wide num_wide_power(int power) {
    num_wide out = {{0}};
    out.d[power / 64] = (uint64_t)1 << power % 64;
    return out;
}

static inline num_wide num_wide_add(num_wide a, num_wide b) {
    uint64_t carry = 0;
    for (int i = 0; i < NUM_WIDE_LIMBS; i++) {
        num_limbs2 t = (num_limbs2)a.d[i] + b.d[i] + carry;
        a.d[i] = (uint64_t)t;
        carry = (uint64_t)(t >> 64);
    }
    return a;
}

static inline num_wide num_wide_sub(num_wide a, num_wide b) {
    uint64_t borrow = 0;
    for (int i = 0; i < NUM_WIDE_LIMBS; i++) {
        num_limbs2 t = (num_limbs2)a.d[i] - b.d[i] - borrow;
        a.d[i] = (uint64_t)t;
        borrow = (uint64_t)(t >> 64) & 1;
    }
    return a;
}

static inline num_wide num_wide_mul(num_wide a, num_wide b) {
    num_wide out = {{0}};
    for (int i = 0; i < NUM_WIDE_LIMBS; i++) {
        uint64_t carry = 0;
        for (int j = 0; i + j < NUM_WIDE_LIMBS; j++) {
            num_limbs2 t = (num_limbs2)a.d[i] * b.d[j] + out.d[i + j] + carry;
            out.d[i + j] = (uint64_t)t;
            carry = (uint64_t)(t >> 64);
        }
    }
    return out;
}

static inline int num_wide_sign(num_wide a) {
    uint64_t any = 0;
    for (int i = 0; i < NUM_WIDE_LIMBS; i++) any |= a.d[i];
    return a.d[NUM_WIDE_LIMBS - 1] >> 63 ? -1 : any != 0;
}
#endif
