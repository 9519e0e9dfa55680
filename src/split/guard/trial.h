/* trial.h: where refinement costs too much, its cell goes on down the guard tree instead.
 *
 *     guard stage      v            1. A cell v where the guard stage ends, with x fragments and g leaves of the guard
 *                     / \              tree below, is refined. Its allowance a is 3 x / 2 + 4 g pieces, in the plane
 *     refinement     /\ /\             3 x + 4 g, and levels and tests (trial.c). Within it, refinement stays.
 *
 *     guard cuts       v            2. Otherwise refinement waits, and v takes its next guard cuts. Where the load has
 *                     / \              halved, refinement is tried, and taken back if it exceeds its allowance. In
 *     refinement     a   b  /\         leaves of the guard tree it is final. If all of that makes at most 3 a / 2
 *     refinement     /\ /\             pieces, it stays, and what waits is removed.
 *
 *     refinement       v            3. Otherwise that is taken back, and refinement goes on where it waited, up to 8 a.
 *                     /\ /\            Then guard cuts may make 12 a pieces, refinement 64 a, and so on.
 *
 * So v has at most a pieces, or those of guard cuts, or less than 16 / 3 times as many. Guard leaves of a scene of low
 * density have few objects (de Berg, lemmas 2.1 and 2.2; Sacks, lemma 12.6), and x fragments in one become at most x^d
 * pieces. So the tree has linear size, and docs/design/density.md says which. */
#ifndef FROE_SPLIT_GUARD_TRIAL_H
#define FROE_SPLIT_GUARD_TRIAL_H
#include "split/grow.h"

/** The leaves below every node of a guard tree, to be freed by trial_leaves_free; NULL without memory. */
uint32_t *trial_leaves(const froe_allocator *alloc, const split_guard_tree *guard);
void trial_leaves_free(const froe_allocator *alloc, const split_guard_tree *guard, uint32_t *leaves);

/** Is a cell to be cut by its guard node? */
bool trial_cuts_by_guard(const split_job *job, const split_method *method, const split_cell *cell);
/** Is the refinement of a cell, which is not to be cut by its guard node, on trial? */
bool trial_is_due(const split_job *job, const split_cell *cell);
/** Notes how things stand before such a cell is refined. */
froe_status trial_begin(const split_job *job, split_work *work, const split_cell *cell);
/** After each step while work->first.open: ends trials that have succeeded, and goes the other way where one has
 * failed. FROE_E_BUDGET: either way makes more than max_fragments pieces. */
froe_status trial_judge(const split_job *job, split_work *work);
/** Adds what a thread did to the sums. */
void trial_add_up(split_sums *sums, const split_work *work);
void trial_free(const froe_allocator *alloc, split_work *work);
#endif
