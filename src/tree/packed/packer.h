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

/** With room for a scene of so many objects at leaves of so many fragments. */
froe_status packer_new(const froe_allocator *alloc, int dim, uint32_t objects, uint32_t leaf, tree_packer *out);
void packer_free(tree_packer *packer);
/** FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_split(tree_packer *packer, uint32_t node, int axis, double value, uint32_t *child);
/** flags: TREE_CROWDED or 0. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_leaf(tree_packer *packer, uint32_t node, const packed_box *box, const packed_fragment *fragments,
                        uint32_t count, uint8_t flags);
/** The same in space; brings the items into the order of the block. FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status packer_space_leaf(tree_packer *packer, uint32_t node, const froe_scene *scene, space_item *items,
                              uint32_t count, uint8_t flags);
/** The finished tree, which takes the packer's arrays and holds the scene. FROE_E_MEMORY. */
froe_status packer_seal(tree_packer *packer, froe_scene *scene, const tree_meta *meta, froe_tree **out);
#endif
