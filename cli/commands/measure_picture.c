/* measure_picture.c: a picture of the cube or ball of a measure, in a window three times as wide. */
#include "commands/measure_picture.h"
#include "args/budget.h"
#include "library.h"
#include "progress.h"
#include <stdio.h>

static int draw(const cli_common *common, const char *path, froe_scene *scene, const froe_draw_mark *mark,
                const char *title, uint64_t max_fragments) {
    cli_draw library;
    const int code = cli_open_draw(&library);
    if (code) return code;
    froe_draw_options o = library.defaults();
    froe_build_options b = froe_build_defaults();
    cli_progress bar = cli_progress_begin(common, "drawing");
    froe_tree *tree;
    froe_diagnostic diag;
    for (int k = 0; k < froe_scene_dim(scene); k++) {
        const double side = mark->hi[k] - mark->lo[k];
        o.lo[k] = mark->lo[k] - side, o.hi[k] = mark->hi[k] + side;
    }
    o.show = FROE_DRAW_OBJECTS;
    o.title = title;
    o.marks = mark;
    o.mark_count = 1;
    o.progress = b.progress = cli_progress_step;
    o.user = b.user = &bar;
    b.purpose = "query"; /* the quickest to build; the picture does not show it */
    b.threads = (unsigned)common->threads;
    b.max_fragments = cli_budget(max_fragments, scene);
    froe_status status = froe_build(scene, &b, &tree, &diag);
    if (!status) {
        status = library.draw(tree, path, &o, &diag);
        froe_tree_free(tree);
    }
    cli_progress_end(&bar);
    if (status == FROE_E_BUDGET) return cli_fail_build(path, max_fragments, scene, status, &diag);
    return status ? cli_fail_status(CLI_WRITING, path, status, &diag) : 0;
}

static int refuse_dimension(const char *path, const froe_scene *scene) {
    return cli_fail(CLI_USE, path, "Pictures exist in 2 and 3 dimensions, not in %d.", froe_scene_dim(scene));
}

int measure_draw_cube(const cli_common *common, const char *path, froe_scene *scene, const froe_clutter *clutter,
                      uint64_t max_fragments) {
    froe_draw_mark mark = {.ball = false};
    char title[80];
    if (froe_scene_dim(scene) > 3) return refuse_dimension(path, scene);
    for (int k = 0; k < froe_scene_dim(scene); k++) mark.lo[k] = clutter->lo[k], mark.hi[k] = clutter->hi[k];
    snprintf(title, sizeof title, "%u objects meet a cube without corners of their boxes", (unsigned)clutter->lower);
    return draw(common, path, scene, &mark, title, max_fragments);
}

int measure_draw_ball(const cli_common *common, const char *path, froe_scene *scene, const froe_density *density,
                      uint64_t max_fragments) {
    froe_draw_mark mark = {.ball = true};
    char title[80];
    if (froe_scene_dim(scene) > 3) return refuse_dimension(path, scene);
    for (int k = 0; k < froe_scene_dim(scene); k++)
        mark.lo[k] = density->centre[k] - density->radius, mark.hi[k] = density->centre[k] + density->radius;
    snprintf(title, sizeof title, "%u objects as large as a ball meet it", (unsigned)density->lower);
    return draw(common, path, scene, &mark, title, max_fragments);
}
