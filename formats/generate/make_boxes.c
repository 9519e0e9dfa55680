/* make_boxes.c: boxes as they come in plans, cities and circuits, and the worst ones. Disjoint, but for debris. */
#include "formats/generate/maker.h"
#include <string.h>

static void add_made_box(formats_maker *m, const double *lo, const double *hi) {
    if (!formats_done(m)) m->status = formats_sink_box(&m->sink, lo, hi);
}

/* Cells of a circuit: rows of one height, cells of several widths side by side, now and then a gap. */
void formats_make_rows(formats_maker *m) {
    double width = 4 * (double)(formats_root(m->n, 2) + 1);
    for (size_t row = 0; !formats_done(m); row++) {
        double x = formats_below(m, 4), y = (double)(row * 10);
        while (x < width && !formats_done(m)) {
            const double lo[2] = {x, y}, hi[2] = {x + 1 + formats_below(m, 8), y + 8};
            add_made_box(m, lo, hi);
            x = hi[0] + (formats_below(m, 4) ? 0 : 1 + formats_below(m, 3));
        }
    }
}

/* Are all unit cells of a box free? Then they are taken. */
static bool take_cells(uint8_t *taken, size_t side, const size_t *from, const size_t *extent) {
    for (int pass = 0; pass < 2; pass++)
        for (size_t z = from[2]; z < from[2] + extent[2]; z++)
            for (size_t y = from[1]; y < from[1] + extent[1]; y++) {
                uint8_t *row = taken + (z * side + y) * side;
                for (size_t x = from[0]; x < from[0] + extent[0]; x++) {
                    if (!pass && row[x]) return false;
                    row[x] = (uint8_t)pass | row[x];
                }
            }
    return true;
}

/* Boxes of `wide` x `wide` x `other` cells, the odd axis at random, anywhere they find room among the others. */
static void pack(formats_maker *m, size_t wide, size_t other) {
    size_t volume = wide * wide * other, side = formats_root(4 * volume * m->n, 3) + wide + other;
    uint8_t *taken = support_calloc(&m->sink.alloc, side * side * side, 1);
    if (!taken) m->status = support_fail_memory(m->sink.diag);
    while (!formats_done(m)) {
        int odd = (int)formats_below(m, 3);
        size_t from[3], extent[3];
        for (int k = 0; k < 3; k++) {
            extent[k] = k == odd ? other : wide;
            from[k] = formats_below(m, (uint32_t)(side - extent[k] + 1));
        }
        if (!take_cells(taken, side, from, extent)) continue;
        double lo[3], hi[3]; /* not quite filling its cells */
        for (int k = 0; k < 3; k++) {
            lo[k] = (double)from[k] + formats_between(m, 0, 0.3);
            hi[k] = (double)(from[k] + extent[k]) - formats_between(m, 0, 0.3);
        }
        add_made_box(m, lo, hi);
    }
    support_free(&m->sink.alloc, taken, side * side * side);
}

void formats_make_sticks(formats_maker *m) {
    pack(m, 1, 8);
}

void formats_make_slabs(formats_maker *m) {
    pack(m, 6, 1);
}

/* Towers on lots of 16 x 16, blocks of 4 x 4 lots between streets; all stand on the ground. */
void formats_make_towers(formats_maker *m) {
    enum { LOTS = 4, STREET = 8, LOT = 16 };
    size_t side = formats_root(m->n, 2) + 1;
    for (size_t i = 0; !formats_done(m); i++) {
        size_t place[2] = {i % side, i / side};
        double lo[3] = {0, 0, 0}, hi[3];
        for (int k = 0; k < 2; k++) {
            size_t streets = place[k] / LOTS, lot = place[k] * LOT + streets * STREET;
            lo[k] = (double)lot + formats_below(m, 4);
            hi[k] = (double)lot + 10 + formats_below(m, 7); /* up to the neighbour's lot: some touch */
        }
        hi[2] = 8 + 4 * (double)formats_below(m, 20);
        add_made_box(m, lo, hi);
    }
}

/* A building of rooms: walls with thickness, storey by storey, with doors left open. */
void formats_make_panels(formats_maker *m) {
    enum { ROOM = 32, HEIGHT = 24, THICK = 2 };
    size_t side = formats_root(m->n / 4, 3) + 1;
    for (size_t i = 0; !formats_done(m); i++) {
        double at[3], lo[3], hi[3];
        formats_grid(i, side, 3, at);
        for (int k = 0; k < 3; k++) at[k] *= k < 2 ? ROOM : HEIGHT;
        const double ceiling[3] = {at[0] + ROOM, at[1] + ROOM, at[2] + THICK};
        add_made_box(m, at, ceiling);
        for (int axis = 0; axis < 2; axis++) {
            double door = 4 + formats_below(m, 16);
            for (int half = 0; half < 2; half++) {
                for (int k = 0; k < 3; k++) lo[k] = at[k], hi[k] = at[k] + (k == 2 ? HEIGHT : THICK);
                lo[2] += THICK;
                lo[axis] = at[axis] + (half ? door + 6 : THICK);
                hi[axis] = at[axis] + (half ? ROOM : door);
                add_made_box(m, lo, hi);
            }
        }
    }
}

/* Cubes in cubes in cubes: one centre. */
void formats_make_shells(formats_maker *m) {
    for (size_t i = 1; !formats_done(m); i++) {
        double r = (double)i;
        const double lo[3] = {-r, -r, -r}, hi[3] = {r, r, r};
        add_made_box(m, lo, hi);
    }
}

/* k x k bars in each of the three directions, through one cube, without touching: n^(3/2) fragments in any partition by
 * axis-parallel planes (Paterson and Yao 1992). */
void formats_make_bars(formats_maker *m) {
    size_t side = formats_root(m->n / 3, 2) + 1;
    for (size_t i = 0; !formats_done(m); i++) {
        int along = (int)(i % 3);
        size_t place = i / 3, row = place / side, column = place % side;
        double lo[3], hi[3];
        const double at[2] = {4 * (double)column, 4 * (double)row};
        for (int k = 0; k < 3; k++) {
            int turn = (k - along + 3) % 3; /* 0: along; 1, 2: across, in places that the others leave free */
            lo[k] = turn ? at[turn - 1] + (turn == 1 ? 0 : 2) : 0;
            hi[k] = turn ? lo[k] + 1 : (double)(4 * side);
        }
        add_made_box(m, lo, hi);
    }
}

/* As wide as the stack is high: cluttered, since a cube between the rims meets all and has no corner inside; but of low
 * directional density. */
void formats_make_plates(formats_maker *m) {
    double wide = 4 * (double)m->n;
    for (size_t i = 0; !formats_done(m); i++) {
        double lo[3] = {0, 0, 2 * (double)i}, hi[3] = {wide, wide, 2 * (double)i + 1};
        for (int k = 0; k < 2; k++) {
            lo[k] += formats_between(m, 0, wide / 16);
            hi[k] -= formats_between(m, 0, wide / 16);
        }
        add_made_box(m, lo, hi);
    }
}

/* The other way round: uncluttered, since all are cubes, of one size where they are near each other; but across a plane
 * of each large one lie about root(n) / 2 others, on two axes at least. */
void formats_make_moons(formats_maker *m) {
    size_t crowd = formats_root(m->n, 2) / 2 + 1, side = formats_root(crowd, 2) + 1,
           row = formats_root(m->n / (2 * crowd), 3) + 1;
    double large = 2 * (double)side;
    for (size_t i = 0; !formats_done(m); i++) {
        double at[3], lo[3], hi[3];
        formats_grid(i, row, 3, at);
        for (int k = 0; k < 3; k++) at[k] *= 4 * large, hi[k] = at[k] + large;
        add_made_box(m, at, hi);
        for (size_t moon = 0; moon < 2 * crowd; moon++) {
            int across = moon < crowd ? 1 : 2;
            size_t place = moon % crowd, layer = place / side;
            lo[0] = at[0] + large + 2 * (double)layer + 1 + formats_between(m, 0, 0.5);
            lo[3 - across] = at[3 - across] + 2 * (double)(place % side);
            lo[across] = at[across] + large - 0.5;
            for (int k = 0; k < 3; k++) hi[k] = lo[k] + 1;
            add_made_box(m, lo, hi);
        }
    }
}

/* Unit cubes side by side. */
void formats_make_bricks(formats_maker *m) {
    size_t side = formats_root(m->n, 3) + 1;
    for (size_t i = 0; !formats_done(m); i++) {
        double lo[3], hi[3];
        formats_grid(i, side, 3, lo);
        for (int k = 0; k < 3; k++) hi[k] = lo[k] + 1;
        add_made_box(m, lo, hi);
    }
}

/* Boxes with corners on a tiny lattice: overlapping, equal, nested, touching, and without extent. */
void formats_make_debris(formats_maker *m) {
    while (!formats_done(m)) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        for (int k = 0; k < m->sink.dim; k++) {
            lo[k] = formats_below(m, 6);
            hi[k] = lo[k] + formats_below(m, 4);
        }
        add_made_box(m, lo, hi);
    }
}
