/* mpi.h: folders of shards built by the processes of an MPI program.
 *
 *     froe_mpi_builder *builder;
 *     froe_mpi_begin(MPI_COMM_WORLD, "planet.froes", 2, NULL, &builder, &diag);
 *     froe_mpi_add(builder, &my_part, my_first, &diag);         // any number of times, each rank its own objects
 *     froe_mpi_finish(builder, &report, &costs, &diag);
 *
 * The folder is that of froe/shards.h, the same bytes for any number of ranks: shard s is built by rank s modulo their
 * number. All ranks see the same file system. A call that is named collective is made by all ranks of the communicator,
 * with the same arguments where nothing else is said; all of them return the same status and diagnostic, those of the
 * first rank that has failed. Failures of MPI itself end the program, as MPI does by default; the folder that was there
 * before stays then, too. */
#ifndef FROE_MPI_H
#define FROE_MPI_H
#include <froe/shards.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a step took on the rank that was slowest: seconds by the clock on the wall, and of processors. */
typedef struct froe_mpi_cost {
    double wall, processor;
} froe_mpi_cost;

/** Between froe_mpi_begin() and froe_mpi_finish(); while objects find their owners; while trees are built and saved. */
typedef struct froe_mpi_costs {
    froe_mpi_cost read, exchange, build;
    uint64_t sent; /**< bytes of objects that left their rank, of all ranks */
} froe_mpi_costs;

/** A rank's part in a folder that is being built. */
typedef struct froe_mpi_builder froe_mpi_builder;

/** Collective. Begins the folder `path`, as froe_shards_begin() does. Of options, threads count for each rank; progress
 * and alloc are ignored. */
froe_status froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                           froe_mpi_builder **out, froe_diagnostic *diag);
/** Adds objects of this rank, to a file without name beside the folder. Objects without tags have the tags first,
 * first + 1, ...: let `first` be the number of the first in the whole input. A failure is returned by
 * froe_mpi_finish() on all ranks, too, and further calls return it. Statuses as of froe_shards_add(). */
froe_status froe_mpi_add(froe_mpi_builder *builder, const froe_objects *batch, uint64_t first, froe_diagnostic *diag);
/** Lets the builder fail with a status of the caller's own, such as a file that cannot be read. */
void froe_mpi_fail(froe_mpi_builder *builder, const froe_diagnostic *why);
/** Collective. Sends each object to the owners of the shards that it belongs to, builds them, and puts the folder into
 * its place; frees the builder whatever comes out. report and costs may be NULL, and are the same on all ranks.
 * Memory: that of building one shard, and 64 MB. Statuses as of froe_shards_finish(). */
froe_status froe_mpi_finish(froe_mpi_builder *builder, froe_shards_report *report, froe_mpi_costs *costs,
                            froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
