/* scatter.c: disjoint short segments at random, for benches and claims.
 *
 * Centres anywhere, in random order, lengths from 0.2 to 1.2 times the mean distance of neighbours; one that meets an
 * earlier segment is thrown again. Coordinates are whole and below 2^26, so the test below is exact. */
#include "bench.h"
#include <math.h>
#include <stdlib.h>

typedef struct grid { /* by centres; cells are as wide as the longest segment */
    size_t side;
    double step;
    uint32_t *first, *next; /* one-based; 0 ends a list */
} grid;

static uint64_t counter_hash(uint64_t x) { /* splitmix64 (Steele, Lea, Flood 2014) */
    x *= 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static double unit(uint64_t *counter) {
    return (double)(counter_hash(++*counter) >> 11) * 0x1p-53;
}

static int side_of(const double *s, const double *p) {
    const double d = (s[2] - s[0]) * (p[1] - s[1]) - (s[3] - s[1]) * (p[0] - s[0]);
    return (d > 0) - (d < 0);
}

/** Does the line of one leave the other strictly on one side? */
static bool apart(const double *s, const double *t) {
    return side_of(s, t) * side_of(s, t + 2) > 0 || side_of(t, s) * side_of(t, s + 2) > 0;
}

static size_t cell_at(const grid *g, double x) {
    const double i = x / g->step;
    return i < 0 ? 0 : i < (double)g->side ? (size_t)i : g->side - 1;
}

static bool clash(const grid *g, const double *all, const double *s) {
    const double x = 0.5 * (s[0] + s[2]), y = 0.5 * (s[1] + s[3]);
    const size_t i1 = cell_at(g, x + g->step), j1 = cell_at(g, y + g->step);
    for (size_t j = cell_at(g, y - g->step); j <= j1; j++)
        for (size_t i = cell_at(g, x - g->step); i <= i1; i++)
            for (uint32_t k = g->first[j * g->side + i]; k; k = g->next[k - 1])
                if (!apart(all + 4 * (size_t)(k - 1), s)) return true;
    return false;
}

static void throw_one(double width, double length, uint64_t *counter, double *s) {
    double x, y, square;
    const double cx = width * unit(counter), cy = width * unit(counter);
    do { /* a direction from a point of the disc */
        x = 2 * unit(counter) - 1, y = 2 * unit(counter) - 1, square = x * x + y * y;
    } while (square > 1 || square < 0.01);
    const double scale = 0.5 * length * (0.2 + unit(counter)) / sqrt(square);
    s[0] = floor(cx - scale * x), s[1] = floor(cy - scale * y);
    s[2] = floor(cx + scale * x), s[3] = floor(cy + scale * y);
}

double *bench_scatter(size_t n, unsigned long long seed) {
    const double width = 0x1p26, spacing = width / sqrt((double)n);
    grid g = {.side = (size_t)(width / (1.2 * spacing + 2))};
    if (g.side == 0) g.side = 1;
    g.step = width / (double)g.side;
    g.first = calloc(g.side * g.side, sizeof *g.first);
    g.next = malloc(n * sizeof *g.next);
    double *all = malloc(4 * n * sizeof *all);
    uint64_t counter = (uint64_t)seed << 40;
    for (size_t i = 0; all && g.first && g.next && i < n;) {
        double *s = all + 4 * i;
        throw_one(width, spacing, &counter, s);
        if (clash(&g, all, s)) continue;
        uint32_t *list = &g.first[cell_at(&g, 0.5 * (s[1] + s[3])) * g.side + cell_at(&g, 0.5 * (s[0] + s[2]))];
        g.next[i] = *list;
        *list = (uint32_t)++i;
    }
    free(g.first), free(g.next);
    return all;
}
