/* grid.c: a plain uniform grid, written for this comparison as the simplest index: cells of about one segment, ids
 * cell by cell in one array (CSR), stamps against duplicates. */
#include "peer.h"
#include "segment.h"
#include <stdlib.h>
#include <string.h>

typedef struct grid {
    const peer_segment *s;
    size_t n;
    double x0, y0, side, per_cell; /* cells per 1 */
    uint32_t cells;                /* a side */
    uint32_t *start, *ids, *stamps, stamp;
} grid;

static uint32_t cell_of(const grid *g, double x, double x0) {
    double i = (x - x0) * g->per_cell;
    return i < 0 ? 0 : i < g->cells ? (uint32_t)i : g->cells - 1;
}

/* Calls for every cell that the segment may meet: column by column, the rows between its heights at the borders. */
static void cover(grid *g, uint32_t id, void (*fn)(grid *, size_t, uint32_t)) {
    const peer_segment *s = g->s + id;
    uint32_t from = cell_of(g, s->ax, g->x0), to = cell_of(g, s->bx, g->x0);
    double low = fmin(s->ay, s->by), high = fmax(s->ay, s->by), width = g->side / g->cells;
    double slope = s->bx > s->ax ? (s->by - s->ay) / (s->bx - s->ax) : 0;
    for (uint32_t i = from; i <= to; i++) {
        double xa = fmax(s->ax, g->x0 + i * width - 1), xb = fmin(s->bx, g->x0 + (i + 1) * width + 1);
        double ya = s->ay + slope * (xa - s->ax), yb = s->ay + slope * (xb - s->ax);
        if (s->bx == s->ax) ya = low, yb = high;
        uint32_t j0 = cell_of(g, fmax(fmin(ya, yb) - 1, low), g->y0),
                 j1 = cell_of(g, fmin(fmax(ya, yb) + 1, high), g->y0);
        for (uint32_t j = j0; j <= j1; j++) fn(g, (size_t)i * g->cells + j, id);
    }
}

static void count_one(grid *g, size_t cell, uint32_t id) {
    (void)id;
    g->start[cell + 1]++;
}
static void put_one(grid *g, size_t cell, uint32_t id) {
    g->ids[g->start[cell]++] = id;
}

static void *build(const peer_data *data, const peer *self) {
    const peer_segment *s = (const peer_segment *)data->coords;
    const size_t n = data->count;
    (void)self;
    grid *g = calloc(1, sizeof *g);
    double x1 = -1e300, y1 = -1e300;
    *g = (grid){.s = s, .n = n, .x0 = 1e300, .y0 = 1e300};
    for (size_t i = 0; i < n; i++) {
        g->x0 = fmin(g->x0, s[i].ax), x1 = fmax(x1, s[i].bx);
        g->y0 = fmin(g->y0, fmin(s[i].ay, s[i].by)), y1 = fmax(y1, fmax(s[i].ay, s[i].by));
    }
    g->side = fmax(x1 - g->x0, y1 - g->y0) + 1;
    g->cells = (uint32_t)fmax(1, sqrt((double)n));
    g->per_cell = g->cells / g->side;
    size_t cells = (size_t)g->cells * g->cells;
    g->start = calloc(cells + 2, sizeof *g->start);
    for (size_t i = 0; i < n; i++) cover(g, (uint32_t)i, count_one);
    for (size_t c = 1; c <= cells; c++) g->start[c] += g->start[c - 1];
    g->ids = malloc((g->start[cells] + 1) * sizeof *g->ids);
    for (size_t i = n; i--;) cover(g, (uint32_t)i, put_one);
    memmove(g->start + 1, g->start, cells * sizeof *g->start); /* runs have moved up by themselves */
    g->start[0] = 0;
    g->stamps = calloc(n + 1, sizeof *g->stamps);
    return g;
}

static void drop(void *index) {
    grid *g = index;
    free(g->start), free(g->ids), free(g->stamps), free(g);
}

static size_t bytes(void *index) {
    const grid *g = index;
    size_t cells = (size_t)g->cells * g->cells;
    return 4 * (cells + 1) + 4 * (size_t)g->start[cells] + 4 * g->n;
}

static void window(grid *g, const double lo[2], const double hi[2], peer_answers *out) {
    uint32_t i0 = cell_of(g, lo[0], g->x0), i1 = cell_of(g, hi[0], g->x0), j0 = cell_of(g, lo[1], g->y0),
             j1 = cell_of(g, hi[1], g->y0);
    g->stamp++;
    for (uint32_t i = i0; i <= i1; i++)
        for (uint32_t k = g->start[(size_t)i * g->cells + j0]; k < g->start[(size_t)i * g->cells + j1 + 1]; k++) {
            uint32_t id = g->ids[k];
            if (g->stamps[id] == g->stamp) continue;
            g->stamps[id] = g->stamp;
            if (peer_meets_window(g->s + id, lo, hi)) peer_put(out, id);
        }
}

static int64_t above(const grid *g, double x, double y) {
    uint32_t i = cell_of(g, x, g->x0);
    int64_t best = -1;
    double height = 1e300, at, width = g->side / g->cells;
    for (uint32_t j = cell_of(g, y, g->y0); j < g->cells; j++) {
        const size_t c = (size_t)i * g->cells + j;
        for (uint32_t k = g->start[c]; k < g->start[c + 1]; k++)
            if (peer_above(g->s + g->ids[k], x, y, &at) && at < height) height = at, best = g->ids[k];
        if (best >= 0 && height <= g->y0 + (j + 1) * width) break;
    }
    return best;
}

/* A point that two segments which meet have in common, to less than the margin of cover(). */
static void common_point(const peer_segment *a, const peer_segment *b, double *x, double *y) {
    double dx = a->bx - a->ax, dy = a->by - a->ay, ex = b->bx - b->ax, ey = b->by - b->ay, d = dx * ey - dy * ex;
    const bool later = b->ax > a->ax || (b->ax == a->ax && b->ay > a->ay); /* on one line: where the later begins */
    double t = d != 0 ? ((b->ax - a->ax) * ey - (b->ay - a->ay) * ex) / d : 0;
    if (d == 0 && later) a = b;
    t = fmin(fmax(t, 0), 1);
    *x = a->ax + t * dx;
    *y = a->ay + t * dy;
}

/* Each pair once: in the cell of its common point. */
static void pairs(const grid *g, double values[2]) {
    const size_t cells = (size_t)g->cells * g->cells;
    double x, y;
    values[0] = values[1] = 0;
    for (size_t c = 0; c < cells; c++)
        for (uint32_t k = g->start[c]; k < g->start[c + 1]; k++)
            for (uint32_t l = k + 1; l < g->start[c + 1]; l++) {
                const peer_segment *a = g->s + g->ids[k], *b = g->s + g->ids[l];
                if (!peer_meet(a, b)) continue;
                common_point(a, b, &x, &y);
                if ((size_t)cell_of(g, x, g->x0) * g->cells + cell_of(g, y, g->y0) == c)
                    peer_pair(values, g->ids[k], g->ids[l]);
            }
}

static void answer(void *index, const peer_questions *q, peer_answers *out) {
    const double *x = q->numbers;
    if (q->work == PEER_PAIRS) pairs(index, out->values);
    for (size_t i = 0; i < q->count && q->work != PEER_PAIRS; i++, x += q->width) {
        if (q->work == PEER_WINDOW)
            window(index, x, x + 2, out), out->ends[i] = out->used;
        else
            out->values[i] = (double)above(index, x[0], x[1]);
    }
}

static bool serves(const peer_data *data, peer_work work) {
    return data->kind == PEER_SEGMENTS && data->dim == 2 &&
           (work == PEER_WINDOW || work == PEER_ABOVE || work == PEER_PAIRS);
}

static const peer plain_grid = {.name = "plain grid",
                                .what = "150 lines of C written for this comparison, the simplest index there is",
                                .serves = serves,
                                .make = build,
                                .free = drop,
                                .answer = answer,
                                .bytes = bytes};

const peer *peer_at(size_t i) {
    return i ? NULL : &plain_grid;
}
