/* dominance.c: building range trees axis by axis, and counting in them. */
#include "measure/dominance.h"
#include "base/sort.h"
#include <string.h>

typedef struct maker {
    measure_dominance *d;
    uint32_t count;
    uint32_t *const *rank;
    uint32_t *at[FROE_MAX_DIM]; /* the point of each rank */
    uint32_t *spare;            /* [3 count] */
} maker;

static int levels_of(uint32_t count) {
    int levels = 0;
    while (levels < 32 && (uint64_t)1 << levels < count) levels++;
    return levels;
}

/* ----------------------------------------------------------------- the last two -- */

static uint32_t lower_bound(const uint32_t *keys, uint32_t count, uint32_t key) {
    uint32_t from = 0, end = count;
    while (from < end) {
        uint32_t middle = from + (end - from) / 2;
        if (keys[middle] < key)
            from = middle + 1;
        else
            end = middle;
    }
    return from;
}

static size_t words_of(uint32_t count) {
    return (size_t)count / 64 + 1;
}

static int compare_ranks(void *user, uint32_t a, uint32_t b) {
    (void)user;
    return a < b ? -1 : a > b;
}

/* Appends the ranks, on the last axis, of a node's points, and splits them by their places on the axis before. */
static bool make_plane(maker *m, size_t at) {
    measure_dominance *d = m->d;
    measure_dominance_node *node = d->nodes.data + at;
    int axis = d->dim - 2;
    if (!array_reserve(&d->alloc, &d->keys, node->count)) return false;
    uint32_t *first = d->keys.data + node->keys, *last = first + node->count, *places = m->spare;
    for (uint32_t i = 0; i < node->count; i++) last[i] = m->rank[axis + 1][m->at[axis][first[i]]];
    base_merge_sort(last, m->spare, node->count, compare_ranks, NULL);
    for (uint32_t i = 0; i < node->count; i++)
        places[i] = lower_bound(first, node->count, m->rank[axis][m->at[axis + 1][last[i]]]);
    d->keys.count += node->count;
    /* Splits the list, level by level, stably: places that have the level's bit go right, behind all others. */
    int levels = levels_of(node->count);
    size_t words = words_of(node->count);
    uint32_t *right = m->spare + m->count;
    node->next = d->bits.count;
    if (!array_reserve(&d->alloc, &d->bits, words * (size_t)levels)) return false;
    for (int level = levels - 1; level >= 0; level--) {
        measure_dominance_bits *bits = d->bits.data + d->bits.count;
        uint32_t left = 0, rights = 0;
        memset(bits, 0, words * sizeof *bits);
        for (uint32_t i = 0; i < node->count; i++) {
            uint32_t goes = places[i] >> level & 1;
            if (!(i % 64)) bits[i / 64].before = rights;
            bits[i / 64].right |= (uint64_t)goes << i % 64;
            if (goes)
                right[rights++] = places[i];
            else
                places[left++] = places[i];
        }
        if (!(node->count % 64)) bits[node->count / 64].before = rights;
        memcpy(places + left, right, rights * sizeof *right);
        d->bits.count += words;
    }
    return true;
}

/* ------------------------------------------------------------------- the others -- */

/* A node for `axis` whose points are those of `count` ranks on the axis before, or all. */
static bool make_node(maker *m, int axis, const size_t *from, uint32_t count) {
    measure_dominance *d = m->d;
    measure_dominance_node node = {.keys = d->keys.count, .count = count};
    if (!array_reserve(&d->alloc, &d->keys, count) || !array_push(&d->alloc, &d->nodes, node)) return false;
    uint32_t *keys = d->keys.data + node.keys;
    for (uint32_t i = 0; i < count; i++) keys[i] = from ? m->rank[axis][m->at[axis - 1][d->keys.data[*from + i]]] : i;
    if (from) base_merge_sort(keys, m->spare, count, compare_ranks, NULL);
    d->keys.count += count;
    return axis < d->dim - 2 || make_plane(m, d->nodes.count - 1);
}

froe_status measure_dominance_new(const froe_allocator *alloc, int dim, uint32_t count, uint32_t *const rank[],
                                  measure_dominance *out) {
    size_t dims = (size_t)dim, numbers = (dims + 3) * count;
    *out = (measure_dominance){.alloc = *alloc, .dim = dim};
    maker m = {.d = out, .count = count, .rank = rank};
    uint32_t *scratch = support_calloc(alloc, numbers, sizeof *scratch);
    if (!scratch) return FROE_E_MEMORY;
    m.spare = scratch + dims * count;
    for (size_t k = 0; k < dims; k++) {
        m.at[k] = scratch + k * count;
        for (uint32_t i = 0; i < count; i++) m.at[k][rank[k][i]] = i;
    }
    bool ok = make_node(&m, 0, NULL, count);
    size_t at = 0;
    for (int axis = 0; axis < dim - 2 && ok; axis++) /* the children of each node are those of a Fenwick tree */
        for (size_t end = out->nodes.count; at < end && ok; at++) {
            const uint32_t points = out->nodes.data[at].count;
            const size_t keys = out->nodes.data[at].keys;
            out->nodes.data[at].next = out->nodes.count;
            for (uint32_t j = 1; j <= points && ok; j++) {
                const uint32_t low = j & -j;
                const size_t from = keys + j - low;
                ok = make_node(&m, axis + 1, &from, low);
            }
        }
    support_free(alloc, scratch, (numbers ? numbers : 1) * sizeof *scratch);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

void measure_dominance_free(measure_dominance *d) {
    array_free(&d->alloc, &d->nodes);
    array_free(&d->alloc, &d->keys);
    array_free(&d->alloc, &d->bits);
}

/* ---------------------------------------------------------------------- counting -- */

static uint32_t rights_before(const measure_dominance_bits *bits, uint32_t i) {
    uint64_t those = bits[i / 64].right & (((uint64_t)1 << i % 64) - 1);
    return bits[i / 64].before + (uint32_t)__builtin_popcountll(those);
}

/* Entries of a list before rank `last` whose places are < `place`: down the levels, from entry to entry. */
static uint32_t count_in_plane(const measure_dominance *d, const measure_dominance_node *node, const uint32_t below[]) {
    const uint32_t *keys = d->keys.data + node->keys;
    uint32_t place = lower_bound(keys, node->count, below[0]), from = 0, count = 0;
    uint32_t end = lower_bound(keys + node->count, node->count, below[1]);
    int level = levels_of(node->count);
    const measure_dominance_bits *bits = d->bits.data + node->next;
    if (place == node->count) return end;
    for (; level-- > 0; bits += words_of(node->count)) {
        uint32_t before[2] = {rights_before(bits, from), rights_before(bits, end)};
        uint32_t lefts = node->count - rights_before(bits, node->count);
        if (place >> level & 1) {
            count += end - before[1] - (from - before[0]);
            from = lefts + before[0], end = lefts + before[1];
        } else
            from -= before[0], end -= before[1];
    }
    return count;
}

uint32_t measure_dominance_count(const measure_dominance *d, const uint32_t below[]) {
    struct {
        const measure_dominance_node *node;
        uint32_t left; /* points up to here are still to be counted */
    } stack[FROE_MAX_DIM];
    int planes = d->dim - 2, top = 0;
    uint32_t count = 0;
    stack[0].node = d->nodes.data;
    stack[0].left = below[0];
    while (top >= 0) {
        if (top == planes)
            count += count_in_plane(d, stack[top--].node, below + planes);
        else if (stack[top].left) {
            uint32_t j = stack[top].left;
            stack[top].left &= j - 1;
            const measure_dominance_node *child = d->nodes.data + stack[top].node->next + j - 1;
            top++;
            stack[top].node = child;
            stack[top].left = top < planes ? lower_bound(d->keys.data + child->keys, child->count, below[top]) : 0;
        } else
            top--;
    }
    return count;
}
