/* trace.c: first and last cell by arithmetic, the cells between by a walk. */
#include "build/index/trace.h"

typedef struct tracing {
    const split_grid *grid;
    axis_work *work;
    trace_counts *counts;
    deal_chunk *chunk;
    trace_bad *bad;
    uint32_t lower;
} tracing;

static void note_bad(tracing *t, int axis, uint32_t line) {
    *t->bad = (trace_bad){axis, line};
}

/* Column and row of an end of an object. False: it needs a closer look. */
static inline bool place_own(const split_grid *g, const double *x, uint32_t out[2]) {
    bool sure = true;
    for (int k = 0; k < 2; k++) {
        const double *line = g->lines[k], guess = (x[k] - line[0]) * g->scale[k];
        const uint32_t last = grid_lines(g, k) - 1, i = guess < last ? (uint32_t)(int32_t)guess : last;
        sure &= (x[k] > line[i]) & (x[k] < line[i + 1]);
        out[k] = i;
    }
    return sure;
}

/* Column and row of an end of a fragment: of a corner of the object, or of an end that a cut made. */
static void place_end(tracing *t, const packed_fragment *f, bool last, uint32_t out[2]) {
    const split_grid *g = t->grid;
    const bool own = f->id & (last ? PACKED_END : PACKED_START);
    for (int k = 0; k < 2; k++) {
        const double x = (last ? f->q : f->p)[k], *line = g->lines[k], guess = (x - line[0]) * g->scale[k];
        const uint32_t n = grid_lines(g, k);
        uint32_t i = guess > 0 ? guess < n ? (uint32_t)guess : n - 1 : 0;
        while (i && x < line[i]) i--;
        while (i + 1 < n && x > line[i + 1]) i++;
        if (own && x == line[i] && i) note_bad(t, k, i);
        if (own && x == line[i + 1] && i + 1 < n) note_bad(t, k, i + 1);
        for (int way = 0; way < 2 && !own; way++) {
            const uint32_t beside = i + (uint32_t)way;
            if (beside == 0 || beside == n) continue;
            const int side = axis_side(t->work, f, last, &g->box, k, line[beside]);
            if (!side) note_bad(t, k, beside);
            if (side && (side > 0) == way) i = way ? i + 1 : i - 1;
        }
        out[k] = i;
    }
}

static uint32_t cell_of(const split_grid *g, const uint32_t at[2]) {
    return g->spread[0][at[0]] | g->spread[1][at[1]];
}

/* The next step of a walk from a cell whose column and row both have to change yet: does it lead to another row? The
 * crossing with the column's line tells: is it beyond the row? */
static bool row_first(tracing *t, const axis_ends *ends, const uint32_t at[2], bool up) {
    const split_grid *g = t->grid;
    double side = g->lines[0][at[0] + 1], level = g->lines[1][at[1] + up], error;
    double beyond = axis_crossing(ends->p, ends->q, 0, side, &error) - level;
    if (t->work->context.first == NUM_FILTER && beyond > error) return up;
    if (t->work->context.first == NUM_FILTER && beyond < -error) return !up;
    int exact = axis_crossing_side(&t->work->context, ends->p, ends->q, 1, side, level);
    if (!exact) note_bad(t, 1, at[1] + up);
    return (exact > 0) == up;
}

static inline void trace_cell(tracing *t, uint32_t cell, uint32_t since, uint32_t id) {
    deal_chunk *c = t->chunk;
    c->entries.data[c->entries.count++] = (deal_entry){grid_place(cell, since, id), id};
    c->parts[cell >> t->lower]++;
    t->counts->met[cell] = 1;
}

/* All cells between the first and the last, and the last. */
static void walk_on(tracing *t, const packed_fragment *f, const uint32_t from[2], const uint32_t to[2]) {
    const split_grid *g = t->grid;
    const uint32_t object = f->id & PACKED_OBJECT;
    const bool up = to[1] > from[1];
    const axis_ends ends = axis_sorted(t->work, object); /* f may be a part of it */
    uint32_t at[2] = {from[0], from[1]}, cell = cell_of(g, at);
    while (at[0] != to[0] || at[1] != to[1]) {
        const bool row = at[0] == to[0] || (at[1] != to[1] && row_first(t, &ends, at, up));
        at[row] += !row || up ? 1u : UINT32_MAX; /* up, or down by one */
        const uint32_t next = cell_of(g, at);
        /* notes the crossing from a cell to the next in the node where they part */
        const uint32_t bit = 31 - (uint32_t)__builtin_clz(cell ^ next), level = g->levels - 1 - bit;
        t->counts->levels[level]++;
        t->counts->crossings[level < g->upper ? (1u << level) | (cell >> (bit + 1))
                                              : (1u << g->upper) | (cell >> t->lower)]++;
        cell = next;
        trace_cell(t, cell, level + 1, object | GRID_SHARED);
    }
}

froe_status trace_run(const froe_allocator *alloc, const grid_source *source, const split_grid *grid, axis_work *work,
                      trace_counts *counts, deal_chunk *chunk, trace_bad *bad) {
    tracing t = {.grid = grid, .work = work, .counts = counts, .chunk = chunk, .bad = bad, .lower = grid_lower(grid)};
    bad->axis = -1;
    const double most = (chunk->to - chunk->from) * (1 + 1.05 * grid->steps) + 256; /* nearly always */
    if (!array_reserve(alloc, &chunk->entries, (size_t)most)) return FROE_E_MEMORY;
    for (uint32_t i = chunk->from; i < chunk->to && bad->axis < 0; i++) {
        const packed_fragment f = source->fragments ? source->fragments[i] : axis_whole(work, i);
        uint32_t from[2], to[2];
        if (source->fragments || !place_own(grid, f.p, from) || !place_own(grid, f.q, to)) {
            place_end(&t, &f, false, from);
            place_end(&t, &f, true, to);
            if (bad->axis >= 0) break;
        }
        const uint32_t rows = to[1] > from[1] ? to[1] - from[1] : from[1] - to[1], steps = to[0] - from[0] + rows;
        if (!array_reserve(alloc, &chunk->entries, (size_t)steps + 1)) return FROE_E_MEMORY;
        const bool shared = steps || !packed_is_whole(f.id);
        trace_cell(&t, cell_of(grid, from), 0, (f.id & PACKED_OBJECT) | (shared ? GRID_SHARED : 0));
        if (steps) walk_on(&t, &f, from, to);
    }
    return FROE_OK;
}
