/* thin.h: a cell in which cuts split too much is cut by cubes with few guards instead, until few fragments are left.
 *
 *      +----------------+          Every plane through this nest splits most of its shells, and so do the planes after
 *      | +-----------+  |          it. Cubes with at most k guards strictly inside meet few fragments where the density
 *      | | +-------+ |  |          is low (guard_tree.h), whatever their sizes: O(m / k) cells of O(k + density)
 *      | | | +---+ | |  |          fragments each are made of a cell of m.
 *      | | | |:::| | |  |
 *
 * Fragments are charged. Each cell knows its growth, the product of (fragments after / fragments before) over the cuts
 * above it, and the sum of fragments / growth over all cells never exceeds n. Where the cut of a cell of at least
 * `least` fragments would bring growth to the limit G, it is not made, and the cell is thinned out. So all smaller
 * cells, and those to be thinned out, have less than G n fragments together, whatever the scene.
 *
 * The guards are the vertices of the boxes of the cell's fragments, not of whole objects. The lemma holds for them,
 * too: a fragment that meets a cube and has no guard in it is as wide as the cube, and so is its object; and a convex
 * object has one fragment in a cell (de Berg, lemmas 2.1 and 2.2; Sacks, lemma 12.6). Where the density is high, as
 * where objects cross, the cubes would have more than THIN_MOST times the fragments of the cell. That is found out by
 * making them once, which is taken back; such a cell is cut as before, and charged no more.
 *
 * Guards are seen from an input vertex, and each cut is moved to the nearest input vertex on its axis: so they are the
 * same wherever the scene lies. Cuts that come to separate nothing are left out.
 *
 * What has been thinned out, or could not be, is never charged again. So each part of space is thinned out once at
 * most, and nothing but the cuts of the guards, which need no search, is made twice. Methods whose cells have rooms
 * (split_method.room) are not served. */
#ifndef FROE_SPLIT_CHARGE_THIN_H
#define FROE_SPLIT_CHARGE_THIN_H
#include "split/grow.h"

/** Are the fragments of the cell charged? Their cuts, and those by guards, are marked TREE_CHARGED: tree_measure()
 * counts the fragments below as charged_fragments. */
static inline bool thin_charges(const split_thin_rule *rule, const split_cell *cell) {
    return rule->growth > 0 && cell->growth > 0 && cell->count >= rule->least;
}
/** Is it to be thinned out rather than cut, when a cut splits so many? */
static inline bool thin_refuses(const split_thin_rule *rule, const split_cell *cell, uint32_t splits) {
    const double before = cell->count;
    return rule->guards && thin_charges(rule, cell) &&
           (double)cell->growth * (before + splits) >= rule->growth * before;
}
/** Counts what cubes of rule->guards would come to. Where that is not too much, the cell is pending again, to be cut by
 * them, and *begun. O(m log m) for the guard tree of m fragments, and the cuts down to its leaves. */
froe_status thin_begin(const split_thin_rule *rule, split_work *work, const split_cell *cell, bool *begun);
/** Cuts a cell by its node, cell->thin, or goes on to the next node where that separates nothing. */
froe_status thin_cut(split_work *work, const split_cell *cell);
/** Adds what a worker noted. */
void thin_add_up(split_thin_notes *sum, const split_thin_notes *notes);
#endif
