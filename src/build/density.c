/* density.c: BSPs whose size is bounded by how cluttered the scene is.
 *
 *   guard stage    +----+--+--+     cubes with at most k corners of bounding boxes strictly inside
 *                  |    |/ | /|     meet few objects when the scene has low density: the objects
 *                  |  / +--+--+     are carried down this tree (guard_tree.h)
 *                  | /  | /|  |
 *   refinement     +----+--+--+     inside: the best of some supporting and axis-parallel planes,
 *                                   free cuts first, until a cell holds at most `leaf` objects
 *
 * de Berg, "Linear size binary space partitions for uncluttered scenes" (lemmas 2.1, 2.2, theorem 2.5);
 * Sacks, lemmas 12.6 and 12.7, theorems 12.8 and 12.9, with lambda by doubling.
 *
 * On scenes that are cluttered after all the guard stage would split without end. It
 * therefore weighs its cells: growth = product of (fragments after / fragments before) over the
 * guard cuts above. Sum over cells of fragments / growth never exceeds n, so stopping where growth
 * reaches a limit G keeps the stage below 2 G n fragments, whatever the scene. It also leaves
 * cells of few objects that it cannot thin out any more: the star around a common vertex.
 *
 * Cells that it leaves before the leaves of the guard tree may have many objects. There, refinement alone has no bound
 * of size: it is on trial against further guard cuts, and the smaller of both stays, but for a constant factor
 * (guard/trial.h). That makes the size linear; docs/design/density.md has the proof. */
#include "base/log2.h"
#include "build/method.h"
#include "split/finish/finish.h"
#include "split/guard/shapes.h"
#include "split/guard/trial.h"
#include "split/refine.h"
#include "support/fail.h"
#include <stdatomic.h>
#include <string.h>

enum {
    MODE,
    K,
    FORM,
    GROWTH,
    HEIGHT,
    GUARDS,
    TUNING,
    STOP,
    SUPPORTS,
    QUANTILES,
    EDGES,
    WEIGHT,
    FREE,
    SMALL,
    SAMPLE,
    CHECKS,
    COPY,
    TRIALS
};
enum { STAR = 1024 }; /* most objects of a cell that may be left for being barren */
enum { MODE_FIXED, MODE_DOUBLING, MODE_TUNED };

static const char *const modes[] = {"fixed", "doubling", "tuned", NULL};
static const char *const forms[] = {"auto", "slabs", "cross", NULL};
static const char *const guards[] = {"object", "shape", NULL};
static const char *const no_yes[] = {"no", "yes", NULL};
static const froe_option_info options[] = {
    [MODE] = {"mode", "how k is found: fixed, by doubling lambda, or tuned by cost", 0, 0, 2, modes, true},
    [K] = {"k", "guards left in a cell of the guard stage; -1: 256 in the plane (64 of shapes), 16 elsewhere", -1, -1,
           1e9, NULL, true},
    [FORM] = {"form", "outer cells of a shrink: slabs (de Berg) or a cross (Sacks)", 0, 0, 2, forms, true},
    [GROWTH] = {"growth", "fragments per object at which the guard stage gives a cell up; 0: never", 1.5, 0, 1e9, NULL,
                false},
    [HEIGHT] = {"height", "balanced cuts beyond this many times log2 n levels; 0: no rule", 2, 0, 1e9, NULL, false},
    [GUARDS] = {"guards", "what has the guards of its box: each object, or each group of them", 0, 0, 1, guards, true},
    [TUNING] = {0},
    [STOP] = {"stop", "the guard stage leaves cells of so many objects to refinement; -1: by dimension", -1, -1, 1e9,
              NULL, true},
    [SUPPORTS] = {"supports", "supporting planes tried per cell; -1: by dimension", -1, -1, 1000, NULL, true},
    [QUANTILES] = {"quantiles", "axis-parallel planes tried per cell and axis; -1: by dimension", -1, -1, 1000, NULL,
                   true},
    [EDGES] = {"edges", "planes through an edge and a vertex tried per cell where balance is due", 20, 0, 1000, NULL,
               true},
    [WEIGHT] = {"weight", "bits of information that outweigh one split", 0.1, 0, 100, NULL, false},
    [FREE] = {"free", "cut first with fragments that cross their cell", 1, 0, 1, no_yes, true},
    [SMALL] = {"small", "cells of at most so many segments or polygons are finished from a table of sides", 48, 0, 48,
               NULL, true},
    [SAMPLE] = {"sample", "fragments scored per candidate, at most", 512, 8, 1e6, NULL, true},
    [CHECKS] = {"checks", "planes per cell that are checked for what only seems to lie in them", 64, 0, 64, NULL, true},
    [COPY] = {"copy", "what it costs to list a solid once more, in comparisons with all of its cell; 0: none is spared",
              0.5, 0, 100, NULL, false},
    [TRIALS] = {"trials", "tests that refinement on trial is allowed, by the usual ones; 0: it is never taken back", 1,
                0, 1e9, NULL, false},
    {0},
};

/* What the guard stage of one probe met; several threads add to it. */
typedef struct loads {
    atomic_uint_least64_t leaves, fragments, squares;
    atomic_uint_least32_t largest;
    uint32_t most; /* a leaf above this ends the probe */
} loads;

typedef struct density {
    split_refine refine;
    const split_guard_tree *guard;
    uint32_t stop;
    uint32_t patience; /* barren cuts in a row */
    float growth;
    uint32_t levels;            /* of the guard stage, at most */
    loads *probe;               /* NULL when building, and then job and sums are set */
    const split_shapes *shapes; /* when probing for shapes, otherwise NULL */
    build_job *job;
    split_sums *sums; /* of the build */
} density;

/** In the plane axis-parallel cuts never beat the lines of segments; other kinds need them. */
static void resolve_density(const froe_scene *scene, uint32_t leaf, double *option) {
    bool plane = scene->dim == 2, segments = plane;
    for (uint32_t i = 0; i < scene->object_count && segments; i++) segments = scene_form(scene, i) == FROE_SEGMENT;
    if (option[K] < 0) option[K] = !plane ? 16 : option[GUARDS] != 0 ? 64 : 256;
    if (option[STOP] < 0) option[STOP] = plane ? (leaf > 32 ? leaf : 32) : 256;
    if (option[SUPPORTS] < 0) option[SUPPORTS] = plane ? 8 : 20;
    if (option[QUANTILES] < 0) option[QUANTILES] = segments ? 0 : plane ? 3 : 10;
}

/* ------------------------------------------------------------ the two stages -- */

static bool in_guard_stage(const void *config, const split_cell *cell) {
    const density *d = config;
    uint32_t load = split_load(cell);
    if (!d->guard->nodes.data[cell->guard].child) return false;
    if (load <= d->stop || load <= d->refine.leaf) return false;
    if (cell->depth >= d->levels) return false;
    if (load <= STAR && cell->barren >= d->patience) return false;
    return d->growth <= 0 || cell->growth < d->growth;
}

static split_verdict choose_density_cut(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const density *d = config;
    return split_refine_choose(&d->refine, work, cell, cut);
}

static froe_status finish_density_cell(const void *config, split_work *work, const split_cell *cell, bool *done) {
    const density *d = config;
    return split_finish(&d->refine, work, cell, done);
}

static bool probe_in_guard_stage(const void *config, const split_cell *cell) {
    const density *d = config;
    return d->guard->nodes.data[cell->guard].child && split_load(cell);
}

/** Objects or shapes that a cell meets. */
static uint32_t count_load(const density *d, split_work *work, const split_cell *cell) {
    uint32_t load = 0;
    if (!d->shapes) return cell->count;
    split_shapes_begin(work->scratch);
    for (uint32_t i = 0; i < cell->count; i++)
        load += split_shapes_first(d->shapes, work->scratch, work->set.items.data[cell->first + i].object);
    return load;
}

static froe_status probe_scratch_new(const void *config, split_work *work) {
    const density *d = config;
    if (!d->shapes) return FROE_OK;
    work->scratch = support_calloc(&work->set.alloc, 1, sizeof(split_shape_marks));
    return work->scratch ? split_shape_marks_make(&work->set.alloc, d->shapes, work->scratch) : FROE_E_MEMORY;
}

static void probe_scratch_free(split_work *work) {
    if (!work->scratch) return;
    split_shape_marks_free(&work->set.alloc, work->scratch);
    support_free(&work->set.alloc, work->scratch, sizeof(split_shape_marks));
    work->scratch = NULL;
}

/** Ends the cell where the guard stage ends, and notes its load. */
static split_verdict probe(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const density *d = config;
    const uint32_t load = count_load(d, work, cell);
    (void)cut;
    if (load > d->probe->most) return SPLIT_GIVE_UP;
    uint_least32_t largest = atomic_load(&d->probe->largest);
    while (load > largest && !atomic_compare_exchange_weak(&d->probe->largest, &largest, load)) continue;
    atomic_fetch_add(&d->probe->leaves, 1);
    atomic_fetch_add(&d->probe->fragments, cell->count);
    atomic_fetch_add(&d->probe->squares, (uint64_t)cell->count * cell->count);
    return SPLIT_LEAF;
}

/* ------------------------------------------------------------- choosing k -- */

typedef struct guard_stage {
    build_job *job;
    split_grid_boxes grid_boxes;
    split_shapes shapes; /* none if objects have the guards; */
    split_grid_boxes shape_boxes;
    split_guard_tree tree;
    split_lowest_nodes lowest;
} guard_stage;

static froe_status explain_guard_stage(const guard_stage *g, froe_status status) {
    if (status == FROE_E_LIMIT)
        return support_fail(g->job->diag, status, "More than 2^31 guards or fragments are needed.");
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(g->job->diag);
    return status ? support_fail_memory(g->job->diag) : FROE_OK;
}

static froe_status make_tree(guard_stage *g, uint32_t k, double span) {
    static const split_form form[] = {SPLIT_FORM_DEFAULT, SPLIT_FORM_U, SPLIT_FORM_S};
    split_guard_options o = {.dim = g->job->scene->dim, .k = k, .form = form[(int)g->job->option[FORM]]};
    split_guard_tree_free(&g->job->alloc, &g->tree);
    split_lowest_nodes_free(&g->job->alloc, &g->lowest);
    const split_grid_boxes *guarded = g->shapes.count ? &g->shape_boxes : &g->grid_boxes;
    froe_status status = split_guard_tree_of(&g->job->alloc, g->job->task, span, &o, guarded, &g->tree);
    if (!status) status = split_lowest_nodes_make(&g->job->alloc, g->job->task, &g->grid_boxes, &g->tree, &g->lowest);
    return explain_guard_stage(g, status);
}

/** A job for the shared loop with this guard tree. */
static split_job guard_job(const guard_stage *g) {
    split_job split = build_split_job(g->job);
    split.guard = &g->tree;
    split.lowest = &g->lowest;
    return split;
}

/** Carries the objects down the guard tree without building anything. FROE_E_BUDGET: a load above `most`, which
 * is no failure yet, so it gets no sentence. */
static froe_status measure_loads(guard_stage *g, uint32_t most, loads *out) {
    out->leaves = out->fragments = out->squares = 0;
    out->largest = 0;
    out->most = most;
    density d = {.guard = &g->tree, .probe = out, .shapes = g->shapes.count ? &g->shapes : NULL};
    split_method method = {.config = &d,
                           .choose = probe,
                           .in_guard_stage = probe_in_guard_stage,
                           .scratch_new = probe_scratch_new,
                           .scratch_free = probe_scratch_free};
    split_job split = guard_job(g);
    split.max_fragments = 0;
    split.span *= 0.1;
    split.diag = NULL;
    froe_status status = split_grow(&split, &method, NULL);
    return status == FROE_E_BUDGET ? status : explain_guard_stage(g, status);
}

/** Sacks' loop, made safe: a round is given up at the first leaf above (1 + c_d) lambda objects, so that it
 * costs O(n) fragments; it ends at the latest with lambda < 2 * density of the scene. */
static froe_status by_doubling(guard_stage *g) {
    uint32_t n = g->job->scene->object_count;
    loads l;
    for (uint64_t lambda = 2;; lambda *= 2) {
        froe_status status = make_tree(g, (uint32_t)lambda, 0);
        uint64_t most = (1 + (uint64_t)g->tree.cell_load) * lambda;
        if (!status) status = measure_loads(g, most > n ? n : (uint32_t)most, &l);
        if (!status) build_promise(g->job, "guard_load", (double)most, (double)l.largest);
        if (status != FROE_E_BUDGET) return status;
    }
}

/** The k of least estimated cost among powers of two: leaves + 2 fragments + sum of squared loads / 4. */
static froe_status by_cost(guard_stage *g) {
    double least = 0;
    uint32_t best = 2;
    for (uint32_t k = 2; k <= 256; k *= 2) {
        loads l;
        froe_status status = make_tree(g, k, 0);
        if (!status) status = measure_loads(g, UINT32_MAX, &l);
        if (status) return status;
        double cost = (double)l.leaves + 2 * (double)l.fragments + 0.25 * (double)l.squares;
        if (k == 2 || cost < least) least = cost, best = k;
    }
    return make_tree(g, best, 0);
}

static froe_status place_boxes(guard_stage *g) {
    const build_job *job = g->job;
    froe_status status = split_grid_boxes_make(&job->alloc, job->task, job->scene, &g->grid_boxes);
    if (!status && job->option[GUARDS] != 0) {
        status = split_shapes_make(&job->alloc, job->scene, &g->shapes);
        if (!status) status = split_grid_boxes_make(&job->alloc, job->task, g->shapes.boxes, &g->shape_boxes);
    }
    return status;
}

static froe_status find_k(guard_stage *g) {
    int mode = (int)g->job->option[MODE];
    froe_status status = place_boxes(g);
    if (status) return explain_guard_stage(g, status);
    if (mode == MODE_DOUBLING) return by_doubling(g);
    if (mode == MODE_TUNED) return by_cost(g);
    return make_tree(g, (uint32_t)g->job->option[K], 0.12);
}

/* ------------------------------------------------------------------ build -- */

static split_refine refine_of(const build_job *job) {
    double n = job->scene->object_count;
    return (split_refine){.leaf = job->leaf,
                          .seed = job->seed,
                          .supports = (uint32_t)job->option[SUPPORTS],
                          .quantiles = (uint32_t)job->option[QUANTILES],
                          .edges = (uint32_t)job->option[EDGES],
                          .sample = (uint32_t)job->option[SAMPLE],
                          .checks = (uint32_t)job->option[CHECKS],
                          .weight = job->option[WEIGHT],
                          .copy = job->option[COPY],
                          .height = job->option[HEIGHT] * base_log2(n + 2),
                          .small = (uint32_t)job->option[SMALL],
                          .free_cuts = job->option[FREE] != 0};
}

/** Only for what is cut: solids are listed as often as that pays (refine.h). */
static bool counts_pieces(const froe_scene *scene) {
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (!split_is_cut(scene_form(scene, i))) return false;
    return true;
}

/** What the tree is promised to be, by what was met on the way (docs/design/density.md). */
static void promise(const void *config) {
    const density *d = config;
    build_job *job = d->job;
    const split_books *books = &d->sums->books;
    const double n = job->scene->object_count, growth = job->option[GROWTH];
    build_promise(job, "guard_leaves", d->guard->promised, (double)d->guard->leaves);
    /* Cells have grown by less than twice the growth; the first one by 1, whatever the growth. */
    if (growth > 0)
        build_promise(job, "guard_fragments", fmax(2 * growth, 1) * n + books->beyond, (double)books->fragments);
    if (job->root) return; /* then there is no guard stage */
    if (counts_pieces(job->scene)) build_promise(job, "fragments", books->pieces, 0);
    if (books->height + books->peels < n) build_promise(job, "height", books->height + books->peels, 0);
    build_promise(job, "tests", d->sums->tests_allowed + d->guard->height * d->sums->carried, d->sums->tests);
}

/** No cut splits points, so that they need no guard stage but for speed; where they are nested it would be high. */
static uint32_t levels_of_guard_stage(const build_job *job, double height) {
    for (uint32_t i = 0; i < job->scene->object_count; i++)
        if (scene_form(job->scene, i) != FROE_POINT) return UINT32_MAX;
    return height > 0 ? (uint32_t)height : UINT32_MAX;
}

/** Grows the tree with its refinement on trial. */
static froe_status grow_on_trial(const guard_stage *g, density *d, split_method *method, froe_tree **out) {
    build_job *job = g->job;
    split_sums sums = {0};
    uint32_t *leaves = trial_leaves(&job->alloc, &g->tree);
    if (!leaves) return support_fail_memory(job->diag);
    const double tests = job->option[TRIALS] > 0 ? job->option[TRIALS] : 1;
    const split_trial_terms terms = {.leaves = leaves,
                                     .candidates = tests * split_refine_candidates(&d->refine, job->scene),
                                     .idle = job->option[TRIALS] == 0};
    split_job split = guard_job(g);
    split.trials = &terms;
    split.sums = &sums;
    d->job = job;
    d->sums = &sums;
    method->note = promise;
    size_t bytes = (size_t)job->scene->dim * sizeof(double); /* beyond, meta stays 0 */
    memcpy(job->meta.root_lo, g->tree.lo, bytes);
    memcpy(job->meta.root_hi, g->tree.hi, bytes);
    froe_status status = split_grow(&split, method, out);
    trial_leaves_free(&job->alloc, &g->tree, leaves);
    return status;
}

static froe_status build_density(build_job *job, froe_tree **out) {
    guard_stage g = {.job = job};
    /* Sorting extents takes half of the time, and few pictures do not pay for it (docs/design/view.md). */
    if (job->picture) job->option[QUANTILES] = 0;
    froe_status status = find_k(&g);
    if (!status) {
        density d = {.refine = refine_of(job), .guard = &g.tree, .stop = (uint32_t)job->option[STOP]};
        d.growth = (float)job->option[GROWTH];
        d.patience = 2 * (uint32_t)job->scene->dim;
        d.levels = levels_of_guard_stage(job, d.refine.height);
        split_method method = {.config = &d,
                               .choose = choose_density_cut,
                               .peels_first = true,
                               .finish = finish_density_cell,
                               .in_guard_stage = in_guard_stage,
                               .scratch_new = split_scratch_new,
                               .scratch_free = split_scratch_free};
        status = grow_on_trial(&g, &d, &method, out);
    }
    split_lowest_nodes_free(&job->alloc, &g.lowest);
    split_grid_boxes_free(&job->alloc, &g.grid_boxes);
    split_grid_boxes_free(&job->alloc, &g.shape_boxes);
    split_shapes_free(&job->alloc, &g.shapes);
    split_guard_tree_free(&job->alloc, &g.tree);
    return status;
}

const build_method build_method_density = {
    .info = {.name = "density",
             .summary = "guards lead to cells of few objects, then the best of several cuts",
             .source = "de Berg, theorem 2.5; Sacks, lemma 12.7, theorems 12.8 and 12.9",
             .guarantee =
                 "O(n) pieces at density lambda: of O(n / k) guard cells each cube meets k + c_d lambda objects",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, BUILD_KINDS_ALL),
             .options = options},
    .tunable = true,
    .resolve = resolve_density,
    .rooted = true,
    .build = build_density,
};
