/* leaf.c: from a head start down to the leaf. */
#include "query/leaf.h"
#include "geom/predicates.h"
#include "query/centroids.h"
#include "query/cuts.h"
#include "tree/table.h"
#include <string.h>

/* Side of a point beside the cut of a node: -1, 0, 1. */
static int side_of(froe_query *q, const query_planes *planes, uint32_t node, const double *x) {
    const query_cut cut = query_cut_at(q->tree, planes, q->tree->nodes + node);
    if (cut.axis >= 0) return (x[cut.axis] > cut.value) - (x[cut.axis] < cut.value);
    double at[3] = {0}, error;
    memcpy(at, x, (size_t)q->tree->scene->dim * sizeof *x);
    const double value = query_plane_value(cut.plane, at, &error);
    if (q->numbers.first == NUM_FILTER && fabs(value) > error) return value > 0 ? 1 : -1;
    const geom_plane plane = tree_plane_at(q->tree, node);
    return geom_side_vertex(&q->numbers, &plane, x);
}

/* The entry of the jump table for a point in the core of a cell. */
static bool find_entry(const tree_table *table, const double *x, tree_entry *out) {
    uint32_t cell[2];
    for (int k = 0; k < 2; k++) {
        const double place = tree_table_place(table, k, x[k]);
        if (!(place >= 0 && place < table->cells[k])) return false;
        cell[k] = (uint32_t)place;
        if (place < cell[k] + TABLE_HAIR || place > cell[k] + 1 - TABLE_HAIR) return false;
    }
    *out = tree_table_at(table, cell[0], cell[1]);
    return true;
}

static query_leaf leaf_of(const froe_tree *t, uint32_t node) {
    return (query_leaf){.place = query_leaf_place(t, node), .list = tree_list(t, node)};
}

/* Where to begin; true: that is the leaf. */
static bool begin(const froe_query *q, const query_centroids *centroids, const double *x, uint32_t *node,
                  query_leaf *out) {
    tree_entry entry;
    *node = 0;
    if (centroids->deep) {
        *node = query_centroid_find(centroids, x, x);
    } else if (tree_is_packed(q->tree) && q->tree->packed.table && find_entry(q->tree->packed.table, x, &entry)) {
        *node = entry.at;
        if (!(entry.kind & TABLE_LEAF)) return false;
        const tree_node leaf = {.type = TREE_LEAF, .child = entry.at, .u.list.count = entry.kind & ~TABLE_LEAF};
        *out = (query_leaf){.place = entry.at, .list = tree_packed_list(q->tree, &leaf)};
        return true;
    }
    return false;
}

froe_status query_leaf_find(froe_query *q, const double *point, query_leaf *out) {
    const query_planes *planes;
    const query_centroids *centroids;
    uint32_t node;
    bool on_cut = false;
    froe_status status = query_planes_of(q, &planes, NULL);
    if (!status) status = query_centroids_of(q, &centroids, NULL);
    if (status) return status;
    q->stats.leaves++;
    if (begin(q, centroids, point, &node, out)) return FROE_OK;
    for (; !tree_is_leaf(q->tree->nodes + node); q->stats.nodes++) {
        const int side = side_of(q, planes, node, point);
        on_cut |= side == 0;
        node = q->tree->nodes[node].child + (side > 0);
    }
    *out = leaf_of(q->tree, node);
    out->on_cut = on_cut;
    return FROE_OK;
}
