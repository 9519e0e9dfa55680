/* guard_grid.c: the tables of a grid. */
#include "split/guard/guard_grid.h"
#include <float.h>
#include <math.h>

enum {
    COUNT_2D = 2048, /* fewer guards go one level at a time ... */
    COUNT = 1 << 16, /* ... and above the plane all but those that threads may share */
    TARGET = 16      /* guards a cell, roughly, where there may be so many cells */
};
static const double PAD = 0.328125; /* 21/64 */

/* The bounding box as a cube, grown by a third of its edge all around: enough to have all guards strictly inside, and
 * no simple fraction, so that middle planes do not meet the lines on which flat scenes lie. */
void guard_root(const guard_cube *box, int dim, guard_cube *root) {
    double edge = 0;
    for (int i = 0; i < dim; i++)
        if (box->hi[i] - box->lo[i] > edge) edge = box->hi[i] - box->lo[i];
    if (edge == 0) edge = 1;
    double pad = edge * PAD > 0 ? edge * PAD : edge;
    bool fits = true;
    for (int i = 0; i < dim; i++) {
        root->lo[i] = box->lo[i] - pad;
        root->hi[i] = root->lo[i] + (pad + edge + pad);
        fits = fits && isfinite(root->lo[i]) && isfinite(root->hi[i]);
    }
    for (int i = 0; i < dim && !fits; i++) {
        root->lo[i] = -DBL_MAX;
        root->hi[i] = DBL_MAX;
    }
}

bool guard_strictly_inside(const double *lo, const double *hi, const guard_cube *cube, int dim) {
    for (int i = 0; i < dim; i++)
        if (!(cube->lo[i] < lo[i] && hi[i] < cube->hi[i])) return false;
    return true;
}

int guard_grid_levels(uint64_t guards, int dim, int bits_most) {
    int bits = 0;
    if (guards < (dim == 2 ? COUNT_2D : COUNT)) return 1;
    while (bits < bits_most && guards >> (bits + 1) >= TARGET) bits++;
    return bits / dim;
}

/* Bits of a slice, spread to the bits of the code. */
static uint32_t spread_bits(uint32_t slice, int dim, int axis, int levels) {
    uint32_t code = 0;
    for (int bit = 0; bit < levels; bit++) code |= (slice >> bit & 1) << (dim * bit + dim - 1 - axis);
    return code;
}

static size_t axis_size(int levels) {
    size_t slices = (size_t)1 << levels;
    return (slices + 2) * sizeof(double) + slices * sizeof(uint32_t) + (slices + 7) / 8 * 8;
}

size_t guard_grid_size(int dim, int levels) {
    return (size_t)dim * axis_size(levels);
}

bool guard_grid_make(int dim, int levels, const guard_cube *cube, char *room, guard_grid *out) {
    *out = (guard_grid){.dim = dim, .levels = levels, .slices = 1u << levels, .cells = 1u << (dim * levels)};
    for (int bit = 0; bit < dim * levels; bit++) out->level_of[bit] = (uint8_t)(bit / dim);
    for (int level = 0; level <= levels; level++) out->starts[level + 1] = out->starts[level] + (1u << (dim * level));
    for (int axis = 0; axis < dim; axis++, room += axis_size(levels)) {
        guard_axis *t = &out->axes[axis];
        t->lo = cube->lo[axis];
        t->scale = out->slices / (cube->hi[axis] - cube->lo[axis]);
        t->last = out->slices - 1;
        t->bounds = (double *)(void *)room;
        t->codes = (uint32_t *)(void *)(t->bounds + out->slices + 2);
        t->levels = (uint8_t *)(t->codes + out->slices);
        for (uint32_t i = 0; i < out->slices; i++) {
            t->codes[i] = spread_bits(i, dim, axis, levels);
            t->levels[i] = (uint8_t)(i ? levels - __builtin_ctz(i) : 0);
        }
        /* middles of middles, as long as doubles tell them apart */
        t->bounds[0] = cube->lo[axis];
        t->bounds[out->slices] = cube->hi[axis];
        t->bounds[out->slices + 1] = INFINITY;
        for (uint32_t step = out->slices; step > 1; step /= 2)
            for (uint32_t i = step / 2; i < out->slices; i += step)
                t->bounds[i] = guard_middle(t->bounds[i - step / 2], t->bounds[i + step / 2]);
        for (uint32_t i = 0; i < out->slices; i++)
            if (!(t->bounds[i] < t->bounds[i + 1])) return false;
    }
    return true;
}

void guard_grid_cell(const guard_grid *grid, int level, uint32_t code, guard_cube *cube, double *mid) {
    uint32_t width = grid->slices >> level;
    for (int i = 0; i < grid->dim; i++) {
        uint32_t place = 0;
        for (int bit = level; bit-- > 0;) place = 2 * place + guard_above(code >> (grid->dim * bit), grid->dim, i);
        const double *bounds = grid->axes[i].bounds + place * (size_t)width;
        cube->lo[i] = bounds[0];
        cube->hi[i] = bounds[width];
        mid[i] = bounds[width / 2];
    }
}
