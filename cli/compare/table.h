/* table.h: the comparison as a table: for the terminal, and as CSV. */
#ifndef FROE_CLI_COMPARE_TABLE_H
#define FROE_CLI_COMPARE_TABLE_H
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

typedef enum table_part { TABLE_TREE, TABLE_QUERY } table_part;
/** One column: where its number is found in a row (row.h), as "object.key", "?kept" for promises, or "/bytes" for a
 * number per object. */
typedef struct table_column {
    const char *name, *path;
    int digits;               /**< that are worth reading; 0: all */
    table_part part;          /**< of which table */
    const char *title, *unit; /**< on pages; the columns of a query have one title */
    double times;             /**< units in the number; 0: 1 */
    const char *meaning;      /**< a clause, for below the table; NULL: the column before says it */
} table_column;
/** Ended by a NULL name. */
extern const table_column table_columns[];
/** Does any row fill the column? Any of a part's columns? */
bool table_column_used(const json_t *rows, const table_column *column);
bool table_part_used(const json_t *rows, table_part part);

/** What stands in a cell; null if there is nothing. */
json_t *table_value(const json_t *row, const table_column *column);
/** For the terminal: of each scene what it is like, its trees, queries and promises, and how well auto chose. */
json_t *table_report(const json_t *comparison);
/** A cli_write_fn: every row in full as CSV; `user` is the comparison. */
bool table_put_csv(FILE *out, const void *user);
#endif
