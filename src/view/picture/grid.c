/* grid.c: the entries of each cell are counted first, then filled in. */
#include "view/picture/grid.h"
#include <math.h>

enum { CELLS_LEAST = 8, CELLS_MOST = 512, ENTRIES_A_THING = 12 };

typedef struct filler {
    view_grid *grid;
    size_t count;
    view_points_fn *fn;
    const void *user;
} filler;

static uint32_t cell_at(double x, double size, uint32_t cells) {
    const double at = floor(x / size);
    return at >= 0 ? at < cells ? (uint32_t)at : cells - 1 : 0;
}

view_cells view_grid_cells(const view_grid *g, const print_point *points, size_t count, double beyond) {
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    if (!count) return (view_cells){1, 1, 0, 0}; /* a thing without points is in no cell */
    for (size_t i = 0; i < count; i++) {
        x0 = fmin(x0, points[i].x), x1 = fmax(x1, points[i].x);
        y0 = fmin(y0, points[i].y), y1 = fmax(y1, points[i].y);
    }
    const double slack = 1e-9, /* of a cell: rounding must not part neighbours */
        dx = beyond + slack * g->wide, dy = beyond + slack * g->high;
    return (view_cells){cell_at(x0 - dx, g->wide, g->cells), cell_at(y0 - dy, g->high, g->cells),
                        cell_at(x1 + dx, g->wide, g->cells), cell_at(y1 + dy, g->high, g->cells)};
}

static view_cells cells_of(const filler *f, size_t i) {
    size_t n;
    const print_point *points = f->fn(f->user, i, &n);
    return view_grid_cells(f->grid, points, n, 0);
}

static void fill_grid(const filler *f, bool count_only) {
    view_grid *g = f->grid;
    for (size_t i = f->count; i-- > 0;) {
        const view_cells c = cells_of(f, i);
        for (uint32_t y = c.y0; y <= c.y1; y++)
            for (uint32_t x = c.x0; x <= c.x1; x++) {
                const size_t cell = (size_t)y * g->cells + x;
                if (count_only)
                    g->starts[cell]++;
                else
                    g->entries[--g->starts[cell]] = (uint32_t)i;
            }
    }
}

froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out) {
    const filler f = {out, count, fn, user};
    const double wanted = sqrt((double)count);
    uint32_t side = wanted < CELLS_LEAST ? CELLS_LEAST : wanted > CELLS_MOST ? CELLS_MOST : (uint32_t)wanted;
    for (;; side /= 2) {
        out->cells = side;
        out->wide = view->width / side;
        out->high = view->height / side;
        out->entry_count = 0;
        for (size_t i = 0; i < count; i++) {
            const view_cells c = cells_of(&f, i);
            out->entry_count += (uint64_t)(c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1);
        }
        if (side <= CELLS_LEAST || out->entry_count <= ENTRIES_A_THING * (uint64_t)count) break;
    }
    const size_t cells = (size_t)out->cells * out->cells;
    out->starts = support_calloc(alloc, cells + 1, sizeof *out->starts);
    if (out->entry_count < UINT32_MAX) out->entries = support_calloc(alloc, out->entry_count + 1, sizeof *out->entries);
    if (!out->starts || !out->entries) return FROE_E_MEMORY;
    fill_grid(&f, true);
    for (size_t i = 1; i <= cells; i++) out->starts[i] += out->starts[i - 1]; /* ends, which filling lowers to starts */
    fill_grid(&f, false);
    return FROE_OK;
}

void view_grid_free(const froe_allocator *alloc, view_grid *g) {
    support_free(alloc, g->starts, ((size_t)g->cells * g->cells + 1) * sizeof *g->starts);
    support_free(alloc, g->entries, (g->entry_count + 1) * sizeof *g->entries);
    *g = (view_grid){0};
}
