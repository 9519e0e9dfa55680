/* convert.h: from a BSP of points to a BSP of segments (de Berg and Streppel: Approximate range searching using binary
 * space partitions, 2004, section 3; Paterson and Yao 1990 for cuts by medians of x).
 *
 *     +-----------------+      A plan, the BSP of the endpoints, is followed from its root. At its node v a segment is
 *     |  ____/_____     |      short if one of its ends lies in the open region of v, and long otherwise: it then
 *     | /   /      o    |      crosses that region from border to border.
 *     |o   /            |          long ones first: cut along one, such that both sides weigh the same (a chord 1, a
 *     |   /   o----o    |          short segment 2), and again, until none is left
 *     +--/--------------+          then by the cut of v; both sides go on with its children
 *      long                        a leaf of the plan holds one endpoint: what is left is a star around it
 *
 * Pruning. Where everything lies on one side of the cut of v, the cut is left out and the child of that side is next;
 * unless a T-junction made from that side lies on it within the cell: then other cuts would grow longer by that, and
 * searches slower. (The paper asks about both sides; what is empty is never cut.)
 *
 * Segments may cross. A chord then splits those that cross it, exactly, where they do: nothing has to be split before.
 *
 * Size. Each segment has two short fragments at most on each level of the plan, so the cuts of the plan split n
 * segments 2 n height times at most. Cuts along disjoint segments split none. */
#ifndef FROE_BUILD_CONVERSION_CONVERT_H
#define FROE_BUILD_CONVERSION_CONVERT_H
#include "build/conversion/point_tree.h"
#include "split/refine.h"

typedef struct convert_job {
    froe_scene *scene; /**< points and segments of the plane */
    froe_allocator alloc;
    base_task *task;
    const point_tree *plan;
    uint32_t leaf;
    uint64_t seed, max_fragments;
    num_stage first;
    bool prune;
    double *fragments; /**< a promise about them: raised by the splits of cuts along segments before meta is read */
    const tree_meta *meta;
} convert_job;

/** FROE_E_BUDGET, FROE_E_LIMIT, FROE_E_CANCELLED, FROE_E_MEMORY: without sentences, see split_explain(). On one thread.
 */
froe_status split_convert(const convert_job *job, froe_tree **out);
#endif
