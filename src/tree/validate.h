/* validate.h: is a tree one that draft_seal could have made? */
#ifndef FROE_TREE_VALIDATE_H
#define FROE_TREE_VALIDATE_H
#include "tree/tree.h"

/** Checks meta and all arrays of a tree whose scene is valid and whose counts are those of its arrays, trusting
 * nothing else. FROE_E_FORMAT with the first violation; FROE_E_MEMORY. O(nodes + rings x log height). */
froe_status tree_validate(const froe_tree *tree, froe_diagnostic *diag);
/** The same without meta, and, in packed trees, without what is in blocks. Of a packed tree it reads nodes alone. */
froe_status tree_validate_nodes(const froe_tree *tree, froe_diagnostic *diag);
/** Does the description say what a builder could have said? O(1). */
bool tree_meta_fits(const froe_tree *tree);
#endif
