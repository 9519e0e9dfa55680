/* refine.h: choosing cuts until a cell holds few enough objects.
 *
 * Candidates are the supporting planes of fragments, axis-parallel planes through ends of
 * extents, and, for kinds that are never cut, separating planes (separate.h). The best by
 * split_price_of() wins; a free cut, a fragment that crosses its cell from border to border,
 * beats all others since it splits nothing that its plane does not have to split
 * (Paterson and Yao 1990; Sacks, theorem 12.9).
 *
 * Boxes, balls and hulls are never split, but listed on both sides. Where they overlap, to tell two apart
 * copies many; a cell in which that does not pay becomes a crowded leaf (tree/crowd.h). */
#ifndef FROE_SPLIT_REFINE_H
#define FROE_SPLIT_REFINE_H
#include "split/axes.h"
#include "split/score/view.h"
#include "split/separate.h"

typedef struct split_refine {
    uint32_t leaf; /**< capacity */
    uint64_t seed;
    uint32_t supports;  /**< supporting planes tried per cell; 1: the random order of the classical analysis */
    uint32_t quantiles; /**< axis-parallel planes tried per axis; 0: an autopartition */
    uint32_t edges;     /**< planes through an edge and a vertex tried per cell where balance is due; 3D */
    uint32_t sample;    /**< fragments scored per candidate, at most */
    uint32_t checks;    /**< planes of a cell that are checked for fragments that only seem to lie in them, at most */
    double weight;      /**< of information against splits, in split_price_of() */
    double copy;        /**< what one more entry of a solid costs, in comparisons with all of its cell; 0: nothing */
    double height;      /**< cells deeper than this minus log_{4/3} m must be cut with balance; 0: no rule */
    uint32_t small;     /**< cells of at most so many segments or polygons are finished at once (finish/finish.h) */
    bool free_cuts;
    bool facets; /**< solids: planes of `supports` facets, drawn at random, in place of all others */
} split_refine;

typedef struct split_table split_table; /* finish.h */

/** What refining keeps per thread. */
typedef struct split_scratch {
    split_view view;
    split_price price;
    split_axes axes; /**< for builders */
    split_separator separator;
    split_table *table;
} split_scratch;

/** For methods whose scratch begins with a split_scratch, all zero so far. */
froe_status split_scratch_begin(const froe_allocator *alloc, split_scratch *scratch);
void split_scratch_end(const froe_allocator *alloc, split_scratch *scratch);
/** split_method.scratch_new and scratch_free of those that need nothing else. */
froe_status split_scratch_new(const void *config, split_work *work);
void split_scratch_free(split_work *work);

/** Must a cell with 2^bits fragments be cut with balance? */
static inline bool split_balance_due(const split_refine *config, uint32_t depth, double bits) {
    const double log_43 = 0.41503749927884381; /* log2(4/3) */
    return config->height > 0 && depth + bits / log_43 >= config->height;
}

/** Planes that the fragments of a cell are compared with, at most, before it is cut, and when it is. */
uint32_t split_refine_candidates(const split_refine *config, const froe_scene *scene);

/** The split_method.choose of autopartition, and of density below its guard stage. */
split_verdict split_refine_choose(const split_refine *config, split_work *work, const split_cell *cell, froe_cut *cut);
#endif
