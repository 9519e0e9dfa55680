/* table.h: a hash table of ids: open addressing, linear probing.
 *
 *     slots   [ tag | id ]  [ tag | id ]  [ free ]  [ tag | id ] ...      first slot of an entry: tag & mask
 *
 * It stores no keys. The owner keeps them by id and compares candidates whose whole
 * 32-bit tag agrees, so a miss hardly ever touches a key. Removal shifts later entries back
 * (Knuth, TAOCP 3, 6.4, algorithm R): no tombstones, and undoing additions leaves no trace. */
#ifndef FROE_SCENE_TABLE_H
#define FROE_SCENE_TABLE_H
#include "support/alloc.h"

typedef struct scene_slot {
    uint32_t tag, next_id; /**< next_id: id + 1, 0 when free */
} scene_slot;

typedef struct scene_table {
    scene_slot *slots;
    size_t size, count; /**< size: 0 or a power of two */
} scene_table;

/** Room for `extra` more entries at a load of 3/4. False without memory; then nothing changed. */
bool scene_table_reserve(const froe_allocator *alloc, scene_table *table, size_t extra);
void scene_table_free(const froe_allocator *alloc, scene_table *table);

/** Where the search for `tag` starts. REQUIRES: room for one entry, as reserve makes. */
static inline size_t scene_table_first(const scene_table *table, uint32_t tag) {
    return tag & (table->size - 1);
}
/** The id of the next entry with this tag from *at on, which moves to it; FROE_NONE with *at at a free slot. */
static inline uint32_t scene_table_find(const scene_table *table, uint32_t tag, size_t *at) {
    while (table->slots[*at].next_id) {
        if (table->slots[*at].tag == tag) return table->slots[*at].next_id - 1;
        *at = (*at + 1) & (table->size - 1);
    }
    return FROE_NONE;
}
/** Goes on after a candidate that was not the one. */
static inline uint32_t scene_table_find_next(const scene_table *table, uint32_t tag, size_t *at) {
    *at = (*at + 1) & (table->size - 1);
    return scene_table_find(table, tag, at);
}
/** Fills the free slot where a search ended. */
static inline void scene_table_put(scene_table *table, size_t at, uint32_t tag, uint32_t id) {
    table->slots[at] = (scene_slot){tag, id + 1};
    table->count++;
}
/** Removes an entry that is there. */
void scene_table_remove(scene_table *table, uint32_t tag, uint32_t id);
#endif
