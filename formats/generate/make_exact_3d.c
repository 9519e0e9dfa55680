/* make_exact_3d.c: triangles whose coordinates are exact on purpose: shared corners,
 * common planes, and the ends of the range of doubles. */
#include "formats/generate/maker.h"
#include <math.h>

/* 12 triangles a level; with more than 900 levels' worth every side is cut into parts^2 squares. */
static void nested_level(formats_maker *m, double r, size_t parts) {
    for (size_t s = 0; s < 6 * parts * parts && !formats_done(m); ++s) {
        int axis = (int)(s % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double p[2], corners[4][3];
        formats_grid(s / 6, parts, 2, p);
        for (int c = 0; c < 4; ++c) {
            corners[c][axis] = s / 3 % 2 ? r : -r;
            corners[c][u] = r * (2 * (p[0] + (c == 1 || c == 2)) / (double)parts - 1);
            corners[c][v] = r * (2 * (p[1] + (c >= 2)) / (double)parts - 1);
        }
        formats_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void formats_make_nested_3d(formats_maker *m) {
    enum { MOST_LEVELS = 900 };
    size_t cubes = (m->n + 11) / 12, levels = cubes < MOST_LEVELS ? cubes : MOST_LEVELS, parts = 1;
    while (parts * parts * levels < cubes) ++parts;
    double r = 1;
    for (size_t level = 0; level < levels && !formats_done(m); ++level, r *= 0.5) nested_level(m, r, parts);
}

/* Unit squares upright on and between the points of a cubic grid. */
void formats_make_lattice_3d(formats_maker *m) {
    size_t side = formats_root(m->n / 6, 3) + 1;
    for (size_t i = 0; !formats_done(m); ++i) {
        int axis = (int)(i % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double corners[4][3];
        for (int c = 0; c < 4; ++c) {
            formats_grid(i / 3, side, 3, corners[c]);
            corners[c][u] += c == 1 || c == 2;
            corners[c][v] += c >= 2;
        }
        formats_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void formats_make_tiles_3d(formats_maker *m) {
    size_t side = formats_root(m->n / 12, 3) + 1;
    for (size_t i = 0; !formats_done(m); ++i) {
        double lo[3];
        formats_grid(i, side, 3, lo);
        double hi[3] = {lo[0] + 1, lo[1] + 1, lo[2] + 1};
        formats_make_cuboid(m, lo, hi);
    }
}

void formats_make_walls_3d(formats_maker *m) {
    while (!formats_done(m)) {
        uint32_t level = 1;
        while (level < 12 && formats_below(m, 8)) ++level;
        int axis = (int)formats_below(m, 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double unit = 1 / (double)(1u << level), corners[4][3], from[3];
        for (int k = 0; k < 3; ++k) from[k] = unit * (double)formats_below(m, 1u << level);
        from[axis] = unit * (2 * (double)formats_below(m, 1u << (level - 1)) + 1);
        for (int c = 0; c < 4; ++c) {
            corners[c][axis] = from[axis];
            corners[c][u] = from[u] + (c == 1 || c == 2 ? unit : 0);
            corners[c][v] = from[v] + (c >= 2 ? unit : 0);
        }
        formats_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
    }
}

void formats_make_identical_3d(formats_maker *m) {
    double p[9];
    formats_place(m, 9, p);
    while (!formats_done(m)) formats_make_triangle(m, p, p + 3, p + 6);
}

/* Whole multiples of (1, 0, 1) and (0, 1, 2): the plane z = x + 2y, exactly. */
void formats_make_coplanar_3d(formats_maker *m) {
    uint32_t side = (uint32_t)formats_root(m->n, 2) + 2;
    while (!formats_done(m)) {
        double corners[3][3], x = formats_below(m, side), y = formats_below(m, side);
        for (int i = 0; i < 3; ++i) {
            corners[i][0] = x + formats_below(m, 6);
            corners[i][1] = y + formats_below(m, 6);
            corners[i][2] = corners[i][0] + 2 * corners[i][1];
        }
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

/* On the sides of the unit cube, or from them inwards. */
void formats_make_border_3d(formats_maker *m) {
    for (size_t i = 0; !formats_done(m); ++i) {
        double corners[3][3];
        for (int c = 0; c < 3; ++c) {
            formats_place(m, 3, corners[c]);
            if (c < 2 || i & 4) corners[c][i % 3] = i & 1 ? 1 : 0;
        }
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void formats_make_huge_3d(formats_maker *m) {
    double radius = 0.5 / formats_cube_root((double)m->n);
    while (!formats_done(m)) {
        double centre[3], corners[3][3];
        for (int k = 0; k < 3; ++k) centre[k] = formats_between(m, -1, 1);
        for (int i = 0; i < 3; ++i) {
            formats_direction(m, 3, corners[i]);
            for (int k = 0; k < 3; ++k) corners[i][k] = 1e300 * (centre[k] + radius * corners[i][k]);
        }
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void formats_make_denormal_3d(formats_maker *m) {
    uint32_t side = 1u << 20, reach = side / (uint32_t)(formats_root(m->n, 3) + 1) + 2;
    while (!formats_done(m)) {
        double centre[3], corners[3][3];
        for (int k = 0; k < 3; ++k) centre[k] = formats_below(m, side);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corners[i][k] = (centre[k] + formats_below(m, reach)) * 0x1p-1074;
        formats_make_triangle(m, corners[0], corners[1], corners[2]);
    }
}

void formats_make_degenerate_3d(formats_maker *m) {
    static const double values[] = {-1, -0.0, 0.0, 1};
    while (!formats_done(m)) {
        double p[9];
        for (int k = 0; k < 9; ++k) p[k] = values[formats_below(m, sizeof values / sizeof *values)];
        formats_make_triangle(m, p, p + 3, p + 6);
    }
}
