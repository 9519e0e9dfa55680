/* csv.h: comma-separated values (RFC 4180), for scenes and for questions.
 *
 *     name;lon;lat               the header tells what separates: of commas, semicolons and tabs the one it has most
 *     "St. ""J""; Ont.";-81,2;43 fields in quotation marks have any text, line ends too;
 *                                numbers may have decimal commas where semicolons separate
 *
 * Fields are read in place: a text is changed while it is read. It ends with a NUL, and numbers are read ahead of it
 * (support/decimal/decimal.h). */
#ifndef FROE_SUPPORT_TEXT_CSV_H
#define FROE_SUPPORT_TEXT_CSV_H
#include <stdbool.h>
#include <stddef.h>

enum { SUPPORT_CSV_COLUMNS = 512 }; /**< more are read by no reader */

typedef struct support_csv_field {
    char *text;  /**< without the blanks around it, or as it stands between its quotation marks; with them where it
                      goes on behind them, so that it is no number */
    bool quoted; /**< it was in quotation marks */
    bool open;   /**< and the text ends before they are closed */
    bool last;   /**< of its record */
} support_csv_field;

/** What separates the fields of the header that a text begins with. */
char support_csv_separator(const char *text);
/** The field that a text begins with; moves *at behind it and what separates it from the next. */
support_csv_field support_csv_next(char **at, char separator);
/** How many line ends stand in a field, which only one in quotation marks has. */
size_t support_csv_line_ends(const support_csv_field *field);
/** Does the text end within quotation marks, so that its last record goes on in the next line? `within`: it begins
 * there. */
bool support_csv_goes_on(const char *text, char separator, bool within);
/** Passes a number that stands alone in a field, without blanks and quotation marks, and what separates it from the
 * next; *last: it ends its record. False: something else stands there, and nothing is passed. */
bool support_csv_plain(char **at, char separator, double *out, bool *last);
/** Is the field a number, and nothing else? *out is the nearest double. For threads in the locale C. The field is the
 * same again afterwards. */
bool support_csv_number(char *field, char separator, double *out);

/** Writes the decimal comma of a number as a point. */
void support_csv_point(char *number, char separator);

/** Families of names of axes: x,y,z,w or x1,x2,...; lon,lat; easting,northing. z belongs to all of them. */
enum { SUPPORT_CSV_FAMILIES = 3 };
/** Which axis a name stands for in a family, in small letters or capitals; `sided`: behind a prefix like lo_, where 1
 * stands for x1. -1: none. Axes may be beyond those that there can be. */
int support_csv_axis(const char *name, int family, bool sided);
/** Which axis of a family does a name bound, as minx, min_x, xmin and x_min do? *high: from above, by max. -1: none. */
int support_csv_bound(const char *name, int family, bool *high);
/** How the names of a header stand in a sentence: "town, x, y", or as many as fit: "town, x and 7 more". */
void support_csv_names(char *out, size_t size, const char *const *names, size_t count);
#endif
