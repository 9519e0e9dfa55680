/* deal.c: chunks, sums, and the copy. */
#include "build/index/deal.h"

enum { CHUNK = 1 << 15 };

/* What counts of a chunk take, which threads write side by side. */
static size_t row_of(const dealing *d) {
    return d->parts + sizeof(base_apart) / sizeof *d->offsets;
}

froe_status deal_new(dealing *d) {
    d->chunk_count = ((size_t)d->count + CHUNK - 1) / CHUNK;
    d->chunks = support_calloc(&d->alloc, d->chunk_count, sizeof *d->chunks);
    d->offsets = support_calloc(&d->alloc, d->chunk_count * row_of(d), sizeof *d->offsets);
    if (!d->chunks || !d->offsets) return FROE_E_MEMORY;
    for (size_t i = 0; i < d->chunk_count; i++) {
        const size_t from = i * CHUNK, rest = d->count - from;
        d->chunks[i].from = (uint32_t)from;
        d->chunks[i].to = (uint32_t)(from + (rest < CHUNK ? rest : CHUNK));
        d->chunks[i].parts = d->offsets + i * row_of(d);
    }
    return FROE_OK;
}

void deal_free(dealing *d) {
    for (size_t i = 0; d->chunks && i < d->chunk_count; i++) array_free(&d->alloc, &d->chunks[i].entries);
    support_free(&d->alloc, d->chunks, d->chunk_count * sizeof *d->chunks);
    support_free(&d->alloc, d->offsets, d->chunk_count * row_of(d) * sizeof *d->offsets);
}

void deal_clear(dealing *d) {
    for (size_t i = 0; i < d->chunk_count; i++) d->chunks[i].entries.count = 0;
    memset(d->offsets, 0, d->chunk_count * row_of(d) * sizeof *d->offsets);
}

froe_status deal_each(dealing *d, double span, base_job_fn *fn, void *user) {
    froe_status status = FROE_OK;
    if (d->task) return base_run(d->task, span, d->chunk_count, fn, user);
    for (size_t i = 0; i < d->chunk_count && !status; i++) status = fn(user, 0, i);
    return status;
}

froe_status deal_starts(dealing *d, uint32_t *starts) {
    uint64_t all = 0;
    for (size_t c = 0; c < d->chunk_count; c++) all += d->chunks[c].entries.count;
    if (all > INT32_MAX) return FROE_E_LIMIT;
    uint32_t next = 0;
    for (size_t p = 0; p < d->parts; p++) {
        starts[p] = next;
        for (size_t c = 0; c < d->chunk_count; c++) {
            const uint32_t entries = d->chunks[c].parts[p];
            d->chunks[c].parts[p] = next;
            next += entries;
        }
    }
    starts[d->parts] = next;
    return FROE_OK;
}

typedef struct deal_copy {
    dealing *deal;
    uint32_t *ids;
    uint16_t *places;
} deal_copy;

static froe_status copy_chunk(void *user, unsigned worker, size_t job) {
    const deal_copy *c = user;
    deal_chunk *chunk = c->deal->chunks + job;
    const uint32_t shift = c->deal->shift, mask = (1u << shift) - 1;
    (void)worker;
    for (size_t i = 0; i < chunk->entries.count; i++) {
        const deal_entry entry = chunk->entries.data[i];
        const uint32_t to = chunk->parts[entry.place >> shift]++;
        c->ids[to] = entry.id;
        if (c->places) c->places[to] = (uint16_t)(entry.place & mask);
    }
    array_free(&c->deal->alloc, &chunk->entries);
    return FROE_OK;
}

froe_status deal_out(dealing *d, double span, uint32_t *ids, uint16_t *places) {
    deal_copy copy = {d, ids, places};
    return deal_each(d, span, copy_chunk, &copy);
}
