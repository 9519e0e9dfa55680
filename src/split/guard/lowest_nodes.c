/* lowest_nodes.c: where each object's descent ends, then a counting sort of the objects by that node.
 *
 * As far as the guard tree is an octree, a table tells its node for each cell of the grid of grid_boxes.h, on all
 * levels. There the bits in which both codes of an object begin alike are its way down. Only below a shrink, or below
 * the grid, or when it touches a plane, does an object have to be compared with cuts. */
#include "split/guard/lowest_nodes.h"

enum { DESCENTS_PER_JOB = 8192, ABREAST = 8 }; /* objects of a job; objects that go down together */

typedef struct object_box {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} object_box;

#define ASTRAY 0x80000000u /* of a node in the map: what is below does not follow the grid */

typedef struct descent {
    const split_grid_boxes *grid_boxes;
    const split_guard_node *nodes;
    base_task *task;
    uint32_t *lowest;
    uint32_t *map; /* the node of each cell of the grid, on all levels; NULL: there is no grid */
    size_t map_count;
} descent;

/** Objects that have to go down by comparisons, up to ABREAST, and the nodes where they start. */
typedef struct queue {
    uint32_t object[ABREAST], node[ABREAST];
    size_t count;
} queue;

/* ------------------------------------------------------------------ the map -- */

/** The node of a cell's part, given that of the cell; its middle planes. */
static uint32_t part_node(const descent *d, uint32_t node, const double *mid, uint32_t part, int dim) {
    if (node & ASTRAY || !d->nodes[node].child) return node;
    uint32_t at = node;
    for (int i = 0; i < dim; i++) {
        const split_guard_node *n = d->nodes + at;
        if (!n->child || n->axis != i || n->value != mid[i]) return node | ASTRAY;
        at = n->child + guard_above(part, dim, i);
    }
    return at;
}

/* ---------------------------------------------------------------- the descent -- */

/** The lowest containing node of an object, if its codes tell; or a node above it, ASTRAY. */
static inline uint32_t look_up(const descent *d, const uint32_t code[2]) {
    const guard_grid *grid = &d->grid_boxes->grid;
    if (code[0] & GRID_BOXES_APART) return ASTRAY;
    uint32_t first = code[0] & GUARD_CODE, differ = first ^ code[1];
    int dim = grid->dim, bits = dim * grid->levels;
    if (!differ) { /* within a cell of the last level */
        uint32_t node = d->map[grid->starts[grid->levels] + first];
        return d->nodes[node & ~ASTRAY].child ? node | ASTRAY : node;
    }
    int alike = bits - 32 + __builtin_clz(differ), level = grid->level_of[alike], rest = bits - dim * level;
    uint32_t node = d->map[grid->starts[level] + (first >> rest)];
    if (d->map[grid->starts[level + 1] + (first >> (rest - dim))] & ASTRAY) return node | ASTRAY;
    for (int bit = rest - 1; bit >= bits - alike && d->nodes[node].child; bit--)
        node = d->nodes[node].child + (first >> bit & 1);
    return node;
}

static void empty(const descent *d, queue *q) {
    object_box boxes[ABREAST];
    for (size_t k = 0; k < q->count; k++)
        scene_object_bounds(d->grid_boxes->scene, q->object[k], boxes[k].lo, boxes[k].hi);
    /* For each box the lowest node whose cell holds it, or the first whose cut it lies across, or in, from a node
     * above on. Several boxes go down abreast, so that one waits for memory while others go on. */
    for (bool moving = true; moving;) {
        moving = false;
        for (size_t i = 0; i < q->count; i++) {
            const split_guard_node *n = d->nodes + q->node[i];
            bool below = boxes[i].lo[n->axis]<n->value, above = boxes[i].hi[n->axis]> n->value;
            bool step = n->child && below != above;
            q->node[i] = step ? n->child + above : q->node[i];
            moving |= step;
        }
    }
    for (size_t k = 0; k < q->count; k++) d->lowest[q->object[k]] = q->node[k];
    q->count = 0;
}

static froe_status descend_chunk(void *user, unsigned worker, size_t job) {
    const descent *d = user;
    size_t first = job * DESCENTS_PER_JOB, last = first + DESCENTS_PER_JOB;
    queue q = {.count = 0};
    (void)worker;
    if (base_cancelled(d->task)) return FROE_E_CANCELLED;
    if (last > d->grid_boxes->object_count) last = d->grid_boxes->object_count;
    for (size_t i = first; i < last; i++) {
        uint32_t node = d->map ? look_up(d, d->grid_boxes->codes[i]) : ASTRAY;
        d->lowest[i] = node;
        if (!(node & ASTRAY)) continue;
        q.object[q.count] = (uint32_t)i;
        q.node[q.count++] = node & ~ASTRAY;
        if (q.count == ABREAST) empty(d, &q);
    }
    empty(d, &q);
    return FROE_OK;
}

/* ------------------------------------------------------------------- the sort -- */

void split_lowest_nodes_free(const froe_allocator *alloc, split_lowest_nodes *h) {
    support_free(alloc, h->ids, h->object_count * sizeof *h->ids);
    support_free(alloc, h->at, h->node_count * sizeof *h->at);
    support_free(alloc, h->end, h->node_count * sizeof *h->end);
    *h = (split_lowest_nodes){0};
}

/** Memory for count numbers, not cleared; one at least. */
static uint32_t *numbers(const froe_allocator *alloc, size_t count) {
    return support_realloc(alloc, NULL, 0, count * sizeof(uint32_t));
}

/** Finds the lowest containing node of each object, given memory for them. */
static froe_status descend_to_lowest(const froe_allocator *alloc, descent *d) {
    size_t n = d->grid_boxes->object_count;
    const guard_grid *grid = &d->grid_boxes->grid;
    if (grid->levels) {
        d->map_count = grid->starts[grid->levels + 1];
        d->map = numbers(alloc, d->map_count);
        if (!d->map) return FROE_E_MEMORY;
        /* the node of each cell of the grid, level by level */
        int dim = grid->dim;
        d->map[0] = 0;
        for (int level = 0; level < grid->levels; level++)
            for (uint32_t code = 0; code < 1u << (dim * level); code++) {
                guard_cube cube;
                double mid[FROE_MAX_DIM];
                uint32_t node = d->map[grid->starts[level] + code], *parts = d->map + grid->starts[level + 1];
                guard_grid_cell(grid, level, code, &cube, mid);
                for (uint32_t part = 0; part < 1u << dim; part++)
                    parts[(code << dim) + part] = part_node(d, node, mid, part, dim);
            }
    }
    froe_status status = base_run(d->task, 0, (n + DESCENTS_PER_JOB - 1) / DESCENTS_PER_JOB, descend_chunk, d);
    support_free(alloc, d->map, d->map_count * sizeof *d->map);
    return status;
}

froe_status split_lowest_nodes_make(const froe_allocator *alloc, base_task *task, const split_grid_boxes *grid_boxes,
                                    const split_guard_tree *guard, split_lowest_nodes *out) {
    size_t n = grid_boxes->object_count, m = guard->nodes.count;
    if (!n) return FROE_OK;
    split_lowest_nodes h = {.object_count = n, .node_count = m};
    h.ids = numbers(alloc, n);
    h.at = numbers(alloc, m);
    h.end = numbers(alloc, m);
    uint32_t *lowest = numbers(alloc, n), *own = support_calloc(alloc, m, sizeof *own);
    descent d = {.grid_boxes = grid_boxes, .nodes = guard->nodes.data, .task = task, .lowest = lowest};
    froe_status status = h.ids && h.at && h.end && lowest && own ? descend_to_lowest(alloc, &d) : FROE_E_MEMORY;
    if (!status) {
        /* Counting sort of the objects by lowest containing node. `own` is zero. */
        for (size_t i = 0; i < h.object_count; i++) own[lowest[i]]++;
        /* slices from the numbers of nodes' own objects: children come later than their parent, so two passes do */
        for (size_t v = h.node_count; v-- > 0;) { /* end: so many objects in the subtree */
            uint32_t child = guard->nodes.data[v].child;
            h.end[v] = own[v] + (child ? h.end[child] + h.end[child + 1] : 0);
        }
        h.at[0] = 0;
        for (size_t v = 0; v < h.node_count; v++) {
            uint32_t child = guard->nodes.data[v].child;
            if (child) {
                h.at[child] = h.at[v] + own[v];
                h.at[child + 1] = h.at[child] + h.end[child];
            }
            h.end[v] += h.at[v];
        }
        for (size_t v = 0; v < h.node_count; v++) own[v] = h.at[v];
        for (uint32_t i = 0; i < h.object_count; i++) h.ids[own[lowest[i]]++] = i;
    }
    support_free(alloc, lowest, n * sizeof *lowest);
    support_free(alloc, own, m * sizeof *own);
    if (status)
        split_lowest_nodes_free(alloc, &h);
    else
        *out = h;
    return status;
}
