/* packed_pairs.c: all pairs of objects of a packed tree that meet, each once.
 *
 *     +-------+------+     Objects that meet have a point in common, the first by x, then y. By general
 *     |   \ / |      |     position (tree/packed/packed.h) both are in the list of every leaf whose closed cell
 *     |    X  |   ___|__   holds that point; the one whose half-open cell does finds them. Crossings well
 *     |   / \ |__/   |     inside of a cell are seen by the kernel, the rest is decided exactly.
 *     +-------+------+
 *
 * Leaves come in their own order, and runs of them to several threads; callers want pairs by ids: so they are gathered,
 * sorted (pair_lists.h) and then reported. Where there are too many for that, none is reported, and the caller searches
 * object by object. */
#include "geom/meet/contact.h"
#include "query/packed/packed.h"
#include "query/pairs/pair_lists.h"
#include "query/segment.h"

enum { PAIRS_EACH = 16, PAIRS_MORE = 1 << 20 }; /* gathered for each object at most, and some more */
enum { NODES_PER_JOB = 512 };
enum { OBJECTS_AHEAD = 256 }; /* objects whose coordinates are prefetched together */

typedef struct packed_search {
    query_workers *workers;
    bool shared;
    pair_lists lists;
} packed_search;

/* The search of one thread. */
typedef struct pairing {
    packed_search *search;
    unsigned worker;
    froe_query *q;
    packed_box cell;
    froe_status status;
} pairing;

/* ------------------------------------------------------------------ places -- */

/* Is a number in lo <= x < hi? The last cells of the root box have their upper side, too. */
static bool in_span(const pairing *p, int axis, double x) {
    double hi = p->cell.hi[axis];
    return x >= p->cell.lo[axis] && (x < hi || (x == hi && hi == p->q->tree->meta.root_hi[axis]));
}

static bool is_here(const pairing *p, const double *x) {
    return in_span(p, 0, x[0]) && in_span(p, 1, x[1]);
}

/* The crossing of two segments that cross in their inner points: those never lie in the root box's upper sides. */
static bool crossing_here(pairing *p, const double *const a[2], const double *const b[2]) {
    geom_plane line = geom_plane_points(2, (const double *const[]){b[0], b[1]});
    for (int axis = 0; axis < 2; axis++) {
        geom_plane low = geom_plane_axis(2, axis, p->cell.lo[axis]), high = geom_plane_axis(2, axis, p->cell.hi[axis]);
        if (geom_side_crossing(&p->q->numbers, &low, a[0], a[1], &line) < 0) return false;
        if (geom_side_crossing(&p->q->numbers, &high, a[0], a[1], &line) >= 0) return false;
    }
    return true;
}

static bool precedes(const double *a, const double *b) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

static bool segment_holds(pairing *p, const double *const s[2], const double *x) {
    return query_segment_meets_box(&p->q->numbers, s[0], s[1], x, x);
}

/* The first common point of two objects that meet, but do not cross, is an end of one of them. */
static bool end_here(pairing *p, const double *const a[2], const double *const b[2]) {
    const double *first = NULL;
    for (int i = 0; i < 2; i++) {
        if ((!first || precedes(a[i], first)) && segment_holds(p, b, a[i])) first = a[i];
        if ((!first || precedes(b[i], first)) && segment_holds(p, a, b[i])) first = b[i];
    }
    return first && is_here(p, first);
}

/* ------------------------------------------------------------------- pairs -- */

static void gather_pair(pairing *p, uint32_t a, uint32_t b, froe_meeting kind) {
    if (!p->status) p->status = pair_lists_add(&p->search->lists, p->worker, a, b, kind);
}

/* What two segments have in common that are known to share a corner, and are not on one line: that corner. NULL where
 * they may have more, or something else. On maps nearly all pairs are such. */
static const double *only_corner(pairing *p, const double *const a[2], const double *const b[2]) {
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if (geom_same_point(a[i], b[j], 2)) return query_turn(&p->q->numbers, a[0], a[1], b[1 - j]) ? a[i] : NULL;
    return NULL;
}

static void decide_pair(pairing *p, uint32_t a, uint32_t b) {
    static const froe_meeting kinds[GEOM_CONTACTS] = {
        [GEOM_CROSS] = FROE_MEET_CROSS, [GEOM_TOUCH] = FROE_MEET_TOUCH, [GEOM_OVERLAP] = FROE_MEET_OVERLAP};
    const froe_scene *s = p->q->tree->scene;
    signed char sides[4];
    const double *u[2], *v[2];
    p->q->packed->decided++;
    packed_ends(s, a, u);
    packed_ends(s, b, v);
    const double *corner = only_corner(p, u, v);
    if (corner) {
        if (p->search->shared && is_here(p, corner)) gather_pair(p, a, b, FROE_MEET_TOUCH);
        return;
    }
    const geom_body one = scene_body(s, a), other = scene_body(s, b);
    const geom_contact c = geom_contact_of(&p->q->numbers, &one, &other, sides);
    if (c.kind == GEOM_APART) return;
    if (!p->search->shared && c.kind == GEOM_TOUCH && c.touch == GEOM_TOUCH_AT_CORNER) return;
    if (c.kind == GEOM_CROSS ? crossing_here(p, u, v) : end_here(p, u, v)) gather_pair(p, a, b, kinds[c.kind]);
}

/* Decides the pairs that kernels left open in a leaf. The coordinates of some objects are prefetched together: three
 * loads lead to those of an object, each waiting for the one before; those of different objects overlap. */
static void decide_open(pairing *p) {
    const froe_scene *s = p->q->tree->scene;
    const uint32_t *open = p->q->packed->candidates.data;
    const size_t count = p->q->packed->candidates.count;
    for (size_t i = 0; i < count && !p->status; i += 2) {
        if (i % OBJECTS_AHEAD == 0) {
            const size_t end = count - i < OBJECTS_AHEAD ? count : i + OBJECTS_AHEAD;
            for (size_t j = i; j < end; j++) scene_ask_start(s, open[j]);
            for (size_t j = i; j < end; j++) scene_ask_corner(s, scene_start(s, open[j]));
            for (size_t j = i; j < end; j++) {
                __builtin_prefetch(scene_point(s, open[j], 0));
                __builtin_prefetch(scene_point(s, open[j], scene_corners(s, open[j]) - 1));
            }
        }
        decide_pair(p, open[i], open[i + 1]);
    }
    p->q->packed->candidates.count = 0;
}

static void pair_leaf(pairing *p, const tree_node *leaf) {
    froe_query *q = p->q;
    const packed_header *block = packed_block(q->tree, leaf);
    uint32_t count = leaf->u.list.count, words = (count + PACKED_LANES - 1) / PACKED_LANES;
    const uint32_t *ids = packed_ids(block, count);
    q->packed->bits.count = q->packed->candidates.count = 0;
    if (!array_reserve(&q->alloc, &q->packed->bits, 2 * (size_t)words)) p->status = FROE_E_MEMORY;
    packed_row row = {q->packed->bits.data, q->packed->bits.data + words};
    packed_cell(q->tree, block, &p->cell);
    q->stats.leaves++;
    for (uint32_t i = 0; i + 1 < count && !p->status; i++) {
        q->packed->kernels->pairs(block, count, i, &row);
        q->stats.tests += count - i - 1;
        for (uint32_t word = i / PACKED_LANES; word < words; word++)
            for (uint32_t bits = row.crossing[word] | row.unsure[word]; bits && !p->status; bits &= bits - 1) {
                const uint32_t bit = (uint32_t)__builtin_ctz(bits), j = word * PACKED_LANES + bit;
                const uint32_t a = ids[i] & PACKED_OBJECT, b = ids[j] & PACKED_OBJECT;
                if (row.crossing[word] >> bit & 1) {
                    gather_pair(p, a, b, FROE_MEET_CROSS);
                } else if (!array_push(&q->alloc, &q->packed->candidates, a) ||
                           !array_push(&q->alloc, &q->packed->candidates, b)) {
                    p->status = FROE_E_MEMORY;
                }
            }
    }
    decide_open(p);
}

static froe_status pair_run(void *user, unsigned worker, size_t job) {
    packed_search *s = user;
    pairing p = {.search = s, .worker = worker, .q = s->workers->queries[worker]};
    const froe_tree *t = p.q->tree;
    const uint32_t from = (uint32_t)job * NODES_PER_JOB,
                   to = t->node_count - from < NODES_PER_JOB ? t->node_count : from + NODES_PER_JOB;
    p.q->stats.nodes += to - from;
    for (uint32_t i = from; i < to && !p.status; i++)
        if (tree_is_leaf(t->nodes + i) && t->nodes[i].u.list.count > 1) pair_leaf(&p, t->nodes + i);
    return p.status;
}

/* -------------------------------------------------------------------- whole -- */

froe_status packed_pairs(query_workers *workers, bool shared, froe_pair_fn *fn, void *user) {
    const froe_query *q = workers->queries[0];
    const uint32_t objects = q->tree->scene->object_count;
    const uint64_t most = (uint64_t)objects * PAIRS_EACH + PAIRS_MORE;
    packed_search s = {.workers = workers, .shared = shared};
    froe_status status =
        pair_lists_take(&s.lists, &q->alloc, objects, workers->count, most < UINT32_MAX ? (uint32_t)most : UINT32_MAX);
    base_task *task = &workers->task;
    const size_t jobs = ((size_t)q->tree->node_count + NODES_PER_JOB - 1) / NODES_PER_JOB;
    if (!status) status = base_run(task, 0.8, jobs, pair_run, &s);
    if (!status) status = pair_lists_sort(&s.lists, task, 0.2);
    if (!status) pair_lists_tell(&s.lists, fn, user);
    pair_lists_give(&s.lists);
    return status;
}
