/* bucket.h: counts of fragments beside all planes of a sweep, by where these meet the corners.
 *
 *     |  a  |     |  b c |     |  d   |        A plane that comes to a bucket is taken to touch all corners in it at
 *     1     2     3      4     5      6        once. So its counts are those of a plane that is as good or better: an
 *                                              optimistic price, which is the true one of buckets of one corner.
 *
 * A fragment is positive from the last of its corners to leave the negative side to the first to leave the positive
 * one, and negative the other way round; at one bucket, if all its corners are in it, both, which means in the plane.
 * Otherwise it is split. Each of these stretches adds one to a 16-bit field of a 64-bit word before its first bucket
 * and takes it off after its last. */
#ifndef FROE_BUILD_GRAIN_BUCKET_H
#define FROE_BUILD_GRAIN_BUCKET_H
#include "split/score/view.h"

enum {
    SWEEP_LEAST = 256,   /* buckets of a turn */
    SWEEP_MOST = 8192,   /* the same */
    SWEEP_COUNT = 0xffff /* fragments, at most */
};

/** Where a corner is met: bucket 1 .. n, and SWEEP_NEGATIVE if it is on the negative side until then, and on the
 * positive one from then on. Four numbers of 16 bits in a word, of which the greatest are wanted: that, the same with
 * SWEEP_NEGATIVE turned, and the complements of both. Corners that lie in every plane are SWEEP_ALWAYS, the least of
 * all. */
typedef uint64_t sweep_met;
#define SWEEP_NEGATIVE 0x4000u
#define SWEEP_ALWAYS UINT64_C(0x8000800080008000)

static inline sweep_met sweep_met_of(uint32_t bucket, bool negative) {
    const uint32_t both = bucket * 0x10001u + (negative ? SWEEP_NEGATIVE : SWEEP_NEGATIVE << 16);
    return both | (uint64_t)~both << 32;
}

/** Of the corners of a fragment, from the greatest of each number: the buckets of the last negative, the last positive,
 * the first positive and the first negative one, 16 bits each. The same turns these back. */
static inline uint64_t sweep_ends_of(uint64_t greatest) {
    return greatest ^ UINT64_C(0xffffffff40004000);
}

/** Changes of the counts. */
typedef struct sweep_bucket {
    uint64_t before, after;
} sweep_bucket;

/** The greater of four pairs of numbers in two's complement. */
static inline uint64_t sweep_greater_plain(uint64_t a, uint64_t b) {
    uint64_t out = 0;
    for (int k = 0; k < 64; k += 16) {
        const int16_t x = (int16_t)(a >> k), y = (int16_t)(b >> k);
        out |= (uint64_t)(uint16_t)(x > y ? x : y) << k;
    }
    return out;
}
#ifdef __SSE2__
#include <emmintrin.h>
typedef __m128i sweep_lanes; /**< the four, in a register */
static inline sweep_lanes sweep_lanes_of(uint64_t a) {
    return _mm_cvtsi64_si128((long long)a);
}
static inline sweep_lanes sweep_greater(sweep_lanes a, sweep_lanes b) {
    return _mm_max_epi16(a, b);
}
static inline uint64_t sweep_value(sweep_lanes a) {
    return (uint64_t)_mm_cvtsi128_si64(a);
}
#else
typedef uint64_t sweep_lanes;
static inline sweep_lanes sweep_lanes_of(uint64_t a) {
    return a;
}
static inline sweep_lanes sweep_greater(sweep_lanes a, sweep_lanes b) {
    return sweep_greater_plain(a, b);
}
static inline uint64_t sweep_value(sweep_lanes a) {
    return a;
}
#endif

/** Buckets 1 .. last, one on either side of them, and one that stands for never. */
typedef struct sweep_buckets {
    uint32_t last, ready; /**< ready: so many buckets are empty but for those of the last sweep */
    ARRAY(sweep_bucket) buckets;
    ARRAY(uint32_t) first;              /**< per bucket: the corner last put there; FROE_NONE: none */
    ARRAY(sweep_met) met;               /**< 1 + corner; at 0: what lies on no side of any plane */
    ARRAY(uint32_t) next;               /**< per corner: the one put into its bucket before it, or FROE_NONE */
    uint64_t used[SWEEP_MOST / 64 + 1]; /**< a bit for each bucket that is not empty */
} sweep_buckets;

/** A bucket and what the plane there seems to cost. */
typedef struct sweep_stop {
    uint32_t bucket;
    double cost;
    split_tally tally;
} sweep_stop;
enum { SWEEP_STOPS = 4 };

void sweep_buckets_free(const froe_allocator *alloc, sweep_buckets *b);
/** Begins anew with `last` buckets, and room for corners 0 .. corners - 1. False: no memory. */
bool sweep_buckets_clear(sweep_buckets *b, const froe_allocator *alloc, uint32_t last, size_t corners);
/** A corner is in bucket 1 .. last. */
static inline void sweep_put(sweep_buckets *b, uint32_t corner, uint32_t bucket, bool negative) {
    uint32_t *first = b->first.data, *next = b->next.data;
    sweep_met *met = b->met.data;
    b->used[bucket >> 6] |= (uint64_t)1 << (bucket & 63);
    next[corner] = first[bucket];
    first[bucket] = corner;
    met[corner + 1] = sweep_met_of(bucket, negative);
}
/** Counts the part's fragments, all of whose corners have been put, and finds up to SWEEP_STOPS buckets with a vertex
 * of the scene and a price below `limit`, the cheapest first; returns how many. O(fragments + buckets / 64). */
uint32_t sweep_count(sweep_buckets *b, const split_view *view, const split_view_part *part, const split_prices *prices,
                     double limit, sweep_stop *stops);
/** The vertex that names the plane of a bucket. */
uint32_t sweep_vertex(const sweep_buckets *b, const split_view *view, uint32_t bucket);
#endif
