/* make_maps.c: what floor plans, town plans and maps look like. */
#include "formats/generate/maker.h"
#include <string.h>

/* Polylines of about 60 whole-numbered vertices; each turns a little at every step. */
void formats_make_polylines(formats_maker *m) {
    enum { VERTICES = 60 };
    double side = 16 * (double)(formats_root(m->n, 2) + 1);
    size_t line = 0;
    while (!formats_done(m)) {
        double at[2], course[2], bend[2];
        formats_place(m, 2, at);
        for (int k = 0; k < 2; ++k) at[k] = (double)(int64_t)(side * at[k]);
        formats_direction(m, 2, course);
        formats_make_group(m, "line", ++line, "polyline");
        for (uint32_t i = VERTICES / 2 + formats_below(m, VERTICES); i && !formats_done(m); --i) {
            formats_direction(m, 2, bend);
            for (int k = 0; k < 2; ++k) course[k] = 0.8 * course[k] + 0.3 * bend[k];
            double to[2];
            for (int k = 0; k < 2; ++k) to[k] = (double)(int64_t)(at[k] + 12 * course[k]);
            formats_make_segment(m, at[0], at[1], to[0], to[1]);
            memcpy(at, to, sizeof at);
        }
    }
}

/* Wall from `from` along `axis`, 16 long, with a door of 4 somewhere. */
static void wall(formats_maker *m, const double *from, int axis, bool door) {
    double to[2] = {from[0], from[1]};
    to[axis] += 16;
    if (!door) return formats_make_segment(m, from[0], from[1], to[0], to[1]);
    double hinge[2] = {from[0], from[1]}, latch[2] = {from[0], from[1]};
    hinge[axis] += 2 + formats_below(m, 9);
    latch[axis] = hinge[axis] + 4;
    formats_make_segment(m, from[0], from[1], hinge[0], hinge[1]);
    if (!formats_done(m)) formats_make_segment(m, latch[0], latch[1], to[0], to[1]);
}

/* Rooms of 16 x 16 in a square; every seventh row is a corridor, without walls across. */
void formats_make_rooms(formats_maker *m) {
    enum { CORRIDOR = 7 };
    size_t side = formats_root(m->n / 4, 2) + 2;
    for (size_t i = 0; !formats_done(m); ++i) {
        double from[2];
        formats_grid(i, side, 2, from);
        for (int k = 0; k < 2; ++k) from[k] *= 16;
        bool outer = i < side, across = i / side % CORRIDOR != CORRIDOR - 1;
        uint32_t dice = formats_below(m, 8);
        wall(m, from, 0, !outer && dice < 5);
        if (across && (dice & 1 || i % side == 0) && !formats_done(m)) wall(m, from, 1, i % side && dice != 7);
    }
}

/* A house of 4 or 6 corners, turned as the street is. */
static void house(formats_maker *m, const double *corner, const double *turn) {
    static const double plain[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const double cornered[6][2] = {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
    double width = formats_between(m, 8, 14), depth = formats_between(m, 8, 14), ring[6][2];
    bool six = formats_below(m, 3) == 0;
    int corners = six ? 6 : 4;
    for (int i = 0; i < corners; ++i) {
        double x = width * (six ? cornered[i][0] : plain[i][0]), y = depth * (six ? cornered[i][1] : plain[i][1]);
        ring[i][0] = corner[0] + turn[0] * x - turn[1] * y;
        ring[i][1] = corner[1] + turn[1] * x + turn[0] * y;
    }
    for (int i = 0; i < corners && !formats_done(m); ++i)
        formats_make_segment(m, ring[i][0], ring[i][1], ring[(i + 1) % corners][0], ring[(i + 1) % corners][1]);
}

/* Quarters of 8 x 8 lots of 16 x 16, each turned by a rational angle about its middle. */
void formats_make_blocks(formats_maker *m) {
    enum { LOTS = 8 };
    size_t quarters = formats_root(m->n / (4 * LOTS * LOTS), 2) + 1, built = 0;
    for (size_t q = 0; !formats_done(m); ++q) {
        double turn[2], middle[2];
        formats_grid(q, quarters, 2, middle);
        for (int k = 0; k < 2; ++k) middle[k] *= 200;
        formats_circle(formats_below(m, 16), 64, turn);
        for (size_t lot = 0; lot < LOTS * LOTS && !formats_done(m); ++lot) {
            double place[2];
            formats_grid(lot, LOTS, 2, place);
            const int half = LOTS / 2;
            double x = 16 * (place[0] - half), y = 16 * (place[1] - half);
            double corner[2] = {middle[0] + turn[0] * x - turn[1] * y, middle[1] + turn[1] * x + turn[0] * y};
            formats_make_group(m, "house", ++built, "house");
            house(m, corner, turn);
        }
    }
}

/* Cell i has the children 2i + 1 and 2i + 2; the split of a cell is one segment. */
void formats_make_cells(formats_maker *m) {
    typedef struct cell {
        double lo[2], hi[2];
    } cell;
    ARRAY(cell) all = {0};
    cell at = {{0, 0}, {1, 1}};
    bool room = array_push(&m->sink.alloc, &all, at);
    for (size_t i = 0; room && !formats_done(m); ++i) {
        at = all.data[i];
        int axis = at.hi[1] - at.lo[1] > at.hi[0] - at.lo[0];
        double cut = at.lo[axis] + (at.hi[axis] - at.lo[axis]) * formats_between(m, 0.3, 0.7);
        cell below = at, above = at;
        below.hi[axis] = above.lo[axis] = cut;
        formats_make_segment(m, above.lo[0], above.lo[1], below.hi[0], below.hi[1]);
        room = array_push(&m->sink.alloc, &all, below) && array_push(&m->sink.alloc, &all, above);
    }
    if (!room) m->status = support_fail_memory(m->sink.diag);
    array_free(&m->sink.alloc, &all);
}
