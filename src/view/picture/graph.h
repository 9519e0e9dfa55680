/* graph.h: an order of painting, from the pairs of nodes whose order matters.
 *
 *     arc  a -> b     b is painted after a
 *
 * Where arcs form cycles, some nodes are made late: their outgoing arcs are dropped, because they will be painted
 * clipped and then cover nothing visible. A small set is searched (a feedback vertex set of each strongly connected
 * component) by taking the node with the greatest product of arcs in and arcs out, repeatedly.
 *
 * It speaks for graph.c and topological.c (the order itself). */
#ifndef FROE_VIEW_PICTURE_GRAPH_H
#define FROE_VIEW_PICTURE_GRAPH_H
#include "support/array.h"

typedef struct graph_arc {
    uint32_t from, to;
} graph_arc;

typedef struct view_graph {
    uint32_t count;                   /**< nodes */
    uint32_t *out_starts, *in_starts; /**< count + 1 */
    uint32_t *outs, *ins;             /**< nodes, ascending */
    uint32_t arc_count;
    uint8_t *late; /**< per node */
    uint32_t late_count;
    uint32_t cyclic; /**< nodes in cycles at first */
} view_graph;

/** From arcs in any order, repeated or not; `arcs` is reordered. FROE_E_MEMORY. */
froe_status view_graph_new(const froe_allocator *alloc, uint32_t nodes, graph_arc *arcs, size_t arc_count,
                           view_graph *out);
void view_graph_free(const froe_allocator *alloc, view_graph *graph);
/** Frees the arcs, where only `late` is still asked for. */
void view_graph_drop(const froe_allocator *alloc, view_graph *graph);
/** Makes nodes late until no cycle is left; a `fixed` node (NULL: none is) only where all of
 * its cycle are. FROE_E_MEMORY. Not recursive (Tarjan 1972 with a stack of its own). */
froe_status view_graph_break(const froe_allocator *alloc, view_graph *graph, const uint8_t *fixed);
/** All nodes so that arcs point forward, those from late nodes apart. Stays with one style as long as it can, then
 * takes up that with the most nodes ready; among equals the lowest number. REQUIRES: no cycles. FROE_E_MEMORY. */
froe_status view_graph_sort(const froe_allocator *alloc, const view_graph *graph, const uint32_t *styles,
                            uint32_t style_count, uint32_t *order);
#endif
