/* tree.c: see tree.h. */
#include "args/tree.h"
#include "args/budget.h"
#include "args/crash.h"
#include "args/method.h"
#include "exit.h"
#include "files.h"
#include "progress.h"
#include "support/path.h"
#include <string.h>

const cli_option cli_tree_options[] = {
    {NULL, 0, CLI_TEXT, offsetof(cli_tree_args, scene.path), "SCENE",
     .help = "map, model or CSV file; or what froe build saved", .required = true, .file = CLI_READ},
    {0},
};

const cli_option cli_tree_build_options[] = {
    {"method", 'm', CLI_TEXT, offsetof(cli_tree_args, method), "M",
     .help = "the builder of the tree, one that froe methods lists (default: the one that suits the command)"},
    CLI_BUDGET_OPTION(cli_tree_args, max_fragments),
    {"save-tree", 0, CLI_TEXT, offsetof(cli_tree_args, save), "FILE",
     .help = "save the tree here; the command is quicker when it is given this file instead of the scene",
     .file = CLI_WRITTEN, .sentence = "froe build with -o - writes a tree there."},
    {0},
};

bool cli_is_saved_tree(const char *path) {
    return froe_is_tree(path) || !strcmp(support_path_extension(path).text, "froe");
}

/* Fails where options are given that are for building a tree. `what` is what there is instead. */
static int refuse_building(const cli_tree_args *args, const char *what) {
    const struct {
        bool given;
        const char *name;
    } options[] = {{args->scene.format, "input-format"},
                   {args->scene.layer, "layer"},
                   {args->scene.where, "where"},
                   {args->scene.faces >= 0, "faces"},
                   {args->scene.boxes, "boxes"},
                   {args->scene.wrap, "wrap"},
                   {args->method, "method"},
                   {args->save, "save-tree"}};
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (options[i].given)
            return cli_fail(CLI_USE, args->scene.path, "The %s, and --%s is for files from which a tree is built.",
                            what, options[i].name);
    return 0;
}

int cli_open_shards(const cli_tree_args *args, froe_shards **shards) {
    froe_diagnostic diag;
    const int code = refuse_building(args, "folder is one of shards");
    if (code) return code;
    const froe_status status = froe_shards_open(args->scene.path, NULL, shards, &diag);
    return status ? cli_fail_status(CLI_READING, args->scene.path, status, &diag) : 0;
}

int cli_open_saved_tree(const cli_common *common, const cli_tree_args *args, froe_tree **tree) {
    froe_diagnostic diag;
    const int code = refuse_building(args, "file is a saved tree");
    if (code) return code;
    const froe_status status = froe_tree_open(args->scene.path, NULL, tree, &diag);
    if (status) return cli_fail_status(CLI_READING, args->scene.path, status, &diag);
    cli_crash_mapped(args->scene.path);
    cli_warn_scene(common, args->scene.path, froe_tree_scene(*tree));
    return 0;
}

int cli_build_tree(const cli_common *common, const char *path, uint64_t max_fragments, froe_scene *scene,
                   froe_build_options *o, froe_tree **tree) {
    froe_diagnostic diag;
    cli_progress bar = cli_progress_begin(common, "building");
    o->seed = common->seed;
    o->max_fragments = cli_budget(max_fragments, scene);
    o->threads = (unsigned)common->threads;
    o->progress = cli_progress_step;
    o->user = &bar;
    const froe_status status = froe_build(scene, o, tree, &diag);
    cli_progress_end(&bar);
    return status ? cli_fail_build(path, max_fragments, scene, status, &diag) : 0;
}

int cli_save_tree(const froe_tree *tree, const char *path) {
    froe_diagnostic diag;
    const froe_status status = froe_tree_save(tree, path, &diag);
    return status ? cli_fail_status(CLI_WRITING, path, status, &diag) : 0;
}

int cli_open_tree(const cli_common *common, const cli_tree_args *args, const char *purpose, froe_tree **tree) {
    froe_scene *scene;
    froe_read_report reader;
    if (cli_is_saved_tree(args->scene.path)) return cli_open_saved_tree(common, args, tree);
    int code = args->method ? cli_check_method(args->method, true) : 0;
    if (!code) code = cli_read_scene(common, &args->scene, &scene, &reader);
    if (code) return code;
    froe_build_options o = froe_build_defaults();
    if (args->method) o.method = args->method;
    o.purpose = purpose;
    code = cli_build_tree(common, args->scene.path, args->max_fragments, scene, &o, tree);
    froe_scene_free(scene); /* the tree holds it */
    if (code || !args->save) return code;
    code = cli_save_tree(*tree, args->save);
    if (code) froe_tree_free(*tree);
    return code;
}

int cli_open_whole_tree(const cli_common *common, const cli_tree_args *args, const char *purpose, froe_tree **tree) {
    froe_diagnostic diag;
    const int code = cli_open_tree(common, args, purpose, tree);
    const froe_status status = code ? FROE_OK : froe_tree_check(*tree, &diag);
    if (!status) return code;
    froe_tree_free(*tree);
    return cli_fail_status(CLI_READING, args->scene.path, status, &diag);
}
