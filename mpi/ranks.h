/* ranks.h: what the ranks of a communicator agree on */
#ifndef FROE_MPI_RANKS_H
#define FROE_MPI_RANKS_H
#include <froe/mpi.h>
#include <froe/shard_parts.h>

typedef struct mpi_ranks {
    MPI_Comm comm;
    int rank, count;
    froe_mpi_cost *waited; /**< what this rank spent waiting for others, while it agreed with them; NULL: not counted */
} mpi_ranks;
mpi_ranks mpi_ranks_of(MPI_Comm comm);

/** The rank that owns a shard. */
static inline int mpi_owner(const mpi_ranks *ranks, uint32_t shard) {
    return (int)froe_shard_owner(shard, (uint32_t)ranks->count);
}
/** This rank's shard number `turn`; the last one is followed by numbers that no shard has. */
static inline uint32_t mpi_own_shard(const mpi_ranks *ranks, uint32_t turn) {
    return froe_shard_of_turn((uint32_t)ranks->rank, (uint32_t)ranks->count, turn);
}

/** Collective: the status of the first rank that has failed, with its diagnostic, on all ranks. `diag` is needed. */
froe_status mpi_agree(const mpi_ranks *ranks, froe_status status, froe_diagnostic *diag);

/** Collective: waits for all ranks, which is counted. So what follows takes no more than its own time. */
void mpi_wait(const mpi_ranks *ranks);

/** Seconds that the calling rank has used so far, but for waiting. */
froe_mpi_cost mpi_now(const mpi_ranks *ranks);
/** Adds what has gone by since `then`. */
void mpi_count(const mpi_ranks *ranks, froe_mpi_cost *sum, froe_mpi_cost then);
/** Collective: the most of all ranks, and `all` of them together. */
froe_mpi_cost mpi_slowest(const mpi_ranks *ranks, froe_mpi_cost mine);
/** Prints what mpi_slowest() has found, on standard error. */
void mpi_print_cost(const char *what, froe_mpi_cost cost);
/** Collective: the sum of all ranks. */
uint64_t mpi_sum(const mpi_ranks *ranks, uint64_t mine);
/** Collective: words[r] goes to rank r, and there[r] comes from it. */
void mpi_tell_counts(const mpi_ranks *ranks, const uint64_t *words, uint64_t *there);
/** Collective: sends words[r] words to rank r, which begin at out[r], and receives there[r] words from it, in the order
 * of the ranks. More words than an int counts may go. Memory that MPI has seen must not grow: see support/pages.c. */
void mpi_swap(const mpi_ranks *ranks, const uint64_t *const *out, const uint64_t *words, uint64_t *in,
              const uint64_t *there);
/** Collective: the sum of the ranks before this one. */
uint64_t mpi_sum_before(const mpi_ranks *ranks, uint64_t mine);
#endif
