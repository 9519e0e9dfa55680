/* members.c: sets of numbers, as sorted lists. */
#include "query/members.h"
#include "base/random.h"
#include <string.h>

/* Where a number is, or would be. */
static size_t place_of_member(const query_members *set, uint32_t number) {
    size_t low = 0, high = set->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (set->data[middle] < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool query_members_has(const query_members *set, uint32_t number) {
    const size_t at = place_of_member(set, number);
    return at < set->count && set->data[at] == number;
}

static bool put_member(query_members *set, const froe_allocator *alloc, size_t at, uint32_t number) {
    if (!array_reserve(alloc, set, 1)) return false;
    memmove(set->data + at + 1, set->data + at, (set->count - at) * sizeof *set->data);
    set->data[at] = number;
    set->count++;
    return true;
}

bool query_members_add(query_members *set, const froe_allocator *alloc, uint32_t number) {
    const size_t at = place_of_member(set, number);
    return (at < set->count && set->data[at] == number) || put_member(set, alloc, at, number);
}

bool query_members_flip(query_members *set, const froe_allocator *alloc, uint32_t number) {
    const size_t at = place_of_member(set, number);
    if (at == set->count || set->data[at] != number) return put_member(set, alloc, at, number);
    set->count--;
    memmove(set->data + at, set->data + at + 1, (set->count - at) * sizeof *set->data);
    return true;
}

/* -------------------------------------------------------------------- kept -- */

void query_sets_free(query_sets *sets, const froe_allocator *alloc) {
    array_free(alloc, &sets->numbers);
    array_free(alloc, &sets->starts);
    scene_table_free(alloc, &sets->table);
}

static bool is_equal(const query_sets *sets, uint32_t kept, const query_members *set) {
    const uint32_t first = sets->starts.data[kept], count = sets->starts.data[kept + 1] - first;
    return count == set->count && !(count && memcmp(sets->numbers.data + first, set->data, count * sizeof *set->data));
}

bool query_sets_keep(query_sets *sets, const froe_allocator *alloc, const query_members *set, uint32_t *out) {
    uint64_t sum = set->count;
    for (size_t i = 0; i < set->count; i++) sum = base_mix(sum + set->data[i]);
    const uint32_t tag = (uint32_t)(sum >> 32);
    if (!scene_table_reserve(alloc, &sets->table, 1)) return false;
    size_t at = scene_table_first(&sets->table, tag);
    *out = scene_table_find(&sets->table, tag, &at);
    while (*out != FROE_NONE && !is_equal(sets, *out, set)) *out = scene_table_find_next(&sets->table, tag, &at);
    if (*out != FROE_NONE) return true;
    if (set->count > UINT32_MAX - sets->numbers.count) return false; /* one way: so many take 16 GB */
    if (!array_reserve(alloc, &sets->numbers, set->count) || !array_reserve(alloc, &sets->starts, 2)) return false;
    if (!sets->starts.count) sets->starts.data[sets->starts.count++] = 0;
    if (set->count) memcpy(sets->numbers.data + sets->numbers.count, set->data, set->count * sizeof *set->data);
    sets->numbers.count += set->count;
    sets->starts.data[sets->starts.count++] = (uint32_t)sets->numbers.count;
    *out = (uint32_t)sets->starts.count - 2;
    scene_table_put(&sets->table, at, tag, *out);
    return true;
}

bool query_sets_copy(const query_sets *sets, const froe_allocator *alloc, uint32_t kept, query_members *out) {
    const uint32_t first = sets->starts.data[kept], count = sets->starts.data[kept + 1] - first;
    out->count = 0;
    if (!array_reserve(alloc, out, count)) return false;
    if (count) memcpy(out->data, sets->numbers.data + first, count * sizeof *out->data);
    out->count = count;
    return true;
}
