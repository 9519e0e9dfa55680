/* guard_sort.c: guards in the order of each axis, by stable sorts of the keys of doubles. */
#include "split/guard/guard_sort.h"
#include <string.h>

enum { SMALL = 48 }; /* pairs that insertion sorts faster */

/* Stably by the coordinate on an axis. */
static void sort_by(const double *points, size_t count, int dim, int axis, base_pair *order, base_pair *spare) {
    for (size_t i = 0; i < count; i++)
        order[i].key = base_double_key(points[order[i].value * (size_t)dim + (size_t)axis]);
    if (count > SMALL) base_radix_sort(order, spare, count);
    for (size_t i = 1; i < count && count <= SMALL; i++) {
        base_pair moving = order[i];
        size_t at = i;
        for (; at > 0 && order[at - 1].key > moving.key; at--) order[at] = order[at - 1];
        order[at] = moving;
    }
}

static bool has_ties(const base_pair *order, size_t count) {
    for (size_t i = 1; i < count; i++)
        if (order[i].key == order[i - 1].key) return true;
    return false;
}

void guard_sort(const double *points, size_t count, int dim, base_pair **order, base_pair *spare) {
    for (size_t i = 0; i < count; i++) order[0][i].value = (uint32_t)i;
    sort_by(points, count, dim, 0, order[0], spare);
    if (has_ties(order[0], count)) /* lexicographically, last coordinate first */
        for (int axis = dim - 1; axis >= 0; axis--) sort_by(points, count, dim, axis, order[0], spare);
    for (int axis = 1; axis < dim; axis++) {
        memcpy(order[axis], order[0], count * sizeof *order[0]);
        sort_by(points, count, dim, axis, order[axis], spare);
    }
}
