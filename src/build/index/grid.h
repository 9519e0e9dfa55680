/* grid.h: many middle cuts at once.
 *
 *     cut 1 |        Halving the longer side of a box again and again gives a uniform grid, whose lines are the cuts.
 *     +---+---+      So the upper levels of the tree are known before any object is read; each object finds its
 *     | 2 | 2 |      cells by arithmetic and a walk along it, and one counting sort puts the objects of every cell,
 *     +---+---+      and of every node above, into one run:
 *
 *         node h  ->  cells [first, last)  ->  ids[starts[first] .. starts[last])
 *
 * Nodes are numbered as in a heap: 1, children 2h and 2h + 1, cells 2^levels + c. An object in several cells crosses as
 * many cuts less one, and each such crossing belongs to the node where two neighbouring cells on its way part; so a
 * node holds as many objects as its children less those that cross its cut, and all nodes are counted without being
 * filled. */
#ifndef FROE_BUILD_INDEX_GRID_H
#define FROE_BUILD_INDEX_GRID_H
#include "base/task.h"
#include "build/index/axis.h"

#define GRID_SHARED 0x80000000u /**< of an id: the object has other cells, too */
#define GRID_LEVELS 16          /**< at most */

typedef struct split_grid {
    packed_box box;
    uint32_t levels;
    uint8_t axis[GRID_LEVELS];        /**< of the cuts of a level, the root's first */
    uint8_t rest[GRID_LEVELS + 1][2]; /**< how often cells of a level are still halved on each axis */
    double *lines[2];                 /**< lines of an axis, the borders of the box included */
    double scale[2];                  /**< cells per 1 */
    uint32_t *spread[2];              /**< column or row -> its bits within the number of a cell */
    uint32_t *count;                  /**< node -> objects */
    uint32_t *starts, *ids;           /**< cells: runs of ids with GRID_SHARED */
    size_t id_room;
} split_grid;

/** What is to be dealt to a grid: fragments of the box, or all objects of the scene if that is NULL. */
typedef struct grid_source {
    const packed_fragment *fragments;
    uint32_t count;
    packed_box box;
    uint32_t load; /**< objects a cell, about */
    double growth; /**< fragments per fragment, at most; the grid has as many levels as that allows */
} grid_source;

/** *made false, without anything to be freed: a grid is not worth it, or cannot be laid. Cells of at least `load`.
 * O(count). FROE_E_MEMORY, FROE_E_LIMIT, FROE_E_CANCELLED. */
froe_status grid_new(axis_work *work, base_task *task, const froe_allocator *alloc, const grid_source *source,
                     split_grid *out, bool *made);
void grid_free(const froe_allocator *alloc, split_grid *grid);

/** Level of a node. */
static inline uint32_t grid_level(uint32_t node) {
    return 31 - (uint32_t)__builtin_clz(node);
}
/** Runs of ids of a node. */
static inline uint32_t grid_first(const split_grid *g, uint32_t node) {
    uint32_t level = grid_level(node);
    return g->starts[(node - (1u << level)) << (g->levels - level)];
}
static inline uint32_t grid_end(const split_grid *g, uint32_t node) {
    uint32_t level = grid_level(node);
    return g->starts[(node + 1 - (1u << level)) << (g->levels - level)];
}
#endif
