/* wide.c: boxes bottom up, then wide nodes top down. */
#include "tree/packed/wide.h"
#include <math.h>
#include <string.h>

typedef struct bounds {
    double lo[3], hi[3]; /* lo > hi: nothing */
} bounds;

/* What a subtree costs as a forest of at most j + 1 trees: leaves and wide nodes. */
typedef struct forest {
    float cost[WIDE_CHILDREN];
    uint8_t share[WIDE_CHILDREN]; /* trees on the negative side; 0: it is as good with one tree less, or one */
} forest;

typedef struct widening {
    const froe_tree *tree;
    tree_wide *wide;
    bounds *boxes;        /* [node] */
    forest *forests;      /* [node] */
    ARRAY(uint32_t) todo; /* node of each wide node */
    ARRAY(wide_node) nodes;
} widening;

/* ------------------------------------------------------------------- boxes -- */

/* Objects may reach 2^-20 units beyond the box (space.h). Coordinates of the tree and of queries, below 1 where they
 * matter, are rounded by less than 2^-52. */
static bounds leaf_box(const tree_wide *w, const space_header *h) {
    bounds b = {{1, 1, 1}, {-1, -1, -1}};
    if (!h->count) return b;
    for (int k = 0; k < 3; k++) {
        double lo = (h->lo[k] - w->middle[k]) * w->scale, unit = w->scale / h->scale;
        b.lo[k] = lo + (h->box[0][k] - 0x1p-19) * unit - 0x1p-50;
        b.hi[k] = lo + (h->box[1][k] + 0x1p-19) * unit + 0x1p-50;
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

static void find_box(widening *w, uint32_t node) {
    const tree_node *n = w->tree->nodes + node;
    w->boxes[node] = tree_is_leaf(n) ? leaf_box(w->wide, space_block(w->tree, n->child))
                                     : both(w->boxes + n->child, w->boxes + n->child + 1);
}

static bool is_empty(const widening *w, uint32_t node) {
    return w->boxes[node].lo[0] > w->boxes[node].hi[0];
}

static float surface(const bounds *b) {
    double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];
    return (float)(x * y + y * z + z * x);
}

/* ------------------------------------------------------------------ forests -- */

/* The binary nodes to become wide ones are those of least total surface, which is how many a search visits (Ylitie,
 * Karras and Laine). Bottom up: a subtree stands as a forest of j trees for the sum of its sides at their best shares.
 */

static void share_out(const forest *a, const forest *b, forest *out) {
    for (int j = 1; j < WIDE_CHILDREN; j++) {
        out->cost[j] = INFINITY;
        for (int i = 0; i < j; i++) {
            const float cost = a->cost[i] + b->cost[j - 1 - i];
            if (cost < out->cost[j]) out->cost[j] = cost, out->share[j] = (uint8_t)(i + 1);
        }
    }
}

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
        share_out(w->forests + n->child, w->forests + n->child + 1, f);
        f->cost[0] = surface(w->boxes + node) + f->cost[WIDE_CHILDREN - 1];
    }
    for (int j = 1; j < WIDE_CHILDREN; j++)
        if (!(f->cost[j] < f->cost[j - 1])) f->cost[j] = f->cost[j - 1], f->share[j] = 0;
}

/* Children come after their parents. */
static void find_boxes(widening *w) {
    for (uint32_t i = w->tree->node_count; i-- > 0;) {
        find_box(w, i);
        find_forest(w, i);
    }
}

/* ------------------------------------------------------------------- nodes -- */

/* What a node is but for sides without objects. */
static uint32_t essence(const widening *w, uint32_t node) {
    const tree_node *n = w->tree->nodes + node;
    while (!tree_is_leaf(n) && (is_empty(w, n->child) || is_empty(w, n->child + 1))) {
        node = n->child + is_empty(w, n->child);
        n = w->tree->nodes + node;
    }
    return node;
}

/* Up to sixteen nodes that stand for this one; in the order of the tree. The stack has at most one entry for each. */
static uint32_t open_up(const widening *w, uint32_t node, uint32_t child[]) {
    struct {
        uint32_t node, room;
    } stack[WIDE_CHILDREN] = {{node, WIDE_CHILDREN}};
    uint32_t count = 0, top = 1;
    bool first = true;
    while (top) {
        const uint32_t at = essence(w, stack[--top].node);
        uint32_t room = stack[top].room, share = 0;
        if (is_empty(w, at)) continue;
        for (; room > 1 && !share; room -= !share) share = w->forests[at].share[room - 1];
        if (first && !share && !tree_is_leaf(w->tree->nodes + at)) room = WIDE_CHILDREN, share = 1; /* it has to be */
        first = false;
        if (!share) {
            child[count++] = at;
            continue;
        }
        const uint32_t below = w->tree->nodes[at].child;
        stack[top].node = below + 1, stack[top++].room = room - share;
        stack[top].node = below, stack[top++].room = share;
    }
    return count;
}

/* The largest shift for which the size is at most 254 units. */
static uint8_t shift_for(double size) {
    int exponent;
    frexp(size, &exponent); /* size < 2^exponent */
    int shift = 8 - exponent;
    return (uint8_t)(ldexp(size, shift) <= 254 ? shift : shift - 1);
}

static uint8_t byte_below(double u) {
    return (uint8_t)(u > 0 ? u < 255 ? u : 255 : 0);
}

static uint8_t byte_above(double u) {
    const uint8_t below = byte_below(u);
    return (uint8_t)(below + (u > below && below < 255));
}

static void fill_wide_node(const widening *w, wide_node *n, const bounds *all, const uint32_t child[], uint32_t count) {
    *n = (wide_node){.count = (uint8_t)count, .unused = WIDE_NORMAL};
    for (int k = 0; k < 3; k++) {
        n->lo[k] = all->lo[k] + 0.0;
        n->shift[k] = shift_for(all->hi[k] - all->lo[k]);
        const double per = ldexp(1, n->shift[k]);
        for (uint32_t i = 0; i < count; i++) {
            const bounds *b = w->boxes + child[i];
            n->box[0][k][i] = byte_below((b->lo[k] - n->lo[k]) * per);
            n->box[1][k][i] = byte_above((b->hi[k] - n->lo[k]) * per);
        }
    }
}

/* Breadth first: siblings lie together. */
static bool make_nodes(widening *w) {
    const froe_allocator *alloc = &w->tree->alloc;
    uint32_t child[WIDE_CHILDREN];
    if (!array_push(alloc, &w->todo, 0)) return false;
    for (size_t i = 0; i < w->todo.count; i++) {
        uint32_t node = w->todo.data[i], count = open_up(w, node, child);
        wide_node wide;
        fill_wide_node(w, &wide, w->boxes + node, child, count);
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
    wide->memory = support_calloc(&w->tree->alloc, wide->memory_size, 1);
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
    wide->inverse = ldexp(1, exponent);
}

froe_status tree_wide_new(const froe_tree *t, tree_wide **out) {
    *out = NULL;
    if (!fits(t)) return FROE_OK;
    tree_wide *wide = support_calloc(&t->alloc, 1, sizeof *wide);
    if (!wide) return FROE_E_MEMORY;
    widening w = {.tree = t, .wide = wide};
    set_frame(wide, &t->meta);
    w.boxes = support_calloc(&t->alloc, t->node_count, sizeof *w.boxes);
    w.forests = support_calloc(&t->alloc, t->node_count, sizeof *w.forests);
    bool made = w.boxes && w.forests;
    if (made) find_boxes(&w);
    made = made && make_nodes(&w) && place_nodes(&w);
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

void tree_wide_free(const froe_allocator *alloc, tree_wide *wide) {
    if (!wide) return;
    support_free(alloc, wide->memory, wide->memory_size);
    support_free(alloc, wide, sizeof *wide);
}

uint64_t tree_wide_bytes(const tree_wide *wide) {
    return wide ? wide->memory_size + sizeof *wide : 0;
}
