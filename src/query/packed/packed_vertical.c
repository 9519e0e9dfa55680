/* packed_vertical.c: the first segment above or below a point.
 *
 *      |   |  2 |     A ray begins in its column of the jump table and climbs from cell to cell; below, cuts
 *      +---+----+     across it have both sides on a stack, the nearer one first. What it meets first in the first
 *      |   | 1 /|     leaf where it meets anything is the answer: pieces end where their cells do, and by general
 *      +---+-|--+     position (tree/packed/packed.h) every segment through that point is in this very leaf.
 *      |   | 0  |
 *
 * Rays advance in batches: each in turn tests its block, which it prefetched one round before, and prefetches its next
 * one. */
#include "query/packed/packed.h"
#include "query/segment.h"

enum { TABLE_AHEAD = 16, NAMED_AHEAD = 8 }; /* points of a batch */

/** A ray in progress. */
typedef struct climb {
    const double *point;
    uint32_t *object; /* its answer */
    uint32_t *stack;
    uint32_t waiting;      /* nodes on the stack */
    uint32_t block, count; /* of the leaf to be tested next */
    uint32_t column, row;  /* of the table; column NO_TABLE: none */
    tree_entry last;       /* the entry that it went to last */
    uint64_t nodes;        /* passed */
} climb;
#define NO_TABLE UINT32_MAX

/* At a leaf: prefetches its block. */
static void arrive_at_block(const froe_tree *t, climb *c, uint32_t block, uint32_t count) {
    c->block = block;
    c->count = count;
    packed_ask_block(t, block, count);
}

/* Goes down to the leaf where the ray begins or enters; what comes after it on its way waits. */
static void descend_from(const froe_tree *t, climb *c, int direction, uint32_t node) {
    const tree_node *n = t->nodes + node;
    for (; !tree_is_leaf(n); c->nodes++) {
        uint32_t upper = c->point[n->axis] >= n->u.value, ahead = n->axis == 1 && (direction > 0) == !upper;
        c->stack[c->waiting] = n->child + !upper;
        c->waiting += ahead;
        n = t->nodes + n->child + upper;
    }
    arrive_at_block(t, c, n->child, n->u.list.count);
}

/* Goes on at the leaf or node that an entry of the table names. */
static void enter_column(const froe_tree *t, climb *c, int direction, tree_entry entry) {
    c->last = entry;
    if (entry.kind & TABLE_LEAF) {
        arrive_at_block(t, c, entry.at, entry.kind & ~TABLE_LEAF);
    } else {
        packed_ask_nodes(t, entry.at);
        descend_from(t, c, direction, entry.at);
    }
}

static void begin_at_root(const froe_tree *t, climb *c, int direction) {
    c->column = NO_TABLE;
    c->waiting = 0;
    descend_from(t, c, direction, 0);
}

/* Finds the next leaf of a ray; false: there is none. */
static bool go_on_climbing(const froe_tree *t, climb *c, int direction) {
    const tree_table *table = t->packed.table;
    if (c->waiting) {
        descend_from(t, c, direction, c->stack[--c->waiting]);
        return true;
    }
    if (c->column == NO_TABLE) return false;
    while (direction > 0 ? c->row + 1 < table->cells[1] : c->row > 0) {
        uint32_t line = direction > 0 ? c->row + 1 : c->row;
        if (table->crooked[1][line]) { /* the table says nothing of crooked lines */
            begin_at_root(t, c, direction);
            return true;
        }
        c->row += direction > 0 ? 1u : UINT32_MAX;
        tree_entry entry = tree_table_at(table, c->column, c->row);
        if (entry.at == c->last.at && entry.kind == c->last.kind) continue;
        enter_column(t, c, direction, entry);
        return true;
    }
    return false;
}

/* ------------------------------------------------------------------- leaves -- */

/* What the ray meets in a leaf; FROE_NONE. */
static uint32_t test(froe_query *q, uint32_t block, uint32_t count, const double *point, int direction) {
    const uint8_t *bytes = q->tree->packed.blocks + (size_t)block * PACKED_BLOCK;
    const packed_header *header = (const packed_header *)(const void *)bytes;
    packed_heights h = {.candidates = q->packed->candidates.data};
    if (!count || !query_leaf_is_good(q, block)) return FROE_NONE;
    q->stats.leaves++;
    q->stats.tests += count;
    q->packed->kernels->vertical(header, count, point, direction, &h);
    if (h.sure || !h.count) return h.count ? h.candidates[0] : FROE_NONE;
    /* The candidate that is met first, exactly. */
    query_height best = {0}, here;
    uint32_t object = FROE_NONE;
    const double *ends[2];
    q->packed->decided += h.count;
    for (uint32_t i = 0; i < h.count; i++) {
        if (scene_kind(q->tree->scene, h.candidates[i]) != FROE_SEGMENT) continue; /* points never are sure */
        packed_ends(q->tree->scene, h.candidates[i], ends);
        if (!query_height_at(&q->numbers, ends[0], ends[1], point, direction, &here)) continue;
        int order = object == FROE_NONE ? -1 : query_height_compare(&q->numbers, &here, &best) * direction;
        if (order > 0 || (order == 0 && h.candidates[i] > object)) continue;
        best = here;
        object = h.candidates[i];
    }
    if (object == FROE_NONE) return FROE_NONE;
    /* Beyond the far side of its cell, it is not in this leaf that the ray meets it. */
    packed_box cell;
    packed_cell(q->tree, header, &cell);
    const query_height side = {.known = true, .x = best.x, .y = direction > 0 ? cell.hi[1] : cell.lo[1]};
    return query_height_compare(&q->numbers, &best, &side) * direction > 0 ? FROE_NONE : object;
}

/* -------------------------------------------------------------------- whole -- */

/* Begins the next of the points that can have an answer. */
static size_t launch_climbs(froe_query *q, const double *points, size_t count, size_t next, int direction,
                            uint32_t *objects, climb *c, bool *flies) {
    const tree_meta *m = &q->tree->meta;
    const tree_table *table = q->tree->packed.table;
    *flies = false;
    for (; next < count && !*flies; next++) {
        const double *x = points + 2 * next;
        const bool beside = x[0] < m->root_lo[0] || x[0] > m->root_hi[0];
        objects[next] = FROE_NONE;
        if (beside || !(direction > 0 ? x[1] <= m->root_hi[1] : x[1] >= m->root_lo[1])) continue;
        c->point = x;
        c->object = objects + next;
        c->nodes = 0;
        *flies = true;
        /* The first leaf of the ray: by the column of the table in whose core its point is, if any. */
        const double place = table ? tree_table_place(table, 0, x[0]) : -1;
        const bool in_table = place >= 0 && place < table->cells[0];
        c->waiting = 0;
        c->column = in_table ? (uint32_t)place : 0;
        if (!in_table || !(place >= c->column + TABLE_MARGIN && place <= c->column + 1 - TABLE_MARGIN)) {
            begin_at_root(q->tree, c, direction);
            continue;
        }
        uint32_t from, to;
        tree_table_span(table, 1, x[1], x[1], &from, &to);
        c->row = direction > 0 ? from : to;
        enter_column(q->tree, c, direction, tree_table_at(table, c->column, c->row));
    }
    return next;
}

/* The answer of one ray. Where it waits for memory, it prefetches the block after next meanwhile. */
static uint32_t climb_alone(froe_query *q, climb *c, int direction, bool waits) {
    uint32_t object = FROE_NONE;
    for (bool more = true; more && object == FROE_NONE;) {
        const uint32_t block = c->block, in_block = c->count;
        if (waits) more = go_on_climbing(q->tree, c, direction);
        object = test(q, block, in_block, c->point, direction);
        if (!waits && object == FROE_NONE) more = go_on_climbing(q->tree, c, direction);
    }
    q->stats.nodes += c->nodes;
    return object;
}

/* What rays need that begin soon. */
PACKED_ASK void ask_ahead(const froe_tree *t, const double *points, size_t count, size_t next) {
    if (next + TABLE_AHEAD < count) packed_ask_table(t, points + 2 * (next + TABLE_AHEAD), false);
    if (next + NAMED_AHEAD < count) packed_ask_table(t, points + 2 * (next + NAMED_AHEAD), true);
}

/* The next ray takes the place of one that is answered; where none is left, the last one does. */
static void climb_together(froe_query *q, const double *points, size_t count, int direction, uint32_t *objects) {
    packed_work *work = q->packed;
    climb batch[PACKED_FLIGHT];
    size_t next = 0, flying = 0;
    for (bool flies = true; flying < PACKED_FLIGHT && flies; flying += flies) {
        batch[flying].stack = work->climbs + flying * work->climb_size;
        ask_ahead(q->tree, points, count, next);
        next = launch_climbs(q, points, count, next, direction, objects, batch + flying, &flies);
    }
    for (size_t i = 0; flying; i = i + 1 < flying ? i + 1 : 0) {
        climb *c = batch + i;
        uint32_t object = test(q, c->block, c->count, c->point, direction), *stack = c->stack;
        bool flies;
        if (object == FROE_NONE && go_on_climbing(q->tree, c, direction)) continue;
        *c->object = object;
        q->stats.nodes += c->nodes;
        ask_ahead(q->tree, points, count, next);
        next = launch_climbs(q, points, count, next, direction, objects, c, &flies);
        if (flies) continue;
        *c = batch[--flying];
        batch[flying].stack = stack;
        if (i == flying) i = 0;
    }
}

froe_status packed_vertical(froe_query *q, const double *points, size_t count, int direction, uint32_t *objects) {
    packed_work *work = q->packed;
    const bool waits = q->tree->packed.block_count >= work->flock_from;
    climb alone = {.stack = work->climbs};
    q->stats.queries += count;
    work->candidates.count = 0;
    if (!array_reserve(&q->alloc, &work->candidates, q->tree->report.max_leaf + PACKED_LANES)) return FROE_E_MEMORY;
    if (waits && count > 1) climb_together(q, points, count, direction, objects);
    for (size_t i = 0; i < count && (!waits || count == 1); i++) {
        bool flies;
        launch_climbs(q, points + 2 * i, 1, 0, direction, objects + i, &alone, &flies);
        if (flies) objects[i] = climb_alone(q, &alone, direction, waits);
    }
    return q->bad.found ? FROE_E_MEMORY : FROE_OK;
}
