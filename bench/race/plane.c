/* plane.c: segments of the plane: whole coordinates from 0 to 2^30, in random order.
 *
 *     short    lengths 0.2 .. 1.2 of the mean distance, disjoint
 *     mixed    lengths by a power law up to the width of the scene, shrunk until disjoint: a few are long
 *     network  an irregular network of triangles: corners shared by six
 *     crossing equal lengths anywhere, such that about n pairs cross
 *     FILE     the segments of a scene that froe reads, scaled and rounded to whole numbers */
#include "bench.h"
#include "peers/segment.h"
#include "race.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 1073741822.0 /* 2^30 - 2 */
#define TAU 6.283185307179586

typedef struct maker {
    peer_segment *s;
    size_t count, room, n;
    uint64_t state; /* of random numbers */
    struct near {   /* a grid of those that are there already */
        uint32_t cells;
        double per_cell, lo[2];
        uint32_t *first, *next, *of, used, room;
    } near;
} maker;

/* ----------------------------------------------------------------- numbers -- */

static double uniform(maker *m, double a, double b) {
    return a + (b - a) * bench_unit(&m->state);
}

static void must(bool good, const char *what) {
    if (good) return;
    fprintf(stderr, "bench: %s\n", what);
    exit(1);
}

/* ---------------------------------------------------------------- segments -- */

static peer_segment oriented(double ax, double ay, double bx, double by) {
    if (ax > bx || (ax == bx && ay > by)) return (peer_segment){bx, by, ax, ay};
    return (peer_segment){ax, ay, bx, by};
}

static peer_segment about(double cx, double cy, double angle, double length) {
    double dx = 0.5 * length * cos(angle), dy = 0.5 * length * sin(angle);
    return oriented(floor(cx - dx), floor(cy - dy), floor(cx + dx), floor(cy + dy));
}

static bool within(const peer_segment *s) {
    return s->ax >= 0 && s->bx <= WIDTH && fmin(s->ay, s->by) >= 0 && fmax(s->ay, s->by) <= WIDTH && s->ax < s->bx;
}

static void add(maker *m, peer_segment s) {
    if (m->count == m->room) {
        m->room = m->room * 2 + 1024;
        m->s = realloc(m->s, m->room * sizeof s);
        must(m->s, "out of memory");
    }
    m->s[m->count++] = s;
}

static void shuffle(maker *m) {
    for (size_t i = m->count; i > 1; i--) {
        size_t j = bench_draw(&m->state) % i;
        peer_segment swap = m->s[i - 1];
        m->s[i - 1] = m->s[j];
        m->s[j] = swap;
    }
}

/* --------------------------------------------------------------- disjointness -- */

static void near_begin(struct near *g, size_t n) {
    g->cells = (uint32_t)fmax(8, sqrt(0.7 * (double)n));
    g->per_cell = g->cells / (WIDTH + 2);
    g->first = calloc((size_t)g->cells * g->cells, sizeof *g->first);
    must(g->first, "out of memory");
}

static void near_end(struct near *g) {
    free(g->first), free(g->next), free(g->of);
}

static uint32_t column(const struct near *g, double x) {
    double i = x * g->per_cell;
    return i < 0 ? 0 : i < g->cells ? (uint32_t)i : g->cells - 1;
}

/* Visits the cells of a segment, a little too many; false from `look` ends it. */
static bool each_cell(struct near *g, const peer_segment *s, maker *m,
                      bool (*look)(maker *, size_t, const peer_segment *)) {
    double width = 1 / g->per_cell, low = fmin(s->ay, s->by), high = fmax(s->ay, s->by);
    double slope = s->bx > s->ax ? (s->by - s->ay) / (s->bx - s->ax) : 0;
    for (uint32_t i = column(g, s->ax); i <= column(g, s->bx); i++) {
        double xa = fmax(s->ax, i * width - 1), xb = fmin(s->bx, (i + 1) * width + 1);
        double ya = s->ay + slope * (xa - s->ax), yb = s->ay + slope * (xb - s->ax);
        if (s->ax == s->bx) ya = low, yb = high;
        for (uint32_t j = column(g, fmax(fmin(ya, yb) - 1, low)); j <= column(g, fmin(fmax(ya, yb) + 1, high)); j++)
            if (!look(m, (size_t)i * g->cells + j, s)) return false;
    }
    return true;
}

static bool is_free(maker *m, size_t cell, const peer_segment *s) {
    for (uint32_t k = m->near.first[cell]; k; k = m->near.next[k])
        if (peer_meet(s, m->s + m->near.of[k])) return false;
    return true;
}

static bool enter(maker *m, size_t cell, const peer_segment *s) {
    struct near *g = &m->near;
    (void)s;
    if (g->used + 1 >= g->room) {
        g->room = 2 * g->room + 1024;
        g->next = realloc(g->next, g->room * sizeof *g->next);
        g->of = realloc(g->of, g->room * sizeof *g->of);
        must(g->next && g->of, "out of memory");
    }
    g->used++;
    g->of[g->used] = (uint32_t)m->count;
    g->next[g->used] = g->first[cell];
    g->first[cell] = g->used;
    return true;
}

static bool add_if_free(maker *m, peer_segment s) {
    if (!within(&s) || !each_cell(&m->near, &s, m, is_free)) return false;
    each_cell(&m->near, &s, m, enter);
    add(m, s);
    return true;
}

/* ------------------------------------------------------------------- kinds -- */

static void make_short(maker *m) {
    double unit = WIDTH / sqrt((double)m->n);
    near_begin(&m->near, m->n);
    while (m->count < m->n)
        add_if_free(
            m, about(uniform(m, 0, WIDTH), uniform(m, 0, WIDTH), uniform(m, 0, TAU / 2), uniform(m, 0.2, 1.2) * unit));
    near_end(&m->near);
}

static void make_mixed(maker *m) {
    double unit = WIDTH / sqrt((double)m->n);
    near_begin(&m->near, m->n);
    while (m->count < m->n) {
        double length = fmin(0.25 * unit / fmax(uniform(m, 0, 1), 1e-9), 0.9 * WIDTH);
        double x = uniform(m, 0, WIDTH), y = uniform(m, 0, WIDTH), angle = uniform(m, 0, TAU / 2);
        for (int i = 0; i < 12 && length >= 0.02 * unit; i++, length *= 0.6)
            if (add_if_free(m, about(x, y, angle, length))) break;
    }
    near_end(&m->near);
}

static void make_crossing(maker *m) {
    double length = sqrt(TAU / 2 / (double)m->n) * WIDTH; /* n^2 length^2 / (pi width^2) = n pairs */
    while (m->count < m->n) {
        peer_segment s = about(uniform(m, 0, WIDTH), uniform(m, 0, WIDTH), uniform(m, 0, TAU / 2), length);
        if (within(&s)) add(m, s);
    }
}

static void make_network(maker *m) {
    size_t side = (size_t)fmax(1, sqrt((double)m->n / 3));
    double step = WIDTH / (double)side, *x = malloc((side + 1) * (side + 1) * 2 * sizeof *x);
    must(x, "out of memory");
    for (size_t j = 0; j <= side; j++)
        for (size_t i = 0; i <= side; i++) {
            bool border = i == 0 || j == 0 || i == side || j == side;
            x[2 * (j * (side + 1) + i)] = floor((double)i * step + (border ? 0 : uniform(m, -0.2, 0.2) * step));
            x[2 * (j * (side + 1) + i) + 1] = floor((double)j * step + (border ? 0 : uniform(m, -0.2, 0.2) * step));
        }
    for (size_t j = 0; j <= side; j++)
        for (size_t i = 0; i <= side; i++)
            for (int e = 0; e < 3; e++) { /* to the right, up, and across */
                size_t k = i + (e != 1), l = j + (e != 0);
                const double *a = x + 2 * (j * (side + 1) + i), *b = x + 2 * (l * (side + 1) + k);
                if (k <= side && l <= side) add(m, oriented(a[0], a[1], b[0], b[1]));
            }
    free(x);
}

static int by_coordinates(const void *a, const void *b) {
    const double *s = a, *t = b;
    for (int k = 0; k < 4; k++)
        if (s[k] != t[k]) return s[k] < t[k] ? -1 : 1;
    return 0;
}

static void keep_each_once(maker *m) {
    size_t kept = 0;
    qsort(m->s, m->count, sizeof *m->s, by_coordinates);
    for (size_t i = 0; i < m->count; i++) {
        const peer_segment *s = m->s + i;
        if ((s->ax != s->bx || s->ay != s->by) && (!kept || by_coordinates(s, m->s + kept - 1))) m->s[kept++] = *s;
    }
    m->count = kept;
}

/* The first n segments of a file, or as many copies side by side as have n. */
static void read_file(maker *m, const char *path) {
    froe_scene *scene = bench_read(path);
    double lo[2] = {0}, hi[2] = {0};
    must(froe_scene_dim(scene) == 2 && froe_scene_bounds(scene, lo, hi), "the scene is not in the plane");
    const uint32_t there = (uint32_t)froe_scene_object_count(scene);
    if (!m->n) m->n = there;
    const size_t side = (size_t)ceil(sqrt((double)m->n / there));
    const double pitch = fmax(hi[0] - lo[0], hi[1] - lo[1]), scale = WIDTH / (1.02 * pitch * (double)side);
    for (size_t tile = 0; tile < side * side; tile++)
        for (uint32_t i = 0; i < there && m->count < m->n; i++) {
            double x[4];
            const froe_object o = froe_scene_object(scene, i);
            if (o.kind != FROE_SEGMENT || o.corners < 2) continue;
            for (uint32_t c = 0; c < 4; c++) {
                const double *p = froe_scene_vertex(scene, froe_scene_corner(scene, i, c / 2));
                const size_t step = c % 2 ? tile / side : tile % side;
                const double shift = 1.02 * pitch * (double)step;
                x[c] = floor((p[c % 2] - lo[c % 2] + shift) * scale);
            }
            add(m, oriented(x[0], x[1], x[2], x[3]));
        }
    keep_each_once(m);
    froe_scene_free(scene);
}

void race_make_segments(race_scene *scene, const char *name, size_t n, uint64_t *state) {
    static const struct {
        const char *name;
        void (*make)(maker *);
        bool disjoint;
    } kinds[] = {{"short", make_short, true},
                 {"mixed", make_mixed, true},
                 {"network", make_network, false},
                 {"crossing", make_crossing, false}};
    maker m = {.n = n, .state = *state};
    size_t k = 0;
    while (k < 4 && strcmp(kinds[k].name, name) != 0) k++;
    if (k < 4)
        kinds[k].make(&m), scene->data.disjoint = kinds[k].disjoint;
    else
        read_file(&m, name), scene->near = true;
    shuffle(&m);
    *state = m.state;
    scene->coords = &m.s->ax;
    scene->data.count = m.count < m.n ? m.count : m.n;
    scene->data.dim = 2;
}
