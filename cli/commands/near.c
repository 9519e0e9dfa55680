/* near.c: froe near, the objects nearest to points. */
#include "command.h"
#include "exit.h"
#include "queries/queries.h"
#include <math.h>

typedef struct near_args {
    cli_common common;
    cli_tree_args tree;
    cli_query_args query;
    uint64_t k;
    double bound;
} near_args;

static const cli_column columns[] = {{"", true}, {0}};

static const cli_option options[] = {
    {"queries", 0, CLI_TEXT, offsetof(near_args, query.input), "CSV", .file = CLI_READ,
     .help = "the points, x,y[,z...]; - for standard input", .required = true, .alias = "points"},
    {"neighbours", 'k', CLI_WHOLE, offsetof(near_args, k), "K", .help = "how many objects (default 1)",
     .max = 2147483646},
    {"within", 0, CLI_REAL, offsetof(near_args, bound), "D", .help = "no object further away (default: no limit)"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(near_args),           {"Near", options, 0},
                                 CLI_QUERY_PARTS(near_args),         CLI_TREE_BUILD_PARTS(near_args),
                                 {"Options", cli_common_options, 0}, {0}};

static froe_status answer_near(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                               froe_diagnostic *diag) {
    const near_args *args = given;
    froe_answers answers;
    if (asked->shards) {
        froe_finds finds = {0};
        const froe_status found = froe_shards_near(asked->shards, cli_block_numbers(block), block->count, args->k,
                                                   args->bound, &asked->batch, &finds, diag);
        if (!found) cli_table_put_finds(out, &finds, args->query.count);
        froe_finds_free(&finds);
        return found;
    }
    const froe_status status = froe_batch_near(asked->query, cli_block_numbers(block), block->count, args->k,
                                               args->bound, &asked->batch, &answers, diag);
    if (status) return status;
    for (size_t i = 0; i < block->count; i++) {
        const size_t first = answers.starts[i], end = answers.starts[i + 1];
        if (args->query.count) cli_table_put(out, &(cli_answer){.at = i, .object = FROE_NONE, .count = end - first});
        for (size_t j = first; j < end && !args->query.count; j++)
            cli_table_put(
                out, &(cli_answer){.at = i, .object = answers.ids[j], .group = FROE_NONE, .value = answers.values[j]});
    }
    froe_answers_free(&answers);
    return FROE_OK;
}

static int run_near(const void *given) {
    const near_args *args = given;
    if (args->bound < 0) return cli_fail(CLI_USE, NULL, "--within: '%g' is not a number >= 0.", args->bound);
    const cli_queries queries = {
        .common = &args->common,
        .tree = &args->tree,
        .args = &args->query,
        .columns = columns,
        .kind = args->query.count ? CLI_COUNTS(CLI_SHAPE_QUERY)
                                  : (cli_answer_kind){"query,object,distance",
                                                      "query,object,group,name,id,distance,point", CLI_SHAPE_NEAREST},
        .answer = answer_near,
        .given = args};
    return cli_queries_run(&queries);
}

const cli_command cli_command_near = {
    .name = "near",
    .summary = "find the objects nearest to points",
    .about = "Prints one line query,object,distance for each of the K objects nearest to a point, nearest first; equal "
             "distances by object. Distances are compared exactly, and printed as the doubles nearest to them; 0 means "
             "that the point is in the object. A query's number is that of its row, from 0.\n\n"
             "With --columns, each line has the columns that are named there. The command has query, object, group, "
             "name, id, distance and point (of "
             "the object, the nearest one). " CLI_COLUMNS_ABOUT
             "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples = "froe near map.geojson --queries towns.csv -k 3\nfroe near house.glb --queries lamps.csv --within 0.5\n"
                "froe near roads.gpkg --queries towns.csv --columns '*,name,distance,point' --format geojson\n",
    .parts = parts,
    .defaults = &(const near_args){.common = CLI_COMMON_DEFAULTS,
                                   .tree = CLI_TREE_DEFAULTS,
                                   .query.table = CLI_TABLE_DEFAULTS,
                                   .k = 1,
                                   .bound = INFINITY},
    .size = sizeof(near_args),
    .run = run_near,
};
