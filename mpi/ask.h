/* ask.h: a file of questions, answered by all ranks */
#ifndef FROE_MPI_ASK_H
#define FROE_MPI_ASK_H
#include "query.h"

typedef struct mpi_asking {
    const char *folder, *input;
    mpi_query query;
} mpi_asking;

/** Collective. Writes on rank 0's standard output what a single process writes. Returns an exit code of cli/exit.h
 * after saying why. */
int mpi_ask(const mpi_ranks *ranks, const mpi_asking *asking);
#endif
