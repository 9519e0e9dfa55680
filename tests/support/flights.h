/* flights.h: motions of rigid bodies that fly and turn, of many kinds, from integers; partitions follow them on
 * parabolas (froe_motion_without_bodies()). */
#ifndef FROE_TESTS_SUPPORT_FLIGHTS_H
#define FROE_TESTS_SUPPORT_FLIGHTS_H
#include "kinetic/space.h"
#include <math.h>

enum { FLIGHT_BODIES = 24, FLIGHT_KEYS = 4, FLIGHT_CORNERS = 8, FLIGHT_RADIUS = 160 };

typedef struct flight_kind {
    const char *name;
    int corners, faces; /* 4 and 4: tetrahedra; 8 and 12: boxes; fewer faces leave a body open */
    int count, grid;
    double deviation;
    bool straight; /* they do not turn */
    bool mortal;   /* faces come and go */
    bool quarters; /* boxes with upright faces, which turn by quarters about x, y or z from one key to the next, so that
                      much coincides (space_counts.blurs) */
    bool still;    /* they turn where they are */
} flight_kind;

/* A quaternion of length 1 but for rounding, within some 75 degrees of the one before, or a quarter away. */
static inline void flight_turn(fuzz_source *r, const flight_kind *kind, const double *before, double q[4]) {
    double square = 0;
    const int axis = fuzz_int(r, 0, 2), i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (int k = 0; k < 4; k++) q[k] = kind->quarters ? (before ? before[k] : k == 3) : 0;
    if (kind->quarters && before) { /* the product with (1 + axis) / sqrt 2 */
        q[3] = before[3] - before[axis], q[axis] = before[axis] + before[3];
        q[i] = before[i] + before[j], q[j] = before[j] - before[i];
    }
    for (int k = 0; k < 4; k++) {
        if (!kind->quarters) q[k] = 0.7 * fuzz_unit(r) + (before ? 1.4 * before[k] : k == 3);
        square += q[k] * q[k];
    }
    for (int k = 0; k < 4; k++) q[k] /= sqrt(square);
}

/* A body in a ball around a way that is straight, or leads there by parabolas whose control points are on it. */
static inline uint32_t flight_add(froe_motion *m, fuzz_source *r, const flight_kind *kind, const int at[3],
                                  const int to[3]) {
    double times[FLIGHT_KEYS] = {0, 17.3, 40.1, SPACE_WINDOW}, places[3 * FLIGHT_KEYS], controls[3 * FLIGHT_KEYS],
           turns[4 * FLIGHT_KEYS];
    for (size_t i = 0; i < FLIGHT_KEYS; i++) {
        const double share = times[i] / SPACE_WINDOW, later = i + 1 < FLIGHT_KEYS ? times[i + 1] / SPACE_WINDOW : 1;
        for (int k = 0; k < 3; k++) {
            places[3 * i + (size_t)k] = at[k] + share * (to[k] - at[k]);
            controls[3 * i + (size_t)k] = at[k] + (0.4 * share + 0.6 * later) * (to[k] - at[k]);
        }
        flight_turn(r, kind, i ? turns + 4 * i - 4 : NULL, turns + 4 * i);
    }
    froe_body body = froe_body_defaults();
    uint32_t id;
    body.count = FLIGHT_KEYS, body.times = times, body.coords = places, body.turns = kind->straight ? NULL : turns;
    body.controls = fuzz_int(r, 0, 1) && !kind->straight ? controls : NULL;
    if (froe_motion_add_body(m, &body, &id, NULL)) abort();
    return id;
}

static inline void flight_add_faces(froe_motion *m, fuzz_source *r, const flight_kind *kind, uint32_t body) {
    static const uint32_t tetrahedron[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    static const uint32_t box[36] = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                     2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    const double zeros[FLIGHT_CORNERS] = {0};
    double at[3 * FLIGHT_CORNERS], births[12], deaths[12];
    uint64_t tags[12];
    size_t starts[FLIGHT_CORNERS + 1];
    uint32_t bodies[FLIGHT_CORNERS];
    for (int c = 0; c < kind->corners; c++) {
        starts[c] = (size_t)c, bodies[c] = body;
        for (int k = 0; k < 3; k++) /* boxes reach as far as their ball */
            at[3 * c + k] =
                kind->corners == 8 ? (c >> k & 1 ? 0.57 : -0.57) * FLIGHT_RADIUS : 0.57 * FLIGHT_RADIUS * fuzz_unit(r);
    }
    starts[kind->corners] = (size_t)kind->corners;
    for (int i = 0; i < kind->faces; i++) {
        births[i] = kind->mortal ? fuzz_int(r, -20, 70) : 0;
        deaths[i] = kind->mortal ? births[i] + fuzz_int(r, 0, 40) : SPACE_WINDOW;
        tags[i] = 1000 * (uint64_t)body + (uint64_t)i;
    }
    froe_moving b = froe_moving_defaults();
    if (froe_motion_add_group(m, &(froe_group){.name = "body"}, &b.group)) abort();
    b.vertex_count = (size_t)kind->corners, b.count = (size_t)kind->faces, b.starts = starts, b.times = zeros;
    b.coords = at, b.vertices = kind->corners == 8 ? box : tetrahedron, b.bodies = bodies;
    b.births = births, b.deaths = deaths, b.tags = tags;
    if (froe_motion_add(m, &b, NULL)) abort();
}

/** Bodies that keep apart. The caller frees them. */
static inline froe_motion *flight_new(const flight_kind *kind, uint64_t seed) {
    int ways[FLIGHT_BODIES][2][3], made = 0;
    space_data *d = calloc(1, sizeof *d);
    froe_motion_options w = froe_motion_defaults();
    froe_motion *m;
    if (!d) abort();
    d->random.state = seed;
    w.dim = 3, w.begin = 0, w.end = SPACE_WINDOW, w.tick = 0x1p-16;
    if (froe_motion_new(&w, NULL, &m, NULL)) abort();
    for (int tries = 0; made < kind->count; tries++) {
        bool apart = true;
        if (tries == 1000) tries = made = 0; /* there may be no room left */
        for (int k = 0; k < 3; k++) {
            ways[made][0][k] = fuzz_int(&d->random, 0, kind->grid);
            ways[made][1][k] = kind->still ? ways[made][0][k] : fuzz_int(&d->random, 0, kind->grid);
        }
        for (int i = 0; i < made; i++) /* in time they may be elsewhere on their ways */
            apart &= space_are_apart(ways[made][0], ways[made][1], ways[i][0], ways[i][1], 2.6 * FLIGHT_RADIUS);
        made += apart;
    }
    for (int i = 0; i < made; i++)
        flight_add_faces(m, &d->random, kind, flight_add(m, &d->random, kind, ways[i][0], ways[i][1]));
    free(d);
    return m;
}

/** All kinds that partitions are tested with. */
static const flight_kind flight_kinds[] = {
    {.name = "turning", .corners = 4, .faces = 4, .count = 6, .grid = 700, .deviation = 1},
    {.name = "turning boxes", .corners = 8, .faces = 12, .count = 3, .grid = 700, .deviation = 1},
    {.name = "mortal turning", .corners = 4, .faces = 4, .count = 6, .grid = 700, .deviation = 1, .mortal = true},
    {.name = "fine turning", .corners = 4, .faces = 4, .count = 6, .grid = 700, .deviation = 0x1p-10},
    {.name = "coarse turning", .corners = 8, .faces = 12, .count = 4, .grid = 800, .deviation = 16},
    {.name = "quarter turns", .corners = 8, .faces = 12, .count = 3, .grid = 700, .deviation = 1, .quarters = true},
    {.name = "turning there",
     .corners = 8,
     .faces = 12,
     .count = 6,
     .grid = 1200,
     .deviation = 1,
     .still = true,
     .quarters = true},
    {.name = "open turning", .corners = 4, .faces = 2, .count = 12, .grid = 1200, .deviation = 1},
    {.name = "many turning", .corners = 4, .faces = 4, .count = 12, .grid = 1400, .deviation = 2},
    {.name = "flying bodies", .corners = 8, .faces = 12, .count = 4, .grid = 800, .deviation = 1, .straight = true},
};
enum { FLIGHT_KINDS = sizeof flight_kinds / sizeof *flight_kinds };

/** A motion of a kind on parabolas. */
static inline froe_motion *flight_on_parabolas(const flight_kind *kind, uint64_t seed, double *reached) {
    froe_motion *m = flight_new(kind, seed), *out = NULL;
    if (froe_motion_without_bodies(m, kind->deviation, NULL, &out, reached, NULL)) abort();
    froe_motion_free(m);
    return out;
}
#endif
