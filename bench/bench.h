/* bench.h: what the benches share: a clock, the head of a report, scenes and builds that must succeed. */
#ifndef FROE_BENCH_BENCH_H
#define FROE_BENCH_BENCH_H
#include <froe/io.h>

double bench_now(void); /**< seconds, monotonic */
double bench_cpu(void); /**< seconds that processors worked for this process */
/** Prints machine, compiler, commit and seed. */
void bench_head(const char *title, unsigned long long seed);
double bench_median(double *values, size_t count); /**< reorders them */
/** These end the program with a message when froe refuses. */
froe_scene *bench_read(const char *path);
froe_scene *bench_segments(const double *xyxy, size_t n);
/** A kind of froe_generate, or "scatter". */
froe_scene *bench_generate(const char *kind, size_t n, unsigned long long seed);
froe_tree *bench_build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf, unsigned threads,
                       double *seconds);
/** n disjoint short segments in random order, 4 numbers each, to be freed. */
double *bench_scatter(size_t n, unsigned long long seed);
/** Least squares slope of log y against log x. */
double bench_exponent(const double *x, const double *y, size_t count);
/** File name without folder and ending, into 32 characters. */
void bench_name(const char *path, char name[32]);
#endif
