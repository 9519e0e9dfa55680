/* near_packed.c: the k nearest of the objects of a packed tree of the plane.
 *
 *     +----+------+----+     Depth first, the nearer child before the other. What waits knows the gaps between the
 *     |    |   gap|    |     point and its region along the axes, which cuts enlarge one at a time (Arya and Mount:
 *     |  x<--dx-->|far |     Algorithms for fast vector quantization, 1993). In a leaf a kernel has the distances of
 *     +----+------+----+     all fragments in units of the cell. Each stands between two bounds:
 *
 *                   distance - slack  <=  truth  <=  distance + slack
 *
 * The search begins in the cell of the jump table that the point is in. In batches the entries of the table, the blocks
 * that they name, and in the end the candidates of several points are on their way from memory at the same time.
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
#include <string.h>

enum { RANKED = 64 }; /* squares that are put in order at once */

static double square_of_gap(const double gap[2]) {
    return gap[0] * gap[0] + gap[1] * gap[1];
}

/* Where a search began: a node whose subtree was searched, or the block of a leaf; NULL: nowhere. */
typedef struct near_start {
    const tree_node *node;
    const packed_header *block;
} near_start;

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
    /* no cell is larger than the scene: units are not too large */
    v.known = block->scale > 0 && most < 0x1p60 && v.slack < 0x1p24 && v.unit > 0x1p-1000;
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

/* The k least of few squares come to the front, by how many are below each: that has no branch to be guessed. How many
 * they are, with equal ones. */
static size_t pick_least(float squares[RANKED], size_t count, size_t k) {
    float all[RANKED];
    const size_t room = (count + 7) / 8 * 8;
    size_t kept = 0;
    for (size_t i = 0; i < room; i++) all[i] = i < count ? squares[i] : (float)INFINITY;
    for (size_t i = 0; i < count; i++) {
        uint32_t below = 0;
        for (size_t j = 0; j < room; j++) below += all[j] < all[i];
        squares[kept] = all[i];
        kept += below < k;
    }
    return kept;
}

/* Lowers the limit by fragments where objects begin. Of a leaf only the k least matter. */
static void lower_limit(query_near *n, const leaf_view *v, const uint32_t *ids, const packed_near *near, size_t k) {
    float squares[RANKED];
    for (uint32_t i = 0; i < near->count;) {
        size_t count = 0;
        for (; i < near->count && count < RANKED; i++) {
            squares[count] = near->squares[near->places[i]];
            count += (ids[near->places[i]] & PACKED_START) != 0;
        }
        if (count > k) count = pick_least(squares, count, k);
        for (size_t j = 0; j < count; j++) query_near_keep(n, square_above(v, sqrt((double)squares[j]) + v->slack), k);
    }
}

static bool scan_leaf(froe_query *q, const packed_header *block, uint32_t count, size_t k) {
    query_near *n = &q->near;
    const size_t at = (size_t)((const uint8_t *)block - q->tree->packed.blocks);
    if (q->ready && !query_leaf_is_good(q, (uint32_t)(at / PACKED_BLOCK))) return false;
    packed_work *work = q->packed;
    const uint32_t *ids = packed_ids(block, count);
    const leaf_view v = view_leaf(n, block);
    if (n->candidates.count > 2 * k + 64) query_near_sift(n);
    if (!array_reserve(&q->alloc, &n->candidates, count) ||
        !array_reserve(&q->alloc, &n->best, count < k ? count : k) ||
        !array_reserve(&q->alloc, &work->squares, count + PACKED_LANES) ||
        !array_reserve(&q->alloc, &work->candidates, count))
        return false;
    q->stats.leaves++;
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
    uint32_t kept = 0;
    for (uint32_t i = 0; i < near.count; i++) { /* without a branch to be guessed */
        near.places[kept] = near.places[i];
        kept += (double)near.squares[near.places[i]] <= within;
    }
    for (uint32_t i = 0; i < kept; i++) {
        const double below = square_below(&v, sqrt((double)near.squares[near.places[i]]) - v.slack);
        n->candidates.data[n->candidates.count++] = (query_candidate){below, NULL, ids[near.places[i]] & PACKED_OBJECT};
    }
    return true;
}

/* From a subtree to the leaf nearest to the point; what is beyond cuts waits. What has been searched is left out. */
static bool descend_to_nearest(froe_query *q, packed_far at, size_t k, const near_start *searched) {
    query_near *n = &q->near;
    const tree_node *node = q->tree->nodes + at.node;
    for (; !tree_is_leaf(node); q->stats.nodes++) {
        const uint32_t axis = node->axis, upper = n->point[axis] >= node->u.value;
        packed_far beyond = {{at.gap[0], at.gap[1]}, node->child + !upper};
        if (node == searched->node) return true;
        beyond.gap[axis] = fabs(node->u.value * n->scale - n->scaled[axis]);
        if (square_of_gap(beyond.gap) <= n->limit) q->packed->far.data[q->packed->far.count++] = beyond;
        node = q->tree->nodes + node->child + upper;
    }
    const packed_header *block = packed_block(q->tree, node);
    const bool done = node == searched->node || block == searched->block;
    return done || !node->u.list.count || scan_leaf(q, block, node->u.list.count, k);
}

static bool search_from(froe_query *q, packed_far root, size_t k, const near_start *searched) {
    q->packed->far.count = 0;
    q->packed->far.data[q->packed->far.count++] = root;
    while (q->packed->far.count) {
        const packed_far at = q->packed->far.data[--q->packed->far.count];
        if (square_of_gap(at.gap) <= q->near.limit && !descend_to_nearest(q, at, k, searched)) return false;
    }
    return true;
}

/* Begins in the cell of the jump table whose core the point is in, if any. Most searches for one object end there: what
 * has nothing in the node of the cell is no nearer than the border of the core. */
static bool begin_in_table(froe_query *q, size_t k, near_start *searched, bool *done) {
    const tree_table *table = q->tree->packed.table;
    const query_near *n = &q->near;
    uint32_t cell[2];
    double room = INFINITY;
    for (int i = 0; i < 2 && table; i++) {
        const double place = tree_table_place(table, i, n->point[i]);
        if (!(place >= 0 && place < table->cells[i])) return true;
        cell[i] = (uint32_t)place;
        const double below = place - cell[i], within = below < 0.5 ? below : 1 - below;
        if (!(within > 2 * TABLE_MARGIN)) return true;
        room = fmin(room, (within - 2 * TABLE_MARGIN) / table->scale[i]);
    }
    if (!table) return true;
    const tree_entry entry = tree_table_at(table, cell[0], cell[1]);
    if (entry.kind & TABLE_LEAF) {
        const uint32_t count = entry.kind & ~TABLE_LEAF;
        searched->block = packed_block_at(q->tree, entry.at);
        if (count && !scan_leaf(q, searched->block, count, k)) return false;
    } else {
        packed_ask_nodes(q->tree, entry.at);
        if (!search_from(q, (packed_far){.node = entry.at}, k, searched)) return false;
        searched->node = q->tree->nodes + entry.at;
    }
    room *= n->scale;
    *done = n->limit < room * room * (1 - 0x1p-40);
    return true;
}

/* Each object once, and what is beyond the limit not at all; what leads to their points is on the way from memory. */
static bool clear_candidates(froe_query *q) {
    query_near *n = &q->near;
    size_t kept = 0;
    query_near_sift(n);
    if (!query_expect(q, n->candidates.count)) return false;
    for (size_t i = 0; i < n->candidates.count; i++) {
        const uint32_t object = n->candidates.data[i].object;
        if (!query_mark(&q->marks, object)) continue;
        scene_ask(q->tree->scene, object);
        n->candidates.data[kept++] = n->candidates.data[i];
    }
    n->candidates.count = kept;
    return true;
}

__attribute__((always_inline)) static inline void ask_points(const froe_scene *s, const query_candidate *c,
                                                             size_t count) {
    for (size_t i = 0; i < count; i++) scene_ask_points(s, c[i].object);
}

static bool find_candidates(froe_query *q, size_t k, double bound) {
    query_near *n = &q->near;
    const tree_meta *m = &q->tree->meta;
    packed_far root = {.node = 0};
    near_start searched = {NULL, NULL};
    bool done = false;
    n->best.count = n->candidates.count = 0;
    n->scale = query_near_scale(q->tree->scene, n->point);
    n->limit = bound < INFINITY ? query_near_reach(query_near_square(n, bound)) : (double)INFINITY;
    for (int i = 0; i < 2; i++) {
        n->scaled[i] = n->point[i] * n->scale;
        if (n->point[i] < m->root_lo[i]) root.gap[i] = m->root_lo[i] * n->scale - n->scaled[i];
        if (n->point[i] > m->root_hi[i]) root.gap[i] = n->scaled[i] - m->root_hi[i] * n->scale;
    }
    return begin_in_table(q, k, &searched, &done) && (done || search_from(q, root, k, &searched)) &&
           clear_candidates(q);
}

froe_status query_near_packed(froe_query *q, size_t k, double bound) {
    if (!find_candidates(q, k, bound)) return FROE_E_MEMORY;
    ask_points(q->tree->scene, q->near.candidates.data, q->near.candidates.count);
    return FROE_OK;
}

/* ------------------------------------------------------------------- flocks -- */

froe_status query_near_flock(froe_query *q, const double *points, size_t count, size_t left, size_t k, double bound) {
    query_near *n = &q->near;
    size_t asked = 0;
    n->flock.count = 0;
    for (size_t i = 0; i < count; i++) {
        if (i + 2 * QUERY_NEAR_FLOCK < left) packed_ask_table(q->tree, points + 2 * (i + 2 * QUERY_NEAR_FLOCK), false);
        if (i + QUERY_NEAR_FLOCK < left) packed_ask_table(q->tree, points + 2 * (i + QUERY_NEAR_FLOCK), true);
        query_begin(q);
        memcpy(n->point, points + 2 * i, 2 * sizeof *points);
        if (!find_candidates(q, k, bound) ||
            !array_append(&q->alloc, &n->flock, n->candidates.data, n->candidates.count))
            return FROE_E_MEMORY;
        /* By now, what leads to the points of the query before has come. */
        ask_points(q->tree->scene, n->flock.data + asked, (i ? n->flock_ends[i - 1] : 0) - asked);
        asked = i ? n->flock_ends[i - 1] : 0;
        n->flock_ends[i] = n->flock.count;
    }
    ask_points(q->tree->scene, n->flock.data + asked, n->flock.count - asked);
    return FROE_OK;
}
