/* grid.c: laying the lines, finding the cells, sorting.
 *
 * A line that would run through a corner of an object or of a fragment is moved to the next double, and everything
 * is done once more: that is rare, for the box has no round numbers. */
#include "build/index/grid.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUDGES = 8, BLOCK = 1 << 16 };

/* A fragment in more than one cell. */
typedef struct grid_crosser {
    uint32_t index;
    uint16_t from[2], to[2];
} grid_crosser;

typedef struct grid_record {
    uint32_t cell, id;
} grid_record;

typedef struct dealing {
    axis_work *work;
    base_task *task;
    const froe_allocator *alloc;
    const grid_source *source;
    split_grid *grid;
    uint32_t *first_cells; /* first cell of each fragment */
    ARRAY(grid_crosser) crossers;
    ARRAY(grid_record) records; /* further cells */
    uint64_t steps;             /* from cell to cell, of all fragments */
    int bad_axis;               /* a line that a corner lies in: its axis, -1: none */
    uint32_t bad_line;
} dealing;

/* ------------------------------------------------------------------- lines -- */

static uint32_t line_count(const split_grid *g, int axis) {
    return 1u << g->rest[0][axis];
}

/* Lays the lines for the levels that the grid has. *made false: doubles run out between them. */
static froe_status lay_lines(const froe_allocator *alloc, split_grid *g, bool *made) {
    /* which axis each level halves: that of the longer side */
    double side[2] = {g->box.hi[0] - g->box.lo[0], g->box.hi[1] - g->box.lo[1]};
    for (uint32_t l = 0; l < g->levels; l++) {
        g->axis[l] = side[1] > side[0];
        side[g->axis[l]] *= 0.5;
    }
    g->rest[g->levels][0] = g->rest[g->levels][1] = 0;
    for (uint32_t l = g->levels; l--;) {
        memcpy(g->rest[l], g->rest[l + 1], sizeof g->rest[l]);
        g->rest[l][g->axis[l]]++;
    }
    *made = true;
    for (int k = 0; k < 2; k++) {
        uint32_t n = line_count(g, k);
        double *line = g->lines[k] = support_calloc(alloc, n + 1, sizeof(double));
        g->spread[k] = support_calloc(alloc, n, sizeof(uint32_t));
        if (!g->lines[k] || !g->spread[k]) return FROE_E_MEMORY;
        /* midpoints of midpoints */
        line[0] = g->box.lo[k];
        line[n] = g->box.hi[k];
        for (uint32_t step = n; step > 1; step /= 2)
            for (uint32_t i = 0; i < n; i += step) line[i + step / 2] = 0.5 * line[i] + 0.5 * line[i + step];
        g->scale[k] = n / (line[n] - line[0]);
        for (uint32_t i = 0; i < n; i++) *made = *made && line[i] < line[i + 1];
        /* bits of columns and rows within the number of a cell: the levels' own, the root's highest */
        for (uint32_t i = 0; i < n; i++) {
            uint32_t bits = 0, left = g->rest[0][k];
            for (uint32_t l = 0; l < g->levels; l++) {
                bool own = g->axis[l] == k;
                bits = 2 * bits + (own ? i >> (left - 1) & 1 : 0);
                left -= own;
            }
            g->spread[k][i] = bits;
        }
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- cells -- */

static void note_bad(dealing *d, int axis, uint32_t line) {
    d->bad_axis = axis;
    d->bad_line = line;
}

/* Column and row of an end of a fragment: of a corner of the object, or of an end that a cut made. */
static void place_end(dealing *d, const packed_fragment *f, bool last, uint16_t out[2]) {
    const split_grid *g = d->grid;
    bool own = f->id & (last ? PACKED_END : PACKED_START);
    for (int k = 0; k < 2; k++) {
        const double x = (last ? f->q : f->p)[k], *line = g->lines[k], guess = (x - line[0]) * g->scale[k];
        uint32_t n = line_count(g, k), i = guess > 0 ? guess < n ? (uint32_t)guess : n - 1 : 0;
        while (i && x < line[i]) i--;
        while (i + 1 < n && x > line[i + 1]) i++;
        if (own && x == line[i] && i) note_bad(d, k, i);
        if (own && x == line[i + 1] && i + 1 < n) note_bad(d, k, i + 1);
        for (int way = 0; way < 2 && !own; way++) {
            uint32_t beside = i + (uint32_t)way;
            if (beside == 0 || beside == n) continue;
            int side = axis_side(d->work, f, last, &g->box, k, line[beside]);
            if (!side) note_bad(d, k, beside);
            if (side && (side > 0) == way) i = way ? i + 1 : i - 1;
        }
        out[k] = (uint16_t)i;
    }
}

static uint32_t cell_of(const split_grid *g, uint32_t column, uint32_t row) {
    return g->spread[0][column] | g->spread[1][row];
}

static froe_status place_all(dealing *d) {
    d->crossers.count = 0;
    d->steps = 0;
    d->bad_axis = -1;
    for (uint32_t i = 0; i < d->source->count && d->bad_axis < 0; i++) {
        packed_fragment f = d->source->fragments ? d->source->fragments[i] : axis_whole(d->work->ends + i, i);
        grid_crosser c = {.index = i};
        place_end(d, &f, false, c.from);
        place_end(d, &f, true, c.to);
        d->first_cells[i] = cell_of(d->grid, c.from[0], c.from[1]);
        if (i % BLOCK == 0 && !base_progress(d->task, d->task->done)) return FROE_E_CANCELLED;
        if (c.from[0] == c.to[0] && c.from[1] == c.to[1]) continue;
        d->steps += (uint64_t)(c.to[0] - c.from[0]) + (uint64_t)abs(c.to[1] - c.from[1]);
        if (!array_push(d->alloc, &d->crossers, c)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- walks -- */

/* The next step of a walk from a cell whose column and row both have to change yet: does it lead to another row? The
 * crossing with the column's line tells: is it beyond the row? */
static bool row_first(dealing *d, const axis_ends *ends, const uint32_t at[2], bool up) {
    const split_grid *g = d->grid;
    double side = g->lines[0][at[0] + 1], level = g->lines[1][at[1] + up], error;
    double beyond = axis_crossing(ends->p, ends->q, 0, side, &error) - level;
    if (d->work->context->first == NUM_FILTER && beyond > error) return up;
    if (d->work->context->first == NUM_FILTER && beyond < -error) return !up;
    int exact = axis_crossing_side(d->work->context, ends->p, ends->q, 1, side, level);
    if (!exact) note_bad(d, 1, at[1] + up);
    return (exact > 0) == up;
}

/* All further cells of all fragments. */
static froe_status walk_all(dealing *d) {
    split_grid *g = d->grid;
    d->records.count = 0;
    memset(g->count, 0, sizeof *g->count << g->levels << 1);
    for (size_t i = 0; i < d->crossers.count && d->bad_axis < 0; i++) {
        const grid_crosser *c = d->crossers.data + i;
        uint32_t at[2] = {c->from[0], c->from[1]}, cell = d->first_cells[c->index];
        uint32_t object = d->source->fragments ? d->source->fragments[c->index].id & PACKED_OBJECT : c->index;
        bool up = c->to[1] > c->from[1];
        while (at[0] != c->to[0] || at[1] != c->to[1]) {
            bool row = at[0] == c->to[0] || (at[1] != c->to[1] && row_first(d, d->work->ends + object, at, up));
            at[row] += !row || up ? 1u : UINT32_MAX; /* up, or down by one */
            uint32_t next = cell_of(g, at[0], at[1]);
            /* notes the crossing from a cell to the next in the node where they part */
            uint32_t bit = 31 - (uint32_t)__builtin_clz(cell ^ next), level = g->levels - 1 - bit;
            g->count[(1u << level) | (cell >> (bit + 1))]++;
            cell = next;
            if (!array_push(d->alloc, &d->records, (grid_record){cell, object | GRID_SHARED})) return FROE_E_MEMORY;
        }
        if (i % BLOCK == 0 && !base_progress(d->task, d->task->done)) return FROE_E_CANCELLED;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- whole -- */

/* One attempt with the levels that the grid has. *made false: steps are too many, or lines cannot be laid. */
static froe_status attempt(dealing *d, bool *made) {
    split_grid *g = d->grid;
    froe_status status = lay_lines(d->alloc, g, made);
    if (status) return status;
    g->starts = support_calloc(d->alloc, ((size_t)1 << g->levels) + 1, sizeof *g->starts);
    g->count = support_calloc(d->alloc, (size_t)2 << g->levels, sizeof *g->count);
    if (!g->starts || !g->count) return FROE_E_MEMORY;
    d->bad_axis = 0;
    for (int i = 0; *made && !status && d->bad_axis >= 0; i++) {
        if (i > NUDGES) *made = false;
        if (i && *made) {
            /* moves the bad line to the next double */
            double *line = g->lines[d->bad_axis] + d->bad_line;
            *line = nextafter(*line, INFINITY);
            *made = *line < line[1];
        }
        status = place_all(d);
        if ((double)d->steps > (d->source->growth - 1) * d->source->count) *made = false;
        if (!status && *made && d->bad_axis < 0) status = walk_all(d);
    }
    if (status || !*made) return status;
    g->id_room = (size_t)d->source->count + d->records.count;
    if (g->id_room > INT32_MAX) return FROE_E_LIMIT;
    g->ids = support_calloc(d->alloc, g->id_room, sizeof *g->ids);
    if (!g->ids) return FROE_E_MEMORY;
    uint32_t *starts = g->starts, cells = 1u << g->levels;
    /* starts[c] becomes where the run of cell c ends; filling moves it to where it begins */
    for (uint32_t i = 0; i < d->source->count; i++) starts[d->first_cells[i]]++;
    for (size_t i = 0; i < d->records.count; i++) starts[d->records.data[i].cell]++;
    for (uint32_t c = 1; c <= cells; c++) starts[c] += starts[c - 1];
    /* the runs of objects, filled from the last to the first, so that runs ascend */
    size_t crosser = d->crossers.count;
    for (size_t i = d->records.count; i--;) g->ids[--starts[d->records.data[i].cell]] = d->records.data[i].id;
    for (uint32_t i = d->source->count; i--;) {
        bool shared = crosser && d->crossers.data[crosser - 1].index == i;
        uint32_t object = d->source->fragments ? d->source->fragments[i].id & PACKED_OBJECT : i;
        crosser -= shared;
        g->ids[--starts[d->first_cells[i]]] = object | (shared ? GRID_SHARED : 0);
    }
    for (uint32_t c = 0; c < cells; c++) g->count[cells + c] = starts[c + 1] - starts[c];
    for (uint32_t h = cells - 1; h; h--) g->count[h] = g->count[2 * h] + g->count[2 * h + 1] - g->count[h];
    return FROE_OK;
}

froe_status grid_new(axis_work *work, base_task *task, const froe_allocator *alloc, const grid_source *source,
                     split_grid *out, bool *made) {
    split_grid grid = {0};
    dealing d = {.work = work, .task = task, .alloc = alloc, .source = source, .grid = &grid};
    double x = source->box.hi[0] - source->box.lo[0], y = source->box.hi[1] - source->box.lo[1];
    const bool fits = x >= 0x1p-900 && y >= 0x1p-900 && x <= 0x1p900 && y <= 0x1p900;
    const double most = (source->growth - 1) * source->count; /* steps from cell to cell */
    uint32_t levels = 0;
    /* levels that leave about `load` objects in a cell */
    while (fits && levels < GRID_LEVELS && source->count >> levels > source->load) levels++;
    size_t room = levels >= 2 ? source->count : 1;
    froe_status status = FROE_OK;
    *made = false;
    d.first_cells = support_calloc(alloc, room, sizeof *d.first_cells);
    if (!d.first_cells) return FROE_E_MEMORY;
    while (levels >= 2 && !*made && !status) {
        grid = (split_grid){.box = source->box, .levels = levels};
        status = attempt(&d, made);
        /* halving the levels of both axes by one halves the steps */
        double steps = (double)d.steps;
        if (!(steps > most)) levels = 0;
        for (; levels && steps > most; steps *= 0.5) levels = levels > 2 ? levels - 2 : 0;
        if (status || !*made) grid_free(alloc, &grid);
    }
    support_free(alloc, d.first_cells, room * sizeof *d.first_cells);
    array_free(alloc, &d.crossers);
    array_free(alloc, &d.records);
    if (!status && *made) *out = grid;
    return status;
}

void grid_free(const froe_allocator *alloc, split_grid *g) {
    for (int k = 0; k < 2; k++) {
        support_free(alloc, g->lines[k], (line_count(g, k) + 1) * sizeof(double));
        support_free(alloc, g->spread[k], line_count(g, k) * sizeof(uint32_t));
    }
    support_free(alloc, g->count, ((size_t)2 << g->levels) * sizeof *g->count);
    support_free(alloc, g->starts, (((size_t)1 << g->levels) + 1) * sizeof *g->starts);
    support_free(alloc, g->ids, (g->id_room ? g->id_room : 1) * sizeof *g->ids);
    *g = (split_grid){0};
}
