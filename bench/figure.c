/* figure.c: from a figure to a file. */
#include "figure.h"
#include <stdio.h>
#include <stdlib.h>

static bool to_file(void *user, const void *data, size_t size) {
    return fwrite(data, 1, size, user) == size;
}

void bench_figure(const char *folder, const char *name, const froe_plot_series *series, size_t count,
                  const froe_plot_options *options) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file || froe_plot_write(series, count, to_file, file, options, NULL) || fclose(file)) {
        fprintf(stderr, "bench: %s cannot be written\n", path);
        exit(1);
    }
}
