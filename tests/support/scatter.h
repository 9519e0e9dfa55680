/* scatter.h: objects anywhere or on a lattice, for tests and fuzzers. */
#ifndef FROE_TESTS_SUPPORT_SCATTER_H
#define FROE_TESTS_SUPPORT_SCATTER_H
#include "base/random.h"
#include <froe/froe.h>

/** A whole number in 0 .. n-1. */
static inline uint32_t trees_random(uint64_t seed, uint64_t counter, uint32_t n) {
    return base_below(base_hash(seed, 77, counter), n);
}
/** A double in [0, 1). */
static inline double trees_unit(uint64_t seed, uint64_t counter) {
    return (double)(base_hash(seed, 78, counter) >> 11) * 0x1p-53;
}

static inline froe_status trees_add(froe_scene *scene, froe_kind kind, size_t count, const double *coords,
                                    const double *radii, const size_t *starts) {
    froe_objects o = froe_objects_defaults();
    o.kind = kind;
    o.count = count;
    o.coords = coords;
    o.radii = radii;
    o.starts = starts;
    return froe_scene_add(scene, &o, NULL);
}

/** `count` objects of one kind on a lattice of `grid` steps a side (0: anywhere in the unit cube), each of extent about
 * `size`. Lattices make them meet, touch, repeat and degenerate. */
static inline froe_status trees_scatter(froe_scene *scene, froe_kind kind, size_t count, uint32_t grid, double size,
                                        uint64_t seed) {
    enum { CORNERS = 3 };
    size_t dim = (size_t)froe_scene_dim(scene);
    size_t corners = kind == FROE_POINT || kind == FROE_BALL    ? 1
                     : kind == FROE_SEGMENT || kind == FROE_BOX ? 2
                                                                : CORNERS;
    double coords[CORNERS * FROE_MAX_DIM], radius;
    const size_t starts[2] = {0, corners};
    froe_status status = FROE_OK;
    uint64_t draw = 0;
    for (size_t i = 0; i < count && !status; i++) {
        for (size_t k = 0; k < dim; k++) {
            double centre = trees_unit(seed, draw++);
            for (size_t c = 0; c < corners; c++) {
                double x = centre + (corners > 1 ? size * (trees_unit(seed, draw++) - 0.5) : 0);
                coords[c * dim + k] = grid ? (double)(int)(x * grid) : x;
            }
            if (kind == FROE_BOX && coords[k] > coords[dim + k]) {
                double swap = coords[k];
                coords[k] = coords[dim + k];
                coords[dim + k] = swap;
            }
        }
        radius = size * 0.5 * trees_unit(seed, draw++);
        if (grid) radius = (double)(int)(radius * grid);
        status =
            trees_add(scene, kind, 1, coords, kind == FROE_BALL ? &radius : NULL, kind == FROE_HULL ? starts : NULL);
    }
    return status;
}
#endif
