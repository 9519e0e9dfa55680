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
#include "tree/packed/table.h"
#include <string.h>

enum { ALL_OPEN = 15, MOST_STARTS = 9 };

/* ----------------------------------------------------------------- context -- */

froe_status packed_work_new(const froe_tree *t, packed_work **out) {
    packed_work *work = support_calloc(&t->alloc, 1, sizeof *work);
    if (!work) return FROE_E_MEMORY;
    work->kernels = packed_kernels_at(0);
    work->climb_size = t->report.height + 2;
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
    array_free(alloc, &work->far);
    array_free(alloc, &work->squares);
    support_free(alloc, work->climbs, PACKED_FLIGHT * work->climb_size * sizeof *work->climbs);
    support_free(alloc, work, sizeof *work);
}

/* -------------------------------------------------------------------- walk -- */

static const packed_header *block_at(const froe_tree *t, uint32_t block) {
    return (const packed_header *)(const void *)(t->packed.blocks + (size_t)block * PACKED_BLOCK);
}

static bool visit_leaf(froe_query *q, uint32_t block, uint32_t count) {
    const packed_visit visit = {block, 0, count};
    if (!count) return true;
    const uint8_t *bytes = q->tree->packed.blocks + (size_t)block * PACKED_BLOCK;
    for (uint32_t at = 0; at < 32 + 12 * count; at += 64) __builtin_prefetch(bytes + at);
    return array_push(&q->alloc, &q->packed->visits, visit);
}

/* All leaves below a node whose closed cells meet the window. False without memory. */
static bool walk_window(froe_query *q, const packed_window *w, uint32_t node, uint32_t open) {
    const tree_node *nodes = q->tree->nodes;
    packed_work *work = q->packed;
    packed_waiting *stack = work->stack.data, *top = stack;
    *top++ = (packed_waiting){node, open};
    while (top > stack) {
        packed_waiting at = *--top;
        const tree_node *n = nodes + at.node;
        while (at.open && !tree_is_leaf(n)) {
            uint32_t axis = n->axis, low = w->lo[axis] <= n->u.value, high = w->hi[axis] >= n->u.value;
            q->stats.nodes++;
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
            const packed_visit visit = {n->child, last->child + packed_size(last->u.list.count), 0};
            __builtin_prefetch(block_at(q->tree, visit.block));
            __builtin_prefetch(block_at(q->tree, visit.end));
            if (!array_push(&q->alloc, &work->visits, visit)) return false;
        } else if (!visit_leaf(q, n->child, n->u.list.count)) {
            return false;
        }
    }
    return true;
}

/* Entries of the table that cover the window, each once; 0: it has to begin at the root. */
static uint32_t find_starts(const tree_table *table, const packed_window *w, tree_entry starts[MOST_STARTS]) {
    uint32_t from[2], to[2], count = 0, ragged = 0;
    if (!table) return 0;
    for (int k = 0; k < 2; k++) tree_table_span(table, k, w->lo[k], w->hi[k], &from[k], &to[k]);
    if ((uint64_t)(to[0] - from[0] + 1) * (to[1] - from[1] + 1) > MOST_STARTS) return 0;
    for (int k = 0; k < 2; k++)
        for (uint32_t line = from[k] + 1; line <= to[k]; line++) ragged |= table->crooked[k][line];
    for (uint32_t i = from[0]; i <= to[0]; i++)
        for (uint32_t j = from[1]; j <= to[1]; j++) {
            tree_entry entry = tree_table_at(table, i, j);
            uint32_t k = 0;
            ragged |= entry.kind == TABLE_RAGGED;
            while (k < count && (starts[k].at != entry.at || starts[k].kind != entry.kind)) k++;
            if (k == count) starts[count++] = entry;
        }
    return ragged && count > 1 ? 0 : count;
}

/* Fills visits. */
static froe_status collect(froe_query *q, const packed_window *w) {
    tree_entry starts[MOST_STARTS];
    const tree_meta *m = &q->tree->meta;
    uint32_t count, open = 0;
    q->packed->visits.count = q->packed->unsure.count = 0;
    for (int k = 0; k < 2; k++) { /* sides of the window that are beyond the root box are not open */
        if (w->lo[k] > m->root_hi[k] || w->hi[k] < m->root_lo[k]) return FROE_OK;
        if (w->lo[k] > m->root_lo[k]) open |= 1u << (2 * k);
        if (w->hi[k] < m->root_hi[k]) open |= 2u << (2 * k);
    }
    count = find_starts(q->tree->packed.table, w, starts);
    if (!count) return walk_window(q, w, 0, open) ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        bool leaf = starts[i].kind & TABLE_LEAF;
        if (!(leaf ? visit_leaf(q, starts[i].at, starts[i].kind & ~TABLE_LEAF)
                   : walk_window(q, w, starts[i].at, ALL_OPEN)))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
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

/* Appends the answers of one visit to query->found. False without memory. */
static bool answer_window(froe_query *q, const packed_visit *v, const packed_window *w) {
    const packed_header *block = block_at(q->tree, v->block);
    packed_work *work = q->packed;
    if (v->end) {
        uint32_t from = block->owner, count = block_at(q->tree, v->end)->owner - from;
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
    work->kernels->window(block, v->count, w, &out);
    q->found.count = out.count;
    work->unsure.count = out.unsure_count;
    q->stats.leaves++;
    q->stats.tests += v->count;
    return true;
}

/* Decides what is unsure. */
static bool settle_unsure(froe_query *q, const packed_window *w) {
    packed_work *work = q->packed;
    uint64_t exact = q->numbers.stats.exact;
    work->decided += work->unsure.count;
    if (!array_reserve(&q->alloc, &q->found, work->unsure.count)) return false;
    for (size_t i = 0; i < work->unsure.count; i++)
        if (reports(q, work->unsure.data + i, w))
            q->found.data[q->found.count++] = work->unsure.data[i].id & PACKED_OBJECT;
    work->unsure.count = 0;
    q->stats.exact += q->numbers.stats.exact - exact;
    return true;
}

static packed_window window_of(const double *lo, const double *hi) {
    return (packed_window){{lo[0], lo[1]}, {hi[0], hi[1]}};
}

froe_status packed_range(froe_query *q, const double *lo, const double *hi) {
    packed_window w = window_of(lo, hi);
    froe_status status = collect(q, &w);
    q->found.count = 0;
    for (size_t i = 0; i < q->packed->visits.count && !status; i++)
        if (!answer_window(q, q->packed->visits.data + i, &w)) status = FROE_E_MEMORY;
    return status || settle_unsure(q, &w) ? status : FROE_E_MEMORY;
}

froe_status packed_count_range(froe_query *q, const double *lo, const double *hi, uint64_t *out) {
    packed_window w = window_of(lo, hi);
    froe_status status = collect(q, &w);
    uint64_t sum = 0;
    q->found.count = 0;
    for (size_t i = 0; i < q->packed->visits.count && !status; i++) {
        const packed_visit *v = q->packed->visits.data + i;
        if (v->end)
            sum += block_at(q->tree, v->end)->owner - block_at(q->tree, v->block)->owner, q->stats.slices++;
        else if (!answer_window(q, v, &w))
            status = FROE_E_MEMORY;
        sum += q->found.count;
        q->found.count = 0;
    }
    if (!status && !settle_unsure(q, &w)) status = FROE_E_MEMORY;
    sum += q->found.count;
    q->found.count = 0;
    if (!status) *out = sum;
    return status;
}

froe_status packed_any(froe_query *q, const double *lo, const double *hi) {
    packed_window w = window_of(lo, hi);
    froe_status status = collect(q, &w);
    q->found.count = 0;
    for (size_t i = 0; i < q->packed->visits.count && !status && !q->found.count; i++) {
        if (!answer_window(q, q->packed->visits.data + i, &w) || !settle_unsure(q, &w)) status = FROE_E_MEMORY;
    }
    return status;
}
