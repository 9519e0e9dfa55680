/* exchange.c: see exchange.h. The ranks go in rounds: a rank whose records for another one fill their room, or that has
 * no more, begins one and waits for the others. Each round first tells whether a rank has failed, and whether one has
 * more. Records of a rank's own shards go into their buckets at once. */
#include "exchange.h"
#include "support/alloc.h"
#include "support/array.h"
#include "support/fail.h"

enum { ROOM = 4 << 20 }; /* bytes of a round that a rank sends, at most; it receives about as many */

typedef ARRAY(uint64_t) word_array; /* records take whole words */

typedef struct exchange {
    const mpi_ranks *ranks;
    const froe_shard_plan *plan;
    froe_shard_buckets *buckets;
    froe_allocator alloc;
    word_array *out, in;       /* for each rank; from all of them. MPI has seen them, so that none is to grow */
    uint64_t *words, *there;   /* how many go to each rank, and come from it */
    const uint64_t **begins;   /* of `out` */
    uint64_t *stamps, record;  /* the last record that goes to each rank */
    uint32_t *cells, *arrived; /* of a record of this rank, and of one that has arrived: room for all */
    uint64_t sent;
    bool stopped; /* a rank has failed */
    froe_diagnostic *diag;
} exchange;

static uint32_t cells_of(const exchange *e, const void *record, uint32_t *cells) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    froe_shard_record_box(record, lo, hi);
    return froe_shard_plan_cells(e->plan, lo, hi, cells);
}

/* Puts records that have arrived into the buckets of this rank's shards. */
static froe_status take_in(exchange *e) {
    const unsigned char *bytes = (const unsigned char *)e->in.data;
    const size_t count = e->in.count * sizeof(uint64_t);
    for (size_t at = 0, size; at < count; at += size) {
        size = froe_shard_record_size(bytes + at, count - at);
        if (!size) return support_fail(e->diag, FROE_E_FORMAT, "A record has been cut off on its way.");
        const uint32_t cells = cells_of(e, bytes + at, e->arrived);
        for (uint32_t i = 0; i < cells; i++) {
            if (mpi_owner(e->ranks, e->arrived[i]) != e->ranks->rank) continue;
            const froe_status status = froe_shard_buckets_add(e->buckets, e->arrived[i], bytes + at, size, e->diag);
            if (status) return status;
        }
    }
    return FROE_OK;
}

/* Room for so many words in an empty array, which is made anew where it has less. */
static bool make_room(const exchange *e, word_array *a, size_t words) {
    if (a->capacity >= words) return true;
    array_free(&e->alloc, a);
    return array_reserve(&e->alloc, a, words);
}

static froe_status trade(exchange *e) {
    uint64_t coming = 0;
    for (int r = 0; r < e->ranks->count; r++) {
        e->begins[r] = e->out[r].data, e->words[r] = e->out[r].count;
        e->sent += e->words[r] * sizeof(uint64_t);
        e->out[r].count = 0;
    }
    mpi_tell_counts(e->ranks, e->words, e->there);
    for (int r = 0; r < e->ranks->count; r++) coming += e->there[r];
    const int mine = make_room(e, &e->in, coming);
    int everywhere;
    MPI_Allreduce(&mine, &everywhere, 1, MPI_INT, MPI_MIN, e->ranks->comm);
    e->stopped = !everywhere;
    if (everywhere) mpi_swap(e->ranks, e->begins, e->words, e->in.data, e->there);
    e->in.count = everywhere ? coming : 0;
    return mine ? FROE_OK : support_fail_memory(e->diag);
}

/* One round. *more: this rank has more after it; then whether one of them has. */
static froe_status go_round(exchange *e, froe_status status, bool *more) {
    const int mine[2] = {status != FROE_OK, *more};
    int most[2] = {0};
    mpi_wait(e->ranks);
    MPI_Allreduce(mine, most, 2, MPI_INT, MPI_MAX, e->ranks->comm);
    e->stopped = most[0] != 0, *more = most[1] != 0;
    if (e->stopped) return status;
    status = trade(e);
    if (!status && !e->stopped) status = take_in(e);
    e->in.count = 0;
    return status;
}

/* Puts a record to those that go to a rank, behind a round if they have no room for it. */
static froe_status post(exchange *e, int to, const void *record, size_t size) {
    word_array *out = &e->out[to];
    const size_t words = size / sizeof(uint64_t), room = ROOM / sizeof(uint64_t) / (size_t)e->ranks->count;
    if (out->count && out->capacity - out->count < words) {
        bool more = true;
        const froe_status status = go_round(e, FROE_OK, &more);
        if (status || e->stopped) return status ? status : FROE_E_CANCELLED; /* which is only to end the call */
    }
    if (!out->count && !make_room(e, out, words > room ? words : room)) return support_fail_memory(e->diag);
    memcpy(out->data + out->count, record, size);
    out->count += words;
    return FROE_OK;
}

static froe_status route(void *user, const void *records, size_t count) {
    exchange *e = user;
    froe_status status = FROE_OK;
    for (size_t at = 0, size; at < count && !status; at += size) {
        const unsigned char *record = (const unsigned char *)records + at;
        size = froe_shard_record_size(record, count - at);
        const uint32_t cells = cells_of(e, record, e->cells);
        e->record++;
        for (uint32_t i = 0; i < cells && !status; i++) {
            const int owner = mpi_owner(e->ranks, e->cells[i]);
            if (owner == e->ranks->rank) {
                status = froe_shard_buckets_add(e->buckets, e->cells[i], record, size, e->diag);
            } else if (e->stamps[owner] != e->record) {
                e->stamps[owner] = e->record;
                status = post(e, owner, record, size);
            }
        }
    }
    return status;
}

froe_status mpi_exchange(const mpi_ranks *ranks, const froe_shard_plan *plan, froe_shard_buckets *spool,
                         froe_shard_buckets *buckets, uint64_t *sent, froe_diagnostic *diag) {
    exchange e = {.ranks = ranks, .plan = plan, .buckets = buckets, .alloc = support_allocator(NULL), .diag = diag};
    const size_t count = (size_t)ranks->count, cells = froe_shard_plan_count(plan);
    e.out = support_calloc(&e.alloc, count, sizeof *e.out);
    e.words = support_calloc(&e.alloc, 2 * count, sizeof *e.words);
    e.begins = support_calloc(&e.alloc, count, sizeof *e.begins);
    e.stamps = support_calloc(&e.alloc, count, sizeof *e.stamps);
    e.cells = support_calloc(&e.alloc, 2 * cells, sizeof *e.cells);
    const bool room = e.out && e.words && e.begins && e.stamps && e.cells;
    froe_status status = mpi_agree(ranks, room ? FROE_OK : support_fail_memory(diag), diag);
    if (room) e.there = e.words + count, e.arrived = e.cells + cells;
    e.stopped = status != FROE_OK;
    if (!status) status = froe_shard_buckets_take(spool, 0, route, &e, diag);
    bool more = true;
    while (!e.stopped && more) { /* also with a failure, which the others wait to hear of */
        more = false;
        status = go_round(&e, status, &more);
    }
    if (e.stopped && status == FROE_E_CANCELLED) status = FROE_OK; /* another rank's failure */
    for (size_t r = 0; e.out && r < count; r++) array_free(&e.alloc, &e.out[r]);
    array_free(&e.alloc, &e.in);
    support_free(&e.alloc, e.out, count * sizeof *e.out);
    support_free(&e.alloc, e.words, 2 * count * sizeof *e.words);
    support_free(&e.alloc, e.begins, count * sizeof *e.begins);
    support_free(&e.alloc, e.stamps, count * sizeof *e.stamps);
    support_free(&e.alloc, e.cells, 2 * cells * sizeof *e.cells);
    *sent = e.sent;
    return status;
}
