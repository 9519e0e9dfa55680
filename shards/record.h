/* record.h: an object as bytes: what goes into buckets, over networks, and into a canonical order.
 *
 *     header    16 bytes    words of 8 bytes, kind, dimension, has it a source?, 0; tag
 *     source    16 bytes    face and group, numbers of the whole folder; only where there is one
 *     numbers   8 each      corners, dim coordinates each; of a ball its radius behind them
 *
 * -0 is stored as 0, so that equal objects have equal bytes. */
#ifndef FROE_SHARDS_RECORD_H
#define FROE_SHARDS_RECORD_H
#include "support/array.h"
#include <froe/shard_parts.h>
#include <string.h>

typedef struct shards_record {
    uint32_t words; /**< of 8 bytes, these 2 among them */
    uint8_t kind, dim, sourced, unused;
    uint64_t tag;
} shards_record;

typedef struct shards_source {
    uint64_t face, group; /**< group: FROE_NONE for none */
} shards_source;

/** What a record says; numbers lie in the record. */
typedef struct shards_object {
    froe_kind kind;
    int dim;
    size_t corners;
    const double *numbers;
    double radius;
    uint64_t tag;
    bool sourced;
    shards_source source;
} shards_object;
static inline shards_object shards_record_read(const shards_record *record) {
    const unsigned char *at = (const unsigned char *)record + sizeof *record;
    shards_object o = {.kind = (froe_kind)record->kind,
                       .dim = record->dim,
                       .tag = record->tag,
                       .sourced = record->sourced,
                       .source = {.group = FROE_NONE}};
    size_t numbers = record->words - sizeof *record / 8;
    if (o.sourced) {
        memcpy(&o.source, at, sizeof o.source);
        at += sizeof o.source;
        numbers -= sizeof o.source / 8;
    }
    o.numbers = (const double *)(const void *)at;
    if (o.kind == FROE_BALL) o.radius = o.numbers[--numbers];
    o.corners = numbers / (size_t)o.dim;
    return o;
}

/** The record at some place of whole ones. */
static inline const shards_record *shards_record_at(const void *bytes, size_t at) {
    return (const shards_record *)(const void *)((const unsigned char *)bytes + at);
}
static inline size_t shards_record_bytes(const shards_record *record) {
    return 8 * (size_t)record->words;
}
/** Is what begins here, of which `left` bytes are there, certain to be no record, whatever comes behind it? */
bool shards_record_is_none(const void *bytes, size_t left);
/** Room for so many bytes more. False: no memory. */
static inline bool shards_records_reserve(froe_shard_records *records, size_t extra) {
    return records->capacity - records->count >= extra ||
           support_array_grow(&records->alloc, (void **)&records->bytes, &records->capacity, records->count, extra, 1);
}
/** froe_shard_records_add() of a batch that is right. FROE_E_LIMIT, FROE_E_MEMORY. */
froe_status shards_records_put(froe_shard_records *records, int dim, const froe_objects *batch, uint64_t first,
                               froe_diagnostic *diag);
/** The box of a ball of which lo and hi are the middle, rounded outwards, but not beyond the largest double. */
void shards_widen_box(int dim, double radius, double *lo, double *hi);
/** The box of an object: bounds of its corners, and of a ball of its extent, rounded outwards. */
static inline void shards_object_box(const shards_object *o, double *lo, double *hi) {
    for (int a = 0; a < o->dim; a++) lo[a] = hi[a] = o->numbers[a];
    for (size_t i = 1; i < o->corners; i++)
        for (int a = 0; a < o->dim; a++) {
            const double x = o->numbers[i * (size_t)o->dim + (size_t)a];
            lo[a] = x < lo[a] ? x : lo[a];
            hi[a] = x > hi[a] ? x : hi[a];
        }
    if (o->kind == FROE_BALL) shards_widen_box(o->dim, o->radius, lo, hi);
}
/** A total order of records of one tag: by their lengths, then by their bytes. 0: they are equal. */
int shards_record_compare(const shards_record *a, const shards_record *b);
/** About how many bytes building a tree takes for an object, with its record. */
uint64_t shards_record_weight(const shards_record *record);

/** Do two boxes have a point in common? */
static inline bool shards_boxes_meet(const double *lo, const double *hi, const double *other_lo, const double *other_hi,
                                     int dim) {
    for (int a = 0; a < dim; a++)
        if (lo[a] > other_hi[a] || hi[a] < other_lo[a]) return false;
    return true;
}
#endif
