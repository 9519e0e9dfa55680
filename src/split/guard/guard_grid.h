/* guard_grid.h: a cube in 2^levels slices on each axis, by the very planes that octree splits of it have.
 *
 *     slice   0   1   2   3   4   5   6   7       The code of a cell has dim bits a level, the first level highest,
 *           |   |   |   |   |   |   |   |   |     axis 0 first in each: cells of one octree cube have one prefix.
 *     level     3   2   3   1   3   2   3
 *
 * Comparisons with a table of planes decide where a point is; the product that finds the place in it is only a
 * guess. */
#ifndef FROE_SPLIT_GUARD_GUARD_GRID_H
#define FROE_SPLIT_GUARD_GUARD_GRID_H
#include "support/arithmetic.h"
#include <froe/froe.h>

enum { GUARD_LEVELS = 10, GUARD_CODE_BITS = 20, GUARD_CODE = (1 << 20) - 1 }; /* at most; dim * levels; its mask */

typedef struct guard_cube {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} guard_cube;

typedef struct guard_axis {
    double lo, scale; /* guess of a place: (x - lo) * scale */
    uint32_t last;    /* slice */
    double *bounds;   /* [slices + 2] lo, planes, hi, infinity */
    uint32_t *codes;  /* [slices] bits of the code */
    uint8_t *levels;  /* [slices] the level that splits at bounds[i], from 1 on; 0 for lo */
} guard_axis;

typedef struct guard_grid {
    int dim, levels;
    uint32_t slices, cells;            /* on an axis, in all */
    uint32_t starts[GUARD_LEVELS + 2]; /* of levels, in an array of the cells of all levels from 0 on */
    uint8_t level_of[GUARD_CODE_BITS]; /* [bits of a code, from the highest] levels that they make up */
    guard_axis axes[FROE_MAX_DIM];
} guard_grid;

/** The root cube of guards with this bounding box. */
void guard_root(const guard_cube *box, int dim, guard_cube *root);
bool guard_strictly_inside(const double *lo, const double *hi, const guard_cube *cube, int dim);

/** Levels for a few guards a cell and at most 2^bits_most cells; 1: a grid is not worth while. */
int guard_grid_levels(uint64_t guards, int dim, int bits_most);
/** Bytes that guard_grid_make() needs at `room`. */
size_t guard_grid_size(int dim, int levels);
/** levels >= 1. False when slices become so narrow that doubles cannot tell their planes apart. */
bool guard_grid_make(int dim, int levels, const guard_cube *cube, char *room, guard_grid *out);
/** Bounds of a cell of a level, and its middle planes (last level: none). */
void guard_grid_cell(const guard_grid *grid, int level, uint32_t code, guard_cube *cube, double *mid);

/** The slice of x, lo <= x <= hi: bounds[slice] <= x < bounds[slice + 1]. */
static inline uint32_t guard_slice(const guard_axis *t, double x) {
    double guess = (x - t->lo) * t->scale;
    uint32_t slice = (uint32_t)(guess < t->last ? guess : t->last);
    while (x < t->bounds[slice]) slice--;
    while (x >= t->bounds[slice + 1]) slice++;
    return slice;
}
/** Middle plane: exact enough to lie strictly inside whenever a double does, and without overflow. */
static inline double guard_middle(double lo, double hi) {
    return 0.5 * lo + 0.5 * hi;
}
/** Is the orthant of this code above on the axis? */
static inline bool guard_above(uint32_t code, int dim, int axis) {
    return code >> (dim - 1 - axis) & 1;
}
#endif
