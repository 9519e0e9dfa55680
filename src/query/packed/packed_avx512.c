/* packed_avx512.c: sixteen floats in one register, truth values in mask registers. */
#include "query/packed/packed_kernel.h"
#include "query/packed/space_kernel.h"

#ifdef PACKED_X86
#include <immintrin.h>
#include <math.h>

#define LANES_TARGET "avx512f,avx512bw,avx512dq,avx512vl"
#define LANES __attribute__((target(LANES_TARGET), always_inline)) static inline
#define LANES_KERNEL __attribute__((target(LANES_TARGET))) static
#define KERNELS packed_kernels_avx512
#define LANES_WHOLE 1
#define KERNELS_NAME "avx512"
#define SPACE_KERNELS space_kernels_avx512

typedef __m512 lanes;
typedef __mmask16 lanes_mask;

LANES lanes lanes_units(const uint16_t *p) {
    return _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(_mm256_loadu_si256((const void *)p)));
}
typedef __m256i ulanes;
typedef __mmask16 ulanes_mask;
LANES ulanes ulanes_load(const uint16_t *p) {
    return _mm256_loadu_si256((const void *)p);
}
LANES ulanes ulanes_bytes(const uint8_t *p) {
    return _mm256_cvtepu8_epi16(_mm_loadu_si128((const void *)p));
}
LANES ulanes ulanes_set(uint16_t x) {
    return _mm256_set1_epi16((short)x);
}
LANES void ulanes_store(uint16_t *p, ulanes a) {
    _mm256_storeu_si256((void *)p, a);
}
LANES ulanes ulanes_raise(ulanes a, ulanes b) {
    return _mm256_adds_epu16(a, b);
}
LANES ulanes ulanes_lower(ulanes a, ulanes b) {
    return _mm256_subs_epu16(a, b);
}
LANES ulanes ulanes_min(ulanes a, ulanes b) {
    return _mm256_min_epu16(a, b);
}
LANES ulanes ulanes_max(ulanes a, ulanes b) {
    return _mm256_max_epu16(a, b);
}
LANES ulanes_mask ulanes_first(uint32_t n) {
    return (ulanes_mask)(n < PACKED_LANES ? (1u << n) - 1 : 0xffffu);
}
LANES ulanes_mask ulanes_le(ulanes_mask m, ulanes a, ulanes b) {
    return _mm256_mask_cmple_epu16_mask(m, a, b);
}
LANES uint32_t ulanes_bits(ulanes_mask m) {
    return m;
}
LANES lanes lanes_bytes(const uint8_t *p) {
    return _mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(_mm_loadu_si128((const void *)p)));
}
LANES four_ints lanes_four(const uint8_t *p) {
    int32_t bytes;
    memcpy(&bytes, p, sizeof bytes);
    return (four_ints)_mm_cvtepu8_epi32(_mm_cvtsi32_si128(bytes));
}
LANES void lanes_store(float *x, lanes a) {
    _mm512_storeu_ps(x, a);
}
LANES lanes lanes_sqrt(lanes a) {
    return _mm512_sqrt_ps(a);
}
LANES lanes lanes_pick(lanes_mask m, lanes a, lanes b) {
    return _mm512_mask_blend_ps(m, b, a);
}
LANES lanes lanes_set(float x) {
    return _mm512_set1_ps(x);
}
LANES lanes lanes_add(lanes a, lanes b) {
    return _mm512_add_ps(a, b);
}
LANES lanes lanes_sub(lanes a, lanes b) {
    return _mm512_sub_ps(a, b);
}
LANES lanes lanes_mul(lanes a, lanes b) {
    return _mm512_mul_ps(a, b);
}
LANES lanes lanes_div(lanes a, lanes b) {
    return _mm512_div_ps(a, b);
}
LANES lanes lanes_min(lanes a, lanes b) {
    return _mm512_min_ps(a, b);
}
LANES lanes lanes_max(lanes a, lanes b) {
    return _mm512_max_ps(a, b);
}
LANES lanes lanes_abs(lanes a) {
    return _mm512_abs_ps(a);
}
LANES lanes_mask lanes_first(uint32_t n) {
    return (lanes_mask)(n < PACKED_LANES ? (1u << n) - 1 : 0xffffu);
}
LANES lanes_mask lanes_le(lanes_mask m, lanes a, lanes b) {
    return _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LE_OQ);
}
LANES lanes_mask lanes_lt(lanes_mask m, lanes a, lanes b) {
    return _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LT_OQ);
}
LANES lanes_mask lanes_and(lanes_mask m, lanes_mask n) {
    return (lanes_mask)(m & n);
}
LANES lanes_mask lanes_or(lanes_mask m, lanes_mask n) {
    return (lanes_mask)(m | n);
}
LANES lanes_mask lanes_without(lanes_mask m, lanes_mask n) {
    return (lanes_mask)(m & ~n);
}
LANES uint32_t lanes_bits(lanes_mask m) {
    return m;
}
LANES lanes_mask lanes_flagged(const uint32_t *ids, int shift) {
    return _mm512_movepi32_mask(_mm512_slli_epi32(_mm512_loadu_si512(ids), (unsigned)shift));
}
LANES float lanes_least(lanes_mask m, lanes a) {
    return _mm512_reduce_min_ps(_mm512_mask_blend_ps(m, _mm512_set1_ps((float)INFINITY), a));
}
/* Compressed in a register: storing compressed is slow on some processors. */
LANES uint32_t lanes_put(uint32_t *out, const uint32_t *ids, uint32_t bits) {
    __m512i objects = _mm512_and_si512(_mm512_loadu_si512(ids), _mm512_set1_epi32((int)PACKED_OBJECT));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32((lanes_mask)bits, objects));
    return (uint32_t)__builtin_popcount(bits);
}

#include "query/packed/packed_kernel.inc"
#include "query/packed/space_kernel.inc"
#endif
