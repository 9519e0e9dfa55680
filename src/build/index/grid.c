/* grid.c: laying the lines, dealing the entries to parts, sorting them there.
 *
 * A line that would run through a corner of an object or of a fragment is moved to the next double, and everything
 * is done once more: that is rare, for the box has no round numbers.
 */
#include "build/index/trace.h"
#include <math.h>
#include <string.h>

enum { NUDGES = 8 };

typedef struct grid_laying {
    const froe_allocator *alloc;
    const grid_source *source;
    split_grid *grid;
    unsigned threads;
    dealing deal;
    trace_bad *bad;       /* of chunks */
    trace_counts *counts; /* of threads */
} grid_laying;

/* ------------------------------------------------------------------- lines -- */

/* The levels: as many as leave `load` objects in a cell and `growth` fragments per fragment, and which axis each
 * halves: that of the longer side. A segment crosses as many lines as it has cells' widths, on average. */
static void choose_levels(const grid_source *source, split_grid *g) {
    const double side[2] = {g->box.hi[0] - g->box.lo[0], g->box.hi[1] - g->box.lo[1]};
    const double most = (source->growth - 1) * source->count;
    const uint32_t limit = source->parts ? GRID_LEVELS : GRID_LOWER;
    double cells[2] = {1, 1};
    bool fits = side[0] >= 0x1p-900 && side[1] >= 0x1p-900 && side[0] <= 0x1p900 && side[1] <= 0x1p900;
    while (fits && g->levels < limit && source->count >> g->levels > source->load) {
        const int axis = side[1] / cells[1] > side[0] / cells[0];
        cells[axis] *= 2;
        const double steps =
            source->length[0] / side[0] * (cells[0] - 1) + source->length[1] / side[1] * (cells[1] - 1);
        fits = steps <= most;
        if (fits) g->steps = steps / source->count, g->axis[g->levels++] = (uint8_t)axis;
    }
    g->upper = source->parts ? g->levels / 2 : 0;
    for (uint32_t l = g->levels; l--;) {
        memcpy(g->rest[l], g->rest[l + 1], sizeof g->rest[l]);
        g->rest[l][g->axis[l]]++;
    }
}

/* Lays the lines for the levels that the grid has. *made false: doubles run out between them. */
static froe_status lay_lines(const froe_allocator *alloc, split_grid *g, bool *made) {
    *made = true;
    for (int k = 0; k < 2; k++) {
        uint32_t n = grid_lines(g, k);
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

/* ------------------------------------------------------------------ dealing -- */

/* Nodes of which a thread counts crossings, and what keeps them apart from those of the next one. */
static size_t counted_of(const grid_laying *l) {
    return l->deal.parts * 2 + sizeof(base_apart) / sizeof *l->counts->crossings;
}

static froe_status trace_job(void *user, unsigned worker, size_t job) {
    grid_laying *l = user;
    return trace_run(l->alloc, l->source, l->grid, l->source->workers + worker, l->counts + worker,
                     l->deal.chunks + job, l->bad + job);
}

/* What stays is taken first: what is given back then lies behind it, where the system gets it. */
static froe_status take_room(grid_laying *l) {
    const size_t parts = (size_t)1 << l->grid->upper;
    l->grid->count = support_calloc(l->alloc, parts * 2, sizeof *l->grid->count);
    l->grid->starts = support_calloc(l->alloc, parts + 1, sizeof *l->grid->starts);
    if (!l->grid->count || !l->grid->starts) return FROE_E_MEMORY;
    l->deal = (dealing){.alloc = *l->alloc,
                        .task = l->source->task,
                        .count = l->source->count,
                        .shift = grid_lower(l->grid) + 1 + GRID_BITS,
                        .parts = parts};
    if (deal_new(&l->deal)) return FROE_E_MEMORY;
    l->bad = support_calloc(l->alloc, l->deal.chunk_count, sizeof *l->bad);
    l->counts = support_calloc(l->alloc, l->threads, sizeof *l->counts);
    bool room = l->bad && l->counts;
    for (unsigned i = 0; room && i < l->threads; i++) {
        l->counts[i].crossings = support_calloc(l->alloc, counted_of(l), sizeof *l->counts->crossings);
        l->counts[i].met = support_calloc(l->alloc, (size_t)1 << l->grid->levels, sizeof *l->counts->met);
        room = l->counts[i].crossings && l->counts[i].met;
    }
    return room ? FROE_OK : FROE_E_MEMORY;
}

static void give_room_back(grid_laying *l) {
    for (unsigned i = 0; l->counts && i < l->threads; i++) {
        support_free(l->alloc, l->counts[i].crossings, counted_of(l) * sizeof *l->counts->crossings);
        support_free(l->alloc, l->counts[i].met, sizeof *l->counts->met << l->grid->levels);
    }
    support_free(l->alloc, l->counts, l->threads * sizeof *l->counts);
    support_free(l->alloc, l->bad, l->deal.chunk_count * sizeof *l->bad);
    deal_free(&l->deal);
}

/* Traces all chunks, until no line is bad. *made false: lines cannot be laid. */
static froe_status trace_all(grid_laying *l, bool *made) {
    const split_grid *g = l->grid;
    froe_status status = FROE_OK;
    *made = false;
    for (int i = 0; i <= NUDGES && !*made && !status; i++) {
        deal_clear(&l->deal);
        for (unsigned w = 0; w < l->threads; w++) {
            memset(l->counts[w].crossings, 0, counted_of(l) * sizeof *l->counts->crossings);
            memset(l->counts[w].levels, 0, sizeof l->counts[w].levels);
            memset(l->counts[w].met, 0, sizeof *l->counts->met << g->levels);
        }
        status = deal_each(&l->deal, 0.15, trace_job, l);
        size_t c = 0;
        while (!status && c < l->deal.chunk_count && l->bad[c].axis < 0) c++;
        *made = !status && c == l->deal.chunk_count;
        if (*made || status) continue;
        /* moves the first bad line to the next double */
        double *line = g->lines[l->bad[c].axis] + l->bad[c].line;
        *line = nextafter(*line, INFINITY);
        if (!(*line < line[1])) break;
    }
    return status;
}

/* Sums what the threads have counted, and finds how many objects nodes have, and where entries go. */
static froe_status sum_up(grid_laying *l) {
    split_grid *g = l->grid;
    const uint32_t parts = 1u << g->upper, cells = 1u << g->levels;
    trace_counts *all = l->counts;
    for (unsigned w = 1; w < l->threads; w++) {
        for (uint32_t i = 0; i < 2 * parts; i++) all->crossings[i] += l->counts[w].crossings[i];
        for (uint32_t i = 0; i < g->levels; i++) all->levels[i] += l->counts[w].levels[i];
        for (uint32_t i = 0; i < cells; i++) all->met[i] |= l->counts[w].met[i];
    }
    g->fragments[0] = l->source->count;
    for (uint32_t i = 0; i < g->levels; i++) g->fragments[i + 1] = g->fragments[i] + all->levels[i];
    for (uint32_t level = g->levels + 1; level--;) { /* the marks of a level are made from those below */
        for (uint32_t i = 0; i < 1u << level; i++) {
            if (level < g->levels) all->met[i] = all->met[2 * i] | all->met[2 * i + 1];
            g->cells[level] += all->met[i];
        }
    }
    froe_status status = deal_starts(&l->deal, g->starts);
    if (status) return status;
    for (uint32_t p = 0; p < parts; p++)
        g->count[parts + p] = g->starts[p + 1] - g->starts[p] - all->crossings[parts + p];
    for (uint32_t h = parts; --h;) g->count[h] = g->count[2 * h] + g->count[2 * h + 1] - all->crossings[h];
    return FROE_OK;
}

static froe_status deal_all(grid_laying *l, bool *made) {
    split_grid *g = l->grid;
    froe_status status = take_room(l);
    if (!status) status = trace_all(l, made);
    if (status || !*made) return status;
    status = sum_up(l);
    if (status) return status;
    g->ids = support_realloc(l->alloc, NULL, 0, g->fragments[g->levels] * sizeof *g->ids);
    g->places = support_realloc(l->alloc, NULL, 0, g->fragments[g->levels] * sizeof *g->places);
    return g->ids && g->places ? deal_out(&l->deal, 0.05, g->ids, g->places) : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- whole -- */

froe_status grid_new(const froe_allocator *alloc, const grid_source *source, split_grid **out) {
    *out = NULL;
    split_grid *g = support_calloc(alloc, 1, sizeof *g);
    if (!g) return FROE_E_MEMORY;
    g->box = source->box;
    choose_levels(source, g);
    grid_laying l = {.alloc = alloc, .source = source, .grid = g, .threads = source->task ? source->task->threads : 1};
    bool made = false;
    froe_status status = FROE_OK;
    if (g->levels >= 2) status = lay_lines(alloc, g, &made);
    if (!status && made) {
        status = deal_all(&l, &made);
        give_room_back(&l);
    }
    if (status || !made)
        grid_free(alloc, g);
    else
        *out = g;
    return status;
}

void grid_free(const froe_allocator *alloc, split_grid *g) {
    const size_t parts = (size_t)1 << g->upper, entries = g->fragments[g->levels];
    for (int k = 0; k < 2; k++) {
        support_free(alloc, g->lines[k], (grid_lines(g, k) + 1) * sizeof(double));
        support_free(alloc, g->spread[k], grid_lines(g, k) * sizeof(uint32_t));
    }
    support_free(alloc, g->count, 2 * parts * sizeof *g->count);
    support_free(alloc, g->starts, (parts + 1) * sizeof *g->starts);
    support_free(alloc, g->ids, entries * sizeof *g->ids);
    support_free(alloc, g->places, entries * sizeof *g->places);
    support_free(alloc, g, sizeof *g);
}

/* ------------------------------------------------------------------- parts -- */

froe_status grid_sort(const froe_allocator *alloc, const split_grid *g, uint32_t part, grid_part *out) {
    const uint32_t lower = grid_lower(g), cells = 1u << lower, from = g->starts[part], to = g->starts[part + 1];
    out->ids.count = out->since.count = 0;
    if (!out->starts) out->starts = support_calloc(alloc, 2 * (size_t)cells + 1, sizeof *out->starts);
    if (!out->count) out->count = support_calloc(alloc, 2 * (size_t)cells, sizeof *out->count);
    if (!out->starts || !out->count || !array_reserve(alloc, &out->ids, to - from) ||
        !array_reserve(alloc, &out->since, to - from))
        return FROE_E_MEMORY;
    uint32_t *starts = out->starts, *count = out->count;
    out->ids.count = out->since.count = to - from;
    memset(starts, 0, (2 * (size_t)cells + 1) * sizeof *starts);
    memset(count, 0, 2 * (size_t)cells * sizeof *count);
    for (uint32_t i = from; i < to; i++) {
        const uint32_t place = g->places[i], since = grid_since(place);
        starts[place >> GRID_BITS]++;
        /* the level above is that of the node where a crossing parts two cells */
        if (since > g->upper) count[(cells | place >> (GRID_BITS + 1)) >> (lower - (since - 1 - g->upper))]++;
    }
    /* a start becomes where its run ends; filling moves it to where it begins */
    for (uint32_t c = 1; c <= 2 * cells; c++) starts[c] += starts[c - 1];
    for (uint32_t i = to; i-- > from;) {
        const uint32_t place = g->places[i], at = --starts[place >> GRID_BITS];
        out->ids.data[at] = g->ids[i];
        out->since.data[at] = (uint8_t)grid_since(place);
    }
    for (uint32_t c = 0; c < cells; c++) count[cells + c] = starts[2 * c + 2] - starts[2 * c];
    for (uint32_t h = cells; --h;) count[h] = count[2 * h] + count[2 * h + 1] - count[h];
    return FROE_OK;
}

void grid_part_free(const froe_allocator *alloc, const split_grid *g, grid_part *p) {
    const size_t cells = (size_t)1 << grid_lower(g);
    support_free(alloc, p->starts, (2 * cells + 1) * sizeof *p->starts);
    support_free(alloc, p->count, 2 * cells * sizeof *p->count);
    array_free(alloc, &p->ids);
    array_free(alloc, &p->since);
}
