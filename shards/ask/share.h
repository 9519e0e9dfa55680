/* share.h: a folder that several processes ask together, each with questions of its own: a shard is asked by its
 * froe_shard_owner() alone.
 *
 *     asker                                     owner of shard t
 *     questions for t, rows of doubles   --->   the same call, with these questions: shards_call_shard()
 *     taken as if asked here             <---   what was found; the first bad question
 *
 * What is found is told apart by plan and manifest, which all processes have. Of objects whose order is to be decided
 * (decide.c), the owners send records. Processes exchange words by a function that the program gives, such as one of
 * MPI. A process that fails says so in the next exchange, which then ends the call in all of them. */
#ifndef FROE_SHARDS_SHARE_H
#define FROE_SHARDS_SHARE_H
#include "shards/ask/ask.h"
#include "shards/record.h"

/** An object of another process's shard. */
typedef struct shards_fetched {
    uint32_t shard, object;
    const shards_record *record; /**< in the bytes that came */
} shards_fetched;

struct shards_share {
    uint32_t rank, count;
    froe_shards_trade_fn *trade;
    void *user;
    bool refused;                   /**< the call has a bad question here, which is no failure of other processes */
    froe_shard_records out, in;     /**< words for process 0, then 1, ...; the same of what came */
    size_t *out_counts, *in_counts; /**< bytes for each process, and from each */
    ARRAY(shards_fetched) fetched;  /**< by shard, then object */
};
void shards_share_free(froe_shards *s);

/** A call begins; its question number so and so is bad. Without other processes nothing. */
void shards_share_begin(froe_shards *s);
void shards_share_refuse(froe_shards *s);
static inline bool shards_share_owns(const froe_shards *s, uint32_t shard) {
    return !s->share || froe_shard_owner(shard, s->share->count) == s->share->rank;
}

/** shards_call_all() of several processes. */
froe_status shards_share_ask(shards_call *call, froe_status status, const size_t *starts, const size_t *which,
                             const bool *alone, bool *more, froe_diagnostic *diag);
/** Exchanges `out`, which is then empty. On failure of one process all return the first failure. */
froe_status shards_share_trade(shards_share *share, froe_status status, froe_diagnostic *diag);
/** Appends words of 8 bytes for the process whose count this is. False: no memory. */
bool shards_share_put(shards_share *share, size_t *count, const void *words, size_t size);

/** Fetches those objects of other processes' shards that shards_decide() compares. All processes call it. */
froe_status shards_share_fetch(froe_shards *s, const froe_finds *finds, size_t k, froe_status status,
                               froe_diagnostic *diag);
/** The record of an object that was fetched; NULL: its shard is one of this process's own. */
const shards_record *shards_share_fetched(const froe_shards *s, const froe_find *find);
#endif
