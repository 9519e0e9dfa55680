/* partition.h: the cells and cuts of a tree as they appear in a view. */
#ifndef FROE_DRAW_PARTITION_H
#define FROE_DRAW_PARTITION_H
#include "view.h"

typedef struct draw_cell {
    size_t first; /**< into points */
    uint32_t count;
    double depth; /**< of the leaf; mean depth of the leaves of a merged region */
} draw_cell;
typedef struct draw_cut {
    draw_point p, q;
    uint32_t depth;
    float size; /**< of the region it cuts, on the page */
} draw_cut;

typedef struct draw_partition {
    froe_allocator alloc;
    ARRAY(draw_point) points; /**< on the page */
    ARRAY(draw_cell) cells;
    ARRAY(draw_cut) cuts;
    uint64_t merged;           /**< regions drawn as one */
    uint64_t merged_leaves;    /**< leaves within them (of the whole tree, not only of the section) */
    double lo_depth, hi_depth; /**< where the scale of depths begins and ends: draw_partition_scale */
    bool below, above;         /**< are there cells beyond the scale? */
} draw_partition;

/** Adds what the view shows; `out` is zeroed but for alloc, or holds earlier views. max_depth
 * 0: no limit. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status draw_partition_add(draw_partition *out, const froe_tree *tree, const draw_view *view, uint32_t max_depth,
                               draw_task *task);
/** Chooses the scale: all depths but for the shallowest fiftieth and the deepest hundredth
 * of the cells, so that a few odd cells do not take the contrast from all others. False
 * without memory. */
bool draw_partition_scale(draw_partition *partition);
void draw_partition_free(draw_partition *partition);

/** How many leaves a subtree has, and the sum of their depths below its root. */
typedef struct draw_census {
    uint64_t leaves, depths;
} draw_census;
bool draw_census_of(const froe_allocator *alloc, const froe_tree *tree, froe_node node, draw_census *out);
#endif
