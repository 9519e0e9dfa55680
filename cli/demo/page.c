/* page.c: lays out scenes, pictures and reports as a page that needs nothing
 * but the pictures beside it: no scripts, no fonts, no network. */
#include "demo/page.h"
#include "files.h"
#include "report/html.h"
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const char *const tree_keys[] = {
    "method",     "objects",     "fragments", "pieces_per_object", "in_cut",        "height", "nodes", "leaves",
    "mean_depth", "inseparable", "bytes",     "seconds.read",      "seconds.build", NULL};
static const char *const defect_keys[] = {"defects.zero_length",
                                          "defects.zero_area",
                                          "defects.duplicates",
                                          "defects.crossings",
                                          "defects.t_junctions",
                                          "defects.overlaps",
                                          NULL};
static const char *const exactness_keys[] = {"predicates.calls",
                                             "predicates.by_id",
                                             "predicates.filtered",
                                             "predicates.refined",
                                             "predicates.exact",
                                             "predicates.exact_zero",
                                             NULL};
static const char *const method_keys[] = {"method", "fragments", "pieces_per_object", "height",
                                          "nodes",  "bytes",     "seconds.build",     NULL};

/* The report of the first step of that sort. */
static const json_t *report_of(const demo_scene *scene, const demo_result *result, const char *command) {
    for (int i = 0; scene->steps[i].command; i++)
        if (strncmp(scene->steps[i].command, command, strlen(command)) == 0) return result->report[i];
    return NULL;
}

static void put_card(FILE *out, const char *title, const json_t *report, const char *const *keys) {
    fprintf(out, "<div class=\"card\"><h3>%s</h3>\n", title);
    html_pairs(out, report, keys);
    fputs("</div>\n", out);
}

static void put_cards(FILE *out, const demo_scene *scene, const demo_result *result) {
    const json_t *build = report_of(scene, result, "build ");
    const json_t *bounds = json_object_get(build, "bounds");
    fputs("<div class=\"cards\">\n", out);
    put_card(out, "The tree", build, tree_keys);
    put_card(out, "How exact predicates were answered", build, exactness_keys);
    put_card(out, "What is odd about the scene", report_of(scene, result, "info "), defect_keys);
    if (json_object_size(bounds)) {
        fputs("<div class=\"card wide\"><h3>What the method promises, and what came out</h3>\n", out);
        html_bounds(out, bounds);
        fputs("</div>\n", out);
    }
    fputs("<div class=\"card wide\"><h3>All methods, same scene, same seed</h3>\n<table class=\"columns\">\n", out);
    html_headings(out, method_keys);
    size_t i;
    json_t *report;
    json_array_foreach(result->methods, i, report) html_row(out, report, method_keys);
    fputs("</table></div>\n</div>\n", out);
}

static void put_scene(FILE *out, const demo_scene *scene, const demo_result *result) {
    static const struct {
        const char *key, *after;
    } figures[] = {
        {"objects", "objects"}, {"fragments", "pieces"}, {"pieces_per_object", "per object"}, {"height", "levels"}};
    const json_t *build = report_of(scene, result, "build ");
    fputs("<section>\n<h2>", out);
    html_text(out, scene->title);
    fputs("</h2>\n<p class=\"figures\">", out);
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++) {
        fputs(i ? " <b>" : "<b>", out);
        html_value(out, json_object_get(build, figures[i].key));
        fprintf(out, "</b> %s", figures[i].after);
    }
    if (json_is_true(json_object_get(report_of(scene, result, "check "), "ok"))) fputs(" <em>audit passed</em>", out);
    fputs("</p>\n<p>", out);
    html_text(out, scene->text);
    fputs("</p>\n<div class=\"pictures\">\n", out);
    for (const demo_step *step = scene->steps; step->command; step++) {
        const char *name = step->caption ? strstr(step->command, "-o ") : NULL;
        if (!name) continue;
        name += 3;
        const int length = (int)strcspn(name, " ");
        fprintf(out, "<figure><a href=\"%.*s\"><img src=\"%.*s\" loading=\"lazy\" alt=\"", length, name, length, name);
        html_text(out, scene->title);
        fputs("\"></a><figcaption>", out);
        html_text(out, step->caption);
        fputs("</figcaption></figure>\n", out);
    }
    fputs("</div>\n", out);
    put_cards(out, scene, result);
    fputs("<p>The same again, in this folder:</p>\n<pre>", out);
    for (const demo_step *step = scene->steps; step->command; step++) {
        fputs("froe ", out);
        html_text(out, step->command);
        fputc('\n', out);
    }
    fputs("</pre>\n<p class=\"credit\">", out);
    html_text(out, scene->credit);
    fputs("</p>\n</section>\n", out);
}

static void put_page(FILE *out, const void *given) {
    const demo_result *results = given;
    html_begin(out, "froe: binary space partitions of real scenes", NULL);
    fputs("<header>\n<h1>froe</h1>\n<p>Binary space partitions that stay small on real "
          "scenes, exactly. A froe is the tool that splits wood along the grain instead of sawing across it.</p>\n"
          "</header>\n<main>\n",
          out);
    for (size_t i = 0; demo_scenes[i].title; i++) put_scene(out, &demo_scenes[i], &results[i]);
    html_end(out);
}

int demo_write_page(const char *path, const demo_result *results) {
    return cli_write_text(path, put_page, results);
}
