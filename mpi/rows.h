/* rows.h: a CSV of objects, of which each rank reads a part */
#ifndef FROE_MPI_ROWS_H
#define FROE_MPI_ROWS_H
#include "ranks.h"

/** Objects of rows, as the core's own reader gives them; false stops. `first`: the number of the first row in the whole
 * file, from 0. Without tags of their own, objects have none here. */
typedef bool mpi_rows_fn(void *user, const froe_objects *batch, uint64_t first);
/** Collective. Calls fn for the rows of this rank, some 10^4 at a time; the status is this rank's own. They are copied,
 * a part at a time, to a file .froe-*.csv in `folder`; *unwritten: it is such a copy that failed. A record is one line:
 * quotation marks are refused. FROE_E_IO, FROE_E_UNSUPPORTED, and the failures of froe_read_batches(), of which the
 * message says from which row on the part is. */
froe_status mpi_rows_read(const mpi_ranks *ranks, const char *path, const char *folder, mpi_rows_fn *fn, void *user,
                          bool *unwritten, froe_diagnostic *diag);
/** Part `part` of `parts` of a file, with the header in front of it: *count bytes, and a NUL. The caller frees it. A
 * record is one line. FROE_E_IO, FROE_E_MEMORY, FROE_E_UNSUPPORTED. */
froe_status mpi_rows_text(const char *path, uint64_t part, uint64_t parts, char **text, size_t *count,
                          froe_diagnostic *diag);
/** In how many parts a file is read that is cut into equal ones of at most so many bytes: a multiple of the ranks. */
uint64_t mpi_rows_parts(const mpi_ranks *ranks, const char *path, size_t bytes);
/** Collective. The dimension of the objects, by the header and the first row, which rank 0 copies to the folder for
 * temporary files; *unwritten there: it is that copy that failed. The status is agreed on. */
froe_status mpi_rows_dim(const mpi_ranks *ranks, const char *path, int *dim, bool *unwritten, froe_diagnostic *diag);
#endif
