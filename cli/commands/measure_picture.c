/* measure_picture.c: a picture of the cube or ball of a measure: the objects that it counts in the accent colour, those
 * around it in ink, and where all that is in the scene. */
#include "commands/measure_picture.h"
#include "args/budget.h"
#include "exit.h"
#include "library.h"
#include "progress.h"
#include "support/fail.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NEIGHBOURS = 40, DOUBLINGS = 8 }; /* the window is widened until it shows as many objects */

typedef struct measured {
    froe_draw_mark mark;
    double least; /* half the size of the objects that count */
    char title[120];
} measured;

int measure_check_pictures(const char *const *paths, size_t count) {
    cli_draw library;
    froe_draw_format format;
    int code = 0;
    for (size_t i = 0; i < count && !code; i++) {
        if (!paths[i]) continue;
        code = cli_open_draw(&library);
        if (!code && !library.format_of(paths[i], &format))
            code = cli_fail(CLI_USE, paths[i], "The ending of pictures is .svg, .pdf or .png.");
    }
    return code;
}

int measure_check_dimension(const char *path, const froe_scene *scene) {
    if (froe_scene_dim(scene) <= 3) return 0;
    return cli_fail(CLI_USE, path, "Pictures exist in 2 and 3 dimensions, not in %d.", froe_scene_dim(scene));
}

/* The radius of the smallest ball around an object; of polygons of more than three corners and of hulls at least. */
static double radius_of(const froe_scene *scene, uint32_t id) {
    const froe_object o = froe_scene_object(scene, id);
    const int dim = froe_scene_dim(scene);
    double sides[3] = {0, 0, 0}, largest = 0;
    if (o.form == FROE_BALL) return o.radius;
    for (uint32_t i = 0; i < o.corners; i++)
        for (uint32_t k = 0; k < i; k++) {
            const double *p = froe_scene_vertex(scene, froe_scene_corner(scene, id, i));
            const double *q = froe_scene_vertex(scene, froe_scene_corner(scene, id, k));
            double square = 0;
            for (int axis = 0; axis < dim; axis++) square += (p[axis] - q[axis]) * (p[axis] - q[axis]);
            if (i + k <= 3) sides[i + k - 1] = square;
            largest = fmax(largest, square);
        }
    const double sum = sides[0] + sides[1] + sides[2];
    if (o.corners != 3 || 2 * largest >= sum) return 0.5 * sqrt(largest);
    /* Acute: the circle through all corners, by Heron's formula for its area, with squares of sides. */
    const double area16 = 2 * (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]) -
                          (sides[0] * sides[0] + sides[1] * sides[1] + sides[2] * sides[2]);
    return sqrt(sides[0] / area16) * sqrt(sides[1]) * sqrt(sides[2]);
}

/* What meets the mark and is large enough, in `ids`, which the caller frees. */
static froe_status find_measured(froe_query *query, const froe_scene *scene, const measured *m, uint32_t **ids,
                                 size_t *count, froe_diagnostic *diag) {
    const int dim = froe_scene_dim(scene);
    const bool ball = m->mark.kind == FROE_DRAW_MARK_BALL;
    double points[6];
    for (int k = 0; k < dim; k++) { /* what only touches the box does not count, for its corners lie on the border */
        const double rim = 1e-9 * (m->mark.hi[k] - m->mark.lo[k]);
        points[k] = ball ? 0.5 * (m->mark.lo[k] + m->mark.hi[k]) : m->mark.lo[k] + rim;
        points[dim + k] = m->mark.hi[k] - rim;
    }
    froe_range range = froe_range_defaults();
    range.shape = ball ? FROE_SHAPE_BALL : FROE_SHAPE_BOX;
    range.points = points;
    range.radius = ball ? 0.5 * (m->mark.hi[0] - m->mark.lo[0]) : 0;
    froe_list found;
    const froe_status status = froe_query_range(query, &range, &found, diag);
    *ids = status ? NULL : malloc((found.count + 1) * sizeof **ids);
    if (status || !*ids) return status ? status : FROE_E_MEMORY;
    *count = 0;
    for (size_t i = 0; i < found.count; i++)
        if (radius_of(scene, found.ids[i]) >= m->least * (1 - 1e-9)) (*ids)[(*count)++] = found.ids[i];
    return FROE_OK;
}

/* A window around the mark with some of its neighbours: three times as wide, or more. */
static froe_status find_window(froe_query *query, const froe_scene *scene, const measured *m, froe_draw_options *o,
                               froe_diagnostic *diag) {
    const int dim = froe_scene_dim(scene);
    double points[6], wide = 0;
    froe_range range = froe_range_defaults();
    range.shape = FROE_SHAPE_BOX;
    range.points = points;
    uint64_t count = 0;
    const uint64_t enough = NEIGHBOURS + (uint64_t)o->accented_count;
    for (int k = 0; k < dim; k++) wide = fmax(wide, m->mark.hi[k] - m->mark.lo[k]);
    for (int i = 0; i < DOUBLINGS && count < enough && count < froe_scene_object_count(scene); i++, wide *= 2) {
        for (int k = 0; k < dim; k++) {
            points[k] = o->lo[k] = m->mark.lo[k] - wide;
            points[dim + k] = o->hi[k] = m->mark.hi[k] + wide;
        }
        const froe_status status = froe_query_count(query, &range, &count, diag);
        if (status) return status;
    }
    return FROE_OK;
}

static int draw(const cli_common *common, const char *path, froe_scene *scene, const measured *m,
                uint64_t max_fragments) {
    cli_draw library;
    const int code = cli_open_draw(&library);
    if (code) return code;
    froe_draw_options o;
    library.defaults(&o, sizeof o);
    froe_build_options b = froe_build_defaults();
    cli_progress bar = cli_progress_begin(common, "drawing");
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_diagnostic diag;
    uint32_t *ids = NULL;
    o.show = FROE_DRAW_OBJECTS;
    o.title = m->title;
    o.marks = &m->mark;
    o.mark_count = 1;
    o.locator = true;
    o.progress = b.progress = cli_progress_step;
    o.user = b.user = &bar;
    b.purpose = "query"; /* the quickest to build; the picture does not show it */
    b.threads = (unsigned)common->threads;
    b.max_fragments = cli_budget(max_fragments, scene);
    froe_status status = froe_build(scene, &b, &tree, &diag);
    if (!status) status = froe_query_new(tree, &query, &diag);
    if (!status) status = find_measured(query, scene, m, &ids, &o.accented_count, &diag);
    o.accented = ids;
    if (!status) status = find_window(query, scene, m, &o, &diag);
    if (!status) status = library.draw(tree, path, &o, &diag);
    free(ids);
    froe_query_free(query);
    froe_tree_free(tree);
    cli_progress_end(&bar);
    if (status == FROE_E_BUDGET) return cli_fail_build(path, max_fragments, scene, status, &diag);
    return status ? cli_fail_status(CLI_WRITING, path, status, &diag) : 0;
}

int measure_draw_cube(const cli_common *common, const char *path, froe_scene *scene, const froe_clutter *clutter,
                      uint64_t max_fragments) {
    measured m = {.mark.kind = FROE_DRAW_MARK_BOX};
    for (int k = 0; k < froe_scene_dim(scene); k++) m.mark.lo[k] = clutter->lo[k], m.mark.hi[k] = clutter->hi[k];
    snprintf(m.title, sizeof m.title, "Clutter: %u object%s meet%s a %s that holds no corner of their boxes",
             (unsigned)clutter->lower, support_plural(clutter->lower), clutter->lower == 1 ? "s" : "",
             froe_scene_dim(scene) == 2 ? "square" : "cube");
    return draw(common, path, scene, &m, max_fragments);
}

int measure_draw_ball(const cli_common *common, const char *path, froe_scene *scene, const froe_density *density,
                      uint64_t max_fragments) {
    measured m = {.mark.kind = FROE_DRAW_MARK_BALL, .least = density->radius};
    for (int k = 0; k < froe_scene_dim(scene); k++)
        m.mark.lo[k] = density->centre[k] - density->radius, m.mark.hi[k] = density->centre[k] + density->radius;
    snprintf(m.title, sizeof m.title, "Density: %u object%s as large as a %s meet%s it", (unsigned)density->lower,
             support_plural(density->lower), froe_scene_dim(scene) == 2 ? "circle" : "ball",
             density->lower == 1 ? "s" : "");
    return draw(common, path, scene, &m, max_fragments);
}
