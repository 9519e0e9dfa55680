/* space.c: triangles in space, in random order.
 *
 *     scattered  triangles of about 0.7 of the mean distance, anywhere, in all directions
 *     city       boxes of 12 triangles on a grid of lots, heights by a power law
 *     mesh       a bumpy sphere
 *     FILE       the triangles of a model */
#include "bench.h"
#include "peers/triangle.h"
#include "race.h"
#include <stdlib.h>
#include <string.h>

#define TAU 6.283185307179586

typedef struct maker {
    peer_triangle *t;
    size_t n;
    uint64_t *state;
} maker;

static double unit(maker *m) {
    return bench_unit(m->state);
}

static void make_scattered(maker *m, size_t n) {
    const double size = 0.7 * cbrt(1.0 / (double)n);
    m->t = bench_take(n, sizeof *m->t);
    for (m->n = 0; m->n < n; m->n++) {
        const double c[3] = {unit(m), unit(m), unit(m)};
        double d[3];
        for (int i = 0; i < 3; i++) {
            race_direction(m->state, d);
            for (int k = 0; k < 3; k++) m->t[m->n].p[i][k] = c[k] + size * d[k] * 0.6;
        }
    }
}

static void add_box(maker *m, const double lo[3], const double hi[3]) {
    static const int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (int f = 0; f < 6; f++)
        for (int half = 0; half < 2; half++) {
            const int corner[3] = {faces[f][0], faces[f][1 + half], faces[f][2 + half]};
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++) m->t[m->n].p[i][k] = corner[i] >> k & 1 ? hi[k] : lo[k];
            m->n++;
        }
}

static void make_city(maker *m, size_t n) {
    const size_t side = (size_t)ceil(sqrt((double)n / 12));
    const double lot = 1.0 / (double)side;
    m->t = bench_take(12 * side * side, sizeof *m->t);
    for (size_t i = 0; i < side; i++)
        for (size_t j = 0; j < side; j++) {
            const double lo[3] = {lot * ((double)i + 0.3 * unit(m)), lot * ((double)j + 0.3 * unit(m)), 0};
            const double hi[3] = {lo[0] + lot * (0.3 + 0.4 * unit(m)), lo[1] + lot * (0.3 + 0.4 * unit(m)),
                                  lot * fmin(0.5 / sqrt(unit(m) + 1e-9), 20)};
            add_box(m, lo, hi);
        }
}

static void sphere_point(size_t i, size_t j, size_t side, double x[3]) {
    const double u = TAU * (double)(j % (2 * side)) / (double)(2 * side), v = 0.5 * TAU * (double)i / (double)side;
    double s = sin(v), d[3] = {s * cos(u), s * sin(u), cos(v)}, bump = 0;
    if (i == 0 || i == side) d[0] = d[1] = 0;
    for (int o = 1; o <= 6; o++) {
        const double f = 3 << o;
        bump += sin(f * d[0] + o) * sin(f * d[1] + 2 * o) * sin(f * d[2] + 3 * o) / (double)(2 << o);
    }
    for (int k = 0; k < 3; k++) x[k] = 0.5 + 0.4 * d[k] * (1 + 0.3 * bump);
}

static void add_triangle(maker *m, const double a[3], const double b[3], const double c[3]) {
    double(*p)[3] = m->t[m->n++].p;
    memcpy(p[0], a, sizeof *p), memcpy(p[1], b, sizeof *p), memcpy(p[2], c, sizeof *p);
}

static void make_mesh(maker *m, size_t n) {
    const size_t side = (size_t)floor(sqrt((double)n / 4));
    m->t = bench_take(4 * side * side, sizeof *m->t);
    for (size_t i = 0; i < side; i++)
        for (size_t j = 0; j < 2 * side; j++) {
            double p[4][3];
            for (size_t c = 0; c < 4; c++) sphere_point(i + c / 2, j + c % 2, side, p[c]);
            if (i) add_triangle(m, p[0], p[1], p[2]);
            if (i + 1 < side) add_triangle(m, p[1], p[3], p[2]);
        }
}

/* The triangles of a model, or so many copies of it on a square lattice that there are n. */
static void read_model(maker *m, const char *path, size_t n) {
    froe_scene *scene = bench_read(path);
    const uint32_t there = (uint32_t)froe_scene_object_count(scene);
    const size_t side = n > there ? (size_t)ceil(sqrt((double)n / there)) : 1;
    double lo[3] = {0}, hi[3] = {0};
    froe_scene_bounds(scene, lo, hi);
    const int up = froe_scene_up(scene), across = up == 0, along = up == 2 ? 1 : 2;
    if (!n) n = there;
    m->t = bench_take(n, sizeof *m->t);
    for (size_t tile = 0; tile < side * side; tile++) {
        const size_t row = tile / side;
        for (uint32_t i = 0; i < there && m->n < n; i++) {
            const froe_object o = froe_scene_object(scene, i);
            if (o.kind != FROE_POLYGON || o.corners != 3) continue;
            for (uint32_t c = 0; c < 3; c++) {
                double *p = m->t[m->n].p[c];
                memcpy(p, froe_scene_vertex(scene, froe_scene_corner(scene, i, c)), sizeof m->t->p[c]);
                p[across] += 1.1 * (hi[across] - lo[across]) * (double)(tile % side);
                p[along] += 1.1 * (hi[along] - lo[along]) * (double)row;
            }
            m->n++;
        }
    }
    froe_scene_free(scene);
}

/* In random order. */
static void shuffle(maker *m) {
    for (size_t i = m->n; i-- > 1;) {
        const size_t j = (size_t)(unit(m) * (double)(i + 1));
        const peer_triangle t = m->t[i];
        m->t[i] = m->t[j], m->t[j] = t;
    }
}

void race_make_triangles(race_scene *scene, const char *name, size_t n, uint64_t *state) {
    maker m = {.state = state};
    if (!strcmp(name, "scattered"))
        make_scattered(&m, n);
    else if (!strcmp(name, "city"))
        make_city(&m, n);
    else if (!strcmp(name, "mesh"))
        make_mesh(&m, n);
    else
        read_model(&m, name, n);
    shuffle(&m);
    scene->near = true;
    scene->coords = &m.t->p[0][0];
    scene->data.count = m.n;
    scene->data.dim = 3;
}
