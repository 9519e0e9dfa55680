/* plane.h: trees of the plane to be queried. */
#ifndef FROE_BUILD_INDEX_PLANE_H
#define FROE_BUILD_INDEX_PLANE_H
#include "build/index/subtree.h"

/** Middle cuts down to leaves of plan->job->leaf fragments, or, where that is to be found (job->own_leaf), of as many
 * as nearly all cells of one level of middle cuts have. The tree does not depend on the number of threads.
 * FROE_E_MEMORY, FROE_E_LIMIT, FROE_E_BUDGET, FROE_E_CANCELLED. */
froe_status build_in_plane(index_plan *plan, froe_tree **out);
#endif
