/* match.h: which of many points are equal, all of them at once.
 *
 *     deal     by chunk   the hash of a point names its part (highest bits) and its tag (those below); entries of 64
 *                         bits, [ tag | number ], of a chunk are sorted by part, within the cache
 *     match    by part    the entries of a part, chunk after chunk, go through a hash table that fits the cache; the
 *                         first point with a tag stands for all others, which are few or have equal coordinates
 *     spread   by chunk   each of the others learns its first
 *     repair              only for careful callers: each is compared with its first; those that differ from it (two
 *                         points, one tag) are compared with one another
 *
 * So memory is read and written in order, where one large table misses the cache at every point (Shatdal, Kant and
 * Naughton: Cache conscious algorithms for relational query processing, 1994). All steps but the last run on several
 * threads. The outcome does not depend on hashes, chunks, parts or threads. */
#ifndef FROE_SCENE_MATCH_H
#define FROE_SCENE_MATCH_H
#include "base/task.h"
#include "support/alloc.h"

/** Points by number: first `known` ones, which all differ, then fresh ones. dim doubles each. */
typedef struct match_points {
    const double *known, *fresh;
    uint32_t known_count, fresh_count; /**< together below MATCH_EQUAL */
    int dim;
} match_points;

/** Constants chosen by measurement, for tests to change. */
typedef struct match_plan {
    uint32_t least;   /**< points from which on it is worth it */
    uint32_t chunk;   /**< points, at least; a power of two */
    uint32_t part;    /**< points, about */
    uint32_t careful; /**< points among which different ones with one tag are to be expected */
    uint64_t mask;    /**< of hashes: without some bits different points collide */
} match_plan;
extern const match_plan match_usual;

/** Of a number: this point equals an earlier one, whose number follows. */
#define MATCH_EQUAL 0x80000000u

typedef struct match_work {
    match_points points;
    match_plan plan;
    base_task *task;
    froe_allocator alloc;
    uint64_t *entries; /**< of all points, by chunk, then by part; once matched: first, number */
    uint32_t part_bits, slot_bits, number_bits, chunk, known_chunks, chunks;
    uint32_t *begins; /**< [chunk][part]: its first entry within the chunk; one more part for the end */
    uint32_t *equal;  /**< [chunk][part]: entries that equal an earlier one, brought to the front */
    uint32_t *wrong;  /**< [chunk][..]: points with the tag of another point */
    uint32_t *counts; /**< [chunk]: of those; then of first points, known ones included */
    uint64_t *scratch;
    size_t scratch_each; /**< for each thread */
    uint32_t *first;
    bool careful;
    uint64_t equals;      /**< points that equal an earlier one, as far as tags tell */
    atomic_bool lost;     /**< a coordinate is not finite, or there are too many collisions: nothing is known */
    atomic_bool mistaken; /**< without care: two vertices there are have one tag */
} match_work;

/** Deals and matches. `entries`: room for all points. When `equals` is 0 all points differ. FROE_E_MEMORY,
 * FROE_E_CANCELLED; match_end() in any case. */
froe_status match_begin(match_work *w, const match_points *points, const match_plan *plan, base_task *task,
                        const froe_allocator *alloc, uint64_t *entries);
/** For each fresh point its own number, if it is the first of those equal to it, or MATCH_EQUAL | the first's.
 * *fresh_firsts of them are the first. Without `careful` equal tags count as equal points, which is three times as
 * fast; the caller compares them, and begins anew where two differ. FROE_E_CANCELLED. */
froe_status match_spread(match_work *w, bool careful, uint32_t *first, uint32_t *fresh_firsts);
void match_end(match_work *w);

static inline bool match_same_point(const double *x, const double *y, int dim) { /* -0 equals 0 */
    for (int k = 0; k < dim; k++)
        if (x[k] != y[k]) return false;
    return true;
}

/** Fresh points of chunk `chunk`, of fresh_chunks: *from .. *to - 1, counted from the first fresh one. */
static inline uint32_t match_fresh_chunks(const match_work *w) {
    return w->chunks - w->known_chunks;
}
static inline void match_fresh_chunk(const match_work *w, uint32_t chunk, uint32_t *from, uint32_t *to) {
    *from = chunk * w->chunk;
    *to = w->points.fresh_count - *from < w->chunk ? w->points.fresh_count : *from + w->chunk;
}
/** How many of them are the first, after match_spread(). */
static inline uint32_t match_fresh_firsts(const match_work *w, uint32_t chunk) {
    return w->counts[w->known_chunks + chunk];
}
#endif
