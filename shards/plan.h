/* plan.h: the cells of a folder, by cuts along the axes.
 *
 *          x = 4                 cut 0 4         lines of the manifest are the nodes of this tree, parents first, and
 *       1    |   2               shard           the lower side before the upper one; so shards are numbered from left
 *            |-------- y = 2     cut 1 2         to right
 *            |   3               shard
 *                                shard           Cells are closed, and those beside the outer cuts have no end.
 *
 * An object belongs to all cells that its box meets. */
#ifndef FROE_SHARDS_PLAN_H
#define FROE_SHARDS_PLAN_H
#include "support/array.h"
#include <froe/shard_parts.h>

enum { SHARDS_DEEPEST = 64 }; /**< cuts above a cell; halves of halves are far from that */

typedef struct shards_node {
    int axis; /**< -1: a shard */
    double value;
    uint32_t upper; /**< the node of the upper side; of a shard its number. That of the lower side is the next one */
} shards_node;

struct froe_shard_plan {
    int dim;
    uint32_t count; /**< shards */
    ARRAY(shards_node) nodes;
    bool areas;    /**< objects of groups are also in cells that their group's box meets */
    double *cells; /**< of each shard lo and hi, dim doubles each */
    froe_allocator alloc;
};
/** An empty plan, for nodes to be appended. NULL: no memory. */
froe_shard_plan *shards_plan_make(int dim, const froe_allocator *alloc);
/** Numbers the shards, finds their cells, and joins nodes in the order of the manifest to a tree. FROE_E_FORMAT: they
 * are none. FROE_E_MEMORY. */
froe_status shards_plan_join(froe_shard_plan *plan);

/** froe_shard_plan_cells(), in froe's own floating point. */
uint32_t shards_plan_cells(const froe_shard_plan *plan, const double *lo, const double *hi, uint32_t *cells);
/** The first of the cells that a box with this lower corner meets: on a cut, the lower side. */
uint32_t shards_plan_first(const froe_shard_plan *plan, const double *lo);

static inline const double *shards_cell_lo(const froe_shard_plan *plan, uint32_t shard) {
    return plan->cells + 2 * (size_t)plan->dim * shard;
}
static inline const double *shards_cell_hi(const froe_shard_plan *plan, uint32_t shard) {
    return plan->cells + (2 * (size_t)shard + 1) * (size_t)plan->dim;
}
#endif
