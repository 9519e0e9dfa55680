/* near_walk.c: best first (Hjaltason and Samet: Distance browsing in spatial databases, 1999), with distances kept
 * by axes (Arya and Mount: Algorithms for fast vector quantization, 1993).
 *
 *         q  |  far     From the nearest place on the heap the walk goes down to q's side of every cut, whose region
 *      near  |          is not further away, and leaves the other side behind with a bound: what is missing on the
 *            cut        axis of the cut replaces what was missing on it above. Beyond oblique cuts the distance
 *                       from the cut counts, if it is the larger. The list of a cut waits with its far side.
 *
 * All bounds are rounded down; a place may be nearer than thought, but no object is passed over. */
#include "query/cuts.h"
#include "query/heap.h"
#include <string.h>

enum { BOUND, OBLIQUE, AXES }; /* the doubles of a place */

/* What is left of a distance when rounding is taken off; 2^-1070: of products below the least normal double. */
static double rounded_down(double distance) {
    const double x = distance * (1 - 0x1p-50) - 0x1p-1070;
    return x > 0 ? x : 0;
}

static double scaled_gap(const query_near *n, double from, double to) {
    return rounded_down(fabs(from * n->scale - to * n->scale));
}

double query_near_box(const query_near *n, int dim, const double *lo, const double *hi) {
    double sum = 0;
    for (int k = 0; k < dim; k++) {
        const double x = n->point[k], gap = x < lo[k]   ? scaled_gap(n, x, lo[k])
                                            : x > hi[k] ? scaled_gap(n, x, hi[k])
                                                        : 0;
        sum += gap * gap;
    }
    return rounded_down(sum);
}

double query_near_square(const query_near *n, double distance) {
    const double x = distance * n->scale * (1 + 0x1p-50) + 0x1p-1070;
    return x * x * (1 + 0x1p-50) + 0x1p-1070;
}

/* Brings the greatest coordinate near 1: then squares neither overflow nor, where it matters, underflow. */
static double scale_for(const froe_scene *s, const double *point) {
    double most = 0;
    int exponent;
    for (int k = 0; k < s->dim; k++) {
        const double x[3] = {fabs(point[k]), fabs(s->lo[k]), fabs(s->hi[k])};
        for (int i = 0; i < 3 && (i == 0 || s->object_count); i++) most = x[i] > most ? x[i] : most;
    }
    frexp(most, &exponent);
    return ldexp(1, exponent > 1000 ? -1000 : exponent < -1000 ? 1000 : -exponent);
}

froe_status query_near_begin(froe_query *q, froe_diagnostic *diag) {
    const query_planes *planes;
    query_near *n = &q->near;
    n->bounds.count = n->places.count = n->free.count = n->heap.count = 0;
    n->width = (size_t)q->tree->scene->dim + AXES;
    n->scale = scale_for(q->tree->scene, n->point);
    n->child = 0;
    for (size_t i = 0; i < n->width; i++) n->here[i] = 0;
    return query_planes_of(q, &planes, diag);
}

/* ------------------------------------------------------------------ places -- */

static double *bounds_of(const query_near *n, uint32_t place) {
    return n->bounds.data + place * n->width;
}

static bool nearer(void *user, uint32_t a, uint32_t b) {
    const query_near *n = user;
    return bounds_of(n, a)[BOUND] < bounds_of(n, b)[BOUND];
}

/* A place with the bounds `at`. */
static bool push(froe_query *q, uint32_t node, int side, const double *at) {
    query_near *n = &q->near;
    uint32_t place = (uint32_t)n->places.count;
    if (at[BOUND] > n->limit) return true;
    if (!array_reserve(&q->alloc, &n->heap, 1) || !array_reserve(&q->alloc, &n->places, 1) ||
        !array_reserve(&q->alloc, &n->bounds, n->width) || !array_reserve(&q->alloc, &n->free, n->places.count + 1))
        return false;
    if (n->free.count)
        place = n->free.data[--n->free.count];
    else
        n->places.count++, n->bounds.count += n->width;
    n->places.data[place] = 2 * node + (uint32_t)side;
    memcpy(bounds_of(n, place), at, n->width * sizeof *at);
    n->heap.data[n->heap.count++] = place;
    query_heap_rise(n->heap.data, n->heap.count - 1, nearer, n);
    return true;
}

/* Takes the nearest place off the heap: its list is next, then its child. */
static bool pop(froe_query *q, tree_objects *list) {
    query_near *n = &q->near;
    if (!n->heap.count || bounds_of(n, n->heap.data[0])[BOUND] > n->limit) return false;
    const uint32_t place = n->heap.data[0], node = n->places.data[place] / 2;
    n->heap.data[0] = n->heap.data[--n->heap.count];
    if (n->heap.count) query_heap_sink(n->heap.data, n->heap.count, 0, nearer, n);
    memcpy(n->here, bounds_of(n, place), n->width * sizeof *n->here);
    n->free.data[n->free.count++] = place;
    n->child = q->tree->nodes[node].child + n->places.data[place] % 2;
    *list = tree_list(q->tree, node);
    return true;
}

/* ----------------------------------------------------------------- walking -- */

/* Goes down to the side of q; the far side waits. */
static bool go_beside_axis(froe_query *q, const tree_node *node, uint32_t id, int axis, double value) {
    query_near *n = &q->near;
    const int far = n->point[axis] < value;
    double at[FROE_MAX_DIM + AXES], sum = 0;
    memcpy(at, n->here, n->width * sizeof *at);
    at[AXES + axis] = scaled_gap(n, n->point[axis], value);
    for (size_t i = AXES; i < n->width; i++) sum += at[i] * at[i];
    sum = rounded_down(sum);
    at[BOUND] = sum > at[OBLIQUE] ? sum : at[OBLIQUE];
    n->child = node->child + 1 - (uint32_t)far;
    return push(q, id, far, at);
}

/* The distance is |value| / |normal|; both are known up to an error. */
static bool go_beside_plane(froe_query *q, const tree_node *node, uint32_t id, const query_plane *plane) {
    query_near *n = &q->near;
    double at[FROE_MAX_DIM + AXES], error;
    const double value = query_plane_value(plane, n->point, &error), gap = fabs(value) - error;
    const double greatest = filter_greater(filter_greater(fabs(plane->n[0]), fabs(plane->n[1])), fabs(plane->n[2]));
    const double most = greatest + plane->n_err;
    const int far = value < 0;
    memcpy(at, n->here, n->width * sizeof *at);
    if (gap > 0 && most > 0 && most <= 0x1p1000) {
        double square = 0; /* of the normal, over that of its greatest component */
        for (int k = 0; k < 3; k++) square += (plane->n[k] / most) * (plane->n[k] / most);
        square += 12 * plane->n_err / most;
        const double distance = gap / most / sqrt(square * (1 + 0x1p-50)), x = rounded_down(distance * n->scale);
        if (isfinite(distance)) at[OBLIQUE] = filter_greater(at[OBLIQUE], rounded_down(x * x));
        at[BOUND] = filter_greater(at[BOUND], at[OBLIQUE]);
    }
    n->child = node->child + 1 - (uint32_t)far;
    return push(q, id, far, at);
}

froe_status query_near_next(froe_query *q, tree_objects *list) {
    const froe_tree *t = q->tree;
    query_near *n = &q->near;
    const query_planes *planes;
    froe_status status = query_planes_of(q, &planes, NULL); /* they are there */
    list->count = 0;
    while (!status && (n->child != FROE_NONE || pop(q, list))) {
        if (list->count) return FROE_OK;
        const uint32_t id = n->child;
        const tree_node *node = t->nodes + id;
        q->stats.nodes++;
        if (tree_is_leaf(node)) {
            q->stats.leaves++;
            n->child = FROE_NONE;
            *list = tree_list(t, id);
            if (list->count) return FROE_OK;
            continue;
        }
        const query_cut cut = query_cut_at(t, planes, node);
        const bool room =
            cut.axis >= 0 ? go_beside_axis(q, node, id, cut.axis, cut.value) : go_beside_plane(q, node, id, cut.plane);
        if (!room) status = FROE_E_MEMORY;
    }
    return status;
}
