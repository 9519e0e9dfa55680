/* bench.h: what the benches share: a clock, the head of a report, scenes and builds that must succeed. */
#ifndef FROE_BENCH_BENCH_H
#define FROE_BENCH_BENCH_H
#include <froe/io.h>

double bench_now(void); /**< seconds, monotonic */
double bench_cpu(void); /**< seconds that processors worked for this process */
/** Prints machine, compiler, commit and seed. */
void bench_head(const char *title, unsigned long long seed);
double bench_median(double *values, size_t count); /**< reorders them */
/** Splitmix64 (Steele, Lea and Flood 2014): the next number of a state, as a whole number or in [0, 1). */
uint64_t bench_draw(uint64_t *state);
uint64_t bench_state(uint64_t numbers); /**< after so many of them, from 0 */
double bench_unit(uint64_t *state);
/** These end the program with a message when froe refuses, or memory ends. */
void bench_must(froe_status status, const froe_diagnostic *diag); /**< diag may be NULL */
void *bench_take(size_t count, size_t size);                      /**< zeros, to be freed */
froe_scene *bench_read(const char *path);
froe_scene *bench_segments(const double *xyxy, size_t n);
/** A kind of froe_generate, or "scatter". */
froe_scene *bench_generate(const char *kind, size_t n, unsigned long long seed);
froe_tree *bench_build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf, unsigned threads,
                       double *seconds);
/** The same by another function: build_tuned() of src/build/options.h, for benches that link to froe_core. */
typedef froe_status bench_builder(froe_scene *, const froe_build_options *, froe_tree **, froe_diagnostic *);
froe_tree *bench_build_by(bench_builder *builder, froe_scene *scene, const char *method, const char *settings,
                          uint32_t leaf, unsigned threads, double *seconds);
/** n disjoint short segments in random order, 4 numbers each, to be freed. */
double *bench_scatter(size_t n, unsigned long long seed);
/** Least squares slope of log y against log x. */
double bench_exponent(const double *x, const double *y, size_t count);
/** File name without folder and ending, into 32 characters. */
void bench_name(const char *path, char name[32]);
#endif
