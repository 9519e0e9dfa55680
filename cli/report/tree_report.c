/* tree_report.c: a tree's counts, promises and filter statistics as JSON. */
#include "report/tree_report.h"
#include "exit.h"
#include "support/fail.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number if it is a finite one from end to end, else text. */
static json_t *value_json(const char *text, size_t length) {
    char copy[64];
    if (length && length < sizeof copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
        char *end;
        const double value = strtod(copy, &end);
        const bool whole = value >= -9e15 && value <= 9e15 && value == (double)(json_int_t)value;
        if (!*end && isfinite(value)) return whole ? json_integer((json_int_t)value) : json_real(value);
    }
    return json_stringn(text, length);
}

/* "name=value name=value" as an object. */
static json_t *settings_json(const char *text) {
    json_t *settings = json_object();
    while (*text) {
        const size_t name = strcspn(text, "= "), word = strcspn(text, " ");
        char key[64];
        snprintf(key, sizeof key, "%.*s", (int)name, text);
        if (name < word) json_object_set_new(settings, key, value_json(text + name + 1, word - name - 1));
        text += word;
        text += strspn(text, " ");
    }
    return settings;
}

json_t *cli_tree_json(const froe_tree *tree) {
    const froe_report r = froe_tree_report(tree);
    const froe_predicate_stats *p = &r.predicates;
    const double each = r.objects ? (double)r.fragments / (double)r.objects : 0;
    json_t *bounds = json_object();
    for (const froe_promise *promise = r.promises; promise->name; promise++)
        json_object_set_new(bounds, promise->name,
                            json_pack("{s:f, s:f}", "promised", promise->promised, "measured", promise->measured));
    json_t *predicates =
        json_pack("{s:I, s:I, s:I, s:I, s:I, s:I}", "calls", (json_int_t)p->calls, "by_id", (json_int_t)p->by_id,
                  "filtered", (json_int_t)p->filtered, "refined", (json_int_t)p->refined, "exact", (json_int_t)p->exact,
                  "exact_zero", (json_int_t)p->exact_zero);
    return json_pack(
        "{s:s, s:o, s:i, s:I, s:I, s:I, s:I, s:I, s:I, s:f, s:I, s:I, s:I, s:I, s:f, s:I, s:I, s:I, s:I, s:o, s:o}",
        "method", r.method, "settings", settings_json(r.settings), "dim", r.dim, "leaf", (json_int_t)r.leaf, "seed",
        (json_int_t)r.seed, "objects", (json_int_t)r.objects, "nodes", (json_int_t)r.nodes, "leaves",
        (json_int_t)r.leaves, "fragments", (json_int_t)r.fragments, "pieces_per_object", each, "in_cut",
        (json_int_t)r.in_cut, "covers", (json_int_t)r.covers, "size", (json_int_t)r.size, "height",
        (json_int_t)r.height, "mean_depth", r.mean_depth, "max_leaf", (json_int_t)r.max_leaf, "inseparable",
        (json_int_t)r.inseparable, "crowded", (json_int_t)r.crowded, "bytes", (json_int_t)r.bytes, "predicates",
        predicates, "bounds", bounds);
}

int cli_report_build(const cli_common *common, const char *scene, const char *output, const froe_tree *tree,
                     cli_build_seconds seconds) {
    const froe_report r = froe_tree_report(tree);
    char headline[400];
    snprintf(headline, sizeof headline, "%.200s: %llu object%s in %llu piece%s, height %llu, by %s in %.3g s", scene,
             (unsigned long long)r.objects, support_plural(r.objects), (unsigned long long)r.fragments,
             support_plural(r.fragments), (unsigned long long)r.height, r.method, seconds.build);
    json_t *report = json_pack("{s:o, s:o*, s:o}", "scene", cli_name_json(scene), "tree", cli_name_json(output),
                               "seconds", json_pack("{s:f, s:f}", "read", seconds.read, "build", seconds.build));
    json_t *tree_report = cli_tree_json(tree);
    if (!report || !tree_report || json_object_update_missing(report, tree_report) != 0) {
        json_decref(report);
        report = NULL;
    }
    json_decref(tree_report);
    return cli_report(common, headline, report);
}
