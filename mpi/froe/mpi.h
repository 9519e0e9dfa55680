/* mpi.h: folders of shards built and asked by the processes of an MPI program.
 *
 *     froe_mpi_builder *builder;
 *     froe_mpi_begin(MPI_COMM_WORLD, "planet.froes", 2, NULL, &builder, &diag);
 *     froe_mpi_add(builder, &my_part, my_first, &diag);         // any number of times, each rank its own objects
 *     froe_mpi_finish(builder, &report, &costs, &diag);
 *
 *     froe_mpi_open(MPI_COMM_WORLD, "planet.froes", &folder, &diag);
 *     froe_shards_boxes(froe_mpi_shards(folder), my_windows, my_count, NULL, &my_finds, &diag);
 *     froe_mpi_close(folder);
 *
 * The folder is that of froe/shards.h, the same bytes for any number of ranks: a shard is built and asked by its
 * froe_shard_owner(). All ranks see the same file system. A call that is named collective is made by all ranks of the
 * communicator, with the same arguments where nothing else is said; all of them return the same status and diagnostic,
 * those of the first rank that has failed. Failures of MPI itself end the program, as MPI does by default; the folder
 * that was there before stays then, too. */
#ifndef FROE_MPI_H
#define FROE_MPI_H
#include <froe/shards.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a step took on the rank that was slowest: seconds by the clock on the wall, and of processors. Waiting for
 * other ranks is not in it. */
typedef struct froe_mpi_cost {
    double wall, processor;
    double all; /**< seconds of processors of all ranks together */
} froe_mpi_cost;

/** Between froe_mpi_begin() and froe_mpi_finish(); while objects find their owners; while trees are built and saved;
 * and while ranks waited for others at the ends of these, where work was not equal. */
typedef struct froe_mpi_costs {
    froe_mpi_cost read, exchange, build, wait;
    uint64_t sent; /**< bytes of objects that left their rank, of all ranks */
} froe_mpi_costs;

/** A rank's part in a folder that is being built. */
typedef struct froe_mpi_builder froe_mpi_builder;

/** Collective. Begins the folder `path`, as froe_shards_begin() does. Of options, threads count for each rank; progress
 * and alloc are ignored. FROE_E_ARG: not all ranks give the same dimension. */
froe_status froe_mpi_begin(MPI_Comm comm, const char *path, int dim, const froe_shards_options *options,
                           froe_mpi_builder **out, froe_diagnostic *diag);
/** The folder in which the new one grows; lives as long as the builder. Files of the names .froe-* may be put there,
 * and go away with it, also when a killed program left it. */
const char *froe_mpi_draft(const froe_mpi_builder *builder);
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

/* --------------------------------------------------------------------- ask -- */

/** A folder of which each rank has opened the shards that it owns, and no other. */
typedef struct froe_mpi_folder froe_mpi_folder;
/** Collective. Opens a folder, and this rank's shards of it. FROE_E_IO, FROE_E_FORMAT, FROE_E_MEMORY. */
froe_status froe_mpi_open(MPI_Comm comm, const char *path, froe_mpi_folder **out, froe_diagnostic *diag);
void froe_mpi_close(froe_mpi_folder *folder);
/** For the questions of froe/shards.h. Each is now a collective call, with questions of each rank's own, perhaps none,
 * and the same other arguments; each rank gets the answers to its own questions, those of a single process. A bad
 * question is a failure of the rank that has it alone. So are failures behind the last exchange of a call, which ranks
 * have to tell each other. Memory: for each question and each answer 64 bytes, about. */
froe_shards *froe_mpi_shards(froe_mpi_folder *folder);

/** What this rank has spent so far, in seconds of its own: opening; questions and answers on their way; waiting for
 * others in between. */
typedef struct froe_mpi_spent {
    froe_mpi_cost open, exchange, wait;
} froe_mpi_spent;
froe_mpi_spent froe_mpi_spent_on(const froe_mpi_folder *folder);

#ifdef __cplusplus
}
#endif
#endif
