/* guard_scenes.h: guards of all sorts for the tests of the guard tree. */
#ifndef FROE_TESTS_SPLIT_GUARD_SCENES_H
#define FROE_TESTS_SPLIT_GUARD_SCENES_H
#include "base/random.h"
#include <float.h>
#include <math.h>
#include <stddef.h>

typedef enum guard_scene {
    SCENE_UNIFORM,
    SCENE_CLUSTERS,
    SCENE_NESTED, /* sizes 2^-1000 .. 1 */
    SCENE_CHAIN,  /* half in one place, the others on the way to it */
    SCENE_LATTICE,
    SCENE_LINE, /* along axis 0 */
    SCENE_DIAGONAL,
    SCENE_COPIES, /* eight at each place, nearly */
    SCENE_COARSE, /* on few lines, which are middle planes */
    SCENE_ONE_PLACE,
    SCENE_HUGE, /* all finite doubles */
    SCENE_DENORMAL,
    SCENE_ULPS,   /* a few doubles wide, axes unlike */
    SCENE_FAR,    /* one axis far from the origin */
    SCENE_SHELLS, /* at distances from the root's corner that differ by rounding */
    SCENE_MIXED,  /* lattice, random and tiny coordinates */
    SCENE_COUNT
} guard_scene;

static inline double scene_unit(uint64_t seed, uint64_t counter) { /* in [0, 1) */
    return (double)(base_hash(seed, 1, counter) >> 11) * 0x1p-53;
}

/* Guards 0 and 1 make the root's lower corner known; distances are of a few sizes. */
static inline double scene_shell(uint64_t seed, size_t p, int axis, uint64_t at) {
    double lo = axis < 2 ? 0.1 : 0.05;
    uint64_t size = base_mix(at + seed) % 3 ? p % 4 : base_mix(at) % 16;
    return p < 2 ? lo + (double)p : 0.1 + 0.25 * scene_unit(seed, 1000 + size);
}

static inline double scene_mixed(uint64_t seed, uint64_t counter) {
    double choice = scene_unit(seed + 1, counter), x = scene_unit(seed, counter);
    if (choice < 0.3) return floor(4 * x);
    return choice < 0.6 ? x : ldexp(x, -(int)(40 * scene_unit(seed + 2, counter)));
}

/* One coordinate of guard p. `at` numbers coordinates. */
static inline double scene_coordinate(guard_scene scene, uint64_t seed, size_t count, size_t p, int axis, uint64_t at) {
    double x = scene_unit(seed, at), along = scene_unit(seed, p);
    uint32_t cluster = base_below(base_hash(seed, 2, p), 20),
             copy = base_below(base_hash(seed, 3, p), (uint32_t)count / 8 + 1);
    int side = (int)sqrt((double)count) + 1;
    switch (scene) {
    case SCENE_UNIFORM:
        return x;
    case SCENE_CLUSTERS:
        return scene_unit(seed + 1, 8 * cluster + (unsigned)axis) + 1e-6 * x;
    case SCENE_NESTED:
        return ldexp(x, -(int)(1000 * scene_unit(seed + 3, p)));
    case SCENE_CHAIN:
        return ldexp(x, p < count / 2 ? -1000 : -(int)(p % 999));
    case SCENE_LATTICE:
        return axis == 0 ? (double)((int)p % side) : axis == 1 ? floor((double)p / side) : floor(3 * x);
    case SCENE_LINE:
        return axis == 0 ? x : 0;
    case SCENE_DIAGONAL:
        return along;
    case SCENE_COPIES:
        if (p < 2) return (double)p; /* makes middle planes lattice planes */
        return floor(1024 * scene_unit(seed, 8 * (uint64_t)copy + (unsigned)axis)) / 1024;
    case SCENE_COARSE:
        return p < 2 ? (double)p : (53 * (4 + floor(9 * x)) - 168) / 512;
    case SCENE_ONE_PLACE:
        return p == 0 ? 0 : p == 1 ? 1 : 0.3;
    case SCENE_HUGE:
        return p == 0 ? -DBL_MAX : p == 1 ? DBL_MAX : (x - 0.5) * 2 * (DBL_MAX / 1.1);
    case SCENE_DENORMAL:
        return DBL_TRUE_MIN * floor(200 * x);
    case SCENE_ULPS:
        return 1 + DBL_EPSILON * floor(100 * (axis + 1) * x);
    case SCENE_FAR:
        return (axis == 0 ? 0x1p50 : 0) + (axis == 0 ? floor(8 * x) / 4 : 2 * x);
    case SCENE_SHELLS:
        return scene_shell(seed, p, axis, at);
    default:
        return scene_mixed(seed, at);
    }
}

static inline void scene_fill(guard_scene scene, uint64_t seed, double *guards, size_t count, int dim) {
    for (size_t p = 0; p < count; p++)
        for (int i = 0; i < dim; i++, guards++)
            *guards = scene_coordinate(scene, seed, count, p, i, p * (size_t)dim + (size_t)i);
}
#endif
