/* moments.c: a program like froe-mpi in which something happens at a moment that a test names.
 *
 *     FROE_MOMENT="RANK FUNCTION NUMBER COMMAND"   before a rank calls a function for the NUMBER-th time, it runs a
 *                                                  command of the shell, whose parent process, $PPID, is the rank
 *     FROE_DIMENSION="RANK DIMENSION"              a rank begins a folder of another dimension than the others
 *     FROE_NO_LOCKS=1                              flock() fails, as where the file system has no locks
 *
 * The linker leads calls of the functions below here (--wrap, cmake/FroeMpi.cmake). */
#define _DEFAULT_SOURCE 1 /* flock */
#include "mpi/rows.h"
#include <errno.h>
#include <froe/shard_parts.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/types.h>

static void meet_moment(const char *function, unsigned number) {
    const char *moment = getenv("FROE_MOMENT");
    char name[64];
    int rank, of, command;
    unsigned at;
    if (!moment || sscanf(moment, "%d %63s %u %n", &of, name, &at, &command) != 3) return;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == of && number == at && !strcmp(name, function) && system(moment + command)) abort();
}

#define MOMENT(type, name, parameters, arguments)                                                                      \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters {                                                                                    \
        static unsigned calls;                                                                                         \
        meet_moment(#name, ++calls);                                                                                   \
        return __real_##name arguments;                                                                                \
    }

MOMENT(froe_status, mpi_rows_read,
       (const mpi_ranks *ranks, const char *path, const char *folder, mpi_rows_fn *fn, void *user, bool *unwritten,
        froe_diagnostic *diag),
       (ranks, path, folder, fn, user, unwritten, diag))
MOMENT(froe_status, froe_shard_records_add,
       (froe_shard_records * records, int dim, const froe_objects *batch, uint64_t first, froe_diagnostic *diag),
       (records, dim, batch, first, diag))
MOMENT(froe_status, froe_shard_plan_new,
       (froe_shard_sample * sample, uint32_t shards, uint64_t memory, froe_shard_plan **out, froe_diagnostic *diag),
       (sample, shards, memory, out, diag))
MOMENT(froe_status, froe_shard_build,
       (froe_shard_records * records, const froe_shard_plan *plan, uint32_t cell, const froe_scene *scene,
        const froe_shards_options *options, const char *folder, froe_shard_entry *out, froe_diagnostic *diag),
       (records, plan, cell, scene, options, folder, out, diag))
MOMENT(froe_status, froe_shard_draft_sync, (const char *folder, uint32_t part, uint32_t parts, froe_diagnostic *diag),
       (folder, part, parts, diag))
MOMENT(froe_status, froe_shard_draft_place, (froe_shard_draft * draft, bool *replaced, froe_diagnostic *diag),
       (draft, replaced, diag))
MOMENT(froe_status, froe_shards_boxes,
       (froe_shards * shards, const double *boxes, size_t count, const froe_batch_options *options, froe_finds *out,
        froe_diagnostic *diag),
       (shards, boxes, count, options, out, diag))
MOMENT(ssize_t, pwrite, (int file, const void *bytes, size_t count, off_t place), (file, bytes, count, place))

froe_status __real_froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                                  froe_mpi_builder **out, froe_diagnostic *diag);
froe_status __wrap_froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                                  froe_mpi_builder **out, froe_diagnostic *diag);
froe_status __wrap_froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                                  froe_mpi_builder **out, froe_diagnostic *diag) {
    const char *words = getenv("FROE_DIMENSION");
    int rank, of, other;
    MPI_Comm_rank(comm, &rank);
    if (words && sscanf(words, "%d %d", &of, &other) == 2 && rank == of) dim = other;
    return __real_froe_mpi_begin(comm, path, dim, options, out, diag);
}

int __real_flock(int file, int how);
int __wrap_flock(int file, int how);
int __wrap_flock(int file, int how) {
    if (!getenv("FROE_NO_LOCKS")) return __real_flock(file, how);
    errno = ENOSYS;
    return -1;
}
