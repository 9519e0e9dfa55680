/* centroids.c: regions of all nodes, and the order in which to ask about them. */
#include "query/range/centroids.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

/* Plain descent is faster up to this many times the logarithm of the nodes. */
enum { DEEP_IN_LOGARITHMS = 4 };

static void free_centroids(const froe_allocator *alloc, query_part *part) {
    query_centroids *c = (query_centroids *)part;
    if (c->steps) support_free(alloc, c->steps, c->node_count * sizeof *c->steps);
    if (c->boxes) support_free(alloc, c->boxes, (size_t)c->node_count * 2 * (size_t)c->dim * sizeof *c->boxes);
    support_free(alloc, c, sizeof *c);
}

bool query_is_deep(const froe_tree *t) {
    uint64_t log = 1;
    while (t->node_count >> log) log++;
    return t->report.height > DEEP_IN_LOGARITHMS * log;
}

/* Sizes of the subtrees among axis-parallel cuts, 0 below oblique ones; parents; regions. */
typedef struct centroid_plan {
    const froe_tree *tree;
    query_centroids *c;
    uint32_t *sizes, *parents;
    bool *gone;            /* is the subtree no longer part of what is left above it? */
    ARRAY(uint64_t) parts; /* a root, and where the step that divides it goes: 2 step + side, or none */
} centroid_plan;

/* ---------------------------------------------------------------- centroids -- */

/* Of two children that are left the heavier; some of what is below the node is left. */
static uint32_t heavier(const centroid_plan *p, uint32_t node) {
    const uint32_t child = p->tree->nodes[node].child;
    const uint32_t left = p->gone[child] ? 0 : p->sizes[child], right = p->gone[child + 1] ? 0 : p->sizes[child + 1];
    return child + (right > left);
}

static void link_to(centroid_plan *p, uint64_t from, uint32_t to) {
    if (from == UINT64_MAX)
        p->c->root = to;
    else
        p->c->steps[from / 2].next[from % 2] = to;
}

static bool push_part(centroid_plan *p, uint32_t root, uint64_t from) {
    return array_push(&p->tree->alloc, &p->parts, root) && array_push(&p->tree->alloc, &p->parts, from);
}

/* Divides each part at its centroid into the subtree there and the rest, until all are single nodes. */
static bool divide_parts(centroid_plan *p) {
    bool ok = push_part(p, 0, UINT64_MAX);
    while (ok && p->parts.count) {
        const uint64_t from = p->parts.data[--p->parts.count];
        const uint32_t root = (uint32_t)p->parts.data[--p->parts.count];
        if (p->sizes[root] == 1) {
            link_to(p, from, root | CENTROID_END);
            continue;
        }
        uint32_t v = heavier(p, root);
        while ((uint64_t)p->sizes[v] * 3 > (uint64_t)p->sizes[root] * 2) v = heavier(p, v); /* v has two or more */
        const uint32_t step = p->c->count++;
        p->c->steps[step].node = v;
        link_to(p, from, step);
        p->gone[v] = true; /* the subtree of v is no longer part of what begins at root */
        for (uint32_t u = v; u != root;) {
            u = p->parents[u];
            p->sizes[u] -= p->sizes[v];
        }
        p->parts.data[p->parts.count + 1] = 2 * (uint64_t)step; /* root remains where it was */
        p->parts.count += 2;
        ok = push_part(p, v, 2 * (uint64_t)step + 1);
    }
    return ok;
}

/* ------------------------------------------------------------------- making -- */

static froe_status make_centroids(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_allocator *alloc = &q->alloc;
    query_centroids *c = support_calloc(alloc, 1, sizeof *c);
    if (!c) return support_fail_memory(diag);
    c->part.free = free_centroids;
    *out = &c->part;
    c->dim = q->tree->scene->dim;
    c->node_count = q->tree->node_count;
    centroid_plan p = {.tree = q->tree, .c = c};
    bool ok = false;
    c->steps = support_calloc(alloc, c->node_count, sizeof *c->steps);
    c->boxes = support_calloc(alloc, (size_t)c->node_count * 2 * (size_t)c->dim, sizeof *c->boxes);
    p.sizes = support_calloc(alloc, c->node_count, sizeof *p.sizes);
    p.parents = support_calloc(alloc, c->node_count, sizeof *p.parents);
    p.gone = support_calloc(alloc, c->node_count, sizeof *p.gone);
    if (c->steps && c->boxes && p.sizes && p.parents && p.gone) {
        const froe_tree *t = q->tree;
        const size_t dim = (size_t)c->dim, width = 2 * dim;
        for (size_t k = 0; k < width; k++) c->boxes[k] = k < dim ? -INFINITY : INFINITY;
        p.sizes[0] = 1;
        for (uint32_t v = 0; v < t->node_count; v++) { /* parents come first */
            if (!p.sizes[v]) continue;
            const froe_cut cut = tree_cut_at(t, v);
            if (cut.kind != FROE_CUT_AXIS) continue;
            for (uint32_t side = 0; side < 2; side++) {
                const uint32_t child = t->nodes[v].child + side;
                double *box = c->boxes + child * width;
                memcpy(box, c->boxes + v * width, width * sizeof *box);
                box[side ? (size_t)cut.axis : dim + (size_t)cut.axis] = cut.value;
                p.parents[child] = v;
                p.sizes[child] = 1;
            }
        }
        for (uint32_t v = t->node_count - 1; v > 0; v--)
            if (p.sizes[v]) p.sizes[p.parents[v]] += p.sizes[v];
        ok = divide_parts(&p);
    }
    support_free(alloc, p.sizes, c->node_count * sizeof *p.sizes);
    support_free(alloc, p.parents, c->node_count * sizeof *p.parents);
    support_free(alloc, p.gone, c->node_count * sizeof *p.gone);
    array_free(alloc, &p.parts);
    return ok ? FROE_OK : support_fail_memory(diag);
}

froe_status query_centroids_of(froe_query *query, const query_centroids **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_CENTROIDS, make_centroids, &part, diag);
    if (status == FROE_OK) *out = (const query_centroids *)part;
    return status;
}
