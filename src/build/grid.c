/* grid.c: a uniform grid, as a tree of axis-parallel cuts.
 *
 *     |   |   |   |         The lines of a grid of about n / load cubes over the bounds of the scene. A cell is cut by
 *     +---+---+---+---      the middle one of its lines that separate objects, across the axis that has most of them;
 *     |   |   |   |         so the tree over the grid is balanced, and cells of the grid that hold few objects stay
 *     +---+---+---+---      together. Where no line is left, cells are cut along their objects.
 *
 * A baseline: right where objects are small and evenly spread, and nowhere else. */
#include "build/method.h"
#include "split/axial.h"
#include "support/fail.h"
#include <math.h>

enum { GROWTH, TUNING, LOAD };
#define LINES_MOST 0x1p30 /* on an axis */

static const froe_option_info options[] = {
    [GROWTH] = {"growth", "fragments per fragment at which a cell is cut along its objects", 4, 1, 1000, NULL, false},
    [TUNING] = {0},
    [LOAD] = {"load", "objects for each cell of the grid", 2, 0.001, 1e9, NULL, false},
    {0},
};

typedef struct grid {
    split_axial axial;
    double lo[FROE_MAX_DIM], step[FROE_MAX_DIM]; /* line i is lo + i step, i = 1 .. lines */
    double lines[FROE_MAX_DIM];
} grid;

static void lay(grid *g, const froe_scene *s, double cubes) {
    double width[FROE_MAX_DIM], most = 0;
    for (int k = 0; k < s->dim; k++) {
        width[k] = 0.5 * s->hi[k] - 0.5 * s->lo[k];
        most = width[k] > most ? width[k] : most;
    }
    if (!(most > 0)) return;
    for (int k = 0; k < s->dim; k++) width[k] /= most;
    /* The edge of a cube, in units of the largest extent: such that cubes fill the bounds. Widths that are less than
     * an edge count as one cube. Bisection: how many there are falls as the edge grows. */
    double low = 0x1p-30, high = 1;
    for (int turn = 0; turn < 60; turn++) {
        double edge = 0.5 * low + 0.5 * high, count = 1;
        for (int k = 0; k < s->dim; k++) count *= width[k] > edge ? width[k] / edge : 1;
        *(count > cubes ? &low : &high) = edge;
    }
    double edge = high;
    for (int k = 0; k < s->dim; k++) {
        double parts = width[k] > edge ? floor(width[k] / edge + 0.5) : 1;
        g->lo[k] = s->lo[k];
        g->lines[k] = parts > LINES_MOST ? LINES_MOST : parts - 1;
        g->step[k] = 2 * (0.5 * s->hi[k] / parts - 0.5 * s->lo[k] / parts);
    }
}

static double line(const grid *g, int k, double i) {
    return g->lo[k] + i * g->step[k];
}

/** The first and last of the lines in [from, to]; last < first: there is none. */
static void lines_in(const grid *g, int k, double from, double to, double *first, double *last) {
    *first = ceil((from - g->lo[k]) / g->step[k]) - 1;
    *last = floor((to - g->lo[k]) / g->step[k]) + 1;
    *first = *first > 1 ? *first : 1; /* NaN, too */
    *last = *last < g->lines[k] ? *last : g->lines[k];
    for (int i = 0; i < 3 && *first <= *last && line(g, k, *first) < from; i++) ++*first;
    for (int i = 0; i < 3 && *first <= *last && line(g, k, *last) > to; i++) --*last;
}

static split_verdict choose_grid_line(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const grid *g = config;
    double most = 0;
    if (split_axial_over(&g->axial, cell)) return split_refine_choose(&g->axial.refine, work, cell, cut);
    for (int k = 0; k < work->set.scene->dim; k++) {
        double from, to, first, last;
        if (!(g->lines[k] > 0) || !split_axes_gap(&work->set, cell, k, &from, &to)) continue;
        lines_in(g, k, from, to, &first, &last);
        if (!(last - first + 1 > most)) continue;
        most = last - first + 1;
        *cut = (froe_cut){.kind = FROE_CUT_AXIS, .axis = k, .value = line(g, k, floor(0.5 * first + 0.5 * last))};
    }
    return most > 0 ? SPLIT_CUT : split_refine_choose(&g->axial.refine, work, cell, cut);
}

static froe_status build_grid(build_job *job, froe_tree **out) {
    grid g = {.axial = split_axial_of(job->scene, job->leaf, job->seed, job->option[GROWTH])};
    split_method method = {
        .config = &g, .choose = choose_grid_line, .scratch_new = split_scratch_new, .scratch_free = split_scratch_free};
    split_job split = build_split_job(job);
    if (job->scene->object_count) lay(&g, job->scene, job->scene->object_count / job->option[LOAD]);
    return split_grow(&split, &method, out);
}

const build_method build_method_grid = {
    .info = {.name = "grid",
             .summary = "a uniform grid, as a balanced tree of axis-parallel cuts",
             .source = "Bentley and Friedman: Data structures for range searching, 1979",
             .guarantee = "at most 2 growth n fragments by lines of the grid; the rest is cut along the objects",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, BUILD_KINDS_ALL),
             .options = options},
    .tunable = true,
    .build = build_grid,
};
