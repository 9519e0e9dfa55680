/* ray.c: froe ray, what rays meet. */
#include "command.h"
#include "exit.h"
#include "queries/queries.h"
#include "support/fail.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct ray_args {
    cli_common common;
    cli_tree_args tree;
    cli_query_args query;
    bool all;
    double t_max;
} ray_args;

static const cli_column columns[] = {{"o", true}, {"d", true}, {0}};

static const cli_option options[] = {
    {"queries", 0, CLI_TEXT, offsetof(ray_args, query.input), "CSV", .file = CLI_READ,
     .help = "the rays, ox,oy[,oz...],dx,dy[,dz...]; - for standard input", .required = true, .alias = "rays"},
    {"all", 0, CLI_FLAG, offsetof(ray_args, all), .help = "all objects met, not only the first"},
    {"t-max", 0, CLI_REAL, offsetof(ray_args, t_max), "T",
     .help = "where rays end, in lengths of their directions (default: nowhere)"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(ray_args),
                                 {"Ray", options, 0},
                                 CLI_QUERY_PARTS(ray_args),
                                 CLI_TREE_BUILD_PARTS(ray_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

/* Rays asked of a folder. */
static froe_status answer_by_shards(const ray_args *args, const cli_asked *asked, const double *origins,
                                    const double *directions, size_t count, cli_table *out, froe_diagnostic *diag) {
    froe_finds all = {0};
    froe_find *firsts = malloc(count * sizeof *firsts + 1);
    if (!firsts) return support_fail_memory(diag);
    const froe_status status =
        args->all
            ? froe_shards_ray_all(asked->shards, origins, directions, count, args->t_max, &asked->batch, &all, diag)
            : froe_shards_ray(asked->shards, origins, directions, count, args->t_max, &asked->batch, firsts, diag);
    if (!status && args->all) cli_table_put_finds(out, &all, args->query.count);
    if (!status && !args->all) cli_table_put_firsts(out, firsts, count, args->query.count);
    froe_finds_free(&all);
    free(firsts);
    return status;
}

static froe_status answer_ray(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                              froe_diagnostic *diag) {
    const ray_args *args = given;
    const size_t count = block->count, dim = asked->dim;
    const double *row = cli_block_numbers(block);
    double *origins = malloc(count * dim * sizeof *origins), *directions = malloc(count * dim * sizeof *directions);
    froe_hit *first = malloc(count * sizeof *first); /* what each ray meets first */
    froe_answers all = {0};
    froe_status status = origins && directions && first ? FROE_OK : support_fail_memory(diag);
    for (size_t i = 0; i < count && !status; i++, row += block->width) {
        memcpy(origins + i * dim, row, dim * sizeof *row);
        memcpy(directions + i * dim, row + dim, dim * sizeof *row);
    }
    if (!status && asked->shards)
        status = answer_by_shards(args, asked, origins, directions, count, out, diag);
    else if (!status && args->all)
        status = froe_batch_ray_all(asked->query, origins, directions, count, args->t_max, &asked->batch, &all, diag);
    else if (!status)
        status = froe_batch_ray(asked->query, origins, directions, count, args->t_max, &asked->batch, first, diag);
    for (size_t i = 0; i < count && !status && !asked->shards; i++) {
        const size_t begin = args->all ? all.starts[i] : 0;
        const size_t end = args->all ? all.starts[i + 1] : first[i].object != FROE_NONE;
        if (args->query.count) cli_table_put(out, &(cli_answer){.at = i, .object = FROE_NONE, .count = end - begin});
        for (size_t j = begin; j < end && !args->query.count; j++)
            cli_table_put(out, &(cli_answer){.at = i,
                                             .object = args->all ? all.ids[j] : first[i].object,
                                             .group = FROE_NONE,
                                             .value = args->all ? all.values[j] : first[i].t});
    }
    froe_answers_free(&all);
    free(origins), free(directions), free(first);
    return status;
}

static int run_ray(const void *given) {
    const ray_args *args = given;
    if (args->t_max < 0) return cli_fail(CLI_USE, NULL, "--t-max: '%g' is not a number >= 0.", args->t_max);
    const cli_queries queries = {.common = &args->common,
                                 .tree = &args->tree,
                                 .args = &args->query,
                                 .columns = columns,
                                 .kind = args->query.count
                                             ? CLI_COUNTS(CLI_SHAPE_NONE)
                                             : (cli_answer_kind){"query,object,t",
                                                                 "query,object,group,name,id,t,distance,point,normal",
                                                                 CLI_SHAPE_HIT},
                                 .answer = answer_ray,
                                 .given = args};
    return cli_queries_run(&queries);
}

const cli_command cli_command_ray = {
    .name = "ray",
    .summary = "find what rays meet",
    .about =
        "Prints one line query,object,t for each ray that meets an object: the first one, met at origin + t "
        "direction; of several met at the same point, the one with the lowest number. With --all one line for each "
        "object met, by t, then object. Objects are closed, the order is decided exactly, and t is the double "
        "nearest to the exact parameter. A query's number is that of its row, from 0.\n\n"
        "With --columns, each line has the columns that are named there. The command has query, object, group, name, "
        "id, t, distance, point "
        "(where it is met) and normal (of length 1, of the face that is met). " CLI_COLUMNS_ABOUT
        "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples = "froe ray house.glb --queries sight.csv\nfroe ray floor.geojson --queries beams.csv --all --t-max 1\n",
    .parts = parts,
    .defaults = &(const ray_args){.common = CLI_COMMON_DEFAULTS,
                                  .tree = CLI_TREE_DEFAULTS,
                                  .query.table = CLI_TABLE_DEFAULTS,
                                  .t_max = INFINITY},
    .size = sizeof(ray_args),
    .run = run_ray,
};
