/* oracle.c: pictures against rays, as lines of results: every scene from nine eyes. The long run of what tests/view
 * checks on small scenes.
 *
 *     bench_oracle [-s SAMPLES] SCENE...        a file, or KIND:N for a generated scene
 *
 * Counts: samples of pictures of whole faces where a ray meets something; layers, where one sees through a fifth of the
 * faces; middles of visible and hidden parts of edges; of all of these the doubtful ones, at which two faces are met at
 * the same depth to seven digits, and the wrong ones among the others. Ends with 1 if anything is wrong. */
#include "bench.h"
#include "json.h"
#include "oracle/views.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

static froe_scene *open_scene(const char *arg, char name[32]) {
    const char *colon = strchr(arg, ':');
    if (!colon) {
        bench_name(arg, name);
        return bench_read(arg);
    }
    snprintf(name, 32, "%.*s", (int)(colon - arg), arg);
    return bench_generate(name, strtoull(colon + 1, NULL, 10), 1);
}

static void must(froe_status status, const char *what, unsigned view, const froe_diagnostic *why) {
    if (!status) return;
    fprintf(stderr, "oracle: %s, view %u: %s\n", what, view, why->message);
    exit(1);
}

static void complain(const char *what, unsigned view, const oracle_report *r) {
    if (r->faces.wrong)
        fprintf(stderr, "  %s, view %u: at (%.3f, %.3f) patch %d is painted, but %d is met\n", what, view,
                r->faces.at[0], r->faces.at[1], (int)r->faces.painted, (int)r->faces.met);
    if (r->lines.wrong) fprintf(stderr, "  %s, view %u: edge %u at %.9g\n", what, view, r->lines.edge, r->lines.share);
}

/* All views; what is wrong is told at once. */
static oracle_report look(const oracle_task *task, const char *what) {
    oracle_report sum = {.shapes = 0};
    froe_diagnostic why = {0};
    for (unsigned view = 0; view < ORACLE_VIEWS; view++) {
        const uint64_t wrong = sum.faces.wrong + sum.lines.wrong;
        must(oracle_check_view(task, view, &sum, &why), what, view, &why);
        if (sum.faces.wrong + sum.lines.wrong > wrong) complain(what, view, &sum);
    }
    return sum;
}

static void put(const char *name, const froe_scene *scene, const char *measure, uint64_t count) {
    const double value = (double)count;
    json_line(&(json_result){"rays", name, froe_scene_object_count(scene), "froe", measure, &value, 1, NULL});
}

static bool check(const char *arg, uint32_t samples) {
    char name[32];
    froe_diagnostic why = {0};
    froe_scene *scene = open_scene(arg, name);
    froe_tree *tree = bench_build(scene, "auto", NULL, 1, 1, NULL);
    oracle_task task = {.tree = tree, .samples = samples, .underlap = 1, .edge_step = 1};
    froe_surface *surface;
    must(froe_surface_new(scene, NULL, &surface, &why), name, 0, &why);
    task.surface = surface;
    const oracle_report opaque = look(&task, name);
    task.clear = 5, task.underlap = 0, task.edge_step = 0;
    const oracle_report clear = look(&task, name);
    const oracle_lines *l = &opaque.lines;
    const uint64_t wrong = opaque.faces.wrong + clear.faces.wrong + l->wrong;
    put(name, scene, "points of faces", opaque.faces.covered);
    put(name, scene, "points of layers", clear.faces.layers);
    put(name, scene, "points of edges", l->visible + l->hidden);
    put(name, scene, "doubtful", opaque.faces.ties + clear.faces.ties + l->doubtful);
    put(name, scene, "wrong", wrong);
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return !wrong;
}

int main(int argc, char **argv) {
    uint32_t samples = 500;
    int at = 1;
    bool right = true;
    if (argc > 2 && !strcmp(argv[1], "-s")) samples = (uint32_t)strtoul(argv[2], NULL, 10), at = 3;
    for (; at < argc; at++) right = check(argv[at], samples) && right;
    return !right;
}
