/* sample.c: see sample.h. */
#include "sample.h"
#include "record.h"
#include "select.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>

enum { HEAD = 3, DIM_BITS = 8 }; /* dimension and, above its bits, the number of items; objects; weight */

/* The finaliser of SplitMix64 (Steele, Lea and Flood, 2014). */
uint64_t shards_mix(uint64_t hash, uint64_t number) {
    uint64_t x = (hash ^ number) + UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return x ^ x >> 31;
}

froe_status froe_shard_sample_new(int dim, const froe_allocator *alloc, froe_shard_sample **out) {
    if (!out || dim < 2 || dim > FROE_MAX_DIM) return FROE_E_ARG;
    const froe_allocator own = support_allocator(alloc);
    froe_shard_sample *s = support_calloc(&own, 1, sizeof *s);
    if (!s) return FROE_E_MEMORY;
    *s = (froe_shard_sample){.dim = dim, .width = 1 + (size_t)dim, .bound = UINT64_MAX, .alloc = own};
    *out = s;
    return FROE_OK;
}

void froe_shard_sample_free(froe_shard_sample *s) {
    if (!s) return;
    const froe_allocator alloc = s->alloc;
    if (s->words) support_free(&alloc, s->words, (HEAD + s->room * s->width) * sizeof *s->words);
    support_free(&alloc, s, sizeof *s);
}

/* Items of equal hashes are compared by their places, whose bits are in some order, too. */
static int compare_items(const uint64_t *x, const uint64_t *y, size_t width) {
    for (size_t i = 0; i < width; i++)
        if (x[i] != y[i]) return x[i] < y[i] ? -1 : 1;
    return 0;
}

#define COMPARE_OF(DIM)                                                                                                \
    static int compare_##DIM(const void *x, const void *y) {                                                           \
        return compare_items(x, y, 1 + (DIM));                                                                         \
    }
COMPARE_OF(2)
COMPARE_OF(3)
COMPARE_OF(4)
COMPARE_OF(5)
COMPARE_OF(6)
COMPARE_OF(7)
COMPARE_OF(8)

static shards_compare_fn *compare_of(const froe_shard_sample *s) {
    static shards_compare_fn *const compare[] = {NULL,      NULL,      compare_2, compare_3, compare_4,
                                                 compare_5, compare_6, compare_7, compare_8};
    return compare[s->dim];
}

uint64_t *shards_sample_settle(froe_shard_sample *s) {
    if (!s->count) return NULL;
    uint64_t *items = s->words + HEAD;
    if (s->count >= SHARDS_SAMPLE) {
        shards_select(items, s->count, s->width * sizeof *items, SHARDS_SAMPLE - 1, compare_of(s));
        s->count = SHARDS_SAMPLE;
        s->bound = items[(SHARDS_SAMPLE - 1) * s->width];
    }
    return items;
}

/* Room for one item more, if its hash may be in the sample. NULL: no memory. */
static uint64_t *next_item(froe_shard_sample *s) {
    if (s->count == 2 * (size_t)SHARDS_SAMPLE) shards_sample_settle(s);
    if (s->count == s->room) {
        const size_t room = s->room ? 2 * s->room : 1024, old = s->words ? HEAD + s->room * s->width : 0;
        uint64_t *words =
            support_realloc(&s->alloc, s->words, old * sizeof *words, (HEAD + room * s->width) * sizeof *words);
        if (!words) return NULL;
        s->words = words;
        s->room = room;
    }
    return s->words + HEAD + s->count * s->width;
}

/* A number that is none has no place among the others, nor has its object a cell. */
static bool is_finite(const shards_object *o) {
    for (size_t i = 0; i < o->corners * (size_t)o->dim; i++)
        if (!isfinite(o->numbers[i])) return false;
    return o->radius >= 0 && isfinite(o->radius);
}

froe_status froe_shard_sample_add(froe_shard_sample *s, const void *records, size_t count) {
    SUPPORT_FLOATS_OWN;
    if (!s || (!records && count)) return FROE_E_ARG;
    for (size_t at = 0, size; at < count; at += size) {
        const shards_record *record = shards_record_at(records, at);
        size = froe_shard_record_size(record, count - at);
        if (!size || record->dim != s->dim) return FROE_E_ARG;
        const shards_object object = shards_record_read(record);
        if (!is_finite(&object)) return FROE_E_ARG;
        double box[2 * FROE_MAX_DIM];
        uint64_t bits[2 * FROE_MAX_DIM], hash = shards_mix(0, record->tag);
        const size_t dim = (size_t)s->dim;
        shards_object_box(&object, box, box + dim);
        memcpy(bits, box, sizeof bits);
        for (size_t i = 0; i < 2 * dim; i++) hash = shards_mix(hash, bits[i]);
        s->objects++;
        s->weight += shards_record_weight(record);
        if (hash > s->bound) continue;
        uint64_t *item = next_item(s);
        if (!item) return FROE_E_MEMORY;
        *item = hash;
        for (size_t a = 0; a < dim; a++) {
            const double middle = 0.5 * box[a] + 0.5 * box[dim + a] + 0.0; /* and never -0, which equals 0 */
            memcpy(item + 1 + a, &middle, sizeof middle);
        }
        s->count++;
    }
    return FROE_OK;
}

/* If every part has so many items below the largest bound, all together have at least as many as a sample. */
uint64_t froe_shard_sample_bound(froe_shard_sample *s, uint32_t parts) {
    SUPPORT_FLOATS_OWN;
    const size_t least = parts ? (SHARDS_SAMPLE + (size_t)parts - 1) / parts : SHARDS_SAMPLE;
    if (!s || s->count < least) return UINT64_MAX;
    uint64_t *items = s->words + HEAD;
    shards_select(items, s->count, s->width * sizeof *items, least - 1, compare_of(s));
    return items[(least - 1) * s->width];
}

void froe_shard_sample_cut(froe_shard_sample *s, uint64_t bound) {
    if (!s || bound >= s->bound) return;
    size_t kept = 0;
    for (size_t i = 0; i < s->count; i++) {
        const uint64_t *item = s->words + HEAD + i * s->width;
        if (*item <= bound) memmove(s->words + HEAD + kept++ * s->width, item, s->width * sizeof *item);
    }
    s->count = kept;
    s->bound = bound;
}

const uint64_t *froe_shard_sample_words(froe_shard_sample *s, size_t *count) {
    SUPPORT_FLOATS_OWN;
    if (!s || !count || !next_item(s)) return NULL;
    shards_sample_settle(s);
    s->words[0] = (uint64_t)s->dim | (uint64_t)s->count << DIM_BITS;
    s->words[1] = s->objects;
    s->words[2] = s->weight;
    *count = HEAD + s->count * s->width;
    return s->words;
}

/* Are they all words of a sample, whose places are numbers? */
static bool are_words(const froe_shard_sample *s, const uint64_t *words, size_t count) {
    if (count < HEAD || (count - HEAD) % s->width) return false;
    const uint64_t items = (count - HEAD) / s->width;
    if (words[0] != ((uint64_t)s->dim | items << DIM_BITS) || items > SHARDS_SAMPLE || items > words[1]) return false;
    for (size_t at = HEAD; at < count; at += s->width)
        for (size_t a = 1; a < s->width; a++) {
            double middle;
            memcpy(&middle, words + at + a, sizeof middle);
            if (!isfinite(middle)) return false;
        }
    return true;
}

froe_status froe_shard_sample_merge(froe_shard_sample *s, const uint64_t *words, size_t count) {
    SUPPORT_FLOATS_OWN;
    if (!s || !words || !are_words(s, words, count)) return FROE_E_ARG;
    for (size_t at = HEAD; at < count; at += s->width) {
        if (words[at] > s->bound) continue;
        uint64_t *item = next_item(s);
        if (!item) return FROE_E_MEMORY;
        memcpy(item, words + at, s->width * sizeof *item);
        s->count++;
    }
    s->objects += words[1];
    s->weight += words[2];
    return FROE_OK;
}
