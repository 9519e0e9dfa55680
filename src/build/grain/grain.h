/* grain.h: choosing cuts along the grain: planes through three vertices that follow the mesh; in the plane, lines
 * through two.
 *
 *      __/\__/\__          a supporting plane at a saddle crosses about sqrt(m) of the m triangles of
 *     /\ a--v--b /\        its cell; the plane through two consecutive edges a-v-b shares them, and
 *     \/__\/__\/__\        touches their neighbours without splitting them
 *
 * Candidates (candidates.h) compete by splits against information (price.h). Two regimes:
 *   many fragments for the levels left    balance counts: halve the cell
 *   at most 4 a level left, 100 in all    splits count: take off what comes off uncut, a dozen fragments at a time
 * with the height budget as a limit to both: no side may keep more fragments than the levels below can separate.
 * Measurements: docs/design/grain.md. */
#ifndef FROE_BUILD_GRAIN_GRAIN_H
#define FROE_BUILD_GRAIN_GRAIN_H
#include "split/grow.h"
#include <stdatomic.h>

typedef struct split_effort {
    uint32_t supports; /**< supporting planes tried */
    uint32_t starts;   /**< edges from which triples are sought */
    uint32_t improved; /**< of the best of these, vertices are exchanged */
    uint32_t turns;    /**< pencils swept from each */
    uint32_t sample;   /**< fragments scored, at most */
    bool again;        /**< look again where no cut is without splits */
} split_effort;

/** Cuts that were not balanced; several threads add to it. */
typedef struct split_grain_notes {
    atomic_uint unbalanced; /**< fragments of the largest cell that was to be cut with balance and was not */
    atomic_bool medians;    /**< vertices were halved instead of fragments */
} split_grain_notes;

typedef struct split_grain {
    uint32_t leaf; /**< capacity */
    uint64_t seed;
    split_effort effort;
    double height; /**< levels; 0: no limit */
    split_thin_rule thin;
    bool deceived; /**< fragments that only seem to lie in planes are not marked */
    uint32_t peel; /**< cells of at most so many fragments are peeled without a limit */
    split_grain_notes *notes;
} split_grain;

/** For split_method; config is a split_grain. */
froe_status split_grain_scratch_new(const void *config, split_work *work);
void split_grain_scratch_free(split_work *work);
split_verdict split_grain_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut);
/** Levels that a cell of n fragments needs when every cut is balanced. */
double split_grain_need(uint32_t leaf, double n);
#endif
