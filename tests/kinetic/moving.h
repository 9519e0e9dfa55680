/* moving.h: motions of every kind that a partition in motion has to live with, from integers. */
#ifndef FROE_TESTS_KINETIC_MOVING_H
#define FROE_TESTS_KINETIC_MOVING_H
#include "kinetic/kinetic.h"
#include "support/batch.h"
#include "support/fuzz.h"
#include <stdlib.h>
#include <string.h>

/** Segments from a grid, each on its way for MOVING_TIME. */
typedef struct moving_kind {
    const char *name;
    int count, grid, length, speed, spin;
    int legs;    /**< pieces of each plan */
    bool curved; /**< on parabolas */
    bool cubic;  /**< with curved: on cubics */
    bool mixed;  /**< with cubic: on cubics, parabolas and straight lines, piece by piece */
    double late; /**< with cubic: the second control point bends them alone, up to 64 of these away */
    bool chains; /**< each segment begins where the last one ends */
    bool rigid;  /**< all with the speed of the first */
    bool twice;  /**< each two segments are the same */
    bool upright;
    bool lanes;   /**< on lines y = const, along them */
    bool mortal;  /**< they come and go */
    bool back;    /**< the second half is the first in reverse: 2 legs */
    bool against; /**< with rigid: each second one the other way */
    double tick;  /**< 0: as is usual */
    bool turns;   /**< quarters of turns about one of nine centres, on parabolas */
} moving_kind;

enum { MOVING_TIME = 64, MOVING_MOST = 256, MOVING_LEGS = 8 };

typedef struct moving_data {
    size_t starts[2 * MOVING_MOST + 1];
    double times[2 * MOVING_MOST * (MOVING_LEGS + 1)], xy[4 * MOVING_MOST * (MOVING_LEGS + 1)];
    double controls[4 * MOVING_MOST * (MOVING_LEGS + 1)], seconds[4 * MOVING_MOST * (MOVING_LEGS + 1)];
    double births[MOVING_MOST], deaths[MOVING_MOST];
    uint32_t vertices[2 * MOVING_MOST];
} moving_data;

/* Makes a piece that is a parabola so far a cubic, or something else; `p`: where it begins. */
static inline void moving_bend(const moving_kind *kind, fuzz_source *r, moving_data *d, size_t i, const double p[2]) {
    const int around = kind->grid / 4 + 1, degree = kind->mixed ? fuzz_int(r, 1, 3) : kind->cubic ? 3 : 2;
    for (size_t c = 0; c < 2; c++) {
        d->seconds[2 * i + c] = degree > 2 ? p[c] + fuzz_int(r, -around, around) : (double)NAN;
        if (kind->late > 0)
            d->controls[2 * i + c] = p[c], d->seconds[2 * i + c] = p[c] + kind->late * fuzz_int(r, -64, 64);
        if (degree < 2) d->controls[2 * i + c] = (double)NAN;
    }
}

static inline void moving_plan(const moving_kind *kind, fuzz_source *r, moving_data *d, size_t v, const int at[2],
                               const int speed[2]) {
    int w[2] = {speed[0], speed[1]}, p[2] = {at[0], at[1]};
    int legs = kind->legs ? kind->legs : 1;
    size_t first = d->starts[v];
    for (int j = 0; j <= legs; j++) {
        size_t i = first + (size_t)j;
        const double from[2] = {p[0], p[1]};
        d->times[i] = (double)MOVING_TIME * j / legs;
        for (int c = 0; c < 2; c++) {
            d->xy[2 * i + (size_t)c] = kind->back && j == 2 ? at[c] : p[c];
            d->controls[2 * i + (size_t)c] =
                kind->curved ? p[c] + fuzz_int(r, -kind->grid / 4 - 1, kind->grid / 4 + 1) : (double)NAN;
            p[c] += w[c] * MOVING_TIME / legs;
            if (!kind->rigid) w[c] = kind->lanes && c ? 0 : -w[c] + fuzz_int(r, -1, 1);
        }
        moving_bend(kind, r, d, i, from);
    }
    for (size_t c = 0; c < 2 && kind->back && kind->curved; c++) {
        const size_t there = 2 * first + c, back = there + 2;
        d->controls[back] = kind->cubic ? d->seconds[there] : d->controls[there];
        if (kind->cubic) d->seconds[back] = d->controls[there];
    }
    d->starts[v + 1] = first + (size_t)legs + 1;
}

/* From d beside the centre to d turned by 90 degrees, and so on; the control point is the corner of the square. */
static inline void moving_turn(const moving_kind *kind, moving_data *d, size_t v, const int at[2],
                               const int centre[2]) {
    int arm[2] = {at[0] - centre[0], at[1] - centre[1]};
    const size_t first = d->starts[v], legs = (size_t)kind->legs;
    for (size_t i = first; i <= first + legs; i++) {
        const int next[2] = {-arm[1], arm[0]};
        d->times[i] = MOVING_TIME * (double)(i - first) / (double)legs;
        for (size_t c = 0; c < 2; c++) {
            d->xy[2 * i + c] = centre[c] + arm[c];
            d->controls[2 * i + c] = centre[c] + arm[c] + next[c];
            d->seconds[2 * i + c] = (double)NAN;
        }
        arm[0] = next[0], arm[1] = next[1];
    }
    d->starts[v + 1] = first + legs + 1;
}

/** A motion of this kind; the caller frees it. */
static inline froe_motion *moving_new(const moving_kind *kind, uint64_t seed, const froe_allocator *alloc) {
    moving_data *d = calloc(1, sizeof *d);
    fuzz_source r = {seed};
    int speed[2] = {0, 0}, at[2][2] = {{0, 0}, {0, 0}};
    if (!d) abort();
    for (size_t i = 0; i < (size_t)kind->count; i++) {
        bool again = kind->twice && i % 2, chained = kind->chains && i % 5;
        for (int c = 0; c < 2 && !again; c++) {
            if (!kind->rigid || !i) speed[c] = kind->lanes && c ? 0 : fuzz_int(&r, -kind->speed, kind->speed);
            if (kind->against && i) speed[c] = -speed[c];
            if (kind->turns) speed[c] = fuzz_int(&r, 0, 2) * kind->grid / 2; /* the centre */
            at[0][c] = chained ? at[1][c] : fuzz_int(&r, 0, kind->grid);
            int step = fuzz_int(&r, -kind->length, kind->length);
            at[1][c] = at[0][c] + (kind->upright && !c ? 0 : kind->lanes && c ? 0 : step);
        }
        if (at[0][0] == at[1][0] && at[0][1] == at[1][1]) at[1][kind->lanes ? 0 : 1]++;
        for (size_t e = 0; e < 2; e++) {
            int w[2] = {speed[0], speed[1]};
            for (int c = 0; c < 2 && !kind->rigid && !kind->twice; c++)
                if (!kind->lanes || !c) w[c] += fuzz_int(&r, -kind->spin, kind->spin);
            if (again) {
                size_t old = 2 * (i - 1) + e, legs = d->starts[old + 1] - d->starts[old];
                for (size_t j = 0; j < legs; j++) {
                    size_t to = d->starts[2 * i + e] + j, from = d->starts[old] + j;
                    d->times[to] = d->times[from];
                    memcpy(d->xy + 2 * to, d->xy + 2 * from, 2 * sizeof *d->xy);
                    memcpy(d->controls + 2 * to, d->controls + 2 * from, 2 * sizeof *d->xy);
                    memcpy(d->seconds + 2 * to, d->seconds + 2 * from, 2 * sizeof *d->xy);
                }
                d->starts[2 * i + e + 1] = d->starts[2 * i + e] + legs;
            } else if (kind->turns) {
                moving_turn(kind, d, 2 * i + e, at[e], speed);
            } else {
                moving_plan(kind, &r, d, 2 * i + e, at[e], w);
            }
            d->vertices[2 * i + e] = (uint32_t)(2 * i + e);
        }
        if (chained) d->vertices[2 * i] = (uint32_t)(2 * i - 1);
        d->births[i] = kind->mortal ? fuzz_int(&r, -20, 40) : 0;
        d->deaths[i] = kind->mortal ? d->births[i] + fuzz_int(&r, 0, 40) : MOVING_TIME;
    }
    froe_motion_options w = froe_motion_defaults();
    w.end = MOVING_TIME;
    w.begin = 0;
    w.tick = kind->tick;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * (size_t)kind->count;
    b.count = (size_t)kind->count;
    b.starts = d->starts, b.times = d->times, b.coords = d->xy, b.controls = d->controls;
    b.second_controls = d->seconds;
    b.vertices = d->vertices, b.births = d->births, b.deaths = d->deaths;
    froe_motion *m = batch_motion(&w, &b, alloc);
    free(d);
    return m;
}

/** All kinds that partitions are tested with. */
static const moving_kind moving_kinds[] = {
    {.name = "random", .count = 24, .grid = 8000, .length = 4000, .speed = 60, .spin = 40},
    {.name = "many small", .count = 90, .grid = 8000, .length = 900, .speed = 90, .spin = 20},
    {.name = "parabolas", .count = 16, .grid = 8000, .length = 3000, .speed = 40, .spin = 30, .curved = true},
    {.name = "rotation", .count = 12, .grid = 3000, .length = 3000, .speed = 1, .spin = 90, .curved = true},
    {.name = "lattice 8", .count = 20, .grid = 8, .length = 4, .speed = 1, .spin = 1},
    {.name = "lattice 16", .count = 30, .grid = 16, .length = 6, .speed = 2, .spin = 1},
    {.name = "lattice 40", .count = 30, .grid = 40, .length = 15, .speed = 2, .spin = 2},
    {.name = "lattice 100", .count = 40, .grid = 100, .length = 60, .speed = 5, .spin = 3},
    {.name = "rigid", .count = 40, .grid = 12, .length = 6, .speed = 5, .rigid = true},
    {.name = "rigid against rigid", .count = 40, .grid = 16, .length = 6, .speed = 3, .rigid = true, .against = true},
    {.name = "quarter turns", .count = 16, .grid = 2000, .length = 900, .turns = true, .legs = 3},
    {.name = "lattice turns", .count = 20, .grid = 12, .length = 5, .turns = true, .legs = 2},
    {.name = "chains", .count = 40, .grid = 3000, .length = 900, .speed = 30, .spin = 20, .chains = true},
    {.name = "lattice chains", .count = 25, .grid = 20, .length = 6, .speed = 1, .spin = 1, .chains = true},
    {.name = "bouncing", .count = 20, .grid = 4000, .length = 1500, .speed = 60, .spin = 20, .legs = 6},
    {.name = "lattice bouncing", .count = 16, .grid = 24, .length = 8, .speed = 2, .spin = 1, .legs = 6},
    {.name = "twins", .count = 24, .grid = 1000, .length = 500, .speed = 12, .twice = true, .legs = 3},
    {.name = "upright", .count = 24, .grid = 200, .length = 90, .speed = 5, .spin = 0, .upright = true},
    {.name = "nearly upright", .count = 20, .grid = 200, .length = 90, .speed = 5, .spin = 1, .upright = true},
    {.name = "lanes", .count = 24, .grid = 12, .length = 5, .speed = 2, .spin = 1, .lanes = true, .legs = 3},
    {.name = "lanes that meet",
     .count = 24,
     .grid = 8,
     .length = 4,
     .speed = 1,
     .lanes = true,
     .twice = true,
     .legs = 3},
    {.name = "mortal", .count = 40, .grid = 2000, .length = 900, .speed = 30, .spin = 10, .mortal = true},
    {.name = "spinning", .count = 20, .grid = 2000, .length = 2500, .speed = 2, .spin = 80, .curved = true, .legs = 2},
    {.name = "lattice spinning", .count = 20, .grid = 12, .length = 8, .speed = 0, .spin = 2, .legs = 4},
    {.name = "mortal lattice", .count = 24, .grid = 16, .length = 6, .speed = 2, .spin = 1, .mortal = true},
    {.name = "cubics",
     .count = 16,
     .grid = 8000,
     .length = 3000,
     .speed = 40,
     .spin = 30,
     .curved = true,
     .cubic = true},
    {.name = "lattice cubics",
     .count = 20,
     .grid = 12,
     .length = 5,
     .speed = 1,
     .spin = 1,
     .legs = 2,
     .curved = true,
     .cubic = true},
    {.name = "all degrees",
     .count = 16,
     .grid = 2000,
     .length = 900,
     .speed = 20,
     .spin = 20,
     .legs = 3,
     .curved = true,
     .cubic = true,
     .mixed = true},
    {.name = "mortal lattice of all degrees",
     .count = 24,
     .grid = 16,
     .length = 6,
     .speed = 2,
     .spin = 1,
     .legs = 4,
     .curved = true,
     .cubic = true,
     .mixed = true,
     .mortal = true},
    {.name = "cubics back",
     .count = 16,
     .grid = 2000,
     .length = 1500,
     .speed = 40,
     .spin = 30,
     .legs = 2,
     .curved = true,
     .cubic = true,
     .back = true,
     .chains = true},
    {.name = "upright late cubics",
     .count = 16,
     .grid = 200,
     .length = 90,
     .speed = 5,
     .curved = true,
     .cubic = true,
     .late = 1,
     .upright = true},
};
enum { MOVING_KINDS = sizeof moving_kinds / sizeof *moving_kinds };

/** The kind of that name, which is in the list. */
static inline const moving_kind *moving_kind_named(const char *name) {
    const moving_kind *kind = moving_kinds;
    while (strcmp(kind->name, name) != 0) kind++;
    return kind;
}
#endif
