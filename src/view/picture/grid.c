/* grid.c: the entries of each cell are counted first, then filled in. */
#include "view/picture/grid.h"
#include <math.h>

enum { CELLS_LEAST = 8, CELLS_MOST = 4096, ENTRIES_A_THING = 12 };

static uint16_t cell_at(double x, double size, uint32_t cells) {
    const double at = x / size;
    return (uint16_t)(at >= 0 ? at < cells ? (uint32_t)at : cells - 1 : 0);
}

view_cells view_grid_cells(const view_grid *g, const print_point *points, size_t count, double beyond) {
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    if (!count) return (view_cells){1, 1, 0, 0}; /* a thing without points is in no cell */
    for (size_t i = 0; i < count; i++) {
        const print_point p = points[i];
        x0 = p.x < x0 ? p.x : x0, x1 = p.x > x1 ? p.x : x1;
        y0 = p.y < y0 ? p.y : y0, y1 = p.y > y1 ? p.y : y1;
    }
    const double slack = 1e-9, /* of a cell: rounding must not part neighbours */
        dx = beyond + slack * g->wide, dy = beyond + slack * g->high;
    return (view_cells){cell_at(x0 - dx, g->wide, g->cells), cell_at(y0 - dy, g->high, g->cells),
                        cell_at(x1 + dx, g->wide, g->cells), cell_at(y1 + dy, g->high, g->cells)};
}

/* Counts the entries of each cell, or fills them in. */
static void fill_grid(view_grid *g, bool count_only) {
    for (size_t i = g->count; i-- > 0;) {
        const view_cells c = g->of[i];
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

/* Notes the cells of each thing, and counts them all. */
static void place_things(view_grid *g, view_points_fn *fn, const void *user) {
    g->entry_count = 0;
    for (size_t i = 0, n; i < g->count; i++) {
        const print_point *points = fn(user, i, &n);
        const view_cells c = g->of[i] = view_grid_cells(g, points, n, 0);
        if (n) g->entry_count += (uint64_t)(c.x1 - c.x0 + 1) * (uint64_t)(c.y1 - c.y0 + 1);
    }
}

froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out) {
    const double wanted = sqrt((double)count);
    uint32_t side = wanted < CELLS_LEAST ? CELLS_LEAST : wanted > CELLS_MOST ? CELLS_MOST : (uint32_t)wanted;
    out->count = count;
    out->of = support_calloc(alloc, count + 1, sizeof *out->of);
    for (; out->of; side /= 2) {
        out->cells = side;
        out->wide = view->width / side;
        out->high = view->height / side;
        place_things(out, fn, user);
        if (side <= CELLS_LEAST || out->entry_count <= ENTRIES_A_THING * (uint64_t)count) break;
    }
    const size_t cells = (size_t)out->cells * out->cells;
    out->starts = support_calloc(alloc, cells + 1, sizeof *out->starts);
    if (out->entry_count < UINT32_MAX) out->entries = support_calloc(alloc, out->entry_count + 1, sizeof *out->entries);
    if (!out->of || !out->starts || !out->entries) return FROE_E_MEMORY;
    fill_grid(out, true);
    for (size_t i = 1; i <= cells; i++) out->starts[i] += out->starts[i - 1]; /* ends, which filling lowers to starts */
    fill_grid(out, false);
    return FROE_OK;
}

void view_grid_free(const froe_allocator *alloc, view_grid *g) {
    support_free(alloc, g->starts, ((size_t)g->cells * g->cells + 1) * sizeof *g->starts);
    support_free(alloc, g->of, (g->count + 1) * sizeof *g->of);
    support_free(alloc, g->entries, (g->entry_count + 1) * sizeof *g->entries);
    *g = (view_grid){0};
}
