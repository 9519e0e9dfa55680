/* grid.c: laying the lines, finding the cells, sorting.
 *
 * A line that would run through a corner of an object or of a fragment is moved by a hair, and everything done once
 * more: that takes special data, for the box has no round numbers. */
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

/* Midpoints of midpoints; false where doubles run out. */
static bool lay_lines(split_grid *g, int axis) {
    uint32_t n = line_count(g, axis);
    double *line = g->lines[axis];
    line[0] = g->box.lo[axis];
    line[n] = g->box.hi[axis];
    for (uint32_t step = n; step > 1; step /= 2)
        for (uint32_t i = 0; i < n; i += step) line[i + step / 2] = 0.5 * line[i] + 0.5 * line[i + step];
    g->scale[axis] = n / (line[n] - line[0]);
    for (uint32_t i = 0; i < n; i++)
        if (!(line[i] < line[i + 1])) return false;
    return true;
}

/* Bits of columns and rows within the number of a cell: the levels' own, the root's highest. */
static void spread_bits(split_grid *g, int axis) {
    uint32_t n = line_count(g, axis);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t bits = 0, left = g->rest[0][axis];
        for (uint32_t l = 0; l < g->levels; l++) {
            bool own = g->axis[l] == axis;
            bits = 2 * bits + (own ? i >> (left - 1) & 1 : 0);
            left -= own;
        }
        g->spread[axis][i] = bits;
    }
}

static froe_status take_lines(const froe_allocator *alloc, split_grid *g) {
    for (int k = 0; k < 2; k++) {
        g->lines[k] = support_calloc(alloc, line_count(g, k) + 1, sizeof(double));
        g->spread[k] = support_calloc(alloc, line_count(g, k), sizeof(uint32_t));
        if (!g->lines[k] || !g->spread[k]) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- cells -- */

static packed_fragment fragment_of(const dealing *d, uint32_t index) {
    if (d->source->fragments) return d->source->fragments[index];
    return axis_whole(d->work->ends + index, index);
}

static void note_bad(dealing *d, int axis, uint32_t line) {
    d->bad_axis = axis;
    d->bad_line = line;
}

/* Column or row of a number, by its image. */
static uint32_t grid_place(const split_grid *g, int axis, double x) {
    const double *line = g->lines[axis];
    double guess = (x - line[0]) * g->scale[axis];
    uint32_t n = line_count(g, axis), i = guess > 0 ? guess < n ? (uint32_t)guess : n - 1 : 0;
    while (i && x < line[i]) i--;
    while (i + 1 < n && x > line[i + 1]) i++;
    return i;
}

/* Column or row of an end that a cut made. */
static uint32_t place_cut_end(dealing *d, const packed_fragment *f, bool last, int axis) {
    const split_grid *g = d->grid;
    uint32_t n = line_count(g, axis), i = grid_place(g, axis, (last ? f->q : f->p)[axis]);
    for (int way = 0; way < 2; way++) {
        uint32_t line = i + (uint32_t)way;
        if (line == 0 || line == n) continue;
        int side = axis_side(d->work, f, last, &g->box, axis, g->lines[axis][line]);
        if (!side) note_bad(d, axis, line);
        if (side && (side > 0) == way) i = way ? i + 1 : i - 1;
    }
    return i;
}

/* Column or row of a corner of an object. */
static uint32_t place_corner(dealing *d, int axis, double x) {
    const double *line = d->grid->lines[axis];
    uint32_t i = grid_place(d->grid, axis, x);
    if (x == line[i] && i) note_bad(d, axis, i);
    if (x == line[i + 1] && i + 1 < line_count(d->grid, axis)) note_bad(d, axis, i + 1);
    return i;
}

static void place_end(dealing *d, const packed_fragment *f, bool last, uint16_t out[2]) {
    bool own = f->id & (last ? PACKED_END : PACKED_START);
    for (int k = 0; k < 2; k++)
        out[k] = (uint16_t)(own ? place_corner(d, k, (last ? f->q : f->p)[k]) : place_cut_end(d, f, last, k));
}

static uint32_t cell_of(const split_grid *g, uint32_t column, uint32_t row) {
    return g->spread[0][column] | g->spread[1][row];
}

static froe_status place_all(dealing *d) {
    d->crossers.count = 0;
    d->steps = 0;
    d->bad_axis = -1;
    for (uint32_t i = 0; i < d->source->count && d->bad_axis < 0; i++) {
        packed_fragment f = fragment_of(d, i);
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

/* All further cells of a fragment. */
static froe_status walk_grid_cells(dealing *d, const grid_crosser *c) {
    split_grid *g = d->grid;
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
    return FROE_OK;
}

static froe_status walk_all(dealing *d) {
    froe_status status = FROE_OK;
    d->records.count = 0;
    memset(d->grid->count, 0, sizeof *d->grid->count << d->grid->levels << 1);
    for (size_t i = 0; i < d->crossers.count && !status && d->bad_axis < 0; i++) {
        status = walk_grid_cells(d, d->crossers.data + i);
        if (i % BLOCK == 0 && !base_progress(d->task, d->task->done)) status = FROE_E_CANCELLED;
    }
    return status;
}

/* ------------------------------------------------------------------ sorting -- */

/* From the last to the first, so that runs ascend. */

static void count_nodes(split_grid *g) {
    uint32_t cells = 1u << g->levels;
    for (uint32_t c = 0; c < cells; c++) g->count[cells + c] = g->starts[c + 1] - g->starts[c];
    for (uint32_t h = cells - 1; h; h--) g->count[h] = g->count[2 * h] + g->count[2 * h + 1] - g->count[h];
}

/* ------------------------------------------------------------------- whole -- */

/* Moves the bad line by a hair. */
static bool nudge(const dealing *d) {
    double *line = d->grid->lines[d->bad_axis] + d->bad_line;
    *line = nextafter(*line, INFINITY);
    return *line < line[1];
}

/* One attempt with the levels that the grid has. *made false: steps are too many, or lines cannot be laid. */
static froe_status attempt(dealing *d, bool *made) {
    split_grid *g = d->grid;
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
    froe_status status = take_lines(d->alloc, g);
    if (status) return status;
    *made = lay_lines(g, 0) && lay_lines(g, 1);
    for (int k = 0; k < 2; k++) spread_bits(g, k);
    g->starts = support_calloc(d->alloc, ((size_t)1 << g->levels) + 1, sizeof *g->starts);
    g->count = support_calloc(d->alloc, (size_t)2 << g->levels, sizeof *g->count);
    if (!g->starts || !g->count) return FROE_E_MEMORY;
    d->bad_axis = 0;
    for (int i = 0; *made && !status && d->bad_axis >= 0; i++) {
        if (i && (i > NUDGES || !nudge(d))) *made = false;
        status = place_all(d);
        if ((double)d->steps > (d->source->growth - 1) * d->source->count) *made = false;
        if (!status && *made && d->bad_axis < 0) status = walk_all(d);
    }
    if (status || !*made) return status;
    g->id_room = (size_t)d->source->count + d->records.count;
    if (g->id_room > INT32_MAX) return FROE_E_LIMIT;
    g->ids = support_calloc(d->alloc, g->id_room, sizeof *g->ids);
    if (!g->ids) return FROE_E_MEMORY;
    uint32_t *starts = d->grid->starts, cells = 1u << d->grid->levels;
    /* starts[c] becomes where the run of cell c ends; filling moves it to where it begins */
    for (uint32_t i = 0; i < d->source->count; i++) starts[d->first_cells[i]]++;
    for (size_t i = 0; i < d->records.count; i++) starts[d->records.data[i].cell]++;
    for (uint32_t c = 1; c <= cells; c++) starts[c] += starts[c - 1];
    /* the runs of objects, filled from behind */
    size_t crosser = d->crossers.count;
    for (size_t i = d->records.count; i--;) g->ids[--g->starts[d->records.data[i].cell]] = d->records.data[i].id;
    for (uint32_t i = d->source->count; i--;) {
        bool shared = crosser && d->crossers.data[crosser - 1].index == i;
        uint32_t object = d->source->fragments ? d->source->fragments[i].id & PACKED_OBJECT : i;
        crosser -= shared;
        g->ids[--g->starts[d->first_cells[i]]] = object | (shared ? GRID_SHARED : 0);
    }
    count_nodes(g);
    return FROE_OK;
}

/* Levels that leave about `load` objects in a cell. */
static uint32_t levels_for(const grid_source *source) {
    uint32_t levels = 0;
    while (levels < GRID_LEVELS && source->count >> levels > source->load) levels++;
    return levels;
}

/* Halving the levels of both axes by one halves the steps. */
static uint32_t fewer_levels(const dealing *d) {
    double most = (d->source->growth - 1) * d->source->count, steps = (double)d->steps;
    uint32_t levels = d->grid->levels;
    if (!(steps > most)) return 0;
    for (; levels && steps > most; steps *= 0.5) levels = levels > 2 ? levels - 2 : 0;
    return levels;
}

static bool box_fits(const packed_box *box) {
    double x = box->hi[0] - box->lo[0], y = box->hi[1] - box->lo[1];
    return x >= 0x1p-900 && y >= 0x1p-900 && x <= 0x1p900 && y <= 0x1p900;
}

froe_status grid_new(axis_work *work, base_task *task, const froe_allocator *alloc, const grid_source *source,
                     split_grid *out, bool *made) {
    split_grid grid = {0};
    dealing d = {.work = work, .task = task, .alloc = alloc, .source = source, .grid = &grid};
    uint32_t levels = box_fits(&source->box) ? levels_for(source) : 0;
    size_t room = levels >= 2 ? source->count : 1;
    froe_status status = FROE_OK;
    *made = false;
    d.first_cells = support_calloc(alloc, room, sizeof *d.first_cells);
    if (!d.first_cells) return FROE_E_MEMORY;
    while (levels >= 2 && !*made && !status) {
        grid = (split_grid){.box = source->box, .levels = levels};
        status = attempt(&d, made);
        levels = fewer_levels(&d);
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
