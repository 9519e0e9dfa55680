/* packer.h: a packed tree while it grows, in the order in which it will lie: depth first, negative child first.
 *
 *     tree_packer p;
 *     packer_new(..., &p);                                     // node 0 is open
 *     packer_split(&p, 0, axis, value, &child);                // child and child + 1 are open
 *     packer_leaf(&p, child, &box, fragments, count, flags);
 *     ...
 *     packer_seal(&p, scene, &meta, &tree);  packer_free(&p);
 *
 * A node must be split or ended before its sibling's turn, children right after their parent. So nothing is moved or
 * renumbered at the end: what is written is the tree. */
#ifndef FROE_TREE_PACKED_PACKER_H
#define FROE_TREE_PACKED_PACKER_H
#include "tree/packed/space.h"

typedef struct tree_packer {
    froe_allocator alloc;
    ARRAY(tree_node) nodes;
    ARRAY(uint32_t) owners;
    uint8_t *memory;    /**< blocks begin at its first multiple of PACKED_BLOCK */
    size_t memory_size; /**< bytes */
    uint32_t block_count, block_room;
    uint32_t piece_count;
} tree_packer;

/** Where a subtree is or goes: its first node, the others, and so on. */
typedef struct packer_place {
    uint32_t first, nodes, blocks, owners, pieces;
} packer_place;

/** One of several subtrees that a packer has side by side, before they are put into a tree. */
typedef struct packer_subtree {
    packer_place at;
    uint32_t nodes, blocks, owners, pieces; /**< how many; nodes without the first */
} packer_subtree;

/** With room for so much. It is taken, not touched, and given back in the end: large arrays are slow to move. */
froe_status packer_new(const froe_allocator *alloc, uint64_t nodes, uint64_t blocks, uint64_t owners, tree_packer *out);
void packer_free(tree_packer *packer);
/** FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_split(tree_packer *packer, uint32_t node, int axis, double value, uint32_t *child);
/** flags: TREE_CROWDED or 0. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_leaf(tree_packer *packer, uint32_t node, const packed_box *box, const packed_fragment *fragments,
                        uint32_t count, uint8_t flags);
/** The same in space; brings the items into the order of the block. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_space_leaf(tree_packer *packer, uint32_t node, const froe_scene *scene, space_item *items,
                              uint32_t count, uint8_t flags);
/** Opens a node behind all that is there, subtree->at.first, for another subtree. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_begin(tree_packer *packer, packer_subtree *subtree);
/** All that came since is of that subtree. */
void packer_end(const tree_packer *packer, packer_subtree *subtree);
/** A subtree of another packer is to begin at `node`, which is open: where all of it goes, which is taken. So several
 * can be put at once. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_place_for(tree_packer *packer, uint32_t node, const packer_subtree *subtree, packer_place *out);
/** Copies a subtree of `from` to its place. */
void packer_put(const tree_packer *packer, const packer_place *place, const tree_packer *from,
                const packer_subtree *subtree);
/** The finished tree, which takes the packer's arrays and holds the scene. FROE_E_MEMORY. */
froe_status packer_seal(tree_packer *packer, froe_scene *scene, const tree_meta *meta, froe_tree **out);
#endif
