/* wide.h: a packed tree of space for searches: sixteen subtrees a node, by tight boxes (Wald, Benthin and Boulos:
 * Getting rid of packets, 2008; boxes in bytes as by Ylitie, Karras and Laine: Efficient incoherent ray traversal,
 * 2017).
 *
 *     binary nodes          wide node: lo, units     x' = (x - middle) * scale, scene within [-1, 1]
 *        /   \              +--+--+-- ... --+--+
 *       .     .       =>    |b0|b1|         |bf|     bounds of what the leaves below list within their cells
 *      / \   / \            +--+--+-- ... --+--+     in units of the node, a byte each, rounded outwards
 *    ...............         c0 c1           cf      blocks of leaves, or other wide nodes
 *
 * Made from the nodes and the boxes of blocks when a tree is built, and saved with it. The box with
 * largest surface is opened until there are sixteen, so a search that meets a node may compare all of them at once and
 * go on with those it meets. Leaves without objects are left out. Bounds are so much wider than the boxes of
 * leaves that rounding leaves no object out. */
#ifndef FROE_TREE_PACKED_WIDE_H
#define FROE_TREE_PACKED_WIDE_H
#include "tree/packed/space.h"

enum { WIDE_CHILDREN = 16 };
#define WIDE_NORMAL 0x3ff00000u
#define WIDE_LEAF 0x80000000u  /**< with the number of a block */
#define WIDE_INDEX 0x3fffffffu /**< the rest */

typedef struct wide_node {
    double lo[3];
    uint8_t shift[3]; /**< units of 2^-shift */
    uint8_t count;
    uint32_t unused; /**< WIDE_NORMAL: kernels load four doubles, and with the bytes before this is no denormal */
    uint8_t box[2][3][WIDE_CHILDREN];
    uint32_t child[WIDE_CHILDREN];
} wide_node;
_Static_assert(sizeof(wide_node) == 192, "three cache lines");

struct tree_wide {
    double middle[4], lo[4], hi[4]; /**< lo, hi: the region of the root, as x'. Fourth ones are 0: kernels load four */
    double scale, inverse;          /**< scale: a power of 2; inverse: 1 / scale */
    wide_node *nodes;               /**< [0] is the root */
    size_t count, levels;
    void *memory; /**< that nodes lie in */
    size_t memory_size;
};

/** *out NULL: the tree is not one of space, empty, or too large or small for it. FROE_E_MEMORY. O(nodes). */
froe_status tree_wide_new(const froe_tree *t, tree_wide **out);
/** The same over nodes that lie in a file, at a multiple of 64, and are not checked. FROE_E_FORMAT, without a sentence:
 * there are nodes where a tree has none, or none where it has some. FROE_E_MEMORY. O(1). */
froe_status tree_wide_from(const froe_tree *t, wide_node *nodes, size_t count, size_t levels, tree_wide **out);
/** May it be searched? Each node is the child of one, they lie breadth first, their levels are counted right, and
 * leaves are blocks that the tree has. O(wide nodes). */
bool tree_wide_fits(const froe_tree *t, const tree_wide *wide);
void tree_wide_free(const froe_allocator *alloc, tree_wide *wide);
uint64_t tree_wide_bytes(const tree_wide *wide);
#endif
