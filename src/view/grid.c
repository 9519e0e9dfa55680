/* grid.c: the entries of each cell are counted first, then filled in. */
#include "view/grid.h"
#include "base/curve.h"
#include <math.h>
#include <string.h>

enum { CELLS_LEAST = 8, CELLS_MOST = 4096, ENTRIES_A_THING = 12 };

uint64_t view_grid_place(const froe_projection *view, print_point point) {
    const double lo[2] = {0, 0}, hi[2] = {view->width, view->height};
    double at[2] = {point.x, point.y};
    for (int k = 0; k < 2; k++) at[k] = at[k] > 0 ? at[k] < hi[k] ? at[k] : hi[k] : 0;
    return base_curve_place(2, at, at, lo, hi);
}

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
static void fill_grid(view_grid *g, const view_cells *of, bool count_only) {
    for (size_t i = g->count; i-- > 0;) {
        const view_cells c = of[i];
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
static void place_things(view_grid *g, view_points_fn *fn, const void *user, view_cells *of) {
    g->entry_count = 0;
    for (size_t i = 0, n; i < g->count; i++) {
        const print_point *points = fn(user, i, &n);
        const view_cells c = of[i] = view_grid_cells(g, points, n, 0);
        if (n) g->entry_count += (uint64_t)(c.x1 - c.x0 + 1) * (uint64_t)(c.y1 - c.y0 + 1);
    }
}

froe_status view_grid_new(const froe_allocator *alloc, const froe_projection *view, size_t count, view_points_fn *fn,
                          const void *user, view_grid *out) {
    const double wanted = sqrt((double)count);
    uint32_t side = wanted < CELLS_LEAST ? CELLS_LEAST : wanted > CELLS_MOST ? CELLS_MOST : (uint32_t)wanted;
    out->count = count;
    view_cells *of = support_calloc(alloc, count + 1, sizeof *of);
    for (; of; side /= 2) {
        out->cells = side;
        out->wide = view->width / side;
        out->high = view->height / side;
        place_things(out, fn, user, of);
        if (side <= CELLS_LEAST || out->entry_count <= ENTRIES_A_THING * (uint64_t)count) break;
    }
    const size_t cells = (size_t)out->cells * out->cells;
    out->starts = support_calloc(alloc, cells + 1, sizeof *out->starts);
    if (out->entry_count < UINT32_MAX) out->entries = support_calloc(alloc, out->entry_count + 1, sizeof *out->entries);
    out->stamps = support_calloc(alloc, count + 1, sizeof *out->stamps);
    const bool ok = of && out->starts && out->entries && out->stamps;
    if (ok) {
        fill_grid(out, of, true);
        for (size_t i = 1; i <= cells; i++) out->starts[i] += out->starts[i - 1]; /* ends, which filling lowers */
        fill_grid(out, of, false);
    }
    support_free(alloc, of, (count + 1) * sizeof *of);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

void view_grid_free(const froe_allocator *alloc, view_grid *g) {
    support_free(alloc, g->starts, ((size_t)g->cells * g->cells + 1) * sizeof *g->starts);
    support_free(alloc, g->stamps, (g->count + 1) * sizeof *g->stamps);
    support_free(alloc, g->entries, (g->entry_count + 1) * sizeof *g->entries);
    *g = (view_grid){0};
}

froe_status view_grid_fork(const froe_allocator *alloc, const view_grid *g, view_grid *out) {
    *out = *g;
    out->walks = 0;
    out->stamps = support_calloc(alloc, g->count + 1, sizeof *out->stamps);
    return out->stamps ? FROE_OK : FROE_E_MEMORY;
}

void view_grid_close(const froe_allocator *alloc, view_grid *g) {
    support_free(alloc, g->stamps, (g->count + 1) * sizeof *g->stamps);
    *g = (view_grid){0};
}

/* ----------------------------------------------------------------------- walks -- */

static view_grid_walk begin_walk(view_grid *g, view_cells c) {
    if (!++g->walks) { /* after 2^32 of them */
        memset(g->stamps, 0, g->count * sizeof *g->stamps);
        g->walks = 1;
    }
    return (view_grid_walk){.grid = g, .cells = c};
}

/* The first row. */
static view_grid_walk enter_first(view_grid_walk w) {
    if (w.cells.x0 > w.cells.x1 || w.cells.y0 > w.cells.y1) {
        w.y = w.cells.y1;
        return w;
    }
    w.y = (uint16_t)(w.cells.y0 - 1); /* may wrap, as rows begin at y + 1 */
    if (view_grid_row(&w)) view_grid_enter(&w);
    return w;
}

view_grid_walk view_grid_begin(view_grid *g, view_cells cells) {
    return enter_first(begin_walk(g, cells));
}

view_grid_walk view_grid_along(view_grid *g, print_point a, print_point b, double beyond) {
    const print_point ends[2] = {a, b};
    view_grid_walk w = begin_walk(g, view_grid_cells(g, ends, 2, beyond));
    w.along = true;
    w.a = a, w.b = b;
    w.beyond = beyond;
    return enter_first(w);
}

/* The cells of a row near ab: where the part of it within the row, made `beyond` higher, reaches. Rows at the margins
 * hold what lies beside the page, too. */
static void narrow_row(view_grid_walk *w) {
    const view_grid *g = w->grid;
    const double dy = w->b.y - w->a.y, slack = 1e-9 * g->high,
                 low = w->y ? w->y * g->high - w->beyond - slack : -INFINITY,
                 high = w->y + 1u < g->cells ? (w->y + 1) * g->high + w->beyond + slack : INFINITY;
    double from = 0, to = 1;
    if (dy != 0) {
        const double s = (low - w->a.y) / dy, t = (high - w->a.y) / dy, first = s < t ? s : t, last = s < t ? t : s;
        from = first > 0 ? first : 0, to = last < 1 ? last : 1;
    }
    const print_point ends[2] = {{w->a.x + from * (w->b.x - w->a.x), w->a.y},
                                 {w->a.x + to * (w->b.x - w->a.x), w->a.y}};
    const view_cells row = view_grid_cells(g, ends, 2, w->beyond);
    w->x = row.x0 > w->cells.x0 ? row.x0 : w->cells.x0;
    w->x1 = row.x1 < w->cells.x1 ? row.x1 : w->cells.x1;
}

bool view_grid_row(view_grid_walk *w) {
    if (w->y == w->cells.y1) return false;
    w->y++;
    w->x = w->cells.x0, w->x1 = w->cells.x1;
    if (w->along) narrow_row(w);
    return true;
}
