/* directions.c: the tables, axes first. */
#include "build/bar/directions.h"
#include <math.h>

static const double plane[4][3] = {{1, 0, 0}, {0, 1, 0}, {1, -1, 0}, {1, 1, 0}};
static const double space[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};

bool split_directions_of(int dim, int count, split_directions *out) {
    if (!(dim == 2 && (count == 3 || count == 4)) && !(dim == 3 && count == 7)) return false;
    *out = (split_directions){.dim = dim, .count = count, .normals = dim == 2 ? plane : space};
    for (int i = 0; i < count; i++) out->lengths[i] = i < dim ? 1 : sqrt(dim);
    return true;
}

froe_cut split_directions_cut(const split_directions *d, int i, double value) {
    if (i < d->dim) return (froe_cut){.kind = FROE_CUT_AXIS, .axis = i, .value = value};
    return (froe_cut){.kind = FROE_CUT_PLANE, .value = value, .normal = d->normals[i]};
}

int split_direction_of(const split_directions *d, const froe_cut *cut) {
    if (cut->kind == FROE_CUT_AXIS) return cut->axis;
    for (int i = d->dim; i < d->count && cut->kind == FROE_CUT_PLANE; i++)
        if (cut->normal == d->normals[i]) return i;
    return -1;
}
