/* gate.c: see gate.h. Each check reads the file and remembers one bit, so relaxed atomics are enough: what a check has
 * read does not change. */
#include "tree/gate.h"
#include "base/floats.h"
#include "support/fail.h"
#include "tree/file.h"
#include "tree/packed/table.h"
#include "tree/validate.h"
#include <string.h>

struct tree_gate {
    const uint8_t *bytes; /* of the file */
    uint64_t size;
    atomic_int trust;            /* scene_trust */
    _Atomic(tree_ready *) ready; /* NULL until the first search */
};

froe_status tree_gate_new(const froe_allocator *alloc, const uint8_t *bytes, uint64_t size, tree_gate **out) {
    tree_gate *gate = *out = support_calloc(alloc, 1, sizeof *gate);
    if (!gate) return FROE_E_MEMORY;
    gate->bytes = bytes;
    gate->size = size;
    atomic_init(&gate->trust, SCENE_UNCHECKED);
    atomic_init(&gate->ready, NULL);
    return FROE_OK;
}

static void free_ready(const froe_allocator *alloc, tree_ready *ready) {
    if (!ready) return;
    tree_table_free(alloc, ready->tree.packed.table);
    support_free(alloc, ready->leaves, ready->leaf_words * sizeof *ready->leaves);
    support_free(alloc, ready->owners, ready->owner_words * sizeof *ready->owners);
    support_free(alloc, ready, sizeof *ready);
}

void tree_gate_free(const froe_allocator *alloc, tree_gate *gate) {
    if (!gate) return;
    free_ready(alloc, atomic_load(&gate->ready));
    support_free(alloc, gate, sizeof *gate);
}

/* ------------------------------------------------------------------ settled -- */

static bool is_zero_between(const uint8_t *bytes, uint64_t from, uint64_t to) {
    for (; from < to; from++)
        if (bytes[from]) return false;
    return true;
}

/* Checksums of the sections, and what lies between them. */
static froe_status check_bytes(const tree_gate *gate, froe_diagnostic *diag) {
    const file_section *table = (const file_section *)(const void *)(gate->bytes + sizeof(file_header));
    uint64_t end = sizeof(file_header) + FILE_SECTIONS * sizeof *table;
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        const file_section *s = table + i;
        if (s->checksum != file_checksum(gate->bytes + s->offset, s->size, 0))
            return support_fail(diag, FROE_E_FORMAT,
                                "The tree file is corrupted: the checksum of its section %u is wrong.", s->id);
        if (!is_zero_between(gate->bytes, end, s->offset))
            return support_fail(diag, FROE_E_FORMAT, "The tree file is corrupted: it has bytes between sections.");
        end = s->offset + s->size;
    }
    return FROE_OK; /* the last section, of wide nodes, fills the file: their size is a multiple of FILE_ALIGN */
}

static bool same(const void *a, const void *b, size_t size) {
    return !size || !memcmp(a, b, size);
}

/* Are the sections that follow from others what the others make of them? */
static froe_status check_made(const froe_tree *t, froe_diagnostic *diag) {
    tree_facts facts;
    table_cells cells;
    tree_wide *wide = NULL;
    if (tree_facts_of(t, &facts) || tree_table_cells(t, &cells)) return support_fail_memory(diag);
    const table_cells *there = &t->packed.cells;
    const bool cells_same = same(cells.nodes, there->nodes, cells.count * sizeof *cells.nodes) &&
                            same(cells.crooked, there->crooked, cells.lines);
    tree_table_cells_free(t, &cells);
    if (tree_wide_new(t, &wide)) return support_fail_memory(diag);
    const tree_wide *nodes = t->packed.wide;
    const bool wide_same =
        !wide || (wide->count == nodes->count && wide->levels == nodes->levels && /* both are there or neither is */
                  same(wide->nodes, nodes->nodes, wide->count * sizeof *wide->nodes));
    if (wide) facts.levels = wide->levels;
    tree_wide_free(&t->alloc, wide);
    const char *what = !same(&facts, &t->facts, sizeof facts) ? "counts"
                       : !cells_same                          ? "a jump table"
                       : !wide_same                           ? "boxes"
                                                              : NULL;
    if (!what) return FROE_OK;
    return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: it has %s that do not follow from its nodes.",
                        what);
}

bool tree_is_checked(const froe_tree *t) {
    return !t->gate || atomic_load_explicit(&t->gate->trust, memory_order_relaxed) == SCENE_RIGHT;
}

froe_status froe_tree_check(const froe_tree *t, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!t) return support_fail_null(diag, __func__);
    if (tree_is_checked(t)) return FROE_OK;
    if (!diag && atomic_load_explicit(&t->gate->trust, memory_order_relaxed) == SCENE_WRONG) return FROE_E_FORMAT;
    froe_status status = check_bytes(t->gate, diag);
    if (!status) status = scene_settle(t->scene, diag);
    if (!status) status = tree_validate(t, diag);
    if (!status) status = check_made(t, diag);
    if (status != FROE_E_MEMORY)
        atomic_store_explicit(&t->gate->trust, status ? SCENE_WRONG : SCENE_RIGHT, memory_order_relaxed);
    return status;
}

/* -------------------------------------------------------------------- ready -- */

/* What searches read beside blocks and objects. */
static froe_status check_frame(tree_ready *r, froe_diagnostic *diag) {
    froe_tree *t = &r->tree;
    if (tree_is_space(t)) {
        if (!t->packed.wide || tree_wide_fits(t, t->packed.wide)) return FROE_OK;
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: boxes that lead nowhere.");
    }
    froe_status status = tree_validate_nodes(t, diag);
    if (status) return status;
    status = tree_table_from(t, &t->packed.cells, &t->packed.table);
    if (status != FROE_E_FORMAT) return status ? support_fail_memory(diag) : FROE_OK;
    return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: a jump table that names a node without being.");
}

static froe_status make_ready(const froe_tree *t, tree_ready **out, froe_diagnostic *diag) {
    tree_ready *r = *out = support_calloc(&t->alloc, 1, sizeof *r);
    if (!r) return support_fail_memory(diag);
    r->tree = *t;
    r->leaf_words = t->packed.block_count / 32 + 1;
    r->owner_words = t->packed.owner_count / READY_OWNERS / 32 + 1;
    r->leaves = support_calloc(&t->alloc, r->leaf_words, sizeof *r->leaves);
    r->owners = support_calloc(&t->alloc, r->owner_words, sizeof *r->owners);
    return r->leaves && r->owners ? check_frame(r, diag) : support_fail_memory(diag);
}

froe_status tree_make_ready(const froe_tree *t, const tree_ready **out, froe_diagnostic *diag) {
    tree_ready *ready, *there = NULL;
    *out = NULL;
    if (!t->gate) return FROE_OK;
    if (!tree_is_packed(t)) return tree_settle(t, diag);
    ready = atomic_load(&t->gate->ready);
    if (!ready) {
        const froe_status status = make_ready(t, &ready, diag);
        if (status) {
            free_ready(&t->alloc, ready);
            return status;
        }
        /* one way: another thread has to be faster between two lines */
        if (!atomic_compare_exchange_strong(&t->gate->ready, &there, ready)) {
            free_ready(&t->alloc, ready);
            ready = there;
        }
    }
    *out = ready;
    return FROE_OK;
}

/* ------------------------------------------------------------- leaf by leaf -- */

static void set_bit(atomic_uint *bits, uint32_t i) {
    atomic_fetch_or_explicit(bits + i / 32, 1u << i % 32, memory_order_relaxed);
}

static froe_status bad_block(uint32_t block, const char *why, froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_FORMAT, "block %u: The tree is corrupted: %s.", block, why);
}

static const char *block_fault(const froe_tree *t, uint32_t block, const uint32_t **ids, uint32_t *count) {
    if (tree_is_space(t)) {
        const space_header *h = space_block(t, block);
        uint32_t size;
        *ids = space_ids(h);
        *count = h->count;
        return space_leaf_fault(t, block, &size);
    }
    const packed_header *h = packed_block_at(t, block);
    packed_box box;
    uint32_t owners = h->owner;
    const uint32_t node = packed_cell(t, h, &box);
    if (t->nodes[node].child != block) return "a block whose header does not fit";
    *count = t->nodes[node].u.list.count;
    *ids = packed_ids(h, *count);
    return packed_leaf_fault(t, node, &owners);
}

froe_status tree_check_leaf(const tree_ready *r, num_context *numbers, uint32_t block, froe_diagnostic *diag) {
    const froe_tree *t = &r->tree;
    const uint32_t *ids;
    uint32_t count = 0;
    const char *why = block_fault(t, block, &ids, &count);
    if (why) return bad_block(block, why, diag);
    for (uint32_t i = 0; i < count; i++) {
        const froe_status status = scene_check_object(t->scene, ids[i] & PACKED_OBJECT, numbers, diag);
        if (status) return status;
    }
    set_bit(r->leaves, block);
    return FROE_OK;
}

froe_status tree_check_owners(const tree_ready *r, uint32_t from, uint32_t to, froe_diagnostic *diag) {
    const tree_packed *p = &r->tree.packed;
    const uint32_t first = packed_block_at(&r->tree, from)->owner, end = packed_block_at(&r->tree, to)->owner;
    if (first > end || end > p->owner_count) return bad_block(from, "owners that do not exist", diag);
    for (uint32_t part = first / READY_OWNERS; (uint64_t)part * READY_OWNERS < end; part++) {
        if (tree_bit_is_set(r->owners, part)) continue;
        const uint64_t next = ((uint64_t)part + 1) * READY_OWNERS;
        for (uint64_t i = (uint64_t)part * READY_OWNERS; i < next && i < p->owner_count; i++)
            if (p->owners[i] >= r->tree.scene->object_count) return bad_block(from, "owners that do not exist", diag);
        set_bit(r->owners, part);
    }
    return FROE_OK;
}
