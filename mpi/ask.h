/* ask.h: a file of questions, answered by all ranks */
#ifndef FROE_MPI_ASK_H
#define FROE_MPI_ASK_H
#include "cli/exit.h"
#include "query.h"

typedef struct mpi_asking {
    const char *folder, *input;
    const char *output; /**< NULL: standard output */
    mpi_query query;
} mpi_asking;

/** Collective. Writes what a single process writes, into a file or on rank 0's standard output. Returns an exit code of
 * cli/exit.h after saying why. */
int mpi_ask(const mpi_ranks *ranks, const mpi_asking *asking);
/** Collective. Rank 0 says why; returns the exit code on all ranks. */
int mpi_fail(const mpi_ranks *ranks, cli_stage stage, const froe_diagnostic *why);
#endif
