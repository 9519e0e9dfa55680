/* maker.c: random numbers, directions and the usual shapes. */
#include "formats/generate/maker.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

bool formats_done(const formats_maker *m) {
    return m->status != FROE_OK || m->sink.total >= m->n;
}

/* ------------------------------------------------------------ randomness -- */

static uint64_t mix(uint64_t x) { /* the finaliser of splitmix64 (Steele, Lea, Flood 2014) */
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static uint64_t next(formats_maker *m) {
    return mix(mix(m->seed + 0x9e3779b97f4a7c15u) + ++m->counter * 0x9e3779b97f4a7c15u);
}

static double unit_of(uint64_t hash) {
    return (double)(hash >> 11) * 0x1p-53;
}

double formats_unit(formats_maker *m) {
    return unit_of(next(m));
}

void formats_place(formats_maker *m, int dim, double *to) {
    for (int k = 0; k < dim; ++k) to[k] = formats_unit(m);
}

double formats_between(formats_maker *m, double lo, double hi) {
    return lo + (hi - lo) * formats_unit(m);
}

uint32_t formats_below(formats_maker *m, uint32_t n) {
    return (uint32_t)(((next(m) >> 32) * n) >> 32);
}

double formats_unit_at(const formats_maker *m, uint64_t layer, uint64_t i, uint64_t j) {
    return unit_of(mix(mix(mix(mix(m->seed + 0x9e3779b97f4a7c15u) ^ layer) ^ (i + 0x632be59bd9b4e019u)) ^ j));
}

/* By rejection: a random point of the ball, not too near the centre, brought to the sphere. */
void formats_direction(formats_maker *m, int dim, double *to) {
    double square;
    do {
        square = 0;
        for (int k = 0; k < dim; ++k) {
            to[k] = formats_between(m, -1, 1);
            square += to[k] * to[k];
        }
    } while (square > 1 || square < 0x1p-20);
    double length = sqrt(square);
    for (int k = 0; k < dim; ++k) to[k] /= length;
}

void formats_circle(size_t i, size_t g, double *to) {
    size_t quarter = 4 * i / g;
    double t = (double)(4 * i - quarter * g) / (double)g;
    double x = (1 - t * t) / (1 + t * t), y = 2 * t / (1 + t * t);
    const double turned[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
    memcpy(to, turned[quarter % 4], 2 * sizeof *to);
}

void formats_grid(size_t i, size_t side, int dim, double *to) {
    for (int k = 0; k < dim; ++k, i /= side) to[k] = (double)(k + 1 < dim ? i % side : i);
}

/* ---------------------------------------------------------------- numbers -- */

size_t formats_root(size_t n, int d) {
    size_t root = d == 2 ? (size_t)sqrt((double)n) : (size_t)formats_cube_root((double)n);
    while (root && (d == 2 ? root * root : root * root * root) > n) --root;
    while ((d == 2 ? (root + 1) * (root + 1) : (root + 1) * (root + 1) * (root + 1)) <= n) ++root;
    return root;
}

double formats_cube_root(double x) {
    double root = x > 1 ? x : 1, before;
    do {
        before = root;
        root = (2 * root + x / (root * root)) / 3;
    } while (root < before);
    return before;
}

/* ----------------------------------------------------------------- shapes -- */

void formats_make_segment(formats_maker *m, double ax, double ay, double bx, double by) {
    double a[2] = {ax, ay}, b[2] = {bx, by};
    if (!m->status) m->status = formats_sink_segment(&m->sink, a, b);
}

void formats_make_triangle(formats_maker *m, const double *a, const double *b, const double *c) {
    if (!m->status) m->status = formats_sink_triangle(&m->sink, a, b, c);
}

void formats_make_quad(formats_maker *m, const double *a, const double *b, const double *c, const double *d) {
    formats_sink_new_face(&m->sink);
    formats_make_triangle(m, a, b, c);
    formats_make_triangle(m, a, c, d);
    m->sink.face = FROE_NONE;
}

void formats_make_cuboid(formats_maker *m, const double *lo, const double *hi) {
    static const unsigned char sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    double corners[8][3];
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 3; ++k) corners[i][k] = i >> k & 1 ? hi[k] : lo[k];
    for (int s = 0; s < 6; ++s)
        formats_make_quad(m, corners[sides[s][0]], corners[sides[s][1]], corners[sides[s][2]], corners[sides[s][3]]);
}

void formats_make_group(formats_maker *m, const char *word, size_t number, const char *material) {
    char name[48];
    snprintf(name, sizeof name, "%s %zu", word, number);
    froe_group group = {.name = name, .material = material};
    if (!m->status) m->status = formats_sink_group(&m->sink, &group);
}
