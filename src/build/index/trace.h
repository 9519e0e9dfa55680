/* trace.h: the cells of a grid that objects come to, chunk by chunk of the objects.
 *
 *        +---+---+---+     A segment begins in one cell and walks to its last: by columns and rows alone while only
 *        |   | __q   |     one of the two is left to change, else by the side of a corner on which it passes.
 *        | p-+-  |   |     Each cell gets an entry. Where a corner of an object, or an end that a cut made, lies in a
 *        +---+---+---+     line, the line is bad, and the grid has to move it. */
#ifndef FROE_BUILD_INDEX_TRACE_H
#define FROE_BUILD_INDEX_TRACE_H
#include "build/index/grid.h"

/** What one thread counts. */
typedef struct trace_counts {
    uint32_t *crossings;          /**< node of the upper levels -> where objects cross its cut; part -> all within it */
    uint64_t levels[GRID_LEVELS]; /**< crossings of cuts of a level */
    uint16_t *met;                /**< cell -> is anything there? No bytes: those could be part of any variable */
} trace_counts;

/** The place is as in the grid, but with all bits of the cell. */
typedef struct trace_entry {
    uint32_t place, id;
} trace_entry;

typedef struct trace_chunk {
    uint32_t from, to; /**< objects, or fragments */
    uint32_t *parts;   /**< part -> entries */
    ARRAY(trace_entry) entries;
    int bad_axis; /**< of a bad line; -1: none */
    uint32_t bad_line;
} trace_chunk;

/** Appends the entries of a chunk, up to the first bad line. FROE_E_MEMORY. */
froe_status trace_run(const froe_allocator *alloc, const grid_source *source, const split_grid *grid, axis_work *work,
                      trace_counts *counts, trace_chunk *chunk);
#endif
