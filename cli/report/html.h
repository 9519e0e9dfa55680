/* html.h: pages, and reports as HTML, the third form beside text and JSON. */
#ifndef FROE_CLI_HTML_H
#define FROE_CLI_HTML_H
#include <jansson.h>
#include <stdio.h>

/** The beginning of a page up to <body>, with the style that all pages share and the embedded file `style` (NULL:
 * none). */
void html_begin(FILE *out, const char *title, const char *style);
/** The end of a page, from </main> on: what made it. */
void html_end(FILE *out);
/** Text with markup escaped. */
void html_text(FILE *out, const char *text);
/** An element that holds text only. */
void html_element(FILE *out, const char *tag, const char *text);
/** Command lines, "froe" and these words each, between a beginning and an end, with a button that copies them once
 * html_copying() has been written. */
void html_command_begin(FILE *out);
void html_command(FILE *out, const char *words);
void html_command_end(FILE *out);
void html_copying(FILE *out);
/** A number for reading: thousands set apart, reals with three digits; or text. */
void html_value(FILE *out, const json_t *value);

/** A value of a report: the name of its key, or "object.key" one level down, and what pages call it. */
typedef struct html_field {
    const char *key, *label;
} html_field;
/** A table of name and value; fields are ended by a NULL key, and those that the report has not are left out. */
void html_pairs(FILE *out, const json_t *report, const html_field *fields);
/** A table with a row for each report, and its heading. */
void html_rows(FILE *out, const json_t *reports, const html_field *fields);
/** The promises of a build as a table with bars; there are some. */
void html_bounds(FILE *out, const json_t *bounds);
#endif
