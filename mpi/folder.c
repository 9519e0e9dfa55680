/* folder.c: a folder whose shards the ranks have divided among them, and the words that they exchange. */
#include "ranks.h"
#include "support/array.h"
#include "support/fail.h"
#include <froe/shard_parts.h>

struct froe_mpi_folder {
    mpi_ranks ranks;
    froe_shards *shards;
    froe_mpi_spent spent;
    uint64_t *words, *there; /* how many go to each rank, and come from it */
    const uint64_t **begins; /* of those that go */
    froe_allocator alloc;
};

/* Room for what comes. */
static froe_status count_words(const froe_mpi_folder *f, const size_t *counts, size_t *in_counts,
                               froe_shard_records *in, froe_diagnostic *diag) {
    enum { WORD = 8 };
    size_t coming = 0;
    for (int r = 0; r < f->ranks.count; r++) f->words[r] = counts[r] / WORD;
    mpi_tell_counts(&f->ranks, f->words, f->there);
    for (int r = 0; r < f->ranks.count; r++) coming += in_counts[r] = f->there[r] * WORD;
    if (coming && !support_array_grow(&in->alloc, (void **)&in->bytes, &in->capacity, 0, coming, 1))
        return support_fail_memory(diag);
    in->count = coming;
    return FROE_OK;
}

/* A froe_shards_trade_fn. */
static froe_status trade(void *user, froe_status status, const froe_shard_records *out, const size_t *counts,
                         froe_shard_records *in, size_t *in_counts, froe_diagnostic *diag) {
    froe_mpi_folder *f = user;
    const unsigned char *begin = out->bytes;
    if ((status = mpi_agree(&f->ranks, status, diag))) return status;
    const froe_mpi_cost then = mpi_now(&f->ranks);
    status = mpi_agree(&f->ranks, count_words(f, counts, in_counts, in, diag), diag);
    for (int r = 0; r < f->ranks.count; begin += counts[r++]) f->begins[r] = (const uint64_t *)(const void *)begin;
    if (!status) mpi_swap(&f->ranks, f->begins, f->words, (uint64_t *)(void *)in->bytes, f->there);
    mpi_count(&f->ranks, &f->spent.exchange, then);
    return status;
}

/* Opens the shards that this rank owns. */
static froe_status open_own(froe_mpi_folder *f, froe_diagnostic *diag) {
    const uint32_t count = froe_shards_about(f->shards).shards;
    froe_status status = FROE_OK;
    for (uint32_t turn = 0, s; !status && (s = mpi_own_shard(&f->ranks, turn)) < count; turn++) {
        const froe_tree *tree;
        status = froe_shards_tree(f->shards, s, &tree, diag);
    }
    return status;
}

/* Collective, of a folder that all have opened: is it the same one? It may have been built anew meanwhile. */
static froe_status compare_folders(const froe_mpi_folder *f, const char *path, froe_diagnostic *diag) {
    const uint64_t check = froe_shards_about(f->shards).check, mine[2] = {check, ~check};
    uint64_t least[2];
    MPI_Allreduce(mine, least, 2, MPI_UINT64_T, MPI_MIN, f->ranks.comm);
    if (least[0] == ~least[1]) return FROE_OK;
    return support_fail(diag, FROE_E_FORMAT,
                        "%s: Processes have opened different folders of this name: it was built anew meanwhile, or "
                        "they do not see the same files.",
                        support_short(path));
}

/* This rank's handle of the folder, of which no shard is open. NULL: no memory. */
static froe_mpi_folder *make_folder(const mpi_ranks *ranks) {
    const froe_allocator alloc = support_allocator(NULL);
    const size_t count = (size_t)ranks->count;
    froe_mpi_folder *f = support_calloc(&alloc, 1, sizeof *f);
    if (!f) return NULL;
    *f = (froe_mpi_folder){.ranks = *ranks, .alloc = alloc};
    f->ranks.waited = &f->spent.wait;
    f->words = support_calloc(&alloc, 2 * count, sizeof *f->words);
    f->begins = support_calloc(&alloc, count, sizeof *f->begins);
    f->there = f->words ? f->words + count : NULL;
    if (f->words && f->begins) return f;
    froe_mpi_close(f);
    return NULL;
}

froe_status froe_mpi_open(MPI_Comm comm, const char *path, froe_mpi_folder **out, froe_diagnostic *diag) {
    const mpi_ranks ranks = mpi_ranks_of(comm);
    const froe_mpi_cost then = mpi_now(&ranks);
    froe_diagnostic why = {0};
    froe_mpi_folder *f = make_folder(&ranks);
    froe_status status = f ? froe_shards_open(path, NULL, &f->shards, &why) : support_fail_memory(&why);
    if (!(status = mpi_agree(&ranks, status, &why))) status = compare_folders(f, path, &why);
    if (!status) {
        status = open_own(f, &why);
        if (!status) status = froe_shards_share(f->shards, (uint32_t)ranks.rank, (uint32_t)ranks.count, trade, f, &why);
        mpi_count(&ranks, &f->spent.open, then);
        status = mpi_agree(&f->ranks, status, &why);
    }
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
    if (f->words) support_free(&alloc, f->words, 2 * (size_t)f->ranks.count * sizeof *f->words);
    if (f->begins) support_free(&alloc, f->begins, (size_t)f->ranks.count * sizeof *f->begins);
    support_free(&alloc, f, sizeof *f);
}

froe_shards *froe_mpi_shards(froe_mpi_folder *f) {
    return f->shards;
}

froe_mpi_spent froe_mpi_spent_on(const froe_mpi_folder *f) {
    return f->spent;
}
