/* cmd_locate.c: froe locate, the objects and groups that points lie in, or what lies above or below them. */
#include "command.h"
#include "exit.h"
#include "queries.h"
#include "tree_report.h"
#include <stdlib.h>

typedef struct locate_args {
    cli_common common;
    cli_query_args query;
    bool groups, above, below;
} locate_args;

static const cli_column columns[] = {{"", true}, {0}};

static const cli_option options[] = {
    {NULL, 0, CLI_TEXT, offsetof(locate_args, query.tree), "TREE", .help = "a tree that froe build saved",
     .required = true},
    {"points", 0, CLI_TEXT, offsetof(locate_args, query.input), "CSV",
     .help = "the points, x,y[,z...]; - for standard input", .required = true},
    {"groups", 0, CLI_FLAG, offsetof(locate_args, groups),
     .help = "the groups each point lies in, with their names, and no objects (plane)"},
    {"above", 0, CLI_FLAG, offsetof(locate_args, above), .help = "the first segment above each point instead (plane)"},
    {"below", 0, CLI_FLAG, offsetof(locate_args, below), .help = "the first segment below"},
    {0},
};

static const cli_part parts[] = {{"Locate", options, 0},
                                 {"Queries", cli_query_options, offsetof(locate_args, query)},
                                 {"Options", cli_common_options, 0},
                                 {0}};

typedef struct locating {
    const locate_args *args;
    froe_query *query;
    const froe_scene *scene;
    uint32_t objects[CLI_BLOCK];
} locating;

static void put_group(cli_answers *out, uint32_t group) {
    if (group == FROE_NONE)
        cli_answers_none(out);
    else
        cli_answers_whole(out, group);
}

/* Does one of the objects belong to the group? */
static bool is_told(const locating *l, const uint32_t *objects, size_t count, uint32_t group) {
    for (size_t i = 0; i < count; i++)
        if (froe_scene_object(l->scene, objects[i]).group == group) return true;
    return false;
}

/* "query,object,group": objects with the groups they belong to, then the other groups that the point lies in. */
static void put_all(const locating *l, const cli_block *block, const froe_answers *objects, const froe_answers *groups,
                    cli_answers *out) {
    for (size_t i = 0; i < block->count; i++) {
        const uint32_t *found = objects->ids + objects->starts[i];
        const size_t count = objects->starts[i + 1] - objects->starts[i];
        for (size_t j = 0; j < count; j++) {
            cli_answers_whole(out, block->ids[i]);
            cli_answers_whole(out, found[j]);
            put_group(out, froe_scene_object(l->scene, found[j]).group);
            cli_answers_end(out);
        }
        for (size_t j = groups->queries ? groups->starts[i] : 0; groups->queries && j < groups->starts[i + 1]; j++) {
            if (is_told(l, found, count, groups->ids[j])) continue;
            cli_answers_whole(out, block->ids[i]);
            cli_answers_none(out);
            put_group(out, groups->ids[j]);
            cli_answers_end(out);
        }
    }
}

/* "query,group,name" */
static void put_groups(const locating *l, const cli_block *block, const froe_answers *groups, cli_answers *out) {
    for (size_t i = 0; i < block->count; i++)
        for (size_t j = groups->starts[i]; j < groups->starts[i + 1]; j++) {
            cli_answers_whole(out, block->ids[i]);
            cli_answers_whole(out, groups->ids[j]);
            cli_answers_name(out, froe_scene_group(l->scene, groups->ids[j]).name);
            cli_answers_end(out);
        }
}

static froe_status answer(void *user, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    const locating *l = user;
    const double *points = block->numbers + block->starts[0] * block->width;
    const bool areas = froe_scene_dim(l->scene) == 2 && froe_scene_group_count(l->scene) > 0;
    froe_answers objects = {0}, groups = {0};
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)l->args->common.threads;
    froe_status status = froe_batch_locate(l->query, points, block->count, &o, &objects, diag);
    if (!status && areas && !l->args->query.count)
        status = froe_batch_groups(l->query, points, block->count, &o, &groups, diag);
    if (!status && l->args->query.count) {
        cli_answers_lists(out, block->ids, &objects, true);
    } else if (!status) {
        cli_answers_sort(&objects);
        put_all(l, block, &objects, &groups, out);
    }
    froe_answers_free(&objects);
    froe_answers_free(&groups);
    return status;
}

static froe_status answer_groups(void *user, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    const locating *l = user;
    const double *points = block->numbers + block->starts[0] * block->width;
    froe_answers groups = {0};
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)l->args->common.threads;
    const froe_status status = froe_batch_groups(l->query, points, block->count, &o, &groups, diag);
    if (status) return status;
    if (l->args->query.count)
        cli_answers_lists(out, block->ids, &groups, true);
    else
        put_groups(l, block, &groups, out);
    froe_answers_free(&groups);
    return FROE_OK;
}

/* Above or below. */
static froe_status answer_vertical(void *user, const cli_block *block, cli_answers *out, froe_diagnostic *diag) {
    locating *l = user;
    const double *points = block->numbers + block->starts[0] * block->width;
    froe_batch_options o = froe_batch_defaults();
    o.threads = (unsigned)l->args->common.threads;
    const froe_status status =
        froe_batch_vertical(l->query, points, block->count, l->args->above ? 1 : -1, &o, l->objects, diag);
    for (size_t i = 0; !status && i < block->count; i++) {
        if (l->args->query.count)
            cli_answers_pair(out, block->ids[i], l->objects[i] != FROE_NONE);
        else if (l->objects[i] != FROE_NONE)
            cli_answers_pair(out, block->ids[i], l->objects[i]);
    }
    return status;
}

static const char *header(const locate_args *args) {
    if (args->query.count) return "query,count";
    if (args->groups) return "query,group,name";
    return args->above || args->below ? "query,object" : "query,object,group";
}

static int ask(const locate_args *args, const froe_tree *tree) {
    locating *l = calloc(1, sizeof *l);
    if (!l) return cli_fail(CLI_RESOURCES, NULL, "out of memory");
    l->args = args;
    l->scene = froe_tree_scene(tree);
    froe_diagnostic diag;
    const froe_status status = froe_query_new(tree, &l->query, &diag);
    if (status) {
        free(l);
        return cli_fail_status(CLI_WORKING, args->query.tree, status, &diag);
    }
    const cli_queries queries = {.common = &args->common,
                                 .args = &args->query,
                                 .columns = columns,
                                 .dim = froe_scene_dim(l->scene),
                                 .header = header(args),
                                 .answer = args->above || args->below ? answer_vertical
                                           : args->groups             ? answer_groups
                                                                      : answer,
                                 .user = l,
                                 .query = l->query};
    const int code = cli_queries_run(&queries);
    froe_query_free(l->query);
    free(l);
    return code;
}

static int run(const void *given) {
    const locate_args *args = given;
    froe_tree *tree;
    if (args->above && args->below) return cli_fail(CLI_USE, NULL, "--above and --below exclude each other");
    if (args->groups && (args->above || args->below))
        return cli_fail(CLI_USE, NULL, "--groups excludes --above and --below");
    int code = cli_open_tree(args->query.tree, &tree);
    if (code) return code;
    code = ask(args, tree);
    froe_tree_free(tree);
    return code;
}

const cli_command cli_command_locate = {
    .name = "locate",
    .summary = "find the objects and groups that points lie in, or what lies above or below them",
    .about = "Prints one line query,object,group for each object that contains a point, in the order of the points, "
             "then of the objects; group is the one the object belongs to, empty if there is none. On maps, a line "
             "with an empty object follows for each other group that the point lies in: a feature of closed rings, "
             "holes left out. With --groups, only lines query,group,name: which country is this point in? A point on a "
             "border is in all groups whose border it is; features that are lines contain only their own points. With "
             "--above or --below, one line query,object for each point that has a segment there. Objects are closed, "
             "and answers are exact. A query's number is that of its row, from 0.\n\n"
             "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples = "froe locate house.froe --points sensors.csv\nfroe locate map.froe --points towns.csv --groups\n"
                "froe locate map.froe --points towns.csv --above\n",
    .parts = parts,
    .defaults = &(const locate_args){.common = CLI_COMMON_DEFAULTS},
    .size = sizeof(locate_args),
    .run = run,
};
