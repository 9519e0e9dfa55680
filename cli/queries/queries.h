/* queries.h: the frame of the commands that ask a tree: rows of numbers come in, rows of answers go out.
 *
 *     CSV --rows.h--> block of queries --the command--> table.h --> standard output
 *
 * A file may have any length; a block has a few thousand queries, so that a command can hand them to the
 * batch calls of the library. A malformed row or a bad query is named with its line. It ends the run, or with
 * --keep-going is passed over; either way the exit code shows it. */
#ifndef FROE_CLI_QUERIES_H
#define FROE_CLI_QUERIES_H
#include "args/tree.h"
#include "queries/table.h"
#include <jansson.h>

/** Shared by all query commands; their own tables name the operand and the input. */
typedef struct cli_query_args {
    const char *input;
    bool keep_going, count;
    cli_table_args table;
} cli_query_args;
extern const cli_option cli_query_options[];
/** The parts of a command whose arguments are the struct T, with the cli_query_args `query`. They stand before those of
 * reading the scene, where --format is another name of --input-format. */
#define CLI_QUERY_PARTS(T)                                                                                             \
    {"Queries", cli_query_options, offsetof(T, query)}, {                                                              \
        "Answers", cli_table_options, offsetof(T, query.table)                                                         \
    }
/** The answers of all commands with --count. */
#define CLI_COUNTS(SHAPE)                                                                                              \
    (cli_answer_kind) {                                                                                                \
        "query,count", "query,count", SHAPE                                                                            \
    }

enum { CLI_BLOCK = 4096 }; /**< queries at most */

/** The tree that is asked, while a command runs. */
typedef struct cli_asked {
    const froe_scene *scene;
    froe_query *query;   /**< NULL: a folder is asked */
    froe_shards *shards; /**< NULL: a tree is asked; otherwise `scene` is that of one shard */
    size_t dim;
    froe_batch_options batch; /**< with the threads of the command line */
} cli_asked;

/** Answers a block. Either all of it, or FROE_E_INPUT with diag->object telling the position of the
 * first bad query and nothing written; other failures end the run. */
typedef froe_status cli_answer_fn(const void *args, const cli_asked *asked, const cli_block *block, cli_table *out,
                                  froe_diagnostic *diag);

typedef struct cli_queries {
    const cli_common *common;
    const cli_tree_args *tree;
    const cli_query_args *args;
    const cli_column *columns; /**< if the first is "query", consecutive rows with the same number are one query */
    cli_answer_kind kind;      /**< of the answers */
    cli_answer_fn *answer;
    const void *given; /**< the arguments of the command */
} cli_queries;

/** What a context has visited, for --json; begins again at 0. query NULL: nothing. */
json_t *cli_statistics_json(froe_query *query);

/** A scene of a folder of shards, for what all of its scenes have in common. Returns 0, or an exit code after saying
 * why. */
int cli_scene_of_shards(const char *path, froe_shards *shards, const froe_scene **scene);
/** Opens the tree or folder, reads, asks, writes. Returns an exit code. */
int cli_queries_run(const cli_queries *queries);
#endif
