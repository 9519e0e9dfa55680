/* cmd_ray.c: froe ray, what rays meet. */
#include "command.h"
#include "exit.h"
#include "queries.h"
#include "tree_report.h"
#include <math.h>
#include <stdlib.h>

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

typedef struct shooting {
    const ray_args *args;
    froe_query *query;
    size_t dim;
    double *origins, *directions; /* of a block */
    froe_hit *hits;
    size_t room;
} shooting;

static void put_hit(cli_answers *out, uint64_t id, const froe_hit *hit) {
    cli_answers_whole(out, id);
    cli_answers_whole(out, hit->object);
    cli_answers_real(out, hit->t);
    cli_answers_end(out);
}

/* The numbers of a block, origins and directions apart. */
static bool part_numbers(shooting *s, const cli_block *block) {
    if (block->count > s->room) {
        free(s->origins), free(s->directions), free(s->hits);
        s->origins = malloc(block->count * s->dim * sizeof *s->origins);
        s->directions = malloc(block->count * s->dim * sizeof *s->directions);
        s->hits = malloc(block->count * sizeof *s->hits);
        s->room = s->origins && s->directions && s->hits ? block->count : 0;
        if (!s->room) return false;
    }
    for (size_t i = 0; i < block->count; i++)
        for (size_t k = 0; k < s->dim; k++) {
            const double *row = block->numbers + block->starts[i] * block->width;
            s->origins[i * s->dim + k] = row[k];
            s->directions[i * s->dim + k] = row[s->dim + k];
        }
    return true;
}

static froe_status answer_first(shooting *s, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)s->args->common.threads;
    const froe_status status =
        froe_batch_ray(s->query, s->origins, s->directions, block->count, s->args->t_max, &o, s->hits, diag);
    if (status) return status;
    for (size_t i = 0; i < block->count; i++) {
        if (s->args->query.count)
            cli_answers_pair(out, block->ids[i], s->hits[i].object != FROE_NONE);
        else if (s->hits[i].object != FROE_NONE)
            put_hit(out, block->ids[i], &s->hits[i]);
    }
    return FROE_OK;
}

static froe_status answer_all(shooting *s, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    froe_answers met = {0};
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)s->args->common.threads;
    const froe_status status =
        froe_batch_ray_all(s->query, s->origins, s->directions, block->count, s->args->t_max, &o, &met, diag);
    if (status) return status;
    if (s->args->query.count) {
        cli_answers_lists(out, block->ids, &met, true);
    } else {
        for (size_t i = 0; i < block->count; i++)
            for (size_t j = met.starts[i]; j < met.starts[i + 1]; j++)
                put_hit(out, block->ids[i], &(froe_hit){met.ids[j], met.values[j]});
    }
    froe_answers_free(&met);
    return FROE_OK;
}

static froe_status answer(void *user, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    shooting *s = user;
    if (!part_numbers(s, block)) {
        *diag = (froe_diagnostic){FROE_E_MEMORY, FROE_NONE, FROE_NONE, FROE_NONE, "out of memory"};
        return FROE_E_MEMORY;
    }
    return s->args->all ? answer_all(s, block, out, diag) : answer_first(s, block, out, diag);
}

static int ask(const ray_args *args, const froe_tree *tree) {
    shooting s = {.args = args, .dim = (size_t)froe_scene_dim(froe_tree_scene(tree))};
    froe_diagnostic diag;
    const froe_status status = froe_query_new(tree, &s.query, &diag);
    if (status) return cli_fail_status(CLI_WORKING, args->query.tree, status, &diag);
    const cli_queries queries = {.common = &args->common,
                                 .args = &args->query,
                                 .columns = columns,
                                 .dim = (int)s.dim,
                                 .header = args->query.count ? "query,count" : "query,object,t",
                                 .answer = answer,
                                 .user = &s,
                                 .query = s.query};
    const int code = cli_queries_run(&queries);
    froe_query_free(s.query);
    free(s.origins);
    free(s.directions);
    free(s.hits);
    return code;
}

static int run(const void *given) {
    const ray_args *args = given;
    froe_tree *tree;
    if (args->t_max < 0) return cli_fail(CLI_USE, NULL, "--t-max must not be negative");
    int code = cli_open_tree(args->query.tree, &tree);
    if (code) return code;
    code = ask(args, tree);
    froe_tree_free(tree);
    return code;
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
    .run = run,
};
