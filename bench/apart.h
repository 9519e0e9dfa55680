/* apart.h: a job in a process of its own, so that one that crashes or runs away costs a line and not the table. */
#ifndef FROE_BENCH_APART_H
#define FROE_BENCH_APART_H
#include <stdbool.h>
#include <stddef.h>

/** Fills `out`; false: it failed. */
typedef bool bench_job(const void *user, double *out);
/** Runs a job for at most `limit` seconds of processor time, in at most 8 GiB. NULL: `out`, `count`
 * numbers, is filled; otherwise what happened, in a few words. */
const char *bench_apart(bench_job *job, const void *user, unsigned limit, double *out, size_t count);
#endif
