/* answers.c: cells as text, gathered in a buffer. */
#include "queries/answers.h"
#include "support/decimal/decimal.h"
#include "support/escape.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELL = 40 }; /* a number and what follows it */

static void flush_answers(cli_answers *out) {
    if (!out->mute) fwrite(out->text, 1, out->length, out->file);
    out->length = 0;
}

static char *room(cli_answers *out) {
    if (out->length + CELL > sizeof out->text) flush_answers(out);
    return out->text + out->length;
}

static void put(cli_answers *out, char c) {
    *room(out) = c;
    out->length++;
}

static void put_bytes(cli_answers *out, const char *text, size_t length) {
    while (length) {
        const size_t part = length < CELL ? length : CELL - 1;
        memcpy(room(out), text, part);
        out->length += part;
        text += part;
        length -= part;
    }
}

void cli_answers_put(cli_answers *out, const char *text) {
    put_bytes(out, text, strlen(text));
}

/* -------------------------------------------------------------------- text -- */

static void put_csv(cli_answers *out, const char *text) {
    if (!strpbrk(text, ",\"\r\n")) return cli_answers_put(out, text);
    put(out, '"');
    for (; *text; text++) {
        if (*text == '"') put(out, '"');
        put(out, *text);
    }
    put(out, '"');
}

static void put_json(cli_answers *out, const char *text) {
    char escaped[8];
    put(out, '"');
    for (size_t length; (length = support_json_escape(&text, escaped)) > 0;) put_bytes(out, escaped, length);
    put(out, '"');
}

/* Writes the digits that reading a number back needs; returns how many characters these are, at most CELL - 1. */
static size_t print_number(char *to, double value) {
    char text[SUPPORT_DECIMAL_ROOM + SUPPORT_DECIMAL_AHEAD] = "", *end;
    size_t length = 0;
    for (int digits = 15; digits <= 17; digits++) {
        length = support_decimal_format(text, value, digits);
        if (digits < 17 && support_decimal_ahead(text, &end) == value) break;
    }
    memcpy(to, text, length + 1);
    return length;
}

/* Is it a number as JSON has them? -1.5e-3 is, 007, .5 and +1 are not. */
static bool is_json_number(const char *c) {
    static const char digits[] = "0123456789";
    size_t length;
    c += *c == '-';
    length = strspn(c, digits);
    if (!length || (*c == '0' && length > 1)) return false;
    c += length;
    if (*c == '.') {
        length = strspn(++c, digits);
        if (!length) return false;
        c += length;
    }
    if (*c == 'e' || *c == 'E') {
        ++c;
        c += *c == '+' || *c == '-';
        length = strspn(c, digits);
        if (!length) return false;
        c += length;
    }
    return !*c;
}

enum { DIGITS = 18 }; /* more than tell any double from its neighbours, with the end */

/* The significant digits of a number: 25 of 0.02500. False: there are too many for a double. */
static bool put_digits(const char *c, char out[DIGITS]) {
    size_t length = 0, end = 0;
    for (; *c && (*c | 0x20) != 'e'; ++c) {
        if (*c < '0' || (*c == '0' && !length)) continue; /* a sign, a point */
        if (length < DIGITS - 1) out[length] = *c;
        ++length;
        if (*c != '0') end = length;
    }
    if (end >= DIGITS) return false;
    out[end] = '\0';
    return true;
}

/* Does the nearest double have all digits of a number, in those that tell it from its neighbours? */
static bool is_held(const char *number) {
    char digits[DIGITS], held[DIGITS], text[CELL];
    const double value = strtod(number, NULL);
    if (!isfinite(value)) return false;
    print_number(text, value);
    (void)put_digits(text, held); /* no double needs more */
    return put_digits(number, digits) && !strcmp(digits, held);
}

/* ------------------------------------------------------------------- cells -- */

/* What stands before a cell. */
static inline void begin_cell(cli_answers *out) {
    if (out->format == CLI_CSV) return;
    put_json(out, out->names[out->column++]);
    put(out, ':');
}

static inline void end_cell(cli_answers *out) {
    put(out, ',');
}

void cli_answers_whole(cli_answers *out, uint64_t value) {
    begin_cell(out);
    char *to = room(out);
    out->length += support_decimal_whole(to, value);
    end_cell(out);
}

void cli_answers_number(cli_answers *out, double value) {
    out->length += print_number(room(out), value);
}

void cli_answers_real(cli_answers *out, double value) {
    begin_cell(out);
    if (out->format != CLI_CSV && !isfinite(value))
        cli_answers_put(out, "null");
    else
        cli_answers_number(out, value);
    end_cell(out);
}

void cli_answers_text(cli_answers *out, const char *value) {
    begin_cell(out);
    (out->format == CLI_CSV ? put_csv : put_json)(out, value);
    end_cell(out);
}

void cli_answers_own(cli_answers *out, const char *value, cli_own what) {
    const bool kept = is_json_number(value) && is_held(value);
    if (out->format != CLI_CSV && what == CLI_OWN_NUMBER && !kept) return cli_answers_real(out, strtod(value, NULL));
    if (out->format == CLI_CSV || what == CLI_OWN_QUOTED || !kept) return cli_answers_text(out, value);
    begin_cell(out);
    cli_answers_put(out, value);
    end_cell(out);
}

void cli_answers_none(cli_answers *out) {
    begin_cell(out);
    if (out->format != CLI_CSV) cli_answers_put(out, "null");
    end_cell(out);
}

/* -------------------------------------------------------------------- rows -- */

void cli_answers_open(cli_answers *out, cli_format format, bool mute, const char *const *names, size_t columns) {
    out->format = format;
    out->mute = mute;
    out->file = stdout;
    out->names = names;
    out->columns = columns;
    out->length = out->column = 0;
    out->rows = 0;
    for (size_t i = 0; i < columns && format == CLI_CSV; i++) {
        put_csv(out, names[i]);
        put(out, i + 1 < columns ? ',' : '\n');
    }
}

void cli_answers_begin(cli_answers *out) {
    out->column = 0;
    if (out->format == CLI_JSONL) put(out, '{');
    if (out->format == CLI_GEOJSON)
        cli_answers_put(out,
                        out->rows ? ",\n{\"type\":\"Feature\",\"geometry\":" : "\n{\"type\":\"Feature\",\"geometry\":");
}

void cli_answers_end(cli_answers *out) {
    static const char *const ends[] = {[CLI_CSV] = "\n", [CLI_JSONL] = "}\n", [CLI_GEOJSON] = "}}"};
    out->length--; /* the last comma */
    cli_answers_put(out, ends[out->format]);
    out->rows++;
    if (out->mute) out->length = 0;
}

void cli_answers_close(cli_answers *out) {
    if (out->format == CLI_GEOJSON) cli_answers_put(out, "\n]}\n");
    flush_answers(out);
}
