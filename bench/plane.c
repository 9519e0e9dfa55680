/* plane.c: scenes and queries for `bench index`.
 *
 *     short    lengths 0.2 .. 1.2 of the mean distance, disjoint
 *     mixed    lengths by a power law up to the width of the scene, shrunk until disjoint: a few long, skinny obstacles
 *     tin      an irregular network of triangles: corners shared by six
 *     cross    equal lengths anywhere, such that about n pairs cross
 *     FILE     the segments of a scene that froe reads, in whole numbers: windows and points lie near them
 *
 * All in random order. Window sizes are found by bisection over 200 centres. */
#include "plane.h"
#include "bench.h"
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 1073741822.0 /* 2^30 - 2 */
#define TAU 6.283185307179586

typedef struct maker {
    plane_scene *scene;
    size_t room, n;
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
    if (m->scene->n == m->room) {
        m->room = m->room * 2 + 1024;
        m->scene->s = realloc(m->scene->s, m->room * sizeof s);
        must(m->scene->s, "out of memory");
    }
    m->scene->s[m->scene->n++] = s;
}

static void shuffle(maker *m) {
    for (size_t i = m->scene->n; i > 1; i--) {
        size_t j = bench_draw(&m->state) % i;
        peer_segment swap = m->scene->s[i - 1];
        m->scene->s[i - 1] = m->scene->s[j];
        m->scene->s[j] = swap;
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
        if (peer_meet(s, m->scene->s + m->near.of[k])) return false;
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
    g->of[g->used] = (uint32_t)m->scene->n;
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
    while (m->scene->n < m->n)
        add_if_free(
            m, about(uniform(m, 0, WIDTH), uniform(m, 0, WIDTH), uniform(m, 0, TAU / 2), uniform(m, 0.2, 1.2) * unit));
    near_end(&m->near);
}

static void make_mixed(maker *m) {
    double unit = WIDTH / sqrt((double)m->n);
    near_begin(&m->near, m->n);
    while (m->scene->n < m->n) {
        double length = fmin(0.25 * unit / fmax(uniform(m, 0, 1), 1e-9), 0.9 * WIDTH);
        double x = uniform(m, 0, WIDTH), y = uniform(m, 0, WIDTH), angle = uniform(m, 0, TAU / 2);
        for (int i = 0; i < 12 && length >= 0.02 * unit; i++, length *= 0.6)
            if (add_if_free(m, about(x, y, angle, length))) break;
    }
    near_end(&m->near);
}

static void make_cross(maker *m) {
    double length = sqrt(TAU / 2 / (double)m->n) * WIDTH; /* n^2 length^2 / (pi width^2) = n pairs */
    while (m->scene->n < m->n) {
        peer_segment s = about(uniform(m, 0, WIDTH), uniform(m, 0, WIDTH), uniform(m, 0, TAU / 2), length);
        if (within(&s)) add(m, s);
    }
}

static void make_tin(maker *m) {
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
    const peer_segment *s = a, *t = b;
    if (s->ax != t->ax) return s->ax < t->ax ? -1 : 1;
    if (s->ay != t->ay) return s->ay < t->ay ? -1 : 1;
    if (s->bx != t->bx) return s->bx < t->bx ? -1 : 1;
    return (s->by > t->by) - (s->by < t->by);
}

static bool is_whole(double x) {
    return x == floor(x) && x >= 0 && x <= WIDTH;
}

/* Coordinates that are not whole numbers from 0 to WIDTH are brought there and rounded. */
static void make_whole(plane_scene *p, const double lo[2], double size) {
    bool whole = true;
    for (size_t i = 0; i < p->n; i++) {
        const peer_segment *s = p->s + i;
        whole = whole && is_whole(s->ax) && is_whole(s->ay) && is_whole(s->bx) && is_whole(s->by);
    }
    const double scale = WIDTH / size;
    for (size_t i = 0; i < p->n && !whole; i++) {
        const peer_segment *s = p->s + i;
        p->s[i] = oriented(floor((s->ax - lo[0]) * scale), floor((s->ay - lo[1]) * scale),
                           floor((s->bx - lo[0]) * scale), floor((s->by - lo[1]) * scale));
    }
}

static void keep_each_once(plane_scene *p) {
    size_t kept = 0;
    qsort(p->s, p->n, sizeof *p->s, by_coordinates);
    for (size_t i = 0; i < p->n; i++) {
        const peer_segment *s = p->s + i;
        if ((s->ax != s->bx || s->ay != s->by) && (!kept || by_coordinates(s, p->s + kept - 1))) p->s[kept++] = *s;
    }
    p->n = kept;
}

/* The first n segments of a scene that froe reads. */
static void read_file(maker *m, const char *path) {
    froe_scene *scene = bench_read(path);
    double lo[2] = {0}, hi[2] = {0};
    must(froe_scene_dim(scene) == 2, "the scene is not in the plane");
    for (uint32_t i = 0; i < froe_scene_object_count(scene) && m->scene->n < m->n; i++) {
        if (froe_scene_object(scene, i).kind != FROE_SEGMENT) continue;
        const double *a = froe_scene_vertex(scene, froe_scene_corner(scene, i, 0));
        const double *b = froe_scene_vertex(scene, froe_scene_corner(scene, i, 1));
        add(m, oriented(a[0], a[1], b[0], b[1]));
    }
    froe_scene_bounds(scene, lo, hi);
    make_whole(m->scene, lo, fmax(hi[0] - lo[0], hi[1] - lo[1]));
    keep_each_once(m->scene);
    froe_scene_free(scene);
}

/* ------------------------------------------------------------------ queries -- */

static void find_bounds(plane_scene *p) {
    for (int k = 0; k < 2; k++) p->lo[k] = DBL_MAX, p->hi[k] = -DBL_MAX;
    for (size_t i = 0; i < p->n; i++) {
        p->lo[0] = fmin(p->lo[0], p->s[i].ax), p->hi[0] = fmax(p->hi[0], p->s[i].bx);
        p->lo[1] = fmin(p->lo[1], fmin(p->s[i].ay, p->s[i].by));
        p->hi[1] = fmax(p->hi[1], fmax(p->s[i].ay, p->s[i].by));
    }
}

/* Anywhere, or near a segment. */
static void centre(maker *m, bool near, double c[2]) {
    const plane_scene *p = m->scene;
    double jitter = fmax(p->hi[0] - p->lo[0], p->hi[1] - p->lo[1]) / 400;
    const peer_segment *s = p->s + bench_draw(&m->state) % p->n;
    c[0] = near ? s->ax + uniform(m, -jitter, jitter) : uniform(m, p->lo[0], p->hi[0]);
    c[1] = near ? s->ay + uniform(m, -jitter, jitter) : uniform(m, p->lo[1], p->hi[1]);
}

static void window_at(const double c[2], double side, double w[4]) {
    for (int k = 0; k < 2; k++) w[k] = floor(c[k] - side / 2), w[2 + k] = floor(c[k] + side / 2);
}

static double mean_results(void *index, const double *centres, size_t count, double side, uint32_t *out) {
    double sum = 0, w[4];
    for (size_t i = 0; i < count; i++)
        window_at(centres + 2 * i, side, w), sum += (double)peer_grid.window(index, w, w + 2, out);
    return sum / (double)count;
}

static double side_for(maker *m, void *index, bool near, double target, uint32_t *out) {
    enum { CENTRES = 200, STEPS = 24 };
    double c[2 * CENTRES], a = 0, b = fmax(m->scene->hi[0] - m->scene->lo[0], m->scene->hi[1] - m->scene->lo[1]);
    for (int i = 0; i < CENTRES; i++) centre(m, near, c + 2 * i);
    for (int i = 0; i < STEPS; i++)
        if (mean_results(index, c, CENTRES, 0.5 * (a + b), out) > target)
            b = 0.5 * (a + b);
        else
            a = 0.5 * (a + b);
    return 0.5 * (a + b);
}

static void make_queries(maker *m, bool near) {
    static const double targets[2] = {10, 1000};
    static const size_t counts[2] = {200000, 4000};
    plane_scene *p = m->scene;
    void *index = peer_grid.build(p->s, p->n);
    uint32_t *out = malloc((p->n + 1) * sizeof *out);
    must(out, "out of memory");
    for (int k = 0; k < 2; k++) {
        double side = side_for(m, index, near, fmin(targets[k], 0.1 * (double)p->n), out), c[2];
        p->window_count[k] = counts[k];
        p->windows[k] = malloc(counts[k] * 4 * sizeof(double));
        must(p->windows[k], "out of memory");
        for (size_t i = 0; i < counts[k]; i++) centre(m, near, c), window_at(c, side, p->windows[k] + 4 * i);
    }
    free(out);
    peer_grid.free(index);
    p->point_count = 200000;
    p->points = malloc(p->point_count * 2 * sizeof(double));
    must(p->points, "out of memory");
    for (size_t i = 0; i < p->point_count; i++) {
        double c[2];
        centre(m, near, c);
        for (int k = 0; k < 2; k++)
            c[k] = fmin(fmax(c[k], p->lo[k]), p->hi[k] - 1), p->points[2 * i + (size_t)k] = floor(c[k]) + 0.5;
    }
}

plane_scene plane_make(const char *kind, size_t n, uint64_t seed) {
    static const struct {
        const char *name;
        void (*make)(maker *);
        bool disjoint;
    } kinds[] = {{"short", make_short, true},
                 {"mixed", make_mixed, true},
                 {"tin", make_tin, true},
                 {"cross", make_cross, false}};
    plane_scene p = {.n = 0};
    maker m = {.scene = &p, .n = n, .state = bench_state(seed << 40)};
    size_t k = 0;
    bench_name(kind, p.name);
    while (k < 4 && strcmp(kinds[k].name, kind) != 0) k++;
    if (k < 4)
        kinds[k].make(&m), p.disjoint = kinds[k].disjoint;
    else
        read_file(&m, kind);
    shuffle(&m);
    if (p.n > n) p.n = n;
    must(p.n, "no segments");
    find_bounds(&p);
    make_queries(&m, k == 4);
    return p;
}

void plane_free(plane_scene *p) {
    free(p->s), free(p->windows[0]), free(p->windows[1]), free(p->points);
}
