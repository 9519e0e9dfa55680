/* figure.h: figures of what benches measure, drawn by froe itself. */
#ifndef FROE_BENCH_FIGURE_H
#define FROE_BENCH_FIGURE_H
#include <froe/plot.h>

/** Writes FOLDER/NAME, or says that it cannot and exits with 1. */
void bench_figure(const char *folder, const char *name, const froe_plot_series *series, size_t count,
                  const froe_plot_options *options);
#endif
