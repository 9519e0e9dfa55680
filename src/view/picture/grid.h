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

/** Cells, inclusive. */
typedef struct view_cells {
    uint16_t x0, y0, x1, y1;
} view_cells;

typedef struct view_grid {
    uint32_t cells;    /**< a side */
    uint32_t *starts;  /**< cells^2 + 1 */
    uint32_t *entries; /**< things, ascending in each cell */
    view_cells *of;    /**< per thing */
    uint64_t entry_count;
    size_t count;      /**< of things */
    double wide, high; /**< of a cell */
} view_grid;

/** The points of thing i. */
typedef const print_point *view_points_fn(const void *user, size_t i, size_t *points);
/** The number of cells grows with that of the things, unless large things would need too much memory. FROE_E_MEMORY. */
froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out);
void view_grid_free(const froe_allocator *alloc, view_grid *grid);
/** The cells that the bounds of some points, widened by `beyond`, meet. */
view_cells view_grid_cells(const view_grid *grid, const print_point *points, size_t count, double beyond);

/** A walk over the things in cells, row by row. */
typedef struct view_grid_walk {
    const view_grid *grid;
    view_cells cells;
    uint16_t x, y;       /**< the cell of the thing found last */
    uint32_t entry, end; /**< what is left of it */
} view_grid_walk;

static inline void view_grid_enter(view_grid_walk *w, uint32_t x, uint32_t y) {
    const uint32_t *starts = w->grid->starts + (size_t)y * w->grid->cells + x;
    w->x = (uint16_t)x, w->y = (uint16_t)y;
    w->entry = starts[0], w->end = starts[1];
}
static inline view_grid_walk view_grid_begin(const view_grid *g, view_cells c) {
    view_grid_walk w = {.grid = g, .cells = c, .x = c.x1, .y = c.y1};
    if (c.x0 <= c.x1 && c.y0 <= c.y1) view_grid_enter(&w, c.x0, c.y0);
    return w;
}
/** The next thing; each comes once, in the first of its cells. False: there is none left. */
static inline bool view_grid_next(view_grid_walk *w, uint32_t *thing) {
    for (;;) {
        while (w->entry == w->end) {
            if (w->x < w->cells.x1)
                view_grid_enter(w, w->x + 1u, w->y);
            else if (w->y < w->cells.y1)
                view_grid_enter(w, w->cells.x0, w->y + 1u);
            else
                return false;
        }
        *thing = w->grid->entries[w->entry++];
        const view_cells *own = w->grid->of + *thing;
        if ((w->x == own->x0 || w->x == w->cells.x0) && (w->y == own->y0 || w->y == w->cells.y0)) return true;
    }
}
#endif
