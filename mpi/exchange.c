/* exchange.c: see exchange.h. The ranks go in rounds: a rank whose outgoing records fill their room, or that has no
 * more, begins one and waits for the others. Each round first tells whether a rank has failed, and whether one has
 * more. */
#include "exchange.h"
#include "support/alloc.h"
#include "support/array.h"
#include "support/fail.h"

enum { ROOM = 16 << 20 }; /* bytes of a round that a rank sends; it receives about as many */

typedef ARRAY(uint64_t) word_array; /* records take whole words */

typedef struct exchange {
    const mpi_ranks *ranks;
    const froe_shard_plan *plan;
    froe_shard_buckets *buckets;
    froe_allocator alloc;
    word_array *out, in;      /* for each rank; from all of them */
    int *counts;              /* four arrays: words to send, where they begin, the same of those to receive */
    uint64_t *stamps, record; /* the last record that goes to each rank */
    uint32_t *cells;          /* room for all */
    size_t waiting;           /* bytes in `out` */
    uint64_t sent;
    bool stopped; /* a rank has failed */
    froe_diagnostic *diag;
} exchange;

static uint32_t cells_of(exchange *e, const void *record) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    froe_shard_record_box(record, lo, hi);
    return froe_shard_plan_cells(e->plan, lo, hi, e->cells);
}

/* Puts records that have arrived into the buckets of this rank's shards. */
static froe_status take_in(exchange *e) {
    const unsigned char *bytes = (const unsigned char *)e->in.data;
    const size_t count = e->in.count * sizeof(uint64_t);
    for (size_t at = 0, size; at < count; at += size) {
        size = froe_shard_record_size(bytes + at, count - at);
        if (!size) return support_fail(e->diag, FROE_E_FORMAT, "A record has been cut off on its way.");
        const uint32_t cells = cells_of(e, bytes + at);
        for (uint32_t i = 0; i < cells; i++) {
            if (mpi_owner(e->ranks, e->cells[i]) != e->ranks->rank) continue;
            const froe_status status = froe_shard_buckets_add(e->buckets, e->cells[i], bytes + at, size, e->diag);
            if (status) return status;
        }
    }
    return FROE_OK;
}

static froe_status trade(exchange *e) {
    const int ranks = e->ranks->count;
    int *const send = e->counts, *const from = send + ranks, *const receive = from + ranks, *const to = receive + ranks;
    word_array all = {0};
    size_t coming = 0;
    bool room = true;
    for (int r = 0; r < ranks; r++) {
        send[r] = (int)e->out[r].count, from[r] = (int)all.count;
        room = room && array_append(&e->alloc, &all, e->out[r].data, e->out[r].count);
        if (r != e->ranks->rank) e->sent += e->out[r].count * sizeof(uint64_t);
        e->out[r].count = 0;
    }
    e->waiting = 0;
    MPI_Alltoall(send, 1, MPI_INT, receive, 1, MPI_INT, e->ranks->comm);
    for (int r = 0; r < ranks; r++) to[r] = (int)coming, coming += (size_t)receive[r];
    room = room && array_reserve(&e->alloc, &e->in, coming);
    const int mine = room;
    int everywhere;
    MPI_Allreduce(&mine, &everywhere, 1, MPI_INT, MPI_MIN, e->ranks->comm);
    if (everywhere) {
        MPI_Alltoallv(all.data, send, from, MPI_UINT64_T, e->in.data, receive, to, MPI_UINT64_T, e->ranks->comm);
        e->in.count = coming;
    }
    array_free(&e->alloc, &all);
    e->stopped = !everywhere;
    return room ? FROE_OK : support_fail_memory(e->diag);
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
    array_free(&e->alloc, &e->in); /* what MPI has filled must not grow: see support/pages.c */
    return status;
}

static froe_status route(void *user, const void *records, size_t count) {
    exchange *e = user;
    for (size_t at = 0, size; at < count; at += size) {
        const unsigned char *record = (const unsigned char *)records + at;
        size = froe_shard_record_size(record, count - at);
        const uint32_t cells = cells_of(e, record);
        e->record++;
        for (uint32_t i = 0; i < cells; i++) {
            const int owner = mpi_owner(e->ranks, e->cells[i]);
            if (e->stamps[owner] == e->record) continue;
            e->stamps[owner] = e->record;
            if (!array_append(&e->alloc, &e->out[owner], (const uint64_t *)(const void *)record,
                              size / sizeof(uint64_t)))
                return support_fail_memory(e->diag);
            e->waiting += size;
        }
        bool more = true;
        const froe_status status = e->waiting < ROOM ? FROE_OK : go_round(e, FROE_OK, &more);
        if (status || e->stopped) return status ? status : FROE_E_CANCELLED; /* which is only to end the call */
    }
    return FROE_OK;
}

froe_status mpi_exchange(const mpi_ranks *ranks, const froe_shard_plan *plan, froe_shard_buckets *spool,
                         froe_shard_buckets *buckets, uint64_t *sent, froe_diagnostic *diag) {
    exchange e = {.ranks = ranks, .plan = plan, .buckets = buckets, .alloc = support_allocator(NULL), .diag = diag};
    const size_t count = (size_t)ranks->count, cells = froe_shard_plan_count(plan);
    e.out = support_calloc(&e.alloc, count, sizeof *e.out);
    e.counts = support_calloc(&e.alloc, 4 * count, sizeof *e.counts);
    e.stamps = support_calloc(&e.alloc, count, sizeof *e.stamps);
    e.cells = support_calloc(&e.alloc, cells, sizeof *e.cells);
    froe_status status = e.out && e.counts && e.stamps && e.cells ? FROE_OK : support_fail_memory(diag);
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
    support_free(&e.alloc, e.counts, 4 * count * sizeof *e.counts);
    support_free(&e.alloc, e.stamps, count * sizeof *e.stamps);
    support_free(&e.alloc, e.cells, cells * sizeof *e.cells);
    *sent = e.sent;
    return status;
}
