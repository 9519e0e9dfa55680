/* exchange.h: every object goes to the ranks that own a shard whose cell its box meets */
#ifndef FROE_MPI_EXCHANGE_H
#define FROE_MPI_EXCHANGE_H
#include "ranks.h"
#include <froe/shard_parts.h>

/** Collective. Empties bucket 0 of `spool`, sends its records to their owners, and puts what arrives into those of
 * `buckets`, a bucket for each shard, that this rank owns. *sent: bytes that went to other ranks. On failure of one
 * rank all stop at once, and `diag`, which is needed, tells of this rank's own; mpi_agree() must follow. */
froe_status mpi_exchange(const mpi_ranks *ranks, const froe_shard_plan *plan, froe_shard_buckets *spool,
                         froe_shard_buckets *buckets, uint64_t *sent, froe_diagnostic *diag);
#endif
