/* rows.c: headers, fields and numbers. */
#include "queries/rows.h"
#include "exit.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { NAME = 32 };

/* ------------------------------------------------------------------ fields -- */

/* Reads a line without its end into rows->text. False: there is none. */
static bool next_line(cli_rows *rows) {
    ssize_t length = getline(&rows->text, &rows->capacity, rows->file);
    if (length < 0) return false;
    rows->line++;
    while (length && (rows->text[length - 1] == '\n' || rows->text[length - 1] == '\r')) length--;
    for (char *zero; (zero = memchr(rows->text, '\0', (size_t)length));) *zero = '?'; /* no text: it spoils its field */
    rows->text[length] = '\0';
    return true;
}

/* Ends the field at *at, trims it, moves *at to the next one or to NULL. */
static char *next_field(char **at, char separator) {
    char *field = *at + strspn(*at, " "), *end = strchr(field, separator);
    *at = end ? end + 1 : NULL;
    if (!end) end = field + strlen(field);
    while (end > field && strchr(" \t", end[-1])) end--;
    if (end > field + 1 && *field == '"' && end[-1] == '"') field++, end--;
    *end = '\0';
    return field;
}

/* ------------------------------------------------------------------ header -- */

/* As in scenes: x or x1, behind a prefix like lo_ also 1; in small letters or capitals. */
static bool names_axis(const char *name, const char *prefix, int axis) {
    char number[NAME];
    size_t length = strlen(prefix);
    if (strncasecmp(name, prefix, length) != 0) return false;
    name += length;
    if (axis < 4 && (name[0] | 0x20) == "xyzw"[axis] && !name[1]) return true;
    if ((name[0] | 0x20) != 'x' && !length) return false;
    snprintf(number, NAME, "%d", axis + 1);
    return !strcmp(name + ((name[0] | 0x20) == 'x'), number);
}

/* Which number has this name? -1: none. */
static int number_of(const cli_column *columns, int dim, const char *name) {
    int number = 0;
    for (; columns->name; columns++)
        for (int axis = 0; axis < (columns->axes ? dim : 1); axis++, number++)
            if (columns->axes ? names_axis(name, columns->name, axis) : !strcasecmp(name, columns->name)) return number;
    return -1;
}

/* "x,y,r": the header that was expected. Returns how many numbers it names. */
static size_t header_text(const cli_column *columns, int dim, char *out, size_t size) {
    size_t length = 0, count = 0;
    for (; columns->name; columns++)
        for (int axis = 0; axis < (columns->axes ? dim : 1); axis++, count++) {
            char name[NAME];
            if (!columns->axes)
                snprintf(name, NAME, "%s", columns->name);
            else if (axis >= 4)
                snprintf(name, NAME, "%sx%d", columns->name, axis + 1);
            else
                snprintf(name, NAME, "%s%c", columns->name, "xyzw"[axis]);
            if (length < size) length += (size_t)snprintf(out + length, size - length, "%s%s", count ? "," : "", name);
        }
    return count;
}

/* Finds the columns in the header line; false: some number has none, or two, or rows->sentence says what it is. */
static bool read_header(cli_rows *rows, const cli_column *columns, int dim) {
    unsigned found = 0;
    char *at = rows->text;
    if (!strncmp(at, "\xef\xbb\xbf", 3)) at += 3;
    rows->separator = strchr(at, ',') ? ',' : strchr(at, ';') ? ';' : '\t';
    for (rows->columns = 0; at; rows->columns++) {
        if (rows->columns == CLI_ROW_COLUMNS) return false;
        const char *name = next_field(&at, rows->separator);
        const int number = number_of(columns, dim, name);
        /* A column that holds the axis behind the last: rows are of another dimension than the tree. */
        for (const cli_column *c = columns; c->name && number < 0; c++)
            if (c->axes && names_axis(name, c->name, dim)) {
                snprintf(rows->sentence, sizeof rows->sentence,
                         "The header names %.40s, and the tree has %d dimensions.", name, dim);
                return false;
            }
        if (number >= 0 && found >> number & 1) return false;
        if (number >= 0) found |= 1u << number;
        rows->place[rows->columns] = (signed char)number;
    }
    return found == (1u << rows->numbers) - 1;
}

int cli_rows_open(const char *path, const cli_column *columns, int dim, cli_rows *out) {
    const bool standard = !strcmp(path, "-");
    char expected[200];
    *out = (cli_rows){.path = standard ? "standard input" : path};
    out->file = standard ? stdin : fopen(path, "r");
    if (!out->file) return cli_fail_file(CLI_INPUT, path, "read");
    out->numbers = header_text(columns, dim, expected, sizeof expected);
    int code = 0;
    if (!next_line(out))
        code = cli_fail(CLI_INPUT, out->path, "line 1: The header must name the columns %s, each once.", expected);
    else if (!read_header(out, columns, dim))
        code = out->sentence[0] ? cli_fail(CLI_INPUT, out->path, "line 1: %s", out->sentence)
                                : cli_fail(CLI_INPUT, out->path,
                                           "line 1: The header must name the columns %s, each once.", expected);
    if (code) cli_rows_close(out);
    return code;
}

void cli_rows_close(cli_rows *rows) {
    if (rows->file && rows->file != stdin) fclose(rows->file);
    free(rows->text);
    *rows = (cli_rows){0};
}

/* -------------------------------------------------------------------- rows -- */

static bool read_numbers(cli_rows *rows, double *values) {
    char *at = rows->text, *end;
    size_t column = 0;
    for (; at && column < rows->columns; column++) {
        const char *field = next_field(&at, rows->separator);
        if (rows->place[column] < 0) continue;
        values[rows->place[column]] = strtod(field, &end);
        if (end != field && !*end) continue;
        if (*field)
            snprintf(rows->sentence, sizeof rows->sentence, "'%.40s' is not a number.", field);
        else
            snprintf(rows->sentence, sizeof rows->sentence, "Column %zu is empty.", column + 1);
        return false;
    }
    if (!at && column == rows->columns) return true;
    while (at) next_field(&at, rows->separator), column++;
    snprintf(rows->sentence, sizeof rows->sentence, "The row has %zu columns, and the header %zu.", column,
             rows->columns);
    return false;
}

cli_row cli_rows_next(cli_rows *rows, double *values) {
    do {
        if (next_line(rows)) continue;
        if (!ferror(rows->file)) return CLI_ROWS_END;
        cli_fail(CLI_INPUT, rows->path, "line %llu: The file cannot be read: %s.", (unsigned long long)rows->line + 1,
                 strerror(errno));
        return CLI_ROWS_FAILED;
    } while (!rows->text[strspn(rows->text, " \t")]); /* blank lines are no rows */
    rows->row = rows->rows++;
    return read_numbers(rows, values) ? CLI_ROW_READ : CLI_ROW_BAD;
}
