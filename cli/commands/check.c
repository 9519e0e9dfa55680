/* check.c: froe check, the exact audit of a tree. */
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"

typedef struct check_args {
    cli_common common;
    cli_tree_args tree;
    bool exact;
} check_args;

static const cli_option options[] = {
    {"exact", 0, CLI_FLAG, offsetof(check_args, exact),
     .help = "bypass every floating-point filter: slow, and the answer must be the same"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(check_args),
                                 {"Check", options, 0},
                                 CLI_TREE_BUILD_PARTS(check_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

static json_t *id_json(uint32_t id) {
    return id == FROE_NONE ? json_null() : json_integer((json_int_t)id);
}

/* A folder: what the manifest says, then each tree. */
static int check_folder(const check_args *args) {
    const char *path = args->tree.scene.path;
    froe_shards *shards;
    froe_diagnostic diag;
    int code = cli_open_shards(&args->tree, &shards);
    if (code) return code;
    const double start = cli_seconds();
    const froe_shards_info info = froe_shards_about(shards);
    cli_progress bar = cli_progress_begin(&args->common, "auditing");
    froe_audit_options o = froe_audit_defaults();
    o.exact_only = args->exact;
    o.threads = (unsigned)args->common.threads;
    froe_status status = froe_shards_check(shards, NULL, &diag);
    for (uint32_t i = 0; i < info.shards && !status; i++) {
        const froe_tree *tree;
        status = froe_shards_tree(shards, i, &tree, &diag);
        if (!status && tree) status = froe_tree_audit(tree, &o, &diag);
        if (!status && !cli_progress_step(&bar, (i + 1.0) / info.shards)) status = FROE_E_CANCELLED;
    }
    cli_progress_end(&bar);
    froe_shards_close(shards);
    if (status) return cli_fail_status(CLI_WORKING, path, status, &diag);
    char headline[400];
    snprintf(headline, sizeof headline, "%.200s: every invariant of every shard holds", path);
    return cli_report(&args->common, headline,
                      json_pack("{s:o, s:b, s:i, s:I, s:I, s:I, s:f}", "folder", cli_name_json(path), "ok", 1, "dim",
                                info.dim, "shards", (json_int_t)info.shards, "objects", (json_int_t)info.objects,
                                "copies", (json_int_t)info.copies, "seconds", cli_seconds() - start));
}

static int run_check(const void *given) {
    const check_args *args = given;
    if (froe_is_shards(args->tree.scene.path)) return check_folder(args);
    froe_tree *tree;
    int code = cli_open_tree(&args->common, &args->tree, NULL, &tree);
    if (code) return code;
    const double start = cli_seconds();
    cli_progress bar = cli_progress_begin(&args->common, "auditing");
    froe_audit_options o = froe_audit_defaults();
    o.exact_only = args->exact;
    o.threads = (unsigned)args->common.threads;
    o.progress = cli_progress_step;
    o.user = &bar;
    froe_diagnostic diag;
    const froe_status status = froe_tree_audit(tree, &o, &diag);
    cli_progress_end(&bar);
    const double seconds = cli_seconds() - start;
    if (status == FROE_OK) {
        const froe_report r = froe_tree_report(tree);
        char headline[400];
        snprintf(headline, sizeof headline, "%.200s: every invariant holds", args->tree.scene.path);
        code = cli_report(&args->common, headline,
                          json_pack("{s:o, s:b, s:s, s:i, s:I, s:I, s:I, s:I, s:f}", "tree",
                                    cli_name_json(args->tree.scene.path), "ok", 1, "method", r.method, "dim", r.dim,
                                    "objects", (json_int_t)r.objects, "nodes", (json_int_t)r.nodes, "fragments",
                                    (json_int_t)r.fragments, "height", (json_int_t)r.height, "seconds", seconds));
    } else {
        code = cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
    }
    if (status == FROE_E_AUDIT && args->common.json) { /* a violation goes to stdout, too */
        const int written =
            cli_report(&args->common, NULL,
                       json_pack("{s:o, s:b, s:{s:s, s:o, s:o, s:o}}", "tree", cli_name_json(args->tree.scene.path),
                                 "ok", 0, "violation", "message", diag.message, "object", id_json(diag.object),
                                 "corner", id_json(diag.corner), "axis", id_json(diag.axis)));
        if (written) code = written;
    }
    froe_tree_free(tree);
    return code;
}

const cli_command cli_command_check = {
    .name = "check",
    .summary = "prove, exactly, that a tree is right",
    .about = "Proves, without the code that built the tree, that the tree is right. Every object is exactly the union "
             "of its pieces. Each list of the tree holds exactly the pieces that a comparison of all objects with all "
             "cells puts there. Pieces that lie in a cut are listed at that cut. No leaf holds more than its capacity, "
             "every index is valid, and the promises of the method that built the tree hold.\n\n"
             "The exit code is 0 when all of it holds and 1, with the first violation, when it does not.",
    .examples = "froe check floor.froe\nfroe check house.glb --method density --exact --json\n",
    .parts = parts,
    .defaults = &(const check_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS},
    .size = sizeof(check_args),
    .run = run_check,
};
