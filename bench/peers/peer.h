/* peer.h: what a program does to take part in bench_race: one shared object, opened at run time, with a table of
 * functions. froe takes part by such a table, too.
 *
 * A peer gets the caller's arrays and makes of them what it answers from; it gets questions in arrays, and writes the
 * answers into others. What it needs in between, such as boxes of its own type, is its cost. */
#ifndef FROE_BENCH_PEERS_PEER_H
#define FROE_BENCH_PEERS_PEER_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------------- scenes -- */

/** Corners of an object: 1, 2, 2, 3, 2 (lowest and highest); areas are rings of segments. */
typedef enum peer_kind {
    PEER_POINTS,
    PEER_SEGMENTS,
    PEER_TRAPEZOIDS, /**< segments, of which every program makes a map of trapezoids */
    PEER_TRIANGLES,
    PEER_BOXES,
    PEER_AREAS,
    PEER_KINDS
} peer_kind;

/** Polygons that do not overlap, each of one area, which may have several. */
typedef struct peer_map {
    double *points;   /**< x, y */
    size_t *rings;    /**< ring i: points rings[i] .. rings[i+1] - 1, the first not repeated */
    size_t *polygons; /**< polygon i: rings polygons[i] .. polygons[i+1] - 1, the first around the others */
    uint32_t *areas;  /**< [polygon] */
    size_t ring_count, polygon_count;
} peer_map;

/** What a caller has. It stays where it is until the peer has freed what it made of it. */
typedef struct peer_data {
    peer_kind kind;
    int dim;
    size_t count;         /**< objects: of areas, segments */
    const double *coords; /**< dim numbers a corner. Segments of the plane: whole, 0 .. 2^30, the left end first */
    bool disjoint;        /**< no two segments meet; of areas: only in common corners, and common borders are equal */
    /* of areas: */
    const peer_map *map;
    size_t areas;
    const uint32_t *groups, *faces; /**< [segment]: its area, its polygon */
} peer_data;

/* ----------------------------------------------------------------- questions -- */

typedef enum peer_work {
    PEER_WINDOW,    /**< lo, hi: which objects meet the closed box? */
    PEER_BALL,      /**< centre, radius, 0: which objects meet the closed ball? */
    PEER_FUZZY,     /**< centre, radius, margin: all objects within the radius, none beyond radius + margin */
    PEER_ABOVE,     /**< point: the first segment on the ray upwards, -1 for none */
    PEER_NEAREST,   /**< point: the distance of the nearest object */
    PEER_NEAREST_K, /**< point: the distances of the k nearest objects, in order */
    PEER_FIRST_HIT, /**< a ray: the parameter of the first hit, infinity for none */
    PEER_ANY_HIT,   /**< a ray: 1 if anything is hit, or 0 */
    PEER_AREA,      /**< point: the number of the area, -1 for none */
    PEER_PAIRS,     /**< no numbers: how many pairs of objects meet, and a sum over these: peer_pair() */
    PEER_WORKS
} peer_work;

typedef struct peer_questions {
    peer_work work;
    size_t count, width;      /**< numbers a question */
    const double *numbers;    /**< [count * width]; of rays: origins */
    const double *directions; /**< of rays: as many */
    size_t k;                 /**< of PEER_NEAREST_K; otherwise 1 */
    bool together;            /**< all in one call, where the library has such a call; otherwise one by one */
} peer_questions;

/** Lists of objects (windows and balls) or numbers (all others), with room for these, kept from call to call. */
typedef struct peer_answers {
    double *values; /**< [count * k], PEER_PAIRS: [2] */
    uint32_t *ids;
    size_t *ends; /**< [count]: where the list of each question ends */
    size_t used, room;
    uint32_t *given; /**< instead of ids: an array of the library's, which is let go of; NULL otherwise */
    void *owner;     /**< of that */
    void (*let_go)(void *owner);
} peer_answers;

static inline void peer_room(peer_answers *a, size_t more) {
    if (a->room - a->used >= more) return;
    a->room = 2 * a->room + more;
    a->ids = (uint32_t *)realloc(a->ids, a->room * sizeof *a->ids);
    if (!a->ids) exit(1);
}

static inline void peer_put(peer_answers *a, uint32_t id) {
    peer_room(a, 1);
    a->ids[a->used++] = id;
}

static inline void peer_let_go(peer_answers *a) {
    if (a->given) a->let_go(a->owner);
    a->given = NULL;
}

/** One more pair of values[0], and its share of the sum of values[1]: whole numbers, exact in doubles. */
static inline void peer_pair(double values[2], uint32_t a, uint32_t b) {
    values[0] += 1;
    values[1] += (double)(((a ^ b) * 2654435761u ^ (a + b) * 2246822519u) >> 12);
}

/* --------------------------------------------------------------------- peers -- */

typedef struct peer {
    const char *name; /**< as the tables have it */
    const char *what; /**< which part of the library, and how it is set */
    double tolerance; /**< of its numbers, as a share of the size of the scene; 0: that of doubles */
    bool own_names;   /**< its numbers of areas are its own: equal wherever those of froe are equal */
    bool (*serves)(const peer_data *data, peer_work work);
    void *(*make)(const peer_data *data, const struct peer *self);
    void (*free)(void *index);
    void (*answer)(void *index, const peer_questions *questions, peer_answers *out);
    size_t (*bytes)(void *index); /**< NULL: by what is resident. Of froe: those of the tree alone */
    /** Seconds of processor time of the parts of making: taking the objects in, and the rest. NULL: not known. */
    void (*steps)(void *index, double seconds[2]);
    const void *own; /**< the peer's */
} peer;

/** What a shared object exports: its peer i, NULL after the last. */
typedef const peer *peer_list(size_t i);
#ifdef __cplusplus
#define PEER_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define PEER_EXPORT __attribute__((visibility("default")))
#endif
PEER_EXPORT const peer *peer_at(size_t i);

#ifdef __cplusplus
}
#endif
#endif
