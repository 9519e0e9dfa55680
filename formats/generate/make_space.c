/* make_space.c: triangles in space, in general position, and the scenes on which
 * other programs were measured: small triangles, boxes, thin triangles, spheres. */
#include "formats/generate/maker.h"
#include <math.h>

/* Corners in three random directions from a centre. */
static void put_triangle(formats_maker *m, const double *centre, double radius) {
    double corners[3][3];
    for (int i = 0; i < 3; ++i) {
        formats_direction(m, 3, corners[i]);
        for (int k = 0; k < 3; ++k) corners[i][k] = centre[k] + radius * corners[i][k];
    }
    formats_make_triangle(m, corners[0], corners[1], corners[2]);
}

void formats_make_triangles(formats_maker *m) {
    double radius = 0.5 / formats_cube_root((double)m->n);
    while (!formats_done(m)) {
        double centre[3];
        formats_place(m, 3, centre);
        put_triangle(m, centre, radius);
    }
}

void formats_make_disjoint_3d(formats_maker *m) {
    size_t side = formats_root(m->n - 1, 3) + 1;
    double step = 1 / (double)side;
    for (size_t i = 0; !formats_done(m); ++i) {
        double centre[3];
        formats_grid(i, side, 3, centre);
        for (int k = 0; k < 3; ++k) centre[k] = (centre[k] + 0.5) * step;
        put_triangle(m, centre, step * formats_between(m, 0.2, 0.45));
    }
}

void formats_make_mixed_3d(formats_maker *m) {
    double least = 0.1 / formats_cube_root((double)m->n);
    while (!formats_done(m)) {
        double centre[3];
        formats_place(m, 3, centre);
        double radius = least / (1 - formats_unit(m)); /* P(radius > R) = least / R */
        put_triangle(m, centre, radius < 0.5 ? radius : 0.5);
    }
}

void formats_make_clusters_3d(formats_maker *m) {
    enum { SIZES = 12 };
    size_t clusters = formats_root(m->n, 2) / 4 + 1;
    double radius = 0.5 / formats_cube_root((double)m->n);
    while (!formats_done(m)) {
        uint32_t c = formats_below(m, (uint32_t)clusters);
        double width = 0.25, centre[3];
        for (uint32_t i = c % SIZES; i; --i) width *= 0.5;
        for (int k = 0; k < 3; ++k) centre[k] = formats_unit_at(m, 1, c, (uint64_t)k);
        for (int i = 0; i < 9; ++i) centre[i % 3] += width * (formats_unit(m) - 0.5);
        put_triangle(m, centre, radius * width);
    }
}

void formats_make_parallel_3d(formats_maker *m) {
    while (!formats_done(m)) {
        double z = formats_unit(m), corners[3][3] = {{0, 0, z}, {1, 0, z}, {0, 1, z}};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corners[i][k] += formats_between(m, 0, 0x1p-20);
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void formats_make_hair_3d(formats_maker *m) {
    while (!formats_done(m)) {
        double root[3], tip[3], side[3];
        formats_place(m, 3, root);
        formats_direction(m, 3, side);
        for (int k = 0; k < 3; ++k) {
            side[k] = root[k] + 0x1p-10 * side[k];
            tip[k] = root[k] + (k == 2 ? formats_between(m, 0.1, 0.2) : formats_between(m, -0x1p-6, 0x1p-6));
        }
        formats_make_triangle(m, root, side, tip);
    }
}

void formats_make_slats_3d(formats_maker *m) {
    size_t pairs = m->n / 2 + 1;
    double step = 1 / (double)pairs;
    for (size_t i = 0; !formats_done(m); ++i) {
        size_t pair = i / 2;
        double at = ((double)pair + formats_between(m, 0.1, 0.9)) * step;
        int along = i % 2, across = 1 - along;
        double corners[3][3];
        for (int c = 0; c < 3; ++c) {
            corners[c][along] = c == 1 ? 1.1 : -0.1;
            corners[c][across] = at;
            corners[c][2] = c == 2 ? 0.5 : 0;
        }
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void formats_make_star_3d(formats_maker *m) {
    const double apex[3] = {0, 0, 0};
    while (!formats_done(m)) {
        double a[3], b[3];
        formats_direction(m, 3, a);
        formats_direction(m, 3, b);
        for (int k = 0; k < 3; ++k) b[k] = a[k] + 0.1 * b[k];
        formats_make_triangle(m, apex, a, b);
    }
}

/* On z = xy and a little above it (Paterson and Yao 1990): Omega(n^2) for any partition. */
void formats_make_grid_3d(formats_maker *m) {
    const double width = 0.0005, above = 0.004;
    size_t lines = (m->n + 1) / 2;
    for (size_t i = 0; !formats_done(m); ++i) {
        size_t line = i / 2;
        double t = ((double)line + 0.5) / (double)lines;
        const double on_x[3][3] = {{t, 0, 0}, {t, 1, t}, {t + width, 0.5, 0.5 * t}};
        const double on_y[3][3] = {{0, t, above}, {1, t, t + above}, {0.5, t + width, 0.5 * t + above}};
        const double(*c)[3] = i % 2 ? on_y : on_x;
        formats_make_triangle(m, c[0], c[1], c[2]);
    }
}

void formats_make_cuboids(formats_maker *m) {
    size_t boxes = (m->n + 11) / 12;
    double side = 0.5 / formats_cube_root((double)boxes);
    while (!formats_done(m)) {
        double lo[3], hi[3];
        formats_place(m, 3, lo);
        for (int k = 0; k < 3; ++k) {
            double half = 0.5 * side * formats_between(m, 0.3, 1);
            hi[k] = lo[k] + half;
            lo[k] -= half;
        }
        formats_make_cuboid(m, lo, hi);
    }
}

/* Point j of 2k on parallel i of k, with poles of one point each. */
static void on_sphere(size_t k, size_t i, size_t j, double *to) {
    double height[2], around[2];
    formats_circle(i, 2 * k, height); /* half a circle from pole to pole */
    formats_circle(j % (2 * k), 2 * k, around);
    to[0] = height[1] * around[0];
    to[1] = height[1] * around[1];
    to[2] = height[0];
}

/* 4k(k - 1) triangles, with the greatest k that gives no more than n (at least 2). */
void formats_make_sphere(formats_maker *m) {
    size_t k = formats_root(m->n / 4, 2) + 1;
    if (k < 2) k = 2;
    while (k > 2 && 4 * k * (k - 1) > m->n) --k;
    for (size_t i = 0; i < k && !m->status; ++i)
        for (size_t j = 0; j < 2 * k && !m->status; ++j) {
            double a[3], b[3], c[3], d[3];
            on_sphere(k, i, j, a);
            on_sphere(k, i + 1, j, b);
            on_sphere(k, i + 1, j + 1, c);
            on_sphere(k, i, j + 1, d);
            if (i + 1 < k) formats_make_triangle(m, a, b, c);
            if (i > 0) formats_make_triangle(m, a, c, d);
        }
}
