/* cube_cut.h: a guard tree cut by cut: which axis-parallel cut comes next depends on the box and the guards alone.
 *
 *     +-------+-------+     octree: the longest side is halved; d such cuts divide a cube into its orthants
 *     |  .    |   .   |
 *     +-------+-------+     shrink: all guards are in one orthant. The smallest cube at its corner that holds them is
 *     |. +----|               cut off, side by side, first where the farthest guard is
 *     |..|    |
 *     +--+----+             Between cuts, guards of objects that do not reach into the part are forgotten.
 *
 * De Berg, "Linear size binary space partitions for uncluttered scenes", lemma 2.1 (the form with slabs, k = 0), with
 * the pruning of de Berg and Streppel, section 4: guard_tree.h makes the tree of fixed guards much faster, but cannot
 * prune. */
#ifndef FROE_BUILD_BAR_CUBE_CUT_H
#define FROE_BUILD_BAR_CUBE_CUT_H
#include "build/bar/bar_shape.h"

/** Bounds of the guards strictly inside of a box. */
typedef struct cube_guards {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} cube_guards;

/** The next cut of a box. `through`: through the farthest guard, which then is in neither part; or just beyond it.
 * False: doubles have no room for one. O(dim). */
bool cube_cut(const bar_region *box, int dim, const cube_guards *guards, bool through, froe_cut *out);
#endif
