/* answers.c: numbers as text, gathered in a buffer. */
#include "queries/answers.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELL = 40 }; /* a number and what follows it */

void cli_answers_flush(cli_answers *out) {
    if (!out->mute) fwrite(out->text, 1, out->length, stdout);
    out->length = 0;
}

static char *room(cli_answers *out) {
    if (out->length + CELL > sizeof out->text) cli_answers_flush(out);
    return out->text + out->length;
}

/* Ends a cell of `length` bytes. */
static void end_cell(cli_answers *out, size_t length) {
    out->text[out->length + length] = ',';
    out->length += length + 1;
}

void cli_answers_whole(cli_answers *out, uint64_t value) {
    char digits[CELL], *to = room(out);
    size_t count = 0;
    do digits[count++] = (char)('0' + value % 10);
    while (value /= 10);
    for (size_t i = 0; i < count; i++) to[i] = digits[count - 1 - i];
    end_cell(out, count);
}

void cli_answers_real(cli_answers *out, double value) {
    char *to = room(out);
    int length = 0;
    for (int digits = 15; digits <= 17; digits++) { /* "%.15g" leaves out zeros at the end */
        length = snprintf(to, CELL, "%.*g", digits, value);
        if (strtod(to, NULL) == value) break;
    }
    end_cell(out, (size_t)length);
}

void cli_answers_text(cli_answers *out, const char *value) {
    size_t length = strlen(value);
    if (length >= CELL) length = CELL - 1;
    memcpy(room(out), value, length);
    end_cell(out, length);
}

static void put(cli_answers *out, char c) {
    *room(out) = c;
    out->length++;
}

void cli_answers_name(cli_answers *out, const char *value) {
    const bool quoted = strpbrk(value, ",\"\r\n");
    if (quoted) put(out, '"');
    for (const char *c = value; *c; c++) {
        if (*c == '"') put(out, '"');
        put(out, *c);
    }
    if (quoted) put(out, '"');
    cli_answers_none(out);
}

void cli_answers_none(cli_answers *out) {
    room(out);
    end_cell(out, 0);
}

void cli_answers_end(cli_answers *out) {
    out->text[out->length - 1] = '\n';
    out->rows++;
    if (out->mute) out->length = 0;
}

void cli_answers_pair(cli_answers *out, uint64_t first, uint64_t second) {
    cli_answers_whole(out, first);
    cli_answers_whole(out, second);
    cli_answers_end(out);
}

static int by_number(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

void cli_answers_sort(froe_answers *answers) {
    for (size_t i = 0; i < answers->queries; i++) {
        const size_t first = answers->starts[i], count = answers->starts[i + 1] - first;
        if (count > 1) qsort(answers->ids + first, count, sizeof *answers->ids, by_number);
    }
}

void cli_answers_lists(cli_answers *out, const uint64_t *ids, froe_answers *answers, bool count) {
    if (!count) cli_answers_sort(answers);
    for (size_t i = 0; i < answers->queries; i++) {
        const size_t first = answers->starts[i], end = answers->starts[i + 1];
        if (count) cli_answers_pair(out, ids[i], end - first);
        for (size_t j = first; j < end && !count; j++) cli_answers_pair(out, ids[i], answers->ids[j]);
    }
}
