/* packed_window.c: windows on packed trees: report, count, any.
 *
 *     +-----+-----+-----+     A fragment reports if it meets the window and the segment enters the window with it:
 *     |   __|__---|--   |     its first end is outside, or is the segment's own. Just one fragment of each segment
 *     |--'+-|-----|--+  |     does, the window being convex, so nothing is marked or sorted. A cell inside the window
 *     +---|-+-----+--|--+     reports what begins there: of a subtree inside, that is one slice of the owners.
 *     |   +-|-----|--+  |
 *     +-----+-----+-----+     What a kernel leaves unsure is decided exactly, in its own cell: reports(). */
#include "query/packed/packed.h"
#include "query/segment.h"
#include <string.h>

enum { ALL_OPEN = 15, MOST_STARTS = 9, MANY_VISITS = 64, USUAL_ANSWERS = 64 };
enum { SOME_VISITS = 8 };                     /* of a window so large that most fragments near it have an end in it */
enum { VISITS_AHEAD = 24, OWNERS_AHEAD = 6 }; /* visits whose blocks are on their way from memory */
enum { FLOCK = 8, FLOCK_VISITS = 48 };      /* windows of which all visits are found before the first is made; visits */
enum { NODES_AHEAD = 8, TABLE_AHEAD = 16 }; /* windows */
enum { BLOCKS_CACHED = 1 << 14 };           /* 1 MB: no window waits for memory, and flocks cost a tenth */

/* Cells of the table. */
typedef struct packed_span {
    uint32_t from[2], to[2]; /* both included */
} packed_span;

/* ----------------------------------------------------------------- context -- */

froe_status packed_work_new(const froe_tree *t, packed_work **out) {
    packed_work *work = support_calloc(&t->alloc, 1, sizeof *work);
    if (!work) return FROE_E_MEMORY;
    work->kernels = packed_kernels_at(0);
    work->flock_from = BLOCKS_CACHED;
    work->climb_size = (size_t)t->report.height + 2;
    work->climbs = support_calloc(&t->alloc, PACKED_FLIGHT * work->climb_size, sizeof *work->climbs);
    if (!work->climbs || !array_reserve(&t->alloc, &work->stack, t->report.height + 2) ||
        !array_reserve(&t->alloc, &work->far, t->report.height + 2)) {
        packed_work_free(work, &t->alloc);
        return FROE_E_MEMORY;
    }
    *out = work;
    return FROE_OK;
}

void packed_work_free(packed_work *work, const froe_allocator *alloc) {
    if (!work) return;
    array_free(alloc, &work->stack);
    array_free(alloc, &work->visits);
    array_free(alloc, &work->unsure);
    array_free(alloc, &work->candidates);
    array_free(alloc, &work->bits);
    array_free(alloc, &work->open);
    array_free(alloc, &work->corners);
    array_free(alloc, &work->far);
    array_free(alloc, &work->squares);
    support_free(alloc, work->climbs, PACKED_FLIGHT * work->climb_size * sizeof *work->climbs);
    support_free(alloc, work, sizeof *work);
}

/* -------------------------------------------------------------------- walk -- */

/* What is on its way to the first cache has one of its few line buffers, 16 on processors of Intel, and the leaves of a
 * window of ten have more lines. So where they wait for memory they are asked for into the second cache only. */
PACKED_ASK void ask_visit(const froe_tree *t, const packed_visit *v) {
    const uint8_t *bytes = t->packed.blocks + (size_t)v->block * PACKED_BLOCK;
    if (v->end) __builtin_prefetch(packed_block_at(t, v->end));
    if (t->packed.block_count < BLOCKS_CACHED)
        packed_ask_block(t, v->block, v->count);
    else
        for (uint32_t at = 0; at < 32 + 12 * v->count; at += 64) __builtin_prefetch(bytes + at, 0, 2);
}

static void forget_visits(packed_work *work) {
    work->visits.count = work->unsure.count = 0;
}

/* False without memory. */
static bool add_visit(froe_query *q, packed_visit visit) {
    packed_work *work = q->packed;
    if (work->visits.count < VISITS_AHEAD) ask_visit(q->tree, &visit);
    return array_push(&q->alloc, &work->visits, visit);
}

static bool visit_leaf(froe_query *q, uint32_t block, uint32_t count) {
    return !count || add_visit(q, (packed_visit){block, 0, count});
}

/* What comes below a node that waits. */
PACKED_ASK void ask_below(const froe_tree *t, const tree_node *n) {
    __builtin_prefetch(tree_is_leaf(n) ? (const void *)packed_block_at(t, n->child)
                                       : (const void *)(t->nodes + n->child));
}

/* All leaves below a node whose closed cells meet the window. False without memory. */
static bool walk_window(froe_query *q, const packed_window *w, uint32_t node, uint32_t open) {
    const tree_node *nodes = q->tree->nodes;
    packed_waiting *stack = q->packed->stack.data, *top = stack;
    const bool large = node == 0; /* from the table it is not far to leaves */
    *top++ = (packed_waiting){node, open};
    while (top > stack) {
        packed_waiting at = *--top;
        const tree_node *n = nodes + at.node;
        while (at.open && !tree_is_leaf(n)) {
            uint32_t axis = n->axis, low = w->lo[axis] <= n->u.value, high = w->hi[axis] >= n->u.value;
            q->stats.nodes++;
            if (large) ask_below(q->tree, nodes + n->child + 1);
            *top = (packed_waiting){n->child + 1, at.open & ~(low << (2 * axis))};
            top += low & high;
            at.open &= ~((low & high) << (2 * axis + 1));
            n = nodes + n->child + !low;
            at.node = (uint32_t)(n - nodes);
        }
        if (!at.open) { /* leaves of a subtree inside the window, as one visit */
            const tree_node *last = n = nodes + at.node;
            while (!tree_is_leaf(n)) n = nodes + n->child;
            while (!tree_is_leaf(last)) last = nodes + last->child + 1;
            if (!add_visit(q, (packed_visit){n->child, last->child + packed_size(last->u.list.count), 0})) return false;
        } else if (!visit_leaf(q, n->child, n->u.list.count)) {
            return false;
        }
    }
    return true;
}

/* Columns and rows of the table that a window reaches. False: it has to begin at the root. */
static inline bool find_span(const tree_table *table, const packed_window *w, packed_span *out) {
    if (!table) return false;
    for (int k = 0; k < 2; k++) tree_table_span(table, k, w->lo[k], w->hi[k], &out->from[k], &out->to[k]);
    return (uint64_t)(out->to[0] - out->from[0] + 1) * (out->to[1] - out->from[1] + 1) <= MOST_STARTS;
}

/* Entries of the table that cover the window, each once; 0: it has to begin at the root. */
static uint32_t find_starts(const tree_table *table, const packed_span *s, tree_entry starts[MOST_STARTS]) {
    uint32_t count = 0, ragged = 0;
    for (int k = 0; k < 2; k++)
        for (uint32_t line = s->from[k] + 1; line <= s->to[k]; line++) ragged |= table->crooked[k][line];
    for (uint32_t i = s->from[0]; i <= s->to[0]; i++)
        for (uint32_t j = s->from[1]; j <= s->to[1]; j++) {
            tree_entry entry = tree_table_at(table, i, j);
            uint32_t k = 0;
            ragged |= entry.kind == TABLE_RAGGED;
            while (k < count && (starts[k].at != entry.at || starts[k].kind != entry.kind)) k++;
            if (k == count) starts[count++] = entry;
        }
    return ragged && count > 1 ? 0 : count;
}

/* Adds the visits of a window. Its span NULL: it begins at the root. False without memory. */
static bool collect(froe_query *q, const packed_window *w, const packed_span *span) {
    tree_entry starts[MOST_STARTS];
    const tree_meta *m = &q->tree->meta;
    uint32_t count, open = 0;
    for (int k = 0; k < 2; k++) { /* sides of the window that are beyond the root box are not open */
        if (w->lo[k] > m->root_hi[k] || w->hi[k] < m->root_lo[k]) return true;
        if (w->lo[k] > m->root_lo[k]) open |= 1u << (2 * k);
        if (w->hi[k] < m->root_hi[k]) open |= 2u << (2 * k);
    }
    count = span ? find_starts(q->tree->packed.table, span, starts) : 0;
    if (!count) return walk_window(q, w, 0, open);
    for (uint32_t i = 0; i < count; i++) {
        bool leaf = starts[i].kind & TABLE_LEAF;
        if (!leaf) packed_ask_nodes(q->tree, starts[i].at);
        if (!(leaf ? visit_leaf(q, starts[i].at, starts[i].kind & ~TABLE_LEAF)
                   : walk_window(q, w, starts[i].at, ALL_OPEN)))
            return false;
    }
    return true;
}

/* The visits of one window. */
static bool collect_one(froe_query *q, const packed_window *w) {
    packed_span span;
    forget_visits(q->packed);
    return collect(q, w, find_span(q->tree->packed.table, w, &span) ? &span : NULL);
}

/* The same, and nothing is found yet. */
static bool collect_alone(froe_query *q, const packed_window *w) {
    q->found.count = 0;
    return collect_one(q, w);
}

/* ------------------------------------------------------------------ answers -- */

static bool ends_meet_box(froe_query *q, const double *const ends[2], const packed_box *box) {
    return query_segment_meets_box(&q->numbers, ends[0], ends[1], box->lo, box->hi);
}

/* Does a fragment report? What it has in the window is what the segment has in the window's part W of the cell. Its
 * first end, if that is no own one, is the point where the segment enters the cell: the only one it has on the left
 * side and on that, bottom or top, where it comes from. So that end is in the window if the segment meets W on one of
 * these. */
static bool reports(froe_query *q, const packed_unsure *u, const packed_window *w) {
    const double *ends[2];
    packed_box cell;
    packed_ends(q->tree->scene, u->id & PACKED_OBJECT, ends);
    if (packed_is_whole(u->id)) return ends_meet_box(q, ends, w);
    packed_cell(q->tree, u->block, &cell);
    packed_box part;
    for (int k = 0; k < 2; k++) {
        part.lo[k] = cell.lo[k] > w->lo[k] ? cell.lo[k] : w->lo[k];
        part.hi[k] = cell.hi[k] < w->hi[k] ? cell.hi[k] : w->hi[k];
    }
    packed_box left = part, level = part;
    if (!ends_meet_box(q, ends, &part)) return false;
    if (u->id & PACKED_START) return true;
    left.hi[0] = cell.lo[0];
    level.lo[1] = level.hi[1] = ends[0][1] < ends[1][1] ? cell.lo[1] : cell.hi[1];
    bool upright = ends[0][0] == ends[1][0], flat = ends[0][1] == ends[1][1]; /* may lie along the root box */
    bool enters_left = !upright && left.lo[0] <= left.hi[0] && ends_meet_box(q, ends, &left);
    bool enters_level =
        !flat && part.lo[1] <= level.lo[1] && level.lo[1] <= part.hi[1] && ends_meet_box(q, ends, &level);
    return !enters_left && !enters_level;
}

/* How many objects begin in the leaves of a visit with an end, which is good. */
static inline uint32_t owners_of(const froe_tree *t, const packed_visit *v) {
    return packed_block_at(t, v->end)->owner - packed_block_at(t, v->block)->owner;
}

/* May the blocks of a visit be read? */
static inline bool is_good(froe_query *q, const packed_visit *v) {
    return !q->ready || (v->end ? query_owners_are_good(q, v->block, v->end) : query_leaf_is_good(q, v->block));
}

/* Appends the answers of one visit to query->found; with `whole`, of its leaf by whole units first. False without
 * memory, or where the visit is not good. */
static bool answer_window(froe_query *q, const packed_visit *v, const packed_window *w, bool whole) {
    const packed_header *block = packed_block_at(q->tree, v->block);
    packed_work *work = q->packed;
    if (!is_good(q, v)) return false;
    if (v->end) {
        const uint32_t from = block->owner, count = owners_of(q->tree, v);
        q->stats.slices++;
        if (!array_reserve(&q->alloc, &q->found, count)) return false;
        if (count) memcpy(q->found.data + q->found.count, q->tree->packed.owners + from, count * sizeof(uint32_t));
        q->found.count += count;
        return true;
    }
    if (!array_reserve(&q->alloc, &q->found, v->count + PACKED_LANES) ||
        !array_reserve(&q->alloc, &work->unsure, v->count))
        return false;
    packed_answers out = {q->found.data, q->found.count, work->unsure.data, work->unsure.count};
    work->kernels->window(block, v->count, w, whole, &out);
    q->found.count = out.count;
    work->unsure.count = out.unsure_count;
    q->stats.leaves++;
    q->stats.tests += v->count;
    return true;
}

/* Decides what is unsure. REQUIRES: room for all of it in query->found, as there is after one visit. */
static void decide_unsure(froe_query *q, const packed_window *w) {
    packed_work *work = q->packed;
    uint64_t exact = q->numbers.stats.exact;
    work->decided += work->unsure.count;
    for (size_t i = 0; i < work->unsure.count; i++)
        if (reports(q, work->unsure.data + i, w))
            q->found.data[q->found.count++] = work->unsure.data[i].id & PACKED_OBJECT;
    work->unsure.count = 0;
    q->stats.exact += q->numbers.stats.exact - exact;
}

/* The same after any number of visits. False without memory. */
static bool settle_unsure(froe_query *q, const packed_window *w) {
    if (!array_reserve(&q->alloc, &q->found, q->packed->unsure.count)) return false;
    decide_unsure(q, w);
    return true;
}

static packed_window window_of(const double *lo, const double *hi) {
    return (packed_window){{lo[0], lo[1]}, {hi[0], hi[1]}};
}

/* The beginning of a slice, once the block that names it has come. */
PACKED_ASK void ask_owners(const froe_tree *t, const packed_visit *v) {
    if (!v->end) return;
    const uint32_t *owners = t->packed.owners + packed_block_at(t, v->block)->owner;
    for (uint32_t i = 0; i < 4; i++) __builtin_prefetch(owners + 16 * i);
}

/* Visit i, whose blocks have been prefetched, while those of a later one are. */
static inline const packed_visit *make_visit(froe_query *q, size_t i) {
    const packed_work *work = q->packed;
    if (i + VISITS_AHEAD < work->visits.count) ask_visit(q->tree, work->visits.data + i + VISITS_AHEAD);
    if (i + OWNERS_AHEAD < work->visits.count) ask_owners(q->tree, work->visits.data + i + OWNERS_AHEAD);
    return work->visits.data + i;
}

/* Makes room for all answers of many visits, where there is little: an array that grows visit by visit is copied again
 * and again. False without memory. */
static bool expect_answers(froe_query *q, size_t from, size_t to) {
    if (to - from < MANY_VISITS || q->found.capacity - q->found.count >= (to - from) * USUAL_ANSWERS) return true;
    size_t most = PACKED_LANES;
    for (size_t i = from; i < to; i++) {
        const packed_visit *v = make_visit(q, i);
        if (!is_good(q, v)) return false;
        most += v->end ? owners_of(q->tree, v) : v->count;
    }
    return array_reserve(&q->alloc, &q->found, most);
}

/* Appends the answers of visits `from` .. `to` - 1 to query->found. False without memory. */
static bool answer_visits(froe_query *q, size_t from, size_t to, const packed_window *w) {
    if (!expect_answers(q, from, to)) return false;
    for (size_t i = from; i < to; i++)
        if (!answer_window(q, make_visit(q, i), w, to - from >= SOME_VISITS)) return false;
    return settle_unsure(q, w);
}

froe_status packed_range(froe_query *q, const double *lo, const double *hi) {
    const packed_window w = window_of(lo, hi);
    return collect_alone(q, &w) && answer_visits(q, 0, q->packed->visits.count, &w) ? FROE_OK : FROE_E_MEMORY;
}

froe_status packed_count_range(froe_query *q, const double *lo, const double *hi, uint64_t *out) {
    const packed_window w = window_of(lo, hi);
    bool memory = collect_alone(q, &w);
    uint64_t sum = 0;
    for (size_t i = 0; i < q->packed->visits.count && memory; i++) {
        const packed_visit *v = make_visit(q, i);
        memory = is_good(q, v);
        if (v->end && memory) sum += owners_of(q->tree, v), q->stats.slices++;
        if (!v->end && memory) memory = answer_window(q, v, &w, q->packed->visits.count >= SOME_VISITS);
        sum += q->found.count;
        q->found.count = 0;
    }
    memory = memory && settle_unsure(q, &w);
    sum += q->found.count;
    if (memory) *out = sum;
    return memory ? FROE_OK : FROE_E_MEMORY;
}

froe_status packed_any(froe_query *q, const double *lo, const double *hi) {
    const packed_window w = window_of(lo, hi);
    bool memory = collect_alone(q, &w);
    for (size_t i = 0; i < q->packed->visits.count && memory && !q->found.count; i++) {
        memory = answer_window(q, make_visit(q, i), &w, false);
        if (memory) decide_unsure(q, &w);
    }
    return memory ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- flocks -- */

/* A window of a batch: its entries in the table are asked for first, then the nodes that these name, then blocks. */
typedef struct flying {
    packed_window window;
    packed_span span;
    bool spans;
    size_t end; /* of its visits */
} flying;

PACKED_ASK flying launch(const froe_tree *t, const double *corners) {
    const tree_table *table = t->packed.table;
    flying f = {.window = window_of(corners, corners + 2)};
    f.spans = find_span(table, &f.window, &f.span);
    for (uint32_t i = f.span.from[0]; f.spans && i <= f.span.to[0]; i++)
        __builtin_prefetch(table->entries + (size_t)i * table->cells[1] + f.span.from[1]);
    return f;
}

/* Prefetches nodes of the first and last entry: of most windows, of all. */
PACKED_ASK void ask_nodes(const froe_tree *t, const flying *f) {
    if (!f->spans) return;
    const tree_entry first = tree_table_at(t->packed.table, f->span.from[0], f->span.from[1]);
    const tree_entry last = tree_table_at(t->packed.table, f->span.to[0], f->span.to[1]);
    if (!(first.kind & TABLE_LEAF)) packed_ask_nodes(t, first.at);
    if (!(last.kind & TABLE_LEAF)) packed_ask_nodes(t, last.at);
}

/* One window after the other. */
static froe_status answer_in_order(froe_query *q, const double *const *boxes, size_t count, size_t *counts) {
    for (size_t i = 0; i < count; i++) {
        const packed_window w = window_of(boxes[i], boxes[i] + 2);
        const size_t before = q->found.count;
        if (!collect_one(q, &w) || !answer_visits(q, 0, q->packed->visits.count, &w)) return FROE_E_MEMORY;
        counts[i] = q->found.count - before;
    }
    return FROE_OK;
}

static froe_status answer_flocks(froe_query *q, const double *const *boxes, size_t count, size_t *counts) {
    packed_work *work = q->packed;
    flying flock[3 * FLOCK];
    size_t launched = 0, asked = 0, collected = 0, done = 0;
    while (done < count) {
        forget_visits(work);
        while (collected < count && collected - done < FLOCK && work->visits.count < FLOCK_VISITS) {
            for (; launched < count && launched <= collected + TABLE_AHEAD; launched++)
                flock[launched % (3 * FLOCK)] = launch(q->tree, boxes[launched]);
            for (; asked < count && asked <= collected + NODES_AHEAD; asked++)
                ask_nodes(q->tree, flock + asked % (3 * FLOCK));
            flying *f = flock + collected % (3 * FLOCK);
            if (!collect(q, &f->window, f->spans ? &f->span : NULL)) return FROE_E_MEMORY;
            f->end = work->visits.count;
            collected++;
        }
        for (size_t from = 0; done < collected; done++) {
            const flying *f = flock + done % (3 * FLOCK);
            const size_t before = q->found.count;
            if (!answer_visits(q, from, f->end, &f->window)) return FROE_E_MEMORY;
            counts[done] = q->found.count - before;
            from = f->end;
        }
    }
    return FROE_OK;
}

froe_status packed_ranges(froe_query *q, const double *const *boxes, size_t count, size_t *counts) {
    q->stats.queries += count;
    return (q->tree->packed.block_count < q->packed->flock_from ? answer_in_order : answer_flocks)(q, boxes, count,
                                                                                                   counts);
}
