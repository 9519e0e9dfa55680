/* canvas.c: shapes row by row. */
#include "oracle/canvas.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct oracle_crossing {
    uint32_t row;
    int turn;
    double x;
} oracle_crossing;

static void *grow(void *old, size_t size) {
    void *p = realloc(old, size);
    if (!p) {
        fprintf(stderr, "oracle: no memory for %zu bytes\n", size);
        exit(1);
    }
    return p;
}

oracle_canvas oracle_canvas_new(oracle_grid grid, const froe_projection *view) {
    const size_t samples = (size_t)grid.wide * grid.high;
    oracle_canvas c = {.grid = grid, .view = view, .top = grow(NULL, samples * sizeof *c.top)};
    for (size_t i = 0; i < samples; i++) c.top[i] = FROE_NONE;
    return c;
}

void oracle_canvas_free(oracle_canvas *c) {
    free(c->top);
    free(c->layers);
    free(c->crossings);
}

/* The first sample along an axis at or beyond a place. */
static uint32_t first_at(double place, double shift, double size, uint32_t cells) {
    const double i = ceil(place / size * cells - 0.5 - shift);
    return i <= 0 ? 0 : i < cells ? (uint32_t)i : cells;
}

static double row_place(const oracle_canvas *c, uint32_t row) {
    double page[2];
    oracle_place(&c->grid, c->view, (size_t)row * c->grid.wide, page);
    return page[1];
}

void oracle_side(oracle_canvas *c, const double from[2], const double to[2]) {
    const int turn = from[1] < to[1] ? 1 : -1;
    const double *a = turn > 0 ? from : to, *b = turn > 0 ? to : from;
    const uint32_t first = first_at(a[1], c->grid.shift[1], c->view->height, c->grid.high),
                   end = first_at(b[1], c->grid.shift[1], c->view->height, c->grid.high);
    for (uint32_t row = first; row < end; row++) {
        const double t = (row_place(c, row) - a[1]) / (b[1] - a[1]);
        if (c->crossing_count == c->crossing_room)
            c->crossings = grow(c->crossings, (c->crossing_room = 2 * c->crossing_room + 64) * sizeof *c->crossings);
        c->crossings[c->crossing_count++] = (oracle_crossing){row, turn, a[0] + t * (b[0] - a[0])};
    }
}

static int by_place(const void *a, const void *b) {
    const oracle_crossing *p = a, *q = b;
    if (p->row != q->row) return p->row < q->row ? -1 : 1;
    return p->x < q->x ? -1 : p->x > q->x;
}

static void put(oracle_canvas *c, size_t sample, uint32_t patch, bool clear) {
    if (!clear && c->top[sample] != FROE_NONE) { /* what was there is hidden for good */
        c->layers[c->top[sample]] = (oracle_layer){patch, FROE_NONE};
        return;
    }
    if (c->count == c->room) c->layers = grow(c->layers, (c->room = 2 * c->room + 1024) * sizeof *c->layers);
    c->layers[c->count] = (oracle_layer){patch, clear ? c->top[sample] : FROE_NONE};
    c->top[sample] = (uint32_t)c->count++;
}

void oracle_fill(oracle_canvas *c, uint32_t patch, bool clear) {
    int turns = 0;
    if (c->crossing_count) qsort(c->crossings, c->crossing_count, sizeof *c->crossings, by_place);
    for (size_t i = 0; i + 1 < c->crossing_count; i++) {
        const oracle_crossing *p = c->crossings + i;
        turns = (i && p[-1].row == p->row ? turns : 0) + p->turn;
        if (!turns || p[1].row != p->row) continue;
        const uint32_t end = first_at(p[1].x, c->grid.shift[0], c->view->width, c->grid.wide);
        for (uint32_t x = first_at(p->x, c->grid.shift[0], c->view->width, c->grid.wide); x < end; x++)
            put(c, (size_t)p->row * c->grid.wide + x, patch, clear);
    }
    c->crossing_count = 0;
}

void oracle_paint(oracle_canvas *c, const froe_picture *picture, const uint8_t *clear) {
    for (size_t i = 0; i < froe_picture_shape_count(picture); i++) {
        const froe_shape s = froe_picture_shape(picture, i);
        for (size_t r = s.first_ring; r < s.first_ring + s.ring_count; r++) {
            size_t n;
            const double *ring = froe_picture_ring(picture, r, &n);
            for (size_t k = 0; k < n; k++) oracle_side(c, ring + 2 * k, ring + 2 * (k + 1 < n ? k + 1 : 0));
        }
        oracle_fill(c, s.patch, clear && clear[s.patch]);
    }
}

/* -------------------------------------------------------------------- comparing -- */

void oracle_compare(const oracle_canvas *c, const oracle_hits *h, const uint8_t *clear, oracle_result *sum) {
    const size_t samples = (size_t)c->grid.wide * c->grid.high;
    for (size_t i = 0; i < samples; i++) {
        bool tie;
        const size_t seen = oracle_stack(h, i, clear, &tie);
        const oracle_hit *hit = h->hits + h->starts[i];
        uint32_t layer = c->top[i];
        size_t same = 0;
        while (same < seen && layer != FROE_NONE && c->layers[layer].patch == hit[same].patch)
            same++, layer = c->layers[layer].below;
        const bool right = same == seen && layer == FROE_NONE;
        sum->samples++;
        sum->covered += seen > 0;
        sum->layers += seen;
        sum->ties += tie;
        sum->ties_wrong += tie && !right;
        if (tie || right || sum->wrong++) continue;
        oracle_place(&c->grid, c->view, i, sum->at);
        sum->painted = layer != FROE_NONE ? c->layers[layer].patch : FROE_NONE;
        sum->met = same < seen ? hit[same].patch : FROE_NONE;
    }
}
