/* build.c: folders of shards by several ranks, in the steps of froe/shard_parts.h. */
#include "exchange.h"
#include "support/alloc.h"
#include "support/fail.h"
#include <string.h>

struct froe_mpi_builder {
    mpi_ranks ranks;
    int dim;
    uint64_t objects; /* of this rank */
    froe_shards_options o;
    froe_allocator alloc;
    char *folder; /* in which the new one grows; the draft is rank 0's */
    size_t folder_size;
    froe_shard_draft *draft;
    froe_shard_sample *sample;
    froe_shard_buckets *spool, *buckets;
    froe_shard_plan *plan;
    froe_shard_entry *entries;
    froe_shard_records batch;
    froe_mpi_cost began;
    froe_mpi_costs costs; /* so far; waiting is counted by `ranks` */
    froe_status status;   /* of what this rank has done so far */
    froe_diagnostic diag;
};

/* Collective. Brings the folder to its place, and removes the old one. */
static froe_status place_folder(froe_mpi_builder *b) {
    bool replaced = false;
    const uint32_t rank = (uint32_t)b->ranks.rank, count = (uint32_t)b->ranks.count;
    froe_status status = froe_shard_draft_sync(b->folder, rank, count, &b->diag);
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    status = b->draft ? froe_shard_draft_place(b->draft, &replaced, &b->diag) : FROE_OK;
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    MPI_Bcast(&replaced, sizeof replaced, MPI_BYTE, 0, b->ranks.comm);
    if (replaced) froe_shard_draft_clear(b->folder, rank, count);
    return mpi_agree(&b->ranks, FROE_OK, &b->diag);
}

/* Collective. Brings the folder to its place, or leaves everything as it was, and frees the builder. */
static froe_status end_builder(froe_mpi_builder *b, froe_status status, froe_diagnostic *diag) {
    const froe_allocator alloc = b->alloc;
    const mpi_ranks ranks = b->ranks;
    b->diag.status = status;
    froe_shard_buckets_free(b->spool);
    froe_shard_buckets_free(b->buckets);
    if (!status) status = place_folder(b);
    if (b->draft) status = froe_shard_draft_end(b->draft, status, &b->diag);
    status = mpi_agree(&ranks, status, &b->diag);
    if (status && diag) *diag = b->diag;
    froe_shard_sample_free(b->sample);
    if (b->entries) support_free(&alloc, b->entries, froe_shard_plan_count(b->plan) * sizeof *b->entries);
    froe_shard_plan_free(b->plan);
    froe_shard_records_free(&b->batch);
    support_free(&alloc, b->folder, b->folder_size);
    support_free(&alloc, b, sizeof *b);
    return status;
}

/* Collective: rank 0 begins the draft, and all know its folder. */
static froe_status begin_draft(froe_mpi_builder *b, const char *path) {
    froe_status status = FROE_OK;
    if (!b->ranks.rank) status = froe_shard_draft_begin(path, NULL, &b->draft, &b->diag);
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    uint64_t size = b->draft ? strlen(froe_shard_draft_folder(b->draft)) + 1 : 0;
    MPI_Bcast(&size, 1, MPI_UINT64_T, 0, b->ranks.comm);
    b->folder = support_calloc(&b->alloc, size, 1);
    b->folder_size = size;
    status = mpi_agree(&b->ranks, b->folder ? FROE_OK : support_fail_memory(&b->diag), &b->diag);
    if (status) return status;
    if (b->draft) memcpy(b->folder, froe_shard_draft_folder(b->draft), size);
    MPI_Bcast(b->folder, (int)size, MPI_CHAR, 0, b->ranks.comm);
    return FROE_OK;
}

/* Collective. A rank without objects may give another dimension by mistake; what the others send would be no records
 * to it. */
static froe_status compare_dims(froe_mpi_builder *b) {
    const int mine[2] = {b->dim, -b->dim};
    int least[2];
    MPI_Allreduce(mine, least, 2, MPI_INT, MPI_MIN, b->ranks.comm);
    if (least[0] == -least[1]) return FROE_OK;
    return support_fail(&b->diag, FROE_E_ARG, "The dimensions %d and %d are given by processes that build one folder.",
                        least[0], -least[1]);
}

froe_status froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                           froe_mpi_builder **out, froe_diagnostic *diag) {
    const mpi_ranks ranks = mpi_ranks_of(comm);
    const froe_allocator alloc = support_allocator(NULL);
    froe_diagnostic why = {0};
    froe_mpi_builder *b = support_calloc(&alloc, 1, sizeof *b);
    froe_status status = mpi_agree(&ranks, b ? FROE_OK : support_fail_memory(&why), &why);
    if (status) {
        support_free(&alloc, b, sizeof *b);
        if (diag) *diag = why;
        return status;
    }
    *b = (froe_mpi_builder){.ranks = ranks, .dim = dim, .alloc = alloc};
    b->ranks.waited = &b->costs.wait;
    b->began = mpi_now(&b->ranks);
    b->o = options ? *options : froe_shards_defaults();
    b->o.progress = NULL, b->o.alloc = NULL;
    status = begin_draft(b, path);
    if (!status && b->o.size != sizeof b->o) status = support_fail_defaults(&b->diag, "froe_shards_defaults");
    if (!status && (dim < 2 || dim > FROE_MAX_DIM))
        status = support_fail(&b->diag, FROE_E_ARG, "The dimension %d is not within 2 and %d.", dim, FROE_MAX_DIM);
    if (!status && froe_shard_sample_new(dim, NULL, &b->sample)) status = support_fail_memory(&b->diag);
    if (!status) status = froe_shard_buckets_new(b->folder, 1, NULL, &b->spool, &b->diag);
    if (!(status = mpi_agree(&b->ranks, status, &b->diag))) status = compare_dims(b);
    if (status) return end_builder(b, status, diag);
    *out = b;
    return FROE_OK;
}

const char *froe_mpi_draft(const froe_mpi_builder *b) {
    return b->folder;
}

void froe_mpi_fail(froe_mpi_builder *b, const froe_diagnostic *why) {
    if (b->status) return;
    b->diag = *why;
    b->status = why->status;
}

froe_status froe_mpi_add(froe_mpi_builder *b, const froe_objects *batch, uint64_t first, froe_diagnostic *diag) {
    froe_status status = b->status;
    if (!status && (batch->groups || batch->group != FROE_NONE))
        status = support_fail(&b->diag, FROE_E_UNSUPPORTED, "Objects with groups are not built by several processes.");
    b->batch.count = 0;
    if (!status) status = froe_shard_records_add(&b->batch, b->dim, batch, first, &b->diag);
    if (!status) status = froe_shard_buckets_add(b->spool, 0, b->batch.bytes, b->batch.count, &b->diag);
    if (!status && froe_shard_sample_add(b->sample, b->batch.bytes, b->batch.count))
        status = support_fail_memory(&b->diag);
    if (status && diag) *diag = b->diag;
    if (!status) b->objects += batch->count;
    return b->status = status;
}

/* ------------------------------------------------------------------- finish -- */

/* Merges the sample of another rank, of so many words; 0: it has failed. It is told whether there is room. */
static froe_status receive_sample(froe_mpi_builder *b, int from, uint64_t count) {
    const MPI_Comm comm = b->ranks.comm;
    uint64_t *words = count ? support_calloc(&b->alloc, count, sizeof *words) : NULL;
    const int room = words != NULL;
    MPI_Send(&room, 1, MPI_INT, from, 0, comm);
    if (!room) return support_fail_memory(&b->diag);
    MPI_Recv(words, (int)count, MPI_UINT64_T, from, 0, comm, MPI_STATUS_IGNORE);
    const froe_status status = froe_shard_sample_merge(b->sample, words, count);
    support_free(&b->alloc, words, count * sizeof *words);
    return status ? support_fail_memory(&b->diag) : FROE_OK;
}

/* 2^17 objects are fewer than 2^31 words. A rank that has failed sends none. */
static void send_sample(froe_mpi_builder *b, int to, froe_status status) {
    size_t words = 0;
    const uint64_t *mine = status ? NULL : froe_shard_sample_words(b->sample, &words);
    const uint64_t count = mine ? words : 0;
    int room;
    MPI_Send(&count, 1, MPI_UINT64_T, to, 0, b->ranks.comm);
    MPI_Recv(&room, 1, MPI_INT, to, 0, b->ranks.comm, MPI_STATUS_IGNORE);
    if (room) MPI_Send(mine, (int)count, MPI_UINT64_T, to, 0, b->ranks.comm);
}

/* Collective: rank 0 merges the samples of all, two by two:
 *
 *     0 <- 1   2 <- 3   4 <- 5
 *     0 <----- 2        4
 *     0 <-------------- 4 */
static froe_status merge_samples(froe_mpi_builder *b) {
    const int rank = b->ranks.rank;
    froe_status status = FROE_OK;
    for (int step = 1; step < b->ranks.count; step *= 2) {
        if (rank & step) {
            send_sample(b, rank - step, status);
            return FROE_OK;
        }
        if (rank + step >= b->ranks.count) continue;
        uint64_t count;
        MPI_Recv(&count, 1, MPI_UINT64_T, rank + step, 0, b->ranks.comm, MPI_STATUS_IGNORE);
        const froe_status received = receive_sample(b, rank + step, count);
        if (!status) status = received;
    }
    return status;
}

/* Collective: leaves of this rank's sample what can be in that of all. */
static void cut_sample(froe_mpi_builder *b) {
    const uint64_t mine = froe_shard_sample_bound(b->sample, (uint32_t)b->ranks.count);
    uint64_t bound;
    MPI_Allreduce(&mine, &bound, 1, MPI_UINT64_T, MPI_MAX, b->ranks.comm);
    froe_shard_sample_cut(b->sample, bound);
}

/* Collective: the plan that the samples of all ranks give. */
static froe_status make_plan(froe_mpi_builder *b) {
    const bool first = !b->ranks.rank;
    size_t words = 0;
    mpi_wait(&b->ranks);
    cut_sample(b);
    froe_status status = merge_samples(b);
    const uint64_t *all = first && !status ? froe_shard_sample_words(b->sample, &words) : NULL;
    if (first && !status && !all) status = support_fail_memory(&b->diag);
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    uint64_t count = words, *copy = NULL;
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, b->ranks.comm);
    froe_shard_sample *sample = NULL;
    if (!(copy = support_calloc(&b->alloc, count, sizeof *copy)) || froe_shard_sample_new(b->dim, NULL, &sample))
        status = support_fail_memory(&b->diag);
    if (first && copy) memcpy(copy, all, count * sizeof *copy);
    if (!(status = mpi_agree(&b->ranks, status, &b->diag))) {
        MPI_Bcast(copy, (int)count, MPI_UINT64_T, 0, b->ranks.comm);
        if (froe_shard_sample_merge(sample, copy, count)) status = support_fail_memory(&b->diag);
        if (!status) status = froe_shard_plan_new(sample, b->o.shards, b->o.memory, &b->plan, &b->diag);
    }
    if (copy) support_free(&b->alloc, copy, count * sizeof *copy);
    froe_shard_sample_free(sample);
    return mpi_agree(&b->ranks, status, &b->diag);
}

static froe_status send_all(froe_mpi_builder *b) {
    froe_status status = make_plan(b);
    if (status) return status;
    const uint32_t count = froe_shard_plan_count(b->plan);
    b->entries = support_calloc(&b->alloc, count, sizeof *b->entries);
    if (!b->entries) status = support_fail_memory(&b->diag);
    if (!status) status = froe_shard_buckets_new(b->folder, count, NULL, &b->buckets, &b->diag);
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    status = mpi_exchange(&b->ranks, b->plan, b->spool, b->buckets, &b->costs.sent, &b->diag);
    return mpi_agree(&b->ranks, status, &b->diag);
}

static froe_status gather(void *user, const void *records, size_t count) {
    froe_mpi_builder *b = user;
    return froe_shard_records_append(&b->batch, records, count, &b->diag);
}

/* This rank's shards, then all entries at rank 0 and the manifest. */
static froe_status build_all(froe_mpi_builder *b) {
    const uint32_t count = froe_shard_plan_count(b->plan);
    froe_status status = FROE_OK;
    for (uint32_t turn = 0, s; !status && (s = mpi_own_shard(&b->ranks, turn)) < count; turn++) {
        b->batch.count = 0;
        status = froe_shard_buckets_take(b->buckets, s, gather, b, &b->diag);
        if (!status) status = froe_shard_build(&b->batch, b->plan, s, NULL, &b->o, b->folder, &b->entries[s], &b->diag);
        froe_shard_records_free(&b->batch);
    }
    if ((status = mpi_agree(&b->ranks, status, &b->diag))) return status;
    MPI_Allreduce(MPI_IN_PLACE, b->entries, (int)(count * sizeof *b->entries), MPI_BYTE, MPI_BOR, b->ranks.comm);
    if (b->draft) status = froe_shard_manifest_write(b->plan, b->entries, b->folder, NULL, &b->diag);
    return mpi_agree(&b->ranks, status, &b->diag);
}

froe_status froe_mpi_finish(froe_mpi_builder *b, froe_shards_report *out, froe_mpi_costs *costs,
                            froe_diagnostic *diag) {
    const mpi_ranks ranks = mpi_ranks_of(b->ranks.comm);
    froe_shards_report report = {0};
    mpi_count(&b->ranks, &b->costs.read, b->began);
    froe_status status = mpi_agree(&b->ranks, b->status, &b->diag);
    const uint64_t objects = status ? 0 : mpi_sum(&ranks, b->objects);
    if (!status && !objects) status = support_fail(&b->diag, FROE_E_INPUT, "There are no objects.");
    froe_mpi_cost then = mpi_now(&b->ranks);
    if (!status) status = send_all(b);
    mpi_count(&b->ranks, &b->costs.exchange, then);
    then = mpi_now(&b->ranks);
    if (!status) status = build_all(b);
    mpi_count(&b->ranks, &b->costs.build, then);
    if (!status) report = froe_shard_report(b->plan, b->entries);
    froe_mpi_costs spent = b->costs;
    status = end_builder(b, status, diag);
    if (status) return status;
    spent.read = mpi_slowest(&ranks, spent.read), spent.exchange = mpi_slowest(&ranks, spent.exchange);
    spent.build = mpi_slowest(&ranks, spent.build), spent.wait = mpi_slowest(&ranks, spent.wait);
    spent.sent = mpi_sum(&ranks, spent.sent);
    if (out) *out = report;
    if (costs) *costs = spent;
    return FROE_OK;
}
