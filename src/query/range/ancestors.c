/* ancestors.c: see ancestors.h. */
#include "query/range/ancestors.h"
#include "support/fail.h"

static void free_ancestors(const froe_allocator *alloc, query_part *part) {
    query_ancestors *a = (query_ancestors *)part;
    support_free(alloc, a->of, a->node_count * sizeof *a->of);
    support_free(alloc, a->above, ((size_t)a->node_count + 1) * sizeof *a->above);
    support_free(alloc, a, sizeof *a);
}

/* The place of the highest bit. */
static unsigned top_bit(uint32_t x) {
    return 31 - (unsigned)__builtin_clz(x);
}

/* The number above x in the binary tree whose lowest bit is at a place. */
static uint32_t number_above(uint32_t x, unsigned place) {
    return (x >> place | 1) << place;
}

/* Of the numbers first + 1 .. last the one with the most zeros at the end. */
static uint32_t roundest(uint32_t first, uint32_t last) {
    const unsigned place = top_bit(first ^ last);
    return last >> place << place;
}

static froe_status make_ancestors(froe_query *q, query_part **out, froe_diagnostic *diag) {
    query_ancestors *a = support_calloc(&q->alloc, 1, sizeof *a);
    if (!a) return support_fail_memory(diag);
    a->part.free = free_ancestors;
    *out = &a->part;
    a->node_count = q->tree->node_count;
    a->of = support_calloc(&q->alloc, a->node_count, sizeof *a->of);
    a->above = support_calloc(&q->alloc, (size_t)a->node_count + 1, sizeof *a->above);
    if (!a->of || !a->above) return support_fail_memory(diag);
    /* Numbers nodes and paths, and links paths with those above. Sizes of subtrees are in `order` until a node gets its
     * number, parents first. */
    const froe_tree *t = q->tree;
    query_ancestor *of = a->of;
    for (uint32_t v = t->node_count; v-- > 0;) {
        of[v].order = 1;
        if (!tree_is_leaf(t->nodes + v)) of[v].order += of[t->nodes[v].child].order + of[t->nodes[v].child + 1].order;
    }
    of[0].path = roundest(0, of[0].order);
    of[0].order = 1;
    for (uint32_t v = 0; v < t->node_count; v++) {
        if (tree_is_leaf(t->nodes + v)) continue;
        uint32_t before = of[v].order;
        for (uint32_t child = t->nodes[v].child; child < t->nodes[v].child + 2; child++) {
            const uint32_t size = of[child].order;
            of[child].path = roundest(before, before + size);
            of[child].order = before + 1;
            before += size;
        }
    }
    of[0].ascending = of[0].path & -of[0].path;
    for (uint32_t v = 0; v < t->node_count; v++) {
        if (tree_is_leaf(t->nodes + v)) continue;
        for (uint32_t child = t->nodes[v].child; child < t->nodes[v].child + 2; child++) {
            of[child].ascending = of[v].ascending | (of[child].path & -of[child].path);
            if (of[child].path != of[v].path) a->above[of[child].path] = v;
        }
    }
    return FROE_OK;
}

froe_status query_ancestors_of(froe_query *query, const query_ancestors **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_ANCESTORS, make_ancestors, &part, diag);
    if (status == FROE_OK) *out = (const query_ancestors *)part;
    return status;
}

/* The lowest node on a path above a node, or the node itself where the path is its own. */
static uint32_t climb_path(const query_ancestors *a, uint32_t node, uint32_t path) {
    const query_ancestor *n = a->of + node;
    if (n->path == path) return node;
    const uint32_t below = n->ascending & ((path & -path) - 1);
    return a->above[number_above(n->path, top_bit(below))];
}

uint32_t query_ancestors_lowest(const query_ancestors *ancestors, uint32_t a, uint32_t b) {
    const query_ancestor *x = ancestors->of + a, *y = ancestors->of + b;
    if (x->path == y->path) return x->order < y->order ? a : b;
    const unsigned place = top_bit(x->path ^ y->path);
    const uint32_t common = (x->ascending & y->ascending) >> place << place;
    const uint32_t path = number_above(x->path, (unsigned)__builtin_ctz(common));
    const uint32_t from_a = climb_path(ancestors, a, path), from_b = climb_path(ancestors, b, path);
    return ancestors->of[from_a].order < ancestors->of[from_b].order ? from_a : from_b;
}
