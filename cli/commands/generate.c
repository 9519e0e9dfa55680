/* generate.c: froe generate, scenes for tests and benches. */
#include "args/output.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"
#include "support/fail.h"
#include <froe/io.h>
#include <string.h>

typedef struct generate_args {
    cli_common common;
    const char *kind;
    cli_output output;
    uint64_t n;
    bool list;
} generate_args;

static const cli_option options[] = {
    {NULL, 0, CLI_TEXT, offsetof(generate_args, kind), "KIND", .help = "what to make; --list tells what there is"},
    {"number", 'n', CLI_WHOLE, offsetof(generate_args, n), "N", .help = "how many objects, about (default 1000)",
     .min = 1, .max = UINT32_MAX},
    CLI_OUTPUT_OPTIONS(generate_args, "FILE",
                       ".geojson (plane), .csv (all but polygons), .off or .obj (polygons), .mfjson (moving)",
                       .required = false),
    {"list", 0, CLI_FLAG, offsetof(generate_args, list), .help = "list the usual kinds; --list all: every kind"},
    {0},
};

static const cli_part parts[] = {{"Generate", options, 0}, {"Options", cli_common_options, 0}, {0}};

static void append_kind(json_t *kinds, const char *name, int dim, const char *kind, const char *summary) {
    json_array_append_new(
        kinds, json_pack("{s:s, s:i, s:s, s:s}", "name", name, "dim", dim, "kind", kind, "summary", summary));
}

static int list_kinds(const generate_args *args) {
    const bool all = args->kind != NULL;
    if (all && strcmp(args->kind, "all") != 0) return cli_fail(CLI_USE, NULL, "--list: '%s' is not 'all'.", args->kind);
    json_t *kinds = json_array();
    const froe_generator_info *g;
    for (size_t i = 0; (g = froe_generator_at(i)) != NULL; i++)
        if (all || g->usual) append_kind(kinds, g->name, g->dim, froe_kind_name(g->kind), g->summary);
    const froe_motion_generator_info *moving;
    for (size_t i = 0; (moving = froe_motion_generator_at(i)) != NULL; i++)
        if (all || moving->usual) append_kind(kinds, moving->name, moving->dim, "moving", moving->summary);
    return cli_report(&args->common, NULL, json_pack("{s:o}", "kinds", kinds));
}

/* Is there such a kind, and are its objects moving? Returns an exit code. */
static int find_kind(const char *kind, bool *moving) {
    enum { MOST = 128 };
    const char *names[MOST];
    size_t count = 0, still;
    const froe_generator_info *g;
    for (size_t i = 0; (g = froe_generator_at(i)) != NULL && count < MOST; i++) /* one way: there are fewer */
        names[count++] = g->name;
    still = count;
    const froe_motion_generator_info *m;
    for (size_t i = 0; (m = froe_motion_generator_at(i)) != NULL && count < MOST; i++) /* one way: as above */
        names[count++] = m->name;
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], kind) == 0) {
            *moving = i >= still;
            return 0;
        }
    const char *hint = cli_nearest(kind, names, count);
    return cli_fail_unknown("kind", kind, hint, hint ? NULL : "froe generate --list all lists what there is.");
}

static int run_generate(const void *given) {
    const generate_args *args = given;
    if (args->list) return list_kinds(args);
    if (!args->kind) return cli_fail(CLI_USE, NULL, "KIND is missing. froe generate --list lists what there is.");
    bool moving = false;
    int code = find_kind(args->kind, &moving);
    if (code) return code;
    if (!args->output.name)
        return cli_fail(CLI_USE, NULL, "-o FILE is missing. froe generate --help lists what there is.");
    froe_motion *motion = NULL;
    froe_scene *scene = NULL;
    froe_diagnostic diag = {0};
    const size_t n = (size_t)args->n;
    froe_status status = moving ? froe_generate_motion(args->kind, n, args->common.seed, NULL, &motion, &diag)
                                : froe_generate(args->kind, n, args->common.seed, NULL, &scene, &diag);
    if (status) return cli_fail_status(CLI_WORKING, NULL, status, &diag);
    status = cli_interrupted() ? support_fail_cancelled(&diag)
             : moving          ? froe_write_motion(motion, args->output.path, &diag)
                               : froe_write_scene(scene, args->output.path, &diag);
    const size_t objects = moving ? froe_motion_object_count(motion) : froe_scene_object_count(scene);
    code = status ? cli_output_fail(&args->output, status, &diag)
                  : cli_report(&args->common, NULL,
                               json_pack("{s:s, s:i, s:I, s:I, s:o}", "kind", args->kind, "dim",
                                         moving ? 2 : froe_scene_dim(scene), "objects", (json_int_t)objects, "seed",
                                         (json_int_t)args->common.seed, "output", cli_name_json(args->output.name)));
    froe_motion_free(motion);
    froe_scene_free(scene);
    return code;
}

const cli_command cli_command_generate = {
    .name = "generate",
    .summary = "make scenes for tests and benches",
    .about = "The same kind, number and seed give the same file, bit for bit, on any machine. Files are written with "
             "all digits, so that reading them gives the scene back exactly.",
    .examples = "froe generate --list\nfroe generate segments -n 100000 --seed 7 -o segments.geojson\n",
    .parts = parts,
    .defaults = &(const generate_args){.common = CLI_COMMON_DEFAULTS, .n = 1000},
    .size = sizeof(generate_args),
    .run = run_generate,
};
