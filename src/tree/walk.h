/* walk.h: all nodes, depth first, in the order of their numbers' pairs and of their lists.
 *
 *     tree_walk w = {.tree = t};
 *     while (tree_walk_next(&w)) ... w.node, tree_walk_depth(&w), w.path ...
 *     status = tree_walk_end(&w);
 *
 * No stack of pending nodes is needed: pairs begin at odd numbers, so an odd node is a left
 * child and its sibling comes next to it. The path (root first, ascending numbers) is all. */
#ifndef FROE_TREE_WALK_H
#define FROE_TREE_WALK_H
#include "tree/tree.h"

typedef struct tree_walk {
    const froe_tree *tree;
    uint32_t node;
    froe_status status;
    ARRAY(uint32_t) path;
} tree_walk;

/** Goes to the first or next node; false after the last and without memory. Trusts child links only
 * of the node left: a validator may walk what it has just checked. */
static inline bool tree_walk_next(tree_walk *w) {
    uint32_t next = 0;
    if (w->path.count && !tree_is_leaf(w->tree->nodes + w->node)) {
        next = w->tree->nodes[w->node].child;
    } else if (w->path.count) {
        while (w->path.count && w->path.data[w->path.count - 1] % 2 == 0) w->path.count--;
        if (!w->path.count) return false;
        next = w->path.data[--w->path.count] + 1;
    }
    if (!array_push(&w->tree->alloc, &w->path, next)) {
        w->status = FROE_E_MEMORY;
        return false;
    }
    w->node = next;
    return true;
}

static inline uint32_t tree_walk_depth(const tree_walk *w) {
    return (uint32_t)w->path.count - 1;
}

/** Is `node` a proper ancestor of the current one? O(log depth). */
static inline bool tree_walk_above(const tree_walk *w, uint32_t node) {
    size_t lo = 0, hi = w->path.count - 1;
    while (lo < hi) {
        size_t mid = lo + (hi - lo) / 2;
        if (w->path.data[mid] < node)
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo < w->path.count - 1 && w->path.data[lo] == node;
}

static inline froe_status tree_walk_end(tree_walk *w) {
    array_free(&w->tree->alloc, &w->path);
    return w->status;
}
#endif
