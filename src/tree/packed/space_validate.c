/* space_validate.c: blocks of a packed tree of space, before they are used.
 *
 * Blocks lie one behind the other in the order of a walk, their headers agree with the nodes, and ids name objects of
 * the scene, triangles first. Units may be anything: wrong ones cause wrong answers only, and the audit
 * finds them. */
#include "support/fail.h"
#include "tree/packed/space.h"
#include "tree/walk.h"
#include <math.h>

static froe_status bad_space_block(froe_diagnostic *diag, uint32_t node, const char *what) {
    return support_fail(diag, FROE_E_FORMAT, "node %u: The tree is corrupted: %s.", node, what);
}

static bool range_is_zero(const uint8_t *from, const uint8_t *to) {
    while (from < to && !*from) from++;
    return from == to;
}

/* Units say nothing only where there are none, or where the scene is too large or too small for them. */
static bool header_fits(const froe_tree *t, const space_header *h) {
    static const uint8_t zeros[sizeof h->unused];
    int exponent;
    bool numbers = h->scale == 0 ? !h->count || !space_is_tame(t->meta.root_lo, t->meta.root_hi)
                                 : h->count && isfinite(h->scale) && frexp(h->scale, &exponent) == 0.5 &&
                                       h->scale >= 0x1p-400 && h->scale <= 0x1p620;
    for (int k = 0; k < 3; k++) {
        numbers = numbers && isfinite(h->lo[k]) && h->box[0][k] <= h->box[1][k];
        if (h->scale == 0) numbers = numbers && h->lo[k] == 0 && h->box[1][k] == 0;
    }
    return numbers && memcmp(h->unused, zeros, sizeof zeros) == 0;
}

const char *space_leaf_fault(const froe_tree *t, uint32_t block, uint32_t *size) {
    const uint32_t room = t->packed.block_count - 1 - block; /* without the sentinel */
    const space_header *h = space_block(t, block);
    const uint32_t count = h->count;
    if (h->triangles > count) return "a block whose header does not fit";
    if ((uint64_t)count * 16 > (uint64_t)room * PACKED_BLOCK || space_size(count, h->triangles) > room)
        return "a block out of place";
    if (!header_fits(t, h)) return "a block whose header does not fit";
    for (uint32_t i = 0; i < count; i++) {
        uint32_t id = space_ids(h)[i], object = id & PACKED_OBJECT;
        if (object >= t->scene->object_count || id & PACKED_END) return "an object that does not exist";
        if (space_is_triangle(t->scene, object) != (i < h->triangles)) return "triangles among others";
        froe_kind form = scene_form(t->scene, object);
        if ((form == FROE_BOX || form == FROE_POINT) != ((id & SPACE_EXACT) != 0))
            return "a box or point not called so, or something else called so";
    }
    *size = space_size(count, h->triangles);
    const uint8_t *end = (const uint8_t *)(space_row(h, 8) + h->triangles);
    const uint8_t *from = h->scale == 0 ? (const uint8_t *)(space_ids(h) + count) : end;
    return range_is_zero(from, t->packed.blocks + ((size_t)block + *size) * PACKED_BLOCK)
               ? NULL
               : "a block with something behind its end";
}

static const char *check_block(const froe_tree *t, const tree_node *n, uint32_t *blocks) {
    uint32_t size;
    if (n->child != *blocks || n->child + 1 >= t->packed.block_count) return "a block out of place";
    if (space_block(t, n->child)->count != n->u.list.count) return "a block whose header does not fit";
    const char *why = space_leaf_fault(t, n->child, &size);
    if (!why) *blocks += size;
    return why;
}

froe_status space_validate(const froe_tree *t, froe_diagnostic *diag) {
    tree_walk walk = {.tree = t};
    uint32_t blocks = 0;
    bool fits = !t->cut_count && !t->packed.owner_count;
    for (int k = 0; k < 3; k++) fits = fits && t->meta.root_lo[k] <= t->meta.root_hi[k];
    froe_status status = fits ? FROE_OK : bad_space_block(diag, 0, "blocks that such a tree cannot have");
    while (!status && tree_walk_next(&walk)) {
        const tree_node *n = t->nodes + walk.node;
        const char *why = tree_is_leaf(n) ? check_block(t, n, &blocks) : NULL;
        if (why) status = bad_space_block(diag, walk.node, why);
    }
    if (tree_walk_end(&walk)) return support_fail_memory(diag);
    if (status) return status;
    const uint8_t *sentinel = t->packed.blocks + (size_t)blocks * PACKED_BLOCK;
    if (blocks + 1 != t->packed.block_count || !range_is_zero(sentinel, sentinel + PACKED_BLOCK))
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: blocks that no leaf uses.");
    return FROE_OK;
}
