/* guarding.h: numbers of the guard stages of density trees of which nothing is refined. */
#ifndef FROE_BENCH_CLAIMS_GUARDING_H
#define FROE_BENCH_CLAIMS_GUARDING_H
#include "claims.h"
#include <froe/measure.h>

/* Ten kinds of scenes, of bounded density or not. */
#define GUARDED                                                                                                        \
    ("segments", "clusters", "nested", "lattice", "star", "parallel", "identical", "terrain", "cuboids", "nested-3d")

claims_value guarding_leaves;            /**< bare: of an octree that halves cubes and never shrinks them */
claims_value guarding_leaves_over_bound; /**< the same, over what the tree promises */
claims_value
    guarding_load_over_bound; /**< doubling: fullest cell over k + c_d density; bare: slabs in place of cubes */
claims_value guarding_clutter_over_density; /**< clutter over c_d density; bare: of slabs in place of cubes */
claims_value guarding_doubled;       /**< lambda at which doubling ends, over twice the density; bare: of slabs */
claims_measure guarding_leaves_by_k; /**< exponent in k, 1 to 64, of the leaves of nested; bare: of such an octree */
#endif
