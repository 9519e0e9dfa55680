/* deal.h: objects dealt to parts, in chunks, by any number of threads.
 *
 *     chunk 0  --->  entries ---.      Each chunk of objects makes a list of entries, in the order of its objects, and
 *     chunk 1  --->  entries ---+-->   counts how many go to each part. Then it is known where each entry goes: to its
 *     chunk 2  --->  entries ---'      part, behind those of the chunks before. Chunks do not depend on the number of
 *                                      threads, so neither does the order of entries in a part. */
#ifndef FROE_BUILD_INDEX_DEAL_H
#define FROE_BUILD_INDEX_DEAL_H
#include "base/apart.h"
#include "base/task.h"
#include "support/array.h"

typedef struct deal_entry {
    uint32_t place, id; /**< place >> shift: the part; its other bits go with the id */
} deal_entry;

typedef struct deal_chunk {
    uint32_t from, to; /**< objects */
    uint32_t *parts;   /**< part -> entries; then where the next one goes */
    ARRAY(deal_entry) entries;
    base_apart apart;
} deal_chunk;

typedef struct dealing {
    froe_allocator alloc;
    base_task *task; /**< NULL: in a job, on its thread */
    uint32_t count;  /**< objects */
    uint32_t shift;
    size_t parts, chunk_count;
    deal_chunk *chunks;
    uint32_t *offsets; /**< [chunk][part] */
} dealing;

/** Chunks without entries, of deal->count objects for deal->parts parts. FROE_E_MEMORY. */
froe_status deal_new(dealing *deal);
void deal_free(dealing *deal);
/** Empties all chunks. */
void deal_clear(dealing *deal);
/** Calls fn for each chunk; user: what fn gets. */
froe_status deal_each(dealing *deal, double span, base_job_fn *fn, void *user);
/** Where the entries of each part begin, and, behind them, how many there are in all. FROE_E_LIMIT: too many. */
froe_status deal_starts(dealing *deal, uint32_t *starts);
/** Writes ids and the rest of places, which may be NULL, to where they go; drops the entries. */
froe_status deal_out(dealing *deal, double span, uint32_t *ids, uint16_t *places);
#endif
