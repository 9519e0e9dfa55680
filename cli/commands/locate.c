/* locate.c: froe locate, the objects and groups that points lie in, or what lies above or below them. */
#include "command.h"
#include "exit.h"
#include "queries/queries.h"
#include "support/fail.h"
#include <stdlib.h>

typedef struct locate_args {
    cli_common common;
    cli_tree_args tree;
    cli_query_args query;
    bool groups, above, below;
} locate_args;

static const cli_column columns[] = {{"", true}, {0}};

static const cli_option options[] = {
    {"queries", 0, CLI_TEXT, offsetof(locate_args, query.input), "CSV", .file = CLI_READ,
     .help = "the points, x,y[,z...]; - for standard input", .required = true, .alias = "points"},
    {"groups", 0, CLI_FLAG, offsetof(locate_args, groups),
     .help = "the groups each point lies in, with their names, and no objects (plane)"},
    {"above", 0, CLI_FLAG, offsetof(locate_args, above), .help = "the first segment above each point instead (plane)"},
    {"below", 0, CLI_FLAG, offsetof(locate_args, below), .help = "the first segment below"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(locate_args),         {"Locate", options, 0},
                                 CLI_QUERY_PARTS(locate_args),       CLI_TREE_BUILD_PARTS(locate_args),
                                 {"Options", cli_common_options, 0}, {0}};

/* The same of a folder: objects, then the other groups that the point lies in. */
static void put_all_finds(froe_shards *shards, const froe_finds *objects, const froe_finds *groups, cli_table *out) {
    for (size_t i = 0; i < objects->questions; i++) {
        for (size_t j = objects->starts[i]; j < objects->starts[i + 1]; j++)
            cli_table_put(
                out, &(cli_answer){
                         .at = i, .object = objects->items[j].object, .group = FROE_NONE, .find = &objects->items[j]});
        for (size_t j = groups->starts ? groups->starts[i] : 0; groups->starts && j < groups->starts[i + 1]; j++) {
            const froe_find *group = &groups->items[j];
            bool told = false; /* does one of the objects belong to the group? */
            for (size_t k = objects->starts[i]; k < objects->starts[i + 1] && !told; k++) {
                const froe_tree *tree; /* it is open, since it has answered */
                told = !froe_shards_tree(shards, objects->items[k].shard, &tree, NULL) &&
                       froe_scene_object(froe_tree_scene(tree), objects->items[k].object).group == group->tag;
            }
            if (!told)
                cli_table_put(
                    out, &(cli_answer){.at = i, .object = FROE_NONE, .group = (uint32_t)group->tag, .find = group});
        }
    }
}

/* The first object above or below each point of a block, asked of a folder. */
static froe_status answer_vertical_by_shards(const locate_args *args, const cli_asked *asked, const cli_block *block,
                                             cli_table *out, froe_diagnostic *diag) {
    froe_find *firsts = malloc(block->count * sizeof *firsts + 1);
    if (!firsts) return support_fail_memory(diag);
    const froe_status status = froe_shards_vertical(asked->shards, cli_block_numbers(block), block->count,
                                                    args->above ? 1 : -1, &asked->batch, firsts, diag);
    if (!status) cli_table_put_firsts(out, firsts, block->count, args->query.count);
    free(firsts);
    return status;
}

/* A block of points asked of a folder. */
static froe_status answer_by_shards(const locate_args *args, const cli_asked *asked, const cli_block *block,
                                    cli_table *out, froe_diagnostic *diag) {
    const double *points = cli_block_numbers(block);
    const bool areas = asked->dim == 2 && froe_scene_group_count(asked->scene) > 0;
    froe_finds objects = {0}, groups = {0};
    froe_status status = FROE_OK;
    if (args->above || args->below) return answer_vertical_by_shards(args, asked, block, out, diag);
    if (!args->groups) status = froe_shards_locate(asked->shards, points, block->count, &asked->batch, &objects, diag);
    if (!status && (args->groups || (areas && !args->query.count)))
        status = froe_shards_groups(asked->shards, points, block->count, &asked->batch, &groups, diag);
    if (!status && (args->groups || args->query.count))
        cli_table_put_finds(out, args->groups ? &groups : &objects, args->query.count);
    else if (!status)
        put_all_finds(asked->shards, &objects, &groups, out);
    froe_finds_free(&objects);
    froe_finds_free(&groups);
    return status;
}

/* Objects with the groups they belong to, then the other groups that the point lies in. */
static void put_all(const froe_scene *scene, const froe_answers *objects, const froe_answers *groups, cli_table *out) {
    for (size_t i = 0; i < objects->queries; i++) {
        const uint32_t *found = objects->ids + objects->starts[i];
        const size_t count = objects->starts[i + 1] - objects->starts[i];
        for (size_t j = 0; j < count; j++)
            cli_table_put(out, &(cli_answer){.at = i, .object = found[j], .group = FROE_NONE});
        for (size_t j = groups->queries ? groups->starts[i] : 0; groups->queries && j < groups->starts[i + 1]; j++) {
            bool told = false; /* does one of the objects belong to the group? */
            for (size_t k = 0; k < count && !told; k++)
                told = froe_scene_object(scene, found[k]).group == groups->ids[j];
            if (!told) cli_table_put(out, &(cli_answer){.at = i, .object = FROE_NONE, .group = groups->ids[j]});
        }
    }
}

static froe_status answer_point(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                                froe_diagnostic *diag) {
    const locate_args *args = given;
    if (asked->shards) return answer_by_shards(args, asked, block, out, diag);
    const bool areas = asked->dim == 2 && froe_scene_group_count(asked->scene) > 0;
    froe_answers objects = {0}, groups = {0};
    froe_status status =
        froe_batch_locate(asked->query, cli_block_numbers(block), block->count, &asked->batch, &objects, diag);
    if (!status && areas && !args->query.count)
        status = froe_batch_groups(asked->query, cli_block_numbers(block), block->count, &asked->batch, &groups, diag);
    if (!status && args->query.count) {
        cli_table_put_lists(out, &objects, true);
    } else if (!status) {
        cli_sort_answers(&objects);
        put_all(asked->scene, &objects, &groups, out);
    }
    froe_answers_free(&objects);
    froe_answers_free(&groups);
    return status;
}

static froe_status answer_groups(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                                 froe_diagnostic *diag) {
    const locate_args *args = given;
    if (asked->shards) return answer_by_shards(args, asked, block, out, diag);
    froe_answers groups = {0};
    const froe_status status =
        froe_batch_groups(asked->query, cli_block_numbers(block), block->count, &asked->batch, &groups, diag);
    if (status) return status;
    cli_table_put_groups(out, &groups, args->query.count);
    froe_answers_free(&groups);
    return FROE_OK;
}

/* Above or below. */
static froe_status answer_vertical(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                                   froe_diagnostic *diag) {
    const locate_args *args = given;
    if (asked->shards) return answer_by_shards(args, asked, block, out, diag);
    uint32_t objects[CLI_BLOCK];
    const froe_status status = froe_batch_vertical(asked->query, cli_block_numbers(block), block->count,
                                                   args->above ? 1 : -1, &asked->batch, objects, diag);
    for (size_t i = 0; !status && i < block->count; i++) {
        const bool found = objects[i] != FROE_NONE;
        if (found || args->query.count)
            cli_table_put(out, &(cli_answer){.at = i, .object = objects[i], .group = FROE_NONE, .count = found});
    }
    return status;
}

static int run_locate(const void *given) {
    const locate_args *args = given;
    if (args->above && args->below) return cli_fail(CLI_USE, NULL, "--above: It excludes --below.");
    if (args->groups && (args->above || args->below))
        return cli_fail(CLI_USE, NULL, "--groups: It excludes --above and --below.");
    cli_queries queries = {
        .common = &args->common, .tree = &args->tree, .args = &args->query, .columns = columns, .given = args};
    static const char objects[] = "query,object,group,name,id";
    queries.answer = args->above || args->below ? answer_vertical : args->groups ? answer_groups : answer_point;
    queries.kind = args->above || args->below ? (cli_answer_kind){"query,object", objects, CLI_SHAPE_QUERY}
                   : args->groups ? (cli_answer_kind){"query,group,name", "query,group,name,id", CLI_SHAPE_QUERY}
                                  : (cli_answer_kind){"query,object,group", objects, CLI_SHAPE_QUERY};
    if (args->query.count) queries.kind = CLI_COUNTS(CLI_SHAPE_QUERY);
    return cli_queries_run(&queries);
}

const cli_command cli_command_locate = {
    .name = "locate",
    .summary = "find the objects and groups that points lie in, or what lies above or below them",
    .about =
        "Prints one line query,object,group for each object that contains a point, in the order of the points, then "
        "of the objects; group is the one the object belongs to, empty if there is none. On maps, a line with an "
        "empty object follows for each other group that the point lies in: a feature of closed rings, holes left "
        "out. With --groups, only lines query,group,name: which country is this point in? A point on a border is in "
        "all groups whose border it is; features that are lines contain only their own points. With --above or "
        "--below, one line query,object for each point that has a segment there. Objects are closed, and answers are "
        "exact. A query's number is that of its row, from 0.\n\n"
        "With --columns, each line has the columns that are named there. The command has query, object, group, name "
        "and id. " CLI_COLUMNS_ABOUT
        "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples =
        "froe locate countries.geojson --queries towns.csv --groups\nfroe locate house.glb --queries sensors.csv\n"
        "froe locate countries.geojson --queries towns.csv --groups --columns '*,name'\n"
        "froe locate map.gpkg --layer roads --queries towns.csv --above\n",
    .parts = parts,
    .defaults = &(
        const locate_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS, .query.table = CLI_TABLE_DEFAULTS},
    .size = sizeof(locate_args),
    .run = run_locate,
};
