/* covers.c: see covers.h. */
#include "query/covers.h"
#include "support/fail.h"

static void free_covers(const froe_allocator *alloc, query_part *part) {
    query_covers *c = (query_covers *)part;
    support_free(alloc, c->above, c->node_count * sizeof *c->above);
    support_free(alloc, c, sizeof *c);
}

static froe_status make_covers(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_tree *t = q->tree;
    query_covers *c = support_calloc(&q->alloc, 1, sizeof *c);
    if (!c) return support_fail_memory(diag);
    c->part.free = free_covers;
    *out = &c->part;
    c->above = support_calloc(&q->alloc, t->node_count, sizeof *c->above);
    if (!c->above) return support_fail_memory(diag);
    c->node_count = t->node_count;
    c->above[0] = FROE_NONE;
    for (uint32_t v = 0; v < t->node_count; v++) { /* parents come first */
        const tree_node *n = t->nodes + v;
        if (!tree_is_leaf(n)) c->above[n->child] = c->above[n->child + 1] = tree_covers(t, n) ? v : c->above[v];
    }
    return FROE_OK;
}

froe_status query_covers_of(froe_query *query, const query_covers **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_COVERS, make_covers, &part, diag);
    if (status == FROE_OK) *out = (const query_covers *)part;
    return status;
}
