/* page.c: what the commands of the demo made, as a page that needs nothing but the files beside it: pictures with the
 * lines that make them first, tables folded away. */
#include "demo/page.h"
#include "files.h"
#include "report/html.h"
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const html_field tree_fields[] = {{"method", "method"},
                                         {"objects", "objects"},
                                         {"fragments", "pieces of objects"},
                                         {"pieces_per_object", "pieces per object"},
                                         {"height", "height: cuts on the longest way"},
                                         {"leaves", "leaves: cells that are not cut"},
                                         {"bytes", "bytes, without the scene"},
                                         {"seconds.read", "seconds to read"},
                                         {"seconds.build", "seconds to build"},
                                         {0}};
static const html_field exactness_fields[] = {{"predicates.calls", "questions"},
                                              {"predicates.by_id", "known from the input"},
                                              {"predicates.filtered", "certain in floating point"},
                                              {"predicates.refined", "certain with twice the digits"},
                                              {"predicates.exact", "decided in exact numbers"},
                                              {0}};
static const html_field method_fields[] = {{"method", "method"},
                                           {"pieces_per_object", "pieces per object"},
                                           {"height", "height"},
                                           {"leaves", "leaves"},
                                           {"bytes", "bytes"},
                                           {"seconds.build", "seconds to build"},
                                           {0}};

static bool begins(const char *text, const char *word) {
    return strncmp(text, word, strlen(word)) == 0;
}

/* The word after one of these: the name of a picture. */
static int picture_of(const demo_step *step, const char **name) {
    static const char *const before[] = {" --animate ", " -o "};
    for (size_t i = 0; i < 2; i++) { /* one way: each picture has a name */
        const char *at = strstr(step->command, before[i]);
        if (!at || begins(at + strlen(before[i]), "--")) continue;
        *name = at + strlen(before[i]);
        return (int)strcspn(*name, " ");
    }
    return 0;
}

static void put_commands(FILE *out, const demo_step *first, const demo_step *last) {
    html_command_begin(out);
    for (; first <= last; first++) html_command(out, first->command);
    html_command_end(out);
}

/* The figure of a picture, above the lines from `first` on that make it. */
static void put_figure(FILE *out, const demo_step *first, const demo_step *step) {
    const char *name = NULL;
    const int length = picture_of(step, &name);
    fputs("<figure>\n<div class=\"sheet\"><picture>", out);
    if (step->still) fprintf(out, "<source media=\"(prefers-reduced-motion: reduce)\" srcset=\"%s\">", step->still);
    fprintf(out, "<img src=\"%.*s\" loading=\"lazy\" alt=\"", length, name);
    html_text(out, step->text);
    fprintf(out, "\"></picture></div>\n<figcaption>%s</figcaption>\n", step->caption);
    put_commands(out, first, step);
    fputs("</figure>\n", out);
}

/* The tree of one build: what it is like, how its decisions were made, and what was promised. */
static void put_tree(FILE *out, const demo_step *step, const json_t *report) {
    fputs("<div class=\"card\">\n", out);
    put_commands(out, step, step);
    html_pairs(out, report, tree_fields);
    fputs("<h3>How exact decisions were made</h3>\n", out);
    html_pairs(out, report, exactness_fields);
    if (json_object_size(json_object_get(report, "bounds"))) { /* one way: each method that is shown promises */
        fputs("<h3>What the method promises, and what came out</h3>\n", out);
        html_bounds(out, json_object_get(report, "bounds"));
    }
    fputs("</div>\n", out);
}

static void put_tables(FILE *out, const demo_scene *scene, const demo_result *result) {
    bool any = false;
    for (int i = 0; scene->steps[i].command; i++) {
        if (!begins(scene->steps[i].command, "build ")) continue;
        if (!any) fputs("<details><summary>The trees in numbers</summary>\n<div class=\"grid\">\n", out);
        any = true;
        put_tree(out, &scene->steps[i], result->report[i]);
    }
    if (any) fputs("</div>\n</details>\n", out);
    if (json_array_size(result->methods)) {
        fprintf(out, "<details><summary>%s by every method</summary>\n<div class=\"card\">\n", scene->methods);
        html_rows(out, result->methods, method_fields);
        fputs("</div>\n</details>\n", out);
    }
}

static void put_scene(FILE *out, const demo_scene *scene, const demo_result *result) {
    int audited = 0;
    const demo_step *first = scene->steps;
    fputs("<section>\n", out);
    html_element(out, "h2", scene->title);
    fprintf(out, "<p>%s</p>\n<div class=\"grid\">\n", scene->text);
    for (const demo_step *step = scene->steps; step->command; step++) {
        audited += json_is_true(json_object_get(result->report[step - scene->steps], "ok"));
        if (!step->caption) continue;
        put_figure(out, first, step);
        first = step + 1;
    }
    fputs("</div>\n", out);
    if (audited) fprintf(out, "<p>The check of each of these %d trees passed.</p>\n", audited);
    put_tables(out, scene, result);
    if (scene->credit) html_element(out, "small", scene->credit);
    fputs("</section>\n", out);
}

static bool put_page(FILE *out, const void *given) {
    const demo_result *results = given;
    html_begin(out, "froe: exact line drawings of models, and answers from maps and models", NULL);
    fputs("<header>\n<h1>Exact drawings of models, exact answers from maps</h1>\n<p class=\"lead\">froe turns 3D "
          "models into line drawings, and says what is at a point, near it, or hit by a ray. Each picture below was "
          "made on this computer by the line under it, which works in this folder once froe is "
          "installed.</p>\n</header>\n<main>\n",
          out);
    for (size_t i = 0; demo_scenes[i].title; i++) put_scene(out, &demo_scenes[i], &results[i]);
    html_copying(out);
    html_end(out);
    return true;
}

int demo_write_page(const char *path, const demo_result *results) {
    return cli_write_text(path, put_page, results);
}
