/* columns.h: what --columns names, and what it stands for.
 *
 *     query,name,"the town, of the query",point,*
 *
 * A command has columns of its own, and those of the file of its queries. Points and normals expand to a column for
 * each axis; * stands for all columns of the file that are not named. */
#ifndef FROE_CLI_COLUMNS_H
#define FROE_CLI_COLUMNS_H
#include "queries/rows.h"

typedef enum cli_field {
    CLI_FIELD_QUERY,
    CLI_FIELD_OBJECT,
    CLI_FIELD_GROUP,
    CLI_FIELD_NAME,
    CLI_FIELD_ID,
    CLI_FIELD_T,
    CLI_FIELD_DISTANCE,
    CLI_FIELD_POINT,
    CLI_FIELD_NORMAL,
    CLI_FIELD_COUNT,
    CLI_FIELD_KIND,
    CLI_FIELD_OWN
} cli_field;

typedef struct cli_shown {
    cli_field field;
    bool second; /**< of the second object of a pair */
    size_t at;   /**< the axis of a point or normal; the column of the file, and of those shown */
    size_t own;
} cli_shown;

typedef struct cli_columns {
    size_t count, own_count;
    cli_shown *shown;
    const char **names; /**< each its own text */
    size_t *own;        /**< the columns of the file that are shown */
} cli_columns;

/** What `given` names (NULL: `standard`), out of `known` and the columns of `rows` (NULL: none): lists of names between
 * commas. Returns 0, or an exit code after saying why. */
int cli_columns_open(const char *given, const char *standard, const char *known, const cli_rows *rows, int dim,
                     cli_columns *out);
void cli_columns_free(cli_columns *columns);
/** Is one of them of this field? */
bool cli_columns_show(const cli_columns *columns, cli_field field);
#endif
