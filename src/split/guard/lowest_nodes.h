/* lowest_nodes.h: where in the guard tree each object first meets a cut.
 *
 *            x = 4                 object 7 goes left of x = 4, right of y = 1, and lies across x = 2:
 *           /     \                that is its lowest containing node. Nodes above need not list it.
 *        y = 1    ...
 *       /     \                    ids:  [ own of v | own below left(v) | own below right(v) ]
 *      ...   x = 2   <- 7                 at[v]                                              end[v]
 *
 * In this order the objects that lie wholly in a cell and have been cut by nothing are one slice, so
 * the guard stage carries a cell's cut fragments only (de Berg, lemma 2.2: each object is found
 * by its lowest node that contains it). O(n height) comparisons, no arithmetic. */
#ifndef FROE_SPLIT_GUARD_LOWEST_NODES_H
#define FROE_SPLIT_GUARD_LOWEST_NODES_H
#include "scene/scene.h"
#include "split/guard/guard_tree.h"

typedef struct split_lowest_nodes {
    uint32_t *ids;      /**< all objects, by lowest containing node */
    uint32_t *at, *end; /**< per guard node: its slice of ids, its own objects first */
    size_t object_count, node_count;
} split_lowest_nodes;

/** The tree is that of the same scene. */
froe_status split_lowest_nodes_make(const froe_allocator *alloc, base_task *task, const split_grid_boxes *grid_boxes,
                                    const split_guard_tree *guard, split_lowest_nodes *out);
void split_lowest_nodes_free(const froe_allocator *alloc, split_lowest_nodes *lowest);

/** The objects whose lowest containing node is `node` itself: ids[at[node] ..], so many. */
static inline uint32_t split_lowest_nodes_own(const split_lowest_nodes *lowest, const split_guard_tree *guard,
                                              uint32_t node) {
    uint32_t child = guard->nodes.data[node].child;
    return (child ? lowest->at[child] : lowest->end[node]) - lowest->at[node];
}
#endif
