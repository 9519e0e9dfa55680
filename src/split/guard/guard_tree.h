/* guard_tree.h: the first stage of the density builder: cubes with few guards.
 *
 *     +-------+---+---+    octree split: the cube by its middle planes
 *     |       |   | . |
 *     |       +---+---+    shrink: where one orthant holds nearly all guards, straight to the
 *     |       |   |..:|            smallest cube at its corner that leaves out enough of them
 *     +-------+---+---+
 *
 * Guards are the vertices of the objects' bounding boxes (guards.h). A cube with at most k
 * guards strictly inside meets at most k + ceil(sqrt d)^d * density objects. Sources: de Berg,
 * "Linear size binary space partitions for uncluttered scenes" (k = 0, form U); density-sensitive
 * BSPs as in the lecture notes of Sacks (k >= 1, form S).
 *
 * The tree depends on the set of guards alone: not on their order, the number of threads or the way
 * it is computed. It owns all of space: the cells at the border of the root cube extend to infinity. */
#ifndef FROE_SPLIT_GUARD_GUARD_TREE_H
#define FROE_SPLIT_GUARD_GUARD_TREE_H
#include "base/task.h"
#include "split/guard/grid_boxes.h"
#include "support/array.h"

/** How a shrink cuts off what is outside of the inner cube. */
typedef enum split_form {
    SPLIT_FORM_DEFAULT = 0, /**< U for k = 0 (fewer leaves), S for k >= 1 (smaller loads) */
    SPLIT_FORM_U = 1,       /**< by d slabs, one after the other: d + 1 cells */
    SPLIT_FORM_S = 2        /**< by a cross of d planes: 2^d cells */
} split_form;

/** Which algorithm; all give the same tree. */
typedef enum split_guard_way {
    SPLIT_GUARD_HYBRID = 0,    /**< partition, phases where that would take too long: O(d n log n) */
    SPLIT_GUARD_PARTITION = 1, /**< O(n) a level: O(n * height) */
    SPLIT_GUARD_PHASES = 2,    /**< O(d n log n), after Callahan and Kosaraju */
    SPLIT_GUARD_PLAIN = 3      /**< partition, one octree level at a time */
} split_guard_way;

typedef struct split_guard_options {
    int dim;    /**< 2 .. FROE_MAX_DIM */
    uint32_t k; /**< at most so many guards strictly inside a leaf */
    split_form form;
    split_guard_way way; /**< hybrid, unless for tests and benches */
} split_guard_options;

/** Nodes come in pairs, later than their parent: child is below the plane, child + 1 above. */
typedef struct split_guard_node {
    double value;    /**< inner: the plane x[axis] = value */
    uint32_t child;  /**< 0: leaf */
    uint8_t axis;    /**< inner */
    uint8_t flags;   /**< 0 */
    uint16_t guards; /**< leaf: guards strictly inside its cell, at most UINT16_MAX are counted */
} split_guard_node;

typedef struct split_guard_tree {
    int dim;
    uint32_t k;
    split_form form; /**< U or S */
    ARRAY(split_guard_node)
    nodes;                                     /**< nodes[0] is the root. The nodes of one split lie together,
                                                    then come the subtrees of its cells in order. */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /**< root cube; guards on its border count as outside */
    uint64_t leaves, octree_steps, shrinks, phases;
    uint32_t height;    /**< cuts on the longest path */
    double promised;    /**< proven bound on leaves: form U (2^d-1)(2m-1)+1, form S, k >= 1 (2^d-1)(2m/k-1)+1 */
    uint32_t cell_load; /**< ceil(sqrt d)^d: a leaf cube meets at most k + cell_load * density objects */
} split_guard_tree;

/** Builds the tree of `count` guards, dim finite doubles each, of which it needs a working copy. Guards
 * at one place count as often as they come. Advances task by `span`. Time O(d n log n).
 * FROE_E_MEMORY, FROE_E_LIMIT (2^31 - 2 guards or nodes), FROE_E_CANCELLED. */
froe_status split_guard_tree_build(const froe_allocator *alloc, base_task *task, double span,
                                   const split_guard_options *options, const double *guards, size_t count,
                                   split_guard_tree *out);
/** The tree of all guards of a scene (guards.h). */
froe_status split_guard_tree_of(const froe_allocator *alloc, base_task *task, double span,
                                const split_guard_options *options, const split_grid_boxes *grid_boxes,
                                split_guard_tree *out);
void split_guard_tree_free(const froe_allocator *alloc, split_guard_tree *tree);
#endif
