/* sample.h: some of the objects, for medians.
 *
 * Every object has a hash of its tag and its box, and those of the least hashes are the sample (Cohen, "Size-estimation
 * framework", 1997: bottom-k). So it is a function of the set of objects, whatever their order, and the sample of two
 * sets together is what is left of their samples. An item is a hash, then the middle of the box. */
#ifndef FROE_SHARDS_SAMPLE_H
#define FROE_SHARDS_SAMPLE_H
#include "support/alloc.h"
#include <froe/shard_parts.h>

enum { SHARDS_SAMPLE = 1 << 17 };

struct froe_shard_sample {
    int dim;
    size_t width;     /**< words of an item */
    uint64_t objects; /**< all of them */
    uint64_t weight;  /**< shards_record_weight() of them together */
    uint64_t *words;  /**< a head of 3 words, then items; room for twice the sample */
    size_t count;     /**< items; settled, at most SHARDS_SAMPLE */
    size_t room;      /**< for items */
    uint64_t bound;   /**< items of larger hashes are in no sample */
    froe_allocator alloc;
};
/** The items, at most SHARDS_SAMPLE of them, in any order. */
uint64_t *shards_sample_settle(froe_shard_sample *sample);
/** Mixes a number into a hash. */
uint64_t shards_mix(uint64_t hash, uint64_t number);
#endif
