/* export.c: froe export, parts of a tree for other programs. */
#include "args/output.h"
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "files.h"
#include "library.h"
#include "progress.h"
#include "report/report.h"

typedef struct export_args {
    cli_common common;
    cli_tree_args tree;
    cli_output output;
    int what;
    cli_reals window;
} export_args;

static const char *const whats[] = {
    [FROE_EXPORT_FRAGMENTS] = "fragments", [FROE_EXPORT_CELLS] = "cells", [FROE_EXPORT_CUTS] = "cuts", NULL};

static const cli_option options[] = {
    CLI_OUTPUT_OPTIONS(export_args, "FILE", ".geojson, .gpkg, .fgb, .shp (plane), .obj (space) or .csv (any dimension)",
                       .required = true),
    {"what", 0, CLI_CHOICE, offsetof(export_args, what), "PART", .help = "fragments (default), cells or cuts",
     .choices = whats},
    {"window", 0, CLI_REALS, offsetof(export_args, window), "LO,HI",
     .help = "clip cells and cuts to this box: lower corner, then upper (default: the scene and a tenth more)"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(export_args),
                                 {"Export", options, 0},
                                 CLI_TREE_BUILD_PARTS(export_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

static int run_export(const void *given) {
    const export_args *args = given;
    froe_tree *tree;
    cli_io io = {.export_map = froe_export};
    int code = 0;
    if (!froe_exports_own(args->output.path)) code = cli_open_io(&io);
    if (!code) code = cli_open_whole_tree(&args->common, &args->tree, NULL, &tree);
    if (code) return code;
    const size_t numbers = 2 * (size_t)froe_scene_dim(froe_tree_scene(tree));
    froe_export_options o = froe_export_defaults();
    if (args->window.count && args->window.count != numbers)
        code = cli_fail_count("window", args->window.count, numbers);
    else if (args->window.count)
        o.lo = args->window.at, o.hi = args->window.at + numbers / 2;
    if (!code) {
        cli_progress bar = cli_progress_begin(&args->common, "exporting");
        froe_diagnostic diag;
        o.progress = cli_progress_step;
        o.user = &bar;
        const froe_status status = io.export_map(tree, args->output.path, (froe_export_what)args->what, &o, &diag);
        cli_progress_end(&bar);
        if (status) code = cli_output_fail(&args->output, status, &diag);
    }
    if (!code)
        code = cli_report(&args->common, NULL,
                          json_pack("{s:o, s:s, s:o}", "tree", cli_name_json(args->tree.scene.path), "what",
                                    whats[args->what], "output", cli_name_json(args->output.name)));
    froe_tree_free(tree);
    return code;
}

const cli_command cli_command_export = {
    .name = "export",
    .summary = "write fragments, cells or cuts for other programs",
    .about = "Fragments carry object, face, group and tag of what they are pieces of, and the node they lie in. Cells "
             "are the leaves' regions, cuts the parts of cuts within their regions, both clipped to a box. Coordinates "
             "are rounded to doubles on output only.",
    .examples = "froe export floor.geojson -o pieces.geojson\nfroe export house.glb -o cells.obj --what cells\n",
    .parts = parts,
    .defaults = &(const export_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS},
    .size = sizeof(export_args),
    .run = run_export,
};
