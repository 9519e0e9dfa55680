/* wide.c: boxes bottom up, then wide nodes top down. */
#include "tree/packed/wide.h"
#include <math.h>
#include <string.h>

typedef struct wide_box {
    double lo[3], hi[3]; /* lo > hi: nothing */
} wide_box;

/* What a subtree costs as a forest of at most j + 1 trees: leaves and wide nodes. */
typedef struct forest {
    float cost[WIDE_CHILDREN];
    uint8_t share[WIDE_CHILDREN]; /* trees on the negative side; 0: it is as good with one tree less, or one */
} forest;

typedef struct widening {
    const froe_tree *tree;
    tree_wide *wide;
    wide_box *boxes;      /* [node] */
    forest *forests;      /* [node] */
    ARRAY(uint32_t) todo; /* node of each wide node */
    ARRAY(wide_node) nodes;
} widening;

/* ------------------------------------------------------------------- boxes -- */

/* The box of a leaf, or around those of the children. Objects may reach 2^-20 units beyond the box of a leaf (space.h).
 * Coordinates of the tree and of queries, below 1 where they matter, are rounded by less than 2^-52. */
static wide_box box_of(const widening *w, const tree_node *n) {
    const tree_wide *frame = w->wide;
    wide_box box = {{1, 1, 1}, {-1, -1, -1}};
    if (tree_is_leaf(n)) {
        const space_header *h = space_block(w->tree, n->child);
        for (int k = 0; h->count && k < 3; k++) {
            double lo = (h->lo[k] - frame->middle[k]) * frame->scale, unit = frame->scale / h->scale;
            box.lo[k] = lo + (h->box[0][k] - 0x1p-19) * unit - 0x1p-50;
            box.hi[k] = lo + (h->box[1][k] + 0x1p-19) * unit + 0x1p-50;
        }
        return box;
    }
    const wide_box *a = w->boxes + n->child, *b = a + 1;
    if (a->lo[0] > a->hi[0]) return *b;
    if (b->lo[0] > b->hi[0]) return *a;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = a->lo[k] < b->lo[k] ? a->lo[k] : b->lo[k];
        box.hi[k] = a->hi[k] > b->hi[k] ? a->hi[k] : b->hi[k];
    }
    return box;
}

static bool is_empty(const widening *w, uint32_t node) {
    return w->boxes[node].lo[0] > w->boxes[node].hi[0];
}

/* ------------------------------------------------------------------ forests -- */

static void find_forest(widening *w, uint32_t node) {
    const tree_node *n = w->tree->nodes + node;
    forest *f = w->forests + node;
    const bool leaf = tree_is_leaf(n), left = !leaf && is_empty(w, n->child),
               right = !leaf && is_empty(w, n->child + 1);
    if (leaf || (left && right)) {
        *f = (forest){{0}, {0}};
    } else if (left || right) {
        *f = w->forests[n->child + left];
    } else {
        const forest *a = w->forests + n->child, *b = a + 1;
        for (int j = 1; j < WIDE_CHILDREN; j++) {
            f->cost[j] = INFINITY;
            for (int i = 0; i < j; i++) {
                const float cost = a->cost[i] + b->cost[j - 1 - i];
                if (cost < f->cost[j]) f->cost[j] = cost, f->share[j] = (uint8_t)(i + 1);
            }
        }
        const wide_box *box = w->boxes + node;
        double x = box->hi[0] - box->lo[0], y = box->hi[1] - box->lo[1], z = box->hi[2] - box->lo[2];
        f->cost[0] = (float)(x * y + y * z + z * x) + f->cost[WIDE_CHILDREN - 1];
    }
    for (int j = 1; j < WIDE_CHILDREN; j++)
        if (!(f->cost[j] < f->cost[j - 1])) f->cost[j] = f->cost[j - 1], f->share[j] = 0;
}

/* ------------------------------------------------------------------- nodes -- */

/* Up to sixteen nodes that stand for this one; in the order of the tree. The stack has at most one entry for each.
 * Nodes with a side without objects stand for their other side. */
static uint32_t open_up(const widening *w, uint32_t node, uint32_t child[]) {
    struct {
        uint32_t node, room;
    } stack[WIDE_CHILDREN] = {{node, WIDE_CHILDREN}};
    uint32_t count = 0, top = 1;
    bool first = true;
    while (top) {
        uint32_t at = stack[--top].node, room = stack[top].room, share = 0;
        const tree_node *n = w->tree->nodes + at;
        for (; !tree_is_leaf(n) && (is_empty(w, n->child) || is_empty(w, n->child + 1)); n = w->tree->nodes + at)
            at = n->child + is_empty(w, n->child);
        if (is_empty(w, at)) continue;
        for (; room > 1 && !share; room -= !share) share = w->forests[at].share[room - 1];
        /* one way: a box costs more than its parts, but in float where 2^24 boxes below are as large */
        if (first && !share && !tree_is_leaf(n)) room = WIDE_CHILDREN, share = 1; /* it has to be */
        first = false;
        if (!share) {
            child[count++] = at;
            continue;
        }
        stack[top].node = n->child + 1, stack[top++].room = room - share;
        stack[top].node = n->child, stack[top++].room = share;
    }
    return count;
}

static uint8_t byte_below(double u) {
    return (uint8_t)(u > 0 ? u < 255 ? u : 255 : 0);
}

/* Units of the node: the largest shift for which its size is at most 254 of them, and bounds rounded outwards. */
static void fill_boxes(wide_node *n, const wide_box *all, const wide_box boxes[], const uint32_t child[]) {
    for (int k = 0; k < 3; k++) {
        const double size = all->hi[k] - all->lo[k];
        int exponent;
        frexp(size, &exponent); /* size < 2^exponent */
        int shift = 8 - exponent;
        if (ldexp(size, shift) > 254) shift--;
        n->lo[k] = all->lo[k] + 0.0;
        n->shift[k] = (uint8_t)shift;
        const double per = ldexp(1, n->shift[k]);
        for (uint32_t i = 0; i < n->count; i++) {
            const double above = (boxes[child[i]].hi[k] - n->lo[k]) * per;
            const uint8_t below = byte_below(above);
            n->box[0][k][i] = byte_below((boxes[child[i]].lo[k] - n->lo[k]) * per);
            n->box[1][k][i] = (uint8_t)(below + (above > below && below < 255));
        }
    }
}

/* Breadth first: siblings lie together. The finished nodes begin at cache lines. */
static bool make_nodes(widening *w) {
    const froe_allocator *alloc = &w->tree->alloc;
    uint32_t child[WIDE_CHILDREN];
    size_t level = 0; /* where the next one begins */
    if (!array_push(alloc, &w->todo, 0)) return false;
    for (size_t i = 0; i < w->todo.count; i++) {
        if (i == level) level = w->todo.count, w->wide->levels++;
        uint32_t node = w->todo.data[i], count = open_up(w, node, child);
        wide_node wide = {.count = (uint8_t)count, .unused = WIDE_NORMAL};
        fill_boxes(&wide, w->boxes + node, w->boxes, child);
        for (uint32_t c = 0; c < count; c++) {
            const tree_node *n = w->tree->nodes + child[c];
            wide.child[c] = tree_is_leaf(n) ? WIDE_LEAF | n->child : (uint32_t)w->todo.count;
            if (!tree_is_leaf(n) && !array_push(alloc, &w->todo, child[c])) return false;
        }
        if (!array_push(alloc, &w->nodes, wide)) return false;
    }
    tree_wide *out = w->wide;
    out->count = w->nodes.count;
    out->memory_size = out->count * sizeof(wide_node) + PACKED_BLOCK;
    out->memory = support_calloc(alloc, out->memory_size, 1);
    if (!out->memory) return false;
    size_t gap = (PACKED_BLOCK - (uintptr_t)out->memory % PACKED_BLOCK) % PACKED_BLOCK;
    out->nodes = (wide_node *)(void *)((uint8_t *)out->memory + gap);
    memcpy(out->nodes, w->nodes.data, out->count * sizeof(wide_node));
    return true;
}

/* ------------------------------------------------------------------- whole -- */

/* The coordinates of the wide tree; false: the tree has none. */
static bool frame_wide(const froe_tree *t, tree_wide *wide) {
    const tree_meta *m = &t->meta;
    double size = 0;
    int exponent;
    /* one way: so many blocks take 128 GB */
    if (!tree_is_space(t) || !t->scene->object_count || t->packed.block_count > WIDE_INDEX ||
        !space_is_tame(m->root_lo, m->root_hi))
        return false;
    for (int k = 0; k < 3; k++) {
        size = fmax(size, m->root_hi[k] - m->root_lo[k]);
        wide->middle[k] = 0.5 * m->root_lo[k] + 0.5 * m->root_hi[k];
    }
    frexp(size, &exponent);
    wide->scale = ldexp(1, -exponent);
    wide->inverse = ldexp(1, exponent);
    for (int k = 0; k < 3; k++) {
        wide->lo[k] = (m->root_lo[k] - wide->middle[k]) * wide->scale;
        wide->hi[k] = (m->root_hi[k] - wide->middle[k]) * wide->scale;
    }
    return true;
}

froe_status tree_wide_new(const froe_tree *t, tree_wide **out) {
    tree_wide frame = {.scale = 0};
    *out = NULL;
    if (!frame_wide(t, &frame)) return FROE_OK;
    tree_wide *wide = support_calloc(&t->alloc, 1, sizeof *wide);
    if (!wide) return FROE_E_MEMORY;
    *wide = frame;
    widening w = {.tree = t, .wide = wide};
    w.boxes = support_calloc(&t->alloc, t->node_count, sizeof *w.boxes);
    w.forests = support_calloc(&t->alloc, t->node_count, sizeof *w.forests);
    bool made = w.boxes && w.forests;
    for (uint32_t i = t->node_count; made && i-- > 0;) { /* children come after their parents */
        w.boxes[i] = box_of(&w, t->nodes + i);
        find_forest(&w, i);
    }
    made = made && make_nodes(&w);
    support_free(&t->alloc, w.boxes, t->node_count * sizeof *w.boxes);
    support_free(&t->alloc, w.forests, t->node_count * sizeof *w.forests);
    array_free(&t->alloc, &w.todo);
    array_free(&t->alloc, &w.nodes);
    if (made)
        *out = wide;
    else
        tree_wide_free(&t->alloc, wide);
    return made ? FROE_OK : FROE_E_MEMORY;
}

froe_status tree_wide_from(const froe_tree *t, wide_node *nodes, size_t count, size_t levels, tree_wide **out) {
    tree_wide frame = {.nodes = nodes, .count = count, .levels = levels};
    *out = NULL;
    const bool wanted = frame_wide(t, &frame);
    if (wanted != (count > 0) || wanted != (levels > 0)) return FROE_E_FORMAT;
    if (!wanted) return FROE_OK;
    *out = support_calloc(&t->alloc, 1, sizeof **out);
    if (!*out) return FROE_E_MEMORY;
    **out = frame;
    return FROE_OK;
}

/* Numbers that kernels do arithmetic with, and children that follow `last` or are leaves; *last is moved on. */
static bool node_fits(const froe_tree *t, const wide_node *n, size_t *last) {
    bool fits = n->count > 0 && n->count <= WIDE_CHILDREN && n->unused == WIDE_NORMAL;
    for (int k = 0; k < 3; k++) fits = fits && fabs(n->lo[k]) <= 2 && n->shift[k] >= 4;
    for (uint32_t i = 0; fits && i < n->count; i++) {
        const uint32_t child = n->child[i];
        if (child & WIDE_LEAF)
            fits = (child & ~WIDE_LEAF) < t->packed.block_count - 1; /* the last one is a sentinel */
        else
            fits = child == ++*last;
    }
    return fits;
}

bool tree_wide_fits(const froe_tree *t, const tree_wide *wide) {
    size_t levels = 0, last = 0, level = 0; /* level: where the next one begins */
    for (size_t i = 0; i < wide->count; i++) {
        if (i > last) return false;
        if (i == level) level = last + 1, levels++;
        if (!node_fits(t, wide->nodes + i, &last) || last >= wide->count) return false;
    }
    return levels == wide->levels; /* every node is the child of one before, and no other child is there */
}

void tree_wide_free(const froe_allocator *alloc, tree_wide *wide) {
    if (!wide) return;
    support_free(alloc, wide->memory, wide->memory_size);
    support_free(alloc, wide, sizeof *wide);
}

uint64_t tree_wide_bytes(const tree_wide *wide) {
    return wide ? wide->count * sizeof *wide->nodes + PACKED_BLOCK + sizeof *wide : 0;
}
