/* plot.c: a table of numbers as a figure of markers, both axes logarithmic.
 *
 *     bench_plot SERIES X Y [TITLE] <table.csv >figure.svg
 *
 * SERIES, X and Y name columns of the CSV (no quotes, no blanks): what a row belongs to, and its numbers. */
#include "report/plot.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SERIES = 16, ROWS = 1000, LINE = 1000 };

typedef struct table {
    char names[SERIES][64];
    double x[SERIES][ROWS], y[SERIES][ROWS];
    size_t rows[SERIES], count;
} table;

static int fail(const char *what) {
    fprintf(stderr, "bench_plot: %s\n", what);
    return 1;
}

/* The field at `column` of a line, as its own text; false: there is none. */
static bool field(const char *line, size_t column, char out[64]) {
    for (; column; column--) {
        line = strchr(line, ',');
        if (!line) return false;
        line++;
    }
    snprintf(out, 64, "%.*s", (int)strcspn(line, ",\r\n"), line);
    return true;
}

static bool find_column(const char *heading, const char *name, size_t *out) {
    char text[64];
    for (*out = 0; field(heading, *out, text); ++*out)
        if (!strcmp(text, name)) return true;
    return false;
}

static bool add_row(table *t, const char *name, const char *x, const char *y) {
    size_t s = 0;
    while (s < t->count && strcmp(t->names[s], name) != 0) s++;
    if (s == SERIES || t->rows[s] == ROWS) return false;
    if (s == t->count) snprintf(t->names[t->count++], sizeof *t->names, "%s", name);
    t->x[s][t->rows[s]] = strtod(x, NULL);
    t->y[s][t->rows[s]++] = strtod(y, NULL);
    return true;
}

/* As people read it. */
static const char *label_of(char *column) {
    for (char *c = column; *c; c++)
        if (*c == '_') *c = ' ';
    return column;
}

static bool write_figure(const table *t, const char *title, const char *x, const char *y) {
    plot_series series[SERIES];
    plot_options o = plot_defaults();
    for (size_t s = 0; s < t->count; s++)
        series[s] = (plot_series){.name = t->names[s], .x = t->x[s], .y = t->y[s], .count = t->rows[s]};
    o.kind = PLOT_POINTS, o.log_x = o.log_y = true;
    o.title = title, o.x_label = x, o.y_label = y, o.width = 640, o.height = 380;
    plot_put(stdout, series, t->count, &o);
    return !fflush(stdout) && !ferror(stdout);
}

int main(int argc, char **argv) {
    static table t;
    char line[LINE], cells[3][64];
    size_t columns[3];
    if (argc < 4 || !fgets(line, sizeof line, stdin)) return fail("usage: bench_plot SERIES X Y [TITLE] <table.csv");
    for (int i = 0; i < 3; i++)
        if (!find_column(line, argv[1 + i], &columns[i])) return fail("there is no such column");
    while (fgets(line, sizeof line, stdin)) {
        for (int i = 0; i < 3; i++)
            if (!field(line, columns[i], cells[i])) return fail("a row is too short");
        if (!add_row(&t, cells[0], cells[1], cells[2])) return fail("too many rows");
    }
    return write_figure(&t, argc > 4 ? argv[4] : NULL, label_of(argv[2]), label_of(argv[3]))
               ? 0
               : fail("the figure was not written");
}
