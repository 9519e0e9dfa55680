/* figures.c: from rows to series of numbers, as figures. */
#include "compare/figures.h"
#include "compare/field.h"
#include "report/plot.h"
#include <froe/froe.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From an item of a list to a point; false: none. */
typedef bool point_fn(const json_t *item, const char *key, double *x, double *y);

static bool plain(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "objects");
    *y = field_number(item, key);
    return *y > 0;
}

static bool per_object(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "objects");
    *y = field_number(item, key) / *x;
    return *y > 0;
}

static bool by_eps(const json_t *item, const char *key, double *x, double *y) {
    const double eps = field_number(item, "eps");
    *x = 1 / eps;
    *y = field_number(item, key);
    return eps > 0 && *y > 0;
}

static bool load(const json_t *item, const char *key, double *x, double *y) {
    *x = field_number(item, "load");
    *y = field_number(item, key);
    return true;
}

/* A list of the row itself or of its queries. */
static const json_t *items_of(const json_t *row, const char *list) {
    const json_t *items = json_object_get(row, list);
    return items ? items : json_object_get(json_object_get(row, "queries"), list);
}

/* A figure has one series for each method there is, so that a method has the same colour in all figures of a page; most
 * have points. A figure without points is left out. */
static bool put_figure(FILE *out, const json_t *rows, const char *list, point_fn *fn, const char *key,
                       const plot_options *options) {
    size_t methods = 0, room = 0, count = 0, points = 0, i;
    json_t *row;
    while (froe_method_at(methods)) methods++;
    json_array_foreach((json_t *)rows, i, row) room += json_array_size(items_of(row, list));
    plot_series *series = calloc(methods + 1, sizeof *series);
    double *numbers = calloc(2 * room + 1, sizeof *numbers), *x = numbers;
    const bool ok = series && numbers;
    for (size_t m = 0; ok && m < methods; m++) {
        const char *name = froe_method_at(m)->name;
        const json_t *of = field_row(rows, name), *items = items_of(of, list);
        if (!of && options->kind == PLOT_COLUMNS) continue; /* columns stand side by side */
        double *y = x + json_array_size(items);
        plot_series *s = &series[count++];
        *s = (plot_series){json_string_value(json_object_get(of, "method")), x, y, 0};
        json_t *item;
        json_array_foreach((json_t *)items, i, item) s->count += fn(item, key, x + s->count, y + s->count);
        points += s->count;
        x = y + json_array_size(items);
    }
    if (points) {
        fputs("<figure>", out);
        plot_put(out, series, count, options);
        fputs("</figure>\n", out);
    }
    free(series);
    free(numbers);
    return ok;
}

bool figures_put(FILE *out, const json_t *rows) {
    static const struct {
        const char *list, *key, *title, *y;
        point_fn *fn;
    } figures[] = {
        {"growth", "fragments", "Pieces per object", "pieces", per_object},
        {"growth", "size", "Size of the tree per object", "nodes and list entries", per_object},
        {"growth", "height", "Height of the tree", "cuts on the longest way", plain},
        {"growth", "seconds", "Time to build", "seconds", plain},
        {"by_eps", "nodes", "Nodes that a rough window visits", "nodes", by_eps},
        {"by_eps", "microseconds", "Time that a rough window takes", "microseconds", by_eps},
    };
    plot_options o = plot_defaults();
    bool ok = true;
    o.log_x = o.log_y = true, o.width = 540;
    fputs("<div class=\"grid plots\">\n", out);
    for (size_t i = 0; i < sizeof figures / sizeof *figures && ok; i++) {
        o.title = figures[i].title, o.y_label = figures[i].y;
        o.x_label =
            figures[i].fn == by_eps ? "1 / eps: how exact it is" : "objects, from the middle of the scene outwards";
        ok = put_figure(out, rows, figures[i].list, figures[i].fn, figures[i].key, &o);
    }
    fputs("</div>\n", out);
    return ok;
}

bool figures_put_loads(FILE *out, const json_t *rows) {
    bool ok = true;
    size_t i;
    json_t *row;
    fputs("<details><summary>How full the leaves are</summary>\n<div class=\"grid small\">\n", out);
    json_array_foreach((json_t *)rows, i, row) { /* a small figure for each method */
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
    fputs("</div>\n</details>\n", out);
    return ok;
}
