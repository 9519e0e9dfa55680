/* guard_shrink.c: the exact shrink rule, and the shrink step on heaps.
 *
 *     +-----------------+   corner v with nearly all guards; the guards farthest from v on some
 *     |            p    |   axis are peeled off, `kill` of them. The last one, p, gives the size s
 *     +-------------+   |   of the inner cube and lies exactly on its plane. The other planes are
 *     | . .         |   |   v + s, rounded, but moved to where they separate what was peeled on their
 *     |:. ..        |   |   axis from what was not.
 *     v-------------+---+
 *
 * Why no guard ends up a rounding error beyond a plane: what was peeled on axis i is at least as far on
 * axis i, in exact coordinates, as all that is left, so there is a place for the plane between them.
 * p itself is not beyond the plane of an axis i before its own: either a guard peeled on i bounds
 * it, or its distance on i is smaller than s by a rounding unit at least (ties go to the lowest axis). So
 * p lies on its plane when the slabs of form U come to it, at most kill - 1 guards are strictly outside,
 * and at least kill of them not strictly inside. */
#include "split/guard/guard_shrink.h"
#include <string.h>

/* Where axis i is cut: v +- s between the farthest guard left and the nearest one peeled on i. */
static double place_between(double at, const double *left, const double *peeled, bool above) {
    if (left && (above ? *left < at : *left > at)) at = *left;
    if (peeled && (above ? *peeled > at : *peeled < at)) at = *peeled;
    return at;
}

void guard_shrink_rule(const guard_cube *cube, int dim, uint32_t corner, uint32_t kill, guard_peeler *peeler,
                       guard_shrunk *out) {
    double nearest[FROE_MAX_DIM], size = 0;
    bool peeled[FROE_MAX_DIM] = {false};
    int last = -1;
    for (uint32_t n = 0; n < kill; n++) {
        double value = 0;
        /* peels one guard: the farthest on an axis with the largest rounded distance */
        int best = -1;
        for (int i = 0; i < dim; i++) {
            const double *point = peeler->farthest(peeler, i);
            if (!point) continue;
            double far = guard_above(corner, dim, i) ? cube->hi[i] - point[i] : point[i] - cube->lo[i];
            if (best >= 0 && far <= size) continue;
            best = i;
            size = far;
            value = point[i];
        }
        if (best >= 0) peeler->peel(peeler, best);
        int axis = best;
        if (axis < 0) break;
        peeled[axis] = true;
        nearest[axis] = value;
        last = axis;
    }
    *out = (guard_shrunk){.cube = *cube};
    for (int i = 0; i < dim; i++) {
        bool above = guard_above(corner, dim, i);
        const double *left = peeler->farthest(peeler, i);
        double at = place_between(above ? cube->hi[i] - size : cube->lo[i] + size, left ? left + i : NULL,
                                  peeled[i] ? nearest + i : NULL, above);
        if (i == last) at = nearest[i];
        if (!(cube->lo[i] < at && at < cube->hi[i])) continue; /* rounding made the cube this flat */
        out->axes[out->count] = (uint8_t)i;
        out->values[out->count++] = at;
        out->inner = 2 * out->inner + above;
        *(above ? &out->cube.lo[i] : &out->cube.hi[i]) = at;
    }
}

froe_status guard_shrink_nodes(guard_worker *w, const guard_item *item, const guard_shrunk *shrunk, uint32_t *inner) {
    uint32_t below = item->height + (uint32_t)shrunk->count;
    if (below > w->height) w->height = below;
    w->shrinks++;
    if (w->plan->form == SPLIT_FORM_U)
        return guard_slabs(w, item->node, shrunk->count, shrunk->axes, shrunk->values, shrunk->inner, inner);
    uint32_t first;
    froe_status status = guard_cross(w, item->node, shrunk->count, shrunk->axes, shrunk->values, &first);
    *inner = first + shrunk->inner;
    return status;
}

/* ---- the step: a heap per axis yields the farthest guard */

typedef struct heaps {
    guard_peeler peeler;
    const double *points;
    int dim;
    uint32_t corner;
    uint32_t *heap[FROE_MAX_DIM], count[FROE_MAX_DIM];
    bool *peeled; /* [guard] */
} heaps;

/* Is guard a farther than b on the axis? Of guards at one place neither is. */
static bool farther(const heaps *h, uint32_t a, uint32_t b, int axis) {
    const double *x = h->points + (size_t)a * (size_t)h->dim, *y = h->points + (size_t)b * (size_t)h->dim;
    bool above = guard_above(h->corner, h->dim, axis);
    if (x[axis] != y[axis]) return (x[axis] < y[axis]) == above;
    for (int i = 0; i < h->dim; i++)
        if (x[i] != y[i]) return (x[i] < y[i]) == above;
    return false;
}

static void sift_down(heaps *h, int axis, uint32_t at) {
    uint32_t *heap = h->heap[axis], count = h->count[axis], moving = heap[at];
    for (uint32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && farther(h, heap[child + 1], heap[child], axis)) child++;
        if (!farther(h, heap[child], moving, axis)) break;
        heap[at] = heap[child];
    }
    heap[at] = moving;
}

static const double *heap_farthest(guard_peeler *self, int axis) {
    heaps *h = (heaps *)self;
    uint32_t *heap = h->heap[axis];
    while (h->count[axis] && h->peeled[heap[0]]) {
        heap[0] = heap[--h->count[axis]];
        if (h->count[axis]) sift_down(h, axis, 0);
    }
    return h->count[axis] ? h->points + (size_t)heap[0] * (size_t)h->dim : NULL;
}

static void heap_peel(guard_peeler *self, int axis) {
    heaps *h = (heaps *)self;
    h->peeled[h->heap[axis][0]] = true;
}

froe_status guard_shrink(guard_worker *w, const guard_item *item, const guard_cube *cube, uint32_t corner) {
    int dim = w->plan->dim;
    uint32_t *room = guard_scratch(w, item->count * ((size_t)dim * sizeof *room + sizeof(bool))), inner;
    if (!room) return FROE_E_MEMORY;
    heaps h = {.peeler = {heap_farthest, heap_peel}, .points = guard_points(w, item), .dim = dim, .corner = corner};
    guard_shrunk shrunk;
    h.peeled = memset(room + (size_t)dim * item->count, 0, item->count);
    for (int i = 0; i < dim; i++) {
        h.heap[i] = room + (size_t)i * item->count;
        h.count[i] = item->count;
        for (uint32_t p = 0; p < item->count; p++) h.heap[i][p] = p;
        for (uint32_t at = item->count / 2; at-- > 0;) sift_down(&h, i, at);
    }
    guard_shrink_rule(cube, dim, corner, w->plan->kill, &h.peeler, &shrunk);
    froe_status status = guard_shrink_nodes(w, item, &shrunk, &inner);
    if (status) return status;
    guard_item part = {.node = inner,
                       .height = item->height + (uint32_t)shrunk.count,
                       .begin = item->begin,
                       .side = guard_other_side(item->side)};
    /* the guards strictly inside move to the other side, the others are counted in the leaves outside */
    const size_t size = (size_t)dim;
    const double *points = guard_points(w, item);
    double *to = w->side[guard_other_side(item->side)] + item->begin * size;
    for (uint32_t p = 0; p < item->count; p++, points += size) {
        bool inside = true;
        for (int c = 0; c < shrunk.count; c++) {
            int i = shrunk.axes[c];
            inside &= shrunk.cube.lo[i] < points[i] && points[i] < shrunk.cube.hi[i];
        }
        memcpy(to + part.count * size, points, size * sizeof *to);
        part.count += inside;
        if (!inside && w->plan->kill > 1) guard_count(w, item->node, points, inner);
    }
    return guard_push(w, item, &part, &shrunk.cube);
}
