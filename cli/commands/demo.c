/* demo.c: froe demo, the main job on real scenes that the program carries.
 *
 * The demo runs froe's own commands, the very lines that its page shows, in the
 * folder of the demo; their reports are printed and become the page's tables. */
#include "command.h"
#include "demo/page.h"
#include "demo/redirect.h"
#include "embedded.h"
#include "exit.h"
#include "files.h"
#include "progress.h"
#include "report/report.h"
#include <errno.h>
#include <fcntl.h>
#include <froe/froe.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct demo_args {
    cli_common common;
    const char *output;
} demo_args;

static const cli_option options[] = {
    {"output", 'o', CLI_TEXT, offsetof(demo_args, output), "DIR", .file = CLI_WRITTEN,
     .help = "folder for pictures, trees and the page (default build/demo)"},
    {0},
};

static const cli_part parts[] = {{"Demo", options, 0}, {"Options", cli_common_options, 0}, {0}};

static int make_folder(const char *path) {
    char *prefix = malloc(strlen(path) + 1);
    if (!prefix) return cli_fail_memory();
    strcpy(prefix, path);
    bool made = true;
    for (char *c = prefix + 1; made && *c; c++) {
        if (*c != '/') continue;
        *c = '\0';
        made = mkdir(prefix, 0777) == 0 || errno == EEXIST;
        *c = '/';
    }
    made = made && (mkdir(path, 0777) == 0 || errno == EEXIST);
    free(prefix);
    return made ? 0 : cli_fail_file(CLI_RESOURCES, path, "made");
}

/* No line of demo/scenes.c is longer, or has more words. */
enum { LINE = 400, WORDS = LINE / 2, SCENES = 8 };

/* Runs a line as if it stood after "froe", with the demo's own seed, threads and --quiet. */
static int run_line(const cli_common *common, const char *text, bool loud, json_t **report) {
    char line[LINE], *words[WORDS];
    int count = 0, kept = -1;
    const char *target = strstr(text, " >"), *file = target ? target + 2 : NULL;
    snprintf(line, sizeof line, "%.*s --seed %llu --threads %llu%s", (int)(target ? target - text : LINE), text,
             (unsigned long long)common->seed, (unsigned long long)common->threads, loud && !file ? "" : " --quiet");
    for (char *rest = line, *word; (word = strtok_r(rest, " ", &rest)) != NULL;) words[count++] = word;
    if (loud) printf("$ froe %s\n", text);
    const cli_command *command = cli_command_named(words[0]);
    *report = NULL;
    int code = file ? demo_redirect(file, &kept) : 0;
    if (!code) code = cli_run(command, count - 1, words + 1, report);
    if (file) {
        const int back = demo_restore(file, kept);
        code = code ? code : back;
    }
    if (loud) putchar('\n');
    return code;
}

static int unpack(const char *name) {
    const support_embedded *file = support_embedded_named(cli_embedded_files, name);
    if (!file) /* one way: the files are there when the tests are built */
        return cli_fail(CLI_INPUT, name, "The program was built without this file.");
    return cli_write_file(name, file->bytes, file->size);
}

/* Unpacks the files of the scene, runs the commands of its section, and builds a tree by every method where the section
 * shows that. */
static int run_scene(const cli_common *common, const demo_scene *scene, demo_result *result) {
    int code = 0;
    for (int i = 0; !code && scene->files[i]; i++) code = unpack(scene->files[i]);
    for (int i = 0; !code && scene->steps[i].command; i++)
        code = run_line(common, scene->steps[i].command, !common->json && !common->quiet, &result->report[i]);
    if (code || !scene->methods) return code;
    result->methods = json_array();
    const froe_method_info *method;
    for (size_t i = 0; !code && (method = froe_method_at(i)) != NULL; i++) {
        if (!(method->kinds[2] >> FROE_SEGMENT & 1)) continue; /* of a plan */
        char line[LINE];
        json_t *report;
        snprintf(line, sizeof line, "build %s --method %s", scene->methods, method->name);
        code = run_line(common, line, false, &report);
        (void)json_array_append_new(result->methods, report); /* the page tells where memory runs out */
    }
    return code;
}

static int run_demo(const void *given) {
    const demo_args *args = given;
    int code = make_folder(args->output);
    if (code) return code;
    if (chdir(args->output) != 0) return cli_fail_file(CLI_RESOURCES, args->output, "entered");
    demo_result results[SCENES] = {0};
    const double start = cli_seconds();
    for (int i = 0; !code && demo_scenes[i].title; i++) code = run_scene(&args->common, &demo_scenes[i], &results[i]);
    if (!code) code = demo_write_page("index.html", results);
    for (int i = 0; i < SCENES; i++) {
        for (int j = 0; j < DEMO_STEPS; j++) json_decref(results[i].report[j]);
        json_decref(results[i].methods);
    }
    if (code) return code;
    char index[400];
    snprintf(index, sizeof index, "%.300s/index.html", args->output);
    return cli_report(&args->common, NULL,
                      json_pack("{s:f, s:o}", "seconds", cli_seconds() - start, "index", cli_name_json(index)));
}

const cli_command cli_command_demo = {
    .name = "demo",
    .summary = "run everything on real scenes and show it on one page",
    .about = "Draws a house and a technical drawing, answers questions about a map and a model, finds when vehicles "
             "meet, and shows the partitions behind all that. The scenes are within the program. Writes a folder with "
             "a page, index.html, that shows the pictures with the commands that made them. Needs no display and no "
             "network.",
    .examples = "froe demo\nfroe demo -o pictures --quiet\n",
    .parts = parts,
    .defaults = &(const demo_args){.common = CLI_COMMON_DEFAULTS, .output = "build/demo"},
    .size = sizeof(demo_args),
    .run = run_demo,
};
