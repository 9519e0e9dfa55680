/* aspect.h: how fat are the cells of the guard stage? Measured from the cuts of the tree alone.
 *
 *     cuts x_i = c and x_i - x_j = c      facets x_i - x_j <= most[i][j], with x_dim = 0
 *     shortest paths (Floyd 1962)         the largest x_i - x_j of the cell: what the facets add up to
 *     most[i][j] + most[j][i]             width, divided by sqrt 2 where that is a distance between oblique planes
 *
 * Sums have 106 bits (num/pair.h) and are charged for what they lack: what comes out is no less than the aspect. */
#ifndef FROE_TREE_AUDIT_ASPECT_H
#define FROE_TREE_AUDIT_ASPECT_H
#include "tree/tree.h"

/** The largest aspect of a cell that a cut of the guard stage leaves, from the tree's root box on, in R^4 .. R^8: the
 * largest width, across axes and differences of two, over the least. INFINITY: one has no interior, or another kind of
 * cut. FROE_E_MEMORY. O(dim^3) a cell. */
froe_status tree_aspect(const froe_tree *tree, double *out);
#endif
