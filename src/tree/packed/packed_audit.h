/* packed_audit.h: is what a block stores of a fragment right? */
#ifndef FROE_TREE_PACKED_PACKED_AUDIT_H
#define FROE_TREE_PACKED_PACKED_AUDIT_H
#include "tree/packed/packed.h"

/** The frame of a packed tree: its root box holds the scene, in space exactly, and every cut divides its cell. *why
 * NULL, or what is wrong at *node, as a clause. FROE_E_MEMORY. O(nodes). */
froe_status packed_frame_refuted(const froe_tree *t, uint32_t *node, const char **why);
/** Piece i of a leaf, whose exact ring is `ring` (tree.h): its flags; that its ends are in general position in the
 * cell; that its units are right within the error of the block. NULL, or what is wrong, as a clause. */
const char *packed_refuted(num_context *context, const froe_tree *t, uint32_t leaf, uint32_t i, const uint32_t ring[2]);
#endif
