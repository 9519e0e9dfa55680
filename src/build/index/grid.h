/* grid.h: many middle cuts at once.
 *
 *     cut 1 |        Halving the longer side of a box again and again gives a uniform grid, whose lines are the cuts.
 *     +---+---+      So the upper levels of the tree are known before any object is read; each object finds its
 *     | 2 | 2 |      cells by arithmetic and a walk along it (build/index/trace.c). Nodes are numbered as in a heap: 1,
 *     +---+---+      children 2h and 2h + 1.
 *
 * The subtrees of level `upper` are the parts of the grid, one after the other; any thread may sort any part. A part
 * has a run of entries, one for each of its cells that an object comes to. Sorting puts the objects of each of its
 * cells, and of each node above, into one run:
 *
 *         entries of part p:  ids[starts[p] .. starts[p + 1])   --grid_sort()-->   cells in order
 *
 * An object in several cells crosses as many cuts less one, and each such crossing belongs to the node where two
 * neighbouring cells on its way part. So a node holds as many objects as its children less those that cross its cut,
 * and all nodes are counted without being filled. No straight line comes back to a node. So an entry is the first of
 * its object in the nodes below the one where it parted from the cell before. The level of these is kept with the
 * entry: where a node is filled, it tells which entries would repeat an object. */
#ifndef FROE_BUILD_INDEX_GRID_H
#define FROE_BUILD_INDEX_GRID_H
#include "base/task.h"
#include "build/index/axis.h"

#define GRID_SHARED 0x80000000u /**< of an id: not all of the object lies in the cell */
enum {
    GRID_LEVELS = 20, /**< at most */
    GRID_LOWER = 10,  /**< of a part, at most */
    GRID_BITS = 5     /**< of a level */
};

/** Of an entry: its cell, whether it is shared, and the first level at which it is the first of its object in its node.
 * Entries that are not shared come first in their cell, so that it is known when it is filled which is which. */
static inline uint32_t grid_place(uint32_t cell, uint32_t since, uint32_t id) {
    return (cell << 1 | id >> 31) << GRID_BITS | since;
}
static inline uint32_t grid_since(uint32_t place) {
    return place & ((1u << GRID_BITS) - 1);
}

typedef struct split_grid {
    packed_box box;
    uint32_t levels, upper;
    double steps;                        /**< from cell to cell, of an object, on average, about */
    uint8_t axis[GRID_LEVELS];           /**< of the cuts of a level, the root's first */
    uint8_t rest[GRID_LEVELS + 1][2];    /**< how often cells of a level are still halved on each axis */
    double *lines[2];                    /**< lines of an axis, the borders of the box included */
    double scale[2];                     /**< cells per 1 */
    uint32_t *spread[2];                 /**< column or row -> its bits within the number of a cell */
    uint32_t *count;                     /**< node down to the level of parts -> objects */
    uint32_t *starts;                    /**< part -> entries */
    uint32_t *ids;                       /**< entry -> object, with GRID_SHARED */
    uint16_t *places;                    /**< entry -> its place, with the cell within the part */
    uint64_t fragments[GRID_LEVELS + 1]; /**< in all cells of a level */
    uint32_t cells[GRID_LEVELS + 1];     /**< of a level that are not empty */
} split_grid;

/** What is to be dealt to a grid: fragments of the box, or all objects of the scene if that is NULL. */
typedef struct grid_source {
    const packed_fragment *fragments;
    uint32_t count;
    packed_box box;
    uint32_t load;      /**< objects a cell, about */
    bool parts;         /**< several of them */
    double growth;      /**< fragments per fragment, about, at most; the grid has as many levels as that allows */
    double length[2];   /**< sum of the extents of all on each axis */
    base_task *task;    /**< for all objects: the threads that deal them; NULL: in a job, on its thread */
    axis_work *workers; /**< as many as the task has threads, or one */
} grid_source;

/** *out NULL: a grid is not worth it, or cannot be laid. Cells of at least `load`. O(count). FROE_E_MEMORY,
 * FROE_E_LIMIT, FROE_E_CANCELLED. */
froe_status grid_new(const froe_allocator *alloc, const grid_source *source, split_grid **out);
void grid_free(const froe_allocator *alloc, split_grid *grid);

static inline uint32_t grid_lines(const split_grid *g, int axis) { /**< cells side by side */
    return 1u << g->rest[0][axis];
}
static inline uint32_t grid_lower(const split_grid *g) { /**< levels of a part */
    return g->levels - g->upper;
}
/** Level of a node, from 0. */
static inline uint32_t grid_level(uint32_t node) {
    return 31 - (uint32_t)__builtin_clz(node);
}

/** The entries of a part in the order of its cells. Its nodes are numbered from 1, too. */
typedef struct grid_part {
    uint32_t *starts; /**< 2 cell + (shared) -> entries */
    uint32_t *count;  /**< node -> objects */
    ARRAY(uint32_t) ids;
    ARRAY(uint8_t) since; /**< entry -> the first level at which it is the first of its object in its node */
} grid_part;

/** Sorts a part. `out` is zero, or has been a part of this grid. O(entries). FROE_E_MEMORY. */
froe_status grid_sort(const froe_allocator *alloc, const split_grid *grid, uint32_t part, grid_part *out);
void grid_part_free(const froe_allocator *alloc, const split_grid *grid, grid_part *part);

/** Entries of a node of a part. */
static inline uint32_t grid_first(const split_grid *g, const grid_part *p, uint32_t node) {
    const uint32_t level = grid_level(node);
    return p->starts[(node - (1u << level)) << (grid_lower(g) - level) << 1];
}
static inline uint32_t grid_end(const split_grid *g, const grid_part *p, uint32_t node) {
    const uint32_t level = grid_level(node);
    return p->starts[(node + 1 - (1u << level)) << (grid_lower(g) - level) << 1];
}
#endif
