/* wide.c: boxes bottom up, then wide nodes top down. */
#include "tree/wide.h"
#include <math.h>
#include <string.h>

typedef struct bounds {
    double lo[3], hi[3]; /* lo > hi: nothing */
} bounds;

typedef struct widening {
    const froe_tree *tree;
    tree_wide *wide;
    bounds *boxes;        /* [node] */
    ARRAY(uint32_t) todo; /* node of each wide node */
    ARRAY(wide_node) nodes;
} widening;

/* ------------------------------------------------------------------- boxes -- */

static bounds leaf_box(const tree_wide *w, const space_header *h) {
    bounds b = {{1, 1, 1}, {-1, -1, -1}};
    if (!h->count) return b;
    for (int k = 0; k < 3; k++) {
        double lo = (h->lo[k] - w->middle[k]) * w->scale, unit = w->scale / h->scale;
        b.lo[k] = lo + h->box[0][k] * unit;
        b.hi[k] = lo + h->box[1][k] * unit;
    }
    return b;
}

static bounds both(const bounds *a, const bounds *b) {
    if (a->lo[0] > a->hi[0]) return *b;
    if (b->lo[0] > b->hi[0]) return *a;
    bounds c;
    for (int k = 0; k < 3; k++) {
        c.lo[k] = a->lo[k] < b->lo[k] ? a->lo[k] : b->lo[k];
        c.hi[k] = a->hi[k] > b->hi[k] ? a->hi[k] : b->hi[k];
    }
    return c;
}

/* Children come after their parents. */
static void find_boxes(widening *w) {
    for (uint32_t i = w->tree->node_count; i-- > 0;) {
        const tree_node *n = w->tree->nodes + i;
        w->boxes[i] = tree_is_leaf(n) ? leaf_box(w->wide, space_block(w->tree, n->child))
                                      : both(w->boxes + n->child, w->boxes + n->child + 1);
    }
}

static bool is_empty(const widening *w, uint32_t node) {
    return w->boxes[node].lo[0] > w->boxes[node].hi[0];
}

static double surface(const bounds *b) {
    double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

/* ------------------------------------------------------------------- nodes -- */

/* Appends a node, or what is below it, if one of its children is empty. */
static uint32_t add_child(const widening *w, uint32_t node, uint32_t child[], uint32_t count) {
    const tree_node *n = w->tree->nodes + node;
    while (!tree_is_leaf(n) && (is_empty(w, n->child) || is_empty(w, n->child + 1))) {
        node = n->child + is_empty(w, n->child);
        n = w->tree->nodes + node;
    }
    if (!is_empty(w, node)) child[count++] = node;
    return count;
}

/* Up to sixteen nodes that stand for this one; in the order of the tree. */
static uint32_t open_up(const widening *w, uint32_t node, uint32_t child[]) {
    uint32_t count = add_child(w, node, child, 0), best = 0;
    while (count && count < WIDE_CHILDREN) {
        double most = -1;
        for (uint32_t i = 0; i < count; i++)
            if (!tree_is_leaf(w->tree->nodes + child[i]) && surface(w->boxes + child[i]) > most)
                most = surface(w->boxes + child[i]), best = i;
        if (most < 0) return count;
        uint32_t opened = w->tree->nodes[child[best]].child;
        memmove(child + best + 2, child + best + 1, (count - best - 1) * sizeof *child);
        add_child(w, opened, child, best);
        add_child(w, opened + 1, child, best + 1);
        count++;
    }
    return count;
}

/* The largest shift for which the size is at most 254 units. */
static uint8_t shift_for(double size) {
    int exponent;
    if (size < 0x1p-110) return 100;
    frexp(size, &exponent); /* size < 2^exponent */
    int shift = 8 - exponent;
    return (uint8_t)(ldexp(size, shift) <= 254 ? shift : shift - 1);
}

static uint8_t byte_of(double u) {
    return (uint8_t)(u > 0 ? u < 255 ? u : 255 : 0);
}

static void fill(const widening *w, wide_node *n, const bounds *all, const uint32_t child[], uint32_t count) {
    *n = (wide_node){.count = (uint8_t)count};
    for (int k = 0; k < 3; k++) {
        n->lo[k] = all->lo[k] + 0.0;
        n->shift[k] = shift_for(all->hi[k] - all->lo[k]);
        for (uint32_t i = 0; i < count; i++) {
            const bounds *b = w->boxes + child[i];
            n->box[0][k][i] = byte_of(floor(ldexp(b->lo[k] - n->lo[k], n->shift[k])));
            n->box[1][k][i] = byte_of(ceil(ldexp(b->hi[k] - n->lo[k], n->shift[k])));
        }
    }
}

/* Breadth first: siblings lie together. */
static bool make_nodes(widening *w) {
    const froe_allocator *alloc = &w->tree->alloc;
    uint32_t child[WIDE_CHILDREN + 1];
    if (!array_push(alloc, &w->todo, 0)) return false;
    for (size_t i = 0; i < w->todo.count; i++) {
        uint32_t node = w->todo.data[i], count = open_up(w, node, child);
        wide_node wide;
        fill(w, &wide, w->boxes + node, child, count);
        for (uint32_t c = 0; c < count; c++) {
            const tree_node *n = w->tree->nodes + child[c];
            wide.child[c] = tree_is_leaf(n) ? WIDE_LEAF | n->child : (uint32_t)w->todo.count;
            if (!tree_is_leaf(n) && !array_push(alloc, &w->todo, child[c])) return false;
        }
        if (!array_push(alloc, &w->nodes, wide)) return false;
    }
    return true;
}

/* Nodes begin at cache lines. */
static bool place_nodes(widening *w) {
    tree_wide *wide = w->wide;
    wide->count = w->nodes.count;
    wide->memory_size = wide->count * sizeof(wide_node) + PACKED_BLOCK;
    wide->memory = base_calloc(&w->tree->alloc, wide->memory_size, 1);
    if (!wide->memory) return false;
    size_t gap = (PACKED_BLOCK - (uintptr_t)wide->memory % PACKED_BLOCK) % PACKED_BLOCK;
    wide->nodes = (wide_node *)(void *)((uint8_t *)wide->memory + gap);
    memcpy(wide->nodes, w->nodes.data, wide->count * sizeof(wide_node));
    return true;
}

/* ------------------------------------------------------------------- whole -- */

static bool fits(const froe_tree *t) {
    return tree_is_space(t) && t->scene->object_count && t->packed.block_count <= WIDE_INDEX &&
           space_is_tame(t->meta.root_lo, t->meta.root_hi);
}

static void set_frame(tree_wide *wide, const tree_meta *m) {
    double size = 0;
    int exponent;
    for (int k = 0; k < 3; k++) {
        size = fmax(size, m->root_hi[k] - m->root_lo[k]);
        wide->middle[k] = 0.5 * m->root_lo[k] + 0.5 * m->root_hi[k];
    }
    frexp(size, &exponent);
    wide->scale = ldexp(1, -exponent);
}

froe_status tree_wide_new(const froe_tree *t, tree_wide **out) {
    *out = NULL;
    if (!fits(t)) return FROE_OK;
    tree_wide *wide = base_calloc(&t->alloc, 1, sizeof *wide);
    if (!wide) return FROE_E_MEMORY;
    widening w = {.tree = t, .wide = wide};
    set_frame(wide, &t->meta);
    w.boxes = base_calloc(&t->alloc, t->node_count, sizeof *w.boxes);
    bool made = w.boxes;
    if (made) find_boxes(&w);
    made = made && make_nodes(&w) && place_nodes(&w);
    base_free(&t->alloc, w.boxes, t->node_count * sizeof *w.boxes);
    array_free(&t->alloc, &w.todo);
    array_free(&t->alloc, &w.nodes);
    if (made)
        *out = wide;
    else
        tree_wide_free(&t->alloc, wide);
    return made ? FROE_OK : FROE_E_MEMORY;
}

void tree_wide_free(const froe_allocator *alloc, tree_wide *wide) {
    if (!wide) return;
    base_free(alloc, wide->memory, wide->memory_size);
    base_free(alloc, wide, sizeof *wide);
}

uint64_t tree_wide_bytes(const tree_wide *wide) {
    return wide ? wide->memory_size + sizeof *wide : 0;
}
