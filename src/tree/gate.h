/* gate.h: which parts of an opened file have been checked. docs/design/opening.md says why, with figures.
 *
 *     open          header, table, description, facts, coordinate system      O(1)
 *     ready         nodes and jump table, or wide nodes                       1 % of the file; before the first search
 *     leaf by leaf  the block, and all objects in it                          when a search comes by for the first time
 *     settled       everything, checksums too                                 when anything else is asked
 *
 * Only searches of packed trees read parts that were checked one by one. All else begins by tree_settle(). So a part
 * that is wrong is refused before anything of it is used, by the call that would have used it; which call that is
 * depends on what was asked before.
 *
 * Two threads may make the same check at the same time. */
#ifndef FROE_TREE_GATE_H
#define FROE_TREE_GATE_H
#include "tree/packed/packed.h"
#include <stdatomic.h>

/** A packed tree that may be searched, and of which leaves have been found right. */
typedef struct tree_ready {
    froe_tree tree;      /**< as opened, with a jump table */
    atomic_uint *leaves; /**< bits: the leaf with that block is right */
    atomic_uint *owners; /**< bits: so many owners exist */
    size_t leaf_words, owner_words;
} tree_ready;
enum { READY_OWNERS = 1024 };

/** For a tree whose arrays lie in these bytes. FROE_E_MEMORY. */
froe_status tree_gate_new(const froe_allocator *alloc, const uint8_t *bytes, uint64_t size, tree_gate **out);
void tree_gate_free(const froe_allocator *alloc, tree_gate *gate);

/** Has everything been checked, and found right? */
bool tree_is_checked(const froe_tree *tree);
/** Checks all of an opened tree, unless that has been done, by froe_tree_check(). FROE_E_FORMAT, FROE_E_MEMORY. */
static inline froe_status tree_settle(const froe_tree *tree, froe_diagnostic *diag) {
    return tree_is_checked(tree) ? FROE_OK : froe_tree_check(tree, diag);
}
/** Checks what every search of a packed tree reads; settles any other. *out NULL: search the tree itself. The gate
 * keeps it. FROE_E_FORMAT, FROE_E_MEMORY. */
froe_status tree_make_ready(const froe_tree *tree, const tree_ready **out, froe_diagnostic *diag);

/** Is the leaf with this block right, with all objects in it? FROE_E_FORMAT says why not. Remembers those that are. */
froe_status tree_check_leaf(const tree_ready *ready, num_context *numbers, uint32_t block, froe_diagnostic *diag);
/** Do the blocks name owners that exist, from that of the one block up to that of the other? FROE_E_FORMAT. */
froe_status tree_check_owners(const tree_ready *ready, uint32_t from, uint32_t to, froe_diagnostic *diag);

static inline bool tree_bit_is_set(const atomic_uint *bits, uint32_t i) {
    return atomic_load_explicit((atomic_uint *)(uintptr_t)(bits + i / 32), memory_order_relaxed) >> i % 32 & 1;
}
#endif
