/* table.c: the comparison as a table. */
#include "compare/table.h"
#include "compare/field.h"
#include "report/report.h"
#include <math.h>
#include <string.h>

const table_column table_columns[] = {
    {"pieces/n", "/fragments", 3, TABLE_TREE, "Pieces", "per object", 0, "how many pieces the cuts make of an object"},
    {"size/n", "/size", 3, TABLE_TREE, "Size", "entries per object", 0, "nodes, and entries of their lists"},
    {"height", "height", 0, TABLE_TREE, "Height", "cuts", 0, "the most cuts on the way to a leaf"},
    {"depth", "mean_depth", 3, TABLE_TREE, "Depth", "cuts", 0, "the mean over all pieces"},
    {"fullest", "max_leaf", 0, TABLE_TREE, "Fullest leaf", "pieces", 0, "a leaf is a cell that is not cut further"},
    {"bytes/n", "/bytes", 3, TABLE_TREE, "Memory", "bytes per object", 0, "of the tree, without the scene"},
    {"peak/n", "/peak_bytes", 3, TABLE_TREE, "Peak", "bytes per object", 0, "the most memory in use while building"},
    {"build s", "seconds.build", 3, TABLE_TREE, "Build", "ms", 1000, "time by the clock on the wall"},
    {"kept", "?kept", 0, TABLE_TREE, "Kept", "promises", 0, "the bounds that the method promises, and that hold"},
    {"note", "note", 0, TABLE_TREE, "Note", "", 0, NULL},
    {"point", "queries.point.nodes", 3, TABLE_QUERY, "Point", "nodes", 0, "what contains a point?"},
    {"point us", "queries.point.microseconds", 3, TABLE_QUERY, "Point", "&micro;s", 0, NULL},
    {"window", "queries.window.nodes", 3, TABLE_QUERY, "Window", "nodes", 0, "what meets a box?"},
    {"window us", "queries.window.microseconds", 3, TABLE_QUERY, "Window", "&micro;s", 0, NULL},
    {"ray", "queries.ray.nodes", 3, TABLE_QUERY, "Ray", "nodes", 0, "what does a ray hit first?"},
    {"ray us", "queries.ray.microseconds", 3, TABLE_QUERY, "Ray", "&micro;s", 0, NULL},
    {"approx", "queries.approximate.nodes", 3, TABLE_QUERY, "Rough window", "nodes", 0,
     "what meets a box, and perhaps what is nearer to it than an eighth of its diameter?"},
    {"approx us", "queries.approximate.microseconds", 3, TABLE_QUERY, "Rough window", "&micro;s", 0, NULL},
    {0}};

/* "a.b.c" from the row. */
static const json_t *find(const json_t *row, const char *path) {
    char key[64];
    while (row && *path) {
        const size_t length = strcspn(path, ".");
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        row = json_object_get(row, key);
        path += length + (path[length] == '.');
    }
    return row;
}

/* "2 of 3" promises hold. */
static json_t *kept_json(const json_t *row) {
    const json_t *bounds = json_object_get(row, "bounds");
    const char *name;
    json_t *bound;
    int kept = 0;
    if (!json_object_size(bounds)) return json_null();
    json_object_foreach((json_t *)bounds, name, bound) {
        (void)name;
        kept += json_number_value(json_object_get(bound, "measured")) <=
                json_number_value(json_object_get(bound, "promised"));
    }
    return json_sprintf("%d of %d", kept, (int)json_object_size(bounds));
}

json_t *table_value(const json_t *row, const table_column *column) {
    if (strcmp(column->path, "?kept") == 0) return kept_json(row);
    const bool each = *column->path == '/';
    const json_t *value = find(row, column->path + each);
    if (!value || json_is_null(value)) return json_null();
    if (!json_is_number(value)) return json_incref((json_t *)value);
    const double n = json_number_value(json_object_get(row, "objects"));
    const double number = json_number_value(value) / (each ? n : 1);
    if (!column->digits || number == 0) return json_real(number);
    const double unit = pow(10, floor(log10(fabs(number))) - column->digits + 1);
    return json_real(unit >= 1 ? round(number / unit) * unit : round(number / unit) / round(1 / unit));
}

bool table_column_used(const json_t *rows, const table_column *column) {
    bool found = false;
    size_t i;
    json_t *row;
    json_array_foreach((json_t *)rows, i, row) {
        json_t *value = table_value(row, column);
        found = found || (json_is_number(value) || json_string_length(value));
        json_decref(value);
    }
    return found;
}

bool table_part_used(const json_t *rows, table_part part) {
    bool used = false;
    for (const table_column *c = table_columns; c->name; c++)
        used = used || (c->part == part && table_column_used(rows, c));
    return used;
}

/* Rows that failed come last, so that the first one tells which columns hold numbers; they are rows of trees only.
 * Empty where no row fills a column of the part. */
static json_t *rows_report(const json_t *rows, table_part part) {
    json_t *table = json_array();
    if (!table_part_used(rows, part)) return table;
    for (int built = 1; built >= (part == TABLE_TREE ? 0 : 1); built--) {
        size_t i;
        json_t *row;
        json_array_foreach((json_t *)rows, i, row) {
            if (field_is_built(row) != built) continue;
            json_t *cells = json_pack("{s:O}", "method", json_object_get(row, "method"));
            for (const table_column *c = table_columns; c->name; c++)
                if (c->part == part && table_column_used(rows, c))
                    json_object_set_new(cells, c->name, table_value(row, c));
            json_array_append_new(table, cells);
        }
    }
    return table;
}

/* Each promise beside what came out. */
static json_t *promises_report(const json_t *rows) {
    json_t *table = json_array();
    size_t i;
    json_t *row, *bound;
    json_array_foreach((json_t *)rows, i, row) {
        const char *name;
        json_object_foreach(json_object_get(row, "bounds"), name, bound) {
            json_t *line = json_pack("{s:O, s:s}", "method", json_object_get(row, "method"), "promises", name);
            json_object_set_new(line, "at most", table_value(bound, &(table_column){.path = "promised", .digits = 4}));
            json_object_set_new(line, "is", table_value(bound, &(table_column){.path = "measured", .digits = 4}));
            json_array_append_new(table, line);
        }
    }
    return table;
}

json_t *table_report(const json_t *comparison) {
    static const char *const names[] = {"trees", "queries", "promises"};
    json_t *out = json_object(), *choices = json_array();
    const json_t *scenes = json_object_get(comparison, "scenes");
    size_t i;
    json_t *scene, *choice;
    json_array_foreach((json_t *)scenes, i, scene) { /* what it is like, and the tables of its methods */
        json_t *report = json_copy(json_object_get(scene, "measures"));
        const json_t *rows = json_object_get(scene, "methods");
        json_t *const tables[] = {rows_report(rows, TABLE_TREE), rows_report(rows, TABLE_QUERY), promises_report(rows)};
        for (int k = 0; k < 3; k++) {
            if (json_array_size(tables[k])) json_object_set(report, names[k], tables[k]);
            json_decref(tables[k]);
        }
        json_object_set_new(out, json_string_value(json_object_get(scene, "scene")), report);
        const char *purpose;
        json_object_foreach(json_object_get(scene, "auto"), purpose, choice) {
            json_t *row = json_pack("{s:O, s:s}", "scene", json_object_get(scene, "scene"), "for", purpose);
            json_object_update(row, choice);
            json_object_set_new(row, "ratio", table_value(choice, &(table_column){.path = "ratio", .digits = 3}));
            json_array_append_new(choices, row);
        }
    }
    json_object_set_new(out, "what auto chose", choices);
    json_object_set(out, "auto in all", json_object_get(comparison, "auto"));
    return out;
}

/* ---------------------------------------------------------------------- CSV -- */

static const char *const csv_paths[] = {
    "method", "status", "objects",    "dim",      "leaf",        "nodes",   "leaves", "fragments",  "pieces_per_object",
    "size",   "height", "mean_depth", "max_leaf", "inseparable", "crowded", "bytes",  "peak_bytes", "seconds.build",
    NULL};
static const char *const csv_kinds[] = {"point", "window", "ray", "approximate", NULL};
static const char *const csv_costs[] = {"nodes", "nodes_p99", "leaves", "tests", "found", "microseconds", NULL};

/* Text as RFC 4180 has it. */
static void put_csv_text(FILE *out, const char *text) {
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, out);
        return;
    }
    fputc('"', out);
    for (; *text; text++) fprintf(out, *text == '"' ? "\"\"" : "%c", *text);
    fputc('"', out);
}

static void put_cell(FILE *out, const json_t *value) {
    char number[32];
    if (json_is_number(value)) cli_number(number, json_number_value(value)), fputs(number, out);
    if (json_is_string(value)) put_csv_text(out, json_string_value(value));
    fputc(',', out);
}

static void put_csv_row(FILE *out, const json_t *scene, const json_t *row, json_t *promises) {
    const char *name;
    json_t *ignored;
    put_csv_text(out, field_scene(scene));
    fputc(',', out);
    for (int i = 0; csv_paths[i]; i++) put_cell(out, find(row, csv_paths[i]));
    for (int k = 0; csv_kinds[k]; k++)
        for (int c = 0; csv_costs[c]; c++) {
            char path[64];
            snprintf(path, sizeof path, "queries.%s.%s", csv_kinds[k], csv_costs[c]);
            put_cell(out, find(row, path));
        }
    json_object_foreach(promises, name, ignored) {
        const json_t *bound = json_object_get(json_object_get(row, "bounds"), name);
        put_cell(out, json_object_get(bound, "promised"));
        put_cell(out, json_object_get(bound, "measured"));
    }
    json_t *kept = kept_json(row);
    put_cell(out, kept);
    json_decref(kept);
    put_csv_text(out, json_string_value(json_object_get(row, "note")));
    fputc('\n', out);
}

bool table_put_csv(FILE *out, const void *user) {
    const json_t *scenes = json_object_get((const json_t *)user, "scenes");
    size_t i, j;
    const char *name;
    json_t *scene, *row, *bound, *promises = json_object(); /* names of all promises of all methods, as keys */
    json_array_foreach((json_t *)scenes, i, scene) json_array_foreach(json_object_get(scene, "methods"), j, row)
        json_object_foreach(json_object_get(row, "bounds"), name, bound) json_object_set(promises, name, json_true());
    fputs("scene,", out);
    for (int k = 0; csv_paths[k]; k++) fprintf(out, "%s,", csv_paths[k]);
    for (int k = 0; csv_kinds[k]; k++)
        for (int c = 0; csv_costs[c]; c++) fprintf(out, "%s.%s,", csv_kinds[k], csv_costs[c]);
    json_object_foreach(promises, name, bound) fprintf(out, "%s.promised,%s.measured,", name, name);
    fputs("promises_kept,note\n", out);
    json_array_foreach((json_t *)scenes, i, scene) json_array_foreach(json_object_get(scene, "methods"), j, row)
        put_csv_row(out, scene, row, promises);
    json_decref(promises);
    return true;
}
