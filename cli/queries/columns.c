/* columns.c: see columns.h. */
#include "queries/columns.h"
#include "args/options.h"
#include "exit.h"
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    cli_field field;
    bool second;
} fields[] = {
    {"query", CLI_FIELD_QUERY, false},       {"object", CLI_FIELD_OBJECT, false}, {"group", CLI_FIELD_GROUP, false},
    {"name", CLI_FIELD_NAME, false},         {"id", CLI_FIELD_ID, false},         {"t", CLI_FIELD_T, false},
    {"distance", CLI_FIELD_DISTANCE, false}, {"point", CLI_FIELD_POINT, false},   {"normal", CLI_FIELD_NORMAL, false},
    {"count", CLI_FIELD_COUNT, false},       {"a", CLI_FIELD_OBJECT, false},      {"a_group", CLI_FIELD_GROUP, false},
    {"a_name", CLI_FIELD_NAME, false},       {"a_id", CLI_FIELD_ID, false},       {"b", CLI_FIELD_OBJECT, true},
    {"b_group", CLI_FIELD_GROUP, true},      {"b_name", CLI_FIELD_NAME, true},    {"b_id", CLI_FIELD_ID, true},
    {"kind", CLI_FIELD_KIND, false},
};
enum { FIELDS = sizeof fields / sizeof *fields, NAMES = FIELDS + SUPPORT_CSV_COLUMNS, NONE = NAMES };

/* A column of the file that has the name of one of the command's is called so behind it: query_name. */
static const char prefix[] = "query_";
enum { LONGER = 24 }; /* bytes: the prefix, and a name of one of the command's columns */

typedef struct choice {
    const char *given, *known; /* on the command line, of the command */
    const cli_rows *rows;
    int dim;
    cli_columns *out;
} choice;

/* Is a name one of a list between commas? */
static bool is_listed(const char *list, const char *name) {
    const size_t length = strlen(name);
    for (; *list; list += strcspn(list, ","), list += *list == ',')
        if (strcspn(list, ",") == length && !strncmp(list, name, length)) return true;
    return false;
}

/* Which of fields[] the command has by this name; FIELDS: none. */
static size_t field_named(const choice *c, const char *name) {
    size_t i = 0;
    while (i < FIELDS && (strcmp(fields[i].name, name) != 0 || !is_listed(c->known, name))) i++;
    return i;
}

/* The column of the file; NONE: there is none. */
static size_t own_named(const choice *c, const char *name) {
    const size_t columns = c->rows ? c->rows->columns : 0;
    const bool behind = !strncmp(name, prefix, sizeof prefix - 1);
    for (int part = 0; part <= behind; part++)
        for (size_t i = 0; i < columns; i++)
            if (!strcmp(c->rows->names[i], name + (part ? sizeof prefix - 1 : 0))) return i;
    return NONE;
}

static bool is_shown(const cli_columns *out, const char *name) {
    for (size_t i = 0; i < out->count; i++)
        if (!strcmp(out->names[i], name)) return true;
    return false;
}

/* Is a name one that the command's columns have, or may have where they expand to axes? */
static bool is_taken(const choice *c, const char *name) {
    if (is_listed(c->known, name)) return true;
    for (int axis = 0; axis < c->dim; axis++)
        if ((is_listed(c->given, "point") && !strcmp(name, cli_axis_name("", axis).text)) ||
            (is_listed(c->given, "normal") && !strcmp(name, cli_axis_name("n", axis).text)))
            return true;
    return false;
}

/* ---------------------------------------------------------------- refusing -- */

static int refuse_shown(const choice *c, const char *name) {
    if (is_taken(c, name) && own_named(c, name) != NONE)
        return cli_fail(CLI_USE, NULL,
                        "--columns: The column '%s' is there twice. That of the file of queries is called %s%s.", name,
                        prefix, name);
    return cli_fail(CLI_USE, NULL, "--columns: The column '%s' is there twice.", name);
}

/* Of two columns with one name one would be lost. Those without a name are what spreadsheets leave behind the last. */
static int check_own(const choice *c, size_t at) {
    const char *name = c->rows->names[at];
    for (size_t i = 0; i < c->rows->columns && *name; i++)
        if (i != at && !strcmp(c->rows->names[i], name))
            return cli_fail(CLI_INPUT, c->rows->path, "line 1: The header names the column '%.40s' twice.", name);
    return 0;
}

/* ------------------------------------------------------------------ adding -- */

static int add_column(choice *c, cli_shown shown, const char *name) {
    cli_columns *out = c->out;
    if (is_shown(out, name)) return refuse_shown(c, name);
    char *text = strdup(name);
    cli_shown *more = realloc(out->shown, (out->count + 1) * sizeof *more);
    if (more) out->shown = more;
    const char **names = realloc(out->names, (out->count + 1) * sizeof *names);
    if (names) out->names = names;
    size_t *own = realloc(out->own, (out->own_count + 1) * sizeof *own);
    if (own) out->own = own;
    if (!text || !more || !names || !own) {
        free(text);
        return cli_fail_memory();
    }
    if (shown.field == CLI_FIELD_OWN) {
        out->own[out->own_count] = shown.at;
        shown.own = out->own_count++;
    }
    out->shown[out->count] = shown;
    out->names[out->count++] = text;
    return 0;
}

static int add_field(choice *c, size_t i) {
    const cli_field field = fields[i].field;
    const bool axes = field == CLI_FIELD_POINT || field == CLI_FIELD_NORMAL;
    int code = 0;
    for (int axis = 0; axis < (axes ? c->dim : 1) && !code; axis++) {
        const cli_axis name = cli_axis_name(field == CLI_FIELD_NORMAL ? "n" : "", axis);
        const cli_shown shown = {.field = field, .second = fields[i].second, .at = (size_t)axis};
        code = add_column(c, shown, axes ? name.text : fields[i].name);
    }
    return code;
}

/* All columns of the file, which there is, that are not there; of several without a name the first. */
static int add_rest(choice *c) {
    int code = 0;
    for (size_t i = 0; i < c->rows->columns && !code; i++) {
        const char *name = c->rows->names[i];
        char *longer = malloc(sizeof prefix + strlen(name));
        if (!longer) return cli_fail_memory();
        sprintf(longer, "%s%s", prefix, name);
        bool there = own_named(c, name) != i;
        for (size_t k = 0; k < c->out->own_count; k++) there = there || c->out->own[k] == i;
        code = check_own(c, i);
        if (!there && !code)
            code = add_column(c, (cli_shown){.field = CLI_FIELD_OWN, .at = i}, is_taken(c, name) ? longer : name);
        free(longer);
    }
    return code;
}

/* The columns of the file, each by the name that --columns takes. */
static void name_own(const choice *c, char longer[][LONGER], const char **names) {
    for (size_t i = 0; i < c->rows->columns; i++) {
        names[i] = c->rows->names[i];
        if (!is_taken(c, names[i])) continue;
        snprintf(longer[i], LONGER, "%s%s", prefix, names[i]);
        names[i] = longer[i];
    }
}

static int refuse_name(const choice *c, const char *name) {
    const char *names[NAMES];
    char longer[SUPPORT_CSV_COLUMNS][LONGER], known[200], own[400], sentence[800];
    size_t count = 0, columns = c->rows ? c->rows->columns : 0;
    for (size_t i = 0; i < FIELDS; i++)
        if (field_named(c, fields[i].name) == i) names[count++] = fields[i].name;
    support_csv_names(known, sizeof known, names, count);
    if (columns) {
        name_own(c, longer, names + count);
        support_csv_names(own, sizeof own, names + count, columns);
        snprintf(sentence, sizeof sentence, "There are %s, and of the file of queries %s.", known, own);
    } else {
        snprintf(sentence, sizeof sentence, "There are %s.", known);
    }
    return cli_fail_unknown("column", name, cli_nearest(name, names, count + columns), sentence);
}

static int add_named(choice *c, const char *name) {
    if (!strcmp(name, "*") && c->rows) return add_rest(c);
    const size_t field = field_named(c, name), own = own_named(c, name);
    if (field < FIELDS) return add_field(c, field);
    if (own == NONE) return refuse_name(c, name);
    const int code = check_own(c, own);
    return code ? code : add_column(c, (cli_shown){.field = CLI_FIELD_OWN, .at = own}, name);
}

int cli_columns_open(const char *given, const char *standard, const char *known, const cli_rows *rows, int dim,
                     cli_columns *out) {
    choice c = {.given = given ? given : standard, .known = known, .rows = rows, .dim = dim, .out = out};
    char *list = strdup(c.given), *at = list;
    int code = list ? 0 : cli_fail_memory();
    *out = (cli_columns){0};
    support_csv_field field = {.last = false};
    while (!code && !field.last) {
        field = support_csv_next(&at, ',');
        code = add_named(&c, field.text);
    }
    free(list);
    if (code) cli_columns_free(out);
    return code;
}

void cli_columns_free(cli_columns *columns) {
    for (size_t i = 0; i < columns->count; i++) free((char *)columns->names[i]);
    free(columns->names);
    free(columns->shown);
    free(columns->own);
    *columns = (cli_columns){0};
}

bool cli_columns_show(const cli_columns *columns, cli_field field) {
    for (size_t i = 0; i < columns->count; i++)
        if (columns->shown[i].field == field) return true;
    return false;
}
