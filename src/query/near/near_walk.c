/* near_walk.c: the lists of a tree, those of the nearest regions first (Hjaltason and Samet: Distance browsing in
 * spatial databases, 1999).
 *
 *     +------+  +--------+     A node is as far away as the box of what is below it (contents.h). From the nearest that
 *     |      |  |    q   |     waits the walk goes on to the nearer child as long as nothing waits that is nearer;
 *     | far  |  |  near  |     the other child is left behind.
 *     +------+  +--------+
 *
 * All bounds are rounded down; a node may be nearer than thought, but no object is passed over. */
#include "query/heap.h"
#include "query/near/contents.h"
#include "query/packed/space.h"
#include "tree/list.h"

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

double query_near_scale(const froe_scene *s, const double *point) {
    double most = 0;
    int exponent;
    for (int k = 0; k < s->dim; k++) {
        const double x[3] = {fabs(point[k]), fabs(s->lo[k]), fabs(s->hi[k])};
        for (int i = 0; i < 3 && (i == 0 || s->object_count); i++) most = x[i] > most ? x[i] : most;
    }
    frexp(most, &exponent);
    return ldexp(1, exponent > 1000 ? -1000 : exponent < -1000 ? 1000 : -exponent);
}

/* Bound of a node; infinite where there is nothing. */
static double bound_of(const query_near *n, const query_contents *c, uint32_t node) {
    const double *box = query_contents_box(c, node);
    return box[0] > box[c->dim] ? (double)INFINITY : query_near_box(n, (int)c->dim, box, box + c->dim);
}

froe_status query_near_begin(froe_query *q, froe_diagnostic *diag) {
    const query_contents *contents;
    query_near *n = &q->near;
    n->places.count = n->free.count = n->heap.count = 0;
    n->scale = query_near_scale(q->tree->scene, n->point);
    n->packed = false;
    if (q->space && space_walk_near(q, &q->space->walk, SPACE_ALL, &n->packed)) return FROE_E_MEMORY;
    if (n->packed) return FROE_OK;
    const froe_status status = query_contents_of(q, &contents, diag);
    if (!status) n->at = (query_place){bound_of(n, contents, 0), 0};
    return status;
}

/* ------------------------------------------------------------------ places -- */

static bool nearer(void *user, uint32_t a, uint32_t b) {
    const query_near *n = user;
    return n->places.data[a].bound < n->places.data[b].bound;
}

static bool push_region(froe_query *q, query_place at) {
    query_near *n = &q->near;
    uint32_t place = (uint32_t)n->places.count;
    if (at.bound > n->limit || isinf(at.bound)) return true;
    if (!array_reserve(&q->alloc, &n->heap, 1) || !array_reserve(&q->alloc, &n->places, 1) ||
        !array_reserve(&q->alloc, &n->free, n->places.count + 1))
        return false;
    if (n->free.count)
        place = n->free.data[--n->free.count];
    else
        n->places.count++;
    n->places.data[place] = at;
    n->heap.data[n->heap.count++] = place;
    query_heap_rise(n->heap.data, n->heap.count - 1, nearer, n);
    return true;
}

/* Takes the nearest place off the heap. */
static bool pop_region(query_near *n) {
    if (!n->heap.count || n->places.data[n->heap.data[0]].bound > n->limit) return false;
    const uint32_t place = n->heap.data[0];
    n->heap.data[0] = n->heap.data[--n->heap.count];
    if (n->heap.count) query_heap_sink(n->heap.data, n->heap.count, 0, nearer, n);
    n->free.data[n->free.count++] = place;
    n->at = n->places.data[place];
    return true;
}

/* ----------------------------------------------------------------- walking -- */

froe_status query_near_next(froe_query *q, tree_objects *list) {
    const froe_tree *t = q->tree;
    query_near *n = &q->near;
    if (n->packed) return space_walk_next(q, &q->space->walk, n->limit, list);
    const query_contents *contents;
    froe_status status = query_contents_of(q, &contents, NULL);
    list->count = 0;
    /* one way: query_near_begin() has prepared the contents */
    while (!status && (n->at.node != FROE_NONE || pop_region(n))) {
        const tree_node *node = t->nodes + n->at.node;
        *list = tree_list(t, n->at.node);
        q->stats.nodes++;
        q->stats.leaves += tree_is_leaf(node);
        n->at.node = FROE_NONE;
        if (!tree_is_leaf(node)) { /* on to the nearer child, unless a waiting node is nearer */
            const uint32_t child = node->child;
            query_place near = {bound_of(n, contents, child), child},
                        far = {bound_of(n, contents, child + 1), child + 1};
            if (far.bound < near.bound) {
                const query_place swap = near;
                near = far;
                far = swap;
            }
            if (!push_region(q, far)) return FROE_E_MEMORY;
            const bool waits = n->heap.count && n->places.data[n->heap.data[0]].bound < near.bound;
            if (waits && !push_region(q, near)) return FROE_E_MEMORY;
            if (!waits && near.bound <= n->limit && !isinf(near.bound)) n->at = near;
        }
        if (list->count) break;
    }
    return status;
}
