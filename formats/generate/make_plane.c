/* make_plane.c: segments in the unit square, in general position. */
#include "formats/generate/maker.h"
#include <math.h>

/* A segment of the given length in a random direction. */
static void put_segment(formats_maker *m, const double *centre, double length) {
    double d[2];
    formats_direction(m, 2, d);
    double x = 0.5 * length * d[0], y = 0.5 * length * d[1];
    formats_make_segment(m, centre[0] - x, centre[1] - y, centre[0] + x, centre[1] + y);
}

void formats_make_segments(formats_maker *m) {
    double length = 0.5 / sqrt((double)m->n);
    while (!formats_done(m)) {
        double centre[2];
        formats_place(m, 2, centre);
        put_segment(m, centre, length * formats_between(m, 0.3, 1));
    }
}

void formats_make_disjoint(formats_maker *m) {
    size_t side = formats_root(m->n - 1, 2) + 1; /* side^2 >= n */
    double step = 1 / (double)side;
    for (size_t i = 0; !formats_done(m); ++i) {
        double centre[2];
        formats_grid(i, side, 2, centre);
        for (int k = 0; k < 2; ++k) centre[k] = (centre[k] + 0.5) * step;
        put_segment(m, centre, step * formats_between(m, 0.3, 0.9));
    }
}

void formats_make_mixed(formats_maker *m) {
    double least = 0.1 / sqrt((double)m->n);
    while (!formats_done(m)) {
        double centre[2];
        formats_place(m, 2, centre);
        double length = least / (1 - formats_unit(m)); /* P(length > L) = least / L */
        put_segment(m, centre, length < 1 ? length : 1);
    }
}

void formats_make_clusters(formats_maker *m) {
    enum { SIZES = 12 };
    size_t clusters = formats_root(m->n, 2) / 4 + 1;
    double length = 0.5 / sqrt((double)m->n);
    while (!formats_done(m)) {
        uint32_t c = formats_below(m, (uint32_t)clusters);
        double width = 0.25;
        for (uint32_t i = c % SIZES; i; --i) width *= 0.5;
        double centre[2] = {formats_unit_at(m, 1, c, 0), formats_unit_at(m, 1, c, 1)};
        for (int i = 0; i < 6; ++i) centre[i % 2] += width * (formats_unit(m) - 0.5);
        put_segment(m, centre, length * width * formats_between(m, 0.3, 1));
    }
}

void formats_make_parallel(formats_maker *m) {
    while (!formats_done(m)) {
        double y = formats_unit(m), slope = formats_between(m, -0x1p-20, 0x1p-20);
        double from = formats_between(m, 0, 0.1), to = formats_between(m, 0.9, 1);
        formats_make_segment(m, from, y, to, y + slope);
    }
}

void formats_make_hair(formats_maker *m) {
    while (!formats_done(m)) {
        double x = formats_unit(m), y = formats_unit(m), bent = formats_between(m, -0x1p-6, 0x1p-6),
               length = formats_between(m, 0.1, 0.2);
        formats_make_segment(m, x, y, x + bent, y + length);
    }
}

void formats_make_slats(formats_maker *m) {
    size_t pairs = m->n / 2 + 1;
    double step = 1 / (double)pairs;
    for (size_t i = 0; !formats_done(m); ++i) {
        size_t pair = i / 2;
        double at = ((double)pair + formats_between(m, 0.1, 0.9)) * step;
        if (i % 2) {
            formats_make_segment(m, at, -0.1, at, 1.1);
        } else {
            formats_make_segment(m, -0.1, at, 1.1, at);
        }
    }
}

void formats_make_star(formats_maker *m) {
    for (size_t i = 0; !formats_done(m); ++i) {
        double p[2], length = formats_between(m, 0.5, 1);
        formats_circle(i, m->n, p);
        formats_make_segment(m, 0, 0, length * p[0], length * p[1]);
    }
}

void formats_make_spiral(formats_maker *m) {
    enum { STEPS = 64 }; /* per turn */
    double before[2] = {0, 0}, p[2];
    for (size_t i = 1; !formats_done(m); ++i) {
        formats_circle(i % STEPS, STEPS, p);
        double radius = (double)i / STEPS;
        p[0] *= radius;
        p[1] *= radius;
        formats_make_segment(m, before[0], before[1], p[0], p[1]);
        before[0] = p[0];
        before[1] = p[1];
    }
}
