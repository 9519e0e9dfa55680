/* space_window.c: windows on packed trees of space, one or a flock of them, of which others go on while one waits for
 * memory.
 *
 *     nodes     0 1 2 | 0 0 1 2 | 0 0 0 1 1 2 2        of three windows, level by level
 *     leaves    0 -> . -> . -> 1 -> . -> 2 -> . -> .   window by window
 *
 * Nodes are visited level by level, so that each has been prefetched while the others of its level were looked at.
 * Leaves are gathered first and their blocks prefetched: of a single window all, of a flock some ahead of the one that
 * is tested. What a kernel is sure of is reported, the rest is decided exactly; an object that several leaves list is
 * looked at once. */
#include "query/packed/space.h"

enum { FLOCK = 32, LEAVES_AHEAD = 5 }; /* windows whose leaves are gathered together; leaves that are asked for */
enum { MET_AT_ONCE = 4096 };           /* objects from which on they are reported */

/* A window in flight. Its own entry of the list is before its leaves. */
typedef struct flown_window {
    space_window window;
    uint32_t last; /* of its entries so far */
} flown_window;

/* Of what kernels found since the last call, reports what is there for the first time. */
static void report_met(froe_query *q, size_t *met) {
    uint32_t *found = q->found.data + q->found.count;
    q->found.count += query_mark_all(&q->marks, found, 1, *met, found);
    *met = 0;
}

/* Objects of a block that meet the window go behind those that are reported, so many so far. The rest is decided
 * exactly. False without memory, or if the block is not good. */
static bool answer_leaf(froe_query *q, uint32_t block, const space_window *window, size_t *met) {
    space_work *w = q->space;
    const space_header *h = space_block(q->tree, block);
    if (!query_leaf_is_good(q, block)) return false;
    const size_t count = h->count;
    bool memory = false;
    if (!query_expect(q, *met + count) || !array_reserve(&q->alloc, &q->found, *met + count + PACKED_LANES) ||
        !array_reserve(&q->alloc, &w->objects, count + PACKED_LANES))
        return false;
    space_answers answers = {q->found.data + q->found.count + *met, w->objects.data, 0, 0};
    w->kernels->window(h, window, &answers);
    q->stats.leaves++;
    *met += answers.sure_count;
    if (answers.unsure_count || *met >= MET_AT_ONCE) report_met(q, met);
    for (size_t i = 0; i < answers.unsure_count; i++)
        if (query_mark(&q->marks, answers.unsure[i]) && query_range_meets(q, answers.unsure[i], &memory))
            query_found(q, answers.unsure[i]);
    return true;
}

static void launch(const tree_wide *wide, const double *box, flown_window *f) {
    f->window = (space_window){.wide = wide};
    for (int k = 0; k < 3; k++) {
        const double lo = box[k], hi = box[3 + k];
        f->window.lo[k] = lo, f->window.hi[k] = hi;
        f->window.from[k] = (lo - wide->middle[k]) * wide->scale;
        f->window.to[k] = (hi - wide->middle[k]) * wide->scale;
    }
}

/* Makes the list of leaves that the windows may meet, from the entry 0 to the entry `count`, which is none. Those of a
 * single window are asked for. False without memory. */
static bool find_leaves(froe_query *q, flown_window *flock, uint32_t count) {
    const tree_wide *wide = q->tree->packed.wide;
    space_work *w = q->space;
    w->nodes.count = w->leaves.count = 0;
    if (!array_reserve(&q->alloc, &w->nodes, FLOCK) || !array_reserve(&q->alloc, &w->leaves, FLOCK + 1)) return false;
    for (uint32_t i = 0; i < count; i++) {
        flock[i].last = i;
        w->nodes.data[i] = (space_visit){0, i};
    }
    w->nodes.count = count, w->leaves.count = count + 1;
    w->leaves.data[count].link = count;
    for (size_t at = 0; at < w->nodes.count; at++) {
        const space_visit visit = w->nodes.data[at];
        const wide_node *n = wide->nodes + visit.what;
        flown_window *f = count == 1 ? flock : flock + visit.link; /* of a single one, the link is not waited for */
        if (!array_reserve(&q->alloc, &w->nodes, WIDE_CHILDREN) || !array_reserve(&q->alloc, &w->leaves, WIDE_CHILDREN))
            return false;
        if (w->leaves.count > UINT32_MAX - WIDE_CHILDREN) return false; /* one way: so many take 32 GB */
        space_visit *nodes = w->nodes.data + w->nodes.count, *leaves = w->leaves.data;
        uint32_t leaf = (uint32_t)w->leaves.count, last = f->last;
        for (uint32_t bits = w->kernels->window_node(n, &f->window); bits; bits &= bits - 1) {
            const uint32_t child = n->child[__builtin_ctz(bits)];
            if (child & WIDE_LEAF) {
                if (count == 1) space_prefetch(q->tree, child);
                leaves[leaf].what = child;
                leaves[last].link = leaf;
                last = leaf++;
            } else {
                space_prefetch(q->tree, child);
                *nodes++ = (space_visit){child, visit.link};
            }
        }
        f->last = last;
        w->leaves.count = leaf;
        w->nodes.count = (size_t)(nodes - w->nodes.data);
    }
    q->stats.nodes += w->nodes.count;
    for (uint32_t i = count, next = count; i-- > 0; next = w->leaves.data[i].link)
        w->leaves.data[flock[i].last].link = next;
    return true;
}

/* Asks for the leaf that comes after one. */
__attribute__((always_inline)) static inline uint32_t ask_next(const froe_query *q, uint32_t asked, uint32_t count) {
    const uint32_t next = q->space->leaves.data[asked].link;
    if (next != count) space_prefetch(q->tree, q->space->leaves.data[next].what);
    return next;
}

static bool answer_flock(froe_query *q, const double *const *boxes, uint32_t count, bool any, size_t *counts) {
    flown_window flock[FLOCK];
    for (uint32_t i = 0; i < count; i++) launch(q->tree->packed.wide, boxes[i], flock + i);
    if (!find_leaves(q, flock, count)) return false;
    const space_visit *leaves = q->space->leaves.data;
    froe_range box; /* only these two are read */
    box.shape = FROE_SHAPE_BOX;
    uint32_t asked = count == 1 ? count : 0;
    for (uint32_t i = 0; i < LEAVES_AHEAD && asked != count; i++) asked = ask_next(q, asked, count);
    for (uint32_t i = 0; i < count; i++) {
        const size_t before = q->found.count;
        size_t met = 0;
        box.points = boxes[i];
        query_marks_clear(&q->marks);
        query_range_of_box(q, &box);
        q->stats.queries++;
        for (uint32_t at = i; at != flock[i].last && !(any && q->found.count + met);) {
            at = leaves[at].link;
            asked = ask_next(q, asked, count);
            if (!answer_leaf(q, leaves[at].what & WIDE_INDEX, &flock[i].window, &met)) return false;
        }
        report_met(q, &met); /* of several leaves at once: how many each has would be guessed wrong */
        counts[i] = q->found.count - before;
    }
    return true;
}

froe_status space_ranges(froe_query *q, const double *const *boxes, size_t count, bool any, size_t *counts) {
    for (size_t at = 0, some; at < count; at += some) {
        some = count - at < FLOCK ? count - at : FLOCK;
        if (!answer_flock(q, boxes + at, (uint32_t)some, any, counts + at)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}
