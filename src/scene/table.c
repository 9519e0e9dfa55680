/* table.c: growth and removal of the hash table of ids. */
#include "scene/table.h"

static void move_entries(const scene_table *from, scene_table *to) {
    for (size_t i = 0; i < from->size; i++) {
        if (!from->slots[i].next_id) continue;
        size_t at = scene_table_first(to, from->slots[i].tag);
        while (to->slots[at].next_id) at = (at + 1) & (to->size - 1);
        to->slots[at] = from->slots[i];
    }
    to->count = from->count;
}

bool scene_table_reserve(const froe_allocator *alloc, scene_table *table, size_t extra) {
    size_t need, size = table->size ? table->size : 64;
    if (__builtin_add_overflow(table->count, extra, &need)) return false;
    while (size - size / 4 < need) {
        if (size > SIZE_MAX / 2) return false;
        size *= 2;
    }
    if (size == table->size) return true;
    scene_table grown = {.slots = support_calloc(alloc, size, sizeof(scene_slot)), .size = size};
    if (!grown.slots) return false;
    move_entries(table, &grown);
    scene_table_free(alloc, table);
    *table = grown;
    return true;
}

void scene_table_free(const froe_allocator *alloc, scene_table *table) {
    support_free(alloc, table->slots, table->size * sizeof(scene_slot));
    *table = (scene_table){0};
}

void scene_table_remove(scene_table *table, uint32_t tag, uint32_t id) {
    size_t mask = table->size - 1, hole = scene_table_first(table, tag);
    while (table->slots[hole].next_id != id + 1) hole = (hole + 1) & mask;
    for (size_t i = (hole + 1) & mask; table->slots[i].next_id; i = (i + 1) & mask) {
        size_t first = scene_table_first(table, table->slots[i].tag);
        if (((i - first) & mask) < ((i - hole) & mask)) continue; /* it would land before its first slot */
        table->slots[hole] = table->slots[i];
        hole = i;
    }
    table->slots[hole] = (scene_slot){0};
    table->count--;
}
