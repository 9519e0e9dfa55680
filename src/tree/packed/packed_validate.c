/* packed_validate.c: blocks of a packed tree, before they are used.
 *
 * Blocks lie one behind the other in the order of a walk, headers say what follows from the nodes, ids name objects
 * of the scene that a block can hold, and owners repeat the ids with PACKED_START in their order. Units may be
 * anything: wrong ones cause wrong answers only, and the audit finds them. */
#include "support/fail.h"
#include "tree/packed/space.h"
#include "tree/walk.h"
#include <math.h>

typedef struct packed_check {
    const froe_tree *tree;
    froe_diagnostic *diag;
    uint32_t blocks, owners; /* seen so far */
} packed_check;

static froe_status bad_block(const packed_check *c, uint32_t node, const char *what) {
    return support_fail(c->diag, FROE_E_FORMAT, "node %u: The tree is corrupted: %s.", node, what);
}

static bool bytes_are_zero(const uint8_t *from, const uint8_t *to) {
    while (from < to && !*from) from++;
    return from == to;
}

bool packed_takes_place(const froe_tree *t, const tree_node *leaf, uint32_t *blocks) {
    const uint32_t count = leaf->u.list.count;
    if (leaf->child != *blocks || *blocks >= t->packed.block_count) return false;
    const uint32_t room = t->packed.block_count - 1 - *blocks; /* without the sentinel */
    if ((uint64_t)count * 12 > (uint64_t)room * PACKED_BLOCK || packed_size(count) > room) return false;
    *blocks += packed_size(count);
    return true;
}

const char *packed_leaf_fault(const froe_tree *t, uint32_t node, uint32_t *owners) {
    const tree_node *n = t->nodes + node;
    const uint32_t count = n->u.list.count, end = n->child + packed_size(count);
    const packed_header *h = packed_block(t, n);
    packed_box box;
    bool fits = isfinite(h->lo[0]) && isfinite(h->lo[1]) && packed_cell(t, h, &box) == node && box.lo[0] == h->lo[0] &&
                box.lo[1] == h->lo[1] && h->owner == *owners && *owners <= t->packed.owner_count;
    bool coarse = h->scale == 0 && h->error == PACKED_COARSE;
    bool units = fits && h->scale == packed_scale(&box) && h->scale > 0 && h->error >= 0.5f && h->error < 0x1p16f;
    const uint32_t *ids = packed_ids(h, count);
    if (!fits || !(coarse || units)) return "a block whose header does not fit";
    if (!bytes_are_zero((const uint8_t *)(ids + count), t->packed.blocks + (size_t)end * PACKED_BLOCK))
        return "a block with something behind its end";
    for (uint32_t i = 0; i < count; i++) {
        uint32_t object = ids[i] & PACKED_OBJECT;
        if (object >= t->scene->object_count) return "an object that does not exist";
        if (scene_form(t->scene, object) > FROE_SEGMENT) return "a kind that no block can hold";
        if (scene_form(t->scene, object) == FROE_POINT && !packed_is_whole(ids[i])) return "a part of a point";
        if (!(ids[i] & PACKED_START)) continue;
        if (*owners == t->packed.owner_count || t->packed.owners[*owners] != object)
            return "owners that differ from the blocks";
        ++*owners;
    }
    return NULL;
}

froe_status packed_validate(const froe_tree *t, froe_diagnostic *diag) {
    if (tree_is_space(t)) return space_validate(t, diag);
    packed_check c = {.tree = t, .diag = diag};
    tree_walk walk = {.tree = t};
    const tree_meta *m = &t->meta;
    bool fits = m->root_lo[0] <= m->root_hi[0] && m->root_lo[1] <= m->root_hi[1];
    froe_status status = fits && !t->cut_count ? FROE_OK : bad_block(&c, 0, "blocks that such a tree cannot have");
    while (!status && tree_walk_next(&walk)) {
        const tree_node *n = t->nodes + walk.node;
        if (!tree_is_leaf(n)) continue;
        const char *why =
            packed_takes_place(t, n, &c.blocks) ? packed_leaf_fault(t, walk.node, &c.owners) : "a block out of place";
        if (why) status = bad_block(&c, walk.node, why);
    }
    if (tree_walk_end(&walk)) return support_fail_memory(diag);
    if (status) return status;
    /* the sentinel is zeros, but for the number of all owners */
    const uint8_t *bytes = t->packed.blocks + (size_t)c.blocks * PACKED_BLOCK;
    const packed_header *h = (const packed_header *)(const void *)bytes;
    if (c.blocks + 1 != t->packed.block_count || c.owners != t->packed.owner_count || h->owner != c.owners ||
        h->lo[0] != 0 || h->lo[1] != 0 || h->scale != 0 || h->error != 0 ||
        !bytes_are_zero(bytes + sizeof *h, bytes + PACKED_BLOCK))
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: blocks or owners that no leaf uses.");
    return FROE_OK;
}
