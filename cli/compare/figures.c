/* figures.c: from rows to series of numbers, as figures. */
#include "compare/figures.h"
#include "compare/field.h"
#include "report/plot.h"
#include <froe/froe.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The series of one figure: one for each method there is, so that a method has the same colour in all figures of a
 * page; most have points. */
typedef struct figure {
    plot_series *series;
    double *numbers; /* all coordinates */
    size_t count, used;
} figure;

static size_t points_of(const json_t *rows, const char *list) {
    size_t points = 0, i;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        const json_t *items = json_object_get(row, list);
        points += json_array_size(items ? items : json_object_get(json_object_get(row, "queries"), list));
    }
    return points;
}

static bool begin(figure *f, const json_t *rows, const char *list) {
    *f = (figure){.count = 0};
    size_t methods = 0;
    while (froe_method_at(methods)) methods++;
    f->series = calloc(methods + 1, sizeof *f->series);
    f->numbers = calloc(2 * points_of(rows, list) + 1, sizeof *f->numbers);
    return f->series && f->numbers;
}

static void end(figure *f) {
    free(f->series);
    free(f->numbers);
}

/* From an item of a list to a point; false: none. */
typedef bool point_fn(const json_t *item, const char *key, double *x, double *y);

static void add_series(figure *f, const json_t *row, const json_t *items, point_fn *fn, const char *key) {
    double *x = f->numbers + f->used, *y = x + json_array_size(items);
    size_t i, count = 0;
    json_t *item;
    json_array_foreach((json_t *)items, i, item) count += fn(item, key, x + count, y + count);
    f->used += 2 * json_array_size(items);
    f->series[f->count++] = (plot_series){json_string_value(json_object_get(row, "method")), x, y, count};
}

static bool has_points(const figure *f) {
    size_t points = 0;
    for (size_t i = 0; i < f->count; i++) points += f->series[i].count;
    return points > 0;
}

static bool put_figure(FILE *out, const json_t *rows, const char *list, point_fn *fn, const char *key,
                       const plot_options *options) {
    figure f;
    bool ok = begin(&f, rows, list);
    const froe_method_info *method;
    for (size_t i = 0; ok && (method = froe_method_at(i)) != NULL; i++) {
        const json_t *row = field_row(rows, method->name), *items = json_object_get(row, list);
        if (row || options->kind != PLOT_COLUMNS) /* columns stand side by side */
            add_series(&f, row, items ? items : json_object_get(json_object_get(row, "queries"), list), fn, key);
    }
    if (ok && has_points(&f)) {
        fputs("<figure>", out);
        plot_put(out, f.series, f.count, options);
        fputs("</figure>\n", out);
    }
    end(&f);
    return ok;
}

/* ------------------------------------------------------------------- growth -- */

static bool per_object(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "objects");
    *y = field_number(item, key) / *x;
    return *y > 0;
}

static bool plain(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "objects");
    *y = field_number(item, key);
    return *y > 0;
}

static bool put_growth(FILE *out, const json_t *rows) {
    plot_options o = plot_defaults();
    o.x_label = "objects n, from the middle outwards", o.log_x = o.log_y = true;
    o.title = "Size against n", o.y_label = "nodes and list entries";
    bool ok = put_figure(out, rows, "growth", plain, "size", &o);
    o.title = "Pieces per object", o.y_label = "pieces / n";
    ok = ok && put_figure(out, rows, "growth", per_object, "fragments", &o);
    o.title = "Height", o.y_label = "edges on the longest path";
    ok = ok && put_figure(out, rows, "growth", plain, "height", &o);
    o.title = "Time to build", o.y_label = "seconds";
    return ok && put_figure(out, rows, "growth", plain, "seconds", &o);
}

/* ---------------------------------------------------------------------- eps -- */

static bool by_eps(const json_t *item, const char *key, double *x, double *y) {
    const double eps = field_number(item, "eps");
    *x = 1 / eps;
    *y = field_number(item, key);
    return eps > 0 && *y > 0;
}

static bool put_eps(FILE *out, const json_t *rows) {
    plot_options o = plot_defaults();
    o.x_label = "1 / eps", o.log_x = o.log_y = true;
    o.title = "Cost against 1 / eps", o.y_label = "nodes visited a query";
    bool ok = put_figure(out, rows, "by_eps", by_eps, "nodes", &o);
    o.title = "Time against 1 / eps", o.y_label = "microseconds a query";
    return ok && put_figure(out, rows, "by_eps", by_eps, "microseconds", &o);
}

/* -------------------------------------------------------------------- loads -- */

static bool load(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "load");
    *y = field_number(item, key);
    return true;
}

/* A small figure for each method. */
static bool put_loads(FILE *out, const json_t *rows) {
    bool ok = true;
    size_t i;
    json_t *row;
    fputs("<h3>Loads of leaves</h3>\n<div class=\"plots small\">\n", out);
    json_array_foreach((json_t *)rows, i, row) {
        const json_t *bins = json_object_get(row, "leaf_loads");
        if (!bins || !ok) continue;
        plot_options o = plot_defaults();
        o.kind = PLOT_COLUMNS, o.width = 260, o.height = 170;
        o.title = json_string_value(json_object_get(row, "method"));
        o.x_label = "pieces in a leaf", o.y_label = "leaves";
        const double step =
            field_number(json_array_get(bins, 1), "load") - field_number(json_array_get(bins, 0), "load");
        o.column = step > 0 ? 0.8 * step : 0.8;
        json_t *one = json_pack("[O]", row);
        ok = one && put_figure(out, one, "leaf_loads", load, "leaves", &o);
        json_decref(one);
    }
    fputs("</div>\n", out);
    return ok;
}

bool figures_put(FILE *out, const json_t *rows) {
    fputs("<div class=\"plots\">\n", out);
    const bool ok = put_growth(out, rows) && put_eps(out, rows);
    fputs("</div>\n", out);
    return ok && put_loads(out, rows);
}
