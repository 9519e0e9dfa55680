/* exact_world.h: all objects of a world for the oracle in whole numbers. */
#ifndef FROE_TESTS_QUERY_EXACT_WORLD_H
#define FROE_TESTS_QUERY_EXACT_WORLD_H
#include "oracle/bodies.h"
#include "query/worlds.h"
#include "support/sanitized.h"

enum { EXACT_SHARE = SANITIZED_SHARE(8) };

/** The shift that makes a world whole. */
static inline int exact_world_shift(const world *w) {
    int shift = exact_shift(0, w->origin, FROE_MAX_DIM);
    for (uint32_t i = 0; i < froe_scene_vertex_count(w->scene); i++)
        shift = exact_shift(shift, froe_scene_vertex(w->scene, i), (size_t)w->dim);
    for (uint32_t i = 0; i < w->count; i++) {
        const double r = froe_scene_object(w->scene, i).radius;
        shift = exact_shift(shift, &r, 1);
    }
    return shift;
}

/** Begins a case with all objects in `bodies`. */
static inline void exact_world_begin(const world *w, int shift, exact_body *bodies) {
    exact_begin(shift);
    for (uint32_t i = 0; i < w->count; i++) {
        const geom_body b = scene_body(w->scene, i);
        bodies[i] = exact_body_of(&b);
    }
}
#endif
