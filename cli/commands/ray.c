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
    cli_query_args query;
    bool all;
    double t_max;
} ray_args;

static const cli_column columns[] = {{"o", true}, {"d", true}, {0}};

static const cli_option options[] = {
    {NULL, 0, CLI_TEXT, offsetof(ray_args, query.tree), "TREE", .help = "a tree that froe build saved",
     .required = true},
    {"rays", 0, CLI_TEXT, offsetof(ray_args, query.input), "CSV",
     .help = "the rays, ox,oy[,oz...],dx,dy[,dz...]; - for standard input", .required = true},
    {"all", 0, CLI_FLAG, offsetof(ray_args, all), .help = "all objects met, not only the first"},
    {"t-max", 0, CLI_REAL, offsetof(ray_args, t_max), "T",
     .help = "where rays end, in lengths of their directions (default: nowhere)"},
    {0},
};

static const cli_part parts[] = {{"Ray", options, 0},
                                 {"Queries", cli_query_options, offsetof(ray_args, query)},
                                 {"Options", cli_common_options, 0},
                                 {0}};

/* The rays of a block, and what they meet first. */
typedef struct flight {
    double *origins, *directions;
    froe_hit *hits;
} flight;

static void put_hit(cli_answers *out, uint64_t id, const froe_hit *hit) {
    cli_answers_whole(out, id);
    cli_answers_whole(out, hit->object);
    cli_answers_real(out, hit->t);
    cli_answers_end(out);
}

static bool take_rays(flight *f, const cli_block *block, size_t dim) {
    const double *row = cli_block_numbers(block);
    f->origins = malloc(block->count * dim * sizeof *f->origins);
    f->directions = malloc(block->count * dim * sizeof *f->directions);
    f->hits = malloc(block->count * sizeof *f->hits);
    if (!f->origins || !f->directions || !f->hits) return false;
    for (size_t i = 0; i < block->count; i++, row += block->width) {
        memcpy(f->origins + i * dim, row, dim * sizeof *row);
        memcpy(f->directions + i * dim, row + dim, dim * sizeof *row);
    }
    return true;
}

static void give_rays(flight *f) {
    free(f->origins);
    free(f->directions);
    free(f->hits);
}

static froe_status answer_first(const ray_args *args, const cli_asked *asked, const cli_block *block, const flight *f,
                                cli_answers *out, froe_diagnostic *diag) {
    const froe_status status = froe_batch_ray(asked->query, f->origins, f->directions, block->count, args->t_max,
                                              &asked->batch, f->hits, diag);
    if (status) return status;
    for (size_t i = 0; i < block->count; i++) {
        if (args->query.count)
            cli_answers_pair(out, block->ids[i], f->hits[i].object != FROE_NONE);
        else if (f->hits[i].object != FROE_NONE)
            put_hit(out, block->ids[i], &f->hits[i]);
    }
    return FROE_OK;
}

static froe_status answer_all(const ray_args *args, const cli_asked *asked, const cli_block *block, const flight *f,
                              cli_answers *out, froe_diagnostic *diag) {
    froe_answers met = {0};
    const froe_status status = froe_batch_ray_all(asked->query, f->origins, f->directions, block->count, args->t_max,
                                                  &asked->batch, &met, diag);
    if (status) return status;
    if (args->query.count) {
        cli_answers_lists(out, block->ids, &met, true);
    } else {
        for (size_t i = 0; i < block->count; i++)
            for (size_t j = met.starts[i]; j < met.starts[i + 1]; j++)
                put_hit(out, block->ids[i], &(froe_hit){met.ids[j], met.values[j]});
    }
    froe_answers_free(&met);
    return FROE_OK;
}

static froe_status answer_ray(const void *given, const cli_asked *asked, const cli_block *block, cli_answers *out,
                              froe_diagnostic *diag) {
    const ray_args *args = given;
    flight f;
    const froe_status status = !take_rays(&f, block, asked->dim) ? support_fail_memory(diag)
                               : args->all                       ? answer_all(args, asked, block, &f, out, diag)
                                                                 : answer_first(args, asked, block, &f, out, diag);
    give_rays(&f);
    return status;
}

static int run_ray(const void *given) {
    const ray_args *args = given;
    if (args->t_max < 0) return cli_fail(CLI_USE, NULL, "--t-max: '%g' is not a number >= 0.", args->t_max);
    const cli_queries queries = {.common = &args->common,
                                 .args = &args->query,
                                 .columns = columns,
                                 .header = args->query.count ? "query,count" : "query,object,t",
                                 .answer = answer_ray,
                                 .given = args};
    return cli_queries_run(&queries);
}

const cli_command cli_command_ray = {
    .name = "ray",
    .summary = "find what rays meet",
    .about = "Prints one line query,object,t for each ray that meets an object: the first one, met at origin + t "
             "direction; of several met at the same point, the one with the lowest number. With --all one line for "
             "each object met, by t, then object. Objects are closed, the order is decided exactly, and t is the "
             "double nearest to the exact parameter. A query's number is that of its row, from 0.\n\n"
             "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples = "froe ray house.froe --rays sight.csv\nfroe ray floor.froe --rays beams.csv --all --t-max 1\n",
    .parts = parts,
    .defaults = &(const ray_args){.common = CLI_COMMON_DEFAULTS, .t_max = INFINITY},
    .size = sizeof(ray_args),
    .run = run_ray,
};
