/* grid.h: a uniform grid of cells over the page, which finds things that may be near each other.
 *
 *      +---+---+---+      Each thing is a ring, or any few points, and is listed in the cells that its bounds meet.
 *      | a | ab| b |      A thing beside the page is listed in the cells at its margin.
 *      +---+---+---+
 *      |   | b | b |
 *      +---+---+---+  */
#ifndef FROE_VIEW_GRID_H
#define FROE_VIEW_GRID_H
#include "view/print.h"

/** Cells, inclusive. */
typedef struct view_cells {
    uint16_t x0, y0, x1, y1;
} view_cells;

typedef struct view_grid {
    uint32_t cells;    /**< a side */
    uint32_t *starts;  /**< cells^2 + 1 */
    uint32_t *entries; /**< things, ascending in each cell */
    uint32_t *stamps;  /**< per thing: the number of the walk that found it last */
    uint32_t walks;    /**< begun so far */
    uint64_t entry_count;
    size_t count;      /**< of things */
    double wide, high; /**< of a cell */
} view_grid;

/** The place of a point along a curve over the page, on which points that are near each other mostly are near, too. */
uint64_t view_grid_place(const froe_projection *view, print_point point);

/** The points of thing i. */
typedef const print_point *view_points_fn(const void *user, size_t i, size_t *points);
/** The number of cells grows with that of the things, unless large things would need too much memory. FROE_E_MEMORY. */
froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out);
void view_grid_free(const froe_allocator *alloc, view_grid *grid);
/** The same things for the walks of another thread; to be closed before the grid is freed. FROE_E_MEMORY. */
froe_status view_grid_fork(const froe_allocator *alloc, const view_grid *grid, view_grid *out);
void view_grid_close(const froe_allocator *alloc, view_grid *fork);
/** The cells that the bounds of some points, widened by `beyond`, meet. */
view_cells view_grid_cells(const view_grid *grid, const print_point *points, size_t count, double beyond);

/** A walk over the things in cells, row by row; one at a time. */
typedef struct view_grid_walk {
    view_grid *grid;
    view_cells cells;
    bool along; /**< only the cells near ab */
    print_point a, b;
    double beyond;
    uint16_t x, x1, y;   /**< the cell entered last, and the last one of its row */
    uint32_t entry, end; /**< what is left of it */
} view_grid_walk;

/** Over some cells. */
view_grid_walk view_grid_begin(view_grid *grid, view_cells cells);
/** Over the cells that lie no farther than `beyond` from ab along both axes. */
view_grid_walk view_grid_along(view_grid *grid, print_point a, print_point b, double beyond);
/** Goes on to the next row that has cells; false: there is none. */
bool view_grid_row(view_grid_walk *walk);

static inline void view_grid_enter(view_grid_walk *w) {
    const uint32_t *starts = w->grid->starts + (size_t)w->y * w->grid->cells + w->x;
    w->entry = starts[0], w->end = starts[1];
}
/** The next thing; each comes once. False: there is none left. */
static inline bool view_grid_next(view_grid_walk *w, uint32_t *thing) {
    for (;;) {
        while (w->entry == w->end) {
            if (w->x < w->x1)
                w->x++;
            else if (!view_grid_row(w))
                return false;
            view_grid_enter(w);
        }
        *thing = w->grid->entries[w->entry++];
        if (w->grid->stamps[*thing] == w->grid->walks) continue;
        w->grid->stamps[*thing] = w->grid->walks;
        return true;
    }
}
#endif
