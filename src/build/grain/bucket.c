/* bucket.c: see bucket.h. */
#include "build/grain/bucket.h"
#include <string.h>

/* One fragment in a field of a word of counts: without negative corners, without positive ones, without either, and
 * without either but marked (split/mark.h). */
#define POSITIVE ((uint64_t)1)
#define NEGATIVE ((uint64_t)1 << 16)
#define FLAT ((uint64_t)1 << 32)
#define MARKED ((uint64_t)1 << 48)

void sweep_buckets_free(const froe_allocator *alloc, sweep_buckets *b) {
    array_free(alloc, &b->buckets);
    array_free(alloc, &b->first);
    array_free(alloc, &b->met);
    array_free(alloc, &b->next);
}

bool sweep_buckets_clear(sweep_buckets *b, const froe_allocator *alloc, uint32_t last, size_t corners) {
    const sweep_bucket empty = {0, 0};
    sweep_bucket *buckets = b->buckets.data;
    for (uint32_t w = 0; w <= b->last / 64 && b->ready; w++) {
        for (uint64_t bits = b->used[w]; bits; bits &= bits - 1) {
            const uint32_t bucket = 64 * w + (uint32_t)__builtin_ctzll(bits);
            buckets[bucket] = empty;
            b->first.data[bucket] = FROE_NONE;
        }
        b->used[w] = 0;
    }
    if (b->ready) buckets[0] = buckets[b->last + 1] = empty;
    b->buckets.count = b->first.count = b->ready;
    b->met.count = b->next.count = 0;
    const size_t more = last + 3 > b->ready ? (size_t)last + 3 - b->ready : 0;
    if (!array_reserve(alloc, &b->buckets, more) || !array_reserve(alloc, &b->first, more) ||
        !array_reserve(alloc, &b->met, corners + 1) || !array_reserve(alloc, &b->next, corners))
        return false;
    for (; b->ready < last + 3; b->ready++) b->buckets.data[b->ready] = empty, b->first.data[b->ready] = FROE_NONE;
    b->last = last;
    const uint64_t end = last + 1;
    b->met.data[0] = sweep_ends_of(end | end << 16);
    return true;
}

static inline void stretch(sweep_bucket *buckets, uint32_t from, uint32_t to, uint64_t unit) {
    unit = from <= to ? unit : 0;
    buckets[from].before += unit;
    buckets[to].after -= unit;
}

/** The stretches of a fragment. Corners with SWEEP_NEGATIVE are negative until they are met, so that none is from the
 * last of them to the first of the others. */
static inline void note_fragment(sweep_bucket *buckets, uint64_t ends, uint8_t marked) {
    const uint32_t last_negative = (uint16_t)ends, last_positive = (uint16_t)(ends >> 16);
    const uint32_t first_positive = (uint16_t)(ends >> 32), first_negative = (uint16_t)(ends >> 48);
    stretch(buckets, last_negative, first_positive, POSITIVE);
    stretch(buckets, last_positive, first_negative, NEGATIVE);
    const uint32_t from = last_negative > last_positive ? last_negative : last_positive;
    const uint32_t to = first_negative < first_positive ? first_negative : first_positive;
    if (from <= to) stretch(buckets, from, to, marked ? MARKED : FLAT);
}

/** Those of at most four corners first, without a branch. */
static void note_fragments(sweep_buckets *b, const split_view *v, uint32_t count) {
    const uint32_t *four = v->fours.data, *start = v->start.data, *corner = v->corner.data;
    const uint64_t end = b->last + 1, *met = b->met.data;
    const sweep_lanes none = sweep_lanes_of(sweep_ends_of(end << 32 | end << 48));
    sweep_bucket *buckets = b->buckets.data;
    for (uint32_t i = 0; i < count; i++, four += 4) {
        const sweep_lanes low = sweep_greater(sweep_lanes_of(met[four[0]]), sweep_lanes_of(met[four[1]]));
        const sweep_lanes high = sweep_greater(sweep_lanes_of(met[four[2]]), sweep_lanes_of(met[four[3]]));
        const sweep_lanes most = sweep_greater(none, sweep_greater(low, high));
        note_fragment(buckets, sweep_ends_of(sweep_value(most)), v->marked.data[i]);
    }
    for (size_t k = 0; k < v->many.count && v->many.data[k] < count; k++) {
        const uint32_t i = v->many.data[k];
        sweep_lanes most = none;
        for (uint32_t j = start[i]; j < start[i + 1]; j++)
            most = sweep_greater(most, sweep_lanes_of(met[1 + corner[j]]));
        note_fragment(buckets, sweep_ends_of(sweep_value(most)), v->marked.data[i]);
    }
}

static inline split_tally tally_of(uint64_t word, uint32_t count) {
    const uint32_t on = (uint32_t)(word >> 32) & 0xffff, within = on + (uint32_t)(word >> 48);
    const uint32_t positive = ((uint32_t)word & 0xffff) - within;
    const uint32_t negative = ((uint32_t)(word >> 16) & 0xffff) - within;
    return (split_tally){negative, positive, on, count - negative - positive - on};
}

static bool has_vertex(const sweep_buckets *b, const split_view *v, uint32_t bucket) {
    uint32_t corner = b->first.data[bucket];
    while (corner != FROE_NONE && v->vertex.data[corner] == FROE_NONE) corner = b->next.data[corner];
    return corner != FROE_NONE;
}

/** More splits than these cost more than the limit if nothing lies in the plane: then the gain is m (h(A / m) +
 * h(B / m)), where h(x) = - x log2 x is at most 0.531. */
static uint32_t most_splits(const split_prices *p, double limit) {
    const double most = limit / p->weight + p->terms.weight * 1.0625 * p->m;
    return most < 0 ? 0 : most < p->m ? (uint32_t)most : p->m;
}

uint32_t sweep_count(sweep_buckets *b, const split_view *v, const split_view_part *part, const split_prices *prices,
                     double limit, sweep_stop *stops) {
    uint32_t count = 0, most = most_splits(prices, limit);
    note_fragments(b, v, part->count);
    const sweep_bucket *buckets = b->buckets.data;
    uint64_t word = buckets->before;
    for (uint32_t w = 0; w <= b->last / 64; w++) {
        for (uint64_t bits = b->used[w]; bits; bits &= bits - 1) {
            const uint32_t bucket = 64 * w + (uint32_t)__builtin_ctzll(bits);
            word += buckets[bucket].before;
            const split_tally t = tally_of(word, part->count);
            word += buckets[bucket].after;
            if ((t.both > most && !t.on) || !split_tally_useful(t)) continue;
            const double cost = split_prices_cost(prices, t);
            if (!(cost < limit) || !has_vertex(b, v, bucket)) continue;
            uint32_t at = count < SWEEP_STOPS ? count++ : SWEEP_STOPS - 1;
            for (; at && stops[at - 1].cost > cost; at--) stops[at] = stops[at - 1];
            stops[at] = (sweep_stop){bucket, cost, t};
            if (count == SWEEP_STOPS) limit = stops[SWEEP_STOPS - 1].cost, most = most_splits(prices, limit);
        }
    }
    return count;
}

static double square_of(const split_view *v, uint32_t corner) {
    const double x = v->x.data[corner], y = v->y.data[corner], z = v->z.data[corner];
    return x * x + y * y + z * z;
}

/* The vertex put last, unless it lies among others that doubles cannot tell apart, in the middle of a scene of all
 * scales. */
uint32_t sweep_vertex(const sweep_buckets *b, const split_view *v, uint32_t bucket) {
    uint32_t best = FROE_NONE;
    for (uint32_t k = b->first.data[bucket]; k != FROE_NONE; k = b->next.data[k]) {
        if (v->vertex.data[k] == FROE_NONE) continue;
        if (best == FROE_NONE || square_of(v, k) > 0x1p20 * square_of(v, best)) best = k;
    }
    return best == FROE_NONE ? FROE_NONE : v->vertex.data[best];
}
