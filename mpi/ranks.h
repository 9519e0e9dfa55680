/* ranks.h: what the ranks of a communicator agree on */
#ifndef FROE_MPI_RANKS_H
#define FROE_MPI_RANKS_H
#include <froe/mpi.h>

typedef struct mpi_ranks {
    MPI_Comm comm;
    int rank, count;
} mpi_ranks;
mpi_ranks mpi_ranks_of(MPI_Comm comm);

/** Collective: the status of the first rank that has failed, with its diagnostic, on all ranks. `diag` is needed. */
froe_status mpi_agree(const mpi_ranks *ranks, froe_status status, froe_diagnostic *diag);

/** Seconds that the calling rank has used so far. */
froe_mpi_cost mpi_now(void);
/** What has gone by since then. */
froe_mpi_cost mpi_since(froe_mpi_cost then);
/** Collective: the most of all ranks. */
froe_mpi_cost mpi_slowest(const mpi_ranks *ranks, froe_mpi_cost mine);
/** Collective: the sum of all ranks. */
uint64_t mpi_sum(const mpi_ranks *ranks, uint64_t mine);
#endif
