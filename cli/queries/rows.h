/* rows.h: the numbers of a CSV, row by row, from a file of any length or from standard input.
 *
 *     static const cli_column columns[] = {{"lo_", true}, {"hi_", true}, {0}};
 *     cli_rows rows;
 *     code = cli_rows_open("boxes.csv", columns, dim, &rows);       // lo_x,lo_y,hi_x,hi_y
 *     while (cli_rows_next(&rows, values) == CLI_ROW_READ) ...
 *     cli_rows_close(&rows);
 *
 * The header line names the columns, in any order, and columns of other names beside them; an axis more than the tree
 * has is refused. What separates fields, what may stand in them, and how axes may be called: support/text/csv.h. Empty
 * lines do not count as rows. */
#ifndef FROE_CLI_ROWS_H
#define FROE_CLI_ROWS_H
#include "support/text/csv.h"
#include <froe/froe.h>
#include <stdio.h>

/** A column, or one for each axis: then `name` is what stands before x, y, ... */
typedef struct cli_column {
    const char *name; /**< NULL ends the list */
    bool axes;
} cli_column;

enum { CLI_ROW_NUMBERS = 2 * FROE_MAX_DIM + 2 };
typedef enum cli_row { CLI_ROW_READ, CLI_ROW_BAD, CLI_ROWS_END, CLI_ROWS_FAILED } cli_row;

typedef struct cli_rows {
    const char *path; /**< as messages name it */
    FILE *file;
    char *header, *text;     /**< the first record, with `names` in it; the current one, with `fields` in it */
    char *more;              /**< a line that belongs to a record */
    size_t capacity, room;   /**< of text; of more */
    uint64_t line, lines;    /**< the first of `text`, from 1; read so far */
    uint64_t row;            /**< of `text`, from 0, bad ones included */
    uint64_t rows;           /**< read so far */
    size_t numbers, columns; /**< asked for; there are */
    const char *names[SUPPORT_CSV_COLUMNS];
    bool kept[SUPPORT_CSV_COLUMNS];                /**< set by the owner: the text of these columns is wanted */
    support_csv_field fields[SUPPORT_CSV_COLUMNS]; /**< these, of a row that was read, as they stand in the file */
    signed char place[SUPPORT_CSV_COLUMNS];        /**< which number a column holds, -1: none */
    char separator;
    int family;         /**< of the names of the axes, see support/text/csv.h */
    bool wide;          /**< the file is text in UTF-16 */
    bool foreign;       /**< its first line is that of a file of another kind */
    bool open;          /**< the file ends within quotation marks */
    char sentence[120]; /**< what is wrong with a bad row */
    int code;           /**< behind CLI_ROWS_FAILED: the exit code */
} cli_rows;

/** Opens a file ("-": standard input) and reads its header. Returns 0, or an exit code after saying why. */
int cli_rows_open(const char *path, const cli_column *columns, int dim, cli_rows *out);
/** The same of a file that is open, which cli_rows_close() closes; `path` is its name in messages. */
int cli_rows_begin(FILE *file, const char *path, const cli_column *columns, int dim, cli_rows *out);
/** Reads the next row's numbers, in the order of the columns asked for. CLI_ROW_BAD: `sentence` says why, and the next
 * call goes on behind it. CLI_ROWS_FAILED: the file cannot be read on, and that has been said. */
cli_row cli_rows_next(cli_rows *rows, double *values);
void cli_rows_close(cli_rows *rows);

/** The name of an axis: x, y, z, w, x5, ... behind a prefix. */
typedef struct cli_axis {
    char text[32];
} cli_axis;
cli_axis cli_axis_name(const char *prefix, int axis);
#endif
