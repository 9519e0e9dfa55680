/* standing.h: worlds that stand through all tests of a program. */
#ifndef FROE_TESTS_QUERY_STANDING_H
#define FROE_TESTS_QUERY_STANDING_H
#include "query/ranges.h"

static world worlds[16];
static size_t world_count;

static inline void standing_add(const char *name, froe_scene *scene, bool lattice) {
    worlds[world_count] = world_begin(name, scene);
    worlds[world_count++].lattice = lattice;
}

/** All kinds of objects, off lattices and on, and a floor plan. */
static inline int standing_begin(void **state) {
    const unsigned solids = FLAT_KINDS | SOLID_KINDS | 1 << FROE_HULL;
    (void)state;
    standing_add("segments", world_mixture(2, 1 << FROE_SEGMENT, 300, 0, 0.15, 1), false);
    standing_add("lattice", world_mixture(2, FLAT_KINDS, 80, 12, 0.4, 2), true);
    standing_add("solids in the plane", world_mixture(2, solids, 50, 0, 0.15, 3), false);
    standing_add("lattice of solids", world_mixture(2, solids, 30, 12, 0.4, 4), true);
    standing_add("polygons", world_mixture(3, 1 << FROE_POLYGON, 150, 0, 0.2, 5), false);
    standing_add("lattice in space", world_mixture(3, FLAT_KINDS | 1 << FROE_POLYGON, 40, 6, 0.6, 6), true);
    standing_add("solids in space", world_mixture(3, solids | 1 << FROE_POLYGON, 30, 0, 0.2, 7), false);
    standing_add("floor plan", world_read("freedoom-e1m1.geojson"), false);
    return 0;
}

static inline int standing_end(void **state) {
    (void)state;
    for (size_t i = 0; i < world_count; i++) world_end(&worlds[i]);
    return 0;
}
#endif
