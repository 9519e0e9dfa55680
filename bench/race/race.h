/* race.h: froe and other programs answer the same questions in one process, in turns. */
#ifndef FROE_BENCH_RACE_H
#define FROE_BENCH_RACE_H
#include "peers/peer.h"

/* Of questions; of making; contestants; questions that are asked to find the size of a range. */
enum { RACE_ROUNDS = 9, RACE_MAKES = 5, RACE_MOST = 12, RACE_SAMPLE = 200 };

/** Objects in arrays, and where they lie. */
typedef struct race_scene {
    char name[32];
    peer_data data;
    double *coords;
    uint32_t *groups, *faces; /* of areas: of each segment */
    peer_map map;
    double lo[3], hi[3], size; /* the longest side */
    bool near;                 /* questions lie near objects, not anywhere */
} race_scene;

/** A kind of scene, of about n objects, or a file: its first n objects, or as many copies of it side by side as have n.
 * n = 0: the file as it is. Exits on failure. */
race_scene race_scene_make(peer_kind kind, const char *name, size_t n);
void race_scene_free(race_scene *scene);
/** Makers of kinds, by a state of bench_unit(): coords and data, but for kind and coords. */
void race_make_segments(race_scene *scene, const char *name, size_t n, uint64_t *state);
void race_make_triangles(race_scene *scene, const char *name, size_t n, uint64_t *state);
void race_make_areas(race_scene *scene, const char *name, size_t n, uint64_t *state);
peer_data race_data(const race_scene *scene); /**< points into it */
size_t race_corners(peer_kind kind);
void race_direction(uint64_t *state, double d[3]); /**< of length 1 */
/** froe as a contestant: METHOD[/LEAF][@THREADS][+KERNELS], e.g. index, kd/32, index@4, index+plain. `plain`: the
 * ordinary way, which needs no name. */
peer *race_froe(const char *spec, bool plain);
void race_froe_free(peer *froe);

/** What is asked: `width` numbers a question. */
typedef struct race_task {
    const char *name;
    peer_work work;
    size_t share, width, k;
    double wanted;                /* objects to be found, on average */
    double eps;                   /* of PEER_FUZZY: the margin by the radius */
    double *numbers, *directions; /* 2 RACE_ROUNDS shares; directions of rays, or NULL */
} race_task;

typedef struct race_contestant {
    const peer *peer;
    void *index;
} race_contestant;

/** Draws the questions of a task; the first contestant finds out how large windows and balls are. */
void race_ask(race_task *task, const race_scene *scene, const race_contestant *first, peer_answers *room);

/** What answers are compared by: one number a question, or k. */
void race_digest(const race_scene *scene, const peer_questions *asked, const peer_answers *found, double *out);
/** How many answers of `other` differ from those of froe. */
size_t race_differ(const race_scene *scene, const race_task *task, const peer *other, const double *froe,
                   const double *its, size_t count);
#endif
