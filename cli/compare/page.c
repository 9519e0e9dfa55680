/* page.c: the comparison as one page: what each scene is like, plots, tables, pictures of cells, and, folded away,
 * promises and loads of leaves. Everything is within the file: no scripts, no network. */
#include "compare/page.h"
#include "compare/field.h"
#include "compare/figures.h"
#include "compare/table.h"
#include "report/html.h"
#include <math.h>
#include <string.h>

static const html_field measures[] = {
    {"objects", "objects"},
    {"clutter at least",
     "clutter factor, at least<br><small>objects in a cube without a corner of their boxes</small>"},
    {"density at least", "density, at least<br><small>objects at a ball that are as large as it</small>"},
    {"density at most", "density, at most"},
    {"fatness median", "fatness, the median<br><small>volume over that of the smallest ball around it</small>"},
    {"directional 95 %", "directional density, of 95 %<br><small>boxes that cross the plane of a face near it</small>"},
    {0}};

/* -------------------------------------------------------------------- tables -- */

/* The least number of the column; it is marked, unless it is that of most rows. NaN: there is none. */
static double best_of(const json_t *rows, const table_column *column) {
    double best = INFINITY;
    size_t i, count = 0;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        json_t *value = table_value(row, column);
        const double number = json_is_number(value) ? json_number_value(value) : INFINITY;
        count = number < best ? 1 : count + (number == best);
        best = fmin(best, number);
        json_decref(value);
    }
    return 2 * count <= json_array_size(rows) ? best : NAN;
}

static void put_cell(FILE *out, const table_column *column, json_t *value, double best) {
    const bool is_best = json_is_number(value) && json_number_value(value) == best;
    if (json_is_number(value) && column->times > 0) {
        json_t *scaled = json_real(json_number_value(value) * column->times);
        json_decref(value);
        value = scaled;
    }
    fputs(is_best ? "<td class=\"best\">" : !*column->unit ? "<td class=\"text\">" : "<td>", out);
    html_value(out, value);
    fputs("</td>", out);
    json_decref(value);
}

static void put_meanings(FILE *out, const json_t *rows, table_part part) {
    const char *separator = "<p class=\"soft\">";
    for (const table_column *c = table_columns; c->name; c++) {
        if (c->part != part || !c->meaning || !table_column_used(rows, c)) continue;
        fprintf(out, "%s<b>%s</b>: %s", separator, c->title, c->meaning);
        separator = c->meaning[strlen(c->meaning) - 1] == '?' ? " " : ". ";
    }
    fprintf(out, "%sThe least of a column is bold.</p>\n", separator);
}

static void put_table(FILE *out, const json_t *rows, table_part part) {
    size_t i;
    json_t *row;
    fputs("<div class=\"card\"><div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\"><b>Method</b></th>", out);
    for (const table_column *c = table_columns; c->name; c++)
        if (c->part == part && table_column_used(rows, c))
            fprintf(out, "<th scope=\"col\"%s><b>%s</b>%s</th>", *c->unit ? "" : " class=\"text\"", c->title, c->unit);
    fputs("</tr></thead>\n<tbody>\n", out);
    json_array_foreach((json_t *)rows, i, row) {
        if (part == TABLE_QUERY && !field_is_built(row)) continue;
        fputs("<tr><th scope=\"row\">", out);
        html_text(out, json_string_value(json_object_get(row, "method")));
        fputs("</th>", out);
        for (const table_column *c = table_columns; c->name; c++)
            if (c->part == part && table_column_used(rows, c)) put_cell(out, c, table_value(row, c), best_of(rows, c));
        fputs("</tr>\n", out);
    }
    fputs("</tbody>\n</table></div>\n", out);
    put_meanings(out, rows, part);
    fputs("</div>\n", out);
}

static void put_choices(FILE *out, const json_t *choices) {
    const char *purpose;
    json_t *choice;
    fputs("<p>The method <code>auto</code> takes ", out);
    const char *separator = "";
    json_object_foreach((json_t *)choices, purpose, choice) {
        const json_t *ratio = json_object_get(choice, "ratio");
        fprintf(out, "%s<b>%s</b> for %s", separator, json_string_value(json_object_get(choice, "auto")),
                strcmp(purpose, "draw") == 0    ? "pictures"
                : strcmp(purpose, "query") == 0 ? "queries"
                                                : purpose);
        separator = ", ";
        if (json_is_null(ratio))
            fputs(" (not compared)", out);
        else if (json_number_value(ratio) <= 1)
            fputs(" (the best)", out);
        else
            fprintf(out, " (the best is %s, %.3g times as good)", json_string_value(json_object_get(choice, "best")),
                    json_number_value(ratio));
    }
    fputs(".</p>\n", out);
}

/* ------------------------------------------------------------------ pictures -- */

static void put_picture(FILE *out, const json_t *of, const char *of_what, const char *name, bool captioned) {
    const char *picture = json_string_value(json_object_get(of, "picture"));
    if (!picture) return;
    fprintf(out, "<figure><div class=\"sheet\"><img alt=\"%s ", of_what);
    html_text(out, name);
    fprintf(out, "\" src=\"data:image/png;base64,%s\"></div>", picture);
    if (captioned) html_element(out, "figcaption", name);
    fputs("</figure>\n", out);
}

static void put_cells(FILE *out, const json_t *rows) {
    size_t i;
    json_t *row;
    bool any = false; /* a tree above dimension 3 has none, nor has a method that failed */
    json_array_foreach((json_t *)rows, i, row) any = any || json_is_string(json_object_get(row, "picture"));
    if (!any) return;
    fputs("<h3>The cells of each tree</h3>\n<p class=\"soft\">Darker cells lie deeper in the tree.</p>\n"
          "<div class=\"grid small\">\n",
          out);
    json_array_foreach((json_t *)rows, i, row) {
        const char *method = json_string_value(json_object_get(row, "method"));
        put_picture(out, row, "Cells of the tree by", method, true);
    }
    fputs("</div>\n", out);
}

/* -------------------------------------------------------------------- scenes -- */

static void put_promises(FILE *out, const json_t *rows) {
    size_t i;
    json_t *row;
    fputs("<details><summary>What the methods promise, and what came out</summary>\n<div class=\"grid\">\n", out);
    json_array_foreach((json_t *)rows, i, row) {
        const json_t *bounds = json_object_get(row, "bounds");
        if (!json_object_size(bounds)) continue;
        fputs("<div class=\"card\">", out);
        html_element(out, "h3", json_string_value(json_object_get(row, "method")));
        html_bounds(out, bounds);
        fputs("</div>\n", out);
    }
    fputs("</div>\n</details>\n", out);
}

static bool put_scene(FILE *out, const json_t *scene) {
    const json_t *rows = json_object_get(scene, "methods");
    const char *name = field_scene(scene);
    fputs("<section>\n", out);
    html_element(out, "h2", name);
    put_choices(out, json_object_get(scene, "auto"));
    fputs("<div class=\"grid\">\n", out);
    put_picture(out, scene, "The scene", name, false);
    fputs("<div class=\"card\"><h3>What the scene is like</h3>\n", out);
    html_pairs(out, json_object_get(scene, "measures"), measures);
    fputs("</div>\n</div>\n", out);
    bool whole = figures_put(out, rows);
    fputs("<h3>The trees</h3>\n", out);
    put_table(out, rows, TABLE_TREE);
    if (table_part_used(rows, TABLE_QUERY)) {
        fputs("<h3>What a query visits, and how long it takes</h3>\n", out);
        put_table(out, rows, TABLE_QUERY);
    }
    put_cells(out, rows);
    put_promises(out, rows);
    whole = figures_put_loads(out, rows) && whole;
    fputs("</section>\n", out);
    return whole;
}

bool page_put(FILE *out, const void *user) {
    static const html_field sums[] = {{"scenes", "scenes compared"},
                                      {"best", "auto is the best"},
                                      {"within_10_percent", "auto is within 10 % of the best"},
                                      {"failed", "auto fails"},
                                      {"worst_ratio", "auto over the best, at worst"},
                                      {0}};
    const json_t *comparison = user;
    size_t i;
    const char *purpose;
    json_t *scene, *sum;
    bool whole = true;
    html_begin(out, "froe compare", "compare.css");
    fputs("<header>\n<h1>Which method suits which scene?</h1>\n<p class=\"lead\">Every method that serves a scene "
          "builds a tree of it, and all trees are asked the same questions.</p>\n</header>\n<main>\n",
          out);
    json_array_foreach(json_object_get(comparison, "scenes"), i, scene) whole = put_scene(out, scene) && whole;
    fputs("<section>\n<h2>How well auto chose</h2>\n<div class=\"grid\">\n", out);
    json_object_foreach(json_object_get(comparison, "auto"), purpose, sum) {
        fprintf(out, "<div class=\"card\"><h3><code>--for %s</code></h3>\n", purpose);
        html_pairs(out, sum, sums);
        fputs("</div>\n", out);
    }
    fputs("</div>\n</section>\n", out);
    html_end(out);
    return whole;
}
