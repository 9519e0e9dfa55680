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
/** A number for reading: thousands set apart, reals with four digits; or text. */
void html_value(FILE *out, const json_t *value);
/** A table of name and value; `names` are keys of the report, ended by NULL. */
void html_pairs(FILE *out, const json_t *report, const char *const *names);
/** The promises of a build as a table with bars, nothing when there are none. */
void html_bounds(FILE *out, const json_t *bounds);
/** One row of cells: the values of these keys. */
void html_row(FILE *out, const json_t *report, const char *const *names);
/** Headings of such rows. */
void html_headings(FILE *out, const char *const *names);
#endif
