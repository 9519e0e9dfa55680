/* packed_avx2.c: sixteen floats in two registers, truth values as lanes of ones. */
#include "query/packed/packed_kernel.h"
#include "query/packed/space_kernel.h"

#ifdef PACKED_X86
#include <immintrin.h>
#include <math.h>

#define LANES_TARGET "avx2,popcnt,bmi"
#define LANES __attribute__((target(LANES_TARGET), always_inline)) static inline
#define LANES_KERNEL __attribute__((target(LANES_TARGET))) static
#define KERNELS packed_kernels_avx2
#define LANES_WHOLE 0
#define KERNELS_NAME "avx2"
#define SPACE_KERNELS space_kernels_avx2

typedef struct lanes {
    __m256 a, b;
} lanes;
typedef lanes lanes_mask;

LANES lanes lanes_units(const uint16_t *p) {
    __m256i a = _mm256_cvtepu16_epi32(_mm_loadu_si128((const void *)p));
    __m256i b = _mm256_cvtepu16_epi32(_mm_loadu_si128((const void *)(p + 8)));
    return (lanes){_mm256_cvtepi32_ps(a), _mm256_cvtepi32_ps(b)};
}
typedef __m256i ulanes, ulanes_mask;
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
    const __m256i at = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    return _mm256_cmpgt_epi16(_mm256_set1_epi16(n < PACKED_LANES ? (short)n : PACKED_LANES), at);
}
LANES ulanes_mask ulanes_le(ulanes_mask m, ulanes a, ulanes b) {
    return _mm256_and_si256(m, _mm256_cmpeq_epi16(_mm256_min_epu16(a, b), a));
}
LANES uint32_t ulanes_bits(ulanes_mask m) {
    const uint32_t bytes = (uint32_t)_mm256_movemask_epi8(_mm256_packs_epi16(m, _mm256_setzero_si256()));
    return (bytes & 0xff) | (bytes >> 8 & 0xff00);
}
LANES lanes lanes_bytes(const uint8_t *p) {
    __m128i all = _mm_loadu_si128((const void *)p);
    __m256i a = _mm256_cvtepu8_epi32(all), b = _mm256_cvtepu8_epi32(_mm_srli_si128(all, 8));
    return (lanes){_mm256_cvtepi32_ps(a), _mm256_cvtepi32_ps(b)};
}
LANES four_ints lanes_four(const uint8_t *p) {
    int32_t bytes;
    memcpy(&bytes, p, sizeof bytes);
    return (four_ints)_mm_cvtepu8_epi32(_mm_cvtsi32_si128(bytes));
}
LANES void lanes_store(float *x, lanes a) {
    _mm256_storeu_ps(x, a.a);
    _mm256_storeu_ps(x + 8, a.b);
}
LANES lanes lanes_sqrt(lanes x) {
    return (lanes){_mm256_sqrt_ps(x.a), _mm256_sqrt_ps(x.b)};
}
LANES lanes lanes_pick(lanes_mask m, lanes x, lanes y) {
    return (lanes){_mm256_blendv_ps(y.a, x.a, m.a), _mm256_blendv_ps(y.b, x.b, m.b)};
}
LANES lanes lanes_set(float x) {
    return (lanes){_mm256_set1_ps(x), _mm256_set1_ps(x)};
}
LANES lanes lanes_add(lanes x, lanes y) {
    return (lanes){_mm256_add_ps(x.a, y.a), _mm256_add_ps(x.b, y.b)};
}
LANES lanes lanes_sub(lanes x, lanes y) {
    return (lanes){_mm256_sub_ps(x.a, y.a), _mm256_sub_ps(x.b, y.b)};
}
LANES lanes lanes_mul(lanes x, lanes y) {
    return (lanes){_mm256_mul_ps(x.a, y.a), _mm256_mul_ps(x.b, y.b)};
}
LANES lanes lanes_div(lanes x, lanes y) {
    return (lanes){_mm256_div_ps(x.a, y.a), _mm256_div_ps(x.b, y.b)};
}
LANES lanes lanes_min(lanes x, lanes y) {
    return (lanes){_mm256_min_ps(x.a, y.a), _mm256_min_ps(x.b, y.b)};
}
LANES lanes lanes_max(lanes x, lanes y) {
    return (lanes){_mm256_max_ps(x.a, y.a), _mm256_max_ps(x.b, y.b)};
}
LANES lanes lanes_abs(lanes x) {
    const __m256 sign = _mm256_set1_ps(-0.0f);
    return (lanes){_mm256_andnot_ps(sign, x.a), _mm256_andnot_ps(sign, x.b)};
}
LANES lanes_mask lanes_and(lanes_mask m, lanes_mask n) {
    return (lanes_mask){_mm256_and_ps(m.a, n.a), _mm256_and_ps(m.b, n.b)};
}
LANES lanes_mask lanes_or(lanes_mask m, lanes_mask n) {
    return (lanes_mask){_mm256_or_ps(m.a, n.a), _mm256_or_ps(m.b, n.b)};
}
LANES lanes_mask lanes_without(lanes_mask m, lanes_mask n) {
    return (lanes_mask){_mm256_andnot_ps(n.a, m.a), _mm256_andnot_ps(n.b, m.b)};
}
LANES lanes_mask lanes_first(uint32_t n) {
    const __m256i a = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), b = _mm256_add_epi32(a, _mm256_set1_epi32(8));
    const __m256i end = _mm256_set1_epi32(n < PACKED_LANES ? (int)n : PACKED_LANES);
    return (lanes_mask){_mm256_castsi256_ps(_mm256_cmpgt_epi32(end, a)),
                        _mm256_castsi256_ps(_mm256_cmpgt_epi32(end, b))};
}
LANES lanes_mask lanes_le(lanes_mask m, lanes x, lanes y) {
    lanes_mask le = {_mm256_cmp_ps(x.a, y.a, _CMP_LE_OQ), _mm256_cmp_ps(x.b, y.b, _CMP_LE_OQ)};
    return lanes_and(m, le);
}
LANES lanes_mask lanes_lt(lanes_mask m, lanes x, lanes y) {
    lanes_mask lt = {_mm256_cmp_ps(x.a, y.a, _CMP_LT_OQ), _mm256_cmp_ps(x.b, y.b, _CMP_LT_OQ)};
    return lanes_and(m, lt);
}
LANES uint32_t lanes_bits(lanes_mask m) {
    return (uint32_t)_mm256_movemask_ps(m.a) | (uint32_t)_mm256_movemask_ps(m.b) << 8;
}
LANES __m256 flagged_half(const uint32_t *ids, int shift) {
    __m256i bit = _mm256_slli_epi32(_mm256_loadu_si256((const void *)ids), shift);
    return _mm256_castsi256_ps(_mm256_srai_epi32(bit, 31));
}
LANES lanes_mask lanes_flagged(const uint32_t *ids, int shift) {
    return (lanes_mask){flagged_half(ids, shift), flagged_half(ids + 8, shift)};
}
LANES float lanes_least(lanes_mask m, lanes x) {
    const __m256 none = _mm256_set1_ps((float)INFINITY);
    __m256 half = _mm256_min_ps(_mm256_blendv_ps(none, x.a, m.a), _mm256_blendv_ps(none, x.b, m.b));
    __m128 x4 = _mm_min_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
    __m128 x2 = _mm_min_ps(x4, _mm_movehl_ps(x4, x4));
    return _mm_cvtss_f32(_mm_min_ss(x2, _mm_shuffle_ps(x2, x2, 1)));
}
LANES uint32_t lanes_put(uint32_t *out, const uint32_t *ids, uint32_t bits) {
    uint32_t count = 0;
    for (; bits; bits &= bits - 1) out[count++] = ids[__builtin_ctz(bits)] & PACKED_OBJECT;
    return count;
}

#include "query/packed/packed_kernel.inc"
#include "query/packed/space_kernel.inc"
#endif
