/* inseparable.h: may a leaf hold more objects than its capacity? Because nothing separates them, or because they crowd.
 */
#ifndef FROE_TREE_AUDIT_INSEPARABLE_H
#define FROE_TREE_AUDIT_INSEPARABLE_H
#include "base/task.h"
#include "geom/predicates.h"
#include "tree/list.h"

/** Why the objects of a leaf can be separated after all, as a clause; *why NULL: nothing was found that does.
 * Separable are
 *   - objects with a support (points, segments, polygons), by it, unless all are one and the same point;
 *   - others by an axis-parallel plane with one of them on each side, touching it at most, or in it: complete
 *     for boxes;
 *   - two hulls by any plane with one of them on each side, touching it at most, or one in it: complete, but for two
 *     in one plane, where axis-parallel planes alone count (normals.h).
 *   - all pairs of solids that have no point in common (share.h): no plane is looked for, so that the audit does not
 *     repeat the search of the builders (geom/meet/apart.h).
 * O(m dim), and O(m^2) pairs when axis-parallel planes fail. On the calling thread of `task`;
 * NULL, too, when that was cancelled meanwhile. FROE_E_MEMORY. */
froe_status inseparable_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                                const char **why);

/** Why the objects of a leaf do not crowd (crowd.h), as a clause; NULL: they do. All have to be boxes, balls or hulls,
 * and half of the pairs that count inseparable in the sense above. O(m) pairs, at most m^2 / 2. Else as above. */
froe_status crowded_refuted(num_context *context, base_task *task, const froe_tree *tree, const tree_objects *list,
                            const char **why);
#endif
