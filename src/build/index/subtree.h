/* subtree.h: the cells of a subtree in the plane, cut down to leaves, on one thread.
 *
 * Where middle cuts do not pay: cells that the cuts before have multiplied into `growth` fragments for each are left as
 * they are, and so are those that two cuts in a row have left nearly whole on both sides (a star, parallels). growth is
 * the product of (fragments after / fragments before) over the cuts above; the sum over leaves of fragments / growth
 * never exceeds n, so there are at most 2 growth n fragments on any scene. A cell whose siblings have been empty
 * several times in a row is shrunk to its contents; where halving has gone beyond `height` log2 n levels, cuts go
 * through medians. */
#ifndef FROE_BUILD_INDEX_SUBTREE_H
#define FROE_BUILD_INDEX_SUBTREE_H
#include "base/apart.h"
#include "base/radix.h"
#include "build/index/grid.h"
#include "build/method.h"
#include "tree/packed/packer.h"

/** A cell waiting for its turn: a node of the uppermost grid, or fragments on top of all others. */
typedef struct index_cell {
    uint32_t node, depth;
    packed_box box;
    double growth;
    uint32_t barren, lonely; /**< cuts in a row that divided nearly all; that left the sibling empty */
    uint32_t heap;           /**< of the grid or its part; 0: fragments; SUBTREE_END: the grid is done */
    uint32_t line[2];        /**< of the grid: where the cell begins */
    uint32_t first, count;   /**< fragments */
} index_cell;
#define SUBTREE_END UINT32_MAX

/** What all threads read. */
typedef struct index_plan {
    build_job *job;
    double growth, height; /**< fragments for each; levels from which on medians are taken, 0: none */
    uint32_t load, grid;   /**< objects in a cell of a grid; fragments from which there is one */
    uint32_t parts;        /**< objects from which it has parts */
    split_grid *whole;     /**< of all objects; NULL: there is none */
} index_plan;

typedef struct index_layer {
    split_grid *grid;
    grid_part part;
} index_layer;

/** What a thread has. */
typedef struct index_work {
    const index_plan *plan;
    unsigned worker;
    axis_work *axis;
    tree_packer *packer; /**< that the subtree goes to */
    grid_part part;      /**< of the grid of all objects */
    ARRAY(index_layer) layers;
    ARRAY(index_cell) cells;
    ARRAY(packed_fragment) items, spare;
    ARRAY(uint8_t) classes[2];
    ARRAY(base_pair) middles;
    base_apart apart;
} index_work;

/** Builds the subtree of a cell: a node of the grid of all objects (heap), or of all objects where there is no grid.
 * FROE_E_MEMORY, FROE_E_LIMIT, FROE_E_BUDGET, FROE_E_CANCELLED. */
froe_status subtree_build(index_work *work, const index_cell *root);
void subtree_work_free(index_work *work);
/** The cut of a cell of a grid at this level, and both its sides but for their nodes; count: objects by heap. */
double subtree_halve(const split_grid *grid, const index_cell *cell, uint32_t level, const uint32_t *count,
                     index_cell side[2]);
#endif
