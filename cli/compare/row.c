/* row.c: builds a tree within its budget and measures it. */
#include "compare/row.h"
#include "compare/part.h"
#include "compare/picture.h"
#include "progress.h"
#include "report/tree_report.h"
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ building -- */

/* A build limited by two clocks. */
typedef struct attempt {
    cli_progress bar;
    double seconds;          /* at most */
    double wall, processors; /* when it began */
    bool late;
} attempt;

/* The lesser of both counts, so that neither other work of the machine nor many threads make a build late. */
static bool step(void *user, double done) {
    attempt *a = user;
    if (cli_seconds() - a->wall > a->seconds && cli_processor_seconds() - a->processors > a->seconds) a->late = true;
    return cli_progress_step(&a->bar, done) && !a->late;
}

typedef struct outcome {
    froe_tree *tree; /* NULL: the note says why */
    double seconds;
    size_t peak; /* most memory of the build, in bytes, the tree included */
    char note[300];
} outcome;

static outcome build(const compare_plan *plan, froe_scene *scene, meter *memory, const char *method) {
    attempt a = {.bar = cli_progress_begin(plan->common, method), .seconds = plan->seconds};
    const double most = plan->pieces * (double)froe_scene_object_count(scene), start = cli_seconds();
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {.message = ""};
    outcome out = {.tree = NULL};
    o.method = method;
    o.leaf = plan->leaf;
    o.seed = plan->common->seed;
    o.threads = (unsigned)plan->common->threads;
    o.max_fragments = most < 1 ? 1 : most < 1e15 ? (uint64_t)most : 0;
    o.progress = step;
    o.user = &a;
    a.wall = start, a.processors = cli_processor_seconds();
    const size_t before = memory ? meter_restart(memory) : 0;
    const froe_status status = froe_build(scene, &o, &out.tree, &diag);
    out.seconds = cli_seconds() - start;
    out.peak = memory ? atomic_load(&memory->most) - before : 0;
    cli_progress_end(&a.bar);
    if (status) {
        out.tree = NULL;
        if (status == FROE_E_MEMORY) (void)cli_report_lose();
        if (a.late)
            snprintf(out.note, sizeof out.note, "more than %g s", plan->seconds);
        else if (status == FROE_E_BUDGET)
            snprintf(out.note, sizeof out.note, "more than %g pieces per object", plan->pieces);
        else
            snprintf(out.note, sizeof out.note, "%s", diag.message);
    }
    return out;
}

/* ----------------------------------------------------------------- measuring -- */

/* Every node once, without recursion: nodes are numbered from 1, children after their parents. */
static json_t *loads_json(const froe_tree *tree) {
    const froe_report r = froe_tree_report(tree);
    const size_t bins = r.max_leaf < 40 ? (size_t)r.max_leaf + 1 : 41;
    const double width = r.max_leaf < 40 ? 1 : (double)(r.max_leaf + 1) / 41;
    uint64_t counts[41] = {0};
    for (uint64_t id = 1; id <= r.nodes; id++) {
        const froe_node_info node = froe_tree_node(tree, (froe_node){(uint32_t)id});
        if (node.cut.kind == FROE_CUT_NONE) counts[(size_t)((double)node.piece_count / width)]++;
    }
    json_t *list = json_array();
    for (size_t i = 0; i < bins; i++)
        json_array_append_new(list, json_pack("{s:I, s:I}", "load", (json_int_t)((double)i * width + 0.999999),
                                              "leaves", (json_int_t)counts[i]));
    return list;
}

static json_t *size_json(const compare_plan *plan, const froe_tree *tree, double seconds) {
    const froe_report r = froe_tree_report(tree);
    json_t *out =
        json_pack("{s:I, s:I, s:I, s:I, s:I}", "objects", (json_int_t)r.objects, "fragments", (json_int_t)r.fragments,
                  "size", (json_int_t)r.size, "height", (json_int_t)r.height, "bytes", (json_int_t)r.bytes);
    if (plan->times) json_object_set_new(out, "seconds", json_real(seconds));
    return out;
}

/* Trees of smaller and smaller parts of the scene, the smallest first; ends with the first that fails. */
static json_t *growth_json(const compare_plan *plan, const compare_scene *scene, const char *method) {
    json_t *list = json_array();
    const size_t n = froe_scene_object_count(scene->scene);
    for (uint64_t i = plan->halvings; i > 0 && !cli_interrupted(); i--) {
        const size_t count = n >> i;
        froe_scene *part;
        if (count < 16) continue;
        const froe_status status = part_new(scene->scene, scene->order, count, &part, NULL);
        if (status == FROE_E_MEMORY) (void)cli_report_lose();
        if (status) break;
        outcome out = build(plan, part, NULL, method);
        if (out.tree) json_array_append_new(list, size_json(plan, out.tree, out.seconds));
        const bool built = out.tree != NULL;
        froe_tree_free(out.tree);
        froe_scene_free(part);
        if (!built) break;
    }
    return list;
}

static json_t *built_json(const compare_plan *plan, const outcome *out) {
    json_t *row = json_pack("{s:s, s:s}", "status", "ok", "note", ""), *tree = cli_tree_json(out->tree);
    if (!row || !tree || json_object_update_missing(row, tree) != 0) {
        json_decref(row);
        row = NULL;
    }
    json_decref(tree);
    if (!row) return NULL;
    if (plan->times) {
        json_object_set_new(row, "seconds", json_pack("{s:f}", "build", out->seconds));
        json_object_set_new(row, "peak_bytes", json_integer((json_int_t)out->peak));
    }
    const workload load = {plan->queries, plan->common->seed, plan->seconds, plan->times};
    froe_diagnostic diag = {.message = ""};
    froe_status status = FROE_OK;
    json_t *queries = plan->queries ? workload_run(out->tree, &load, &status, &diag) : NULL;
    if (status == FROE_E_MEMORY) (void)cli_report_lose();
    json_object_set_new(row, "leaf_loads", loads_json(out->tree));
    if (queries) json_object_set_new(row, "queries", queries);
    if (status) json_object_set_new(row, "note", json_sprintf("no queries: %s", diag.message));
    if (plan->pictures) json_object_set_new(row, "picture", picture_json(out->tree, true));
    return row;
}

json_t *compare_row(const compare_plan *plan, const compare_scene *scene, const char *method) {
    outcome out = build(plan, scene->scene, scene->memory, method);
    json_t *row = out.tree ? built_json(plan, &out)
                           : json_pack("{s:s, s:s, s:s}", "method", method, "status", "failed", "note", out.note);
    json_t *growth = growth_json(plan, scene, method);
    if (out.tree) json_array_append_new(growth, size_json(plan, out.tree, out.seconds));
    json_object_set_new(row, "growth", growth); /* dropped without a row */
    froe_tree_free(out.tree);
    if (!cli_interrupted() && !cli_report_short()) return row;
    json_decref(row);
    return NULL;
}
