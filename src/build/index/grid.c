/* grid.c: laying the lines, dealing the entries to parts, sorting them there.
 *
 * A line that would run through a corner of an object or of a fragment is moved to the next double, and everything
 * is done once more: that is rare, for the box has no round numbers.
 *
 * Objects are dealt by chunks, whose number does not depend on that of threads: so the entries of a part are in the
 * order of their objects. */
#include "build/index/trace.h"
#include <math.h>
#include <string.h>

enum { NUDGES = 8, CHUNK = 1 << 15 };

typedef struct dealing {
    const froe_allocator *alloc;
    const grid_source *source;
    split_grid *grid;
    trace_chunk *chunks;
    size_t chunk_count;
    trace_counts *counts; /* of workers */
    uint32_t *offsets;    /* [chunk][part]: entries, then where they go */
} dealing;

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
        if (fits) g->axis[g->levels++] = (uint8_t)axis;
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

static unsigned worker_count(const grid_source *source) {
    return source->task ? source->task->threads : 1;
}

/* One job for each chunk, on all threads there are. */
static froe_status for_each_chunk(dealing *d, double span, base_job_fn *fn) {
    froe_status status = FROE_OK;
    if (d->source->task) return base_run(d->source->task, span, d->chunk_count, fn, d);
    for (size_t i = 0; i < d->chunk_count && !status; i++) status = fn(d, 0, i);
    return status;
}

static froe_status trace_job(void *user, unsigned worker, size_t job) {
    dealing *d = user;
    return trace_run(d->alloc, d->source, d->grid, d->source->workers + worker, d->counts + worker, d->chunks + job);
}

static froe_status deal_job(void *user, unsigned worker, size_t job) {
    dealing *d = user;
    split_grid *g = d->grid;
    trace_chunk *chunk = d->chunks + job;
    const uint32_t lower = grid_lower(g), mask = (1u << (lower + 1 + GRID_BITS)) - 1;
    (void)worker;
    for (size_t i = 0; i < chunk->entries.count; i++) {
        const trace_entry entry = chunk->entries.data[i];
        const uint32_t to = chunk->parts[entry.place >> (lower + 1 + GRID_BITS)]++;
        g->ids[to] = entry.id;
        g->places[to] = (uint16_t)(entry.place & mask);
    }
    array_free(d->alloc, &chunk->entries);
    return FROE_OK;
}

static froe_status take_room(dealing *d) {
    const split_grid *g = d->grid;
    const size_t parts = (size_t)1 << g->upper, count = d->source->count;
    d->chunk_count = (count + CHUNK - 1) / CHUNK;
    d->chunks = support_calloc(d->alloc, d->chunk_count, sizeof *d->chunks);
    d->offsets = support_calloc(d->alloc, d->chunk_count * parts, sizeof *d->offsets);
    d->counts = support_calloc(d->alloc, worker_count(d->source), sizeof *d->counts);
    bool room = d->chunks && d->offsets && d->counts;
    for (size_t i = 0; room && i < d->chunk_count; i++) {
        const size_t from = i * CHUNK, to = count - from < CHUNK ? count : from + CHUNK;
        d->chunks[i].from = (uint32_t)from, d->chunks[i].to = (uint32_t)to;
        d->chunks[i].parts = d->offsets + i * parts;
    }
    for (unsigned i = 0; room && i < worker_count(d->source); i++) {
        d->counts[i].crossings = support_calloc(d->alloc, 2 * parts, sizeof(uint32_t));
        d->counts[i].met = support_calloc(d->alloc, (size_t)1 << g->levels, sizeof *d->counts->met);
        room = d->counts[i].crossings && d->counts[i].met;
    }
    return room ? FROE_OK : FROE_E_MEMORY;
}

static void give_room_back(dealing *d) {
    const split_grid *g = d->grid;
    const size_t parts = (size_t)1 << g->upper;
    for (size_t i = 0; d->chunks && i < d->chunk_count; i++) array_free(d->alloc, &d->chunks[i].entries);
    for (unsigned i = 0; d->counts && i < worker_count(d->source); i++) {
        support_free(d->alloc, d->counts[i].crossings, 2 * parts * sizeof(uint32_t));
        support_free(d->alloc, d->counts[i].met, sizeof *d->counts->met << g->levels);
    }
    support_free(d->alloc, d->counts, worker_count(d->source) * sizeof *d->counts);
    support_free(d->alloc, d->offsets, d->chunk_count * parts * sizeof *d->offsets);
    support_free(d->alloc, d->chunks, d->chunk_count * sizeof *d->chunks);
}

/* Traces all chunks, until no line is bad. *made false: lines cannot be laid. */
static froe_status trace_all(dealing *d, bool *made) {
    split_grid *g = d->grid;
    const size_t parts = (size_t)1 << g->upper;
    froe_status status = FROE_OK;
    *made = false;
    for (int i = 0; i <= NUDGES && !*made && !status; i++) {
        for (size_t c = 0; c < d->chunk_count; c++) d->chunks[c].entries.count = 0, d->chunks[c].bad_axis = -1;
        memset(d->offsets, 0, d->chunk_count * parts * sizeof *d->offsets);
        for (unsigned w = 0; w < worker_count(d->source); w++) {
            memset(d->counts[w].crossings, 0, 2 * parts * sizeof(uint32_t));
            memset(d->counts[w].levels, 0, sizeof d->counts[w].levels);
            memset(d->counts[w].met, 0, sizeof *d->counts->met << g->levels);
        }
        status = for_each_chunk(d, 0.15, trace_job);
        size_t c = 0;
        while (c < d->chunk_count && d->chunks[c].bad_axis < 0) c++;
        *made = c == d->chunk_count;
        if (*made || status) continue;
        /* moves the first bad line to the next double */
        double *line = g->lines[d->chunks[c].bad_axis] + d->chunks[c].bad_line;
        *line = nextafter(*line, INFINITY);
        if (!(*line < line[1])) break;
    }
    return status;
}

/* Sums what the threads have counted, and finds how many objects nodes have, and where entries go. */
static froe_status sum_up(dealing *d) {
    split_grid *g = d->grid;
    const uint32_t parts = 1u << g->upper, cells = 1u << g->levels;
    trace_counts *all = d->counts;
    for (unsigned w = 1; w < worker_count(d->source); w++) {
        for (uint32_t i = 0; i < 2 * parts; i++) all->crossings[i] += d->counts[w].crossings[i];
        for (uint32_t l = 0; l < g->levels; l++) all->levels[l] += d->counts[w].levels[l];
        for (uint32_t i = 0; i < cells; i++) all->met[i] |= d->counts[w].met[i];
    }
    g->fragments[0] = d->source->count;
    for (uint32_t l = 0; l < g->levels; l++) g->fragments[l + 1] = g->fragments[l] + all->levels[l];
    for (uint32_t l = g->levels + 1; l--;) { /* the marks of a level are made from those below */
        for (uint32_t i = 0; i < 1u << l; i++) {
            if (l < g->levels) all->met[i] = all->met[2 * i] | all->met[2 * i + 1];
            g->cells[l] += all->met[i];
        }
    }
    if (g->fragments[g->levels] > INT32_MAX) return FROE_E_LIMIT;
    for (uint32_t p = 0, next = 0; p < parts; p++) {
        g->starts[p] = next;
        for (size_t c = 0; c < d->chunk_count; c++) {
            const uint32_t entries = d->chunks[c].parts[p];
            d->chunks[c].parts[p] = next;
            next += entries;
        }
        g->starts[p + 1] = next;
        g->count[parts + p] = next - g->starts[p] - all->crossings[parts + p];
    }
    for (uint32_t h = parts; --h;) g->count[h] = g->count[2 * h] + g->count[2 * h + 1] - all->crossings[h];
    return FROE_OK;
}

static froe_status deal_all(dealing *d, bool *made) {
    split_grid *g = d->grid;
    const froe_allocator *alloc = d->alloc;
    const size_t parts = (size_t)1 << g->upper;
    froe_status status = take_room(d);
    if (!status) status = trace_all(d, made);
    if (status || !*made) return status;
    g->count = support_calloc(alloc, 2 * parts, sizeof *g->count);
    g->starts = support_calloc(alloc, parts + 1, sizeof *g->starts);
    status = g->count && g->starts ? sum_up(d) : FROE_E_MEMORY;
    if (status) return status;
    g->ids = support_realloc(alloc, NULL, 0, g->fragments[g->levels] * sizeof *g->ids);
    g->places = support_realloc(alloc, NULL, 0, g->fragments[g->levels] * sizeof *g->places);
    return g->ids && g->places ? for_each_chunk(d, 0.05, deal_job) : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- whole -- */

froe_status grid_new(const froe_allocator *alloc, const grid_source *source, split_grid **out) {
    *out = NULL;
    split_grid *g = support_calloc(alloc, 1, sizeof *g);
    if (!g) return FROE_E_MEMORY;
    g->box = source->box;
    choose_levels(source, g);
    dealing d = {.alloc = alloc, .source = source, .grid = g};
    bool made = false;
    froe_status status = FROE_OK;
    if (g->levels >= 2) status = lay_lines(alloc, g, &made);
    if (!status && made) {
        status = deal_all(&d, &made);
        give_room_back(&d);
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
