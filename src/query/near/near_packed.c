/* near_packed.c: the k nearest of the objects of a packed tree of the plane.
 *
 *     +----+------+----+     Depth first, the nearer child before the other. What waits knows the gaps between the
 *     |    |   gap|    |     point and its region along the axes, which cuts enlarge one at a time (Arya and Mount:
 *     |  x<--dx-->|far |     Algorithms for fast vector quantization, 1993). In a leaf a kernel has the distances of
 *     +----+------+----+     all fragments in units of the cell. Each stands between two bounds:
 *
 *                   distance - slack  <=  truth  <=  distance + slack
 *
 * The k-th least of the upper bounds is the limit. Fragments whose lower bounds are within it are candidates, which are
 * measured exactly in the end. For k > 1 the upper bounds are those of fragments where objects begin, so that no object
 * counts twice.
 *
 * The slack, in units. E is the error of the block, A the greatest of 65536 and the point's coordinates |x|, |y|, and
 * u = 2^-24. Both ends of a fragment are off by up to E along each axis, so the fragment by less than 1.5 E. The point
 * is rounded by A u along each axis. Let v be the vector from p to the point and d that from p to q. v is rounded by
 * 2 A u along each axis, |v| <= 3 A, and |d| <= 1.5 A. So v . d is off by at most 2^-21 |v| |d|, t by
 * 2^-21 (|v| / |d| + 2), and t d by 2^-21 (3 A + 3 A). Clamped to [0, 1], t is no further off. The vector v - t d has
 * roundings of 8 A u along each axis, and its length, up to 5 A, has those of 2 u of itself. All of that together is
 * less than (1.5 + 3 + 48 + 12 + 10) A u < A 2^-17.
 *
 * Scaled squares are those of near_points.c, with its rules of rounding. */
#include "query/context.h"
#include "query/packed/packed.h"
#include <math.h>

enum { LEAST_FEW = 16 };

static double square_of_gap(const double gap[2]) {
    return gap[0] * gap[0] + gap[1] * gap[1];
}

/* What a kernel says of a leaf. */
typedef struct leaf_view {
    double unit;  /* scaled */
    double slack; /* in units */
    float point[2];
    bool known; /* otherwise distances in units say nothing */
} leaf_view;

static leaf_view view_leaf(const query_near *n, const packed_header *block) {
    double most = 65536;
    leaf_view v = {.unit = n->scale / block->scale};
    for (int k = 0; k < 2; k++) {
        const double x = (n->point[k] - block->lo[k]) * block->scale;
        most = fabs(x) > most ? fabs(x) : most; /* not for a NaN, of infinite differences in a coarse block */
        v.point[k] = (float)x;
    }
    v.slack = 1.5 * (double)block->error + 0x1p-17 * most;
    v.known = block->scale > 0 && most < 0x1p60 && v.slack < 0x1p24 && v.unit > 0x1p-1000 && v.unit < 0x1p1000;
    return v;
}

/* Scaled square of a distance in units, with its rounding: 2^-40 is more than that of the four operations. */
static double square_above(const leaf_view *v, double distance) {
    const double x = distance * v->unit * (1 + 0x1p-40);
    return x * x;
}

static double square_below(const leaf_view *v, double distance) {
    const double x = distance > 0 ? distance * v->unit * (1 - 0x1p-40) : 0;
    return x * x;
}

/* A leaf of which units say nothing: bounds of the objects from below, their ends from above. */
static void scan_objects(froe_query *q, const uint32_t *ids, uint32_t count, size_t k) {
    query_near *n = &q->near;
    const froe_scene *s = q->tree->scene;
    for (uint32_t i = 0; i < count; i++) {
        double lo[2], hi[2];
        const uint32_t object = ids[i] & PACKED_OBJECT;
        scene_bounds_in(s, 2, object, lo, hi);
        const double below = query_near_box(n, 2, lo, hi);
        if (below > n->limit) continue;
        n->candidates.data[n->candidates.count++] = (query_candidate){below, NULL, object};
        const double *end = scene_point(s, object, 0);
        const double gap[2] = {end[0] * n->scale - n->scaled[0], end[1] * n->scale - n->scaled[1]};
        if (ids[i] & PACKED_START) query_near_keep(n, query_near_reach(square_of_gap(gap)), k);
    }
}

/* What squares of distances in units are up to, of fragments within the limit. */
static double squares_within(const query_near *n, const leaf_view *v) {
    const double within = sqrt(n->limit) / v->unit * (1 + 0x1p-40) + v->slack;
    return within * within * (1 + 0x1p-40);
}

/* Lowers the limit by fragments where objects begin. Of a leaf only the k least matter. */
static void lower_limit(query_near *n, const leaf_view *v, const uint32_t *ids, const packed_near *near, size_t k) {
    float least[LEAST_FEW];
    size_t count = 0;
    for (uint32_t i = 0; i < near->count; i++) {
        const float square = near->squares[near->places[i]];
        if (!(ids[near->places[i]] & PACKED_START)) continue;
        if (k > LEAST_FEW) {
            query_near_keep(n, square_above(v, sqrt((double)square) + v->slack), k);
            continue;
        }
        if (count == k && square >= least[k - 1]) continue;
        size_t at = count < k ? count++ : k - 1;
        for (; at && least[at - 1] > square; at--) least[at] = least[at - 1];
        least[at] = square;
    }
    for (size_t i = 0; i < count; i++) query_near_keep(n, square_above(v, sqrt((double)least[i]) + v->slack), k);
}

static bool scan_leaf(froe_query *q, const tree_node *leaf, size_t k) {
    query_near *n = &q->near;
    packed_work *work = q->packed;
    const uint32_t count = leaf->u.list.count;
    const packed_header *block = packed_block(q->tree, leaf);
    const uint32_t *ids = packed_ids(block, count);
    const leaf_view v = view_leaf(n, block);
    if (n->candidates.count > 2 * k + 64) query_near_sift(n);
    if (!array_reserve(&q->alloc, &n->candidates, count) ||
        !array_reserve(&q->alloc, &n->best, count < k ? count : k) ||
        !array_reserve(&q->alloc, &work->squares, count + PACKED_LANES) ||
        !array_reserve(&q->alloc, &work->candidates, count))
        return false;
    q->stats.tests += count;
    if (!v.known) {
        scan_objects(q, ids, count, k);
        return true;
    }
    packed_near near = {.squares = work->squares.data, .places = work->candidates.data};
    double within = squares_within(n, &v);
    work->kernels->nearest(block, count, v.point, within < 0x1p100 ? (float)(within * (1 + 0x1p-20)) : INFINITY, &near);
    if (!near.count) return true;
    if (k == 1)
        query_near_keep(n, square_above(&v, sqrt((double)near.least) + v.slack), 1);
    else
        lower_limit(n, &v, ids, &near, k);
    within = squares_within(n, &v);
    for (uint32_t i = 0; i < near.count; i++) {
        const double square = (double)near.squares[near.places[i]];
        if (!(square <= within)) continue;
        const double below = square_below(&v, sqrt(square) - v.slack);
        n->candidates.data[n->candidates.count++] = (query_candidate){below, NULL, ids[near.places[i]] & PACKED_OBJECT};
    }
    return true;
}

/* From a subtree to the leaf nearest to the point; what is beyond cuts waits. */
static bool descend_to_nearest(froe_query *q, packed_far at, size_t k) {
    query_near *n = &q->near;
    const tree_node *node = q->tree->nodes + at.node;
    for (; !tree_is_leaf(node); q->stats.nodes++) {
        const uint32_t axis = node->axis, upper = n->point[axis] >= node->u.value;
        packed_far beyond = {{at.gap[0], at.gap[1]}, node->child + !upper};
        beyond.gap[axis] = fabs(node->u.value * n->scale - n->scaled[axis]);
        if (square_of_gap(beyond.gap) <= n->limit) q->packed->far.data[q->packed->far.count++] = beyond;
        node = q->tree->nodes + node->child + upper;
    }
    q->stats.leaves++;
    return !node->u.list.count || scan_leaf(q, node, k);
}

/* Each object once, and what is beyond the limit not at all; their points are on the way from memory. */
static bool clear_candidates(froe_query *q) {
    query_near *n = &q->near;
    const froe_scene *s = q->tree->scene;
    size_t kept = 0;
    query_near_sift(n);
    if (!query_expect(q, n->candidates.count)) return false;
    for (size_t i = 0; i < n->candidates.count; i++) {
        const uint32_t object = n->candidates.data[i].object;
        if (!query_mark(&q->marks, object)) continue;
        scene_ask(s, object);
        n->candidates.data[kept++] = n->candidates.data[i];
    }
    n->candidates.count = kept;
    for (size_t i = 0; i < kept; i++) scene_ask_points(s, n->candidates.data[i].object);
    return true;
}

froe_status query_near_packed(froe_query *q, size_t k, double bound) {
    query_near *n = &q->near;
    const tree_meta *m = &q->tree->meta;
    packed_far root = {.node = 0};
    n->best.count = n->candidates.count = 0;
    n->scale = query_near_scale(q->tree->scene, n->point);
    n->limit = bound < INFINITY ? query_near_reach(query_near_square(n, bound)) : (double)INFINITY;
    for (int i = 0; i < 2; i++) {
        n->scaled[i] = n->point[i] * n->scale;
        if (n->point[i] < m->root_lo[i]) root.gap[i] = m->root_lo[i] * n->scale - n->scaled[i];
        if (n->point[i] > m->root_hi[i]) root.gap[i] = n->scaled[i] - m->root_hi[i] * n->scale;
    }
    q->packed->far.count = 0;
    q->packed->far.data[q->packed->far.count++] = root;
    while (q->packed->far.count) {
        const packed_far at = q->packed->far.data[--q->packed->far.count];
        if (square_of_gap(at.gap) <= n->limit && !descend_to_nearest(q, at, k)) return FROE_E_MEMORY;
    }
    return clear_candidates(q) ? FROE_OK : FROE_E_MEMORY;
}
