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
#include <string.h>

enum { NODES_PER_JOB = 512 };

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
    const packed_header *block; /* of the leaf in turn */
    packed_box cell;            /* its cell, if it is known */
    bool cell_known;
    froe_status status;
} pairing;

/* ------------------------------------------------------------------ places -- */

/* Is a corner of an object in the cell? It lies in no cut (packed.h), and so in no other cell. */
static bool is_here(const pairing *p, const double *x) {
    return x[0] >= p->cell.lo[0] && x[0] <= p->cell.hi[0] && x[1] >= p->cell.lo[1] && x[1] <= p->cell.hi[1];
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

static bool segment_holds(pairing *p, const double *const s[2], const double *x) {
    return query_segment_meets_box(&p->q->numbers, s[0], s[1], x, x);
}

/* The first common point of two objects that meet, but do not cross, is an end of one of them. Ends are in order, so it
 * is where one of the objects begins, or where one ends if they have nothing else in common. */
static bool end_here(pairing *p, const double *const a[2], const double *const b[2]) {
    if (segment_holds(p, b, a[0])) return is_here(p, a[0]);
    if (segment_holds(p, a, b[0])) return is_here(p, b[0]);
    return is_here(p, segment_holds(p, b, a[1]) ? a[1] : b[1]);
}

/* ------------------------------------------------------------------- pairs -- */

static void gather_pair(pairing *p, uint32_t a, uint32_t b, froe_meeting kind) {
    if (!p->status) p->status = pair_lists_add(&p->search->lists, p->worker, a, b, kind);
}

/* Which corners of objects are one vertex? As 2 * (corner of one) + (corner of the other); -1: none is. */
static int shared_corner(const packed_corners *one, const packed_corners *other) {
    if (one->vertex[0] == other->vertex[0]) return 0;
    if (one->vertex[0] == other->vertex[1]) return 1;
    if (one->vertex[1] == other->vertex[0]) return 2;
    return one->vertex[1] == other->vertex[1] ? 3 : -1;
}

/* Are two segments that share corners on one line? */
static bool are_in_line(pairing *p, const packed_corners *one, const packed_corners *other, int shared) {
    const froe_scene *s = p->q->tree->scene;
    return !query_turn(&p->q->numbers, scene_vertex(s, one->vertex[0]), scene_vertex(s, one->vertex[1]),
                       scene_vertex(s, other->vertex[!(shared & 1)]));
}

/* Is a vertex that fragments i and j both end in, or would if they were whole, in this leaf? It is where the fragment
 * has it as its own end. */
static bool has_end_here(const pairing *p, const uint32_t *ids, const packed_open *o, uint32_t vertex) {
    const froe_scene *s = p->q->tree->scene;
    const double *ends[2];
    if (packed_is_whole(ids[o->i]) || packed_is_whole(ids[o->j])) return true;
    packed_ends(s, ids[o->i] & PACKED_OBJECT, ends);
    return ids[o->i] & (ends[0] == scene_vertex(s, vertex) ? PACKED_START : PACKED_END);
}

/* Objects that meet in other ways than in one corner, if at all. */
static void decide_contact(pairing *p, uint32_t a, uint32_t b) {
    static const froe_meeting kinds[GEOM_CONTACTS] = {
        [GEOM_CROSS] = FROE_MEET_CROSS, [GEOM_TOUCH] = FROE_MEET_TOUCH, [GEOM_OVERLAP] = FROE_MEET_OVERLAP};
    const froe_scene *s = p->q->tree->scene;
    const double *u[2], *v[2];
    signed char sides[4];
    const geom_body one = scene_body(s, a), other = scene_body(s, b);
    const geom_contact c = geom_contact_of(&p->q->numbers, &one, &other, sides);
    if (c.kind == GEOM_APART) return;
    if (!p->search->shared && c.kind == GEOM_TOUCH && c.touch == GEOM_TOUCH_AT_CORNER) return;
    if (!p->cell_known) packed_cell(p->q->tree, p->block, &p->cell);
    p->cell_known = true;
    packed_ends(s, a, u);
    packed_ends(s, b, v);
    if (c.kind == GEOM_CROSS ? crossing_here(p, u, v) : end_here(p, u, v)) gather_pair(p, a, b, kinds[c.kind]);
}

/* Two segments that share a corner and are not on one line meet in that corner alone: on maps nearly all pairs are
 * such. Equal points are one vertex, so most of them are decided without coordinates. */
static void decide_pair(pairing *p, const uint32_t *ids, const packed_open *o) {
    const packed_corners *one = p->q->packed->corners.data + o->i, *other = p->q->packed->corners.data + o->j;
    const uint32_t a = ids[o->i] & PACKED_OBJECT, b = ids[o->j] & PACKED_OBJECT;
    const int shared = shared_corner(one, other);
    p->q->packed->decided++;
    if (shared < 0 || (!o->bent && are_in_line(p, one, other, shared)))
        decide_contact(p, a, b);
    else if (p->search->shared && has_end_here(p, ids, o, one->vertex[shared >> 1]))
        gather_pair(p, a, b, FROE_MEET_TOUCH);
}

/* Finds the corners of all fragments of open pairs. Loads of one object wait for each other; those of different objects
 * overlap. */
static bool find_corners(froe_query *q, const uint32_t *ids, uint32_t count) {
    packed_work *work = q->packed;
    const froe_scene *s = q->tree->scene;
    work->corners.count = work->candidates.count = 0;
    if (!array_reserve(&q->alloc, &work->corners, count) || !array_reserve(&q->alloc, &work->candidates, count))
        return false;
    memset(work->corners.data, 0xff, count * sizeof *work->corners.data);
    for (size_t n = 0; n < 2 * work->open.count; n++) {
        const uint32_t i = n % 2 ? work->open.data[n / 2].j : work->open.data[n / 2].i;
        if (!work->corners.data[i].vertex[0]) continue;
        work->corners.data[i].vertex[0] = 0;
        work->candidates.data[work->candidates.count++] = i;
        scene_ask_start(s, ids[i] & PACKED_OBJECT);
    }
    const uint32_t *wanted = work->candidates.data;
    for (size_t n = 0; n < work->candidates.count; n++)
        scene_ask_corner(s, scene_start(s, ids[wanted[n]] & PACKED_OBJECT));
    for (size_t n = 0; n < work->candidates.count; n++) {
        const uint32_t object = ids[wanted[n]] & PACKED_OBJECT, last = scene_corners(s, object) - 1;
        packed_corners *c = work->corners.data + wanted[n];
        c->vertex[0] = scene_corner(s, object, 0), c->vertex[1] = scene_corner(s, object, last);
        if (!s->vertex_of || !packed_is_whole(ids[wanted[n]])) scene_ask_points(s, object);
    }
    return true;
}

static bool decide_open(pairing *p, const uint32_t *ids, uint32_t count) {
    const packed_work *work = p->q->packed;
    if (!work->open.count) return true;
    if (!find_corners(p->q, ids, count)) return false;
    for (size_t n = 0; n < work->open.count && !p->status; n++) decide_pair(p, ids, work->open.data + n);
    return true;
}

/* Takes what a kernel says of the pairs of fragment i in a word. */
static bool take_word(pairing *p, const uint32_t *ids, uint32_t i, uint32_t word, const packed_row *row) {
    froe_query *q = p->q;
    for (uint32_t bits = row->crossing[word] | row->unsure[word]; bits; bits &= bits - 1) {
        const uint32_t bit = (uint32_t)__builtin_ctz(bits), j = word * PACKED_LANES + bit;
        if (row->crossing[word] >> bit & 1)
            gather_pair(p, ids[i] & PACKED_OBJECT, ids[j] & PACKED_OBJECT, FROE_MEET_CROSS);
        else if (!array_push(&q->alloc, &q->packed->open, (packed_open){i, j, row->bent[word] >> bit & 1}))
            return false;
    }
    return true;
}

static bool pair_leaf(pairing *p, const tree_node *leaf) {
    froe_query *q = p->q;
    const uint32_t count = leaf->u.list.count, words = (count + PACKED_LANES - 1) / PACKED_LANES;
    q->packed->bits.count = q->packed->open.count = 0;
    const size_t room = packed_boxes_room(count);
    if (!array_reserve(&q->alloc, &q->packed->bits, 4 * room + 3 * (size_t)words)) return false;
    uint16_t *boxes = q->packed->bits.data, *bits = boxes + 4 * room;
    packed_row row = {bits, bits + words, bits + 2 * (size_t)words};
    p->block = packed_block(q->tree, leaf);
    p->cell_known = false;
    const uint32_t *ids = packed_ids(p->block, count);
    q->stats.leaves++;
    q->packed->kernels->boxes(p->block, count, boxes);
    for (uint32_t i = 0; i + 1 < count && !p->status; i++) {
        q->stats.tests += count - i - 1;
        if (!q->packed->kernels->pairs(p->block, count, boxes, i, &row)) continue;
        for (uint32_t word = i / PACKED_LANES; word < words; word++)
            if (!take_word(p, ids, i, word, &row)) return false;
    }
    return decide_open(p, ids, count);
}

static froe_status pair_run(void *user, unsigned worker, size_t job) {
    packed_search *s = user;
    pairing p = {.search = s, .worker = worker, .q = s->workers->queries[worker]};
    const froe_tree *t = p.q->tree;
    const uint32_t from = (uint32_t)job * NODES_PER_JOB,
                   to = t->node_count - from < NODES_PER_JOB ? t->node_count : from + NODES_PER_JOB;
    p.q->stats.nodes += to - from;
    for (uint32_t i = from; i < to && !p.status; i++)
        if (tree_is_leaf(t->nodes + i) && t->nodes[i].u.list.count > 1 && !pair_leaf(&p, t->nodes + i))
            return FROE_E_MEMORY;
    return p.status;
}

/* -------------------------------------------------------------------- whole -- */

froe_status packed_pairs(query_workers *workers, bool shared, froe_pair_fn *fn, void *user) {
    const froe_query *q = workers->queries[0];
    const uint32_t objects = q->tree->scene->object_count;
    packed_search s = {.workers = workers, .shared = shared};
    froe_status status = pair_lists_take(&s.lists, &q->alloc, objects, workers->count);
    base_task *task = &workers->task;
    const size_t jobs = ((size_t)q->tree->node_count + NODES_PER_JOB - 1) / NODES_PER_JOB;
    if (!status) status = base_run(task, 0.8, jobs, pair_run, &s);
    if (!status) status = pair_lists_sort(&s.lists, task, 0.2);
    if (!status) pair_lists_tell(&s.lists, fn, user);
    pair_lists_give(&s.lists);
    return status;
}
