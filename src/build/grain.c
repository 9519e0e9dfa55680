/* grain.c: the BSP with the fewest pieces: cuts along the mesh.
 *
 *      __/\__/\__        a froe splits wood along the grain: most cuts are planes through three vertices, above all
 *     /\ a--v--b /\      through two consecutive edges of the mesh, which touch their neighbours and split few
 *     \/__\/__\/__\      (build/grain/grain.h)
 *
 * Height. A cell of m fragments needs N(m) levels when every cut leaves at most 7/10 on a side: N(m) = m for m <= 4,
 * and 4 + log_{10/7} (m / 4) beyond, less than 1.95 log2 m. A cut is balanced when both children need no more levels
 * than are left of H = C log2 n + 2, or have at most 7/10 of the cell. So depth + N(m) never exceeds H (or N(n), if
 * that is more), except where no balanced cut is found:
 *   - axis-parallel cuts at a median of vertices: at most log2 v + 1 for each axis, for each of them halves the number
 *     of vertices that lie between others on that axis, which no other cut increases;
 *   - other cuts, which take at least one fragment off each side: at most U on a path, where U is the number of
 *     fragments in the largest cell to which that happened. Each adds one level at most.
 * Hence the promise: H, + 3 (log2 v + 1) if there were such medians, + U; and where cells were thinned out, which a
 * path meets once at most, the levels of their guards and the fragments of the largest cell left by them.
 *
 * Size. Fragments are charged (split/charge/thin.h): cells where the charge ends have GROWTH n fragments at most, and
 * those that were thinned out what the guards made of them. */
#include "build/grain/grain.h"
#include "base/log2.h"
#include "build/method.h"
#include "support/fail.h"

enum { EFFORT, HEIGHT, TUNING, PEEL, GUARDS, MARKS };
#define GROWTH 1.4                   /* fragments in place of one at which cells are thinned out: */
enum { LEAST = 512, OBJECTS = 128 }; /* cells of so many, into cubes with the guards of so many */
enum { EFFORT_LOG = 2, EFFORT_MIN = 3, LOW = 2 };

static const char *const efforts[] = {"fast", "default", "log", "min", NULL};
static const froe_option_info options[] = {
    [EFFORT] = {"effort", "how long to look for good cuts; min: and in a tree two and a half times as high", 1, 0, 3,
                efforts, true},
    [HEIGHT] = {"height", "C: at most C log2 n + 2 levels, if cuts can be found; 0: no limit; -1: 2, with effort=min 5",
                -1, -1, 1000, NULL, false},
    [TUNING] = {0},
    [PEEL] = {"peel", "cells of so many pieces may take as many levels: fewer pieces", 0, 0, 1e9, NULL, true},
    [GUARDS] = {"guards", "left in a cube where a cell is thinned out; 0: cells are not", -1, -1, 1e9, NULL, true},
    [MARKS] = {"marks", "pieces that only seem to lie in planes are marked", 1, 0, 1, NULL, true},
    {0},
};

static const split_effort presets[] = {
    {.supports = 8, .starts = 4, .improved = 4, .turns = 6, .sample = 512},
    {.supports = 20, .starts = 24, .improved = 6, .turns = 12, .sample = 2048},
    {.supports = 80, .starts = 160, .improved = 40, .turns = 20, .sample = 8192},
    {.supports = 80, .starts = 160, .improved = 40, .turns = 20, .sample = 8192, .again = true},
};

static void resolve_grain(const froe_scene *scene, uint32_t leaf, double *option) {
    (void)leaf;
    if (option[GUARDS] < 0) option[GUARDS] = OBJECTS << scene->dim;
    if (option[HEIGHT] < 0) option[HEIGHT] = option[EFFORT] == EFFORT_MIN ? 5 : LOW;
}

/** See the head of this file. Every cut leaves fewer fragments on either side, so n is a bound, too; but for a first
 * cut that is given, below which all of them may be on one side. */
static double promised_height(const build_job *job, const split_grain *grain, const split_thin_notes *thinned) {
    double n = job->scene->object_count, v = job->scene->vertex_count;
    double need = split_grain_need(job->leaf, n), bound = grain->height > need ? grain->height : need;
    if (atomic_load(&grain->notes->medians)) bound += 3 * (base_log2(v + 1) + 1);
    bound += atomic_load(&grain->notes->unbalanced) + grain->peel + thinned->largest;
    return (grain->height > 0 && bound < n ? bound : n) + thinned->height + build_levels_given(job);
}

/** See split/charge/thin.h. Growth is rounded at every cut. */
static double promised_fragments(const build_job *job, const split_thin_notes *thinned) {
    return GROWTH * (1 + 0x1p-12) * job->scene->object_count + (double)(thinned->after - thinned->before);
}

/** A tree of at most C log2 n + 2 levels, if cuts can be found. */
static froe_status grow_grain(build_job *job, const split_job *split, int effort, double c, froe_tree **out) {
    split_grain_notes notes = {0, false};
    split_grain grain = {.leaf = job->leaf,
                         .seed = job->seed,
                         .effort = presets[effort],
                         .thin = {GROWTH, LEAST, (uint32_t)job->option[GUARDS]},
                         .peel = (uint32_t)job->option[PEEL],
                         .deceived = job->option[MARKS] == 0,
                         .notes = &notes};
    if (c > 0) grain.height = c * base_log2(job->scene->object_count + 1.0) + 2;
    split_thin_notes thinned = {0};
    split_job grown = *split;
    grown.thinned = &thinned;
    split_method method = {.config = &grain,
                           .choose = split_grain_choose,
                           .ahead = true,
                           .scratch_new = split_grain_scratch_new,
                           .scratch_free = split_grain_scratch_free,
                           .height = grain.height > 0 ? grain.height + grain.peel : 0,
                           .thin = grain.thin};
    froe_status status = split_grow(&grown, &method, out);
    if (status) return status;
    tree_promise_anew(*out, "height", promised_height(job, &grain, &thinned));
    tree_promise_anew(*out, "charged_fragments", promised_fragments(job, &thinned));
    return FROE_OK;
}

/** More levels mean fewer pieces, except where every cut has to split: the low tree of effort=log, or a taller one if
 * that has fewer. */
static froe_status grow_two(build_job *job, froe_tree **out) {
    split_job split = build_split_job(job);
    froe_tree *low = NULL;
    split.diag = NULL;
    split.span *= 0.5;
    froe_status status = grow_grain(job, &split, EFFORT_LOG, LOW, &low);
    const size_t pieces = status ? 0 : froe_tree_piece_count(low);
    const bool fewest = !status && pieces <= job->scene->object_count;
    if (!fewest && (!status || status == FROE_E_BUDGET)) {
        if (pieces) split.max_fragments = pieces - 1;
        status = grow_grain(job, &split, EFFORT_MIN, job->option[HEIGHT], out);
    }
    if (fewest || (pieces && status == FROE_E_BUDGET)) {
        *out = low;
        return FROE_OK;
    }
    froe_tree_free(low);
    return split_explain(job->diag, job->max_fragments, status);
}

static froe_status build_grain(build_job *job, froe_tree **out) {
    const double c = job->option[HEIGHT];
    const split_job split = build_split_job(job);
    build_promise(job, "height", 0, 0); /* renewed once they are known */
    build_promise(job, "charged_fragments", 0, 0);
    if (job->option[EFFORT] == EFFORT_MIN && (c == 0 || c > LOW)) return grow_two(job, out);
    return grow_grain(job, &split, (int)job->option[EFFORT], c, out);
}

const build_method build_method_grain = {
    .info = {.name = "grain",
             .summary = "cuts along the mesh, through its vertices: fewest pieces",
             .source = "froe's own; information against splits, after Paterson and Yao 1990",
             .guarantee =
                 "height <= C log2 n + 2, + 3 log2 v + U where no cut is balanced, + levels of guards in nests",
             .kinds = BUILD_SERVES(1u << 2 | 1u << 3, 1u << FROE_POINT | 1u << FROE_SEGMENT | 1u << FROE_POLYGON),
             .options = options},
    .tunable = true,
    .resolve = resolve_grain,
    .rooted = true,
    .build = build_grain,
};
