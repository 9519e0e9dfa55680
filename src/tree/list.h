/* list.h: the list of a node, wherever the layout of its tree keeps it.
 *
 *     general     pieces[first .. first + count): every second number is an object
 *     packed      the ids in the block of the leaf, in the plane (packed.h) or in space (space.h)
 */
#ifndef FROE_TREE_LIST_H
#define FROE_TREE_LIST_H
#include "tree/packed/space.h"

/** The list of a node: pieces first .. first + count - 1; tree_object() returns their objects. */
typedef struct tree_objects {
    const uint32_t *at;
    uint32_t stride, mask;
    uint32_t first, count;
} tree_objects;

static inline tree_objects tree_list(const froe_tree *t, uint32_t node) {
    const tree_node *n = t->nodes + node;
    tree_objects list = {.stride = sizeof(tree_piece) / sizeof(uint32_t), .mask = UINT32_MAX};
    if (n->type == TREE_LEAF)
        list.first = n->u.list.first, list.count = n->u.list.count;
    else if (n->type == TREE_TABLED)
        list.first = t->cuts[n->u.cut].first, list.count = t->cuts[n->u.cut].count;
    if (n->type == TREE_LEAF && tree_is_packed(t)) {
        list.stride = 1;
        list.mask = PACKED_OBJECT;
        list.at = tree_is_space(t) ? space_ids(space_block(t, n->child)) : packed_ids(packed_block(t, n), list.count);
    } else if (list.count) {
        list.at = &t->pieces[list.first].object;
    }
    return list;
}
/** A part of a list: `count` pieces from the i-th on. */
static inline tree_objects tree_part(tree_objects list, uint32_t i, uint32_t count) {
    if (i) list.at += (size_t)i * list.stride;
    list.first += i;
    list.count = count;
    return list;
}
/** The covers of a node. */
static inline tree_objects tree_cover_list(const froe_tree *t, uint32_t node) {
    return tree_part(tree_list(t, node), 0, tree_covers(t, t->nodes + node));
}
/** The list of a node without its covers: what lies in its cut, or in the open cell of a leaf. */
static inline tree_objects tree_own_list(const froe_tree *t, uint32_t node) {
    const tree_objects list = tree_list(t, node);
    const uint32_t covers = tree_covers(t, t->nodes + node);
    return tree_part(list, covers, list.count - covers);
}
/** Object of the i-th piece of a list. */
static inline uint32_t tree_object(const tree_objects *list, uint32_t i) {
    return list->at[(size_t)i * list->stride] & list->mask;
}
#endif
