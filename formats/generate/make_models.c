/* make_models.c: a house, a city, hills, and the walls of a partition. */
#include "formats/generate/maker.h"
#include <string.h>

/* Upright wall from a to b, between two heights. */
static void upright(formats_maker *m, const double *a, const double *b, double low, double high) {
    double corners[4][3] = {{a[0], a[1], low}, {b[0], b[1], low}, {b[0], b[1], high}, {a[0], a[1], high}};
    formats_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
}

/* 16 long, 12 high, with a door of 4 x 8 or without. */
static void wall(formats_maker *m, const double *from, int axis, bool door) {
    double to[2] = {from[0], from[1]}, hinge[2] = {from[0], from[1]}, latch[2] = {from[0], from[1]}, z = from[2];
    to[axis] += 16;
    if (!door) return upright(m, from, to, z, z + 12);
    hinge[axis] += 2 + formats_below(m, 9);
    latch[axis] = hinge[axis] + 4;
    upright(m, from, hinge, z, z + 12);
    upright(m, latch, to, z, z + 12);
    upright(m, hinge, latch, z + 8, z + 12);
}

/* One group a storey; about 8 triangles a room. */
void formats_make_rooms_3d(formats_maker *m) {
    size_t side = formats_root(m->n / 8, 3) + 1;
    for (size_t i = 0; !formats_done(m); ++i) {
        size_t storey = i / side / side;
        if (i % (side * side) == 0) formats_make_group(m, "storey", storey, "wall");
        double from[3];
        formats_grid(i, side, 3, from);
        for (int k = 0; k < 3; ++k) from[k] *= k < 2 ? 16 : 12;
        uint32_t dice = formats_below(m, 8);
        const double x = from[0], y = from[1], z = from[2];
        const double tile[4][3] = {{x, y, z}, {x + 16, y, z}, {x + 16, y + 16, z}, {x, y + 16, z}};
        formats_make_quad(m, tile[0], tile[1], tile[2], tile[3]);
        if (dice < 6) wall(m, from, 0, dice < 3);
        if (dice & 1) wall(m, from, 1, dice & 2);
    }
}

/* A building of one or two boxes, stepping back, on a lot of 16 x 16. */
static void building(formats_maker *m, double x, double y, double base) {
    double lo[3] = {0, 0, 0}, hi[3];
    lo[0] = x + formats_between(m, 0, 3);
    lo[1] = y + formats_between(m, 0, 3);
    hi[0] = x + formats_between(m, 10, 15);
    hi[1] = y + formats_between(m, 10, 15);
    hi[2] = base * formats_between(m, 1, 4);
    formats_make_cuboid(m, lo, hi);
    if (formats_below(m, 3) || formats_done(m)) return;
    double above[3] = {lo[0] + 2, lo[1] + 2, hi[2]}, top[3] = {hi[0] - 2, hi[1] - 2, hi[2] + base};
    formats_make_cuboid(m, above, top);
}

/* Blocks of 4 x 4 lots between streets; higher towards the middle. */
void formats_make_city(formats_maker *m) {
    enum { LOTS = 4, STREET = 8, LOT = 16 };
    size_t side = formats_root(m->n / 16, 2) + 1;
    for (size_t i = 0; !formats_done(m); ++i) {
        size_t column = i % side, row = i / side;
        size_t across = column * LOT + column / LOTS * STREET, along = row * LOT + row / LOTS * STREET;
        double dx = 2 * (double)column / (double)side - 1, dy = 2 * (double)row / (double)side - 1;
        formats_make_group(m, "building", i + 1, "concrete");
        building(m, (double)across, (double)along, 10 + 40 * (1 - dx * dx) * (1 - dy * dy));
    }
}

/* Grid points moved by less than 0.3 steps, so that no triangle turns over: 0.7 * 0.7 > 0.3 * 1.3. */
static void ground(const formats_maker *m, size_t i, size_t j, double *to) {
    to[0] = (double)i + 0.3 * formats_unit_at(m, 1, i, j);
    to[1] = (double)j + 0.3 * formats_unit_at(m, 2, i, j);
    to[2] = 0; /* noise on lattices of 64, 16 and 4, interpolated bilinearly (value noise) */
    for (uint64_t width = 64; width >= 4; width /= 4) {
        double u = to[0] / (double)width, v = to[1] / (double)width;
        uint64_t column = (uint64_t)u, row = (uint64_t)v;
        double fu = u - (double)column, fv = v - (double)row;
        double low =
            formats_unit_at(m, width, column, row) * (1 - fu) + formats_unit_at(m, width, column + 1, row) * fu;
        double high =
            formats_unit_at(m, width, column, row + 1) * (1 - fu) + formats_unit_at(m, width, column + 1, row + 1) * fu;
        to[2] += 0.5 * (double)width * (low * (1 - fv) + high * fv);
    }
}

/* Two triangles a square, lower right and upper left of its diagonal, both facing up. */
void formats_make_terrain(formats_maker *m) {
    size_t side = formats_root(m->n / 2, 2) + 1;
    for (size_t at = 0; !formats_done(m); ++at) {
        size_t i = at / 2 % side, j = at / 2 / side;
        double near[3], far[3], third[3];
        ground(m, i, j, near);
        ground(m, i + 1, j + 1, far);
        ground(m, i + !(at % 2), j + at % 2, third);
        if (at % 2) {
            formats_make_triangle(m, near, far, third);
        } else {
            formats_make_triangle(m, near, third, far);
        }
    }
}

/* Cell i has the children 2i + 1 and 2i + 2; the wall that splits a cell is two triangles. */
void formats_make_cells_3d(formats_maker *m) {
    typedef struct cell {
        double lo[3], hi[3];
    } cell;
    ARRAY(cell) all = {0};
    cell at = {{0, 0, 0}, {1, 1, 1}};
    bool room = array_push(&m->sink.alloc, &all, at);
    for (size_t i = 0; room && !formats_done(m); ++i) {
        at = all.data[i];
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (at.hi[k] - at.lo[k] > at.hi[axis] - at.lo[axis]) axis = k;
        double cut = at.lo[axis] + (at.hi[axis] - at.lo[axis]) * formats_between(m, 0.3, 0.7), corners[4][3];
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int c = 0; c < 4; ++c) {
            corners[c][axis] = cut;
            corners[c][u] = c == 1 || c == 2 ? at.hi[u] : at.lo[u];
            corners[c][v] = c >= 2 ? at.hi[v] : at.lo[v];
        }
        formats_make_quad(m, corners[0], corners[1], corners[2], corners[3]);
        cell below = at, above = at;
        below.hi[axis] = above.lo[axis] = cut;
        room = array_push(&m->sink.alloc, &all, below) && array_push(&m->sink.alloc, &all, above);
    }
    if (!room) m->status = support_fail_memory(m->sink.diag);
    array_free(&m->sink.alloc, &all);
}
