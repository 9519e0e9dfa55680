/* ranks.c: see ranks.h. */
#include "ranks.h"
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

mpi_ranks mpi_ranks_of(MPI_Comm comm) {
    mpi_ranks r = {.comm = comm};
    MPI_Comm_rank(comm, &r.rank);
    MPI_Comm_size(comm, &r.count);
    return r;
}

static froe_mpi_cost used_by_now(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    const double seconds = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
    const double micros = (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    return (froe_mpi_cost){MPI_Wtime(), seconds + 1e-6 * micros, 0};
}

static void add_since(froe_mpi_cost *sum, froe_mpi_cost then, froe_mpi_cost now) {
    sum->wall += now.wall - then.wall;
    sum->processor += now.processor - then.processor;
}

froe_status mpi_agree(const mpi_ranks *ranks, froe_status status, froe_diagnostic *diag) {
    const froe_mpi_cost then = used_by_now();
    const int mine = status ? ranks->rank : ranks->count;
    int first = ranks->count;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, ranks->comm);
    if (ranks->waited) add_since(ranks->waited, then, used_by_now());
    if (first == ranks->count) return FROE_OK;
    if (status) diag->status = status; /* also where nobody wrote a sentence */
    MPI_Bcast(diag, (int)sizeof *diag, MPI_BYTE, first, ranks->comm);
    return diag->status;
}

void mpi_wait(const mpi_ranks *ranks) {
    const froe_mpi_cost then = used_by_now();
    MPI_Barrier(ranks->comm);
    if (ranks->waited) add_since(ranks->waited, then, used_by_now());
}

froe_mpi_cost mpi_now(const mpi_ranks *ranks) {
    froe_mpi_cost now = used_by_now();
    if (ranks->waited) now.wall -= ranks->waited->wall, now.processor -= ranks->waited->processor;
    return now;
}

void mpi_count(const mpi_ranks *ranks, froe_mpi_cost *sum, froe_mpi_cost then) {
    add_since(sum, then, mpi_now(ranks));
}

froe_mpi_cost mpi_slowest(const mpi_ranks *ranks, froe_mpi_cost mine) {
    const double own[2] = {mine.wall, mine.processor};
    double most[2] = {0};
    froe_mpi_cost cost = {0};
    MPI_Allreduce(own, most, 2, MPI_DOUBLE, MPI_MAX, ranks->comm);
    MPI_Allreduce(&mine.processor, &cost.all, 1, MPI_DOUBLE, MPI_SUM, ranks->comm);
    cost.wall = most[0], cost.processor = most[1];
    return cost;
}

void mpi_print_cost(const char *what, froe_mpi_cost cost) {
    fprintf(stderr, "%-9s %9.3f s %9.3f s of processors %9.3f s of all\n", what, cost.wall, cost.processor, cost.all);
}

uint64_t mpi_sum(const mpi_ranks *ranks, uint64_t mine) {
    uint64_t sum = 0;
    MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, ranks->comm);
    return sum;
}

uint64_t mpi_sum_before(const mpi_ranks *ranks, uint64_t mine) {
    uint64_t sum = 0;
    MPI_Exscan(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, ranks->comm);
    return ranks->rank ? sum : 0; /* which MPI leaves undefined */
}

/* -------------------------------------------------------------------- words -- */

void mpi_tell_counts(const mpi_ranks *ranks, const uint64_t *words, uint64_t *there) {
    MPI_Alltoall(words, 1, MPI_UINT64_T, there, 1, MPI_UINT64_T, ranks->comm);
}

/* Sends words to a rank while it receives words from another one, in pieces that an int counts. */
static void swap_two(const mpi_ranks *ranks, int to, const uint64_t *out, uint64_t words, int from, uint64_t *in,
                     uint64_t there) {
    const uint64_t most = UINT64_C(1) << 30;
    for (uint64_t at = 0; at < words || at < there; at += most) {
        const uint64_t going = at < words ? words - at : 0, coming = at < there ? there - at : 0;
        MPI_Sendrecv(going ? out + at : NULL, (int)(going < most ? going : most), MPI_UINT64_T,
                     going ? to : MPI_PROC_NULL, 0, coming ? in + at : NULL, (int)(coming < most ? coming : most),
                     MPI_UINT64_T, coming ? from : MPI_PROC_NULL, 0, ranks->comm, MPI_STATUS_IGNORE);
    }
}

void mpi_swap(const mpi_ranks *ranks, const uint64_t *const *out, const uint64_t *words, uint64_t *in,
              const uint64_t *there) {
    const int count = ranks->count, rank = ranks->rank;
    for (int step = 0; step < count; step++) {
        const int to = (rank + step) % count, from = (rank - step + count) % count;
        uint64_t *place = in;
        for (int r = 0; r < from; r++) place += there[r];
        if (step)
            swap_two(ranks, to, out[to], words[to], from, place, there[from]);
        else if (words[to])
            memcpy(place, out[to], words[to] * sizeof *place);
    }
}
