/* packed_pairs.c: all pairs of objects of a packed tree that meet, each once.
 *
 *     +-------+------+     Objects that meet have a point in common, the first by x, then y. By general
 *     |   \ / |      |     position (tree/packed.h) both are in the list of every leaf whose closed cell
 *     |    X  |   ___|__   holds that point; the one whose half-open cell does finds them. Crossings well
 *     |   / \ |__/   |     inside of a cell are seen by the kernel, the rest is decided exactly.
 *     +-------+------+
 *
 * Leaves come in their own order, callers want pairs by ids: so they are gathered, counted by the first id,
 * and told then. Where there are too many for that, nothing is told, and the caller asks object by object. */
#include "geom/contact.h"
#include "query/heap.h"
#include "query/packed.h"
#include "query/segment.h"

enum { PAIRS_EACH = 16, PAIRS_MORE = 1 << 20 }; /* gathered for each object at most, and some more */
#define PAIR_KIND 30                            /* shift of the kind beside the higher id */

typedef struct gathered {
    uint32_t a, b; /* b with the kind above PACKED_OBJECT */
} gathered;

typedef struct pairing {
    froe_query *q;
    bool shared;
    packed_box cell;
    uint64_t most;
    froe_status status; /* FROE_E_LIMIT: more than `most` */
    ARRAY(gathered) pairs;
    uint32_t *starts; /* of the pairs of each first id, once sorted */
    gathered *sorted;
} pairing;

/* ------------------------------------------------------------------ places -- */

/* Is a number in lo <= x < hi? The last cells of the root box have their upper side, too. */
static bool in_span(const pairing *p, int axis, double x) {
    double hi = p->cell.hi[axis];
    return x >= p->cell.lo[axis] && (x < hi || (x == hi && hi == p->q->tree->meta.root_hi[axis]));
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

static bool holds(pairing *p, const double *const s[2], const double *x) {
    return query_segment_meets_box(&p->q->numbers, s[0], s[1], x, x);
}

/* The first common point of two objects that meet, but do not cross, is an end of one of them. */
static bool end_here(pairing *p, const double *const a[2], const double *const b[2]) {
    const double *first = NULL;
    for (int i = 0; i < 2; i++) {
        if ((!first || precedes(a[i], first)) && holds(p, b, a[i])) first = a[i];
        if ((!first || precedes(b[i], first)) && holds(p, a, b[i])) first = b[i];
    }
    return first && in_span(p, 0, first[0]) && in_span(p, 1, first[1]);
}

/* ------------------------------------------------------------------- pairs -- */

static void gather(pairing *p, uint32_t a, uint32_t b, froe_meeting kind) {
    const gathered pair = {a < b ? a : b, (a < b ? b : a) | (uint32_t)kind << PAIR_KIND};
    if (p->status) return;
    if (p->pairs.count == p->most)
        p->status = FROE_E_LIMIT;
    else if (!array_push(&p->q->alloc, &p->pairs, pair))
        p->status = FROE_E_MEMORY;
}

static void decide(pairing *p, uint32_t a, uint32_t b) {
    static const froe_meeting kinds[GEOM_CONTACTS] = {
        [GEOM_CROSS] = FROE_MEET_CROSS, [GEOM_TOUCH] = FROE_MEET_TOUCH, [GEOM_OVERLAP] = FROE_MEET_OVERLAP};
    const froe_scene *s = p->q->tree->scene;
    const geom_body one = scene_body(s, a), other = scene_body(s, b);
    signed char sides[4];
    const double *u[2], *v[2];
    const geom_contact c = geom_contact_of(&p->q->numbers, &one, &other, sides);
    p->q->packed->decided++;
    if (c.kind == GEOM_APART) return;
    if (!p->shared && c.kind == GEOM_TOUCH && c.touch == GEOM_TOUCH_AT_CORNER) return;
    packed_ends(s, a, u);
    packed_ends(s, b, v);
    if (c.kind == GEOM_CROSS ? crossing_here(p, u, v) : end_here(p, u, v)) gather(p, a, b, kinds[c.kind]);
}

/* Fragment i with all after it. */
static void pair_row(pairing *p, const uint32_t *ids, uint32_t count, uint32_t i, const packed_row *row) {
    for (uint32_t word = i / PACKED_LANES; word < (count + PACKED_LANES - 1) / PACKED_LANES; word++)
        for (uint32_t bits = row->crossing[word] | row->unsure[word]; bits && !p->status; bits &= bits - 1) {
            uint32_t bit = (uint32_t)__builtin_ctz(bits), j = word * PACKED_LANES + bit;
            if (row->crossing[word] >> bit & 1)
                gather(p, ids[i] & PACKED_OBJECT, ids[j] & PACKED_OBJECT, FROE_MEET_CROSS);
            else
                decide(p, ids[i] & PACKED_OBJECT, ids[j] & PACKED_OBJECT);
        }
}

static froe_status pair_leaf(pairing *p, const tree_node *leaf) {
    froe_query *q = p->q;
    const packed_header *block = packed_block(q->tree, leaf);
    uint32_t count = leaf->u.list.count, words = (count + PACKED_LANES - 1) / PACKED_LANES;
    const uint32_t *ids = packed_ids(block, count);
    if (!array_reserve(&q->alloc, &q->packed->bits, 2 * (size_t)words)) return FROE_E_MEMORY;
    packed_row row = {q->packed->bits.data, q->packed->bits.data + words};
    packed_cell(q->tree, block, &p->cell);
    q->stats.leaves++;
    for (uint32_t i = 0; i + 1 < count && !p->status; i++) {
        q->packed->kernels->pairs(block, count, i, &row);
        q->stats.tests += count - i - 1;
        pair_row(p, ids, count, i, &row);
    }
    return FROE_OK;
}

static void gather_all(pairing *p) {
    const froe_tree *t = p->q->tree;
    p->q->packed->bits.count = 0;
    for (uint32_t i = 0; i < t->node_count && !p->status; i++)
        if (tree_is_leaf(t->nodes + i) && t->nodes[i].u.list.count > 1 && pair_leaf(p, t->nodes + i))
            p->status = FROE_E_MEMORY;
}

/* ----------------------------------------------------------------- telling -- */

/* By the first id: counted, then put, from the last to the first. */
static froe_status sort_pairs(pairing *p) {
    size_t objects = p->q->tree->scene->object_count, n = p->pairs.count;
    p->starts = base_calloc(&p->q->alloc, objects + 1, sizeof *p->starts);
    p->sorted = base_calloc(&p->q->alloc, n, sizeof *p->sorted);
    if (!p->starts || !p->sorted) return FROE_E_MEMORY;
    for (size_t i = 0; i < n; i++) p->starts[p->pairs.data[i].a]++;
    for (size_t i = 1; i <= objects; i++) p->starts[i] += p->starts[i - 1];
    for (size_t i = n; i--;) p->sorted[--p->starts[p->pairs.data[i].a]] = p->pairs.data[i];
    return FROE_OK;
}

static bool later(void *user, uint32_t i, uint32_t j) {
    (void)user;
    return (i & PACKED_OBJECT) > (j & PACKED_OBJECT);
}

/* The pairs of one first id by the second; false: the visitor wants no more. */
static bool tell_one(pairing *p, uint32_t object, froe_pair_fn *fn, void *user) {
    uint32_t from = p->starts[object], to = p->starts[object + 1];
    p->q->packed->candidates.count = 0;
    for (uint32_t i = from; i < to; i++) p->q->packed->candidates.data[i - from] = p->sorted[i].b;
    query_heap_sort(p->q->packed->candidates.data, to - from, later, NULL);
    for (uint32_t i = 0; i < to - from; i++) {
        uint32_t b = p->q->packed->candidates.data[i];
        if (!fn(user, &(froe_pair){object, b & PACKED_OBJECT, (froe_meeting)(b >> PAIR_KIND)})) return false;
    }
    return true;
}

static froe_status tell_all(pairing *p, froe_pair_fn *fn, void *user) {
    uint32_t objects = p->q->tree->scene->object_count, most = 0;
    froe_status status = sort_pairs(p);
    for (uint32_t i = 0; i < objects && !status; i++)
        most = p->starts[i + 1] - p->starts[i] > most ? p->starts[i + 1] - p->starts[i] : most;
    p->q->packed->candidates.count = 0;
    if (!status && !array_reserve(&p->q->alloc, &p->q->packed->candidates, most)) status = FROE_E_MEMORY;
    for (uint32_t i = 0; i < objects && !status; i++)
        if (!tell_one(p, i, fn, user)) break;
    return status;
}

froe_status packed_pairs(froe_query *q, bool shared, froe_pair_fn *fn, void *user) {
    size_t objects = q->tree->scene->object_count;
    uint64_t most = (uint64_t)objects * PAIRS_EACH + PAIRS_MORE;
    pairing p = {.q = q, .shared = shared, .most = most < UINT32_MAX ? most : UINT32_MAX};
    gather_all(&p);
    if (!p.status) p.status = tell_all(&p, fn, user);
    base_free(&q->alloc, p.starts, (objects + 1) * sizeof *p.starts);
    base_free(&q->alloc, p.sorted, (p.pairs.count ? p.pairs.count * sizeof *p.sorted : 1));
    array_free(&q->alloc, &p.pairs);
    return p.status;
}
