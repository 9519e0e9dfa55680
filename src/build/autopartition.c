/* autopartition.c: cuts are supporting lines or planes of the objects themselves.
 *
 *         |  /            every cut is the line of a segment (2D) or the plane of a polygon (3D);
 *      ---+-/---          the object that gives it ends in the cut, the others go to a side or
 *         |/              are split. In random order n disjoint segments give at most
 *         /               n + 2 n ln n fragments on average (Sacks, lemma 12.1; Paterson and Yao 1990).
 *
 * Choosing the best of several random candidates gives fewer pieces in practice. Boxes are cut by the planes of their
 * facets, and never divided. */
#include "build/method.h"
#include "split/refine.h"

enum { CANDIDATES, TUNING, WEIGHT, FREE, SAMPLE };

static const char *const no_yes[] = {"no", "yes", NULL};
static const froe_option_info options[] = {
    [CANDIDATES] = {"candidates", "planes tried per cell, of objects or of facets of boxes; 1: random order", 1, 1,
                    1000, NULL, true},
    [TUNING] = {0},
    [WEIGHT] = {"weight", "bits of balance that outweigh one split (candidates > 1)", 0.1, 0, 100, NULL, false},
    [FREE] = {"free", "cut first with fragments that cross their cell", 1, 0, 1, no_yes, true},
    [SAMPLE] = {"sample", "fragments scored per candidate, at most", 512, 8, 1e6, NULL, true},
    {0},
};

static split_verdict choose_support(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    return split_refine_choose(config, work, cell, cut);
}

static froe_status build_autopartition(build_job *job, froe_tree **out) {
    split_refine refine = {.leaf = job->leaf,
                           .seed = job->seed,
                           .supports = (uint32_t)job->option[CANDIDATES],
                           .sample = (uint32_t)job->option[SAMPLE],
                           .weight = job->option[WEIGHT],
                           .free_cuts = job->option[FREE] != 0,
                           .facets = true};
    split_method method = {.config = &refine,
                           .choose = choose_support,
                           .scratch_new = split_scratch_new,
                           .scratch_free = split_scratch_free};
    split_job split = build_split_job(job);
    return split_grow(&split, &method, out);
}

const build_method build_method_autopartition = {
    .info = {.name = "autopartition",
             .summary = "cuts along the objects or facets of boxes, in random order or best of several",
             .source = "Paterson and Yao 1990; Sacks, lemma 12.1, theorem 12.9",
             .guarantee = "2D, disjoint: n + 2 n ln n fragments expected; 3D: O(n^2) expected",
             .kinds = BUILD_SERVES_ABOVE(BUILD_DIMS_ALL,
                                         1u << FROE_POINT | 1u << FROE_SEGMENT | 1u << FROE_POLYGON | 1u << FROE_BOX,
                                         1u << FROE_POINT | 1u << FROE_BOX),
             .options = options},
    .tunable = true,
    .rooted = true,
    .build = build_autopartition,
};
