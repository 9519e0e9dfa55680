/* make_exact.c: segments whose coordinates are exact on purpose: shared corners,
 * common lines, ends on lines, and the ends of the range of doubles. */
#include "maker.h"
#include <math.h>

enum { MOST_LEVELS = 900 }; /* 2^-900 is far from both ends of the exponents */

static size_t levels_for(size_t units) {
    return units < MOST_LEVELS ? units : MOST_LEVELS;
}

/* 4 sides a level; with more than 900 levels' worth every side is cut into `parts`. */
void io_make_nested(io_maker *m) {
    size_t levels = levels_for((m->n + 3) / 4), parts = (m->n + 4 * levels - 1) / (4 * levels);
    double r = 1;
    for (size_t level = 0; level < levels && !io_done(m); ++level, r *= 0.5)
        for (size_t i = 0; i < 4 * parts && !io_done(m); ++i) {
            size_t part = i / 4;
            double a = r * (2 * (double)part / (double)parts - 1);
            double b = r * (2 * (double)(part + 1) / (double)parts - 1);
            double at = i & 1 ? r : -r;
            if (i & 2) {
                io_make_segment(m, at, a, at, b);
            } else {
                io_make_segment(m, a, at, b, at);
            }
        }
}

/* Upright segments from the x-axis to the line y = x. */
void io_make_wedge(io_maker *m) {
    size_t levels = levels_for(m->n), parts = (m->n + levels - 1) / levels;
    double x = 1;
    for (size_t level = 0; level < levels && !io_done(m); ++level, x *= 0.5)
        for (size_t i = 0; i < parts && !io_done(m); ++i) {
            double at = x * (1 - 0.5 * (double)i / (double)parts);
            io_make_segment(m, at, 0, at, at);
        }
}

void io_make_lattice(io_maker *m) {
    size_t side = io_root(m->n / 2, 2) + 1; /* 2 side (side + 1) >= n */
    for (size_t i = 0; !io_done(m); ++i) {
        double p[2];
        io_grid(i / 2, side, 2, p);
        io_make_segment(m, p[0], p[1], i % 2 ? p[0] : p[0] + 1, i % 2 ? p[1] + 1 : p[1]);
    }
}

void io_make_tiles(io_maker *m) {
    size_t side = io_root(m->n / 4, 2) + 1;
    for (size_t i = 0; !io_done(m); ++i) {
        double p[2];
        io_grid(i, side, 2, p);
        double x = p[0], y = p[1];
        const double ring[5][2] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}, {x, y}};
        for (int k = 0; k < 4 && !io_done(m); ++k)
            io_make_segment(m, ring[k][0], ring[k][1], ring[k + 1][0], ring[k + 1][1]);
    }
}

/* Odd multiples of 2^-level, few levels being the most frequent, as wide as the level allows. */
void io_make_walls(io_maker *m) {
    while (!io_done(m)) {
        uint32_t level = 1;
        while (level < 20 && io_below(m, 4)) ++level;
        double unit = 1 / (double)(1u << level);
        double at = unit * (2 * (double)io_below(m, 1u << (level - 1)) + 1);
        double from = unit * (double)io_below(m, 1u << level), to = from + unit;
        if (io_below(m, 2)) {
            io_make_segment(m, at, from, at, to);
        } else {
            io_make_segment(m, from, at, to, at);
        }
    }
}

void io_make_identical(io_maker *m) {
    double p[4];
    io_place(m, 4, p);
    while (!io_done(m)) io_make_segment(m, p[0], p[1], p[2], p[3]);
}

void io_make_collinear(io_maker *m) {
    for (size_t i = 0; !io_done(m); ++i) {
        double t = (double)i;
        io_make_segment(m, 3 * t, t, 3 * t + 3, t + 1);
    }
}

void io_make_diagonals(io_maker *m) {
    uint32_t side = (uint32_t)io_root(m->n, 2) + 2;
    while (!io_done(m)) {
        double x = io_below(m, side), y = io_below(m, side), length = 1 + io_below(m, 4);
        io_make_segment(m, x, y, x + length, io_below(m, 2) ? y + length : y - length);
    }
}

/* On the border of the unit square, or from it inwards. */
void io_make_border(io_maker *m) {
    for (size_t i = 0; !io_done(m); ++i) {
        double at = i & 1 ? 1 : 0, a = io_unit(m), b = io_unit(m), inwards = i & 4 ? io_unit(m) : at;
        if (i & 2) {
            io_make_segment(m, at, a, inwards, b);
        } else {
            io_make_segment(m, a, at, b, inwards);
        }
    }
}

void io_make_huge(io_maker *m) {
    double length = 0.5 / sqrt((double)m->n);
    while (!io_done(m)) {
        double x = io_between(m, -1, 1), y = io_between(m, -1, 1), d[2];
        io_direction(m, 2, d);
        double across = x + length * d[0], up = y + length * d[1];
        io_make_segment(m, 1e300 * x, 1e300 * y, 1e300 * across, 1e300 * up);
    }
}

void io_make_denormal(io_maker *m) {
    uint32_t side = 1u << 20, reach = side / (uint32_t)(io_root(m->n, 2) + 1) + 2;
    while (!io_done(m)) {
        double x = io_below(m, side), y = io_below(m, side), dx = io_below(m, reach), dy = io_below(m, reach);
        io_make_segment(m, x * 0x1p-1074, y * 0x1p-1074, (x + dx) * 0x1p-1074, (y + dy) * 0x1p-1074);
    }
}

/* -2 .. 2 with both zeros. */
static double tiny(io_maker *m) {
    static const double values[] = {-2, -1, -0.0, 0.0, 1, 2};
    return values[io_below(m, sizeof values / sizeof *values)];
}

void io_make_degenerate(io_maker *m) {
    while (!io_done(m)) {
        double p[4];
        for (int k = 0; k < 4; ++k) p[k] = tiny(m);
        io_make_segment(m, p[0], p[1], p[2], p[3]);
    }
}
