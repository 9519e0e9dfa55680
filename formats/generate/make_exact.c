/* make_exact.c: segments whose coordinates are exact on purpose: shared corners,
 * common lines, ends on lines, and the ends of the range of doubles. */
#include "formats/generate/maker.h"
#include <math.h>

enum { MOST_LEVELS = 900 }; /* 2^-900 is far from both ends of the exponents */

static size_t levels_for(size_t units) {
    return units < MOST_LEVELS ? units : MOST_LEVELS;
}

/* 4 sides a level; with more than 900 levels' worth every side is cut into `parts`. */
void formats_make_nested(formats_maker *m) {
    size_t levels = levels_for((m->n + 3) / 4), parts = (m->n + 4 * levels - 1) / (4 * levels);
    double r = 1;
    for (size_t level = 0; level < levels && !formats_done(m); ++level, r *= 0.5)
        for (size_t i = 0; i < 4 * parts && !formats_done(m); ++i) {
            size_t part = i / 4;
            double a = r * (2 * (double)part / (double)parts - 1);
            double b = r * (2 * (double)(part + 1) / (double)parts - 1);
            double at = i & 1 ? r : -r;
            if (i & 2) {
                formats_make_segment(m, at, a, at, b);
            } else {
                formats_make_segment(m, a, at, b, at);
            }
        }
}

/* Upright segments from the x-axis to the line y = x. */
void formats_make_wedge(formats_maker *m) {
    size_t levels = levels_for(m->n), parts = (m->n + levels - 1) / levels;
    double x = 1;
    for (size_t level = 0; level < levels && !formats_done(m); ++level, x *= 0.5)
        for (size_t i = 0; i < parts && !formats_done(m); ++i) {
            double at = x * (1 - 0.5 * (double)i / (double)parts);
            formats_make_segment(m, at, 0, at, at);
        }
}

void formats_make_lattice(formats_maker *m) {
    size_t side = formats_root(m->n / 2, 2) + 1; /* 2 side (side + 1) >= n */
    for (size_t i = 0; !formats_done(m); ++i) {
        double p[2];
        formats_grid(i / 2, side, 2, p);
        formats_make_segment(m, p[0], p[1], i % 2 ? p[0] : p[0] + 1, i % 2 ? p[1] + 1 : p[1]);
    }
}

void formats_make_tiles(formats_maker *m) {
    size_t side = formats_root(m->n / 4, 2) + 1;
    for (size_t i = 0; !formats_done(m); ++i) {
        double p[2];
        formats_grid(i, side, 2, p);
        double x = p[0], y = p[1];
        const double ring[5][2] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}, {x, y}};
        for (int k = 0; k < 4 && !formats_done(m); ++k)
            formats_make_segment(m, ring[k][0], ring[k][1], ring[k + 1][0], ring[k + 1][1]);
    }
}

/* Odd multiples of 2^-level, few levels being the most frequent, as wide as the level allows. */
void formats_make_walls(formats_maker *m) {
    while (!formats_done(m)) {
        uint32_t level = 1;
        while (level < 20 && formats_below(m, 4)) ++level;
        double unit = 1 / (double)(1u << level);
        double at = unit * (2 * (double)formats_below(m, 1u << (level - 1)) + 1);
        double from = unit * (double)formats_below(m, 1u << level), to = from + unit;
        if (formats_below(m, 2)) {
            formats_make_segment(m, at, from, at, to);
        } else {
            formats_make_segment(m, from, at, to, at);
        }
    }
}

void formats_make_identical(formats_maker *m) {
    double p[4];
    formats_place(m, 4, p);
    while (!formats_done(m)) formats_make_segment(m, p[0], p[1], p[2], p[3]);
}

void formats_make_collinear(formats_maker *m) {
    for (size_t i = 0; !formats_done(m); ++i) {
        double t = (double)i;
        formats_make_segment(m, 3 * t, t, 3 * t + 3, t + 1);
    }
}

void formats_make_diagonals(formats_maker *m) {
    uint32_t side = (uint32_t)formats_root(m->n, 2) + 2;
    while (!formats_done(m)) {
        double x = formats_below(m, side), y = formats_below(m, side), length = 1 + formats_below(m, 4);
        formats_make_segment(m, x, y, x + length, formats_below(m, 2) ? y + length : y - length);
    }
}

/* On the border of the unit square, or from it inwards. */
void formats_make_border(formats_maker *m) {
    for (size_t i = 0; !formats_done(m); ++i) {
        double at = i & 1 ? 1 : 0, a = formats_unit(m), b = formats_unit(m), inwards = i & 4 ? formats_unit(m) : at;
        if (i & 2) {
            formats_make_segment(m, at, a, inwards, b);
        } else {
            formats_make_segment(m, a, at, b, inwards);
        }
    }
}

void formats_make_huge(formats_maker *m) {
    double length = 0.5 / sqrt((double)m->n);
    while (!formats_done(m)) {
        double x = formats_between(m, -1, 1), y = formats_between(m, -1, 1), d[2];
        formats_direction(m, 2, d);
        double across = x + length * d[0], up = y + length * d[1];
        formats_make_segment(m, 1e300 * x, 1e300 * y, 1e300 * across, 1e300 * up);
    }
}

void formats_make_denormal(formats_maker *m) {
    uint32_t side = 1u << 20, reach = side / (uint32_t)(formats_root(m->n, 2) + 1) + 2;
    while (!formats_done(m)) {
        double x = formats_below(m, side), y = formats_below(m, side), dx = formats_below(m, reach),
               dy = formats_below(m, reach);
        formats_make_segment(m, x * 0x1p-1074, y * 0x1p-1074, (x + dx) * 0x1p-1074, (y + dy) * 0x1p-1074);
    }
}

void formats_make_degenerate(formats_maker *m) {
    static const double values[] = {-2, -1, -0.0, 0.0, 1, 2};
    while (!formats_done(m)) {
        double p[4];
        for (int k = 0; k < 4; ++k) p[k] = values[formats_below(m, sizeof values / sizeof *values)];
        formats_make_segment(m, p[0], p[1], p[2], p[3]);
    }
}
