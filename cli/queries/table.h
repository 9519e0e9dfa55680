/* table.h: the answers of a command as a table: each answer is put as a row of the columns that are shown.
 *
 *     cli_table_put(table, &(cli_answer){.at = i, .object = found[i], .group = FROE_NONE, .value = t});
 *
 * What a column shows beside that is asked of the scene and the query: names, the feature's own id, the nearest point,
 * the place where a ray hits. In GeoJSON each row has a geometry, too. */
#ifndef FROE_CLI_TABLE_H
#define FROE_CLI_TABLE_H
#include "args/options.h"
#include "queries/answers.h"
#include "queries/columns.h"
#include <froe/shards.h>

/** What the geometry of an answer is. */
typedef enum cli_shape {
    CLI_SHAPE_NONE,
    CLI_SHAPE_QUERY,   /**< the point that was asked about */
    CLI_SHAPE_NEAREST, /**< from there to the nearest point of the object */
    CLI_SHAPE_HIT,     /**< from the origin of the ray to where it hits */
    CLI_SHAPE_OBJECT,  /**< the object */
    CLI_SHAPE_PAIR     /**< two objects */
} cli_shape;

/** What a command answers with. */
typedef struct cli_answer_kind {
    const char *standard, *known; /**< its columns: those shown by default, and all */
    cli_shape shape;
} cli_answer_kind;

/** Options of a command that answers in rows. */
typedef struct cli_table_args {
    const char *columns; /**< NULL: the standard ones */
    int format;          /**< cli_format; -1: not given */
} cli_table_args;
extern const cli_option cli_table_options[];
/** What --columns takes beside the columns of a command, for its `about`. */
#define CLI_COLUMNS_ABOUT                                                                                              \
    "A column of the CSV is named as there, or with query_ before its name where the command has a column of that "    \
    "name; * stands for all that are not named. group is the group of the object, and name is its name. id is the "    \
    "number of the feature in its file, or the tag of a CSV.\n\n"
#define CLI_TABLE_DEFAULTS                                                                                             \
    { .format = -1 }

/** Queries in the order of the input. Query i has the rows starts[i] .. starts[i+1] of `numbers`, each `width`
 * numbers; without a column `query` one row each. */
typedef struct cli_block {
    size_t count, width;
    const size_t *starts;
    const double *numbers;
    const uint64_t *ids; /**< what the column `query` of the answers says */
    const size_t *own;   /**< [own_count] of each query: where the text of its own columns begins, behind a mark */
    const char *texts;   /**< each mark is a cli_own */
} cli_block;

/** The first number of a block whose queries have a row each. */
static inline const double *cli_block_numbers(const cli_block *block) {
    return block->numbers + block->starts[0] * block->width;
}

typedef struct cli_answer {
    size_t at;              /**< which query of the block */
    uint32_t object, other; /**< FROE_NONE: none; `other` is the second of a pair */
    uint32_t group;         /**< where there is no object */
    double value;           /**< t, distance */
    uint64_t count;
    const char *kind;
    const froe_find *find; /**< of a folder: where `object` is, or a group; shard and tag go before what stands above */
} cli_answer;

typedef struct cli_table {
    cli_answers out;
    cli_columns columns;
    cli_shape shape;
    const froe_scene *scene; /**< of a folder: of the shard that the answer in hand is from */
    froe_query *query;
    froe_shards *shards;           /**< NULL: a tree was asked */
    const cli_block *block;        /**< that the answers to come are about; NULL: none */
    uint64_t *group_ids;           /**< the ids of features by groups, made at first need */
    const froe_scene *group_scene; /**< that they are of */
    froe_status status;            /**< the first failure, which the command's answer must return */
    bool nearest, hit;             /**< what every answer is asked for */
    froe_hit_place place;          /**< of the answer in hand; its point is also the nearest one */
} cli_table;

/** Settles columns and format, and writes what stands before the first row. Returns 0, or an exit code after saying
 * why. With --json rows are only counted. */
int cli_table_open(const cli_common *common, const cli_table_args *args, const cli_answer_kind *kind,
                   const cli_rows *rows, const froe_scene *scene, froe_query *query, cli_table *out);
void cli_table_put(cli_table *table, const cli_answer *answer);
/** All answers of a batch, by query, then object, or how many each query has. */
void cli_table_put_lists(cli_table *table, froe_answers *answers, bool count);
/** The same of answers that are groups, ascending for each query. */
void cli_table_put_groups(cli_table *table, const froe_answers *answers, bool count);
/** The answers of a folder, in their order: objects, or groups, with their values, or how many each query has. */
void cli_table_put_finds(cli_table *table, const froe_finds *finds, bool count);
/** What one object each was found for, or none. */
void cli_table_put_firsts(cli_table *table, const froe_find *finds, size_t queries, bool count);
/** Puts the ids of each query in ascending order. */
void cli_sort_answers(froe_answers *answers);
/** Writes what stands behind the last row; of a command that has `failed` before its first row nothing is written, no
 * header either. Returns 0, or an exit code after saying why not all was written. */
int cli_table_close(cli_table *table, bool failed);
#endif
