/* report.h: the results of a command, as JSON or as text.
 *
 * A command fills one JSON object; --json prints it as it is, and otherwise the
 * same object is laid out for reading:
 *
 *     height      19                     a plain member
 *     seconds                            an object: its members, indented
 *       read      0.004
 *     bounds      promised  measured     an object of objects, or an array of them: a table
 *       height          60        19
 *
 * Numbers are printed with as many digits as reading them back needs, not more. */
#ifndef FROE_CLI_REPORT_H
#define FROE_CLI_REPORT_H
#include "args/options.h"
#include <jansson.h>
#include <stdio.h>

/** Before anything is reported: from here on it is known whether memory for a report was refused. */
void cli_report_begin(void);
/** Whether any memory that reports asked for was refused: members may be missing from them. */
bool cli_report_short(void);

/** Says so of memory that was not jansson's. Null, to be put in the place of what is missing. */
json_t *cli_report_lose(void);

/** Prints and releases `report` (NULL: there was no memory for it). `headline` is
 * a sentence above the text form, or NULL. With common->report it is handed
 * over there instead of released. Returns 0 or an exit code. */
int cli_report(const cli_common *common, const char *headline, json_t *report);

/** Flushes stdout; an exit code when it did not take everything. */
int cli_flush(void);

/** The shortest text that reads back as `value`; `text` holds at least 32 bytes. */
void cli_number(char *text, double value);

/** Prints `length` bytes of text, its words wrapped at a terminal's width and
 * indented; the line already holds `column` characters. Ends with a newline. */
void cli_wrap(FILE *out, const char *text, size_t length, int column, int indent);

/** The name of a file, which may have any bytes: those of one that is no UTF-8, and so no JSON, stand as \xFF. NULL
 * without a name, or memory. */
json_t *cli_name_json(const char *name);

/** A JSON array of `count` doubles, NULL without memory. */
json_t *cli_reals_json(const double *values, size_t count);

/** Seconds of a clock that only moves forward, of all processors that worked for this program, and of this thread. */
double cli_seconds(void);
double cli_processor_seconds(void);
double cli_thread_seconds(void);
#endif
