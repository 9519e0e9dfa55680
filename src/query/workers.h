/* workers.h: several contexts for one call: the caller's own and forks of it, one a thread.
 *
 * It speaks for workers.c and batch.c, the public calls with many questions. */
#ifndef FROE_QUERY_WORKERS_H
#define FROE_QUERY_WORKERS_H
#include "base/task.h"
#include "query/context.h"

typedef struct query_workers {
    base_task task;
    froe_query **queries; /**< [task.threads]; the first is the caller's */
    unsigned count;
} query_workers;

/** For at most `jobs` jobs at a time. FROE_E_OPTIONS, FROE_E_MEMORY; query_workers_give() gives back what was taken. */
froe_status query_workers_take(froe_query *query, const froe_batch_options *options, size_t jobs, query_workers *out,
                               froe_diagnostic *diag);
/** The failure for options that froe_batch_defaults() has not made: FROE_E_OPTIONS. */
froe_status query_workers_refuse(froe_diagnostic *diag);
/** Adds the statistics of the forks to the caller's, and frees the forks. */
void query_workers_give(query_workers *workers);
#endif
