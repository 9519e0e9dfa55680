/* workers.c: forks for a call, and the sum of their statistics. */
#include "query/workers.h"
#include "support/fail.h"

void froe_batch_defaults_into(froe_batch_options *out, size_t size) {
    const froe_batch_options all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

froe_status query_workers_refuse(froe_diagnostic *diag) {
    return support_fail_defaults(diag, "froe_batch_defaults");
}

froe_status query_workers_take(froe_query *query, const froe_batch_options *options, size_t jobs, query_workers *out,
                               froe_diagnostic *diag) {
    static const froe_batch_options defaults = {.size = sizeof defaults};
    const froe_batch_options *o = options ? options : &defaults;
    *out = (query_workers){0};
    if (o->size != sizeof *o) return query_workers_refuse(diag);
    base_task_init(&out->task, o->threads, o->progress, o->user);
    if (out->task.threads > jobs) out->task.threads = jobs ? (unsigned)jobs : 1;
    out->queries = support_calloc(&query->alloc, out->task.threads, sizeof *out->queries);
    if (!out->queries) return support_fail_memory(diag);
    out->queries[0] = query;
    for (out->count = 1; out->count < out->task.threads; out->count++)
        if (froe_query_fork(query, &out->queries[out->count], NULL)) return support_fail_memory(diag);
    return FROE_OK;
}

void query_workers_give(query_workers *workers) {
    if (!workers->queries) return;
    froe_query *query = workers->queries[0];
    for (unsigned i = 1; i < workers->count; i++) {
        const froe_query_stats *more = &workers->queries[i]->stats;
        query->stats.queries += more->queries;
        query->stats.nodes += more->nodes;
        query->stats.leaves += more->leaves;
        query->stats.steps += more->steps;
        query->stats.tests += more->tests;
        query->stats.exact += more->exact;
        query->stats.slices += more->slices;
        froe_query_free(workers->queries[i]);
    }
    support_free(&query->alloc, workers->queries, workers->task.threads * sizeof *workers->queries);
}
