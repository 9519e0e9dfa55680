/* report.c: prints JSON objects, as JSON and as text. The walk descends as deep as
 * a report is nested, which the commands fix (three levels), not their input. */
#include "report/report.h"
#include "exit.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static bool json_refused; /* jansson has one allocator for all, without a place for the caller's data */

static void *allocate(size_t size) {
    void *block = malloc(size);
    if (!block) json_refused = true;
    return block;
}

void cli_report_begin(void) {
    json_set_alloc_funcs(allocate, free);
}

json_t *cli_report_lose(void) {
    json_refused = true;
    return json_null();
}

bool cli_report_short(void) {
    return json_refused;
}

static bool is_whole(double value) {
    return value > -1e15 && value < 1e15 && value == (double)(json_int_t)value;
}

void cli_number(char *text, double value) {
    if (is_whole(value)) {
        snprintf(text, 32, "%" JSON_INTEGER_FORMAT, (json_int_t)value);
        return;
    }
    for (int digits = 1; digits <= 17; digits++) { /* one way: 17 tell each double from all others */
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value) return;
    }
}

json_t *cli_reals_json(const double *values, size_t count) {
    json_t *array = json_array();
    for (size_t i = 0; array && i < count; i++)
        if (json_array_append_new(array, json_real(values[i])) != 0) {
            json_decref(array);
            return NULL;
        }
    return array;
}

json_t *cli_name_json(const char *name) {
    json_t *plain = name ? json_string(name) : NULL;
    if (plain || !name) return plain;
    char *text = malloc(4 * strlen(name) + 1), *end = text;
    if (!text) return NULL;
    for (const char *c = name; *c; c++)
        end += sprintf(end, (unsigned char)*c < 0x80 ? "%c" : "\\x%02X", (unsigned char)*c);
    plain = json_string(text);
    free(text);
    return plain;
}

static double seconds_of(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double cli_seconds(void) {
    return seconds_of(CLOCK_MONOTONIC);
}

double cli_processor_seconds(void) {
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double cli_thread_seconds(void) {
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

int cli_flush(void) {
    if (fflush(stdout) == 0 && !ferror(stdout)) return 0;
    if (!errno) errno = EIO;
    return cli_fail_file(CLI_RESOURCES, "standard output", "written");
}

void cli_wrap(FILE *out, const char *text, size_t length, int column, int indent) {
    enum { LINE = 88 };
    const char *end = text + length;
    while (text < end) {
        const int word = (int)strcspn(text, " \n");
        if (column > indent && column + 1 + word > LINE) {
            fputc('\n', out);
            column = 0;
        }
        const int blanks = column < indent ? indent - column : column > indent;
        fprintf(out, "%*s%.*s", blanks, "", word, text);
        column += blanks + word;
        text += word;
        text += strspn(text, " \n");
    }
    fputc('\n', out);
}

/* ------------------------------------------------------------------- JSON -- */

static void put_json_text(const char *text) {
    putchar('"');
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            printf("\\%c", *c);
        else if (*c < 0x20)
            printf("\\u%04x", *c);
        else
            putchar(*c);
    }
    putchar('"');
}

static void put_json(const json_t *value, int indent);

static void put_json_members(const json_t *object, int indent) { // NOLINT(misc-no-recursion)
    const char *separator = "\n";
    const char *key;
    json_t *member;
    json_object_foreach((json_t *)object, key, member) {
        printf("%s%*s", separator, indent + 2, "");
        put_json_text(key);
        fputs(": ", stdout);
        put_json(member, indent + 2);
        separator = ",\n";
    }
    if (json_object_size(object)) printf("\n%*s", indent, "");
}

static void put_json_items(const json_t *array, int indent) { // NOLINT(misc-no-recursion)
    const bool plain = !json_is_object(json_array_get(array, 0));
    for (size_t i = 0; i < json_array_size(array); i++) {
        if (plain)
            fputs(i ? ", " : "", stdout);
        else
            printf("%s\n%*s", i ? "," : "", indent + 2, "");
        put_json(json_array_get(array, i), indent + 2);
    }
    if (!plain) printf("\n%*s", indent, "");
}

static void put_json(const json_t *value, int indent) { // NOLINT(misc-no-recursion)
    char number[32];
    switch (json_typeof(value)) { /* one way: each type has a case */
    case JSON_OBJECT:
        putchar('{'), put_json_members(value, indent), putchar('}');
        break;
    case JSON_ARRAY:
        putchar('['), put_json_items(value, indent), putchar(']');
        break;
    case JSON_STRING:
        put_json_text(json_string_value(value));
        break;
    case JSON_INTEGER:
        printf("%" JSON_INTEGER_FORMAT, json_integer_value(value));
        break;
    case JSON_REAL:
        cli_number(number, json_real_value(value)), fputs(number, stdout);
        break;
    case JSON_TRUE:
        fputs("true", stdout);
        break;
    case JSON_FALSE:
        fputs("false", stdout);
        break;
    case JSON_NULL:
        fputs("null", stdout);
        break;
    }
}

/* ------------------------------------------------------------------- text -- */

enum { CELL = 400 };

static bool is_table(const json_t *value) {
    if (json_is_array(value)) return json_is_object(json_array_get(value, 0));
    if (!json_is_object(value)) return false;
    return json_is_object(json_object_iter_value(json_object_iter((json_t *)value)));
}

/* A plain value, or the plain items of an array with blanks between. A number that was measured needs six digits for
 * reading, and --json has them all; items are coordinates, with all their digits. */
static void cell_text(const json_t *value, char *out, size_t size) {
    const double number = json_number_value(value);
    *out = '\0';
    if (!value || json_is_null(value))
        snprintf(out, size, "-");
    else if (json_is_string(value))
        snprintf(out, size, "%s", json_string_value(value));
    else if (json_is_integer(value))
        snprintf(out, size, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else if (json_is_real(value) && is_whole(number))
        cli_number(out, number);
    else if (json_is_real(value))
        snprintf(out, size, "%.6g", number);
    else if (json_is_boolean(value))
        snprintf(out, size, "%s", json_is_true(value) ? "yes" : "no");
    for (size_t i = 0; i < json_array_size(value); i++) {
        char item_number[32] = "";
        const json_t *item = json_array_get(value, i);
        if (json_is_number(item)) cli_number(item_number, json_number_value(item));
        const size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", i ? " " : "",
                 json_is_string(item) ? json_string_value(item) : item_number);
    }
}

/* "in_cut" reads "in cut"; names of files stay. */
static void label_text(const char *key, char *out, size_t size) {
    snprintf(out, size, "%s", key);
    if (strpbrk(key, "./")) return;
    for (char *c = out; *c; c++)
        if (*c == '_') *c = ' ';
}

static int width_of_keys(const json_t *object) {
    int width = 0;
    const char *key;
    json_t *member;
    json_object_foreach((json_t *)object, key, member) {
        (void)member;
        if ((int)strlen(key) > width) width = (int)strlen(key);
    }
    return width;
}

/* A table's rows are the members of an object, named, or the items of an array. */
typedef struct table {
    const json_t *rows;
    int name_width;
} table;

static int column_width(const table *t, const char *column) {
    char text[CELL];
    int width = (int)strlen(column);
    const char *key;
    json_t *row;
    size_t i;
    if (json_is_array(t->rows)) {
        json_array_foreach((json_t *)t->rows, i, row) {
            cell_text(json_object_get(row, column), text, sizeof text);
            if ((int)strlen(text) > width) width = (int)strlen(text);
        }
        return width;
    }
    json_object_foreach((json_t *)t->rows, key, row) {
        (void)key;
        cell_text(json_object_get(row, column), text, sizeof text);
        if ((int)strlen(text) > width) width = (int)strlen(text);
    }
    return width;
}

/* Prints one row; `row` NULL prints the columns' names. Text is set left, numbers right; the last column unpadded. */
static void put_row(const table *t, const json_t *first, const json_t *row, const char *name, int indent) {
    char text[CELL];
    printf("%*s%-*s", indent, "", t->name_width, name);
    const char *column;
    json_t *sample;
    size_t left = json_object_size(first);
    json_object_foreach((json_t *)first, column, sample) {
        left--;
        const int width = column_width(t, column);
        if (row)
            cell_text(json_object_get(row, column), text, sizeof text);
        else
            label_text(column, text, sizeof text);
        const bool number = json_is_number(sample);
        if (!left && !number)
            printf("  %s", text);
        else
            printf(number ? "  %*s" : "  %-*s", width, text);
    }
    putchar('\n');
}

static void put_table(const char *title, const json_t *rows, int indent) {
    table t = {.rows = rows};
    const char *key;
    json_t *row;
    size_t i;
    if (json_is_array(rows)) {
        printf("%*s%s\n", indent, "", title);
        put_row(&t, json_array_get(rows, 0), NULL, "", indent);
        json_array_foreach((json_t *)rows, i, row) put_row(&t, json_array_get(rows, 0), row, "", indent);
        return;
    }
    const json_t *first = json_object_iter_value(json_object_iter((json_t *)rows));
    t.name_width = width_of_keys(rows) + 2;
    if ((int)strlen(title) > t.name_width) t.name_width = (int)strlen(title);
    put_row(&t, first, NULL, title, indent);
    json_object_foreach((json_t *)rows, key, row) {
        char label[CELL];
        snprintf(label, sizeof label, "  ");
        label_text(key, label + 2, sizeof label - 2);
        put_row(&t, first, row, label, indent);
    }
}

/* Instants are what the motion says, or brackets of what is exact: in full, or two of them would look like one. */
static bool is_instant(const char *key) {
    static const char *const keys[] = {"from", "to", "at", "begin_low", "begin_high"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(keys[i], key) == 0) return true;
    return false;
}

static void put_text(const json_t *object, int indent, int width) { // NOLINT(misc-no-recursion)
    const char *key;
    json_t *member;
    json_object_foreach((json_t *)object, key, member) {
        char label[CELL], text[CELL];
        label_text(key, label, sizeof label);
        if (is_table(member)) {
            put_table(label, member, indent);
        } else if (json_is_object(member)) {
            if (json_object_size(member)) printf("%*s%s\n", indent, "", label);
            put_text(member, indent + 2, width);
        } else {
            cell_text(member, text, sizeof text);
            if (json_is_real(member) && is_instant(key)) cli_number(text, json_real_value(member));
            printf("%*s%-*s  %s\n", indent, "", width - indent, label, text);
        }
    }
}

int cli_report(const cli_common *common, const char *headline, json_t *report) {
    if (!report || json_refused) {
        json_decref(report);
        return cli_fail_memory();
    }
    if (common->json) {
        put_json(report, 0);
        putchar('\n');
    } else if (!common->quiet) {
        int width = width_of_keys(report); /* values of all levels share one column */
        const char *key;
        json_t *member;
        json_object_foreach(report, key, member) {
            (void)key;
            if (!json_is_object(member) || is_table(member)) continue;
            const int inner = width_of_keys(member) + 2;
            if (inner > width) width = inner;
        }
        if (headline) printf("%s\n\n", headline);
        put_text(report, 0, width);
    }
    if (common->report)
        *common->report = report;
    else
        json_decref(report);
    return cli_flush();
}
