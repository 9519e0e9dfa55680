/* generate.c: froe generate, scenes for tests and benches. */
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"
#include "support/fail.h"
#include <froe/io.h>
#include <string.h>

typedef struct generate_args {
    cli_common common;
    const char *kind, *output;
    uint64_t n;
    bool list;
} generate_args;

static const cli_option options[] = {
    {NULL, 0, CLI_TEXT, offsetof(generate_args, kind), "KIND", .help = "what to make; --list tells what there is"},
    {"number", 'n', CLI_WHOLE, offsetof(generate_args, n), "N", .help = "how many objects, about (default 1000)",
     .min = 1, .max = UINT32_MAX},
    {"output", 'o', CLI_TEXT, offsetof(generate_args, output), "FILE",
     .help = ".geojson (plane), .csv (points, boxes, balls), .off or .obj (polygons), .mfjson (moving)"},
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
        if (all || moving->usual) append_kind(kinds, moving->name, 2, "moving", moving->summary);
    return cli_report(&args->common, NULL, json_pack("{s:o}", "kinds", kinds));
}

static int check_kind(const char *kind) {
    enum { MOST = 128 };
    const char *names[MOST];
    size_t count = 0;
    const froe_generator_info *g;
    for (size_t i = 0; (g = froe_generator_at(i)) != NULL && count < MOST; i++) {
        if (strcmp(g->name, kind) == 0) return 0;
        names[count++] = g->name;
    }
    const froe_motion_generator_info *moving;
    for (size_t i = 0; (moving = froe_motion_generator_at(i)) != NULL && count < MOST; i++) {
        if (strcmp(moving->name, kind) == 0) return 0;
        names[count++] = moving->name;
    }
    const char *hint = cli_nearest(kind, names, count);
    return cli_fail_unknown("kind", kind, hint, hint ? NULL : "froe generate --list all lists what there is.");
}

static bool is_moving(const char *kind) {
    const froe_motion_generator_info *g;
    for (size_t i = 0; (g = froe_motion_generator_at(i)) != NULL; i++)
        if (strcmp(g->name, kind) == 0) return true;
    return false;
}

static int report(const generate_args *args, int dim, size_t objects) {
    return cli_report(&args->common, NULL,
                      json_pack("{s:s, s:i, s:I, s:I, s:o}", "kind", args->kind, "dim", dim, "objects",
                                (json_int_t)objects, "seed", (json_int_t)args->common.seed, "output",
                                cli_name_json(args->output)));
}

static int generate_motion(const generate_args *args) {
    froe_motion *motion;
    froe_diagnostic diag = {0};
    froe_status status = froe_generate_motion(args->kind, (size_t)args->n, args->common.seed, NULL, &motion, &diag);
    if (status) return cli_fail_status(CLI_WORKING, NULL, status, &diag);
    status = cli_interrupted() ? support_fail_cancelled(&diag) : froe_write_motion(motion, args->output, &diag);
    const int code = status ? cli_fail_status(CLI_WRITING, args->output, status, &diag)
                            : report(args, 2, froe_motion_object_count(motion));
    froe_motion_free(motion);
    return code;
}

static int generate(const generate_args *args) {
    froe_scene *scene;
    froe_diagnostic diag = {0};
    froe_status status = froe_generate(args->kind, (size_t)args->n, args->common.seed, NULL, &scene, &diag);
    if (status) return cli_fail_status(CLI_WORKING, NULL, status, &diag);
    status = cli_interrupted() ? support_fail_cancelled(&diag) : froe_write_scene(scene, args->output, &diag);
    const int code = status ? cli_fail_status(CLI_WRITING, args->output, status, &diag)
                            : report(args, froe_scene_dim(scene), froe_scene_object_count(scene));
    froe_scene_free(scene);
    return code;
}

static int run_generate(const void *given) {
    const generate_args *args = given;
    if (args->list) return list_kinds(args);
    if (!args->kind) return cli_fail(CLI_USE, NULL, "KIND: It is missing. froe generate --list lists what there is.");
    const int code = check_kind(args->kind);
    if (code) return code;
    if (!args->output) return cli_fail(CLI_USE, NULL, "-o FILE: It is missing. --help lists what there is.");
    return is_moving(args->kind) ? generate_motion(args) : generate(args);
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
