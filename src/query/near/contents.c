/* contents.c: regions from the root down, then contents from the leaves up, in the same place. */
#include "query/near/contents.h"
#include "support/fail.h"
#include "tree/list.h"
#include <math.h>
#include <string.h>

static void free_contents(const froe_allocator *alloc, query_part *part) {
    query_contents *c = (query_contents *)part;
    support_free(alloc, c->boxes, c->node_count * 2 * c->dim * sizeof *c->boxes);
    support_free(alloc, c, sizeof *c);
}

static double *box_of(query_contents *c, uint32_t node) {
    return c->boxes + node * 2 * c->dim;
}

static void add_box(size_t dim, double *to, const double *lo, const double *hi) {
    for (size_t k = 0; k < dim; k++) {
        if (lo[k] < to[k]) to[k] = lo[k];
        if (hi[k] > to[dim + k]) to[dim + k] = hi[k];
    }
}

static froe_status make_contents(froe_query *q, query_part **out, froe_diagnostic *diag) {
    query_contents *c = support_calloc(&q->alloc, 1, sizeof *c);
    if (!c) return support_fail_memory(diag);
    c->part.free = free_contents;
    *out = &c->part;
    c->dim = (size_t)q->tree->scene->dim;
    c->node_count = q->tree->node_count;
    c->boxes = support_calloc(&q->alloc, c->node_count * 2 * c->dim, sizeof *c->boxes);
    if (!c->boxes) return support_fail_memory(diag);
    /* Closed regions by the axis-parallel cuts above; parents come first. */
    const froe_tree *t = q->tree;
    const size_t dim = c->dim, bytes = 2 * dim * sizeof *c->boxes;
    for (size_t k = 0; k < dim; k++) c->boxes[k] = -INFINITY, c->boxes[dim + k] = INFINITY;
    for (uint32_t v = 0; v < c->node_count; v++) {
        if (tree_is_leaf(t->nodes + v)) continue;
        const uint32_t child = t->nodes[v].child;
        const froe_cut cut = tree_cut_at(t, v);
        memcpy(box_of(c, child), box_of(c, v), bytes);
        memcpy(box_of(c, child + 1), box_of(c, v), bytes);
        if (cut.kind != FROE_CUT_AXIS) continue;
        box_of(c, child)[dim + (size_t)cut.axis] = cut.value;
        box_of(c, child + 1)[cut.axis] = cut.value;
    }
    /* Puts the box of what a node has in place of its region, when its children's boxes are there. */
    for (uint32_t v = t->node_count; v-- > 0;) {
        const tree_objects list = tree_list(t, v);
        double *box = box_of(c, v), held[2 * FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        for (size_t k = 0; k < dim; k++) held[k] = INFINITY, held[dim + k] = -INFINITY;
        for (uint32_t i = 0; i < list.count; i++) {
            scene_bounds_in(t->scene, (int)dim, tree_object(&list, i), lo, hi);
            for (size_t k = 0; k < dim; k++) {
                if (lo[k] < box[k]) lo[k] = box[k];
                if (hi[k] > box[dim + k]) hi[k] = box[dim + k];
            }
            add_box(dim, held, lo, hi);
        }
        for (uint32_t side = 0; side < 2 && !tree_is_leaf(t->nodes + v); side++) {
            const double *child = box_of(c, t->nodes[v].child + side);
            add_box(dim, held, child, child + dim);
        }
        memcpy(box, held, bytes);
    }
    return FROE_OK;
}

froe_status query_contents_of(froe_query *query, const query_contents **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_CONTENTS, make_contents, &part, diag);
    if (status == FROE_OK) *out = (const query_contents *)part;
    return status;
}
