/* draft.c: growing a tree: nodes split in pairs, lists and rings appended behind one another.
 *
 *     nodes   0 | 1 2 | 3 4 | ...        a pair per split, in the builder's order
 *     pieces  list | list | ...          each list one run, in the order they were begun
 *     bounds  - | count e e e | count e e | ...
 *
 * Nothing is moved while the draft grows; draft_seal puts all of it in order, once. */
#include "tree/draft.h"
#include <string.h>

void draft_free(tree_draft *draft) {
    array_free(&draft->alloc, &draft->nodes);
    array_free(&draft->alloc, &draft->cuts);
    array_free(&draft->alloc, &draft->pieces);
    array_free(&draft->alloc, &draft->bounds);
    array_free(&draft->alloc, &draft->normals);
}

froe_status draft_new(const froe_allocator *alloc, int dim, uint32_t outer, tree_draft *out) {
    tree_draft draft = {.alloc = support_allocator(alloc), .dim = dim, .outer = outer};
    if (!array_push(&draft.alloc, &draft.nodes, (tree_node){0}) || !array_push(&draft.alloc, &draft.bounds, 0)) {
        draft_free(&draft);
        return FROE_E_MEMORY;
    }
    *out = draft;
    return FROE_OK;
}

/* Appends `cut` to the table, its list empty. */
static froe_status table_cut(tree_draft *draft, const froe_cut *cut, uint32_t *index) {
    tree_cut entry = {.kind = (uint32_t)cut->kind};
    if (!array_reserve(&draft->alloc, &draft->cuts, 1)) return FROE_E_MEMORY;
    switch (cut->kind) {
    case FROE_CUT_AXIS:
        entry.a = (uint32_t)cut->axis;
        entry.u.value = cut->value;
        break;
    case FROE_CUT_PLANE:
        entry.u.value = cut->value;
        break;
    case FROE_CUT_FINE:
        entry.u.id.b = cut->id[0];
        break;
    default:
        entry.a = cut->id[0];
        entry.u.id.b = cut->kind == FROE_CUT_OBJECT || cut->kind == FROE_CUT_VERTEX ? 0 : cut->id[1];
        entry.u.id.c = cut->kind == FROE_CUT_VERTICES && draft->dim == 3 ? cut->id[2] : 0;
    }
    const size_t normals = tree_cut_normals(&entry, draft->dim);
    if (normals) {
        if (draft->normals.count + normals > UINT32_MAX) return FROE_E_LIMIT; /* one way: so many take 32 GB */
        entry.a = (uint32_t)draft->normals.count;
        if (!array_append(&draft->alloc, &draft->normals, cut->normal, normals)) return FROE_E_MEMORY;
    }
    *index = (uint32_t)draft->cuts.count;
    draft->cuts.data[draft->cuts.count++] = entry;
    return FROE_OK;
}

froe_status draft_split(tree_draft *draft, uint32_t node, const froe_cut *cut, uint8_t flags, uint32_t *child) {
    tree_node inner = {.child = (uint32_t)draft->nodes.count, .flags = flags, .type = TREE_TABLED};
    if (draft->nodes.count + 2 + draft->outer > TREE_MOST) return FROE_E_LIMIT;
    if (!array_reserve(&draft->alloc, &draft->nodes, 2)) return FROE_E_MEMORY;
    if (cut->kind == FROE_CUT_AXIS) {
        inner.type = TREE_PLAIN;
        inner.axis = (uint8_t)cut->axis;
        inner.u.value = cut->value;
    } else {
        froe_status status = table_cut(draft, cut, &inner.u.cut);
        if (status) return status;
    }
    memset(draft->nodes.data + draft->nodes.count, 0, 2 * sizeof(tree_node));
    draft->nodes.count += 2;
    draft->nodes.data[node] = inner;
    *child = inner.child;
    return FROE_OK;
}

void draft_leaf(tree_draft *draft, uint32_t node, uint8_t flags) {
    draft->nodes.data[node] = (tree_node){.type = TREE_LEAF, .flags = flags};
}

tree_draft_mark draft_mark(const tree_draft *draft) {
    return (tree_draft_mark){draft->nodes.count, draft->cuts.count, draft->pieces.count, draft->bounds.count,
                             draft->normals.count};
}

void draft_cut_back(tree_draft *draft, const tree_draft_mark *mark, uint32_t node) {
    draft->nodes.count = mark->nodes;
    draft->cuts.count = mark->cuts;
    draft->pieces.count = mark->pieces;
    draft->bounds.count = mark->bounds;
    draft->normals.count = mark->normals;
    draft->nodes.data[node] = (tree_node){0};
}

/** What a node refers to lies further down by as much as `by`. */
static void move_node(tree_node *node, const tree_draft_mark *by) {
    if (node->type == TREE_LEAF) {
        node->u.list.first -= node->u.list.count ? (uint32_t)by->pieces : 0;
    } else {
        node->child -= (uint32_t)by->nodes;
        if (node->type == TREE_TABLED) node->u.cut -= (uint32_t)by->cuts;
    }
}

/** The same for a ring, which may name nodes from before. */
static void move_ring(const tree_draft *draft, uint32_t *ring, const tree_draft_mark *from, uint32_t by) {
    for (uint32_t k = 1; k <= ring[0]; k++)
        if (ring[k] & TREE_EDGE_CUT && (ring[k] & ~TREE_EDGE_CUT) >= draft->outer + from->nodes) ring[k] -= by;
}

#define DRAFT_CLOSE_UP(array)                                                                                          \
    do {                                                                                                               \
        if (draft->array.count > to->array)                                                                            \
            memmove(draft->array.data + from->array, draft->array.data + to->array,                                    \
                    (draft->array.count - to->array) * sizeof *draft->array.data);                                     \
        draft->array.count -= by.array;                                                                                \
    } while (0)

void draft_remove(tree_draft *draft, const tree_draft_mark *from, const tree_draft_mark *to, uint32_t node) {
    const tree_draft_mark by = {to->nodes - from->nodes, to->cuts - from->cuts, to->pieces - from->pieces,
                                to->bounds - from->bounds, to->normals - from->normals};
    move_node(draft->nodes.data + node, &by);
    for (size_t i = to->nodes; i < draft->nodes.count; i++) move_node(draft->nodes.data + i, &by);
    for (size_t i = to->cuts; i < draft->cuts.count; i++) {
        tree_cut *cut = draft->cuts.data + i;
        cut->first -= cut->count ? (uint32_t)by.pieces : 0;
        if (tree_cut_normals(cut, draft->dim)) cut->a -= (uint32_t)by.normals;
    }
    for (size_t i = to->pieces; i < draft->pieces.count; i++) {
        tree_piece *piece = draft->pieces.data + i;
        if (!piece->ring) continue;
        move_ring(draft, draft->bounds.data + piece->ring, from, (uint32_t)by.nodes);
        piece->ring -= (uint32_t)by.bounds;
    }
    DRAFT_CLOSE_UP(nodes);
    DRAFT_CLOSE_UP(cuts);
    DRAFT_CLOSE_UP(pieces);
    DRAFT_CLOSE_UP(bounds);
    DRAFT_CLOSE_UP(normals);
}

froe_status draft_list(tree_draft *draft, uint32_t node) {
    tree_node *n = draft->nodes.data + node;
    uint32_t first = (uint32_t)draft->pieces.count;
    if (n->type == TREE_PLAIN) { /* a plain node has no list: its cut moves to the table */
        froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = n->axis, .value = n->u.value};
        uint32_t index;
        froe_status status = table_cut(draft, &cut, &index);
        if (status) return status;
        *n = (tree_node){.u.cut = index, .child = n->child, .type = TREE_TABLED, .flags = n->flags};
    }
    if (n->type == TREE_LEAF)
        n->u.list.first = first;
    else
        draft->cuts.data[n->u.cut].first = first;
    return FROE_OK;
}

froe_status draft_cover(tree_draft *draft, uint32_t node, uint32_t object) {
    const froe_status status = draft_piece(draft, node, object, NULL, 0);
    tree_node *n = draft->nodes.data + node;
    if (!status) *(n->type == TREE_LEAF ? &n->child : &n->u.covers) += 1;
    return status;
}

froe_status draft_piece(tree_draft *draft, uint32_t node, uint32_t object, const uint32_t *ring, uint32_t count) {
    tree_node *n = draft->nodes.data + node;
    tree_piece piece = {.object = object};
    /* one way: so many take 16 GB */
    if (draft->pieces.count >= TREE_MOST || draft->bounds.count + count >= UINT32_MAX) return FROE_E_LIMIT;
    if (!array_reserve(&draft->alloc, &draft->pieces, 1)) return FROE_E_MEMORY;
    if (ring) {
        if (!array_reserve(&draft->alloc, &draft->bounds, (size_t)count + 1)) return FROE_E_MEMORY;
        uint32_t *to = draft->bounds.data + draft->bounds.count;
        piece.ring = (uint32_t)draft->bounds.count;
        *to++ = count;
        for (uint32_t i = 0; i < count; i++) to[i] = ring[i];
        draft->bounds.count += (size_t)count + 1;
    }
    draft->pieces.data[draft->pieces.count++] = piece;
    if (n->type == TREE_LEAF)
        n->u.list.count++;
    else
        draft->cuts.data[n->u.cut].count++;
    return FROE_OK;
}
