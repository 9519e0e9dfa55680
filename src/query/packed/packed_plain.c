/* packed_plain.c: sixteen floats as four short vectors, in the notation that gcc and clang have for any machine. */
#include "query/packed/packed_kernel.h"
#include "query/packed/space_kernel.h"
#include <math.h>
#include <string.h>

#define LANES __attribute__((always_inline)) static inline
#define LANES_KERNEL static
#define KERNELS packed_kernels_plain
#define LANES_WHOLE 0
#define KERNELS_NAME "plain"
#define SPACE_KERNELS space_kernels_plain
#define EACH_QUARTER for (int i = 0; i < 4; i++)
#define EACH_HALF for (int i = 0; i < 2; i++)

typedef float floats __attribute__((vector_size(16)));
typedef int32_t ints __attribute__((vector_size(16)));
typedef struct lanes {
    floats x[4];
} lanes;
typedef struct lanes_mask {
    ints x[4]; /* 0 or all ones */
} lanes_mask;

LANES floats pick(ints m, floats a, floats b) {
    return (floats)(((ints)a & m) | ((ints)b & ~m));
}
LANES lanes lanes_units(const uint16_t *p) {
    lanes r;
    EACH_QUARTER r.x[i] = (floats){p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]};
    return r;
}
typedef uint16_t units __attribute__((vector_size(16)));
typedef struct ulanes {
    units x[2];
} ulanes, ulanes_mask; /* of a mask: 0 or all ones */
LANES ulanes ulanes_load(const uint16_t *p) {
    ulanes r;
    memcpy(&r, p, sizeof r);
    return r;
}
LANES ulanes ulanes_bytes(const uint8_t *p) {
    ulanes r;
    EACH_HALF for (int j = 0; j < 8; j++) r.x[i][j] = p[8 * i + j];
    return r;
}
LANES ulanes ulanes_set(uint16_t x) {
    const units all = {x, x, x, x, x, x, x, x};
    return (ulanes){{all, all}};
}
LANES void ulanes_store(uint16_t *p, ulanes a) {
    memcpy(p, &a, sizeof a);
}
LANES ulanes ulanes_raise(ulanes a, ulanes b) {
    EACH_HALF {
        const units sum = a.x[i] + b.x[i];
        a.x[i] = sum | (units)(sum < b.x[i]);
    }
    return a;
}
LANES ulanes ulanes_lower(ulanes a, ulanes b) {
    EACH_HALF a.x[i] = (a.x[i] - b.x[i]) & (units)(a.x[i] > b.x[i]);
    return a;
}
LANES ulanes ulanes_min(ulanes a, ulanes b) {
    EACH_HALF {
        const units m = (units)(a.x[i] < b.x[i]);
        a.x[i] = (a.x[i] & m) | (b.x[i] & ~m);
    }
    return a;
}
LANES ulanes ulanes_max(ulanes a, ulanes b) {
    EACH_HALF {
        const units m = (units)(a.x[i] > b.x[i]);
        a.x[i] = (a.x[i] & m) | (b.x[i] & ~m);
    }
    return a;
}
LANES ulanes_mask ulanes_first(uint32_t n) {
    const units end = ulanes_set((uint16_t)(n < PACKED_LANES ? n : PACKED_LANES)).x[0];
    return (ulanes_mask){
        {(units)((units){0, 1, 2, 3, 4, 5, 6, 7} < end), (units)((units){8, 9, 10, 11, 12, 13, 14, 15} < end)}};
}
LANES ulanes_mask ulanes_le(ulanes_mask m, ulanes a, ulanes b) {
    EACH_HALF m.x[i] &= (units)(a.x[i] <= b.x[i]);
    return m;
}
/* Each lane keeps its own bit. */
LANES uint32_t ulanes_bits(ulanes_mask m) {
    const units all = (m.x[0] & (units){1, 2, 4, 8, 16, 32, 64, 128}) |
                      (m.x[1] & (units){256, 512, 1024, 2048, 4096, 8192, 16384, 32768});
    uint64_t halves[2];
    memcpy(halves, &all, sizeof all);
    halves[0] |= halves[1];
    halves[0] |= halves[0] >> 32;
    return (uint32_t)((halves[0] | halves[0] >> 16) & 0xffff);
}
LANES lanes lanes_bytes(const uint8_t *p) {
    lanes r;
    EACH_QUARTER r.x[i] = (floats){p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]};
    return r;
}
LANES four_ints lanes_four(const uint8_t *p) {
    return (four_ints){p[0], p[1], p[2], p[3]};
}
LANES void lanes_store(float *x, lanes a) {
    memcpy(x, &a, sizeof a);
}
LANES lanes lanes_sqrt(lanes a) {
    EACH_QUARTER a.x[i] = (floats){sqrtf(a.x[i][0]), sqrtf(a.x[i][1]), sqrtf(a.x[i][2]), sqrtf(a.x[i][3])};
    return a;
}
LANES lanes lanes_pick(lanes_mask m, lanes a, lanes b) {
    EACH_QUARTER a.x[i] = pick(m.x[i], a.x[i], b.x[i]);
    return a;
}
LANES lanes lanes_set(float x) {
    lanes r;
    EACH_QUARTER r.x[i] = (floats){x, x, x, x};
    return r;
}
LANES lanes lanes_add(lanes a, lanes b) {
    EACH_QUARTER a.x[i] += b.x[i];
    return a;
}
LANES lanes lanes_sub(lanes a, lanes b) {
    EACH_QUARTER a.x[i] -= b.x[i];
    return a;
}
LANES lanes lanes_mul(lanes a, lanes b) {
    EACH_QUARTER a.x[i] *= b.x[i];
    return a;
}
LANES lanes lanes_div(lanes a, lanes b) {
    EACH_QUARTER a.x[i] /= b.x[i];
    return a;
}
LANES lanes lanes_min(lanes a, lanes b) {
    EACH_QUARTER a.x[i] = pick(a.x[i] < b.x[i], a.x[i], b.x[i]);
    return a;
}
LANES lanes lanes_max(lanes a, lanes b) {
    EACH_QUARTER a.x[i] = pick(a.x[i] > b.x[i], a.x[i], b.x[i]);
    return a;
}
LANES lanes lanes_abs(lanes a) {
    EACH_QUARTER a.x[i] = (floats)((ints)a.x[i] & 0x7fffffff);
    return a;
}
LANES lanes_mask lanes_first(uint32_t n) {
    lanes_mask m;
    int32_t end = n < PACKED_LANES ? (int32_t)n : PACKED_LANES;
    EACH_QUARTER m.x[i] = (ints){4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3} < end;
    return m;
}
LANES lanes_mask lanes_le(lanes_mask m, lanes a, lanes b) {
    EACH_QUARTER m.x[i] &= a.x[i] <= b.x[i];
    return m;
}
LANES lanes_mask lanes_lt(lanes_mask m, lanes a, lanes b) {
    EACH_QUARTER m.x[i] &= a.x[i] < b.x[i];
    return m;
}
LANES lanes_mask lanes_and(lanes_mask m, lanes_mask n) {
    EACH_QUARTER m.x[i] &= n.x[i];
    return m;
}
LANES lanes_mask lanes_or(lanes_mask m, lanes_mask n) {
    EACH_QUARTER m.x[i] |= n.x[i];
    return m;
}
LANES lanes_mask lanes_without(lanes_mask m, lanes_mask n) {
    EACH_QUARTER m.x[i] &= ~n.x[i];
    return m;
}
/* Each lane keeps its own bit; the four vectors have different ones. */
LANES uint32_t lanes_bits(lanes_mask m) {
    ints all = (m.x[0] & (ints){1, 2, 4, 8}) | (m.x[1] & (ints){16, 32, 64, 128}) |
               (m.x[2] & (ints){256, 512, 1024, 2048}) | (m.x[3] & (ints){4096, 8192, 16384, 32768});
    return (uint32_t)(all[0] | all[1] | all[2] | all[3]);
}
LANES lanes_mask lanes_flagged(const uint32_t *ids, int shift) {
    lanes_mask m;
    memcpy(&m, ids, sizeof m);
    EACH_QUARTER m.x[i] = m.x[i] << shift >> 31; /* arithmetic: copies of the sign */
    return m;
}
LANES float lanes_least(lanes_mask m, lanes a) {
    const floats none = {(float)INFINITY, (float)INFINITY, (float)INFINITY, (float)INFINITY};
    floats least = none;
    EACH_QUARTER a.x[i] = pick(m.x[i], a.x[i], none), least = pick(a.x[i] < least, a.x[i], least);
    float left = least[0] < least[1] ? least[0] : least[1], right = least[2] < least[3] ? least[2] : least[3];
    return left < right ? left : right;
}
LANES uint32_t lanes_put(uint32_t *out, const uint32_t *ids, uint32_t which) {
    uint32_t count = 0;
    for (; which; which &= which - 1) out[count++] = ids[__builtin_ctz(which)] & PACKED_OBJECT;
    return count;
}

#include "query/packed/packed_kernel.inc"
#include "query/packed/space_kernel.inc"

/* -------------------------------------------------------------- which ones -- */

#ifdef PACKED_X86
static bool has_avx512(void) {
    return !!__builtin_cpu_supports("avx512f") & !!__builtin_cpu_supports("avx512bw") &
           !!__builtin_cpu_supports("avx512dq") & !!__builtin_cpu_supports("avx512vl");
}
static bool has_avx2(void) {
    return !!__builtin_cpu_supports("avx2") & !!__builtin_cpu_supports("popcnt") & !!__builtin_cpu_supports("bmi");
}
#endif

const packed_kernels *packed_kernels_at(size_t i) {
    const packed_kernels *all[3];
    size_t count = 0;
#ifdef PACKED_X86
    if (has_avx512()) all[count++] = &packed_kernels_avx512; /* one way: as processors are */
    if (has_avx2()) all[count++] = &packed_kernels_avx2;     /* one way: as processors are */
#endif
    all[count++] = &packed_kernels_plain;
    return i < count ? all[i] : NULL;
}

const space_kernels *space_kernels_at(size_t i) {
    const packed_kernels *same = packed_kernels_at(i);
#ifdef PACKED_X86
    if (same == &packed_kernels_avx512) return &space_kernels_avx512;
    if (same == &packed_kernels_avx2) return &space_kernels_avx2;
#endif
    return same ? &space_kernels_plain : NULL;
}
