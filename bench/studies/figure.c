/* figure.c: from a figure to a file. */
#include "figure.h"
#include <stdio.h>
#include <stdlib.h>

void bench_figure(const char *folder, const char *name, const plot_series *series, size_t count,
                  const plot_options *options) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (file) plot_put(file, series, count, options);
    if (!file || ferror(file) | fclose(file)) {
        fprintf(stderr, "bench: %s cannot be written\n", path);
        exit(1);
    }
}
