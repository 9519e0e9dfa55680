/* draft.h: a tree while it grows, and how drafts become the final arrays.
 *
 * A builder splits nodes and hands over finished lists in any order; every node
 * ends as a leaf or split. Ring entries name nodes of the draft. Subtrees may be
 * built in drafts of their own, by other threads: a graft puts such a draft in place of a
 * leaf of the main one; its ring entries below `outer` mean nodes of the main draft, those
 * from `outer` on are its own nodes (node + outer). draft_seal renumbers depth-first, so
 * the result does not depend on which thread built which subtree, or when.
 *
 * It speaks for draft.c and seal.c. */
#ifndef FROE_TREE_DRAFT_H
#define FROE_TREE_DRAFT_H
#include "tree/tree.h"

typedef struct tree_draft {
    froe_allocator alloc;
    int dim;
    uint32_t outer; /**< 0 in the main draft; its node count when a subtree draft was begun */
    ARRAY(tree_node) nodes;
    ARRAY(tree_cut) cuts;
    ARRAY(tree_piece) pieces;
    ARRAY(uint32_t) bounds;
    ARRAY(double) normals;
    froe_predicate_stats predicates;
} tree_draft;

/** A draft whose only node is an unfinished root. */
froe_status draft_new(const froe_allocator *alloc, int dim, uint32_t outer, tree_draft *out);
void draft_free(tree_draft *draft);

/** Makes `node` inner with this cut; *child is the negative child, *child + 1 the
 * positive. FROE_CUT_AXIS without in-cut list stays in the node. `flags`: of tree_node. */
froe_status draft_split(tree_draft *draft, uint32_t node, const froe_cut *cut, uint8_t flags, uint32_t *child);
/** Makes `node` a leaf. Its list starts empty. */
void draft_leaf(tree_draft *draft, uint32_t node, uint8_t flags);
/** Begins the list of a leaf or of a split node (an AXIS cut moves to the table);
 * the following draft_piece calls fill it. One list at a time, each once. */
froe_status draft_list(tree_draft *draft, uint32_t node);
/** Appends a cover, a box that contains the region of the node, to the list begun last, before all other pieces. */
froe_status draft_cover(tree_draft *draft, uint32_t node, uint32_t object);
/** Appends a piece to the list begun last. ring NULL: the whole object. Otherwise
 * `count` ring entries as in tree.h, nodes numbered as said above (+ outer). */
froe_status draft_piece(tree_draft *draft, uint32_t node, uint32_t object, const uint32_t *ring, uint32_t count);

/** How much of a draft there is. */
typedef struct tree_draft_mark {
    size_t nodes, cuts, pieces, bounds, normals;
} tree_draft_mark;
tree_draft_mark draft_mark(const tree_draft *draft);
/** Removes what was added since the mark, all of it below `node`, which was not finished then and is not again. */
void draft_cut_back(tree_draft *draft, const tree_draft_mark *mark, uint32_t node);
/** Removes what was added between two marks. What came later, which does not refer to it, hangs below `node`, which was
 * there before. */
void draft_remove(tree_draft *draft, const tree_draft_mark *from, const tree_draft_mark *to, uint32_t node);

/** A tree without arrays, which holds the scene; to be filled and finished. FROE_E_MEMORY. */
froe_status draft_shell(const froe_allocator *alloc, froe_scene *scene, const tree_meta *meta, froe_tree **out);

typedef struct tree_graft {
    uint32_t node; /**< a leaf of the main draft with an empty list, replaced */
    tree_draft *draft;
} tree_graft;
/** The final tree of a draft that is in its order already: nodes were split depth-first, child 0 first, and each had
 * its list begun, even an empty one, before the next. The tree takes the arrays, and the draft is empty. Holds the
 * scene. FROE_E_MEMORY. */
froe_status draft_seal_ordered(tree_draft *draft, froe_scene *scene, const tree_meta *meta, froe_tree **out);
/** The final tree: depth-first, compact, arrays of exactly the needed size. Holds the scene.
 * The drafts stay the caller's. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status draft_seal(const tree_draft *main, const tree_graft *grafts, size_t graft_count, froe_scene *scene,
                       const tree_meta *meta, froe_tree **out);
#endif
