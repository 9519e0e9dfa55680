/* arcs.c: whose visible piece lies over what somebody else paints.
 *
 * Each node may be painted whole, once, if it comes after every node that paints, behind it, where it is visible: then
 * the last to paint any point is the one that is visible there. A grid on the page finds pairs of a visible piece and a
 * part; separating axes in doubles decide almost all of them, sightlines the rest: parts that touch must not count. */
#include "view/parts.h"
#include <math.h>

enum { CELLS_MOST = 512, ENTRIES_A_PART = 12 };

typedef struct grid {
    uint32_t cells;    /* a side */
    uint32_t *starts;  /* cells^2 + 1 */
    uint32_t *entries; /* parts */
    double wide, high; /* of a cell */
} grid;

typedef struct finder {
    view_parts *parts;
    view_sights *sights;
    view_arcs *arcs;
    grid grid;
    print_ring piece;
    view_ring ring;
    uint32_t *stamps; /* per part: the visible piece + 1 that it was compared with last */
    uint32_t *known;  /* per node: the node + 1 that is known to come after it */
    uint64_t most, *tests;
} finder;

/* ------------------------------------------------------------------------- grid -- */

typedef struct cell_range {
    uint32_t x0, y0, x1, y1; /* inclusive */
} cell_range;

static uint32_t cell_at(double x, double size, uint32_t cells) {
    const double at = floor(x / size);
    return at >= 0 ? at < cells ? (uint32_t)at : cells - 1 : 0;
}

static cell_range range_of(const grid *g, const print_point *ring, size_t count) {
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        x0 = fmin(x0, ring[i].x), x1 = fmax(x1, ring[i].x);
        y0 = fmin(y0, ring[i].y), y1 = fmax(y1, ring[i].y);
    }
    const double slack = 1e-9; /* of a cell: rounding must not part neighbours */
    return (cell_range){
        cell_at(x0 - slack * g->wide, g->wide, g->cells), cell_at(y0 - slack * g->high, g->high, g->cells),
        cell_at(x1 + slack * g->wide, g->wide, g->cells), cell_at(y1 + slack * g->high, g->high, g->cells)};
}

static uint64_t entries_for(finder *f) {
    uint64_t total = 0;
    for (size_t i = 0; i < f->parts->parts.count; i++) {
        const paint_part *p = f->parts->parts.data + i;
        const cell_range r = range_of(&f->grid, f->parts->points.data + p->first, p->count);
        total += (uint64_t)(r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1);
    }
    return total;
}

static void set_cells(finder *f, uint32_t cells) {
    f->grid.cells = cells;
    f->grid.wide = f->parts->view->width / cells;
    f->grid.high = f->parts->view->height / cells;
}

/* As fine as the number of parts asks for, but not so fine that large parts fill the memory. */
static uint64_t choose_cells(finder *f) {
    const double wanted = sqrt((double)f->parts->parts.count);
    uint32_t cells = wanted < 8 ? 8 : wanted > CELLS_MOST ? CELLS_MOST : (uint32_t)wanted;
    for (;; cells /= 2) {
        set_cells(f, cells);
        const uint64_t entries = entries_for(f);
        if (cells <= 8 || entries <= ENTRIES_A_PART * (uint64_t)f->parts->parts.count) return entries;
    }
}

static void fill_grid(finder *f, bool count_only) {
    grid *g = &f->grid;
    for (size_t i = f->parts->parts.count; i-- > 0;) {
        const paint_part *p = f->parts->parts.data + i;
        const cell_range r = range_of(g, f->parts->points.data + p->first, p->count);
        for (uint32_t y = r.y0; y <= r.y1; y++)
            for (uint32_t x = r.x0; x <= r.x1; x++) {
                const size_t cell = (size_t)y * g->cells + x;
                if (count_only)
                    g->starts[cell]++;
                else
                    g->entries[--g->starts[cell]] = (uint32_t)i;
            }
    }
}

static bool make_grid(finder *f, uint64_t *entry_count) {
    const froe_allocator *alloc = &f->parts->v->alloc;
    grid *g = &f->grid;
    *entry_count = choose_cells(f);
    const size_t cells = (size_t)g->cells * g->cells;
    g->starts = base_calloc(alloc, cells + 1, sizeof *g->starts);
    g->entries = *entry_count < UINT32_MAX ? base_calloc(alloc, *entry_count + 1, sizeof *g->entries) : NULL;
    if (!g->starts || !g->entries) return false;
    fill_grid(f, true);
    for (size_t i = 1; i <= cells; i++) g->starts[i] += g->starts[i - 1]; /* ends, which filling lowers to starts */
    fill_grid(f, false);
    return true;
}

/* ---------------------------------------------------------------------- overlap -- */

static bool beyond(view_sights *s, const view_corner *a, uint32_t a_count, const view_corner *b, uint32_t b_count) {
    for (uint32_t i = 0; i < a_count; i++) {
        const view_way way = a[i].way;
        bool all = true;
        for (uint32_t j = 0; j < b_count && all; j++) {
            const int side = view_side(s, way >> 1, &b[j].ray, b[j].vertex, b[j ? j - 1 : b_count - 1].way, b[j].way);
            all = way & 1 ? side >= 0 : side <= 0;
        }
        if (all) return true;
    }
    return false;
}

static bool overlap_exactly(finder *f, const view_piece *piece, const paint_part *part, int kind) {
    const froe_visibility *v = f->parts->v;
    const view_corner *a = v->corners.data + piece->first, *b;
    uint32_t count;
    if (kind == PART_VISIBLE) {
        b = v->corners.data + v->pieces[part->source].first;
        count = v->pieces[part->source].count;
    } else {
        const bool ok = kind == PART_PIECE ? view_beam_of(f->sights, part->source, &f->ring)
                                           : view_beam_of_object(f->sights, part->source, &f->ring);
        if (!ok) return true; /* an arc too many does no harm */
        b = f->ring.data;
        count = (uint32_t)f->ring.count;
    }
    return !beyond(f->sights, a, piece->count, b, count) && !beyond(f->sights, b, count, a, piece->count);
}

/* Do their interiors overlap? Where rounding could hide that, sightlines tell. */
static bool overlap(finder *f, const view_piece *piece, size_t i) {
    const paint_part *part = f->parts->parts.data + i;
    const print_point *ring = f->parts->points.data + part->first;
    const double unsure = 1e-9 * (f->parts->view->width + f->parts->view->height);
    if (!print_overlap(f->piece.data, f->piece.count, ring, part->count, -unsure)) return false;
    if (print_overlap(f->piece.data, f->piece.count, ring, part->count, unsure)) return true;
    return overlap_exactly(f, piece, part, f->parts->kinds.data[i]);
}

/* ------------------------------------------------------------------------- arcs -- */

static froe_status compare(finder *f, uint32_t visible, uint32_t i) {
    const view_piece *piece = f->parts->v->pieces + visible;
    const paint_part *part = f->parts->parts.data + i;
    const uint32_t node = f->parts->node_of[visible];
    if (f->stamps[i] == visible + 1) return FROE_OK;
    f->stamps[i] = visible + 1;
    if (part->node == node || f->known[part->node] == node + 1) return FROE_OK;
    if (f->parts->clear && part->place <= piece->place) return FROE_OK;
    if (++*f->tests > f->most) return FROE_E_BUDGET;
    if (!overlap(f, piece, i)) return FROE_OK;
    f->known[part->node] = node + 1;
    return array_push(&f->parts->v->alloc, f->arcs, (graph_arc){part->node, node}) ? FROE_OK : FROE_E_MEMORY;
}

static froe_status compare_piece(finder *f, uint32_t visible) {
    froe_status status = FROE_OK;
    const grid *g = &f->grid;
    f->piece.count = 0;
    if (!view_print_visible(f->parts, visible, &f->piece)) return FROE_E_MEMORY;
    if (f->piece.count < 3) return FROE_OK;
    const cell_range r = range_of(g, f->piece.data, f->piece.count);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            const size_t cell = (size_t)y * g->cells + x;
            for (uint32_t e = g->starts[cell]; e < g->starts[cell + 1] && !status; e++)
                status = compare(f, visible, g->entries[e]);
        }
    return status;
}

froe_status view_find_arcs(view_parts *parts, view_sights *sights, uint64_t most, view_arcs *arcs, uint64_t *tests) {
    const froe_allocator *alloc = &parts->v->alloc;
    finder f = {.parts = parts, .sights = sights, .arcs = arcs, .most = most, .tests = tests};
    const size_t part_count = parts->parts.count, node_count = parts->nodes.count;
    uint64_t entries = 0;
    arcs->count = 0;
    f.stamps = base_calloc(alloc, part_count + 1, sizeof *f.stamps);
    f.known = base_calloc(alloc, node_count + 1, sizeof *f.known);
    const bool ok = f.stamps && f.known && make_grid(&f, &entries);
    froe_status status = ok ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; i < parts->v->piece_count && !status; i++) status = compare_piece(&f, i);
    base_free(alloc, f.stamps, (part_count + 1) * sizeof *f.stamps);
    base_free(alloc, f.known, (node_count + 1) * sizeof *f.known);
    if (f.grid.starts)
        base_free(alloc, f.grid.starts, ((size_t)f.grid.cells * f.grid.cells + 1) * sizeof *f.grid.starts);
    base_free(alloc, f.grid.entries, (entries + 1) * sizeof *f.grid.entries);
    array_free(alloc, &f.piece);
    array_free(alloc, &f.ring);
    return status;
}
