/* folder.c: a folder whose shards the ranks have divided among them, and the words that they exchange. */
#include "ranks.h"
#include "support/array.h"
#include "support/fail.h"
#include <froe/shard_parts.h>

struct froe_mpi_folder {
    mpi_ranks ranks;
    froe_shards *shards;
    froe_mpi_spent spent;
    int *counts; /* four arrays: words to send, where they begin, the same of those to receive */
    froe_allocator alloc;
};

/* Room for what comes. Words of one rank are counted by an int. */
static froe_status count_words(const froe_mpi_folder *f, const size_t *counts, size_t *in_counts,
                               froe_shard_records *in, froe_diagnostic *diag) {
    enum { WORD = 8 };
    const int ranks = f->ranks.count;
    int *const send = f->counts, *const from = send + ranks, *const receive = from + ranks, *const to = receive + ranks;
    size_t going = 0, coming = 0;
    for (int r = 0; r < ranks; r++) going += counts[r] / WORD;
    const bool many = going > INT32_MAX;
    going = 0;
    for (int r = 0; r < ranks; r++) {
        send[r] = many ? 0 : (int)(counts[r] / WORD);
        from[r] = (int)going, going += (size_t)send[r];
    }
    MPI_Alltoall(send, 1, MPI_INT, receive, 1, MPI_INT, f->ranks.comm);
    bool room = true;
    for (int r = 0; r < ranks; r++) {
        room = room && coming <= INT32_MAX;
        to[r] = room ? (int)coming : 0, coming += (size_t)receive[r];
        in_counts[r] = (size_t)receive[r] * WORD;
    }
    if (many || !room || coming > INT32_MAX)
        return support_fail(diag, FROE_E_LIMIT, "More than 16 GB of questions or answers come at once.");
    if (coming && !support_array_grow(&in->alloc, (void **)&in->bytes, &in->capacity, 0, coming * WORD, 1))
        return support_fail_memory(diag);
    in->count = coming * WORD;
    return FROE_OK;
}

/* A froe_shards_trade_fn. */
static froe_status trade(void *user, froe_status status, const froe_shard_records *out, const size_t *counts,
                         froe_shard_records *in, size_t *in_counts, froe_diagnostic *diag) {
    froe_mpi_folder *f = user;
    const int ranks = f->ranks.count;
    int *const send = f->counts, *const from = send + ranks, *const receive = from + ranks, *const to = receive + ranks;
    if ((status = mpi_agree(&f->ranks, status, diag))) return status;
    const froe_mpi_cost then = mpi_now(&f->ranks);
    status = mpi_agree(&f->ranks, count_words(f, counts, in_counts, in, diag), diag);
    if (!status)
        MPI_Alltoallv(out->bytes, send, from, MPI_UINT64_T, in->bytes, receive, to, MPI_UINT64_T, f->ranks.comm);
    mpi_count(&f->ranks, &f->spent.exchange, then);
    return status;
}

/* Opens the shards that this rank owns. */
static froe_status open_own(froe_mpi_folder *f, froe_diagnostic *diag) {
    const uint32_t count = froe_shards_about(f->shards).shards;
    froe_status status = FROE_OK;
    for (uint32_t s = (uint32_t)f->ranks.rank; s < count && !status; s += (uint32_t)f->ranks.count) {
        const froe_tree *tree;
        status = froe_shards_tree(f->shards, s, &tree, diag);
    }
    return status;
}

froe_status froe_mpi_open(MPI_Comm comm, const char *path, froe_mpi_folder **out, froe_diagnostic *diag) {
    const mpi_ranks ranks = mpi_ranks_of(comm);
    const froe_allocator alloc = support_allocator(NULL);
    froe_diagnostic why = {0};
    froe_mpi_folder *f = support_calloc(&alloc, 1, sizeof *f);
    froe_status status = f ? FROE_OK : support_fail_memory(&why);
    if (f) {
        *f = (froe_mpi_folder){.ranks = ranks, .alloc = alloc};
        f->ranks.waited = &f->spent.wait;
        f->counts = support_calloc(&alloc, 4 * (size_t)ranks.count, sizeof *f->counts);
        const froe_mpi_cost then = mpi_now(&f->ranks);
        status = f->counts ? froe_shards_open(path, NULL, &f->shards, &why) : support_fail_memory(&why);
        if (!status) status = open_own(f, &why);
        if (!status) status = froe_shards_share(f->shards, (uint32_t)ranks.rank, (uint32_t)ranks.count, trade, f, &why);
        mpi_count(&f->ranks, &f->spent.open, then);
    }
    status = mpi_agree(f ? &f->ranks : &ranks, status, &why);
    if (!status) {
        *out = f;
        return FROE_OK;
    }
    froe_mpi_close(f);
    if (diag) *diag = why;
    return status;
}

void froe_mpi_close(froe_mpi_folder *f) {
    if (!f) return;
    const froe_allocator alloc = f->alloc;
    froe_shards_close(f->shards);
    if (f->counts) support_free(&alloc, f->counts, 4 * (size_t)f->ranks.count * sizeof *f->counts);
    support_free(&alloc, f, sizeof *f);
}

froe_shards *froe_mpi_shards(froe_mpi_folder *f) {
    return f->shards;
}

froe_mpi_spent froe_mpi_spent_on(const froe_mpi_folder *f) {
    return f->spent;
}
