/* output.h: where the answers of all ranks go: a file, each rank at its own place, or standard output, by rank 0.
 *
 *     rank 0        |  rank 1      |  rank 2   |  rank 0       |  ...      the file
 *     one call of mpi_output_put() ............|  the next one
 *
 * A file grows beside its place as .NAME.writing, and is brought there when all is written (support/writer.h). */
#ifndef FROE_MPI_OUTPUT_H
#define FROE_MPI_OUTPUT_H
#include "ranks.h"
#include "support/writer.h"

typedef struct mpi_output {
    const mpi_ranks *ranks;
    const char *path;      /**< NULL: standard output */
    support_writer writer; /**< rank 0's */
    bool writing;          /**< it is open */
    int file;              /**< this rank's descriptor of the file; -1: rank 0 writes for all */
    uint64_t length;       /**< so far */
} mpi_output;
/** Collective. path NULL: standard output. FROE_E_IO, FROE_E_MEMORY; then there is nothing to be closed. */
froe_status mpi_output_open(const mpi_ranks *ranks, const char *path, mpi_output *out, froe_diagnostic *diag);
/** Collective. Appends the text of each rank, in the order of the ranks. A failure is agreed on: FROE_E_IO. */
froe_status mpi_output_put(mpi_output *output, const char *text, size_t count, froe_diagnostic *diag);
/** Collective, with a status that all have agreed on. With FROE_OK: brings the file to its place. Otherwise the old one
 * stays, and nothing else. Returns `status`, or FROE_E_IO. */
froe_status mpi_output_close(mpi_output *output, froe_status status, froe_diagnostic *diag);
#endif
