/* near_points.c: the k nearest of many points.
 *
 *       k best so far   k-th  reach
 *     ----.--..---.------.------]---x----x-->     squares of distances, in doubles
 *
 * Coordinates lie side by side (pieces.h). What is beyond the k-th of the squares by more than rounding can cause is
 * dropped. A few more than k are left in the end, and only those are compared exactly.
 *
 * Depth first, the nearer child before the other (Friedman, Bentley and Finkel: An algorithm for finding best matches
 * in logarithmic expected time, 1977), by the boxes of what is below nodes.
 *
 * Rounding. Coordinates are scaled by a power of 2 to at most 2^25, so that a difference errs by a 2^-52nd of it and
 * less than 2^-1072 in any rounding mode, and the sum of up to eight squares by less than a 2^-48th and less than
 * 2^-1040. So a true square that is not above that of s comes out at most at query_near_reach(s), and so does the
 * distance of a box that holds its point. */
#include "query/check.h"
#include "query/near/contents.h"
#include "query/near/near.h"
#include "query/pieces.h"
#include <math.h>

enum { CANDIDATES_FEW = 24 };

static double square_of(double x) {
    return x * x;
}

/* Squared distance of a box from a scaled point, 0 inside; infinite where the box is of nothing. */
static double box_square(const query_near *n, const query_contents *c, uint32_t node) {
    const double *lo = query_contents_box(c, node), *hi = lo + c->dim, *x = n->scaled;
    double sum = 0;
    for (size_t k = 0; k < c->dim; k++) {
        const double below = lo[k] * n->scale - x[k], above = x[k] - hi[k] * n->scale;
        const double gap = below > above ? below : above;
        sum += gap > 0 ? square_of(gap) : 0;
    }
    return lo[0] > hi[0] ? (double)INFINITY : sum;
}

/* ----------------------------------------------------------------- k best -- */

/* The k least are a heap, the greatest on top. */
void query_near_keep(query_near *n, double square, size_t k) {
    double *heap = n->best.data;
    size_t i;
    if (n->best.count < k) {
        for (i = n->best.count++; i && heap[(i - 1) / 2] < square; i = (i - 1) / 2) heap[i] = heap[(i - 1) / 2];
    } else {
        if (square >= heap[0]) return;
        i = 0;
        for (size_t child = 1; child < k; child = 2 * i + 1) {
            if (child + 1 < k && heap[child + 1] > heap[child]) child++;
            if (heap[child] <= square) break;
            heap[i] = heap[child];
            i = child;
        }
    }
    heap[i] = square;
    if (n->best.count == k && query_near_reach(heap[0]) < n->limit) n->limit = query_near_reach(heap[0]);
}

void query_near_sift(query_near *n) {
    size_t kept = 0;
    for (size_t i = 0; i < n->candidates.count; i++)
        if (n->candidates.data[i].square <= n->limit) n->candidates.data[kept++] = n->candidates.data[i];
    n->candidates.count = kept;
}

void query_near_order(query_near *n) {
    query_candidate *c = n->candidates.data;
    for (size_t i = 1; i < n->candidates.count && n->candidates.count <= CANDIDATES_FEW; i++) {
        const query_candidate one = c[i];
        size_t at = i;
        for (; at && c[at - 1].square > one.square; at--) c[at] = c[at - 1];
        c[at] = one;
    }
}

static bool scan(froe_query *q, const query_pieces *pieces, const tree_objects *list, size_t k) {
    query_near *n = &q->near;
    const size_t dim = (size_t)q->tree->scene->dim;
    const double *at = pieces->points + list->first * dim;
    const size_t room = list->count < k ? list->count : k;
    if (n->candidates.count > 2 * k + 64)
        query_near_sift(n); /* without ties there are little more than 2 k and one list */
    if (!array_reserve(&q->alloc, &n->candidates, list->count) || !array_reserve(&q->alloc, &n->best, room))
        return false;
    for (uint32_t i = 0; i < list->count; i++, at += dim) {
        double square = 0;
        for (size_t j = 0; j < dim; j++) square += square_of(at[j] * n->scale - n->scaled[j]);
        if (!(square <= n->limit)) continue;
        n->candidates.data[n->candidates.count++] = (query_candidate){square, at, tree_object(list, i)};
        query_near_keep(n, square, k);
    }
    q->stats.tests += list->count;
    return true;
}

/* ----------------------------------------------------------------- descent -- */

static bool wait(froe_query *q, uint32_t node, double square) {
    if (square > q->near.limit) return true;
    if (!array_reserve(&q->alloc, &q->near.places, 1)) return false;
    q->near.places.data[q->near.places.count++] = (query_place){square, node};
    return true;
}

/* From a node to the nearest leaf below; what is further away waits. */
static bool descend_nearer_child(froe_query *q, const query_contents *c, const query_pieces *pieces, uint32_t node,
                                 size_t k) {
    const froe_tree *t = q->tree;
    for (;;) {
        const tree_node *at = t->nodes + node;
        q->stats.nodes++;
        if (at->type != TREE_PLAIN) {
            const tree_objects list = tree_list(t, node);
            q->stats.leaves += tree_is_leaf(at);
            if (list.count && !scan(q, pieces, &list, k)) return false;
            if (tree_is_leaf(at)) return true;
        }
        const double left = box_square(&q->near, c, at->child), right = box_square(&q->near, c, at->child + 1);
        const bool swap = right < left;
        if (!wait(q, at->child + !swap, swap ? left : right)) return false;
        if ((swap ? right : left) > q->near.limit) return true;
        node = at->child + swap;
    }
}

froe_status query_near_points(froe_query *q, size_t k, double bound, bool *done, froe_diagnostic *diag) {
    const query_contents *contents;
    const query_pieces *pieces;
    query_near *n = &q->near;
    froe_status status = query_pieces_of(q, &pieces, diag);
    *done = !status && pieces->points;
    if (!*done) return status;
    status = query_contents_of(q, &contents, diag);
    if (status) return status;
    n->places.count = n->best.count = n->candidates.count = 0;
    n->scale = query_near_scale(q->tree->scene, n->point);
    n->limit = bound < INFINITY ? query_near_reach(query_near_square(n, bound)) : (double)INFINITY;
    for (size_t i = 0; i < contents->dim; i++) n->scaled[i] = n->point[i] * n->scale;
    bool memory = wait(q, 0, box_square(n, contents, 0));
    while (memory && n->places.count) {
        const query_place at = n->places.data[--n->places.count];
        if (at.bound <= n->limit) memory = descend_nearer_child(q, contents, pieces, at.node, k);
    }
    if (!memory) return FROE_E_MEMORY;
    query_near_sift(n);
    return FROE_OK;
}
