/* ham_sandwich.h: partition trees of points by ham-sandwich cuts (Willard: Polygon retrieval, 1982; Edelsbrunner and
 * Welzl: Halfplanar range search in linear space and O(n^0.695) query time, 1986).
 *
 *        o   /  o           A line halves the points. One and the same line then halves both halves, and so on: of the
 *     o     /      o        four cells around a crossing a line meets three at most, so a search along a line comes
 *     -----/----------      into O(n^0.695) of n cells.
 *      o  /  o  o
 *
 * The line through the medians of two sets on both sides of another is found by bisection: turned from one direction
 * of the dividing line to the other, the median of one set rises over that of the other. It is then laid through the
 * two medians, input points both, and cuts exactly. In doubles the halves may be uneven, where rounding decides. */
#ifndef FROE_BUILD_CONVERSION_HAM_SANDWICH_H
#define FROE_BUILD_CONVERSION_HAM_SANDWICH_H
#include "base/task.h"
#include "build/conversion/point_tree.h"

/** Grows a tree of one leaf until each leaf holds one of the scene's endpoints at most. O(n log n) times the number of
 * bisections. FROE_E_CANCELLED, FROE_E_LIMIT, FROE_E_MEMORY. */
froe_status point_tree_by_ham_sandwich(point_tree *tree, num_context *context, base_task *task);
#endif
