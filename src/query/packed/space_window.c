/* space_window.c: windows on packed trees of space.
 *
 * Nodes are visited level by level, so that each has been prefetched while the others of its level were looked at.
 * Leaves are gathered first and their blocks prefetched, then tested. What a kernel is sure of is reported, the rest is
 * decided exactly; an object that several leaves list is looked at once. */
#include "query/packed/space.h"

/* Objects of a block that meet the window. False without memory, or if the block is not good. */
static bool answer_space_window(froe_query *q, uint32_t block, const space_window *window) {
    space_work *w = q->space;
    const space_header *h = space_block(q->tree, block);
    if (!query_leaf_is_good(q, block)) return false;
    const size_t room = h->count + PACKED_LANES;
    bool memory = false;
    w->objects.count = 0;
    if (!query_expect(q, h->count) || !array_reserve(&q->alloc, &w->objects, 2 * room)) return false;
    space_answers answers = {w->objects.data, w->objects.data + room, 0, 0};
    w->kernels->window(h, window, &answers);
    q->stats.leaves++;
    q->found.count += query_mark_all(&q->marks, answers.sure, 1, answers.sure_count, q->found.data + q->found.count);
    for (size_t i = 0; i < answers.unsure_count; i++)
        if (query_mark(&q->marks, answers.unsure[i]) && query_range_meets(q, answers.unsure[i], &memory))
            query_found(q, answers.unsure[i]);
    return true;
}

froe_status space_range(froe_query *q, const double *lo, const double *hi, bool any) {
    const tree_wide *wide = q->tree->packed.wide;
    space_window window;
    window.wide = wide;
    for (int k = 0; k < 3; k++) {
        window.lo[k] = lo[k], window.hi[k] = hi[k];
        window.from[k] = (lo[k] - wide->middle[k]) * wide->scale;
        window.to[k] = (hi[k] - wide->middle[k]) * wide->scale;
    }
    /* Nodes whose boxes the window may meet become `objects`; the blocks of such leaves, `others`. */
    space_work *w = q->space;
    w->objects.count = w->others.count = 0;
    if (!array_push(&q->alloc, &w->objects, 0)) return FROE_E_MEMORY;
    for (size_t at = 0; at < w->objects.count; at++) {
        const wide_node *n = wide->nodes + w->objects.data[at];
        q->stats.nodes++;
        if (!array_reserve(&q->alloc, &w->objects, WIDE_CHILDREN) ||
            !array_reserve(&q->alloc, &w->others, WIDE_CHILDREN))
            return FROE_E_MEMORY;
        for (uint32_t bits = w->kernels->window_node(n, &window); bits; bits &= bits - 1) {
            const uint32_t child = n->child[__builtin_ctz(bits)];
            space_prefetch(q->tree, child);
            if (child & WIDE_LEAF)
                w->others.data[w->others.count++] = child & WIDE_INDEX;
            else
                w->objects.data[w->objects.count++] = child;
        }
    }
    for (size_t i = 0; i < q->space->others.count && !(any && q->found.count); i++)
        if (!answer_space_window(q, q->space->others.data[i], &window)) return FROE_E_MEMORY;
    return FROE_OK;
}
