/* figure.h: figures of what benches measure, drawn by froe itself. */
#ifndef FROE_BENCH_FIGURE_H
#define FROE_BENCH_FIGURE_H
#include "report/plot.h"

/** Writes FOLDER/NAME, or says that it cannot and exits with 1. */
void bench_figure(const char *folder, const char *name, const plot_series *series, size_t count,
                  const plot_options *options);
#endif
