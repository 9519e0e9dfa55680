/* pairs.c: froe pairs, all objects that meet, and how. */
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "queries/answers.h"
#include "queries/queries.h"
#include "report/report.h"
#include <inttypes.h>
#include <stdlib.h>

typedef struct pairs_args {
    cli_common common;
    cli_tree_args tree;
    bool count, no_corners;
} pairs_args;

static const cli_option options[] = {
    {"no-corners", 0, CLI_FLAG, offsetof(pairs_args, no_corners),
     .help = "leave out pairs that touch in nothing but one corner of both"},
    {"count", 0, CLI_FLAG, offsetof(pairs_args, count), .help = "say only how many there are of each kind"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(pairs_args),
                                 {"Pairs", options, 0},
                                 CLI_TREE_BUILD_PARTS(pairs_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

static const char *const kinds[] = {"cross", "touch", "overlap"};

typedef struct writing {
    cli_answers out;
    cli_progress bar;
    double objects;
    uint64_t counts[3];
    bool mute, stopped;
} writing;

static bool put_pair(void *user, const froe_pair *pair) {
    writing *w = user;
    w->counts[pair->kind]++;
    if (!w->mute) {
        cli_answers_whole(&w->out, pair->a);
        cli_answers_whole(&w->out, pair->b);
        cli_answers_text(&w->out, kinds[pair->kind]);
        cli_answers_end(&w->out);
    }
    w->stopped = !cli_progress_step(&w->bar, pair->a / w->objects);
    return !w->stopped;
}

static int ask(const pairs_args *args, const froe_tree *tree, writing *w) {
    froe_query *query;
    froe_diagnostic diag;
    froe_status status = froe_query_new(tree, &query, &diag);
    if (status) return cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
    w->objects = (double)froe_scene_object_count(froe_tree_scene(tree));
    w->mute = args->count || args->common.json;
    w->bar = cli_progress_begin(&args->common, "searching");
    if (!args->common.json) printf("%s\n", args->count ? "kind,count" : "a,b,kind");
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)args->common.threads;
    status = froe_batch_pairs(query, !args->no_corners, &o, put_pair, w, &diag);
    cli_progress_end(&w->bar);
    int code = 0;
    if (status) {
        code = cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
    } else if (args->common.json) {
        code = cli_report(&args->common, NULL,
                          json_pack("{s:o, s:I, s:I, s:I, s:o}", "tree", cli_name_json(args->tree.scene.path), kinds[0],
                                    (json_int_t)w->counts[0], kinds[1], (json_int_t)w->counts[1], kinds[2],
                                    (json_int_t)w->counts[2], "visited", cli_statistics_json(query)));
    } else {
        for (int i = 0; i < 3 && args->count; i++) printf("%s,%" PRIu64 "\n", kinds[i], w->counts[i]);
        cli_answers_flush(&w->out);
        code = cli_flush();
    }
    froe_query_free(query);
    return w->stopped && !status ? cli_fail(CLI_CANCELLED, NULL, "Cancelled.") : code;
}

static int run_pairs(const void *given) {
    const pairs_args *args = given;
    froe_tree *tree;
    writing *w = calloc(1, sizeof *w);
    if (!w) return cli_fail_memory();
    int code = cli_open_tree(&args->common, &args->tree, "query", &tree);
    if (!code) {
        code = ask(args, tree, w);
        froe_tree_free(tree);
    }
    free(w);
    return code;
}

const cli_command cli_command_pairs = {
    .name = "pairs",
    .summary = "find all objects that meet, and how",
    .about = "Prints one line a,b,kind for each pair of objects that have a point in common, a < b, by a, then b. "
             "They cross when their relative interiors meet in less than the dimension of either, overlap when they "
             "share a piece of the dimension of the lower one, and touch when they meet otherwise. All of it is "
             "decided exactly.",
    .examples = "froe pairs floor.geojson --no-corners\nfroe pairs house.glb --count\n",
    .parts = parts,
    .defaults = &(const pairs_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS},
    .size = sizeof(pairs_args),
    .run = run_pairs,
};
