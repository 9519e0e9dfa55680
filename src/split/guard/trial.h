/* trial.h: where refinement costs too much, its cell goes on down the guard tree instead, if that costs less.
 *
 *     guard stage      v              1. Where the guard stage leaves a cell v that its guard node could cut, the draft
 *                     / \                and the fragments of v are noted, and v is refined. That is good enough if it
 *     refinement     /\ /\               makes at most 3 pieces a fragment, or, in a cell of up to 3,000 fragments,
 *                                        k / 3 for each leaf of the guard tree below. It ends at 8 a fragment + k a
 *                                        leaf.
 *     guard cuts       v              2. If it is not, the draft is cut back, and v takes its next guard cuts. Where
 *                     / \                the load has halved, refinement is tried in the same way, and taken back if it
 *     refinement     a   b  /\           is not good enough. In leaves of the guard tree it is final.
 *     refinement     /\ /\            3. If that makes more pieces than were made in step 1, v is refined after all.
 *
 * So no cell has more pieces than by step 1 alone. Where step 2 makes at most 8 pieces a fragment of v + k a leaf,
 * as it does on scenes of low density, whose guard leaves have few objects (de Berg, lemma 2.1; Sacks, lemma 12.6), the
 * pieces are linear in the fragments of the guard stage and the guard leaves. What is taken back costs as much at each
 * halving of the load at most. Elsewhere, as where every partition is quadratic, refinement costs what it must. */
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
/** After each step while work->first.open: ends trials that have succeeded, and takes back those that have failed,
 * whose cells are pending again. */
froe_status trial_judge(const split_job *job, split_work *work);
void trial_free(const froe_allocator *alloc, split_work *work);
#endif
