/* page.c: scenes, tables, promises, figures and pictures of cells, all within one file: no scripts, no network. */
#include "compare/page.h"
#include "compare/figures.h"
#include "compare/table.h"
#include "report/html.h"
#include <string.h>

static const char *const measure_keys[] = {
    "objects", "clutter at least", "density at least", "density at most", "fatness median", "directional 95 %", NULL};

/* -------------------------------------------------------------------- tables -- */

static void put_cell(FILE *out, const char *tag, const json_t *value) {
    fprintf(out, json_is_number(value) ? "<%s class=\"number\">" : "<%s>", tag);
    html_value(out, value);
    fprintf(out, "</%s>", tag);
}

static void put_methods(FILE *out, const json_t *rows) {
    size_t i;
    json_t *row;
    fputs("<div class=\"card wide\"><table class=\"methods\">\n<tr><th>method</th>", out);
    for (const table_column *c = table_columns; c->name; c++) fprintf(out, "<th>%s</th>", c->name);
    fputs("</tr>\n", out);
    json_array_foreach((json_t *)rows, i, row) {
        fputs("<tr>", out);
        put_cell(out, "th", json_object_get(row, "method"));
        for (const table_column *c = table_columns; c->name; c++) {
            json_t *value = table_value(row, c);
            put_cell(out, "td", value);
            json_decref(value);
        }
        fputs("</tr>\n", out);
    }
    fputs("</table></div>\n", out);
}

static void put_choices(FILE *out, const json_t *choices) {
    const char *purpose;
    json_t *choice;
    fputs("<p class=\"choice\">auto takes ", out);
    const char *separator = "";
    json_object_foreach((json_t *)choices, purpose, choice) {
        const json_t *ratio = json_object_get(choice, "ratio");
        fprintf(out, "%s<b>%s</b> for %s", separator, json_string_value(json_object_get(choice, "auto")), purpose);
        separator = ", ";
        if (json_is_null(ratio))
            fputs(" (not compared)", out);
        else if (json_number_value(ratio) <= 1)
            fputs(" (the best)", out);
        else
            fprintf(out, " (best: %s, %.3g times as good)", json_string_value(json_object_get(choice, "best")),
                    json_number_value(ratio));
    }
    fputs(".</p>\n", out);
}

/* ------------------------------------------------------------------ pictures -- */

static void put_picture(FILE *out, const json_t *of, const char *alt, const char *caption) {
    const char *picture = json_string_value(json_object_get(of, "picture"));
    if (!picture) return;
    fprintf(out, "<figure><img alt=\"%s\" src=\"data:image/png;base64,%s\"><figcaption>%s</figcaption></figure>\n", alt,
            picture, caption);
}

/* -------------------------------------------------------------------- scenes -- */

static void put_scene(FILE *out, const json_t *scene) {
    const json_t *rows = json_object_get(scene, "methods");
    size_t i;
    json_t *row;
    fputs("<section>\n<h2>", out);
    html_text(out, json_string_value(json_object_get(scene, "scene")));
    fputs("</h2>\n<div class=\"cards\"><div class=\"card scene\"><h3>What the scene is like</h3>\n", out);
    html_pairs(out, json_object_get(scene, "measures"), measure_keys);
    fputs("</div>\n", out);
    put_picture(out, scene, "the scene", "");
    fputs("</div>\n", out);
    put_choices(out, json_object_get(scene, "auto"));
    put_methods(out, rows);
    if (!figures_put(out, rows)) fputs("<p>There was no memory for figures.</p>\n", out);
    fputs("<h3>What methods promise, and what came out</h3>\n<div class=\"cards\">\n", out);
    json_array_foreach((json_t *)rows, i, row) {
        const json_t *bounds = json_object_get(row, "bounds");
        if (!json_object_size(bounds)) continue;
        fputs("<div class=\"card promise\"><h3>", out);
        html_text(out, json_string_value(json_object_get(row, "method")));
        fputs("</h3>\n", out);
        html_bounds(out, bounds);
        fputs("</div>\n", out);
    }
    fputs("</div>\n", out);
    if (json_is_string(json_object_get(json_array_get(rows, 0), "picture"))) {
        fputs("<h3>Cells, dark where the tree is deep, and the scene in ink</h3>\n<div class=\"plots small\">\n", out);
        json_array_foreach((json_t *)rows, i, row) {
            const char *method = json_string_value(json_object_get(row, "method"));
            put_picture(out, row, method, method);
        }
        fputs("</div>\n", out);
    }
    fputs("</section>\n", out);
}

void page_put(FILE *out, const void *user) {
    static const char *const sum_keys[] = {"scenes", "best", "within_10_percent", "failed", "worst_ratio", NULL};
    const json_t *comparison = user;
    size_t i;
    const char *purpose;
    json_t *scene, *sum;
    html_begin(out, "froe compare", "compare.css");
    fputs("<header>\n<h1>froe compare</h1>\n<p>Partitions of the same scenes by every method that serves them. Numbers "
          "of "
          "nodes are means over queries near objects; kept: promises of the method that hold.</p>\n</header>\n<main>\n",
          out);
    json_array_foreach(json_object_get(comparison, "scenes"), i, scene) put_scene(out, scene);
    fputs("<section>\n<h2>How well auto chose</h2>\n<div class=\"cards\">\n", out);
    json_object_foreach(json_object_get(comparison, "auto"), purpose, sum) {
        fprintf(out, "<div class=\"card\"><h3>--for %s</h3>\n", purpose);
        html_pairs(out, sum, sum_keys);
        fputs("</div>\n", out);
    }
    fputs("</div>\n</section>\n", out);
    html_end(out);
}
