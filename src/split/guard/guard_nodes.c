/* guard_nodes.c: nodes of the guard tree: crosses and slabs.
 *
 * The nodes of a cross of q planes lie together, level by level: the pair of the first plane, the
 * two pairs of the second, ... the 2^q cells. So all places are known without recursion. */
#include "split/guard/guard_work.h"
#include <string.h>

/* `extra` new leaves; *first is the number of the first one. */
static froe_status add_nodes(guard_worker *w, uint32_t extra, uint32_t *first) {
    guard_nodes *nodes = w->nodes;
    if (nodes->count + extra > GUARD_LIMIT) return FROE_E_LIMIT;
    if (!array_reserve(w->plan->alloc, nodes, extra)) return FROE_E_MEMORY;
    memset(nodes->data + nodes->count, 0, extra * sizeof *nodes->data);
    *first = (uint32_t)nodes->count - w->origin;
    nodes->count += extra;
    return FROE_OK;
}

static split_guard_node inner_node(int axis, double value, uint32_t child) {
    return (split_guard_node){.value = value + 0.0, .child = child, .axis = (uint8_t)axis}; /* + 0.0: no -0 */
}

froe_status guard_cross(guard_worker *w, uint32_t node, int count, const uint8_t *axes, const double *values,
                        uint32_t *first) {
    uint32_t base;
    froe_status status = add_nodes(w, (2u << count) - 2, &base);
    if (status) return status;
    *guard_node(w, node) = inner_node(axes[0], values[0], base);
    for (int level = 1; level < count; level++) {
        uint32_t here = base + (1u << level) - 2, below = base + (2u << level) - 2;
        for (uint32_t i = 0; i < 1u << level; i++)
            *guard_node(w, here + i) = inner_node(axes[level], values[level], below + 2 * i);
    }
    *first = base + (1u << count) - 2;
    return FROE_OK;
}

froe_status guard_slabs(guard_worker *w, uint32_t node, int count, const uint8_t *axes, const double *values,
                        uint32_t inner, uint32_t *rest) {
    uint32_t base;
    froe_status status = add_nodes(w, 2 * (uint32_t)count, &base);
    if (status) return status;
    for (int i = 0; i < count; i++) {
        *guard_node(w, node) = inner_node(axes[i], values[i], base + 2 * (uint32_t)i);
        node = base + 2 * (uint32_t)i + (inner >> (count - 1 - i) & 1);
    }
    *rest = node;
    return FROE_OK;
}

froe_status guard_octants(guard_worker *w, uint32_t node, uint32_t height, const double *mid, uint32_t *first) {
    static const uint8_t axes[FROE_MAX_DIM] = {0, 1, 2, 3, 4, 5, 6, 7};
    uint32_t below = height + (uint32_t)w->plan->dim;
    if (below > w->height) w->height = below;
    w->octree_steps++;
    return guard_cross(w, node, w->plan->dim, axes, mid, first);
}

void guard_count(guard_worker *w, uint32_t node, const double *point, uint32_t except) {
    const split_guard_node *at = guard_node(w, node);
    while (at->child) {
        if (point[at->axis] == at->value) return;
        node = at->child + (point[at->axis] > at->value);
        at = guard_node(w, node);
    }
    if (node != except && at->guards < UINT16_MAX) guard_node(w, node)->guards++;
}

void guard_leaf(guard_worker *w, uint32_t node, uint32_t guards) {
    guard_node(w, node)->guards = (uint16_t)(guards < UINT16_MAX ? guards : UINT16_MAX);
}
