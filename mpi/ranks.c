/* ranks.c: see ranks.h. */
#include "ranks.h"
#include <sys/resource.h>

mpi_ranks mpi_ranks_of(MPI_Comm comm) {
    mpi_ranks r = {.comm = comm};
    MPI_Comm_rank(comm, &r.rank);
    MPI_Comm_size(comm, &r.count);
    return r;
}

froe_status mpi_agree(const mpi_ranks *ranks, froe_status status, froe_diagnostic *diag) {
    const int mine = status ? ranks->rank : ranks->count;
    int first = ranks->count;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, ranks->comm);
    if (first == ranks->count) return FROE_OK;
    MPI_Bcast(diag, (int)sizeof *diag, MPI_BYTE, first, ranks->comm);
    return diag->status;
}

froe_mpi_cost mpi_now(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (froe_mpi_cost){MPI_Wtime(), (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                                            1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec)};
}

froe_mpi_cost mpi_since(froe_mpi_cost then) {
    const froe_mpi_cost now = mpi_now();
    return (froe_mpi_cost){now.wall - then.wall, now.processor - then.processor};
}

froe_mpi_cost mpi_slowest(const mpi_ranks *ranks, froe_mpi_cost mine) {
    froe_mpi_cost most = {0};
    MPI_Allreduce(&mine, &most, 2, MPI_DOUBLE, MPI_MAX, ranks->comm);
    return most;
}

uint64_t mpi_sum(const mpi_ranks *ranks, uint64_t mine) {
    uint64_t sum = 0;
    MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, ranks->comm);
    return sum;
}
