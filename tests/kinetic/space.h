/* space.h: motions of triangles in space of many kinds, from integers, and a partition that follows one from event to
 * event beside trees of `cylindrical`. */
#ifndef FROE_TESTS_KINETIC_SPACE_H
#define FROE_TESTS_KINETIC_SPACE_H
#include "kinetic/kinetic.h"
#include "support/batch.h"
#include "support/fuzz.h"
#include <stdio.h>
#include <stdlib.h>

enum { SPACE_MOST = 512, SPACE_WINDOW = 64 };

/** Triangles that never cross, from one place to another for SPACE_WINDOW. */
typedef enum space_form {
    SPACE_LAYERS, /**< each between two heights of its own */
    SPACE_STEEP,  /**< each between two y of its own, which do not change: nearly upright */
    SPACE_TETRAHEDRA,
    SPACE_SHEETS, /**< meshes over squares, one above the other */
    SPACE_FANS,   /**< triangles around a vertex, in layers */
    SPACE_SWARM,  /**< each within a ball, which never meets another */
    SPACE_BOXES   /**< the same with boxes of twelve triangles */
} space_form;

typedef struct space_kind {
    const char *name;
    space_form form;
    int count, grid, reach;
    int speed, spin; /**< of a whole, and of each vertex beside it */
    int tilt;        /**< seen from aside: so many 64ths */
    int lean;        /**< heights grow so much by x and fall by y */
    int far;         /**< moved away by 2^far */
    int scale;       /**< times 2^scale */
    int still;       /**< one in so many stands still */
    bool turning;    /**< in a ball: it turns over on its way */
    bool curved;     /**< on parabolas */
    bool cubic;      /**< with curved: on cubics */
    int legs;        /**< pieces of each plan, there and back again; 0: one */
    bool mortal;     /**< they come and go */
    bool offbeat;    /**< knots of each vertex at times of its own */
} space_kind;

typedef struct space_data {
    size_t starts[3 * SPACE_MOST + 1];
    int at[3 * SPACE_MOST][3], to[3 * SPACE_MOST][3];
    double times[27 * SPACE_MOST], coords[81 * SPACE_MOST], controls[81 * SPACE_MOST], seconds[81 * SPACE_MOST];
    double births[SPACE_MOST], deaths[SPACE_MOST];
    uint32_t vertices[3 * SPACE_MOST];
    size_t vertex_count, count;
    fuzz_source random;
} space_data;

static inline void space_vertex(space_data *d, const int at[3], const int to[3]) {
    for (int k = 0; k < 3; k++) d->at[d->vertex_count][k] = at[k], d->to[d->vertex_count][k] = to[k];
    d->vertex_count++;
}

static inline void space_face(space_data *d, size_t a, size_t b, size_t c) {
    const size_t all[3] = {a, b, c};
    for (size_t k = 0; k < 3; k++) d->vertices[3 * d->count + k] = (uint32_t)all[k];
    d->count++;
}

static inline int space_any(space_data *d, int most) {
    return fuzz_int(&d->random, -most, most);
}

/* ------------------------------------------------------------------------- forms -- */

/* So many vertices within a layer, each on its own way beside that of all. */
static inline void space_cloud(const space_kind *kind, space_data *d, int layer, int corners) {
    int centre[2], drift[2];
    const bool still = kind->still && d->count % (size_t)kind->still == 0;
    for (int k = 0; k < 2; k++) centre[k] = fuzz_int(&d->random, 0, kind->grid), drift[k] = space_any(d, kind->speed);
    for (int i = 0; i < corners; i++) {
        int at[3], to[3];
        for (int k = 0; k < 2; k++) {
            at[k] = centre[k] + space_any(d, kind->reach);
            to[k] = still ? at[k] : at[k] + drift[k] + space_any(d, kind->spin);
        }
        at[2] = 2 * kind->grid * layer + fuzz_int(&d->random, 0, kind->grid);
        to[2] = still || !kind->spin ? at[2] : 2 * kind->grid * layer + fuzz_int(&d->random, 0, kind->grid);
        if (kind->form == SPACE_STEEP) {
            const int y = at[1], v = to[1];
            at[1] = at[2], to[1] = at[2], at[2] = y, to[2] = v;
        }
        space_vertex(d, at, to);
    }
}

/* Six times the volume of the tetrahedron of a vertex and the three after it. */
static inline double space_volume(const space_data *d, size_t v, double share) {
    double p[3][3];
    for (size_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int at = d->at[v + 1 + i][k] - d->at[v][k], to = d->to[v + 1 + i][k] - d->to[v][k];
            p[i][k] = at + share * (to - at);
        }
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += p[0][i] * (p[1][(i + 1) % 3] * p[2][(i + 2) % 3] - p[1][(i + 2) % 3] * p[2][(i + 1) % 3]);
    return sum;
}

/* A tetrahedron that never turns inside out, which it cannot do without being flat for an instant. */
static inline bool space_is_solid(const space_data *d, size_t v) {
    enum { STEPS = 64 };
    bool below = false, above = false;
    for (int i = 0; i <= STEPS; i++) {
        const double volume = space_volume(d, v, (double)i / STEPS);
        below |= volume<1e5, above |= volume> - 1e5;
    }
    return below != above;
}

/* Are the vertex and the two after it in one line, at the start or the end? */
static inline bool space_is_thin(const space_data *d, size_t v) {
    for (int end = 0; end < 2; end++) {
        const int(*at)[3] = end ? d->to + v : d->at + v;
        bool thin = true;
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            thin &= (at[1][i] - at[0][i]) * (at[2][j] - at[0][j]) == (at[1][j] - at[0][j]) * (at[2][i] - at[0][i]);
        }
        if (thin) return true;
    }
    return false;
}

static inline void space_layer(const space_kind *kind, space_data *d, int layer) {
    const size_t first = d->vertex_count;
    const bool solid = kind->form == SPACE_TETRAHEDRA;
    do {
        d->vertex_count = first;
        space_cloud(kind, d, layer, solid ? 4 : 3);
    } while (solid ? !space_is_solid(d, first) : space_is_thin(d, first));
    space_face(d, first, first + 1, first + 2);
    if (!solid) return;
    space_face(d, first, first + 3, first + 1);
    space_face(d, first + 1, first + 3, first + 2);
    space_face(d, first + 2, first + 3, first);
}

/* Squares of a net, each two triangles, none of which turns over at the start. */
static inline void space_sheet(const space_kind *kind, space_data *d, int layer) {
    enum { SIDE = 3 };
    const size_t first = d->vertex_count;
    int drift[2], corner[2];
    for (int k = 0; k < 2; k++) corner[k] = fuzz_int(&d->random, 0, kind->grid), drift[k] = space_any(d, kind->speed);
    for (int i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        int at[3] = {corner[0] + i % (SIDE + 1) * kind->reach, corner[1] + i / (SIDE + 1) * kind->reach, 0}, to[3];
        for (int k = 0; k < 2; k++) {
            at[k] += space_any(d, kind->spin / 4);
            to[k] = at[k] + drift[k] + space_any(d, kind->spin);
        }
        at[2] = to[2] = 2 * kind->grid * layer + fuzz_int(&d->random, 0, kind->grid);
        space_vertex(d, at, to);
    }
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const size_t v = first + i / SIDE * (SIDE + 1) + i % SIDE;
        space_face(d, v, v + 1, v + SIDE + 1);
        space_face(d, v + 1, v + SIDE + 2, v + SIDE + 1);
    }
}

static inline void space_fan(const space_kind *kind, space_data *d, int layer) {
    enum { BLADES = 5 };
    const size_t first = d->vertex_count;
    int drift[2], hub[2];
    static const int way[BLADES][2] = {{10, 0}, {3, 9}, {-8, 6}, {-8, -6}, {3, -9}};
    for (int k = 0; k < 2; k++) hub[k] = fuzz_int(&d->random, 0, kind->grid), drift[k] = space_any(d, kind->speed);
    for (int i = 0; i <= BLADES; i++) {
        int at[3], to[3];
        for (int k = 0; k < 2; k++) {
            at[k] = hub[k] + (i ? way[i - 1][k] * kind->reach / 10 + space_any(d, kind->reach / 8) : 0);
            to[k] = at[k] + drift[k] + space_any(d, kind->spin);
        }
        at[2] = to[2] = 2 * kind->grid * layer + (i ? fuzz_int(&d->random, 0, kind->grid / 2) : kind->grid);
        space_vertex(d, at, to);
    }
    for (size_t i = 0; i < BLADES; i++) space_face(d, first, first + 1 + i, first + 1 + (i + 1) % BLADES);
}

/* Do two balls keep apart by `far` on their straight ways from 0 to 1? */
static inline bool space_are_apart(const int at[3], const int to[3], const int from[3], const int on[3], double far) {
    double p[3], q[3], pq = 0, qq = 0, left = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = at[k] - from[k], q[k] = to[k] - on[k] - p[k];
        pq += p[k] * q[k], qq += q[k] * q[k];
    }
    double t = qq > 0 ? -pq / qq : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int k = 0; k < 3; k++) left += (p[k] + q[k] * t) * (p[k] + q[k] * t);
    return left > far * far;
}

static inline void space_in_ball(space_data *d, int radius, int out[3]) {
    do {
        for (int k = 0; k < 3; k++) out[k] = space_any(d, radius);
    } while (out[0] * out[0] + out[1] * out[1] + out[2] * out[2] > radius * radius);
}

static inline void space_body(const space_kind *kind, space_data *d, const int at[3], const int to[3]) {
    static const int faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                     {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    const size_t first = d->vertex_count, boxes = kind->form == SPACE_BOXES;
    int half[3], p[3], q[3], v[3], w[3];
    for (int k = 0; k < 3; k++) half[k] = (1 + fuzz_int(&d->random, 0, 3)) * kind->reach / 8;
    for (int i = 0; i < (boxes ? 8 : 3); i++) {
        space_in_ball(d, kind->reach, v);
        space_in_ball(d, kind->reach, w);
        for (int k = 0; k < 3; k++) {
            const int off = i >> k & 1 ? half[k] : -half[k];
            p[k] = at[k] + (boxes ? off : v[k]);
            q[k] = to[k] + (boxes ? off : kind->turning ? w[k] : v[k]);
        }
        space_vertex(d, p, q);
    }
    for (size_t i = 0; i < (boxes ? 12 : 1); i++)
        space_face(d, first + (boxes ? (size_t)faces[i][0] : 0), first + (boxes ? (size_t)faces[i][1] : 1),
                   first + (boxes ? (size_t)faces[i][2] : 2));
}

/* Balls on ways that keep apart. On a lattice, boxes are of whole lattice steps. */
static inline void space_swarm(const space_kind *kind, space_data *d) {
    static int ways[SPACE_MOST][2][3];
    const int step = kind->form == SPACE_BOXES ? kind->reach / 4 : 1;
    int count = 0;
    for (long tries = 0; d->count < (size_t)kind->count && tries < 4000000; tries++) {
        int(*way)[3] = ways[count];
        bool apart = true;
        for (int k = 0; k < 3; k++) {
            way[0][k] = step * fuzz_int(&d->random, 0, kind->grid / step);
            way[1][k] = way[0][k] + step * space_any(d, kind->speed / step);
        }
        for (int i = 0; i < count && apart; i++)
            apart = space_are_apart(way[0], way[1], ways[i][0], ways[i][1], 2.01 * kind->reach);
        if (!apart) continue;
        space_body(kind, d, way[0], way[1]);
        count++;
    }
}

/* ----------------------------------------------------------------------- motions -- */

/* x + a z + b y, y + c z - d x, times 64, with odd a, b, c, d. */
static inline void space_tilt(const space_kind *kind, int p[3]) {
    const int x = p[0], y = p[1], z = p[2], a = kind->tilt;
    p[2] += kind->lean * (x - y);
    if (!a) return;
    p[0] = 64 * x + (a + 8) * z + a * y;
    p[1] = 64 * y + (a + 2) * z - (a - 2) * x;
    p[2] = 64 * z;
}

static inline void space_plan(const space_kind *kind, space_data *d, size_t v) {
    const size_t legs = kind->legs ? (size_t)kind->legs : 1, first = d->starts[v];
    const int beat = kind->offbeat ? fuzz_int(&d->random, -3, 3) : 0;
    space_tilt(kind, d->at[v]);
    space_tilt(kind, d->to[v]);
    for (size_t i = 0; i <= legs; i++) {
        const int *p = i % 2 ? d->to[v] : d->at[v], *q = i % 2 ? d->at[v] : d->to[v];
        d->times[first + i] = (double)SPACE_WINDOW * (double)i / (double)legs + (i && i < legs ? beat : 0);
        for (size_t k = 0; k < 3; k++) {
            const double away = kind->far ? ldexp(1, kind->far) : 0;
            d->coords[3 * (first + i) + k] = ldexp(p[k] + away, kind->scale);
            /* halfway in z, so that layers stay apart */
            const int middle = (p[k] + q[k]) / 2,
                      bend = k < 2 ? fuzz_int(&d->random, -kind->reach / 2, kind->reach / 2) : 0;
            const int other = kind->cubic && k < 2 ? fuzz_int(&d->random, -kind->reach / 2, kind->reach / 2) : 0;
            d->controls[3 * (first + i) + k] = kind->curved ? ldexp(middle + bend + away, kind->scale) : (double)NAN;
            d->seconds[3 * (first + i) + k] = kind->cubic ? ldexp(middle + other + away, kind->scale) : (double)NAN;
        }
    }
    d->starts[v + 1] = first + legs + 1;
}

/** The caller frees it. */
static inline froe_motion *space_new(const space_kind *kind, uint64_t seed, const froe_allocator *alloc) {
    space_data *d = calloc(1, sizeof *d);
    if (!d) abort();
    d->random.state = seed * 1000003u + (uint64_t)kind->count;
    if (kind->form >= SPACE_SWARM) space_swarm(kind, d);
    for (int layer = 0; d->count < (size_t)kind->count && kind->form < SPACE_SWARM; layer++)
        if (kind->form == SPACE_SHEETS)
            space_sheet(kind, d, layer);
        else if (kind->form == SPACE_FANS)
            space_fan(kind, d, layer);
        else
            space_layer(kind, d, layer);
    for (size_t v = 0; v < d->vertex_count; v++) space_plan(kind, d, v);
    for (size_t i = 0; i < d->count; i++) {
        d->births[i] = kind->mortal ? fuzz_int(&d->random, -20, 40) : 0;
        d->deaths[i] = kind->mortal ? d->births[i] + fuzz_int(&d->random, 0, 40) : SPACE_WINDOW;
    }
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = SPACE_WINDOW, w.tick = kind->curved ? 0x1p-8 : 0x1p-16;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = d->vertex_count, b.starts = d->starts, b.times = d->times, b.coords = d->coords;
    b.controls = d->controls, b.second_controls = d->seconds, b.births = d->births, b.deaths = d->deaths;
    b.count = d->count, b.vertices = d->vertices;
    froe_motion *m = batch_motion(&w, &b, alloc);
    free(d);
    return m;
}

/* --------------------------------------------------------------------- following -- */

typedef struct space_counts {
    uint64_t events[FROE_EVENT_KINDS], all, compared;
    bool blurs;       /* what coincides exactly does not always where doubles are next to it */
    uint64_t blurred; /* how often that made another tree of `cylindrical` */
} space_counts;

static inline bool space_count(void *user, const froe_event *event) {
    space_counts *c = user;
    c->events[event->kind]++;
    c->all++;
    return true;
}

/** Is the tree, node for node, that of `cylindrical`, which is built of the triangles where they are, or at the doubles
 * next to that? */
static inline bool space_is_alike(froe_kinetic *k, space_counts *counts, froe_diagnostic *why) {
    froe_snapshot s = {0};
    counts->compared++;
    if (froe_kinetic_snapshot(k, NULL, &s, why)) return false;
    const bool blurred = !s.alike && counts->blurs && s.rounded, alike = s.alike || blurred;
    counts->blurred += blurred;
    if (!alike) snprintf(why->message, sizeof why->message, "alike %d, rounded %zu", s.alike, s.rounded);
    froe_tree_free(s.tree);
    return alike;
}

/** From event to event, and to somewhere between, comparing the tree with `cylindrical` and with one made from scratch,
 * certificates too. False: why. */
static inline bool space_follow(froe_kinetic *k, uint64_t most, space_counts *counts, froe_diagnostic *why) {
    fuzz_source r = {7};
    bool good = space_is_alike(k, counts, why) && !froe_kinetic_audit(k, why);
    const uint64_t end = counts->all + most;
    while (good && counts->all < end) {
        const double next = froe_kinetic_next(k), now = froe_kinetic_time(k);
        if (!(next <= SPACE_WINDOW)) break;
        const double between = now + (fuzz_int(&r, 1, 9) / 10.0) * (next - now);
        if (next > now + 0x1p-14 && fuzz_int(&r, 0, 3) == 0) {
            good = !froe_kinetic_advance(k, between, space_count, counts, why);
            if (good && froe_kinetic_time(k) < next) good = space_is_alike(k, counts, why);
        }
        if (good) good = !froe_kinetic_advance(k, next, space_count, counts, why);
        if (good) good = space_is_alike(k, counts, why) && !froe_kinetic_audit(k, why);
    }
    return good;
}

/** All kinds that partitions in space are tested with. */
static const space_kind space_kinds[] = {
    {.name = "layers", .form = SPACE_LAYERS, .count = 10, .grid = 1000, .reach = 300, .speed = 300, .spin = 300},
    {.name = "small", .form = SPACE_LAYERS, .count = 30, .grid = 1000, .reach = 120, .speed = 500, .spin = 120},
    {.name = "rigid", .form = SPACE_LAYERS, .count = 12, .grid = 1000, .reach = 300, .speed = 500},
    {.name = "steep", .form = SPACE_STEEP, .count = 14, .grid = 40, .reach = 300, .speed = 100, .spin = 100},
    {.name = "tetrahedra", .form = SPACE_TETRAHEDRA, .count = 24, .grid = 1000, .reach = 250, .speed = 600},
    {.name = "soft", .form = SPACE_TETRAHEDRA, .count = 24, .grid = 1000, .reach = 250, .speed = 300, .spin = 200},
    {.name = "sheets", .form = SPACE_SHEETS, .count = 36, .grid = 700, .reach = 150, .speed = 500, .spin = 40},
    {.name = "fans", .form = SPACE_FANS, .count = 20, .grid = 1000, .reach = 300, .speed = 500, .spin = 40},
    {.name = "swarm", .form = SPACE_SWARM, .count = 20, .grid = 1000, .reach = 130, .speed = 900, .turning = true},
    {.name = "rigid swarm", .form = SPACE_SWARM, .count = 20, .grid = 1000, .reach = 130, .speed = 900},
    {.name = "tilted boxes", .form = SPACE_BOXES, .count = 36, .grid = 700, .reach = 160, .speed = 500, .tilt = 5},
    {.name = "boxes", .form = SPACE_BOXES, .count = 60, .grid = 800, .reach = 120, .speed = 840},
    {.name = "lattice", .form = SPACE_LAYERS, .count = 14, .grid = 12, .reach = 5, .speed = 4, .spin = 2},
    {.name = "rigid lattice", .form = SPACE_LAYERS, .count = 16, .grid = 12, .reach = 4, .speed = 6},
    {.name = "far", .form = SPACE_LAYERS, .count = 14, .grid = 1000, .reach = 250, .speed = 300, .spin = 99, .far = 24},
    {.name = "still",
     .form = SPACE_LAYERS,
     .count = 20,
     .grid = 1000,
     .reach = 250,
     .speed = 500,
     .spin = 99,
     .still = 2},
    {.name = "minute",
     .form = SPACE_LAYERS,
     .count = 10,
     .grid = 1000,
     .reach = 250,
     .speed = 300,
     .spin = 99,
     .scale = -990},
    {.name = "huge",
     .form = SPACE_LAYERS,
     .count = 6,
     .grid = 1000,
     .reach = 250,
     .speed = 300,
     .spin = 99,
     .scale = 990},
    {.name = "curved",
     .form = SPACE_LAYERS,
     .count = 12,
     .grid = 1000,
     .reach = 200,
     .speed = 300,
     .spin = 99,
     .curved = true},
    {.name = "cubics",
     .form = SPACE_LAYERS,
     .count = 12,
     .grid = 1000,
     .reach = 200,
     .speed = 300,
     .spin = 99,
     .curved = true,
     .cubic = true},
    {.name = "lattice of cubics",
     .form = SPACE_LAYERS,
     .count = 8,
     .grid = 12,
     .reach = 6,
     .speed = 6,
     .spin = 4,
     .curved = true,
     .cubic = true,
     .legs = 2},
    {.name = "one", .form = SPACE_LAYERS, .count = 1, .grid = 1000, .reach = 300, .speed = 300, .spin = 900},
    {.name = "bouncing",
     .form = SPACE_LAYERS,
     .count = 10,
     .grid = 1000,
     .reach = 250,
     .speed = 300,
     .spin = 99,
     .legs = 4},
    {.name = "mortal",
     .form = SPACE_LAYERS,
     .count = 24,
     .grid = 1000,
     .reach = 200,
     .speed = 300,
     .spin = 99,
     .mortal = true},
    {.name = "offbeat",
     .form = SPACE_LAYERS,
     .count = 12,
     .grid = 1024,
     .reach = 256,
     .speed = 320,
     .spin = 64,
     .legs = 3,
     .offbeat = true},
    {.name = "offbeat sheets",
     .form = SPACE_SHEETS,
     .count = 36,
     .grid = 700,
     .reach = 160,
     .speed = 480,
     .spin = 32,
     .legs = 2,
     .offbeat = true},
    {.name = "mortal solids",
     .form = SPACE_TETRAHEDRA,
     .count = 32,
     .grid = 1000,
     .reach = 250,
     .speed = 600,
     .mortal = true},
    {.name = "mortal lattice",
     .form = SPACE_LAYERS,
     .count = 20,
     .grid = 12,
     .reach = 5,
     .speed = 4,
     .spin = 2,
     .mortal = true},
};
enum { SPACE_KINDS = sizeof space_kinds / sizeof *space_kinds };
#endif
