/* answers.h: rows of answers on standard output, millions of them, as CSV, as lines of JSON, or as GeoJSON.
 *
 *     cli_answers_open(&out, CLI_CSV, names, count);
 *     cli_answers_begin(&out);  cli_answers_whole(&out, 7);  ...  cli_answers_end(&out);     // a row: a cell a column
 *     cli_answers_close(&out);
 *
 * In GeoJSON a row is a feature: its geometry is written between cli_answers_begin() and the first cell, by
 * cli_answers_put(), and cells are its properties. The collection begins with what cli_answers_put() wrote before the
 * first row. */
#ifndef FROE_CLI_ANSWERS_H
#define FROE_CLI_ANSWERS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum cli_format { CLI_CSV, CLI_JSONL, CLI_GEOJSON } cli_format;

typedef struct cli_answers {
    cli_format format;
    bool mute;     /**< count them only */
    FILE *file;    /**< standard output; set by the owner behind cli_answers_open() to write elsewhere */
    uint64_t rows; /**< written so far */
    const char *const *names;
    size_t columns, column; /**< the next cell's */
    size_t length;
    char text[1 << 16];
} cli_answers;

/** What stands before the first row. The names must last. */
void cli_answers_open(cli_answers *out, cli_format format, bool mute, const char *const *names, size_t columns);
void cli_answers_begin(cli_answers *out);
void cli_answers_end(cli_answers *out);
/** What stands behind the last row; hands everything to standard output. cli_flush() says whether it arrived. */
void cli_answers_close(cli_answers *out);

void cli_answers_whole(cli_answers *out, uint64_t value);
/** With the digits that reading it back needs. JSON has no infinity: null. */
void cli_answers_real(cli_answers *out, double value);
void cli_answers_text(cli_answers *out, const char *value); /**< any; quoted where CSV needs it */
void cli_answers_none(cli_answers *out);                    /**< empty, in JSON null */
/** What a cell of a CSV was: other text, text in quotation marks, a number that the command read. */
typedef enum cli_own { CLI_OWN_TEXT = ' ', CLI_OWN_QUOTED = '"', CLI_OWN_NUMBER = '0' } cli_own;
/** Text of a CSV as it stands there. In JSON numbers that the command read are numbers, and so is other text without
 * quotation marks that JSON takes for a number and a double holds to its last digit: not 1e400, not 20 digits. */
void cli_answers_own(cli_answers *out, const char *value, cli_own what);

/** Within geometries: text as it is, and numbers. */
void cli_answers_put(cli_answers *out, const char *text);
void cli_answers_number(cli_answers *out, double value);
#endif
