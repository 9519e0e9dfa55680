/* turning.h: motions of the plane in which bodies fly and turn among segments that fly by themselves, from integers. */
#ifndef FROE_TESTS_SUPPORT_TURNING_H
#define FROE_TESTS_SUPPORT_TURNING_H
#include "kinetic/moving.h"
#include <math.h>
#include <stdio.h>

typedef struct turning_kind {
    const char *name;
    int bodies, each; /**< bodies, and segments of each */
    int free;         /**< segments of no body */
    int grid, size;   /**< of where they are, and of bodies and segments */
    int speed, legs;  /**< on the grid in all of the time; pieces of each plan */
    bool resting;     /**< centres do not move */
    bool curved;      /**< centres and free segments fly on parabolas */
    bool cubic;       /**< with curved: free segments on cubics */
    bool quarters;    /**< turns by quarters: much coincides */
    bool closed;      /**< segments of a body are joined: each begins where the last one ends */
    bool still;       /**< bodies do not turn */
    bool mortal;      /**< segments come and go */
} turning_kind;

enum { TURNING_MOST = 64, TURNING_LEGS = 8, TURNING_BODIES = 8 };

/* Turn j of a body: a quarter more each time, or anything less than half a turn from the last one. */
static inline void turning_turn(const turning_kind *kind, fuzz_source *r, int j, double *angle, double out[2]) {
    static const double half = 0.70710678118654752440;
    static const double quarters[8][2] = {{0, 1},  {half, half},   {1, 0},  {half, -half},
                                          {0, -1}, {-half, -half}, {-1, 0}, {-half, half}};
    *angle += j ? 0.7 + 0.5 * fuzz_unit(r) : 0;
    out[0] = kind->quarters ? quarters[j % 8][0] : sin(*angle);
    out[1] = kind->quarters ? quarters[j % 8][1] : cos(*angle);
}

static inline uint32_t turning_body(const turning_kind *kind, fuzz_source *r, froe_motion *m) {
    double times[TURNING_LEGS + 1], at[2 * TURNING_LEGS + 2], controls[2 * TURNING_LEGS + 2],
        turns[2 * TURNING_LEGS + 2];
    double angle = fuzz_unit(r);
    int place[2] = {fuzz_int(r, 0, kind->grid), fuzz_int(r, 0, kind->grid)};
    for (int j = 0; j <= kind->legs; j++) {
        times[j] = (double)MOVING_TIME * j / kind->legs;
        if (kind->still)
            turns[2 * j] = 0, turns[2 * j + 1] = 1;
        else
            turning_turn(kind, r, j, &angle, turns + 2 * (size_t)j);
        for (int c = 0; c < 2; c++) {
            at[2 * j + c] = place[c];
            if (!kind->resting) place[c] += fuzz_int(r, -kind->speed, kind->speed) / kind->legs;
            controls[2 * j + c] = kind->curved ? place[c] + fuzz_int(r, -kind->size, kind->size) : (double)NAN;
        }
    }
    froe_body b = froe_body_defaults();
    uint32_t id = 0;
    b.count = (size_t)kind->legs + 1, b.times = times, b.coords = at, b.turns = turns;
    b.controls = kind->curved && !kind->resting ? controls : NULL;
    if (froe_motion_add_body(m, &b, &id, NULL)) abort();
    return id;
}

typedef struct turning_batch {
    size_t starts[2 * TURNING_MOST + 1], count, knots;
    double times[2 * TURNING_MOST * (TURNING_LEGS + 1)], xy[4 * TURNING_MOST * (TURNING_LEGS + 1)];
    double controls[4 * TURNING_MOST * (TURNING_LEGS + 1)], seconds[4 * TURNING_MOST * (TURNING_LEGS + 1)];
    double births[TURNING_MOST], deaths[TURNING_MOST];
    uint32_t vertices[2 * TURNING_MOST], bodies[2 * TURNING_MOST], vertex_count;
} turning_batch;

static inline uint32_t turning_vertex(turning_batch *t, const int at[2], uint32_t body) {
    const uint32_t v = t->vertex_count++;
    t->bodies[v] = body;
    t->starts[v] = t->knots;
    t->times[t->knots] = 0;
    for (size_t c = 0; c < 2; c++) {
        t->xy[2 * t->knots + c] = at[c];
        t->controls[2 * t->knots + c] = t->seconds[2 * t->knots + c] = (double)NAN;
    }
    t->starts[v + 1] = ++t->knots;
    return v;
}

/* The segments of a body, about its centre. */
static inline void turning_shape(const turning_kind *kind, fuzz_source *r, uint32_t body, turning_batch *t) {
    uint32_t last = FROE_NONE, first = FROE_NONE;
    for (int i = 0; i < kind->each; i++) {
        int at[2], to[2];
        for (int c = 0; c < 2; c++) {
            at[c] = fuzz_int(r, -kind->size, kind->size);
            to[c] = fuzz_int(r, -kind->size, kind->size);
        }
        if (at[0] == to[0] && at[1] == to[1]) to[0]++;
        const bool joined = kind->closed && i, ends = joined && i + 1 == kind->each && i > 1;
        const uint32_t from = joined ? last : turning_vertex(t, at, body);
        if (!i) first = from;
        last = ends ? first : turning_vertex(t, to, body);
        t->vertices[2 * t->count] = from, t->vertices[2 * t->count + 1] = last;
        t->count++;
    }
}

static inline void turning_free(const turning_kind *kind, fuzz_source *r, turning_batch *t) {
    int at[2] = {fuzz_int(r, 0, kind->grid), fuzz_int(r, 0, kind->grid)};
    for (int e = 0; e < 2; e++) {
        const uint32_t v = turning_vertex(t, at, FROE_NONE);
        int place[2] = {at[0], at[1]};
        t->knots = t->starts[v];
        for (int j = 0; j <= kind->legs; j++, t->knots++) {
            t->times[t->knots] = (double)MOVING_TIME * j / kind->legs;
            for (size_t c = 0; c < 2; c++) {
                t->xy[2 * t->knots + c] = place[c];
                place[c] += fuzz_int(r, -kind->speed, kind->speed) / kind->legs;
                t->controls[2 * t->knots + c] =
                    kind->curved ? place[c] + fuzz_int(r, -kind->size, kind->size) : (double)NAN;
                t->seconds[2 * t->knots + c] =
                    kind->cubic ? place[c] + fuzz_int(r, -kind->size, kind->size) : (double)NAN;
            }
        }
        t->starts[v + 1] = t->knots;
        t->vertices[2 * t->count + (size_t)e] = v;
        at[0] += fuzz_int(r, 1, kind->size), at[1] += fuzz_int(r, -kind->size, kind->size);
    }
    t->count++;
}

/** A motion of this kind; the caller frees it. */
static inline froe_motion *turning_new(const turning_kind *kind, uint64_t seed) {
    turning_batch *t = calloc(1, sizeof *t);
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m = NULL;
    fuzz_source r = {seed};
    w.begin = 0, w.end = MOVING_TIME;
    if (!t || froe_motion_new(&w, NULL, &m, NULL)) abort();
    for (int i = 0; i < kind->bodies; i++) {
        const uint32_t body = turning_body(kind, &r, m);
        turning_shape(kind, &r, body, t);
    }
    for (int i = 0; i < kind->free; i++) turning_free(kind, &r, t);
    for (size_t i = 0; i < t->count; i++) {
        t->births[i] = kind->mortal ? fuzz_int(&r, -20, 40) : 0;
        t->deaths[i] = kind->mortal ? fuzz_int(&r, 41, 80) : MOVING_TIME;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = t->vertex_count, b.count = t->count, b.starts = t->starts, b.times = t->times, b.coords = t->xy;
    b.controls = t->controls, b.second_controls = t->seconds, b.vertices = t->vertices, b.bodies = t->bodies;
    b.births = t->births, b.deaths = t->deaths;
    froe_diagnostic why = {0};
    if (froe_motion_add(m, &b, &why)) {
        fprintf(stderr, "%s\n", why.message);
        abort();
    }
    free(t);
    return m;
}

/** All kinds that partitions are tested with. */
static const turning_kind turning_kinds[] = {
    {.name = "windmills", .bodies = 4, .each = 4, .grid = 3000, .size = 1500, .legs = 4, .resting = true},
    {.name = "flying bodies", .bodies = 4, .each = 4, .free = 4, .grid = 3000, .size = 1200, .speed = 3000, .legs = 3},
    {.name = "thrown bodies",
     .bodies = 3,
     .each = 4,
     .free = 4,
     .grid = 3000,
     .size = 1200,
     .speed = 3000,
     .legs = 2,
     .curved = true},
    {.name = "closed bodies",
     .bodies = 4,
     .each = 5,
     .free = 3,
     .grid = 3000,
     .size = 1000,
     .speed = 2000,
     .legs = 3,
     .closed = true},
    {.name = "bodies that do not turn",
     .bodies = 4,
     .each = 4,
     .free = 4,
     .grid = 20,
     .size = 6,
     .speed = 20,
     .legs = 3,
     .still = true},
    {.name = "quarter turns",
     .bodies = 4,
     .each = 4,
     .free = 3,
     .grid = 10,
     .size = 4,
     .speed = 10,
     .legs = 4,
     .quarters = true},
    {.name = "quarter turns in place",
     .bodies = 5,
     .each = 4,
     .grid = 6,
     .size = 4,
     .legs = 4,
     .resting = true,
     .quarters = true},
    {.name = "closed quarter turns",
     .bodies = 4,
     .each = 5,
     .free = 3,
     .grid = 12,
     .size = 4,
     .speed = 12,
     .legs = 2,
     .quarters = true,
     .closed = true},
    {.name = "mortal bodies",
     .bodies = 4,
     .each = 5,
     .free = 4,
     .grid = 3000,
     .size = 1200,
     .speed = 3000,
     .legs = 3,
     .mortal = true},
    {.name = "bodies among cubics",
     .bodies = 3,
     .each = 4,
     .free = 4,
     .grid = 3000,
     .size = 1200,
     .speed = 3000,
     .legs = 2,
     .curved = true,
     .cubic = true},
};
enum { TURNING_KINDS = sizeof turning_kinds / sizeof *turning_kinds };
#endif
