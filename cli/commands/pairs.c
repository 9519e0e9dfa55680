/* pairs.c: froe pairs, all objects that meet, and how. */
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "queries/queries.h"
#include "report/report.h"
#include "support/fail.h"
#include <stdlib.h>

typedef struct pairs_args {
    cli_common common;
    cli_tree_args tree;
    cli_table_args table;
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
                                 {"Answers", cli_table_options, offsetof(pairs_args, table)},
                                 CLI_TREE_BUILD_PARTS(pairs_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

static const cli_answer_kind pairs_kind = {"a,b,kind", "a,b,kind,a_group,a_name,a_id,b_group,b_name,b_id",
                                           CLI_SHAPE_PAIR},
                             counts_kind = {"kind,count", "kind,count", CLI_SHAPE_NONE};

static const char *const kinds[] = {"cross", "touch", "overlap"};

typedef struct writing {
    cli_table table;
    cli_progress bar;
    double objects;
    uint64_t counts[3];
    bool mute, stopped;
} writing;

static bool put_pair(void *user, const froe_pair *pair) {
    writing *w = user;
    w->counts[pair->kind]++;
    if (!w->mute)
        cli_table_put(
            &w->table,
            &(cli_answer){.object = pair->a, .other = pair->b, .group = FROE_NONE, .kind = kinds[pair->kind]});
    w->stopped = !cli_progress_step(&w->bar, pair->a / w->objects);
    return !w->stopped;
}

static bool put_found_pair(void *user, const froe_found_pair *pair) {
    writing *w = user;
    w->counts[pair->kind]++;
    if (!w->mute)
        cli_table_put(&w->table, &(cli_answer){.object = pair->a.object,
                                               .other = pair->b.object,
                                               .group = FROE_NONE,
                                               .kind = kinds[pair->kind],
                                               .find = &pair->a});
    w->stopped = cli_interrupted();
    return !w->stopped && !w->table.status;
}

static int report_pairs(const pairs_args *args, const writing *w) {
    return cli_report(&args->common, NULL,
                      json_pack("{s:o, s:I, s:I, s:I, s:o}", "tree", cli_name_json(args->tree.scene.path), kinds[0],
                                (json_int_t)w->counts[0], kinds[1], (json_int_t)w->counts[1], kinds[2],
                                (json_int_t)w->counts[2], "visited", cli_statistics_json(w->table.query)));
}

/* Finds the pairs, for the table that is open. */
static int put_pairs(const pairs_args *args, writing *w) {
    froe_diagnostic diag;
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)args->common.threads;
    w->objects = (double)froe_scene_object_count(w->table.scene);
    w->mute = args->count || args->common.json;
    w->bar = cli_progress_begin(&args->common, "searching");
    froe_status status = w->table.shards
                             ? froe_shards_pairs(w->table.shards, !args->no_corners, &o, put_found_pair, w, &diag)
                             : froe_batch_pairs(w->table.query, !args->no_corners, &o, put_pair, w, &diag);
    cli_progress_end(&w->bar);
    for (int i = 0; i < 3 && args->count && !status; i++)
        cli_table_put(&w->table, &(cli_answer){.kind = kinds[i], .count = w->counts[i]});
    const int closed = cli_table_close(&w->table, status != FROE_OK);
    if (!status && w->table.status) status = support_fail_memory(&diag);
    if (status) return cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
    const int reported = args->common.json ? report_pairs(args, w) : 0;
    if (w->stopped) return cli_fail_cancelled(NULL);
    return closed ? closed : reported;
}

static int ask(const pairs_args *args, const froe_tree *tree, writing *w) {
    froe_query *query;
    froe_diagnostic diag;
    const froe_status status = froe_query_new(tree, &query, &diag);
    if (status) return cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
    int code = cli_table_open(&args->common, &args->table, args->count ? &counts_kind : &pairs_kind, NULL,
                              froe_tree_scene(tree), query, &w->table);
    if (!code) code = put_pairs(args, w);
    froe_query_free(query);
    return code;
}

static int ask_folder(const pairs_args *args, writing *w) {
    const cli_answer_kind *kind = args->count ? &counts_kind : &pairs_kind;
    const froe_scene *scene;
    froe_shards *shards;
    int code = cli_open_shards(&args->tree, &shards);
    if (code) return code;
    code = cli_scene_of_shards(args->tree.scene.path, shards, &scene);
    if (!code) code = cli_table_open(&args->common, &args->table, kind, NULL, scene, NULL, &w->table);
    w->table.shards = shards;
    if (!code) code = put_pairs(args, w);
    froe_shards_close(shards);
    return code;
}

static int run_pairs(const void *given) {
    const pairs_args *args = given;
    froe_tree *tree;
    writing *w = calloc(1, sizeof *w);
    if (!w) return cli_fail_memory();
    if (froe_is_shards(args->tree.scene.path)) {
        const int asked = ask_folder(args, w);
        free(w);
        return asked;
    }
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
    .about =
        "Prints one line a,b,kind for each pair of objects that have a point in common, a < b, by a, then b. They "
        "cross when their relative interiors meet in less than the dimension of either, overlap when they share a "
        "piece of the dimension of the lower one, and touch when they meet otherwise. All of it is decided exactly. "
        "With --columns, each line has the columns that are named there: a, b, kind, and of the two objects a_group, "
        "a_name, "
        "a_id, b_group, b_name and b_id.",
    .examples = "froe pairs floor.geojson --no-corners\nfroe pairs house.glb --count\n",
    .parts = parts,
    .defaults =
        &(const pairs_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS, .table = CLI_TABLE_DEFAULTS},
    .size = sizeof(pairs_args),
    .run = run_pairs,
};
