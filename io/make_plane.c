/* make_plane.c: segments in the unit square, in general position. */
#include "maker.h"
#include <math.h>

/* A segment of the given length in a random direction. */
static void put_segment(io_maker *m, const double *centre, double length) {
    double d[2];
    io_direction(m, 2, d);
    double x = 0.5 * length * d[0], y = 0.5 * length * d[1];
    io_make_segment(m, centre[0] - x, centre[1] - y, centre[0] + x, centre[1] + y);
}

void io_make_segments(io_maker *m) {
    double length = 0.5 / sqrt((double)m->n);
    while (!io_done(m)) {
        double centre[2];
        io_place(m, 2, centre);
        put_segment(m, centre, length * io_between(m, 0.3, 1));
    }
}

void io_make_disjoint(io_maker *m) {
    size_t side = io_root(m->n - 1, 2) + 1; /* side^2 >= n */
    double step = 1 / (double)side;
    for (size_t i = 0; !io_done(m); ++i) {
        double centre[2];
        io_grid(i, side, 2, centre);
        for (int k = 0; k < 2; ++k) centre[k] = (centre[k] + 0.5) * step;
        put_segment(m, centre, step * io_between(m, 0.3, 0.9));
    }
}

void io_make_mixed(io_maker *m) {
    double least = 0.1 / sqrt((double)m->n);
    while (!io_done(m)) {
        double centre[2];
        io_place(m, 2, centre);
        double length = least / (1 - io_unit(m)); /* P(length > L) = least / L */
        put_segment(m, centre, length < 1 ? length : 1);
    }
}

void io_make_clusters(io_maker *m) {
    enum { SIZES = 12 };
    size_t clusters = io_root(m->n, 2) / 4 + 1;
    double length = 0.5 / sqrt((double)m->n);
    while (!io_done(m)) {
        uint32_t c = io_below(m, (uint32_t)clusters);
        double width = 0.25;
        for (uint32_t i = c % SIZES; i; --i) width *= 0.5;
        double centre[2] = {io_unit_at(m, 1, c, 0), io_unit_at(m, 1, c, 1)};
        for (int i = 0; i < 6; ++i) centre[i % 2] += width * (io_unit(m) - 0.5);
        put_segment(m, centre, length * width * io_between(m, 0.3, 1));
    }
}

void io_make_parallel(io_maker *m) {
    while (!io_done(m)) {
        double y = io_unit(m), slope = io_between(m, -0x1p-20, 0x1p-20);
        double from = io_between(m, 0, 0.1), to = io_between(m, 0.9, 1);
        io_make_segment(m, from, y, to, y + slope);
    }
}

void io_make_hair(io_maker *m) {
    while (!io_done(m)) {
        double x = io_unit(m), y = io_unit(m), bent = io_between(m, -0x1p-6, 0x1p-6), length = io_between(m, 0.1, 0.2);
        io_make_segment(m, x, y, x + bent, y + length);
    }
}

void io_make_slats(io_maker *m) {
    size_t pairs = m->n / 2 + 1;
    double step = 1 / (double)pairs;
    for (size_t i = 0; !io_done(m); ++i) {
        size_t pair = i / 2;
        double at = ((double)pair + io_between(m, 0.1, 0.9)) * step;
        if (i % 2) {
            io_make_segment(m, at, -0.1, at, 1.1);
        } else {
            io_make_segment(m, -0.1, at, 1.1, at);
        }
    }
}

void io_make_star(io_maker *m) {
    for (size_t i = 0; !io_done(m); ++i) {
        double p[2], length = io_between(m, 0.5, 1);
        io_circle(i, m->n, p);
        io_make_segment(m, 0, 0, length * p[0], length * p[1]);
    }
}

void io_make_spiral(io_maker *m) {
    enum { STEPS = 64 }; /* per turn */
    double before[2] = {0, 0}, p[2];
    for (size_t i = 1; !io_done(m); ++i) {
        io_circle(i % STEPS, STEPS, p);
        double radius = (double)i / STEPS;
        p[0] *= radius;
        p[1] *= radius;
        io_make_segment(m, before[0], before[1], p[0], p[1]);
        before[0] = p[0];
        before[1] = p[1];
    }
}
