/* pieces.c: see pieces.h. */
#include "query/pieces.h"
#include "support/fail.h"
#include "tree/list.h"
#include <string.h>

static void free_pieces(const froe_allocator *alloc, query_part *part) {
    query_pieces *p = (query_pieces *)part;
    support_free(alloc, p->points, p->size);
    support_free(alloc, p, sizeof *p);
}

static froe_status make_pieces(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_tree *t = q->tree;
    const froe_scene *s = t->scene;
    query_pieces *p = support_calloc(&q->alloc, 1, sizeof *p);
    if (!p) return support_fail_memory(diag);
    p->part.free = free_pieces;
    *out = &p->part;
    bool points = t->piece_count > 0 && t->piece_count == s->object_count; /* each in one list */
    p->flat = !tree_is_packed(t);
    for (uint32_t i = 0; i < s->object_count; i++) {
        points &= scene_form(s, i) == FROE_POINT;
        p->flat = p->flat && scene_form(s, i) < FROE_BOX;
    }
    p->whole = p->flat && t->bound_count <= 1; /* the first is unused */
    if (!points) return FROE_OK;
    const size_t bytes = (size_t)s->dim * sizeof *p->points;
    p->points = support_calloc(&q->alloc, t->piece_count, bytes);
    if (!p->points) return support_fail_memory(diag);
    p->size = t->piece_count * bytes;
    for (uint32_t v = 0; v < t->node_count; v++) {
        const tree_objects list = tree_list(t, v);
        for (uint32_t i = 0; i < list.count; i++)
            memcpy(p->points + (size_t)(list.first + i) * (size_t)s->dim, scene_point(s, tree_object(&list, i), 0),
                   bytes);
    }
    return FROE_OK;
}

froe_status query_pieces_of(froe_query *query, const query_pieces **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_PIECES, make_pieces, &part, diag);
    if (status == FROE_OK) *out = (const query_pieces *)part;
    return status;
}
