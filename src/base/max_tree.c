/* max_tree.c: a range-maximum tree with sums at the nodes; bottom-up, no recursion. */
#include "base/max_tree.h"

static uint32_t rounded_up(uint32_t size) {
    uint32_t power = 1;
    while (power < size) power *= 2;
    return power;
}

froe_status base_max_tree_new(const froe_allocator *alloc, uint32_t size, base_max_tree *out) {
    *out = (base_max_tree){.size = rounded_up(size)};
    out->node = support_calloc(alloc, 2 * (size_t)out->size, sizeof *out->node);
    return out->node ? FROE_OK : FROE_E_MEMORY;
}

void base_max_tree_free(const froe_allocator *alloc, base_max_tree *s) {
    support_free(alloc, s->node, 2 * (size_t)s->size * sizeof *s->node);
    s->node = NULL;
}

static int64_t higher(int64_t a, int64_t b) {
    return a > b ? a : b;
}

static void lift(base_max_tree_node *node, int64_t by) {
    node->add += by;
    node->max += by;
}

/** Brings the nodes above a changed one up to date. */
static void settle_inner(base_max_tree *s, uint32_t i) {
    for (i /= 2; i; i /= 2) s->node[i].max = higher(s->node[2 * i].max, s->node[2 * i + 1].max) + s->node[i].add;
}

void base_max_tree_raise(base_max_tree *s, uint32_t from, uint32_t end, int64_t by) {
    if (from >= end || !by) return;
    uint32_t a = from + s->size, b = end + s->size;
    for (; a < b; a /= 2, b /= 2) {
        if (a & 1) lift(s->node + a++, by);
        if (b & 1) lift(s->node + --b, by);
    }
    settle_inner(s, from + s->size);
    settle_inner(s, end - 1 + s->size);
}

/** What was added above node i. */
static int64_t above(const base_max_tree *s, uint32_t i) {
    int64_t sum = 0;
    for (i /= 2; i; i /= 2) sum += s->node[i].add;
    return sum;
}

/** Below node i, which has a number of at least `level` in it, the first or last of these. */
static uint32_t descend_to_first(const base_max_tree *s, uint32_t i, int64_t level, bool last) {
    level -= above(s, i);
    while (i < s->size) {
        level -= s->node[i].add;
        i = 2 * i + last;
        if (s->node[i].max < level) i ^= 1;
    }
    return i - s->size;
}

uint32_t base_max_tree_first(const base_max_tree *s, uint32_t from, uint32_t end, int64_t level) {
    if (from >= end) return BASE_MAX_TREE_NONE;
    uint32_t i = from + s->size;
    for (;;) { /* i: the next node that begins at the first position not yet looked at */
        while (!(i & 1)) i /= 2;
        if (s->node[i].max + above(s, i) >= level) {
            uint32_t at = descend_to_first(s, i, level, false);
            return at < end ? at : BASE_MAX_TREE_NONE;
        }
        if (!(i & (i + 1))) return BASE_MAX_TREE_NONE; /* nothing lies to the right */
        i++;
    }
}

uint32_t base_max_tree_last(const base_max_tree *s, uint32_t from, uint32_t end, int64_t level) {
    if (from >= end) return BASE_MAX_TREE_NONE;
    uint32_t i = end - 1 + s->size;
    for (;;) {
        while (i > 1 && i & 1) i /= 2;
        if (s->node[i].max + above(s, i) >= level) {
            uint32_t at = descend_to_first(s, i, level, true);
            return at >= from ? at : BASE_MAX_TREE_NONE;
        }
        if (!(i & (i - 1))) return BASE_MAX_TREE_NONE; /* nothing lies to the left */
        i--;
    }
}

int64_t base_max_tree_max(const base_max_tree *s, uint32_t from, uint32_t end) {
    uint32_t a = from + s->size, b = end + s->size;
    int64_t max = INT64_MIN;
    for (; a < b; a /= 2, b /= 2) {
        if (a & 1) max = higher(max, s->node[a].max + above(s, a)), a++;
        if (b & 1) --b, max = higher(max, s->node[b].max + above(s, b));
    }
    return max;
}
