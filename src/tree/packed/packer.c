/* packer.c: nodes, blocks and owners appended behind one another. */
#include "tree/packed/packer.h"
#include "tree/draft.h"
#include <string.h>

/* Blocks begin at the first multiple of their size. */
static size_t gap(const void *memory) {
    return (PACKED_BLOCK - (uintptr_t)memory % PACKED_BLOCK) % PACKED_BLOCK;
}

/* Gives the blocks room for `room` of them and the sentinel; what is there moves along. */
static froe_status resize(tree_packer *p, uint32_t room) {
    size_t size = ((size_t)room + 2) * PACKED_BLOCK, before = p->memory ? gap(p->memory) : 0;
    uint8_t *memory = support_realloc(&p->alloc, p->memory, p->memory_size, size);
    if (!memory) return FROE_E_MEMORY;
    if (gap(memory) != before) memmove(memory + gap(memory), memory + before, (size_t)p->block_count * PACKED_BLOCK);
    p->memory = memory;
    p->memory_size = size;
    p->block_room = room;
    return FROE_OK;
}

static uint8_t *block_at(const tree_packer *p, uint32_t block) {
    return p->memory + gap(p->memory) + (size_t)block * PACKED_BLOCK;
}

froe_status packer_new(const froe_allocator *alloc, uint64_t nodes, uint64_t blocks, uint64_t owners,
                       tree_packer *out) {
    tree_packer p = {.alloc = *alloc};
    bool taken = !resize(&p, blocks < UINT32_MAX / 2 ? (uint32_t)blocks : UINT32_MAX / 2) &&
                 array_reserve(alloc, &p.owners, owners + 1) && array_reserve(alloc, &p.nodes, nodes + 1);
    if (taken) p.nodes.data[p.nodes.count++] = (tree_node){0};
    if (taken)
        *out = p;
    else
        packer_free(&p);
    return taken ? FROE_OK : FROE_E_MEMORY;
}

void packer_free(tree_packer *p) {
    array_free(&p->alloc, &p->nodes);
    array_free(&p->alloc, &p->owners);
    support_free(&p->alloc, p->memory, p->memory_size);
    p->memory = NULL;
}

froe_status packer_split(tree_packer *p, uint32_t node, int axis, double value, uint32_t *child) {
    if (p->nodes.count + 2 > TREE_MOST) return FROE_E_LIMIT; /* one way: so many take 32 GB */
    if (!array_reserve(&p->alloc, &p->nodes, 2)) return FROE_E_MEMORY;
    *child = (uint32_t)p->nodes.count;
    p->nodes.data[node] = (tree_node){.u.value = value, .child = *child, .type = TREE_PLAIN, .axis = (uint8_t)axis};
    memset(p->nodes.data + *child, 0, 2 * sizeof(tree_node));
    p->nodes.count += 2;
    return FROE_OK;
}

/* Takes blocks and pieces. */
static froe_status take_blocks(tree_packer *p, uint32_t size, uint32_t pieces) {
    uint64_t need = (uint64_t)p->block_count + size, room = p->block_room + p->block_room / 2 + 16;
    if (pieces > TREE_MOST - p->piece_count) return FROE_E_LIMIT; /* one way: so many take 32 GB */
    if (need > p->block_room) {
        if (need >= UINT32_MAX - 1) return FROE_E_LIMIT;        /* one way: so many take 32 GB */
        if (room < need || room >= UINT32_MAX - 1) room = need; /* one way: so many take 32 GB */
        if (resize(p, (uint32_t)room)) return FROE_E_MEMORY;
    }
    p->piece_count += pieces;
    p->block_count += size;
    return FROE_OK;
}

/* Makes a node a leaf of so many pieces and blocks, which are yet to be written. */
static froe_status take_leaf(tree_packer *p, uint32_t node, uint32_t count, uint32_t size, uint8_t flags,
                             void **block) {
    const uint32_t first = p->piece_count, at = p->block_count;
    froe_status status = take_blocks(p, size, count);
    if (status) return status;
    *block = block_at(p, at);
    p->nodes.data[node] = (tree_node){.u.list = {first, count}, .child = at, .type = TREE_LEAF, .flags = flags};
    return FROE_OK;
}

froe_status packer_leaf(tree_packer *p, uint32_t node, const packed_box *box, const packed_fragment *fragments,
                        uint32_t count, uint8_t flags) {
    uint32_t size = packed_size(count), owner = (uint32_t)p->owners.count;
    void *block;
    if (!array_reserve(&p->alloc, &p->owners, count)) return FROE_E_MEMORY;
    froe_status status = take_leaf(p, node, count, size, flags, &block);
    if (status) return status;
    memset((uint8_t *)block + (size_t)(size - 1) * PACKED_BLOCK, 0, PACKED_BLOCK); /* what follows the ids */
    packed_write(block, box, owner, fragments, count);
    for (uint32_t i = 0; i < count; i++) {
        p->owners.data[p->owners.count] = fragments[i].id & PACKED_OBJECT;
        p->owners.count += fragments[i].id >> 31;
    }
    return FROE_OK;
}

froe_status packer_space_leaf(tree_packer *p, uint32_t node, const froe_scene *scene, space_item *items, uint32_t count,
                              uint8_t flags) {
    uint32_t triangles = space_sort(items, count), size = space_size(count, triangles);
    void *block;
    froe_status status = take_leaf(p, node, count, size, flags, &block);
    if (status) return status;
    memset(block, 0, (size_t)size * PACKED_BLOCK);
    space_write(block, scene, items, count, triangles);
    return FROE_OK;
}

froe_status packer_begin(tree_packer *p, packer_subtree *out) {
    const packer_place at = {(uint32_t)p->nodes.count, (uint32_t)p->nodes.count + 1, p->block_count,
                             (uint32_t)p->owners.count, p->piece_count};
    if (p->nodes.count + 1 > TREE_MOST) return FROE_E_LIMIT; /* one way: so many take 32 GB */
    *out = (packer_subtree){.at = at};
    return array_push(&p->alloc, &p->nodes, (tree_node){0}) ? FROE_OK : FROE_E_MEMORY;
}

void packer_end(const tree_packer *p, packer_subtree *s) {
    s->nodes = (uint32_t)p->nodes.count - s->at.nodes, s->blocks = p->block_count - s->at.blocks;
    s->owners = (uint32_t)p->owners.count - s->at.owners, s->pieces = p->piece_count - s->at.pieces;
}

froe_status packer_place_for(tree_packer *p, uint32_t node, const packer_subtree *s, packer_place *out) {
    *out = (packer_place){node, (uint32_t)p->nodes.count, p->block_count, (uint32_t)p->owners.count, p->piece_count};
    if (p->nodes.count + s->nodes > TREE_MOST) return FROE_E_LIMIT; /* one way: so many take 32 GB */
    if (!array_reserve(&p->alloc, &p->nodes, s->nodes) || !array_reserve(&p->alloc, &p->owners, s->owners))
        return FROE_E_MEMORY;
    froe_status status = take_blocks(p, s->blocks, s->pieces);
    if (status) return status; /* one way: the tree was made with room for the blocks of all subtrees */
    p->nodes.count += s->nodes;
    p->owners.count += s->owners;
    return FROE_OK;
}

void packer_put(const tree_packer *p, const packer_place *place, const tree_packer *from, const packer_subtree *s) {
    const packer_place *at = &s->at;
    memcpy(block_at(p, place->blocks), block_at(from, at->blocks), (size_t)s->blocks * PACKED_BLOCK);
    if (s->owners)
        memcpy(p->owners.data + place->owners, from->owners.data + at->owners, s->owners * sizeof *p->owners.data);
    for (uint32_t i = 0; i <= s->nodes; i++) {
        tree_node node = from->nodes.data[at->first + i];
        if (tree_is_leaf(&node)) {
            node.u.list.first += place->pieces - at->pieces;
            node.child += place->blocks - at->blocks;
            packed_header *block = (packed_header *)(void *)block_at(p, node.child);
            block->owner += place->owners - at->owners; /* in space that is 0, and another field */
        } else {
            node.child += place->nodes - at->nodes;
        }
        p->nodes.data[i ? place->nodes + i - 1 : place->first] = node;
    }
}

/* An array of exactly its size, one byte for an empty one; it stays as it was where that fails. */
static froe_status trim_array(const froe_allocator *alloc, void **data, size_t room, size_t count, size_t item_size) {
    void *trimmed = support_realloc(alloc, *data, room * item_size, count ? count * item_size : 1);
    if (!trimmed) return FROE_E_MEMORY;
    *data = trimmed;
    return FROE_OK;
}

froe_status packer_seal(tree_packer *p, froe_scene *scene, const tree_meta *meta, froe_tree **out) {
    froe_tree *t;
    froe_status status = resize(p, p->block_count);
    if (status) return status;
    packed_header *sentinel = (packed_header *)(void *)block_at(p, p->block_count);
    memset(sentinel, 0, PACKED_BLOCK);
    sentinel->owner = (uint32_t)p->owners.count; /* 0 in trees of space */
    status = trim_array(&p->alloc, (void **)&p->nodes.data, p->nodes.capacity, p->nodes.count, sizeof *p->nodes.data);
    if (status) return status;
    p->nodes.capacity = p->nodes.count;
    status = draft_shell(&p->alloc, scene, meta, &t);
    if (status) return status;
    status =
        trim_array(&p->alloc, (void **)&p->owners.data, p->owners.capacity, p->owners.count, sizeof *p->owners.data);
    if (!status) { /* hands the arrays over */
        t->nodes = p->nodes.data;
        t->node_count = (uint32_t)p->nodes.count;
        t->piece_count = p->piece_count;
        t->packed = (tree_packed){.memory = p->memory,
                                  .memory_size = p->memory_size,
                                  .blocks = block_at(p, 0),
                                  .block_count = p->block_count + 1,
                                  .owners = p->owners.data,
                                  .owner_count = (uint32_t)p->owners.count};
        *p = (tree_packer){.alloc = p->alloc};
        status = tree_finish(t);
    }
    if (!status) status = tree_fill_promises(t);
    if (status)
        froe_tree_free(t);
    else
        *out = t;
    return status;
}
