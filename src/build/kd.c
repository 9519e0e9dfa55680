/* kd.c: kd-trees (Bentley 1975): every cut is axis-parallel, through an end of an object.
 *
 *     median     as many objects wholly below the cut as above it
 *     surface    where a line that comes into the bounds of the cell's objects is expected to meet fewest: objects of
 *                a side, times the surface of their bounds (MacDonald and Booth: Heuristics for ray tracing using space
 *                subdivision, 1990; Wald and Havran: On building fast kd-trees for ray tracing, 2006, whose clipped
 *                objects are fragments here). All ends are tried, in one walk over each axis.
 *
 * A baseline: nothing bounds how often objects are cut but the limit that split/axial.h sets. */
#include "build/method.h"
#include "split/axial.h"
#include "support/fail.h"
#include <math.h>

enum { COST, GROWTH, TUNING, AXES };
enum { MEDIAN, SURFACE };
enum { WIDEST, CYCLE, FIRST };

static const char *const costs[] = {"median", "surface", NULL};
static const char *const axes[] = {"widest", "cycle", "first", NULL};
static const froe_option_info options[] = {
    [COST] = {"cost", "what a cut is to do: halve the objects, or save a search most", MEDIAN, 0, 1, costs, true},
    [GROWTH] = {"growth", "fragments per fragment at which a cell is cut along its objects", 4, 1, 1000, NULL, false},
    [TUNING] = {0},
    [AXES] = {"axes", "axis of a median: the widest, in turn, or the first that separates anything", WIDEST, 0, 2, axes,
              true},
    {0},
};

typedef struct kd {
    split_axial axial;
    int cost, axes;
} kd;

/** The best cut so far; less is better. */
typedef struct best_cut {
    double cost;
    froe_cut cut;
} best_cut;

static void enter_kd_cut(best_cut *best, double cost, int axis, double value) {
    if (!(cost < best->cost) || !isfinite(value)) return;
    *best = (best_cut){cost, {.kind = FROE_CUT_AXIS, .axis = axis, .value = value}};
}

/* ------------------------------------------------------------------ median -- */

/** Half widths of the cell's objects: no overflow. */
static void find_widths(const split_work *work, const split_cell *cell, double *width) {
    for (int k = 0; k < work->set.scene->dim; k++) {
        double from = INFINITY, to = -INFINITY;
        for (uint32_t i = 0; i < cell->count; i++) {
            double low, high;
            split_extent(&work->set, work->set.items.data + cell->first + i, k, &low, &high);
            from = low < from ? low : from;
            to = high > to ? high : to;
        }
        width[k] = 0.5 * to - 0.5 * from;
    }
}

static bool find_median(const kd *d, split_work *work, const split_cell *cell, best_cut *best) {
    split_scratch *s = work->scratch;
    int dim = work->set.scene->dim;
    double width[FROE_MAX_DIM];
    if (d->axes == WIDEST) find_widths(work, cell, width);
    for (int turn = 0; turn < dim && best->cost == INFINITY; turn++) {
        int axis = turn, widest = -1; /* width < 0: tried already */
        for (int k = 0; k < dim && d->axes == WIDEST; k++)
            if (width[k] >= 0 && (widest < 0 || width[k] > width[widest])) widest = k;
        if (d->axes == WIDEST) axis = widest < 0 ? 0 : widest;
        if (d->axes == CYCLE) axis = (int)((cell->depth + (uint32_t)turn) % (uint32_t)dim);
        /* ends of extents, the most even cut */
        if (!split_axes_fill(&s->axes, &work->set, cell, axis)) return false;
        while (split_axes_next(&s->axes)) {
            if (!split_tally_useful(s->axes.tally)) continue;
            enter_kd_cut(best, fabs((double)s->axes.tally.negative - s->axes.tally.positive), axis, s->axes.value);
        }
        width[axis] = -1;
    }
    return true;
}

/* ----------------------------------------------------------------- surface -- */

/** Surfaces of a box as functions of its width on one axis: ends + side * width, in units of the whole. */
typedef struct surface {
    double ends, side;
} surface;

static surface surface_across(const double *width, int dim, int axis) {
    double most = 0, whole;
    surface s = {1, 0};
    for (int k = 0; k < dim; k++) most = width[k] > most ? width[k] : most;
    if (!(most > 0)) return (surface){1, 0};
    for (int k = 0; k < dim; k++) {
        double facet = 1; /* of the others, without k */
        for (int j = 0; j < dim; j++)
            if (j != k && j != axis) facet *= width[j] / most;
        if (k == axis)
            s.ends = facet;
        else
            s.side += facet;
    }
    whole = s.ends + s.side * (width[axis] / most);
    if (!(whole > 0)) return (surface){0, 1}; /* everything lies in a line: by its length */
    return (surface){s.ends / whole, s.side * (width[axis] / most) / whole};
}

static bool find_surface(split_work *work, const split_cell *cell, best_cut *best) {
    split_axes *a = &((split_scratch *)work->scratch)->axes;
    double width[FROE_MAX_DIM];
    find_widths(work, cell, width);
    for (int axis = 0; axis < work->set.scene->dim; axis++) {
        surface s = surface_across(width, work->set.scene->dim, axis);
        if (!split_axes_fill(a, &work->set, cell, axis)) return false;
        double from = a->low.data[0], size = 2 * width[axis];
        while (split_axes_next(a)) {
            const split_tally t = a->tally;
            if (!split_tally_useful(t)) continue;
            double share = size > 0 ? (0.5 * a->value - 0.5 * from) / (0.5 * size) : 0;
            double below = (double)t.negative + t.both, above = (double)t.positive + t.both;
            double cost = (s.ends + s.side * share) * below + (s.ends + s.side * (1 - share)) * above;
            enter_kd_cut(best, cost, axis, a->value);
        }
    }
    return true;
}

/* ------------------------------------------------------------------- build -- */

static split_verdict choose_kd_cut(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const kd *d = config;
    best_cut best = {.cost = INFINITY};
    if (split_axial_over(&d->axial, cell)) return split_refine_choose(&d->axial.refine, work, cell, cut);
    if (!(d->cost == SURFACE ? find_surface(work, cell, &best) : find_median(d, work, cell, &best)))
        return SPLIT_MEMORY;
    if (best.cost == INFINITY) return split_refine_choose(&d->axial.refine, work, cell, cut);
    *cut = best.cut;
    return SPLIT_CUT;
}

static froe_status build_kd(build_job *job, froe_tree **out) {
    kd d = {.axial = split_axial_of(job->scene, job->leaf, job->seed, job->option[GROWTH]),
            .cost = (int)job->option[COST],
            .axes = (int)job->option[AXES]};
    split_method method = {
        .config = &d, .choose = choose_kd_cut, .scratch_new = split_scratch_new, .scratch_free = split_scratch_free};
    split_job split = build_split_job(job);
    return split_grow(&split, &method, out);
}

const build_method build_method_kd = {
    .info = {.name = "kd",
             .summary = "a kd-tree: axis-parallel cuts through medians, or by surface area",
             .source = "Bentley 1975; MacDonald and Booth 1990; Wald and Havran 2006",
             .guarantee = "at most 2 growth n fragments by axis-parallel cuts; the rest is cut along the objects",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, BUILD_KINDS_ALL),
             .options = options},
    .tunable = true,
    .build = build_kd,
};
