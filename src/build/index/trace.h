/* trace.h: the cells of a grid that objects come to, chunk by chunk of the objects.
 *
 *        +---+---+---+     A segment begins in one cell and walks to its last: by columns and rows alone while only
 *        |   | __q   |     one of the two is left to change, else by the side of a corner on which it passes.
 *        | p-+-  |   |     Each cell gets an entry. Where a corner of an object, or an end that a cut made, lies in a
 *        +---+---+---+     line, the line is bad, and the grid has to move it. */
#ifndef FROE_BUILD_INDEX_TRACE_H
#define FROE_BUILD_INDEX_TRACE_H
#include "base/apart.h"
#include "build/index/deal.h"
#include "build/index/grid.h"

/** What one thread counts. */
typedef struct trace_counts {
    uint32_t *crossings;          /**< node of the upper levels -> where objects cross its cut; part -> all within it */
    uint64_t levels[GRID_LEVELS]; /**< crossings of cuts of a level */
    uint16_t *met;                /**< cell -> is anything there? No bytes: those could be part of any variable */
    base_apart apart;
} trace_counts;

/** A line that a corner or an end lies in; axis -1: there is none. */
typedef struct trace_bad {
    int axis;
    uint32_t line;
} trace_bad;

/** Appends the entries of a chunk, up to the first bad line: places are as in the grid, but with all bits of the cell.
 * FROE_E_MEMORY. */
froe_status trace_run(const froe_allocator *alloc, const grid_source *source, const split_grid *grid, axis_work *work,
                      trace_counts *counts, deal_chunk *chunk, trace_bad *bad);
#endif
