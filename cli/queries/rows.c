/* rows.c: headers, records and numbers. */
#include "queries/rows.h"
#include "exit.h"
#include "progress.h"
#include "support/decimal/decimal.h"
#include "support/fail.h"
#include "support/path.h"
#include "support/utf8.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ----------------------------------------------------------------- records -- */

/* Makes room for so many bytes, a NUL, and what numbers are read ahead. */
static bool make_room(char **text, size_t *capacity, size_t length) {
    enum { BEHIND = 1 + SUPPORT_DECIMAL_AHEAD };
    if (*capacity < length + BEHIND) {
        char *more = realloc(*text, 2 * length + BEHIND);
        if (!more) return errno = ENOMEM, false;
        *text = more;
        *capacity = 2 * length + BEHIND;
    }
    memset(*text + length, '\0', BEHIND);
    return true;
}

/* Where the first line has returns and no line feed, it is all of the file, whose lines end by returns alone, as on an
 * old Macintosh: it is read again with line feeds. False: no memory. */
static bool end_lines(cli_rows *rows, char **text, size_t *capacity, ssize_t *length) {
    const size_t size = (size_t)*length;
    if (!memchr(*text, '\r', size) || memchr(*text, '\n', size)) return true;
    FILE *again = fmemopen(NULL, size + 1, "w+");
    if (!again) return errno = ENOMEM, false;
    for (char *at = *text; (at = memchr(at, '\r', size - (size_t)(at - *text)));) *at = '\n';
    if (rows->file != stdin) fclose(rows->file);
    rows->file = again;
    if (fwrite(*text, 1, size, again) != size || fseek(again, 0, SEEK_SET)) return errno = ENOMEM, false;
    *length = getline(text, capacity, again);
    return *length >= 0;
}

/* Is the first line that of a file of another kind, such as a map: JSON, or with bytes that no text has? */
static bool is_foreign(const char *text, size_t length) {
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)text[i] < ' ' && !(text[i] >= '\t' && text[i] <= '\r')) return true;
    text += strncmp(text, "\xef\xbb\xbf", 3) ? 0 : 3;
    text += strspn(text, " \t");
    if (*text != '{') return false;
    text += 1 + strspn(text + 1, " \t\r\n");
    return !*text || *text == '"';
}

/* Reads a line with its end. False: there is none, not all of one, or no memory. */
static bool next_line(cli_rows *rows, char **text, size_t *capacity, size_t *length) {
    ssize_t got = getline(text, capacity, rows->file);
    if (got < 0 || ferror(rows->file) || (!rows->lines && !end_lines(rows, text, capacity, &got))) return false;
    rows->lines++;
    *length = (size_t)got;
    if (!make_room(text, capacity, *length)) return false;
    if (rows->lines == 1) rows->wide = support_is_utf16(*text, *length), rows->foreign = is_foreign(*text, *length);
    for (char *zero; (zero = memchr(*text, '\0', *length));) *zero = '?'; /* no text: it spoils its field */
    return true;
}

/* Was it a failure that ended the records? */
static bool stopped(const cli_rows *rows) {
    return ferror(rows->file) || errno == ENOMEM;
}

/* Reads a record without its end into rows->text: a line, and those behind it within quotation marks. False: there is
 * none, no memory, or no reading on. */
static bool next_record(cli_rows *rows) {
    size_t length, more;
    errno = 0;
    rows->line = rows->lines + 1;
    if (!next_line(rows, &rows->text, &rows->capacity, &length)) return false;
    if (rows->line == 1) {
        const size_t mark = strncmp(rows->text, "\xef\xbb\xbf", 3) ? 0 : 3;
        memmove(rows->text, rows->text + mark, length + 1 - mark);
        length -= mark;
        rows->separator = support_csv_separator(rows->text);
    }
    rows->open = memchr(rows->text, '"', length) && support_csv_goes_on(rows->text, rows->separator, false);
    while (rows->open && next_line(rows, &rows->more, &rows->room, &more)) {
        if (!make_room(&rows->text, &rows->capacity, length + more)) return false;
        memcpy(rows->text + length, rows->more, more);
        length += more;
        rows->open = support_csv_goes_on(rows->more, rows->separator, true);
    }
    if (rows->open && stopped(rows)) return false;
    while (length && (rows->text[length - 1] == '\n' || rows->text[length - 1] == '\r')) length--;
    rows->text[length] = '\0';
    return true;
}

static int fail_reading(const cli_rows *rows) {
    const unsigned long long line = rows->line;
    if (errno == EINTR && cli_interrupted()) return cli_fail_cancelled(rows->path);
    if (errno == ENOMEM) return cli_fail(CLI_RESOURCES, rows->path, "line %llu: Out of memory.", line);
    return cli_fail(CLI_INPUT, rows->path, "line %llu: The file cannot be read: %s.", line, support_errno(errno).text);
}

/* ------------------------------------------------------------------ header -- */

cli_axis cli_axis_name(const char *prefix, int axis) {
    cli_axis name;
    if (axis >= 4)
        snprintf(name.text, sizeof name.text, "%sx%d", prefix, axis + 1);
    else
        snprintf(name.text, sizeof name.text, "%s%c", prefix, "xyzw"[axis]);
    return name;
}

/* Which axis behind the prefix does it name in a family? -1: none. Only lo_ and the like stand before lon and lat. */
static int axis_behind(const char *name, const char *prefix, int family) {
    const size_t length = strlen(prefix);
    if (strncasecmp(name, prefix, length) != 0 || (family && length && prefix[length - 1] != '_')) return -1;
    return support_csv_axis(name + length, family, length > 0);
}

/* Which axis does it bound, as xmin does? -1: none, or it is not that end of boxes, lo_ or hi_, which the prefix
 * names. */
static int axis_bounded(const char *name, const char *prefix, int family) {
    bool high;
    const int axis = support_csv_bound(name, family, &high);
    return axis >= 0 && !strcmp(prefix, high ? "hi_" : "lo_") ? axis : -1;
}

/* Which number has this name? -1: none. *beyond: it names the axis behind the last. */
static int number_of(const cli_column *columns, int dim, int family, bool bounds, const char *name, bool *beyond) {
    int number = 0;
    for (; columns->name; columns++) {
        const int axis = !columns->axes ? -1
                         : bounds       ? axis_bounded(name, columns->name, family)
                                        : axis_behind(name, columns->name, family);
        if (axis >= 0 && axis < dim) return number + axis;
        if (!columns->axes && support_equal_nocase(name, columns->name)) return number;
        *beyond = *beyond || axis == dim;
        number += columns->axes ? dim : 1;
    }
    return -1;
}

/* "x,y,r": the header that was expected. Returns how many numbers it names. */
static size_t header_text(const cli_column *columns, int dim, char *out, size_t size) {
    size_t length = 0, count = 0;
    for (; columns->name; columns++)
        for (int axis = 0; axis < (columns->axes ? dim : 1); axis++, count++) {
            const cli_axis name = cli_axis_name(columns->name, axis);
            if (length < size) /* one way: the longest takes 8 dimensions */
                length += (size_t)snprintf(out + length, size - length, "%s%s", count ? "," : "",
                                           columns->axes ? name.text : columns->name);
        }
    return count;
}

/* Finds the columns, with axes of one family; false: some number has none, or two. *beyond: that of an axis that the
 * tree has not, which counts where all others are found. */
static bool find_columns(cli_rows *rows, const cli_column *columns, int dim, int family, bool bounds,
                         const char **beyond) {
    unsigned found = 0;
    *beyond = NULL;
    for (size_t i = 0; i < rows->columns; i++) {
        bool more = false;
        const int number = number_of(columns, dim, family, bounds, rows->names[i], &more);
        if (more && !*beyond) *beyond = rows->names[i];
        if (number >= 0 && found >> number & 1) return false;
        if (number >= 0) found |= 1u << number;
        rows->place[i] = (signed char)number;
    }
    return found == (1u << rows->numbers) - 1;
}

static int read_header(cli_rows *rows, const cli_column *columns, int dim) {
    char expected[200], names[400];
    const char *beyond, *first_beyond = NULL;
    rows->numbers = header_text(columns, dim, expected, sizeof expected);
    const bool there = next_record(rows);
    if (!there && stopped(rows)) return fail_reading(rows);
    if (rows->wide) return cli_fail(CLI_INPUT, rows->path, "%s", support_utf16_sentence);
    if (rows->foreign)
        return cli_fail(CLI_INPUT, rows->path, "The file is no table (CSV), whose header would name the columns %s.",
                        expected);
    if (there) {
        rows->header = rows->text;
        rows->text = NULL;
        rows->capacity = 0;
        char *at = rows->header;
        support_csv_field field = {.last = false};
        for (; !field.last && rows->columns < SUPPORT_CSV_COLUMNS; rows->columns++) {
            field = support_csv_next(&at, rows->separator);
            rows->names[rows->columns] = field.text;
        }
        if (!field.last)
            return cli_fail(CLI_INPUT, rows->path, "line 1: The header has more than %d columns.", SUPPORT_CSV_COLUMNS);
    }
    bool found = false;
    for (int i = 0; i < 2 * SUPPORT_CSV_FAMILIES && !found; i++) {
        rows->family = i % SUPPORT_CSV_FAMILIES;
        found = find_columns(rows, columns, dim, rows->family, i >= SUPPORT_CSV_FAMILIES, &beyond);
        if (!first_beyond || found) first_beyond = beyond;
    }
    if (first_beyond)
        return cli_fail(CLI_INPUT, rows->path, "line 1: The header names %.40s, and the tree has %d dimensions.",
                        first_beyond, dim);
    if (found) return 0;
    support_csv_names(names, sizeof names, rows->names, rows->columns);
    return cli_fail(CLI_INPUT, rows->path,
                    "line 1: The header must name the columns %s, each once, and it names %s. Axes are named "
                    "x,y,z or x1,x2,..., or lon,lat, or easting,northing.",
                    expected, *names ? names : "nothing");
}

int cli_rows_begin(FILE *file, const char *path, const cli_column *columns, int dim, cli_rows *out) {
    *out = (cli_rows){.path = path, .file = file};
    const int code = read_header(out, columns, dim);
    if (code) cli_rows_close(out);
    return code;
}

int cli_rows_open(const char *path, const cli_column *columns, int dim, cli_rows *out) {
    const bool standard = !strcmp(path, "-");
    FILE *file = standard ? stdin : fopen(path, "r");
    if (!file) return cli_fail_file(CLI_INPUT, path, "read");
    return cli_rows_begin(file, standard ? "standard input" : path, columns, dim, out);
}

void cli_rows_close(cli_rows *rows) {
    if (rows->file != stdin) fclose(rows->file);
    free(rows->header);
    free(rows->text);
    free(rows->more);
    *rows = (cli_rows){0};
}

/* -------------------------------------------------------------------- rows -- */

static bool read_numbers(cli_rows *rows, double *values) {
    char *at = rows->text;
    size_t column = 0;
    support_csv_field field = {.last = false};
    if (rows->open) {
        snprintf(rows->sentence, sizeof rows->sentence, "A quotation mark is not closed.");
        return false;
    }
    for (; !field.last && column < rows->columns; column++) {
        double *value = rows->place[column] < 0 ? NULL : &values[rows->place[column]];
        if (value && !rows->kept[column] && support_csv_plain(&at, rows->separator, value, &field.last)) continue;
        rows->fields[column] = field = support_csv_next(&at, rows->separator);
        if (!value) continue;
        if (support_csv_number(field.text, rows->separator, value)) {
            support_csv_point(field.text, rows->separator);
            continue;
        }
        if (*field.text)
            snprintf(rows->sentence, sizeof rows->sentence, "'%.40s' is not a number.", field.text);
        else
            snprintf(rows->sentence, sizeof rows->sentence, "Column %zu is empty.", column + 1);
        return false;
    }
    if (field.last && column == rows->columns) return true;
    if (field.last && column == rows->columns - 1 && !*rows->names[column]) { /* as GDAL's of one attribute end */
        rows->fields[column] = (support_csv_field){.text = at, .last = true};
        return true;
    }
    for (; !field.last; column++) field = support_csv_next(&at, rows->separator);
    snprintf(rows->sentence, sizeof rows->sentence, "The row has %zu column%s, and the header %zu.", column,
             support_plural(column), rows->columns);
    return false;
}

cli_row cli_rows_next(cli_rows *rows, double *values) {
    do {
        if (next_record(rows)) continue;
        if (!stopped(rows)) return CLI_ROWS_END;
        rows->code = fail_reading(rows);
        return CLI_ROWS_FAILED;
    } while (!rows->text[strspn(rows->text, " \t")]); /* blank lines are no rows */
    rows->row = rows->rows++;
    return read_numbers(rows, values) ? CLI_ROW_READ : CLI_ROW_BAD;
}
