/* compare.c: froe compare, every method on every scene, side by side. */
#include "args/method.h"
#include "args/output.h"
#include "args/scene.h"
#include "command.h"
#include "compare/contest.h"
#include "compare/page.h"
#include "compare/part.h"
#include "compare/picture.h"
#include "compare/row.h"
#include "compare/table.h"
#include "exit.h"
#include "files.h"
#include "progress.h"
#include "report/report.h"
#include <froe/measure.h>
#include <stdlib.h>
#include <string.h>

typedef struct compare_args {
    cli_common common;
    cli_texts scenes;
    cli_scene_args scene; /* but its path */
    cli_output page;
    const char *csv, *methods;
    uint64_t leaf, queries, halvings;
    double seconds, pieces;
    bool no_times;
} compare_args;

static const cli_option what[] = {
    {NULL, 0, CLI_TEXTS, offsetof(compare_args, scenes), "SCENE", .file = CLI_READ, .help = "maps, models or CSV files",
     .required = true},
    {"output", 'o', CLI_OUTPUT, offsetof(compare_args, page), "FILE", .file = CLI_WRITTEN,
     .help = "write a page with figures and pictures here (HTML, one file); - for standard output", .ending = "html"},
    {"csv", 0, CLI_TEXT, offsetof(compare_args, csv), "FILE", .file = CLI_WRITTEN,
     .help = "write all numbers here, one row a method"},
    {0},
};

static const cli_option options[] = {
    {"methods", 'm', CLI_TEXT, offsetof(compare_args, methods), "M,...",
     .help = "these builders only, also where they do not serve (default: all that serve the scene)"},
    {"leaf", 0, CLI_WHOLE, offsetof(compare_args, leaf), "K",
     .help = "most objects in a leaf, the same for all (default: each method's own)", .max = INT32_MAX},
    {"queries", 0, CLI_WHOLE, offsetof(compare_args, queries), "N", .help = "queries of each kind (default 1000)",
     .max = 100000000},
    {"halvings", 0, CLI_WHOLE, offsetof(compare_args, halvings), "H",
     .help = "also build n / 2, n / 4, ... objects from the middle, H times (default 4)", .max = 40},
    {"seconds", 0, CLI_REAL, offsetof(compare_args, seconds), "S",
     .help = "give up a build, or a kind of query, after so long (default 20)"},
    {"pieces", 0, CLI_REAL, offsetof(compare_args, pieces), "P",
     .help = "give up a build beyond so many pieces per object (default 100)"},
    {"no-times", 0, CLI_FLAG, offsetof(compare_args, no_times),
     .help = "leave out times and memory: the same scenes and options then give the same bytes"},
    {0},
};

static const cli_part parts[] = {
    {"Comparison", what, 0},
    {"Reading", &cli_scene_options[1], offsetof(compare_args, scene)},
    {"Compare", options, 0},
    {"Options", cli_common_options, 0},
    {0},
};

/* ----------------------------------------------------------------- measuring -- */

/* Is a measure there? Memory that it lacked is noted. */
static bool is_measured(froe_status status) {
    if (status == FROE_E_MEMORY) (void)cli_report_lose();
    return status == FROE_OK;
}

/* A few cheap measures, to tell scenes apart. */
static json_t *measures_json(const compare_args *args, const froe_scene *scene) {
    froe_measure_options o = froe_measure_defaults();
    froe_clutter clutter;
    froe_density density;
    froe_fatness fatness;
    froe_directional directional;
    o.samples = 1000;
    o.seed = args->common.seed;
    json_t *out = json_pack("{s:I}", "objects", (json_int_t)froe_scene_object_count(scene));
    if (is_measured(froe_measure_clutter(scene, &o, &clutter, NULL)))
        json_object_set_new(out, "clutter at least", json_integer(clutter.lower));
    if (is_measured(froe_measure_density(scene, FROE_SIZE_RADIUS, &o, &density, NULL))) {
        json_object_set_new(out, "density at least", json_integer(density.lower));
        if (density.count == froe_scene_object_count(scene))
            json_object_set_new(out, "density at most", json_integer(density.upper));
    }
    if (is_measured(froe_measure_fatness(scene, &o, &fatness, NULL)) && fatness.full.count + fatness.flat.count)
        json_object_set_new(out, "fatness median",
                            json_real(fatness.full.count ? fatness.full.median : fatness.flat.median));
    if (is_measured(froe_measure_directional(scene, 0.5, &o, &directional, NULL)))
        json_object_set_new(out, "directional 95 %", json_real(directional.paired.q95));
    return out;
}

static bool is_wanted(const char *list, const char *method) {
    if (!list) return true;
    const size_t length = strlen(method);
    for (const char *at = list; (at = strstr(at, method)) != NULL; at += length) {
        const bool begins = at == list || at[-1] == ',';                      /* one way: no name is within another */
        if (begins && (at[length] == '\0' || at[length] == ',')) return true; /* one way: as above */
    }
    return false;
}

static json_t *scene_json(const compare_args *args, const compare_plan *plan, const char *path, froe_scene *scene,
                          meter *memory) {
    const compare_scene both = {scene, part_order(scene), memory};
    json_t *rows = both.order ? json_array() : NULL;
    const froe_method_info *method;
    for (size_t i = 0; rows && (method = froe_method_at(i)) != NULL; i++) {
        const uint32_t own = method->leaf ? method->leaf : 1;
        const uint32_t leaf = plan->leaf == FROE_LEAF_OWN ? own : plan->leaf;
        const bool named = args->methods != NULL; /* then a row says why the method does not serve */
        if (!is_wanted(args->methods, method->name) || (!named && !froe_method_serves(method, scene, leaf))) continue;
        if (json_array_append_new(rows, compare_row(plan, &both, method->name)) == 0) continue;
        json_decref(rows);
        rows = NULL;
    }
    free(both.order);
    if (!rows) return NULL;
    return json_pack("{s:o, s:i, s:o, s:o, s:o, s:o*}", "scene", cli_name_json(path), "dim", froe_scene_dim(scene),
                     "measures", measures_json(args, scene), "methods", rows, "auto", contest_json(scene, rows),
                     "picture", plan->pictures ? picture_scene_json(scene) : NULL);
}

static json_t *compare(const compare_args *args, froe_scene *const *scenes, meter *meters) {
    const compare_plan plan = {.common = &args->common,
                               .leaf = (uint32_t)args->leaf,
                               .seconds = args->seconds,
                               .pieces = args->pieces,
                               .queries = args->queries,
                               .halvings = args->halvings,
                               .times = !args->no_times,
                               .pictures = args->page.name != NULL};
    json_t *list = json_array();
    for (size_t i = 0; i < args->scenes.count; i++)
        if (json_array_append_new(list, scene_json(args, &plan, args->scenes.at[i], scenes[i], &meters[i])) != 0 ||
            cli_report_short()) { /* what follows looks for members that may be missing */
            json_decref(list);
            return NULL;
        }
    return json_pack("{s:I, s:I, s:o, s:o}", "seed", (json_int_t)args->common.seed, "queries",
                     (json_int_t)args->queries, "auto", contest_sum_json(list), "scenes", list);
}

/* ------------------------------------------------------------------- writing -- */

static int write(const compare_args *args, json_t *comparison) {
    int code = args->page.name ? cli_write_text(args->page.path, page_put, comparison) : 0;
    if (!code && args->csv) code = cli_write_text(args->csv, table_put_csv, comparison);
    size_t i, j;
    json_t *scene, *row;
    json_array_foreach(json_object_get(comparison, "scenes"), i, scene) { /* pictures are for the page alone */
        json_object_del(scene, "picture");
        json_array_foreach(json_object_get(scene, "methods"), j, row) json_object_del(row, "picture");
    }
    json_t *report = code ? NULL : args->common.json ? json_incref(comparison) : table_report(comparison);
    json_decref(comparison);
    return code ? code : cli_report(&args->common, NULL, report);
}

static int run_compare(const void *given) {
    const compare_args *args = given;
    froe_scene *scenes[sizeof args->scenes.at / sizeof *args->scenes.at] = {NULL};
    meter meters[sizeof args->scenes.at / sizeof *args->scenes.at] = {{0}};
    if (!(args->seconds > 0)) return cli_fail(CLI_USE, NULL, "--seconds: '%g' is not a number above 0.", args->seconds);
    if (!(args->pieces > 0)) return cli_fail(CLI_USE, NULL, "--pieces: '%g' is not a number above 0.", args->pieces);
    int code = cli_check_ending("output", args->page.path, "html");
    for (const char *at = args->methods; !code && at;) { /* names parted by commas */
        char name[64];
        const size_t length = strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        code = cli_check_method(name, false);
        at = at[length] ? at + length + 1 : NULL;
    }
    for (size_t i = 0; i < args->scenes.count && !code; i++)
        for (size_t j = 0; j < i && !code; j++)
            if (strcmp(args->scenes.at[i], args->scenes.at[j]) == 0)
                code = cli_fail(CLI_USE, args->scenes.at[i], "The scene is given twice.");
    for (size_t i = 0; i < args->scenes.count && !code; i++) { /* all, before hours of work */
        cli_scene_args scene = args->scene;
        const froe_allocator alloc = meter_allocator(&meters[i]);
        froe_read_report reader;
        scene.alloc = &alloc;
        scene.path = args->scenes.at[i];
        code = cli_read_scene(&args->common, &scene, &scenes[i], &reader);
        if (code) scenes[i] = NULL;
    }
    json_t *comparison = code ? NULL : compare(args, scenes, meters);
    if (comparison && !cli_report_short()) {
        code = write(args, comparison);
    } else if (!code) {
        json_decref(comparison);
        code = cli_interrupted() ? cli_fail_cancelled(NULL) : cli_fail_memory();
    }
    for (size_t i = 0; i < args->scenes.count; i++) froe_scene_free(scenes[i]);
    return code;
}

const cli_command cli_command_compare = {
    .name = "compare",
    .summary = "compare all methods on one or more scenes",
    .about = CLI_SCENE_ABOUT
    "\n\nBuilds a tree by every method that serves the scene, and sends all trees the same queries: points, windows, "
    "rays, and approximate windows (within eps of the window's diameter). Sizes, heights, visited nodes, times, and "
    "what each method promises are printed beside each other: as a table, as JSON (--json), as CSV, or as a page with "
    "figures. To show "
    "how trees grow, parts of the scene are built, too: the objects nearest its middle. A method that fails, or "
    "takes too long, is a row that says so.\n\nThe last tables tell what --method auto takes for each purpose, "
    "what was best, and how many times its cost that of auto is.",
    .examples = "froe compare floor.geojson house.glb -o report.html\n"
                "froe compare map.gpkg --layer roads --methods density,index --csv roads.csv --seconds 120\n",
    .parts = parts,
    .defaults = &(const compare_args){.common = CLI_COMMON_DEFAULTS,
                                      .leaf = FROE_LEAF_OWN,
                                      .queries = 1000,
                                      .halvings = 4,
                                      .seconds = 20,
                                      .pieces = 100},
    .size = sizeof(compare_args),
    .run = run_compare,
};
