/* make_exact_3d.c: triangles whose coordinates are exact on purpose: shared corners,
 * common planes, and the ends of the range of doubles. */
#include "maker.h"
#include <math.h>

/* 12 triangles a level; with more than 900 levels' worth every side is cut into parts^2 squares. */
static void nested_level(io_maker *m, double r, size_t parts) {
    for (size_t s = 0; s < 6 * parts * parts && !io_done(m); ++s) {
        int axis = (int)(s % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double p[2], corners[4][3];
        io_grid(s / 6, parts, 2, p);
        for (int c = 0; c < 4; ++c) {
            corners[c][axis] = s / 3 % 2 ? r : -r;
            corners[c][u] = r * (2 * (p[0] + (c == 1 || c == 2)) / (double)parts - 1);
            corners[c][v] = r * (2 * (p[1] + (c >= 2)) / (double)parts - 1);
        }
        io_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void io_make_nested_3d(io_maker *m) {
    enum { MOST_LEVELS = 900 };
    size_t cubes = (m->n + 11) / 12, levels = cubes < MOST_LEVELS ? cubes : MOST_LEVELS, parts = 1;
    while (parts * parts * levels < cubes) ++parts;
    double r = 1;
    for (size_t level = 0; level < levels && !io_done(m); ++level, r *= 0.5) nested_level(m, r, parts);
}

/* Unit squares upright on and between the points of a cubic grid. */
void io_make_lattice_3d(io_maker *m) {
    size_t side = io_root(m->n / 6, 3) + 1;
    for (size_t i = 0; !io_done(m); ++i) {
        int axis = (int)(i % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corners[4][3];
        for (int c = 0; c < 4; ++c) {
            io_grid(i / 3, side, 3, corners[c]);
            corners[c][u] += c == 1 || c == 2;
            corners[c][v] += c >= 2;
        }
        io_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void io_make_tiles_3d(io_maker *m) {
    size_t side = io_root(m->n / 12, 3) + 1;
    for (size_t i = 0; !io_done(m); ++i) {
        double lo[3];
        io_grid(i, side, 3, lo);
        double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
        io_make_cuboid(m, lo, hi);
    }
}

void io_make_walls_3d(io_maker *m) {
    while (!io_done(m)) {
        uint32_t level = 1;
        while (level < 12 && io_below(m, 8)) ++level;
        int axis = (int)io_below(m, 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double unit = 1 / (double)(1u << level), corners[4][3], from[3];
        for (int k = 0; k < 3; ++k) from[k] = unit * (double)io_below(m, 1u << level);
        from[axis] = unit * (2 * (double)io_below(m, 1u << (level - 1)) + 1);
        for (int c = 0; c < 4; ++c) {
            corners[c][axis] = from[axis];
            corners[c][u] = from[u] + (c == 1 || c == 2 ? unit : 0);
            corners[c][v] = from[v] + (c >= 2 ? unit : 0);
        }
        io_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void io_make_identical_3d(io_maker *m) {
    double p[9];
    io_place(m, 9, p);
    while (!io_done(m)) io_make_triangle(m, p, p + 3, p + 6);
}

/* Whole multiples of (1, 0, 1) and (0, 1, 2): the plane z = x + 2y, exactly. */
void io_make_coplanar_3d(io_maker *m) {
    uint32_t side = (uint32_t)io_root(m->n, 2) + 2;
    while (!io_done(m)) {
        double corners[3][3], x = io_below(m, side), y = io_below(m, side);
        for (int i = 0; i < 3; ++i) {
            corners[i][0] = x + io_below(m, 6);
            corners[i][1] = y + io_below(m, 6);
            corners[i][2] = corners[i][0] + 2 * corners[i][1];
        }
        io_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

/* On the sides of the unit cube, or from them inwards. */
void io_make_border_3d(io_maker *m) {
    for (size_t i = 0; !io_done(m); ++i) {
        double corners[3][3];
        for (int c = 0; c < 3; ++c) {
            io_place(m, 3, corners[c]);
            if (c < 2 || i & 4) corners[c][i % 3] = i & 1 ? 1 : 0;
        }
        io_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void io_make_huge_3d(io_maker *m) {
    double radius = 0.5 / io_cube_root((double)m->n);
    while (!io_done(m)) {
        double centre[3], corners[3][3];
        for (int k = 0; k < 3; ++k) centre[k] = io_between(m, -1, 1);
        for (int i = 0; i < 3; ++i) {
            io_direction(m, 3, corners[i]);
            for (int k = 0; k < 3; ++k) corners[i][k] = 1e300 * (centre[k] + radius * corners[i][k]);
        }
        io_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void io_make_denormal_3d(io_maker *m) {
    uint32_t side = 1u << 20, reach = side / (uint32_t)(io_root(m->n, 3) + 1) + 2;
    while (!io_done(m)) {
        double centre[3], corners[3][3];
        for (int k = 0; k < 3; ++k) centre[k] = io_below(m, side);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corners[i][k] = (centre[k] + io_below(m, reach)) * 0x1p-1074;
        io_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void io_make_degenerate_3d(io_maker *m) {
    static const double values[] = {-1, -0.0, 0.0, 1};
    while (!io_done(m)) {
        double p[9];
        for (int k = 0; k < 9; ++k) p[k] = values[io_below(m, sizeof values / sizeof *values)];
        io_make_triangle(m, p, p + 3, p + 6);
    }
}
