/* build.c: froe build, from a scene to a tree and its report. */
#include "args/budget.h"
#include "args/method.h"
#include "args/order.h"
#include "args/output.h"
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "files.h"
#include "report/tree_report.h"
#include "shards/build_shards.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct build_args {
    cli_common common;
    cli_scene_args scene;
    cli_output output;
    cli_shards_args shards;
    const char *method, *order;
    char *settings;
    uint64_t leaf, max_fragments;
    int purpose; /* -1: not given */
    bool split_intersections;
} build_args;

static const char *const purposes[] = {"pieces", "query", "draw", NULL};

static const cli_option options[] = {
    {"output", 'o', CLI_OUTPUT, offsetof(build_args, output), "TREE", .file = CLI_WRITTEN,
     .help = "save the tree here (default: report only); - for standard output", .ending = "froe"},
    {"method", 'm', CLI_TEXT, offsetof(build_args, method), "M",
     .help = "a builder that froe methods lists, or auto (default), which takes the one that serves the scene best"},
    {"for", 0, CLI_CHOICE, offsetof(build_args, purpose), "USE",
     .help = "what auto chooses for: pieces (default), query or draw", .choices = purposes},
    {"leaf", 0, CLI_WHOLE, offsetof(build_args, leaf), "K",
     .help =
         "most objects in a leaf (default: the method's own, mostly 1); 0: every object ends in a cut (segments in the "
         "plane and polygons only)",
     .max = INT32_MAX},
    {"option", 0, CLI_WORDS, offsetof(build_args, settings), "NAME=VALUE",
     .help = "set an option of the method; may be given again and again"},
    {"order", 0, CLI_TEXT, offsetof(build_args, order), "FILE", .file = CLI_READ,
     .help = "take the objects in the order of this file, one id a line, instead of a random one (cylindrical)"},
    {"split-intersections", 0, CLI_FLAG, offsetof(build_args, split_intersections),
     .help = "cut polygons that cross others instead of refusing them (cylindrical): the same as --option "
             "crossing=split"},
    CLI_BUDGET_OPTION(build_args, max_fragments),
    {0},
};

static const cli_part parts[] = {
    {"Scene", cli_scene_options, offsetof(build_args, scene)},
    {"Build", options, 0},
    {"Folders", cli_shards_options, offsetof(build_args, shards)},
    {"Options", cli_common_options, 0},
    {0},
};

static int build(const build_args *args, froe_scene *scene, froe_tree **tree) {
    uint32_t *order = NULL;
    const size_t objects = froe_scene_object_count(scene);
    int code = args->order ? cli_read_order(args->order, objects, &order) : 0;
    /* The settings with what other options stand for. */
    const char *more = args->split_intersections ? "crossing=split" : "", *given = args->settings ? args->settings : "";
    const size_t size = strlen(given) + strlen(more) + 2;
    char *settings = malloc(size);
    if (!code && !settings) code = cli_fail_memory();
    if (!code) {
        snprintf(settings, size, "%s %s", given, more);
        froe_build_options o = froe_build_defaults();
        o.method = args->method;
        o.purpose = purposes[args->purpose < 0 ? 0 : args->purpose];
        o.settings = settings;
        o.order = order;
        o.order_count = order ? objects : 0;
        o.leaf = (uint32_t)args->leaf;
        code = cli_build_tree(&args->common, args->scene.path, args->max_fragments, scene, &o, tree);
    }
    free(settings);
    free(order);
    return code;
}

/* With --shards. */
static int build_folder(const build_args *args) {
    if (!args->shards.shards) return cli_fail(CLI_USE, NULL, "--memory: It needs --shards.");
    if (args->order || args->split_intersections || args->max_fragments != CLI_BUDGET_OWN)
        return cli_fail(CLI_USE, NULL, "--shards: It excludes --order, --split-intersections and --max-fragments.");
    froe_shards_options o = froe_shards_defaults();
    o.method = args->method;
    o.settings = args->settings;
    o.leaf = (uint32_t)args->leaf;
    o.seed = args->common.seed;
    o.threads = (unsigned)args->common.threads;
    return cli_build_shards(&args->common, &args->scene, &args->shards, &args->output, o);
}

static int run_build(const void *given) {
    const build_args *args = given;
    froe_scene *scene;
    froe_tree *tree = NULL;
    froe_read_report reader;
    int code = cli_check_method(args->method, true);
    const bool folder = args->shards.shards || args->shards.memory;
    if (!code && args->purpose >= 0 && (folder || strcmp(args->method, "auto") != 0))
        return cli_fail(CLI_USE, NULL, "--for: It excludes --shards and every --method but auto.");
    if (!code && folder) return build_folder(args);
    if (!code) code = cli_read_scene(&args->common, &args->scene, &scene, &reader);
    if (code) return code;
    const double start = cli_seconds();
    code = build(args, scene, &tree);
    const cli_build_seconds seconds = {.read = reader.seconds, .build = cli_seconds() - start};
    if (!code && args->output.name) code = cli_save_tree(tree, args->output.path);
    if (!code) code = cli_report_build(&args->common, args->scene.path, args->output.name, tree, seconds);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return code;
}

const cli_command cli_command_build = {
    .name = "build",
    .summary = "build a tree (a binary space partition) and report on it",
    .about = CLI_SCENE_ABOUT
    "\n\nThe report counts nodes, leaves and fragments (pieces in all leaf and in-cut lists), says what the method "
    "promises beside what came out, and how the exact predicates got their answers. The same scene, options and seed "
    "give the same tree, bit for bit, on any machine and with any number of threads.\n\n"
    "With --shards, a folder of trees takes the place of one tree, for more objects than memory holds. The commands "
    "check, range, locate, ray, near and pairs take the folder as they take a tree. Their answers are the same, with "
    "objects called by their tags. A CSV without names of groups is read in one pass, in the memory of --memory; other "
    "files are read as a whole first. The trees are those that serve queries best, unless --method says otherwise. "
    "What "
    "was in the folder stays until the new one is whole.",
    .examples = "froe build floor.geojson -o floor.froe\n"
                "froe build house.glb --method autopartition --leaf 0 --json\n"
                "froe build planet.csv --shards auto --memory 4G -o planet.froes\n"
                "froe build map.gpkg --layer roads --where \"lanes > 2\" -o roads.froe\n",
    .parts = parts,
    .defaults = &(const build_args){.common = CLI_COMMON_DEFAULTS,
                                    .method = "auto",
                                    .leaf = FROE_LEAF_OWN,
                                    .max_fragments = CLI_BUDGET_OWN,
                                    .purpose = -1},
    .size = sizeof(build_args),
    .run = run_build,
};
