/* grid.h: a uniform grid of cells over the page, which finds things that may be near each other.
 *
 *      +---+---+---+      Each thing is a ring, or any few points, and is listed in the cells that its bounds meet.
 *      | a | ab| b |      A thing beside the page is listed in the cells at its margin.
 *      +---+---+---+
 *      |   | b | b |
 *      +---+---+---+  */
#ifndef FROE_VIEW_PICTURE_GRID_H
#define FROE_VIEW_PICTURE_GRID_H
#include "view/print.h"

typedef struct view_grid {
    uint32_t cells;    /**< a side */
    uint32_t *starts;  /**< cells^2 + 1 */
    uint32_t *entries; /**< things, ascending in each cell */
    uint64_t entry_count;
    double wide, high; /**< of a cell */
} view_grid;

/** Cells, inclusive. */
typedef struct view_cells {
    uint32_t x0, y0, x1, y1;
} view_cells;

/** The points of thing i. */
typedef const print_point *view_points_fn(const void *user, size_t i, size_t *points);
/** The number of cells grows with that of the things, unless large things would need too much memory. FROE_E_MEMORY. */
froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out);
void view_grid_free(const froe_allocator *alloc, view_grid *grid);
/** The cells that the bounds of some points, widened by `beyond`, meet. */
view_cells view_grid_cells(const view_grid *grid, const print_point *points, size_t count, double beyond);
#endif
